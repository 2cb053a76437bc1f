#include "core/mesh/refinement.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "core/math/elementary.h"
#include "core/mesh/measure.h"
#include "tests/support/meshes.h"
#include "tests/support/solids.h"

namespace sporeprint::mesh_refinement_test {
namespace {

/// Returns a closed ball with texture coordinates, whose vertices at the poles and at the seam are at
/// exactly the same places.
Mesh textured_ball(std::uint32_t round, std::uint32_t rows) {
    Mesh mesh = ball(1.0F, {0.0F, 0.0F, 0.0F}, round, rows);
    for (std::size_t i = 0; i < mesh.positions.size(); ++i)
        for (int k = 0; k < 3; ++k) {
            float& place = mesh.positions[i][k];
            place = std::round(place * 65536.0F) / 65536.0F;
        }
    for (std::size_t i = 0; i < mesh.positions.size(); ++i)
        mesh.normals[i] = glm::normalize(mesh.positions[i]);
    mesh.texture_coordinates.resize(mesh.positions.size());
    for (std::size_t i = 0; i < mesh.positions.size(); ++i)
        mesh.texture_coordinates[i] = 0.5F + 0.5F * glm::vec2(mesh.positions[i]);
    mesh.tangents.clear();
    return mesh;
}

TEST(Refinement, OfAWholeBallMakesItRounderAndStaysClosed) {
    Mesh mesh = textured_ball(8, 4);
    const double whole = 4.0 / 3.0 * pi, before = volume(mesh);
    const std::size_t triangles = mesh.triangles(), vertices = mesh.positions.size();
    const auto parents = refine(mesh, [](std::uint32_t) { return true; });
    EXPECT_EQ(mesh.triangles(), 4 * triangles);
    ASSERT_EQ(mesh.positions.size(), vertices + parents.size());
    EXPECT_LT(std::abs(whole - volume(mesh)), 0.45 * std::abs(whole - before));
    for (std::size_t i = vertices; i < mesh.positions.size(); ++i) {
        EXPECT_NEAR(static_cast<double>(glm::length(mesh.normals[i])), 1.0, 1e-5);
        const auto [a, b] = parents[i - vertices];
        const float side = glm::distance(mesh.positions[a], mesh.positions[b]);
        EXPECT_LE(glm::distance(mesh.positions[i], 0.5F * (mesh.positions[a] + mesh.positions[b])),
                  0.5F * side);
    }
    expect_valid(mesh);
}

TEST(Refinement, OfAPartLeavesTheRestAndNoGap) {
    Mesh mesh = textured_ball(16, 8);
    const Mesh was = mesh;
    refine(mesh, [&](std::uint32_t i) { return was.positions[i].y < -0.1F; });
    EXPECT_GT(mesh.triangles(), was.triangles());
    EXPECT_LT(mesh.triangles(), 4 * was.triangles());
    for (std::size_t i = 0; i < was.positions.size(); ++i)
        EXPECT_EQ(mesh.positions[i], was.positions[i]);
    for (std::size_t i = was.positions.size(); i < mesh.positions.size(); ++i)
        EXPECT_LT(mesh.positions[i].y, 0.0F);
    EXPECT_GT(volume(mesh), volume(was));
    expect_valid(mesh);
}

TEST(Refinement, OfNothingChangesNothing) {
    Mesh mesh = textured_ball(8, 4);
    const Mesh was = mesh;
    EXPECT_TRUE(refine(mesh, [](std::uint32_t) { return false; }).empty());
    EXPECT_TRUE(same_bits(mesh, was));
}

}  // namespace
}  // namespace sporeprint::mesh_refinement_test
