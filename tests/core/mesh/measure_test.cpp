#include "core/mesh/measure.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <limits>
#include <string>

#include "tests/support/meshes.h"

namespace sporeprint::mesh_measure_test {
namespace {

/// Returns a cube of the given side, each face with vertices of its own: closed once welded.
Mesh cube(float side, const glm::vec3& at = glm::vec3(0.0f)) {
    Mesh mesh;
    for (int axis = 0; axis < 3; ++axis)
        for (const float sign : {-1.0f, 1.0f}) {
            glm::vec3 normal(0.0f), u(0.0f), v(0.0f);
            normal[axis] = sign;
            u[(axis + 1) % 3] = sign;
            v[(axis + 2) % 3] = 1.0f;
            const auto first = static_cast<std::uint32_t>(mesh.positions.size());
            for (const auto& [a, b] : {std::pair{-1.0f, -1.0f}, std::pair{1.0f, -1.0f},
                                       std::pair{1.0f, 1.0f}, std::pair{-1.0f, 1.0f}}) {
                mesh.positions.push_back(at + 0.5f * side * (normal + a * u + b * v));
                mesh.normals.push_back(normal);
                mesh.tangents.emplace_back(u, 1.0f);
                mesh.texture_coordinates.emplace_back(0.5f + 0.5f * a, 0.5f + 0.5f * b);
            }
            for (const std::uint32_t i : {0u, 1u, 2u, 0u, 2u, 3u})
                mesh.indices.push_back(first + i);
        }
    return mesh;
}

TEST(Measure, MomentsOfACubeAndOfNothing) {
    const SurfaceMoments of = surface_moments(cube(2.0f, {5.0f, -3.0f, 1.0f}));
    EXPECT_NEAR(of.area, 24.0, 1e-6);
    EXPECT_NEAR(glm::distance(of.middle, glm::dvec3(5.0, -3.0, 1.0)), 0.0, 1e-6);
    // Two faces at a distance of 1, four over which coordinates are uniform in -1..1.
    for (int i = 0; i < 3; ++i)
        for (int k = 0; k < 3; ++k)
            EXPECT_NEAR(of.covariance[i][k], i == k ? (2.0 * 1.0 + 4.0 / 3.0) / 6.0 : 0.0, 1e-6);
    EXPECT_EQ(surface_moments({}).area, 0.0);
    EXPECT_EQ(surface_moments({}).covariance, glm::dmat3(0.0));
}

TEST(Measure, ACubeHasTheVolumeAndAreaOfACube) {
    const Mesh mesh = cube(2.0f, {5.0f, -3.0f, 1.0f});
    EXPECT_DOUBLE_EQ(volume(mesh), 8.0);
    EXPECT_DOUBLE_EQ(area(mesh), 24.0);
    EXPECT_EQ(bounds(mesh).min, glm::vec3(4.0f, -4.0f, 0.0f));
    EXPECT_EQ(bounds(mesh).max, glm::vec3(6.0f, -2.0f, 2.0f));
    expect_valid(mesh);
}

TEST(Measure, AnInvertedMeshHasNegativeVolume) {
    Mesh mesh = cube(1.0f);
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3)
        std::swap(mesh.indices[i], mesh.indices[i + 1]);
    EXPECT_DOUBLE_EQ(volume(mesh), -1.0);
}

TEST(Measure, DisjointMeshesAreTwoPieces) {
    Mesh mesh = cube(1.0f);
    append(mesh, cube(3.0f, {9.0f, 0.0f, 0.0f}));
    const auto found = pieces(mesh);
    ASSERT_EQ(found.size(), 2u);
    EXPECT_DOUBLE_EQ(volume(found[0]), 1.0);
    EXPECT_DOUBLE_EQ(volume(found[1]), 27.0);
}

/// Returns the defects of a cube after a change.
std::string defects_after(const std::function<void(Mesh&)>& change) {
    Mesh mesh = cube(1.0f);
    change(mesh);
    std::string text;
    for (const std::string& defect : defects(mesh)) text += defect + "; ";
    return text;
}

TEST(Measure, EveryDefectIsReported) {
    constexpr float nan = std::numeric_limits<float>::quiet_NaN();
    const auto expect = [](const std::string& words, const std::function<void(Mesh&)>& change) {
        const std::string text = defects_after(change);
        EXPECT_NE(text.find(words), std::string::npos) << words << " is not in: " << text;
    };
    EXPECT_EQ(defects_after([](Mesh&) {}), "");
    expect("empty", [](Mesh& m) { m = {}; });
    expect("normals and positions differ", [](Mesh& m) { m.normals.pop_back(); });
    expect("tangents and positions differ", [](Mesh& m) { m.tangents.pop_back(); });
    expect("coordinates and positions differ", [](Mesh& m) { m.texture_coordinates.pop_back(); });
    expect("no multiple of three", [](Mesh& m) { m.indices.pop_back(); });
    expect("position is not finite at vertex 3", [](Mesh& m) { m.positions[3].y = nan; });
    expect("normal is not unit at vertex 5", [](Mesh& m) { m.normals[5] *= 1.1f; });
    expect("normal is not unit", [](Mesh& m) { m.normals[5].x = nan; });
    expect("tangent is not unit", [](Mesh& m) { m.tangents[5] *= 0.9f; });
    expect("not square", [](Mesh& m) { m.tangents[5] = glm::vec4(m.normals[5], 1.0f); });
    expect("handedness", [](Mesh& m) { m.tangents[5].w = 0.0f; });
    expect("outside 0..1", [](Mesh& m) { m.texture_coordinates[5].x = 1.01f; });
    expect("outside 0..1", [](Mesh& m) { m.texture_coordinates[5].y = nan; });
    expect("out of range in triangle 4", [](Mesh& m) { m.indices[14] = 24; });
    expect("repeated index in triangle 0", [](Mesh& m) { m.indices[1] = m.indices[0]; });
    expect("open edge", [](Mesh& m) { m.indices.resize(m.indices.size() - 3); });
    expect("open edge", [](Mesh& m) { m.positions[0].x += 1e-3f; });
    expect("open edge", [](Mesh& m) { std::swap(m.indices[0], m.indices[1]); });
}

TEST(Measure, TheListOfDefectsIsBounded) {
    Mesh mesh = cube(1.0f);
    for (auto& normal : mesh.normals) normal *= 2.0f;
    EXPECT_LE(defects(mesh).size(), 20u);
}

}  // namespace
}  // namespace sporeprint::mesh_measure_test
