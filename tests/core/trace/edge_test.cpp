#include "core/trace/edge.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "core/trace/lab.h"
#include "tests/support/drawn_mushroom.h"
#include "tests/support/photographs.h"

namespace sporeprint::trace_edge_test {
namespace {

Picture painted(const trace::Mask& mask, const glm::dvec3& inside, const glm::dvec3& outside) {
    Picture picture{mask.width, mask.height, {}};
    for (const std::uint8_t is_inside : mask.inside)
        for (int c = 0; c < 3; ++c)
            picture.rgb.push_back(
                static_cast<std::uint8_t>((is_inside != 0 ? inside : outside)[c]));
    return picture;
}

TEST(Edge, IsTheDifferenceOfBothColours) {
    const trace::Mask mask = DrawnMushroom().mask();
    const glm::dvec3 brown(150.0, 90.0, 50.0), green(80.0, 130.0, 70.0);
    EXPECT_NEAR(trace::edge_of(painted(mask, brown, green), mask),
                glm::length(trace::lab_of(brown) - trace::lab_of(green)), 0.5);
    EXPECT_LT(trace::edge_of(painted(mask, brown, brown), mask), 0.1);
}

TEST(Edge, OfPhotographedMushroomsIsClear) {
    for (const Scenery scenery : {Scenery::plain, Scenery::forest, Scenery::crowded})
        for (const char* species :
             {"boletus_edulis", "amanita_phalloides", "psilocybe_semilanceata"}) {
            const Photograph photo = photograph({species, 0.7, 3, View::front, 1024}, scenery);
            EXPECT_GT(trace::edge_of(photo.picture, photo.truth), trace::least_edge) << species;
        }
}

TEST(Edge, OfNothingAndOfAllIsNone) {
    const Picture grey{30, 20, std::vector<std::uint8_t>(1800, 90)};
    EXPECT_EQ(trace::edge_of(grey, trace::Mask(30, 20)), 100.0);
    EXPECT_EQ(trace::edge_of(grey, trace::Mask(30, 20, true)), 100.0);
}

}  // namespace
}  // namespace sporeprint::trace_edge_test
