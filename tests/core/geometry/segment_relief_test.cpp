#include "core/geometry/segment_relief.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <glm/geometric.hpp>
#include <vector>

#include "core/math/elementary.h"

namespace sporeprint::geometry_segment_relief_test {
namespace {

constexpr std::uint32_t sides = 24;
constexpr double radius = 0.01;

/// An upright tube of 41 rings, a fifth of a radius apart, from a place on.
struct Segment {
    Mesh mesh;
    std::vector<Tube> tubes;

    void add(const glm::dvec3& from) {
        Tube tube;
        tube.rows.push_back(
            {static_cast<std::uint32_t>(mesh.positions.size()), sides, false, 0, 41});
        for (std::size_t i = 0; i < 41; ++i) {
            Station station;
            station.at = from + glm::dvec3(0.0, 0.2 * radius * static_cast<double>(i), 0.0);
            station.radius = radius;
            tube.stations.push_back(station);
            for (std::uint32_t j = 0; j < sides; ++j) {
                const auto [s, c] = sine_cosine(2.0 * pi * j / sides);
                mesh.positions.emplace_back(station.at + radius * glm::dvec3(c, 0.0, s));
                mesh.normals.emplace_back(c, 0.0, s);
            }
        }
        tubes.push_back(tube);
    }
};

TEST(SegmentRelief, IsNothingWithoutGnarl) {
    Segment segment;
    segment.add({0.0, 0.0, 0.0});
    const Mesh before = segment.mesh;
    add_segment_relief(segment.mesh, segment.tubes, 0.0, radius, 1);
    EXPECT_EQ(segment.mesh.positions, before.positions);
    EXPECT_EQ(segment.mesh.normals, before.normals);
}

TEST(SegmentRelief, RaisesAndSinksTheSkinAndTurnsItsNormals) {
    Segment segment;
    segment.add({0.003, 0.0, 0.007});
    const Mesh before = segment.mesh;
    add_segment_relief(segment.mesh, segment.tubes, 0.5, radius, 1);
    double least = 0.0, most = 0.0, turned = 1.0;
    for (std::size_t i = 0; i < before.positions.size(); ++i) {
        const glm::dvec3 normal(before.normals[i]);
        const glm::dvec3 moved =
            glm::dvec3(segment.mesh.positions[i]) - glm::dvec3(before.positions[i]);
        const double raised = glm::dot(moved, normal);
        EXPECT_NEAR(glm::length(moved), std::abs(raised), 1e-4 * radius);
        EXPECT_NEAR(glm::length(glm::dvec3(segment.mesh.normals[i])), 1.0, 1e-5);
        least = std::min(least, raised);
        most = std::max(most, raised);
        turned = std::min(turned, glm::dot(glm::dvec3(segment.mesh.normals[i]), normal));
    }
    EXPECT_GT(most, 0.05 * radius);
    EXPECT_LT(most, 0.5 * radius);
    EXPECT_LT(least, -0.05 * radius);
    EXPECT_GT(least, -0.5 * radius);
    EXPECT_LT(turned, 0.98);
    EXPECT_GT(turned, 0.3);
}

TEST(SegmentRelief, IsTheSameOnTubesThatCoincide) {
    Segment segment;
    segment.add({0.0, 0.0, 0.0});
    segment.add({0.0, 0.0, 0.0});
    add_segment_relief(segment.mesh, segment.tubes, 1.0, radius, 7);
    const std::size_t half = segment.mesh.positions.size() / 2;
    for (std::size_t i = 0; i < half; ++i) {
        EXPECT_EQ(segment.mesh.positions[i], segment.mesh.positions[half + i]);
        EXPECT_EQ(segment.mesh.normals[i], segment.mesh.normals[half + i]);
    }
}

}  // namespace
}  // namespace sporeprint::geometry_segment_relief_test
