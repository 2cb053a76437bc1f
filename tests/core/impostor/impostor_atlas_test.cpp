#include "core/impostor/impostor_atlas.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <thread>
#include <vector>

#include "core/problems.h"
#include "tests/support/solids.h"

namespace sporeprint::impostor_impostor_atlas_test {
namespace {

constexpr int side = 64;
constexpr float radius = 0.3F;
const glm::vec3 middle(0.2F, 0.7F, -0.1F);

/// Two balls, of which no view from opposite sides is its own mirror image.
struct Pair {
    Mesh large = ball(0.3F, {0.0F, 0.3F, 0.0F}), small = ball(0.1F, {0.4F, 0.8F, 0.3F});
    GlbScene scene = scene_of(large);

    Pair() {
        scene.meshes.push_back({"small", {{&small, 0, {}}}});
        scene.nodes.push_back({.name = "small", .mesh = 1});
    }
};

std::size_t texel(const ImpostorAtlas& atlas, FrameCell cell, int x, int y) {
    return static_cast<std::size_t>((cell.row * atlas.frame_side + y) * atlas.side() +
                                    cell.column * atlas.frame_side + x);
}

template <class Visit>
void each_texel(Visit visit) {
    for (int row = 0; row < frame_grid; ++row)
        for (int column = 0; column < frame_grid; ++column)
            for (int y = 0; y < side; ++y)
                for (int x = 0; x < side; ++x) visit(FrameCell{column, row}, x, y);
}

/// Returns the place of the middle of a texel from that of its frame, in radii of the ball.
glm::vec2 from_middle(const ImpostorAtlas& atlas, int x, int y) {
    const float step = 2.0F * atlas.radius / side / radius;
    return {(static_cast<float>(x) + 0.5F - side / 2) * step,
            (side / 2 - static_cast<float>(y) - 0.5F) * step};
}

TEST(ImpostorAtlas, ABallCoversTheAreaOfADiscInEveryFrame) {
    const Mesh mesh = ball(radius, middle, 128, 64);
    const ImpostorAtlas atlas = impostor_atlas(scene_of(mesh), side);
    EXPECT_EQ(atlas.side(), 512) << "the power of two beyond seven frames";
    EXPECT_LT(glm::distance(atlas.centre, middle), 1e-6F);
    EXPECT_GT(atlas.radius, radius) << "a margin";
    const float step = 2.0F * atlas.radius / side;
    std::array<double, frame_count> areas{};
    each_texel([&](FrameCell cell, int x, int y) {
        areas[static_cast<std::size_t>(cell.row * frame_grid + cell.column)] +=
            atlas.base_color[4 * texel(atlas, cell, x, y) + 3] / 255.0 * step * step;
    });
    const double disc = 3.14159265 * radius * radius;
    for (const double area : areas) EXPECT_NEAR(area / disc, 1.0, 0.01);
}

TEST(ImpostorAtlas, NormalsAndDepthAreThoseOfABall) {
    const Mesh mesh = ball(radius, middle, 128, 64);
    const ImpostorAtlas atlas = impostor_atlas(scene_of(mesh), side);
    each_texel([&](FrameCell cell, int x, int y) {
        const std::size_t at = texel(atlas, cell, x, y);
        const glm::vec2 p = from_middle(atlas, x, y);
        const float squared = glm::dot(p, p);
        if (squared > 0.8F) return;
        const glm::vec3 expected(p, std::sqrt(1.0F - squared));
        glm::vec3 normal(atlas.normal[3 * at], atlas.normal[3 * at + 1], atlas.normal[3 * at + 2]);
        normal = normal / 127.5F - glm::vec3(1.0F);
        ASSERT_NEAR(glm::length(normal), 1.0F, 0.01F);
        ASSERT_LT(glm::distance(normal, expected), 0.05F);
        const float depth =
            (2.0F * static_cast<float>(atlas.orm[3 * at]) / 255.0F - 1.0F) * atlas.radius;
        ASSERT_NEAR(depth, expected.z * radius, 0.02F * radius);
    });
}

TEST(ImpostorAtlas, NormalLengthOfASmoothShapeIsOne) {
    EXPECT_NEAR(impostor_atlas(scene_of(ball(radius, middle, 128, 64)), side).normal_length, 1.0F,
                0.02F);
}

TEST(ImpostorAtlas, NormalLengthOfBallsSmallerThanATexelIsTwoThirds) {
    // The mean of the normals of a ball over the disc that it covers is 2/3 towards the viewer.
    Mesh balls;
    for (int x = 0; x < 12; ++x)
        for (int y = 0; y < 12; ++y)
            for (int z = 0; z < 12; ++z) {
                const glm::vec3 at(x, y, z);
                append(balls,
                       ball(0.03F,
                            (at + 0.3F * glm::sin(at * 7.0F + glm::vec3(at.y, at.z, at.x))) / 6.0F,
                            10, 6));
            }
    EXPECT_NEAR(impostor_atlas(scene_of(balls), side).normal_length, 2.0F / 3.0F, 0.1F);
}

TEST(ImpostorAtlas, OneColourIsThatOfAllTexels) {
    const Mesh mesh = ball(radius, middle);
    const ImpostorAtlas atlas = impostor_atlas(scene_of(mesh), side);
    for (std::size_t i = 0; i < atlas.base_color.size(); i += 4) {
        ASSERT_EQ(atlas.base_color[i], atlas.base_color[0]) << "no fringe beside an outline";
        ASSERT_EQ(atlas.base_color[i], 231) << "0.8 of the light";
    }
}

TEST(ImpostorAtlas, ViewsFromOppositeSidesHaveMirroredOutlines) {
    const Pair pair;
    const ImpostorAtlas atlas = impostor_atlas(pair.scene, side);
    constexpr int last = frame_grid - 1;
    for (int i = 0; i <= last; ++i) {
        const FrameCell near{i, 0}, far{last - i, last};
        ASSERT_LT(glm::length(axes_of(near).toward + axes_of(far).toward), 1e-6F);
        int different = 0, mirrored = 0;
        for (int y = 0; y < side; ++y)
            for (int x = 0; x < side; ++x) {
                const auto shows = [&](FrameCell cell, int column) {
                    return atlas.base_color[4 * texel(atlas, cell, column, y) + 3] > 127;
                };
                different += shows(near, x) != shows(far, side - 1 - x) ? 1 : 0;
                mirrored += shows(near, x) != shows(far, x) ? 1 : 0;
            }
        EXPECT_LT(different, 12) << i;
        EXPECT_GT(mirrored, 10 * different) << i;
    }
}

TEST(ImpostorAtlas, WhatIsNearerHidesWhatIsBehind) {
    const Mesh far = ball(0.2F, {0.0F, 0.5F, -0.5F}), near = ball(0.1F, {0.0F, 0.5F, 0.5F});
    GlbScene scene = scene_of(far);
    scene.meshes.push_back({"near", {{&near, 0, {}}}});
    scene.nodes.push_back({.name = "near", .mesh = 1});
    const ImpostorAtlas atlas = impostor_atlas(scene, side);
    const auto depth = [&](FrameCell cell) {
        const float byte = atlas.orm[3 * texel(atlas, cell, side / 2, side / 2)];
        return (2.0F * byte / 255.0F - 1.0F) * atlas.radius;
    };
    // The box reaches from z = -0.7 to z = 0.6.
    EXPECT_NEAR(depth({0, 6}), 0.6F + 0.05F, 0.02F) << "from +Z the near one";
    EXPECT_NEAR(depth({6, 0}), 0.7F - 0.05F, 0.02F) << "from -Z the far one";
}

TEST(ImpostorAtlas, ContentIsWhatAFrameShows) {
    const Pair pair;
    const ImpostorAtlas atlas = impostor_atlas(pair.scene, side);
    for (int row = 0; row < frame_grid; ++row)
        for (int column = 0; column < frame_grid; ++column) {
            const FrameCell cell{column, row};
            FrameContent found{side, side, 0, 0};
            for (int y = 0; y < side; ++y)
                for (int x = 0; x < side; ++x)
                    if (atlas.base_color[4 * texel(atlas, cell, x, y) + 3] > 0)
                        found = {std::min(found.left, x), std::min(found.top, y),
                                 std::max(found.right, x + 1), std::max(found.bottom, y + 1)};
            const FrameContent& stated = atlas.content_of(cell);
            EXPECT_EQ(stated.left, found.left);
            EXPECT_EQ(stated.top, found.top);
            EXPECT_EQ(stated.right, found.right);
            EXPECT_EQ(stated.bottom, found.bottom);
            EXPECT_GE(found.left, 1) << "the border of a frame is empty";
            EXPECT_LE(found.bottom, side - 1);
        }
}

TEST(ImpostorAtlas, ThreadsDoNotChangeIt) {
    const Pair pair;
    const Parallel threads = [](std::span<const std::function<void()>> tasks) {
        std::vector<std::thread> running;
        for (std::size_t i = 0; i < 4; ++i)
            running.emplace_back([=] {
                for (std::size_t k = i; k < tasks.size(); k += 4) tasks[k]();
            });
        for (std::thread& one : running) one.join();
    };
    const ImpostorAtlas one = impostor_atlas(pair.scene, 32),
                        other = impostor_atlas(pair.scene, 32, threads);
    EXPECT_EQ(one.base_color, other.base_color);
    EXPECT_EQ(one.normal, other.normal);
    EXPECT_EQ(one.orm, other.orm);
}

TEST(ImpostorAtlas, OtherSidesAndEmptyScenesAreRefused) {
    const Mesh mesh = ball(radius, middle);
    for (const int wrong : {0, 24, 65, 520})
        EXPECT_THROW((void)impostor_atlas(scene_of(mesh), wrong), GenerationError) << wrong;
    EXPECT_THROW((void)impostor_atlas(GlbScene{}, side), GenerationError);
}

/// Returns an image in which `shows` says what has full alpha.
template <class Shows>
Bytes image_of(int width, Shows shows) {
    Bytes rgba;
    for (int y = 0; y < width; ++y)
        for (int x = 0; x < width; ++x) {
            rgba.insert(rgba.end(), 3, 99);
            rgba.push_back(shows(x, y) ? 255 : 0);
        }
    return rgba;
}

TEST(CutoffOfAlpha, OfASolidShapeIsAboutAHalf) {
    const Bytes disc = image_of(256, [](int x, int y) {
        return (x - 130) * (x - 130) + (y - 121) * (y - 121) < 100 * 100;
    });
    EXPECT_GE(cutoff_of(disc, 256), 0.45);
    EXPECT_EQ(cutoff_of(image_of(64, [](int, int) { return false; }), 64), 0.5);
}

TEST(CutoffOfAlpha, OfPorousShapesIsLessSoThatTheyDoNotVanish) {
    std::uint32_t state = 1;
    const Bytes leaves = image_of(256, [&](int, int) {
        state = state * 1664525U + 1013904223U;
        return state >> 24 < 77;  // three of ten
    });
    EXPECT_LT(cutoff_of(leaves, 256), 0.4);
}

TEST(ImpostorAtlas, IsEncodedWithAlphaInEitherFormat) {
    const Mesh mesh = ball(radius, middle);
    const ImpostorAtlas atlas = impostor_atlas(scene_of(mesh), 32);
    const ImageSet webp = encoded(atlas, ImageFormat::webp), jpg = encoded(atlas, ImageFormat::jpg);
    EXPECT_EQ(webp.format_of(ImageKind::base_color), ImageFormat::webp);
    EXPECT_EQ(jpg.format_of(ImageKind::base_color), ImageFormat::png);
    EXPECT_EQ(jpg.format_of(ImageKind::normal), ImageFormat::jpg);
    EXPECT_EQ(jpg.files[0].data()[1], 'P');
    EXPECT_EQ(jpg.files[1].data()[0], 0xFF);
    EXPECT_EQ(webp.files[0].data()[0], 'R');
}

}  // namespace
}  // namespace sporeprint::impostor_impostor_atlas_test
