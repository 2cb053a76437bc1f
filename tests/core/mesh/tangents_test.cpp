#include "core/mesh/tangents.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

namespace sporeprint::mesh_tangents_test {
namespace {

// Returns a square in the plane z = 0 that faces +z with an upright image: u to +x, v down.
Mesh upright_square() {
    Mesh mesh;
    mesh.positions = {{0, 0, 0}, {2, 0, 0}, {2, 3, 0}, {0, 3, 0}};
    mesh.normals.assign(4, {0, 0, 1});
    mesh.texture_coordinates = {{0, 1}, {1, 1}, {1, 0}, {0, 0}};
    mesh.indices = {0, 1, 2, 0, 2, 3};
    return mesh;
}

TEST(Tangents, PointAlongIncreasingU) {
    Mesh mesh = upright_square();
    add_tangents(mesh);
    for (const glm::vec4& tangent : mesh.tangents) EXPECT_EQ(tangent, glm::vec4(1, 0, 0, 1));
}

TEST(Tangents, HandleMirroredImages) {
    Mesh mesh = upright_square();
    for (glm::vec2& at : mesh.texture_coordinates) at.x = 1.0F - at.x;
    add_tangents(mesh);
    for (const glm::vec4& tangent : mesh.tangents) EXPECT_EQ(tangent, glm::vec4(-1, 0, 0, -1));
}

TEST(Tangents, ArePerpendicularToTheNormalAlsoWithoutAnImage) {
    Mesh mesh = upright_square();
    mesh.normals.assign(4, glm::normalize(glm::vec3(0.3F, 0.2F, 1.0F)));
    for (const bool blank : {false, true}) {
        if (blank) mesh.texture_coordinates.assign(4, {0.5F, 0.5F});
        add_tangents(mesh);
        for (std::size_t i = 0; i < 4; ++i) {
            const glm::vec3 tangent(mesh.tangents[i]);
            EXPECT_NEAR(glm::length(tangent), 1.0F, 1e-6F);
            EXPECT_NEAR(glm::dot(tangent, mesh.normals[i]), 0.0F, 1e-6F);
        }
    }
}

}  // namespace
}  // namespace sporeprint::mesh_tangents_test
