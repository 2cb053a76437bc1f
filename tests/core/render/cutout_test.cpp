#include "core/render/cutout.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <vector>

#include "core/surface/codecs.h"

namespace sporeprint::render::cutout_test {
namespace {

constexpr int side = 64;

/// A material of which the right half, u > 1/2, is clear.
DrawMaterial half_clear() {
    Bytes rgba(std::size_t{4} * side * side, 200);
    for (std::size_t i = 0; i < std::size_t{side} * side; ++i)
        rgba[4 * i + 3] = i % side < side / 2 ? 255 : 0;
    DrawMaterial material;
    const Bytes file = png(rgba, side, side);
    material.alpha = Texture(file, Encoding::alpha, false);
    material.alpha_cutoff = 0.5F;
    return material;
}

/// A triangle that shows u and v as the place in it: corners at (0, 0), (1, 0), (0, 1).
Mesh right_triangle() {
    Mesh mesh;
    mesh.positions = {{0.0F, 0.0F, 0.0F}, {1.0F, 0.0F, 0.0F}, {0.0F, 1.0F, 0.0F}};
    mesh.texture_coordinates = {{0.0F, 0.0F}, {1.0F, 0.0F}, {0.0F, 1.0F}};
    mesh.indices = {0, 1, 2};
    return mesh;
}

TEST(Cutout, IsNoneWithoutAlpha) {
    const Mesh mesh = right_triangle();
    Draw draw;
    draw.mesh = &mesh;
    const Cutout opaque(draw, DrawMaterial(), 0,
                        {glm::vec3(0, 0, 1), glm::vec3(9, 0, 1), glm::vec3(0, 9, 1)}, {});
    EXPECT_TRUE(opaque.shows(3, 3));
    EXPECT_TRUE(Cutout().shows(3, 3));
}

TEST(Cutout, LeavesOutWhatIsClearSeenInParallel) {
    const Mesh mesh = right_triangle();
    const DrawMaterial material = half_clear();
    Draw draw;
    draw.mesh = &mesh;
    // A hundred samples for the unit: sample x is at u = (x + 1/2) / 100.
    const Cutout cutout(draw, material, 0,
                        {glm::vec3(0, 0, 1), glm::vec3(100, 0, 1), glm::vec3(0, 100, 1)},
                        {glm::vec2(0.5F), glm::vec2(1.0F)});
    for (int x = 0; x < 100; ++x) {
        if (std::abs(x - 50) <= 2) continue;
        for (const int y : {0, 20}) EXPECT_EQ(cutout.shows(x, y), x < 50) << x << ' ' << y;
    }
}

TEST(Cutout, LeavesOutWhatIsClearInPerspective) {
    // The triangle leans away from the camera: u = 1/2 is at x = 1/2 and a depth of 3/2, so at a
    // third of the image and not at a half of the 1/2 at which u = 1 is seen.
    const Mesh mesh = right_triangle();
    const DrawMaterial material = half_clear();
    Draw draw;
    draw.mesh = &mesh;
    const Cutout cutout(draw, material, 0,
                        {glm::vec3(0, 0, 1), glm::vec3(1, 0, 2), glm::vec3(0, 1, 1)},
                        {glm::vec2(0.0F), glm::vec2(0.001F)});
    EXPECT_TRUE(cutout.shows(320, 1));
    EXPECT_FALSE(cutout.shows(346, 1));
}

TEST(Cutout, TakesSmallerCopiesFromAfar) {
    // Stripes of one texel, half of them clear: from afar each place has an alpha of a half.
    Bytes rgba(std::size_t{4} * side * side, 200);
    for (std::size_t i = 0; i < std::size_t{side} * side; ++i) rgba[4 * i + 3] = i % 2 ? 255 : 0;
    const Bytes file = png(rgba, side, side);
    DrawMaterial material;
    material.alpha = Texture(file, Encoding::alpha, false);
    const Mesh mesh = right_triangle();
    Draw draw;
    draw.mesh = &mesh;
    for (const float cutoff : {0.45F, 0.55F}) {
        material.alpha_cutoff = cutoff;
        const Cutout cutout(draw, material, 0,
                            {glm::vec3(0, 0, 1), glm::vec3(32, 0, 1), glm::vec3(0, 32, 1)},
                            {glm::vec2(0.5F), glm::vec2(1.0F)});
        for (int x = 2; x < 20; ++x) EXPECT_EQ(cutout.shows(x, 4), cutoff < 0.5F) << x;
    }
}

}  // namespace
}  // namespace sporeprint::render::cutout_test
