// A fallen leaf as a small picture that is painted onto the floor of a world again and again.
#pragma once

#include <algorithm>
#include <cstddef>
#include <glm/vec3.hpp>
#include <vector>

#include "core/plant/leaf.h"

namespace sporeprint {

/// A kind of litter.
struct LeafLitter {
    LeafShape shape;
    LeafPalette palette;
};

/// Returns whether the leaves of a kind are needles: so narrow that they cover the ground as lines.
[[nodiscard]] bool has_needles(const LeafLitter& kind);

/// A leaf seen from above and from below. Colours are encoded as sRGB, 0..1, because they are mixed as they
/// are encoded.
struct LeafStamp {
    struct Texel {
        glm::vec3 upper{0.0F}, lower{0.0F};
        float cover = 0.0F;  ///< share of the texel that is leaf
        float rise = 0.0F;   ///< of veins and border above the plane of the leaf, in lengths of it
    };
    int columns = 0, rows = 0;  ///< along and across the leaf
    double length = 0.08;       ///< of the picture along the leaf, metres
    float half = 0.5F;          ///< of its breadth, in lengths of it
    std::vector<Texel> texels;  ///< by rows

    /// Returns the texel at a place.
    ///
    /// along, across  in lengths of the picture, -0.5..0.5 and -half..half; the root is at the low end of
    ///                `along`
    [[nodiscard]] const Texel& at(float along, float across) const {
        // Truncated, after the places below 0 are set to 0.
        const int column = static_cast<int>(
                      std::max((along + 0.5F) * static_cast<float>(columns), 0.0F)),
                  row = static_cast<int>(
                      std::max((across + half) * static_cast<float>(columns), 0.0F));
        return texels[static_cast<std::size_t>(std::min(row, rows - 1) * columns +
                                               std::min(column, columns - 1))];
    }
};

/// Returns the stamp of a kind of leaf in the colours of fallen leaves; of a compound leaf that of a leaflet,
/// since they fall one by one.
///
/// columns  texels along the leaf, 8..128
/// throws  InvalidInput for an invalid shape, or another number of columns (path "/columns")
/// cost    O(columns²)
[[nodiscard]] LeafStamp leaf_stamp(const LeafLitter& kind, int columns);

}  // namespace sporeprint
