#include "core/trace/soil.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <optional>

#include "core/trace/colour_sample.h"
#include "core/trace/lab.h"

namespace sporeprint::trace {

namespace {

/// The plate is in the lowest part, of the height.
constexpr double lowest_part = 0.25;

/// It is wider than the stem above it.
constexpr double wider = 1.2;

/// Its colour differs from that of the stem, in L*a*b*.
constexpr double other_colour = 18.0;

/// Slices across the axis in which widths are measured.
constexpr std::size_t slices = 128;

/// Its edge lies within so many slices.
constexpr std::size_t edge = 5;

/// Columns across the stem in which the soil before it is measured.
constexpr std::size_t columns = 15;

/// A mask in slices across its axis, the lowest first.
struct Slices {
    glm::dvec2 up{0.0}, right{0.0};
    double lowest = 1e300, highest = -1e300;
    std::array<double, slices> left{}, width{};

    Slices(const Mask& mask, const Stroke& axis) {
        const glm::dvec2 way = axis.back() - axis.front();
        up = glm::length(way) > 0.0 ? way / glm::length(way) : glm::dvec2(0.0, -1.0);
        right = {-up.y, up.x};
        each_pixel(mask, [this](int, int, const glm::dvec2& at) {
            lowest = std::min(lowest, glm::dot(at, up));
            highest = std::max(highest, glm::dot(at, up));
        });
        left.fill(1e300);
        std::array<double, slices> end{};
        end.fill(-1e300);
        each_pixel(mask, [&](int, int, const glm::dvec2& at) {
            const std::size_t i = of(at);
            left[i] = std::min(left[i], glm::dot(at, right));
            end[i] = std::max(end[i], glm::dot(at, right));
        });
        for (std::size_t i = 0; i < slices; ++i) width[i] = std::max(end[i] - left[i], 0.0);
    }

    /// Returns the height of a place as a share of the whole.
    [[nodiscard]] double height(const glm::dvec2& at) const {
        return (glm::dot(at, up) - lowest) / std::max(highest - lowest, 1.0);
    }
    [[nodiscard]] std::size_t of(const glm::dvec2& at) const {
        return std::min(static_cast<std::size_t>(height(at) * slices), slices - 1);
    }
};

std::optional<glm::dvec3> colour_of(const ColourSample& sample) {
    return sample.colour(sample.commonest_hue());
}

}  // namespace

Mask without_soil(const Picture& picture, const Mask& mask, const Stroke& axis) {
    const Slices sliced(mask, axis);
    // Above the plate the mask becomes narrower at once.
    constexpr auto low = static_cast<std::size_t>(lowest_part * slices);
    std::size_t top = 0;
    double drop = wider;
    for (std::size_t i = 0; i < low; ++i)
        if (const double times = sliced.width[i] / std::max(sliced.width[i + edge], 1.0);
            times > drop) {
            drop = times;
            top = i + edge;
        }
    if (top == 0) return mask;
    const double stem_width = sliced.width[top], middle = sliced.left[top] + 0.5 * stem_width;
    ColourSample wings, stem;
    each_pixel(mask, [&](int x, int y, const glm::dvec2& at) {
        const std::size_t slice = sliced.of(at);
        const double beside = std::abs(glm::dot(at, sliced.right) - middle) / stem_width;
        const std::uint8_t* rgb = &picture.rgb[3 * mask.index(x, y)];
        if (slice < top && beside > 0.6) wings.add(rgb);
        if (slice >= top && slice < top + slices / 6 && beside < 0.45) stem.add(rgb);
    });
    const std::optional<glm::dvec3> soil = colour_of(wings), skin = colour_of(stem);
    if (!soil || !skin || glm::length(*soil - *skin) < other_colour) return mask;
    const auto is_like_soil = [&](int x, int y) {
        const std::uint8_t* rgb = &picture.rgb[3 * mask.index(x, y)];
        const glm::dvec3 lab = lab_of(glm::dvec3(rgb[0], rgb[1], rgb[2]));
        return glm::length(lab - *soil) < glm::length(lab - *skin);
    };
    // Before the foot the soil reaches so high as it does in the middle of the columns: stems are stained.
    std::array<std::size_t, columns> soiled{}, all{};
    const auto column_of = [&](const glm::dvec2& at) {
        const double share = (glm::dot(at, sliced.right) - middle) / stem_width + 0.5;
        return share < 0.0 ? columns : static_cast<std::size_t>(share * columns);
    };
    each_pixel(mask, [&](int x, int y, const glm::dvec2& at) {
        const std::size_t column = column_of(at);
        if (sliced.of(at) >= top || column >= columns) return;
        ++all[column];
        if (is_like_soil(x, y)) ++soiled[column];
    });
    std::array<double, columns> shares{};
    for (std::size_t i = 0; i < columns; ++i)
        shares[i] =
            static_cast<double>(soiled[i]) / static_cast<double>(std::max<std::size_t>(all[i], 1));
    std::nth_element(shares.begin(), shares.begin() + columns / 2, shares.end());
    const double front =
        shares[columns / 2] * static_cast<double>(top) / static_cast<double>(slices);
    Mask rest = mask;
    each_pixel(mask, [&](int x, int y, const glm::dvec2& at) {
        if (sliced.of(at) >= top) return;
        if (column_of(at) < columns ? sliced.height(at) < front : is_like_soil(x, y))
            rest.inside[rest.index(x, y)] = 0;
    });
    // Grains and needles of another colour lie in the soil.
    const Mask whole = opened(rest, std::clamp(static_cast<int>(0.1 * stem_width), 1, 6));
    each_pixel(mask, [&](int x, int y, const glm::dvec2& at) {
        if (sliced.of(at) < top) rest.inside[rest.index(x, y)] = whole.inside[whole.index(x, y)];
    });
    return without_holes(largest_part(rest));
}

}  // namespace sporeprint::trace
