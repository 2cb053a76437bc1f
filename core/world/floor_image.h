// The images of the floor of a world: soil, moss and what lies on them, painted from the coordinates of the world.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/images.h"
#include "core/world/cover.h"
#include "core/world/ground.h"
#include "core/world/leaf_stamp.h"

namespace sporeprint {

/// What the images of a floor depend on.
struct FloorPaint {
    std::uint32_t seed = 1;  ///< of the world
    WorldBox box;            ///< a square: the middles of the outermost texels are on its borders
    int side = 1024;         ///< texels
    double wetness = 0.5;    ///< of the soil, 0..1: wet soil and leaves are darker and smoother
    int day = 1;             ///< of the year: leaves fade from their fall on
    std::span<const LeafLitter> kinds;  ///< of the stand, at most most_kinds
    const CoverField* cover = nullptr;  ///< of the box and of floor_margin round it
    /// Whether each leaf, needle and blade is painted, for which the cover has its finest step. Otherwise their colours
    /// are mixed into the ground, as they look from afar, and noises are as broad as texels need it.
    bool pieces = true;
};

/// How far beyond a box its images depend on the cover, metres.
inline constexpr double floor_margin = 0.75;

/// Paints base colour, normal (+Y to the north) and occlusion-roughness-metalness; the first row is the
/// northern one. Texels at the same place of the world are equal bit for bit, whatever image they
/// are part of, if the images have texels of one size.
///
/// throws  InvalidInput for a side outside 16..4096 (path "/side"); what `parallel` throws
/// cost    O(side²)
[[nodiscard]] RawImages floor_images(const FloorPaint& paint, const Parallel& parallel = in_turn);

}  // namespace sporeprint
