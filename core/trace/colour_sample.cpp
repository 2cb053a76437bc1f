#include "core/trace/colour_sample.h"

#include <algorithm>
#include <array>
#include <cstddef>

#include "core/trace/lab.h"

namespace sporeprint::trace {

namespace {

/// Fewer pixels do not tell a colour.
constexpr std::size_t least_pixels = 24;

/// A place has a given hue or one so near to it, in steps, if enough of it has.
constexpr int near_hue = 3;
constexpr double least_of_hue = 0.2;

std::vector<Pixel> within(const std::vector<Pixel>& pixels, const Hue& hue, int steps) {
    std::vector<Pixel> found;
    found.reserve(pixels.size());
    for (const Pixel& pixel : pixels)
        if (are_near(hue_of(pixel), hue, steps)) found.push_back(pixel);
    return found;
}

/// Shares of the channels of ITU-R BT.709 in ten thousandths; pixels of one luma are in order of their channels, so
/// that the same set is chosen everywhere.
std::array<int, 4> luma(const Pixel& pixel) {
    return {2126 * pixel[0] + 7152 * pixel[1] + 722 * pixel[2], pixel[0], pixel[1], pixel[2]};
}

bool is_darker(const Pixel& a, const Pixel& b) { return luma(a) < luma(b); }

}  // namespace

std::optional<glm::dvec3> ColourSample::colour(const Hue& near) const {
    if (pixels_.size() < least_pixels) return std::nullopt;
    std::vector<Pixel> alike = within(pixels_, near, near_hue);
    if (static_cast<double>(alike.size()) < least_of_hue * static_cast<double>(pixels_.size()))
        alike = pixels_;
    alike = within(alike, trace::commonest_hue(alike), 1);
    const std::size_t darker = alike.size() * 2 / 5;
    const auto from = alike.begin() + static_cast<std::ptrdiff_t>(darker);
    std::nth_element(alike.begin(), from, alike.end(), is_darker);
    const auto middle = from + (alike.end() - from) / 2;
    glm::dvec3 median(0.0);
    for (int c = 0; c < 3; ++c) {
        const auto channel = static_cast<std::size_t>(c);
        std::nth_element(from, middle, alike.end(), [channel](const Pixel& a, const Pixel& b) {
            return a[channel] < b[channel];
        });
        median[c] = (*middle)[channel];
    }
    return lab_of(median);
}

}  // namespace sporeprint::trace
