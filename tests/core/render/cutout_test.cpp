#include "core/render/cutout.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>

#include "core/surface/codecs.h"

namespace sporeprint::render::cutout_test {
namespace {

constexpr int side = 64;

/// A triangle with corners at (0, 0), (1, 0) and (0, 1) of an image, and its material.
class CutoutTest : public ::testing::Test {
  protected:
    CutoutTest() {
        mesh_.positions = {{0.0F, 0.0F, 0.0F}, {1.0F, 0.0F, 0.0F}, {0.0F, 1.0F, 0.0F}};
        mesh_.texture_coordinates = {{0.0F, 0.0F}, {1.0F, 0.0F}, {0.0F, 1.0F}};
        mesh_.indices = {0, 1, 2};
        draw_.mesh = &mesh_;
    }

    /// Gives it alpha: 255 in the columns that are opaque, 0 in others.
    void set_alpha(const std::function<bool(int column)>& is_opaque) {
        Bytes rgba(std::size_t{4} * side * side, 200);
        for (std::size_t i = 0; i < std::size_t{side} * side; ++i)
            rgba[4 * i + 3] = is_opaque(static_cast<int>(i % side)) ? 255 : 0;
        material_.alpha = Texture(png(rgba, side, side), Encoding::alpha, false);
        material_.alpha_cutoff = 0.5F;
    }

    [[nodiscard]] Cutout cutout(const std::array<glm::vec3, 3>& corners,
                                const SampleRays& rays) const {
        return Cutout(*draw_.mesh, material_, 0, corners, rays);
    }

    /// The same, seen in parallel, with so many samples for the image.
    [[nodiscard]] Cutout in_parallel(float samples) const {
        return cutout({glm::vec3(0, 0, 1), glm::vec3(samples, 0, 1), glm::vec3(0, samples, 1)},
                      {glm::vec2(0.5F), glm::vec2(1.0F)});
    }

    DrawMaterial material_;

  private:
    Mesh mesh_;
    Draw draw_;
};

bool is_left(int column) { return column < side / 2; }

TEST_F(CutoutTest, IsNoneWithoutAlpha) {
    EXPECT_TRUE(in_parallel(9.0F).shows(3, 3));
    EXPECT_TRUE(Cutout().shows(3, 3));
}

TEST_F(CutoutTest, LeavesOutWhatIsClearSeenInParallel) {
    set_alpha(is_left);
    // Sample x is at u = (x + 1/2) / 100.
    const Cutout cutout = in_parallel(100.0F);
    for (int x = 0; x < 100; ++x) {
        if (std::abs(x - 50) <= 2) continue;
        for (const int y : {0, 20}) EXPECT_EQ(cutout.shows(x, y), x < 50) << x << ' ' << y;
    }
}

TEST_F(CutoutTest, LeavesOutWhatIsClearInPerspective) {
    set_alpha(is_left);
    // The triangle leans away from the camera: u = 1/2 is at x = 1/2 and a depth of 3/2, so at a
    // third of the image and not at a half of the 1/2 at which u = 1 is seen.
    const Cutout seen = cutout({glm::vec3(0, 0, 1), glm::vec3(1, 0, 2), glm::vec3(0, 1, 1)},
                               {glm::vec2(0.0F), glm::vec2(0.001F)});
    EXPECT_TRUE(seen.shows(320, 1));
    EXPECT_FALSE(seen.shows(346, 1));
}

TEST_F(CutoutTest, TakesSmallerCopiesFromAfar) {
    // Stripes of one texel, half of them clear: from afar each place has an alpha of a half.
    set_alpha([](int column) { return column % 2 == 1; });
    for (const float cutoff : {0.45F, 0.55F}) {
        material_.alpha_cutoff = cutoff;
        const Cutout cutout = in_parallel(32.0F);
        for (int x = 2; x < 20; ++x) EXPECT_EQ(cutout.shows(x, 4), cutoff < 0.5F) << x;
    }
}

}  // namespace
}  // namespace sporeprint::render::cutout_test
