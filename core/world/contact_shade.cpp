#include "core/world/contact_shade.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <vector>

namespace sporeprint {

namespace {

/// Part of the light of the sky, and of the colour, that is lost at a trunk.
constexpr float of_light = 0.6F, of_colour = 0.15F;

/// The texels of a range of metres, within an image.
struct TexelRange {
    std::size_t first = 0, last = 0;
};

TexelRange range_of(double from, double to, double texel, std::size_t side) {
    const double end = static_cast<double>(side) - 1.0;
    const double first = std::clamp(std::floor(from / texel), 0.0, end),
                 last = std::clamp(std::ceil(to / texel) + 1.0, 0.0, end + 1.0);
    return {static_cast<std::size_t>(first), static_cast<std::size_t>(std::max(first, last))};
}

}  // namespace

void add_contact_shade(RawImages& images, const WorldBox& box, std::span<const Contact> contacts) {
    const auto side = static_cast<std::size_t>(images.side);
    const double texel = (box.east - box.west) / static_cast<double>(side - 1);
    // Where several trunks are near, the nearest one counts.
    std::vector<float> shades(side * side, 0.0F);
    for (const Contact& one : contacts) {
        const double reach = contact_reach * one.radius;
        const glm::dvec2 low = glm::min(one.from, one.to) - reach,
                         high = glm::max(one.from, one.to) + reach, way = one.to - one.from;
        if (low.x > box.east || high.x < box.west || low.y > box.north || high.y < box.south)
            continue;
        const double square = glm::dot(way, way);
        const TexelRange rows = range_of(box.north - high.y, box.north - low.y, texel, side),
                         columns = range_of(low.x - box.west, high.x - box.west, texel, side);
        for (std::size_t row = rows.first; row < rows.last; ++row)
            for (std::size_t column = columns.first; column < columns.last; ++column) {
                const glm::dvec2 at = glm::dvec2(box.west + texel * static_cast<double>(column),
                                                 box.north - texel * static_cast<double>(row)) -
                                      one.from;
                const double along =
                    square > 0.0 ? std::clamp(glm::dot(at, way) / square, 0.0, 1.0) : 0.0;
                const double away = glm::distance(at, along * way) / one.radius;
                const double open = std::clamp((away - 0.7) / (contact_reach - 0.7), 0.0, 1.0);
                float& shade = shades[row * side + column];
                shade = std::max(shade, static_cast<float>((1.0 - open) * (1.0 - open)));
            }
    }
    for (std::size_t i = 0; i < shades.size(); ++i) {
        if (shades[i] <= 0.0F) continue;
        const auto darken = [](std::uint8_t& value, float by) {
            value = static_cast<std::uint8_t>(static_cast<float>(value) * (1.0F - by) + 0.5F);
        };
        for (std::size_t k = 0; k < 3; ++k) darken(images.rgb[0][3 * i + k], of_colour * shades[i]);
        darken(images.rgb[2][3 * i], of_light * shades[i]);
    }
}

}  // namespace sporeprint
