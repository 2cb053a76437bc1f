#include "core/trace/hue.h"

#include <algorithm>
#include <cstddef>
#include <cstdlib>

namespace sporeprint::trace {

namespace {

constexpr int hue_steps = 32;

/// Pixels darker than this share of the light ones do not count.
constexpr double least_light = 0.3;

}  // namespace

Hue hue_of(const Pixel& pixel) {
    // Black has no hue; a little of each channel makes it grey.
    const int sum = pixel[0] + pixel[1] + pixel[2] + 3;
    return {(pixel[0] + 1) * (hue_steps - 1) / sum, (pixel[1] + 1) * (hue_steps - 1) / sum};
}

bool are_near(const Hue& a, const Hue& b, int steps) {
    return std::abs(a[0] - b[0]) <= steps && std::abs(a[1] - b[1]) <= steps;
}

Hue commonest_hue(std::vector<Pixel> pixels) {
    if (pixels.empty()) return {hue_steps / 3, hue_steps / 3};
    const auto light = pixels.begin() + static_cast<std::ptrdiff_t>(pixels.size() * 9 / 10);
    const auto value = [](const Pixel& pixel) {
        return *std::max_element(pixel.begin(), pixel.end());
    };
    std::nth_element(pixels.begin(), light, pixels.end(),
                     [&](const Pixel& a, const Pixel& b) { return value(a) < value(b); });
    // By the greatest channel: pure red is no shade of white.
    const double least = least_light * value(*light);
    std::array<std::array<int, hue_steps + 2>, hue_steps + 2> counts{};
    for (const Pixel& pixel : pixels) {
        if (value(pixel) < least) continue;
        const Hue hue = hue_of(pixel);
        ++counts[static_cast<std::size_t>(hue[0] + 1)][static_cast<std::size_t>(hue[1] + 1)];
    }
    // The middle of the three by three hues that together most pixels have.
    Hue best{};
    // Of equal sums the one with most in its middle.
    std::array<int, 2> most{};
    for (int red = 0; red < hue_steps; ++red)
        for (int green = 0; green < hue_steps; ++green) {
            int sum = 0;
            for (int i = red; i <= red + 2; ++i)
                for (int j = green; j <= green + 2; ++j)
                    sum += counts[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)];
            const std::array<int, 2> here = {
                sum,
                counts[static_cast<std::size_t>(red + 1)][static_cast<std::size_t>(green + 1)]};
            if (here <= most) continue;
            most = here;
            best = {red, green};
        }
    return best;
}

}  // namespace sporeprint::trace
