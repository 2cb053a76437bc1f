#include "core/plant/spots.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "core/mesh/measure.h"
#include "tests/support/atlas.h"
#include "tests/support/refusals.h"

namespace sporeprint::plant_spots_test {
namespace {

class Spots : public ::testing::Test {
  protected:
    Spots() {
        const TreePreset& preset = *tree_preset("shrub");
        leaves = placed_leaves(grown_tree(preset.shape, 1), preset.leaves, 1);
        for (const PlacedLeaf& leaf : leaves) whole += leaf_area * leaf.size * leaf.size;
    }
    static constexpr double leaf_area = 0.002, middle = 0.05;
    std::vector<PlacedLeaf> leaves;
    double whole = 0.0;
};

TEST_F(Spots, KeepAreaTimesNumber) {
    for (const std::size_t count : {1U, 17U, 200U, 100'000U}) {
        const std::vector<Spot> spots = spots_of(leaves, leaf_area, middle, count);
        EXPECT_EQ(spots.size(), std::min<std::size_t>(count, leaves.size()));
        double sum = 0.0;
        for (const Spot& spot : spots) sum += spot.area;
        EXPECT_NEAR(sum / whole, 1.0, 1e-9);
    }
    EXPECT_TRUE(spots_of({}, leaf_area, middle, 10).empty());
}

TEST_F(Spots, OfFewerAreTheFirstOfMore) {
    const std::vector<Spot> many = spots_of(leaves, leaf_area, middle, 300);
    const std::vector<Spot> few = spots_of(leaves, leaf_area, middle, 40);
    for (std::size_t i = 0; i < few.size(); ++i) {
        EXPECT_EQ(few[i].id, many[i].id);
        EXPECT_EQ(few[i].place, many[i].place);
        EXPECT_GT(few[i].area, many[i].area);
    }
}

TEST_F(Spots, ArePolygonsOfTheirAreaOnBothSides) {
    const std::vector<Spot> spots = spots_of(leaves, leaf_area, middle, 100);
    for (const int corners : {3, 4}) {
        const Mesh mesh = polygonal_spots(spots, corners, 1);
        EXPECT_TRUE(defects(mesh).empty());
        EXPECT_EQ(mesh.triangles(), spots.size() * (corners == 3 ? 2U : 4U));
        EXPECT_NEAR(area(mesh) / (2.0 * whole), 1.0, 1e-4);
        // The orientation of each triangle agrees with the normals of its corners.
        for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
            const glm::vec3 a = mesh.positions[mesh.indices[i]];
            const glm::vec3 across = glm::cross(mesh.positions[mesh.indices[i + 1]] - a,
                                                mesh.positions[mesh.indices[i + 2]] - a);
            EXPECT_GT(glm::dot(across, mesh.normals[mesh.indices[i]]), 0.0F);
        }
    }
    EXPECT_TRUE(names(refusal([&] { (void)polygonal_spots(spots, 5, 1); }), "/corners", "5"));
}

TEST_F(Spots, ArePointsOfTheirArea) {
    const std::vector<Spot> spots = spots_of(leaves, leaf_area, middle, 100);
    const PointCloud cloud = point_cloud(spots);
    ASSERT_EQ(cloud.positions.size(), 100U);
    double sum = 0.0;
    for (const float half : cloud.half_sides) sum += 4.0 * half * half;
    EXPECT_NEAR(sum / whole, 1.0, 1e-5);
}

}  // namespace
}  // namespace sporeprint::plant_spots_test
