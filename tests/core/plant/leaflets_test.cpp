#include "core/plant/leaflets.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "core/math/elementary.h"
#include "core/math/random.h"
#include "core/plant/leaf.h"
#include "tests/support/atlas.h"
#include "tests/support/draws.h"
#include "tests/support/meshes.h"

namespace sporeprint::plant_leaflets_test {
namespace {

TEST(Leaflets, ASimpleLeafHasNone) { EXPECT_TRUE(placed_leaflets({}).empty()); }

TEST(Leaflets, StandAlongTheAxisAndTheLastReachesItsEnd) {
    Random random(3, 1);
    for (int i = 0; i < 200; ++i) {
        auto leaflets = drawn<Leaflets>(random);
        leaflets.count = std::max(leaflets.count, 1);
        const std::vector<PlacedLeaflet> placed = placed_leaflets(leaflets);
        ASSERT_EQ(placed.size(), static_cast<std::size_t>(leaflets.count));
        double before = -1.0;
        for (const PlacedLeaflet& one : placed) {
            EXPECT_GE(one.at, 0.0);
            EXPECT_GT(one.at, before);
            before = one.at;
            EXPECT_GT(one.size, 0.0);
            EXPECT_LE(one.size, leaflets.length);
            EXPECT_NEAR(glm::length(one.along), 1.0, 1e-12);
            EXPECT_NEAR(glm::length(one.up), 1.0, 1e-12);
            EXPECT_NEAR(glm::dot(one.along, one.up), 0.0, 1e-12);
        }
        const glm::dvec3 tip = placed.back().place({0.0, 0.0, 1.0});
        EXPECT_LT(glm::distance(tip, glm::dvec3(0.0, 0.0, 1.0)), 1e-12);
    }
}

TEST(Leaflets, InTwoRowsStandLevelOnBothSidesInTurn) {
    Leaflets leaflets;
    leaflets.count = 21;
    const std::vector<PlacedLeaflet> placed = placed_leaflets(leaflets);
    for (std::size_t i = 0; i + 1 < placed.size(); ++i) {
        EXPECT_EQ(placed[i].along.x > 0.0, i % 2 == 0);
        EXPECT_NEAR(placed[i].along.y, 0.0, 1e-12);
        EXPECT_GT(placed[i].up.y, 0.999);
    }
}

TEST(Leaflets, NeighboursDifferInSizeAndAngle) {
    Leaflets leaflets;
    leaflets.count = 31;
    leaflets.narrow_base = leaflets.narrow_tip = 0.0;
    const std::vector<PlacedLeaflet> placed = placed_leaflets(leaflets);
    for (std::size_t i = 0; i + 2 < placed.size(); ++i) {
        EXPECT_GT(std::abs(placed[i].size - placed[i + 1].size), 1e-4 * leaflets.length);
        EXPECT_GT(std::abs(placed[i].along.z - placed[i + 1].along.z), 1e-4);
        EXPECT_GT(placed[i].size, 0.8 * leaflets.length);
    }
}

TEST(Leaflets, AllRoundStandOnEverySideUnlessTheyAreParted) {
    Leaflets leaflets;
    leaflets.count = 60;
    leaflets.turn_deg = 137.5;
    const auto height = [&](double flat) {
        leaflets.flat = flat;
        double sum = 0.0;
        for (const PlacedLeaflet& one : placed_leaflets(leaflets)) sum += std::abs(one.along.y);
        return sum;
    };
    EXPECT_LT(height(1.0), 0.5 * height(0.0));
}

// A compound leaf is as many closed pieces as it has leaflets, and its axis; its coarse levels cover
// what its finest does.
TEST(Leaflets, MakeAFrondOfClosedPiecesAtEveryLevel) {
    const LeafShape& fern = leaf_preset("fern")->shape;
    ASSERT_GT(fern.leaflets.count, 0);
    for (int lod = 0; lod < leaf_lods; ++lod) {
        const Mesh mesh = leaf_mesh(fern, lod);
        expect_valid(mesh);
        EXPECT_EQ(pieces(mesh).size(), static_cast<std::size_t>(fern.leaflets.count) + 1);
    }
}

TEST(Leaflets, AFrondIsAsLongAsTheLeafAndAsWideAsItsLeaflets) {
    LeafShape fern = leaf_preset("fern")->shape;
    fern.curl_deg = fern.fold_deg = fern.wave = fern.bow = 0.0;
    const Bounds box = bounds(leaf_mesh(fern, 0));
    EXPECT_NEAR(static_cast<double>(box.max.z), fern.length * (1.0 + fern.petiole),
                0.01 * fern.length);
    const double widest = 2.0 * fern.length * fern.leaflets.length;
    EXPECT_LT(static_cast<double>(box.max.x - box.min.x), 1.05 * widest);
    EXPECT_GT(static_cast<double>(box.max.x - box.min.x), 0.6 * widest);
}

}  // namespace
}  // namespace sporeprint::plant_leaflets_test
