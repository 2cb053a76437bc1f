#include "core/world/world_mask.h"

#include <algorithm>
#include <cmath>

#include "core/params/types.h"

namespace sporeprint {

namespace {

constexpr double full = 65535.0;

/// Calls use(pixel, length) for each pixel along one axis that an interval covers a part of.
///
/// from, to  in pixels; what lies beyond the first and the last one is theirs
template <class Use>
void each_pixel(double from, double to, int side, const Use& use) {
    const int first = static_cast<int>(std::floor(from)), end = static_cast<int>(std::ceil(to));
    for (int i = first; i < end; ++i) {
        const double length = std::min(to, i + 1.0) - std::max(from, i + 0.0);
        if (length > 0.0) use(std::clamp(i, 0, side - 1), length);
    }
}

}  // namespace

double WorldMask::at(WorldPoint place) const {
    const std::int64_t whole = std::int64_t{extent} * units_of_metre;
    const auto pixel = [&](std::int32_t units) {
        const std::int64_t from_border =
            std::clamp<std::int64_t>(std::int64_t{units} + whole / 2, 0, whole - 1);
        return static_cast<std::size_t>(from_border * side / whole);
    };
    const auto across = static_cast<std::size_t>(side);
    return values[(across - 1 - pixel(place.y)) * across + pixel(place.x)] / full;
}

double WorldMask::over(const WorldBox& box) const {
    const double scale = static_cast<double>(side) / extent, half = 0.5 * side;
    double sum = 0.0, area = 0.0;
    each_pixel(half - box.north * scale, half - box.south * scale, side, [&](int row, double high) {
        const std::uint16_t* const of_row =
            &values[static_cast<std::size_t>(row) * static_cast<std::size_t>(side)];
        each_pixel(half + box.west * scale, half + box.east * scale, side,
                   [&](int column, double wide) {
                       sum += high * wide * of_row[column];
                       area += high * wide;
                   });
    });
    return area > 0.0 ? std::min(sum / (area * full), 1.0) : 0.0;
}

bool WorldMask::is_full() const {
    return std::all_of(values.begin(), values.end(),
                       [](std::uint16_t value) { return value == 65535; });
}

std::string text_of(const WorldMask& mask) {
    std::vector<std::uint8_t> bytes;
    bytes.reserve(2 * mask.values.size());
    for (const std::uint16_t value : mask.values) {
        bytes.push_back(static_cast<std::uint8_t>(value & 255U));
        bytes.push_back(static_cast<std::uint8_t>(value >> 8U));
    }
    return std::to_string(mask.side) + " sha256:" + sha256_hex(bytes.data(), bytes.size());
}

}  // namespace sporeprint
