#include "core/impostor/cards.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "tests/support/solids.h"

namespace sporeprint::impostor_cards_test {
namespace {

/// A ball on a stem, as a mushroom.
struct Toadstool {
    Mesh cap = ball(0.3F, {0.05F, 0.8F, 0.0F}), foot = ball(0.1F, {0.0F, 0.1F, 0.0F});
    GlbScene scene = scene_of(cap);
    ImpostorAtlas atlas;

    Toadstool() {
        scene.meshes.push_back({"foot", {{&foot, 0, {}}}});
        scene.nodes.push_back({.name = "foot", .mesh = 1});
        atlas = impostor_atlas(scene, 64);
    }
};

TEST(Cards, HaveTheStatedCounts) {
    const Mesh mesh = impostor_cards(Toadstool().atlas);
    EXPECT_EQ(mesh.positions.size(), card_vertices);
    EXPECT_EQ(mesh.triangles(), card_triangles);
    EXPECT_GE(card_triangles, 8u);
    EXPECT_LE(card_triangles, 12u);
    for (const std::uint32_t index : mesh.indices) EXPECT_LT(index, card_vertices);
}

TEST(Cards, ShowEachPointWhereItsFrameShowsIt) {
    const Toadstool one;
    const Mesh mesh = impostor_cards(one.atlas);
    for (std::size_t card = 0; card < mesh.positions.size() / 4; ++card) {
        const FrameCell cell = card < upright_cards.size()
                                   ? upright_cards[card]
                                   : FrameCell{frame_grid / 2, frame_grid / 2};
        const FrameAxes axes = axes_of(cell);
        for (std::size_t i = 4 * card; i < 4 * card + 4; ++i) {
            const glm::vec3 seen = axes.seen(mesh.positions[i] - one.atlas.centre);
            const glm::vec2 in_frame(0.5F + 0.5F * seen.x / one.atlas.radius,
                                     0.5F - 0.5F * seen.y / one.atlas.radius);
            const glm::vec2 expected =
                (glm::vec2(cell.column, cell.row) + in_frame) * (64.0F / 512.0F);
            EXPECT_LT(glm::distance(mesh.texture_coordinates[i], expected), 1e-5F);
            EXPECT_EQ(mesh.normals[i], axes.toward);
            EXPECT_EQ(glm::vec3(mesh.tangents[i]), axes.right);
            EXPECT_EQ(mesh.tangents[i].w, 1.0F);
            for (const float part : {in_frame.x, in_frame.y}) {
                EXPECT_GE(part, -1e-5F) << "within its frame";
                EXPECT_LE(part, 1.0F + 1e-5F);
            }
        }
    }
}

TEST(Cards, FaceTheSideFromWhichTheirFrameIsSeen) {
    const Mesh mesh = impostor_cards(Toadstool().atlas);
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
        const auto at = [&](std::size_t k) { return mesh.positions[mesh.indices[i + k]]; };
        const glm::vec3 facing = glm::cross(at(1) - at(0), at(2) - at(0));
        EXPECT_GT(glm::dot(glm::normalize(facing), mesh.normals[mesh.indices[i]]), 0.999F);
    }
}

TEST(Cards, ReachTheGroundAndLieWhereTheWholeIsWidest) {
    const Toadstool one;
    const Mesh mesh = impostor_cards(one.atlas);
    const float texel = 2.0F * one.atlas.radius / 64.0F;
    for (std::size_t i = 0; i < 4 * upright_cards.size(); i += 4)
        EXPECT_NEAR(mesh.positions[i].y, 0.0F, 2.1F * texel);
    for (std::size_t i = 4 * upright_cards.size(); i < mesh.positions.size(); ++i)
        EXPECT_NEAR(mesh.positions[i].y, 0.8F, 2.0F * texel);
}

TEST(Cards, MeetInTheAxisOnWhichTheProductStands) {
    const Mesh mesh = impostor_cards(Toadstool().atlas);
    for (std::size_t i = 0; i < 4 * upright_cards.size(); ++i)
        EXPECT_NEAR(glm::dot(mesh.positions[i], mesh.normals[i]), 0.0F, 1e-6F);
}

TEST(Cards, StandAboutEquallyFarApart) {
    for (std::size_t i = 0; i < upright_cards.size(); ++i) {
        const glm::vec3 one = axes_of(upright_cards[i]).toward,
                        next = axes_of(upright_cards[(i + 1) % upright_cards.size()]).toward;
        const double degrees = std::acos(glm::dot(one, next)) * 180.0 / 3.14159265;
        EXPECT_GT(degrees, 50.0);
        EXPECT_LT(degrees, 80.0);
        EXPECT_GT(glm::cross(one, next).y, 0.0F) << "one after the other";
    }
}

TEST(Cards, HaveTheErrorOfTheMeanCosine) {
    double sum = 0.0;
    constexpr int steps = 1000;
    for (int i = 0; i < steps; ++i) sum += 1.0 - std::cos(3.14159265 / 5.0 * (i + 0.5) / steps);
    EXPECT_NEAR(card_error(), sum / steps, 1e-6);
}

}  // namespace
}  // namespace sporeprint::impostor_cards_test
