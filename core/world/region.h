// A rectangle of a world.
#pragma once

#include <cmath>
#include <cstdint>

#include "core/world/records.h"

namespace sporeprint {

/// A rectangle, in units of WorldPoint. Its western and southern sides belong to it, the others do not.
struct Region {
    std::int32_t west, south, east, north;

    constexpr Region(std::int32_t of_west, std::int32_t of_south, std::int32_t of_east,
                     std::int32_t of_north)
        : west(of_west), south(of_south), east(of_east), north(of_north) {}
    /// The rectangle of a block.
    // NOLINTNEXTLINE(google-explicit-constructor): a block is a region.
    constexpr Region(CellIndex block)
        : Region(block.x * side, block.y * side, (block.x + 1) * side, (block.y + 1) * side) {}

    [[nodiscard]] constexpr bool contains(WorldPoint place) const {
        return place.x >= west && place.x < east && place.y >= south && place.y < north;
    }
    /// Returns the rectangle whose sides lie so many metres farther out.
    [[nodiscard]] Region grown(double by) const {
        const auto units = static_cast<std::int32_t>(std::ceil(by * units_of_metre));
        return {west - units, south - units, east + units, north + units};
    }
    bool operator==(const Region&) const = default;

  private:
    static constexpr std::int32_t side = block_side * units_of_metre;
};

}  // namespace sporeprint
