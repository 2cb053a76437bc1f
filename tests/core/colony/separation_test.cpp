#include "core/colony/separation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <vector>

#include "core/math/random.h"
#include "tests/support/intrusion.h"
#include "tests/support/meshes.h"
#include "tests/support/orders.h"

namespace sporeprint::colony_separation_test {
namespace {

Mesh cap_of(const char* id, double age = 0.6) {
    return cap_mesh(resolved(order_of(id, age, 2, 1)), {1, 1.0, false});
}

TEST(OccupancyGrid, ContainsItsMeshAndLittleMore) {
    for (const char* id : {"armillaria_mellea", "mycena_haematopus", "macrolepiota_procera"}) {
        const Mesh mesh = cap_of(id);
        const OccupancyGrid occupancy(mesh);
        for (const glm::dvec3& point : samples_of(mesh))
            EXPECT_TRUE(occupancy.contains(point)) << id;
        const Bounds box = bounds(mesh);
        const double above = box.max.y + 0.2 * occupancy.reach();
        EXPECT_FALSE(occupancy.contains({0.0, above, 0.0}));
        EXPECT_TRUE(occupancy.contains({0.0, box.max.y - 1e-4, 0.0}));
        for (const glm::dvec3& point : occupancy.border())
            EXPECT_LE(glm::length(point - occupancy.middle()), occupancy.reach());
    }
    // The space under an umbrella is free.
    const Mesh umbrella = cap_of("macrolepiota_procera");
    const OccupancyGrid occupancy(umbrella);
    const Bounds box = bounds(umbrella);
    EXPECT_FALSE(occupancy.contains({0.6 * box.max.x, box.min.y, 0.0}));
}

TEST(OccupancyGrid, TwoOverlapExactlyWhereTheirMeshesNearlyTouch) {
    const Mesh mesh = cap_of("armillaria_mellea");
    const OccupancyGrid occupancy(mesh);
    const Bounds box = bounds(mesh);
    const double wide = box.max.x - box.min.x, high = box.max.y - box.min.y;
    const Pose here;
    const auto collides = [&](const glm::dvec3& at, const glm::dmat3& turn = glm::dmat3(1.0)) {
        const Pose there{at, turn, 1.0};
        const bool one = overlap(occupancy, here, occupancy, there);
        EXPECT_EQ(one, overlap(occupancy, there, occupancy, here)) << "it is mutual";
        return one;
    };
    EXPECT_TRUE(collides({0.0, 0.0, 0.0}));
    EXPECT_TRUE(collides({0.9 * wide, 0.0, 0.0}));
    EXPECT_FALSE(collides({1.12 * wide, 0.0, 0.0}));
    EXPECT_FALSE(collides({0.0, 1.02 * high, 0.0}));
    EXPECT_TRUE(collides({0.0, 0.3 * high, 0.0}));
    // One crosses the other edgewise.
    EXPECT_TRUE(collides({0.3 * wide, 0.0, 0.0}, upright({1.0, 0.0, 0.0}, 0.3)));
}

TEST(OccupancyGrid, PosesAreInvertible) {
    Random random(5, 7);
    for (int i = 0; i < 50; ++i) {
        const double x = random.symmetric(), z = random.symmetric(), turn = random.uniform(0, 6);
        const glm::dvec3 up = glm::normalize(glm::dvec3(x, 0.6, z));
        const Pose pose{{1.0, 2.0, 3.0}, upright(up, turn), 1.7};
        EXPECT_NEAR(glm::determinant(pose.turn), 1.0, 1e-12);
        EXPECT_LT(glm::length(pose.turn * glm::dvec3(0, 1, 0) - up), 1e-12);
        const glm::dvec3 point(0.3, -0.2, 0.7);
        EXPECT_LT(glm::length(pose.own(pose.world(point)) - point), 1e-12);
        EXPECT_NEAR(glm::length(pose.world(point) - pose.at), 1.7 * glm::length(point), 1e-12);
    }
}

// Two stems side by side with caps of a given width: the first stays in place, the second is
// adjusted.
class TwoStems : public ::testing::Test {
  protected:
    std::vector<ColonyMember> placed(double apart, const std::vector<ColonyModel>& models) {
        site_.places.clear();
        for (const double x : {0.0, apart}) {
            ColonyPlace place;
            place.foot = {x, 0.0, 0.0};
            place.rise = {0.0, 0.08, 0.0};
            place.radius = 0.006;
            place.number = static_cast<std::uint32_t>(site_.places.size());
            if (x > 0.0) place.outwards = {1.0, 0.0, 0.0};
            site_.places.push_back(place);
        }
        ColonyParams params;
        return placed_members(site_, models, params, ColonyTraits{});
    }

    ColonySite site_;
    Mesh large_ = cap_of("armillaria_mellea"), small_ = cap_of("armillaria_mellea", 0.2);
    ColonyModel wide_{OccupancyGrid(large_), 0.006}, narrow_{OccupancyGrid(small_), 0.009};
    double across_ = static_cast<double>(bounds(large_).max.x - bounds(large_).min.x);
};

TEST_F(TwoStems, WithEnoughSpaceStandAsPlaced) {
    const auto members = placed(1.3 * across_, {wide_});
    ASSERT_EQ(members.size(), 2U);
    for (const ColonyMember& member : members) {
        EXPECT_EQ(member.steps, 0);
        EXPECT_EQ(member.rise, site_.places[member.place].rise);
        EXPECT_EQ(member.swing, site_.places[member.place].swing);
        EXPECT_EQ(member.pose.scale, 1.0);
    }
}

TEST_F(TwoStems, LeanFirst) {
    const auto members = placed(0.9 * across_, {wide_, narrow_});
    ASSERT_EQ(members.size(), 2U);
    EXPECT_EQ(members[0].steps, 0);
    EXPECT_GT(members[1].swing.x, 0.0) << "away from the other";
    EXPECT_EQ(members[1].rise, site_.places[1].rise) << "as high as before";
}

TEST_F(TwoStems, AreYoungerWhereNoLeanHelps) {
    const auto alone = placed(0.2 * across_, {wide_});
    const auto members = placed(0.2 * across_, {wide_, narrow_});
    ASSERT_EQ(members.size(), 2U);
    EXPECT_EQ(members[1].model, 1U);
    ASSERT_LE(alone.size(), 2U);
    if (alone.size() == 2) {
        EXPECT_NE(alone[1].rise, site_.places[1].rise) << "or else lower";
    }
}

TEST_F(TwoStems, TheSecondAtTheSamePlaceIsLeftOut) {
    const auto members = placed(0.02 * across_, {wide_});
    ASSERT_EQ(members.size(), 1U);
    EXPECT_EQ(members[0].place, 0U);
}

}  // namespace
}  // namespace sporeprint::colony_separation_test
