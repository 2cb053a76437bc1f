#include "core/geometry/joints.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <glm/geometric.hpp>
#include <vector>

#include "core/math/elementary.h"

namespace sporeprint {
namespace {

constexpr std::uint32_t sides = 24;
constexpr double radius = 0.01;

/// A straight tube along a unit direction, of `count` rings a tenth of a radius apart.
Tube straight_tube(Mesh& mesh, std::vector<double>& colours, const glm::dvec3& from,
                   const glm::dvec3& along, std::size_t count, double colour) {
    Tube tube;
    tube.rows.push_back(
        {static_cast<std::uint32_t>(mesh.positions.size()), sides, false, 0, count});
    const glm::dvec3 side(0.0, 0.0, 1.0), third = glm::cross(side, along);
    for (std::size_t i = 0; i < count; ++i) {
        Station station;
        station.at = from + 0.1 * radius * static_cast<double>(i) * along;
        station.along = along;
        station.radius = radius;
        station.colour = colour;
        tube.stations.push_back(station);
        for (std::uint32_t j = 0; j < sides; ++j) {
            const auto [s, c] = sine_cosine(2.0 * pi * j / sides);
            const glm::dvec3 out = c * side + s * third;
            mesh.positions.emplace_back(station.at + radius * out);
            mesh.normals.emplace_back(out);
            colours.push_back(colour);
        }
    }
    return tube;
}

/// An upright tube of colour 1 and one of colour 0 that leaves it at a right angle.
struct Crossing {
    Mesh mesh;
    std::vector<double> colours;
    std::vector<Tube> tubes;

    Crossing() {
        tubes.push_back(straight_tube(mesh, colours, {0.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, 101, 1.0));
        tubes.push_back(straight_tube(mesh, colours, {0.0, 0.05, 0.0}, {1.0, 0.0, 0.0}, 51, 0.0));
        tubes.back().parent = 0;
    }
};

/// Distance of a place from the surface of the other tube, metres.
double distance_from_other(const Crossing& crossing, std::size_t vertex) {
    const glm::dvec3 at(crossing.mesh.positions[vertex]);
    const bool upright = vertex < crossing.tubes[1].rows[0].first_vertex;
    if (!upright) return glm::length(glm::dvec2(at.x, at.z)) - radius;
    // The other tube begins on the axis of the upright one with a round end.
    const glm::dvec3 from = at - glm::dvec3(0.0, 0.05, 0.0);
    return glm::length(at.x >= 0.0 ? glm::dvec3(0.0, from.y, from.z) : from) - radius;
}

TEST(Joints, LeaveASingleTubeAsItIs) {
    Mesh mesh;
    std::vector<double> colours;
    const std::vector<Tube> tubes = {
        straight_tube(mesh, colours, {0.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, 11, 0.5)};
    const Mesh before = mesh;
    const std::vector<double> colours_before = colours;
    blend_joints(mesh, colours, tubes);
    EXPECT_EQ(mesh.normals, before.normals);
    EXPECT_EQ(colours, colours_before);
}

TEST(Joints, GiveBothSurfacesOneNormalAndOneColourWhereTheyCross) {
    Crossing crossing;
    const Crossing before = crossing;
    blend_joints(crossing.mesh, crossing.colours, crossing.tubes);
    int found = 0;
    for (std::size_t i = 0; i < crossing.mesh.positions.size(); ++i) {
        if (std::abs(distance_from_other(before, i)) > 0.02 * radius) continue;
        // Nearer to its beginning the other tube is not seen, and looks like the upright one.
        const glm::dvec3 at(before.mesh.positions[i]);
        if (at.x < 0.9 * radius) continue;
        // The mean of the normals of the cylinders at a place of both.
        const glm::dvec3 upright = glm::normalize(glm::dvec3(at.x, 0.0, at.z));
        const glm::dvec3 level = glm::normalize(glm::dvec3(0.0, at.y - 0.05, at.z));
        if (glm::length(upright + level) < 0.2) continue;
        const glm::dvec3 mean = glm::normalize(upright + level);
        EXPECT_GT(glm::dot(glm::dvec3(crossing.mesh.normals[i]), mean), 0.99);
        EXPECT_NEAR(crossing.colours[i], 0.5, 0.02);
        ++found;
    }
    EXPECT_GT(found, 3);
}

TEST(Joints, FilletBothSurfacesOutwardsAndChangeNothingFarAway) {
    Crossing crossing;
    const Crossing before = crossing;
    blend_joints(crossing.mesh, crossing.colours, crossing.tubes);
    int far = 0;
    double most = 0.0;
    for (std::size_t i = 0; i < crossing.mesh.positions.size(); ++i) {
        EXPECT_NEAR(glm::length(glm::dvec3(crossing.mesh.normals[i])), 1.0, 1e-6);
        const glm::dvec3 moved =
            glm::dvec3(crossing.mesh.positions[i]) - glm::dvec3(before.mesh.positions[i]);
        const double raised = glm::dot(moved, glm::dvec3(before.mesh.normals[i]));
        // Near its beginning the other tube is moved into the upright one.
        const bool begins =
            i >= before.tubes[1].rows[0].first_vertex && before.mesh.positions[i].x < 2.0 * radius;
        if (!begins) {
            EXPECT_NEAR(glm::length(moved), raised, 1e-4 * radius);
        }
        EXPECT_LE(raised, 0.4 * radius);
        most = std::max(most, raised);
        if (distance_from_other(before, i) < 2.3 * radius) continue;
        EXPECT_EQ(crossing.mesh.positions[i], before.mesh.positions[i]);
        EXPECT_EQ(crossing.mesh.normals[i], before.mesh.normals[i]);
        EXPECT_EQ(crossing.colours[i], before.colours[i]);
        ++far;
    }
    EXPECT_GT(far, 500);
    EXPECT_GT(most, 0.2 * radius);
}

TEST(Joints, ATubeBeginsInsideItsParentAndComesOutOfItWithoutAStep) {
    Crossing crossing;
    blend_joints(crossing.mesh, crossing.colours, crossing.tubes);
    const TubeRows& rows = crossing.tubes[1].rows[0];
    const auto out = [&](std::size_t row, std::uint32_t column) {
        const glm::vec3& at = crossing.mesh.positions[rows.first_vertex + row * sides + column];
        return std::hypot(static_cast<double>(at.x), static_cast<double>(at.z)) - radius;
    };
    for (std::uint32_t column = 0; column < sides; ++column) {
        EXPECT_LT(out(0, column), -0.1 * radius);
        for (std::size_t row = 1; row < rows.count; ++row)
            EXPECT_LT(out(row, column) - out(row - 1, column), 0.3 * radius) << row;
    }
}

}  // namespace
}  // namespace sporeprint
