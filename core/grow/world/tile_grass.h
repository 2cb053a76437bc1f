// Grass on a tile: tufts that repeat a few shapes.
#pragma once

#include <cstddef>
#include <vector>

#include "core/gltf/glb.h"
#include "core/grow/world/plot.h"
#include "core/grow/world/plot_places.h"
#include "core/mesh/mesh.h"
#include "core/world/cover.h"
#include "core/world/grass_season.h"

namespace sporeprint {

/// Number of shapes of tufts.
inline constexpr std::size_t tuft_shapes = 4;

/// Returns a tuft of six blades with tints, about 13 cm high, rooted at the origin.
///
/// shape   0 to tuft_shapes - 1
/// season  how many of its blades are withered, and how bright the others are
[[nodiscard]] Mesh tuft_mesh(std::size_t shape, const GrassSeason& season);

/// Returns the places of tufts of each shape, in the order of the cells of the world.
[[nodiscard]] std::vector<std::vector<GlbTransform>> tufts_on(const PlotContent& content,
                                                              const PlotFrame& frame,
                                                              const CoverField& cover);

}  // namespace sporeprint
