// Irregular cells in a plane: where their middles are.
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>

namespace sporeprint {

/// Returns the middle of a cell, which lies anywhere in the inner parts of its square.
///
/// x, y  of the corner of its square
/// salt  selects one of many divisions of the plane
inline glm::dvec2 cell_middle(int x, int y, std::uint32_t salt) {
    std::uint32_t mixed = static_cast<std::uint32_t>(x) * 0x9E3779B1U ^
                          static_cast<std::uint32_t>(y) * 0x85EBCA77U ^ salt * 0xC2B2AE3DU;
    mixed ^= mixed >> 15U;
    mixed *= 0x2C1B3C6DU;
    mixed ^= mixed >> 12U;
    mixed *= 0x297A2D39U;
    mixed ^= mixed >> 15U;
    constexpr double inset = 0.12, scale = (1.0 - 2.0 * inset) / 65535.0;
    return {x + inset + scale * (mixed & 0xFFFFU), y + inset + scale * (mixed >> 16U)};
}

}  // namespace sporeprint
