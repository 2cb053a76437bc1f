#include "core/plant/bark_image.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <vector>

#include "core/plant/tree.h"
#include "tests/support/atlas.h"
#include "tests/support/refusals.h"

namespace sporeprint::plant_bark_image_test {
namespace {

constexpr std::size_t side = 64;

double difference(const RawImages& images, std::size_t x, std::size_t other) {
    double sum = 0.0;
    for (std::size_t y = 0; y < side; ++y)
        for (std::size_t k = 0; k < 3; ++k)
            sum += std::abs(static_cast<double>(images.rgb[0][3 * (y * side + x) + k]) -
                            static_cast<double>(images.rgb[0][3 * (y * side + other) + k]));
    return sum / (3.0 * side);
}

TEST(BarkImage, WrapsWithoutASeam) {
    BarkStyle style;
    style.ridges = 4;  // so that neighbouring texels are similar
    const RawImages images = bark_images(style, 3, side);
    double inside = 0.0;
    for (std::size_t x = 1; x < side; ++x) inside = std::max(inside, difference(images, x - 1, x));
    EXPECT_LE(difference(images, side - 1, 0), 1.2 * inside);
    EXPECT_GT(difference(images, 0, side / 2), 0.5 * inside);
}

TEST(BarkImage, NormalsAreUnitVectorsAndFlatWhereBarkIsSmooth) {
    BarkStyle style;
    const auto mean_lean = [&] {
        const RawImages images = bark_images(style, 3, side);
        double sum = 0.0;
        for (std::size_t i = 0; i < images.rgb[1].size(); i += 3) {
            const glm::dvec3 normal =
                2.0 * glm::dvec3(images.rgb[1][i], images.rgb[1][i + 1], images.rgb[1][i + 2]) /
                    255.0 -
                1.0;
            EXPECT_NEAR(glm::length(normal), 1.0, 0.02);
            sum += 1.0 - normal.z;
        }
        return sum;
    };
    const double furrowed = mean_lean();
    style.furrows = 0.0;
    EXPECT_LT(mean_lean(), 0.5 * furrowed);
}

TEST(BarkImage, HasNoPatternThatComesAgain) {
    // The greatest correlation of the brightness of bark with itself, shifted by more than one of
    // its features. Rows wrap, columns do not.
    for (const TreePreset& preset : tree_presets()) {
        constexpr int size = 128, least = size / 6;
        const RawImages images = bark_images(preset.bark, 1, size);
        std::vector<double> bright(static_cast<std::size_t>(size) * size);
        double mean = 0.0, square = 0.0;
        for (std::size_t i = 0; i < bright.size(); ++i) {
            for (std::size_t k = 0; k < 3; ++k) bright[i] += images.rgb[0][3 * i + k];
            mean += bright[i] / static_cast<double>(bright.size());
        }
        for (double& value : bright) {
            value -= mean;
            square += value * value / static_cast<double>(bright.size());
        }
        double most = 0.0;
        for (int down = 0; down <= size / 2; ++down)
            for (int aside = 0; aside < size; ++aside) {
                if (down < least && std::min(aside, size - aside) < least) continue;
                double sum = 0.0;
                for (int y = 0; y + down < size; ++y)
                    for (int x = 0; x < size; ++x)
                        sum += bright[static_cast<std::size_t>(y * size + x)] *
                               bright[static_cast<std::size_t>((y + down) * size +
                                                               (x + aside) % size)];
                most = std::max(most, sum / (static_cast<double>(size - down) * size * square));
            }
        EXPECT_LT(most, 0.3) << preset.id.view();
    }
}

TEST(BarkImage, OfPresetsDifferAndRepeat) {
    for (const TreePreset& preset : tree_presets())
        EXPECT_EQ(bark_images(preset.bark, 1, 32).rgb, bark_images(preset.bark, 1, 32).rgb);
    EXPECT_NE(bark_images(tree_preset("birch")->bark, 1, 32).rgb,
              bark_images(tree_preset("broadleaf")->bark, 1, 32).rgb);
    EXPECT_TRUE(names(refusal([] { (void)bark_images({}, 1, 48); }), "/side", "48"));
}

}  // namespace
}  // namespace sporeprint::plant_bark_image_test
