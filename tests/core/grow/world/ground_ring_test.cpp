#include "core/grow/world/ground_ring.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <span>
#include <vector>

#include "core/problems.h"

namespace sporeprint::grow_ground_ring_test {
namespace {

std::vector<double> slope(std::span<const double> x, std::span<const double> y) {
    std::vector<double> heights;
    for (const double north : y)
        for (const double east : x) heights.push_back(100.0 + 0.2 * east - 0.1 * north);
    return heights;
}

GroundRingParams params_with_hole() {
    GroundRingParams params;
    params.box = {-10.0, -10.0, 10.0, 10.0};
    params.hole = WorldBox{-3.0, -1.0, 1.0, 2.5};
    params.finest = 0.5;
    params.growth = 0.1;
    params.height = 100.0;
    return params;
}

/// Returns the area of all triangles as seen from above, those from below negative.
double area_from_above(const Mesh& mesh) {
    double sum = 0.0;
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
        const glm::dvec3 a(mesh.positions[mesh.indices[i]]), b(mesh.positions[mesh.indices[i + 1]]),
            c(mesh.positions[mesh.indices[i + 2]]);
        sum += 0.5 * glm::cross(b - a, c - a).y;
    }
    return sum;
}

TEST(GroundRing, CoversItsSquareButForTheHole) {
    GroundRingParams params = params_with_hole();
    EXPECT_NEAR(area_from_above(ground_ring(params, slope)), 400.0 - 4.0 * 3.5, 1e-3);
    params.hole.reset();
    EXPECT_NEAR(area_from_above(ground_ring(params, slope)), 400.0, 1e-3);
}

TEST(GroundRing, LiesOnTheGroundAndItsWallsBelowIt) {
    const GroundRingParams params = params_with_hole();
    const Mesh ring = ground_ring(params, slope);
    const glm::dvec3 up = glm::normalize(glm::dvec3(-0.2, 1.0, -0.1));
    for (std::size_t i = 0; i < ring.positions.size(); ++i) {
        const glm::vec3& at = ring.positions[i];
        // South is +z.
        const double below = 0.2 * static_cast<double>(at.x) + 0.1 * static_cast<double>(at.z) -
                             static_cast<double>(at.y);
        EXPECT_TRUE(std::abs(below) < 1e-4 || std::abs(below - params.skirt) < 1e-4) << below;
        EXPECT_NEAR(glm::distance(glm::dvec3(ring.normals[i]), up), 0.0, 1e-5);
    }
}

TEST(GroundRing, HasTheTextureOfItsWholeSquare) {
    GroundRingParams params = params_with_hole();
    params.texture_side = 64;
    const Mesh ring = ground_ring(params, slope);
    for (std::size_t i = 0; i < ring.positions.size(); ++i) {
        const double s = (static_cast<double>(ring.positions[i].x) + 10.0) / 20.0,
                     t = (static_cast<double>(ring.positions[i].z) + 10.0) / 20.0;
        EXPECT_NEAR(ring.texture_coordinates[i].x, (0.5 + 63.0 * s) / 64.0, 1e-5);
        EXPECT_NEAR(ring.texture_coordinates[i].y, (0.5 + 63.0 * t) / 64.0, 1e-5);
    }
}

TEST(GroundRing, VerticesAreNearestToEachOtherAtTheHole) {
    const GroundRingParams params = params_with_hole();
    const Mesh ring = ground_ring(params, slope);
    std::vector<float> columns;
    for (const glm::vec3& at : ring.positions) columns.push_back(at.x);
    std::sort(columns.begin(), columns.end());
    columns.erase(std::unique(columns.begin(), columns.end()), columns.end());
    for (std::size_t i = 1; i < columns.size(); ++i) {
        const float step = columns[i] - columns[i - 1];
        if (columns[i] <= 1.0F && columns[i - 1] >= -3.0F)
            EXPECT_LE(step, 0.501F);
        else
            EXPECT_LE(step, 0.5F + 0.11F * 10.0F + 0.3F);
    }
}

TEST(GroundRing, RefusesAHoleThatReachesBeyondIt) {
    GroundRingParams params = params_with_hole();
    params.hole->east = 10.5;
    EXPECT_THROW(static_cast<void>(ground_ring(params, slope)), InvalidInput);
}

}  // namespace
}  // namespace sporeprint::grow_ground_ring_test
