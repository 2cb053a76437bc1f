#include "core/grow/world/mesh_copies.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <glm/geometric.hpp>
#include <vector>

#include "core/math/elementary.h"
#include "tests/support/meshes.h"

namespace sporeprint::grow_mesh_copies_test {
namespace {

/// A triangle in the plane y = 0, which faces upwards.
Mesh triangle() {
    Mesh mesh;
    mesh.positions = {{0.0F, 0.0F, 0.0F}, {0.0F, 0.0F, 1.0F}, {1.0F, 0.0F, 0.0F}};
    mesh.normals.assign(3, {0.0F, 1.0F, 0.0F});
    mesh.indices = {0, 1, 2};
    return mesh;
}

TEST(MeshCopies, AreNoneWithoutPlaces) {
    EXPECT_TRUE((MeshCopies{triangle(), {}}.merged().positions.empty()));
}

TEST(MeshCopies, StandTurnedAndScaledAtTheirPlaces) {
    // A quarter turn about the vertical axis takes z to x.
    const SineCosine half = sine_cosine(0.25 * pi);
    GlbTransform moved;
    moved.translation = {5.0, 2.0, 0.0};
    moved.rotation = {0.0, half.sine, 0.0, half.cosine};
    moved.scale = glm::dvec3(3.0);
    const Mesh all = MeshCopies{triangle(), {GlbTransform{}, moved}}.merged();
    ASSERT_EQ(all.positions.size(), 6U);
    EXPECT_EQ(all.triangles(), 2U);
    EXPECT_LT(glm::distance(all.positions[1], glm::vec3(0.0F, 0.0F, 1.0F)), 1e-6F);
    EXPECT_LT(glm::distance(all.positions[4], glm::vec3(8.0F, 2.0F, 0.0F)), 1e-5F);
    for (const glm::vec3& normal : all.normals)
        EXPECT_LT(glm::distance(normal, glm::vec3(0.0F, 1.0F, 0.0F)), 1e-6F);
}

TEST(MeshCopies, HaveTheTintOfTheirPlaceTimesThatOfTheMesh) {
    GlbTransform dark;
    dark.tint = glm::vec3(0.5F);
    MeshCopies copies{triangle(), {dark}};
    EXPECT_EQ(copies.merged().tints, std::vector<glm::vec3>(3, glm::vec3(0.5F)));
    copies.one.tints.assign(3, {1.0F, 0.5F, 0.0F});
    EXPECT_EQ(copies.merged().tints, std::vector<glm::vec3>(3, glm::vec3(0.5F, 0.25F, 0.0F)));
}

}  // namespace
}  // namespace sporeprint::grow_mesh_copies_test
