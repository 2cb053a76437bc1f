#include "core/trace/hue.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>

namespace sporeprint::trace {

namespace {

constexpr int hue_steps = 32;

/// Pixels darker than this share of the light ones do not count.
constexpr double least_light = 0.3;

/// Numbers of pixels by hue, with a border of empty ones.
class Counts {
  public:
    /// Returns the number of a hue, whose shares are from -1 to hue_steps.
    [[nodiscard]] int& operator()(int red, int green) { return counts_[index(red, green)]; }
    [[nodiscard]] int operator()(int red, int green) const { return counts_[index(red, green)]; }

  private:
    static constexpr int side = hue_steps + 2;
    static constexpr std::size_t index(int red, int green) {
        return static_cast<std::size_t>((red + 1) * side + green + 1);
    }
    std::array<int, std::size_t{side * side}> counts_{};
};

/// Calls a function with each hue that pixels have, and their number.
template <class Use>
void each_hue(const Counts& counts, Use use) {
    for (int red = 0; red < hue_steps; ++red)
        for (int green = 0; green < hue_steps; ++green)
            if (const int count = counts(red, green); count > 0) use(Hue{red, green}, count);
}

/// Returns the middle of the three by three hues that together most pixels have; of equal sums the one with most in
/// its middle.
Hue densest(const Counts& counts) {
    Hue best{};
    std::array<int, 2> most{};
    for (int red = 0; red < hue_steps; ++red)
        for (int green = 0; green < hue_steps; ++green) {
            int sum = 0;
            for (int i = red - 1; i <= red + 1; ++i)
                for (int j = green - 1; j <= green + 1; ++j) sum += counts(i, j);
            const std::array<int, 2> here = {sum, counts(red, green)};
            if (here <= most) continue;
            most = here;
            best = {red, green};
        }
    return best;
}

/// Two groups of hues are different colours if their means are farther apart, in steps.
constexpr double least_apart = 5.0;

/// Leaves the larger one of two groups of hues, if they are different colours: large spots that are all alike may have
/// the commonest hue of a cap whose own hue changes in the light.
void leave_larger_group(Counts& counts, const Hue& first) {
    struct Group {
        double red, green;
        std::int64_t pixels;
        [[nodiscard]] double square(const Hue& hue) const {
            const double x = hue[0] - red, y = hue[1] - green;
            return x * x + y * y;
        }
    };
    // Lloyd's algorithm: from the commonest hue and from that which has most pixels far from it.
    Group one{static_cast<double>(first[0]), static_cast<double>(first[1]), 0}, other = one;
    double farthest = 0.0;
    each_hue(counts, [&](const Hue& hue, int count) {
        const double weight = count * one.square(hue);
        if (weight <= farthest) return;
        farthest = weight;
        other = {static_cast<double>(hue[0]), static_cast<double>(hue[1]), 0};
    });
    if (farthest == 0.0) return;
    const auto is_of_one = [&](const Hue& hue) { return one.square(hue) <= other.square(hue); };
    for (int round = 0; round < 16; ++round) {
        std::array<Group, 2> sums{};
        each_hue(counts, [&](const Hue& hue, int count) {
            Group& sum = sums[is_of_one(hue) ? 0 : 1];
            sum.red += static_cast<double>(hue[0]) * count;
            sum.green += static_cast<double>(hue[1]) * count;
            sum.pixels += count;
        });
        for (Group& sum : sums) {
            if (sum.pixels == 0) return;
            sum.red /= static_cast<double>(sum.pixels);
            sum.green /= static_cast<double>(sum.pixels);
        }
        one = sums[0];
        other = sums[1];
    }
    const double x = one.red - other.red, y = one.green - other.green;
    if (x * x + y * y < least_apart * least_apart) return;
    const bool leaves_one = one.pixels >= other.pixels;
    for (int red = 0; red < hue_steps; ++red)
        for (int green = 0; green < hue_steps; ++green)
            if (is_of_one({red, green}) != leaves_one) counts(red, green) = 0;
}

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
    Counts counts;
    for (const Pixel& pixel : pixels) {
        if (value(pixel) < least) continue;
        const Hue hue = hue_of(pixel);
        ++counts(hue[0], hue[1]);
    }
    leave_larger_group(counts, densest(counts));
    return densest(counts);
}

}  // namespace sporeprint::trace
