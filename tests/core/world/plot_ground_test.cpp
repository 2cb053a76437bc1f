#include "core/world/plot_ground.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "tests/support/meshes.h"
#include "tests/support/slopes.h"

namespace sporeprint::world_plot_ground_test {
namespace {

TEST(FloorHeights, WithoutReliefAndTreesAreThoseOfTheGround) {
    const Ground ground = sloping_ground(0.1, -0.05);
    const FloorHeights floor(ground, 1, 0.0, {});
    EXPECT_NEAR(floor.at(12.0, -7.0), 1.2 + 0.35, 0.002);
}

TEST(FloorHeights, RiseRoundTrunks) {
    const Ground ground = sloping_ground(0.0, 0.0);
    const TreeFoot foot{1.0, 2.0, 0.4};
    const FloorHeights floor(ground, 1, 0.0, std::span(&foot, 1));
    EXPECT_NEAR(floor.at(1.0, 2.0), 0.25 * 0.4 * (1.0 - std::exp(-5.0)), 1e-12);
    EXPECT_NEAR(floor.at(1.6, 2.0), 0.25 * 0.4 * (std::exp(-1.0) - std::exp(-5.0)), 1e-12);
    // It ends level, 7.5 diameters away.
    EXPECT_NEAR(floor.at(3.999, 2.0), 0.0, 1e-5);
    EXPECT_EQ(floor.at(4.001, 2.0), 0.0);
}

TEST(FloorHeights, HaveWavesOfTheirAmplitude) {
    const Ground ground = sloping_ground(0.0, 0.0);
    std::vector<double> places;
    for (int i = 0; i < 200; ++i) places.push_back(0.37 * i - 37.0);
    const auto deviation = [&](double micro) {
        const std::vector<double> heights = FloorHeights(ground, 5, micro, {}).at(places, places);
        double sum = 0.0, squares = 0.0;
        for (const double height : heights) {
            sum += height;
            squares += height * height;
        }
        const auto count = static_cast<double>(heights.size());
        EXPECT_NEAR(sum / count, 0.0, 0.2 * micro);
        return std::sqrt(squares / count);
    };
    EXPECT_NEAR(deviation(0.06), 0.57 * 0.06, 0.012);
    EXPECT_NEAR(deviation(0.12), 2.0 * deviation(0.06), 1e-9);
}

TEST(FloorHeights, OfAGridAreThoseOfItsPlaces) {
    const Ground ground = sloping_ground(0.03, 0.02);
    const std::vector<TreeFoot> feet{
        {-6.9, 0.4, 0.5}, {0.2, -2.1, 0.7}, {19.0, 4.9, 0.4}, {2.6, 1.0, 0.3}};
    const FloorHeights floor(ground, 9, 0.06, feet);
    const std::vector<double> x{-10.0, -3.0, 0.0, 0.25, 5.0, 20.0, 23.9},
        y{9.7, 5.0, 1.0, 0.0, -2.0};
    const std::vector<double> heights = floor.at(x, y);
    for (std::size_t row = 0; row < y.size(); ++row)
        for (std::size_t column = 0; column < x.size(); ++column)
            EXPECT_EQ(heights[row * x.size() + column], floor.at(x[column], y[row]));
}

TEST(Slab, IsClosedAndEnclosesItsVolume) {
    const Ground ground = sloping_ground(0.0, 0.0);
    const FloorHeights floor(ground, 1, 0.0, {});
    const SlabParams params{{-5.0, -5.0, 5.0, 5.0}, 33, 256, 0.0, 0.5};
    const Mesh slab = slab_mesh(params, floor);
    expect_valid(slab);
    EXPECT_NEAR(volume(slab), 10.0 * 10.0 * 0.5, 1e-3);
    EXPECT_EQ(slab.tints.size(), slab.positions.size());
}

TEST(Slab, WithReliefIsValid) {
    const Ground ground = sloping_ground(0.4, -0.3);
    const TreeFoot foot{0.5, 0.5, 0.6};
    const FloorHeights floor(ground, 3, 0.3, std::span(&foot, 1));
    const SlabParams params{{-1.0, -1.0, 1.0, 1.0}, 65, 512, 0.0, 0.4};
    expect_valid(slab_mesh(params, floor));
}

TEST(Slab, HasSoilBeforeItsWalls) {
    const Ground ground = sloping_ground(0.4, -0.3);
    const FloorHeights floor(ground, 3, 0.3, {});
    const SlabParams params{{-4.0, -4.0, 4.0, 4.0}, 33, 512, 0.0, 0.4};
    const Mesh slab = slab_mesh(params, floor), soil = soil_round(slab, params);
    expect_valid(soil);
    // As thin as it is, all of it is before the walls, as high as these.
    const Bounds box = bounds(slab), own = bounds(soil);
    EXPECT_EQ(own.min.y, box.min.y);
    EXPECT_GT(own.max.x, box.max.x);
    EXPECT_LT(own.max.x, box.max.x + 0.01F);
    for (std::size_t i = 0; i < soil.positions.size(); ++i) {
        EXPECT_GE(std::max(std::abs(soil.positions[i].x), std::abs(soil.positions[i].z)), 4.0F);
        EXPECT_GT(soil.tints[i].r, soil.tints[i].b) << "Soil is brown.";
        EXPECT_LT(soil.tints[i].r, 0.3F);
    }
    EXPECT_EQ(soil.tints.size(), soil.positions.size());
}

TEST(Slab, ThatIsSeenFromAboveIsClosedByFewerVertices) {
    const Ground ground = sloping_ground(0.4, -0.3);
    const FloorHeights floor(ground, 3, 0.3, {});
    SlabParams params{{-4.0, -4.0, 4.0, 4.0}, 33, 512, 0.0, 0.4};
    params.step = 1.0 / 256.0;
    const Mesh whole = slab_mesh(params, floor);
    params.is_seen_from_above = true;
    const Mesh tile = slab_mesh(params, floor);
    expect_valid(tile);
    EXPECT_EQ(tile.positions.size(), 33U * 33U + 4U * 33U * 2U + 1U);
    EXPECT_NEAR(volume(tile), volume(whole), 1e-3);
    for (std::size_t i = 0; i < 33 * 33; ++i) EXPECT_EQ(tile.positions[i], whole.positions[i]);
}

TEST(Slab, OfANeighbourHasTheSameBorder) {
    const Ground ground = sloping_ground(0.07, 0.11);
    const TreeFoot foot{4.7, 1.0, 0.5};
    const FloorHeights floor(ground, 3, 0.06, std::span(&foot, 1));
    const double low = slab_height(0.3), high = slab_height(1.9);
    constexpr std::size_t nodes = 129;
    const Mesh west = slab_mesh({{-5.0, -5.0, 5.0, 5.0}, nodes, 1024, low, 0.4}, floor),
               east = slab_mesh({{5.0, -5.0, 15.0, 5.0}, nodes, 1024, high, 0.4}, floor);
    for (std::size_t row = 0; row < nodes; ++row) {
        const std::size_t of_west = row * nodes + nodes - 1, of_east = row * nodes;
        EXPECT_EQ(static_cast<double>(west.positions[of_west].y) + low,
                  static_cast<double>(east.positions[of_east].y) + high);
        EXPECT_EQ(west.positions[of_west].z, east.positions[of_east].z);
        EXPECT_EQ(west.positions[of_west].x - 5.0F, east.positions[of_east].x + 5.0F);
        EXPECT_EQ(west.normals[of_west], east.normals[of_east]);
    }
}

}  // namespace
}  // namespace sporeprint::world_plot_ground_test
