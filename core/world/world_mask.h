// A mask of a world: which share of what could live at a place does.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "core/world/ground.h"
#include "core/world/records.h"

namespace sporeprint {

/// Greatest number of pixels along each side of a mask.
inline constexpr int most_mask_side = 1024;

/// A square of pixels over the whole extent of a world, each of which covers a square of ground.
struct WorldMask {
    int extent = 1024;  ///< of the world, metres
    int side = 1;       ///< pixels along each side
    /// Rows from north to south, each from west to east: 65535 for all, 0 for nothing.
    std::vector<std::uint16_t> values;

    /// Returns the share at a place, 0..1: that of the pixel in which it lies. Southern and western borders belong to a
    /// pixel; places beyond the world have the pixel that is nearest.
    [[nodiscard]] double at(WorldPoint place) const;
    /// Returns the mean over a rectangle, 0..1, by the areas of the pixels in it.
    ///
    /// box  at least as long and as wide as a thousandth of a pixel
    [[nodiscard]] double over(const WorldBox& box) const;
    /// Returns true if it takes nothing away.
    [[nodiscard]] bool is_full() const;
    /// Returns the memory that it takes.
    [[nodiscard]] std::size_t bytes() const {
        return sizeof(*this) + values.size() * sizeof(values[0]);
    }
    bool operator==(const WorldMask&) const = default;
};

/// Returns a text that two masks have in common if they are equal: the side and the SHA-256 of the values.
[[nodiscard]] std::string text_of(const WorldMask& mask);

}  // namespace sporeprint
