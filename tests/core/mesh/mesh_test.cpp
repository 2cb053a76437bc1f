// Tests of what is done with whole meshes; normals, tangents and measures have their own.
#include "core/mesh/mesh.h"

#include <gtest/gtest.h>

#include "core/mesh/measure.h"
#include "tests/support/meshes.h"
#include "tests/support/solids.h"

namespace sporeprint::mesh_test {
namespace {

TEST(Append, PartsKeepTheirVolumesAndAllThatTheirVerticesCarry) {
    Mesh part = ball(0.5F, {2.0F, 0.0F, 0.0F});
    part.tangents.assign(part.positions.size(), glm::vec4(1.0F, 0.0F, 0.0F, 1.0F));
    part.texture_coordinates.assign(part.positions.size(), glm::vec2(0.25F));
    part.sway.assign(part.positions.size(), Sway{.bend = 0.5F});
    Mesh whole;
    append(whole, part);
    EXPECT_TRUE(same_bits(whole, part));
    append(whole, part);
    EXPECT_EQ(whole.triangles(), 2 * part.triangles());
    EXPECT_NEAR(volume(whole), 2.0 * volume(part), 1e-6);
    EXPECT_EQ(whole.tangents.size(), whole.positions.size());
    EXPECT_EQ(whole.texture_coordinates.size(), whole.positions.size());
    ASSERT_EQ(whole.sway.size(), whole.positions.size());
    EXPECT_EQ(whole.sway.back(), part.sway.back());
}

TEST(Append, AnEmptyPartChangesNothing) {
    Mesh mesh = ball(1.0F, {});
    const Mesh before = mesh;
    append(mesh, Mesh{});
    EXPECT_TRUE(same_bits(mesh, before));
}

}  // namespace
}  // namespace sporeprint::mesh_test
