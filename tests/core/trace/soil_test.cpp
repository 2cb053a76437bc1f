#include "core/trace/soil.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/drawn_mushroom.h"
#include "tests/support/photographs.h"

namespace sporeprint::trace_soil_test {
namespace {

const glm::dvec3 skin(225.0, 220.0, 205.0), earth(70.0, 52.0, 38.0), cap(150.0, 90.0, 50.0);

/// A drawn mushroom on a plate, an ellipse round its foot.
struct Standing {
    DrawnMushroom drawn;
    trace::Mask without = drawn.mask(), with = without;
    Picture picture{drawn.side, drawn.side, {}};

    /// width   half of that of the plate, of the unit
    /// stained height up to which the right half of the stem has the colour of soil, of the unit
    Standing(double width, const glm::dvec3& plate, double stained = 0.0) {
        const glm::dvec2 foot = drawn.foot();
        for (int y = 0; y < drawn.side; ++y)
            for (int x = 0; x < drawn.side; ++x) {
                const double right = (x + 0.5 - foot.x) / drawn.pixels,
                             up = (foot.y - y - 0.5) / drawn.pixels;
                const double across = right / width, down = up / 0.03;
                const bool in_plate = across * across + down * down < 1.0;
                // The foot stands in the middle of the plate, whose front half is before it.
                const bool is_stem = without.at(x, y) && up >= 0.0;
                if (in_plate) with.inside[with.index(x, y)] = 1;
                glm::dvec3 colour(90.0, 140.0, 90.0);
                if (in_plate) colour = plate;
                if (is_stem) colour = up > drawn.stem_top ? cap : skin;
                if (is_stem && right > 0.01 && up < stained) colour = earth;
                for (int c = 0; c < 3; ++c)
                    picture.rgb.push_back(static_cast<std::uint8_t>(colour[c]));
            }
    }

    [[nodiscard]] trace::Mask found() const {
        return trace::without_soil(picture, with, drawn.gesture().axis);
    }
};

TEST(WithoutSoil, LeavesOutAPlateOfAnotherColour) {
    for (const double stained : {0.0, 0.02}) {
        const Standing standing(0.2, earth, stained);
        EXPECT_LT(intersection_over_union(standing.with, standing.without), 0.975);
        EXPECT_GT(intersection_over_union(standing.found(), standing.without), 0.99) << stained;
    }
}

TEST(WithoutSoil, LeavesAFootOfTheColourOfTheStem) {
    const Standing standing(0.2, skin);
    EXPECT_EQ(standing.found(), standing.with);
}

TEST(WithoutSoil, LeavesAStainedFootThatIsNoWider) {
    const Standing standing(0.06, earth, 0.1);
    EXPECT_EQ(standing.found(), standing.with);
}

TEST(WithoutSoil, LeavesGrownMushroomsWithoutGroundAsTheyAre) {
    for (const char* species : {"amanita_muscaria", "boletus_edulis", "lycoperdon_perlatum"}) {
        const Photograph photo = photograph({species, 0.7, 3, View::front, 512}, Scenery::plain);
        const trace::Mask found =
            trace::without_soil(photo.picture, photo.truth, photo.gesture.axis);
        EXPECT_GT(intersection_over_union(found, photo.truth), 0.97) << species;
    }
}

}  // namespace
}  // namespace sporeprint::trace_soil_test
