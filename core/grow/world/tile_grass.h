// Grass: tufts that repeat a few shapes.
#pragma once

#include <cstddef>
#include <cstdint>
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

/// Tufts on a square of half a metre where grass covers it.
inline constexpr int tufts_of_cell = 3;

/// Returns the places of tufts of each shape, in the order of the cells of the world.
///
/// per_cell  tufts on a square of half a metre; more of them are more beside the same ones
/// rim       distance from the border within which none stands, metres
[[nodiscard]] std::vector<std::vector<GlbTransform>> tufts_on(const PlotContent& content,
                                                              const PlotFrame& frame,
                                                              const CoverField& cover,
                                                              int per_cell = tufts_of_cell,
                                                              double rim = 0.0);

/// Tufts on a square of half a metre of a plot, and how far from its border they are rooted, metres: blades lean over it by
/// less than that.
inline constexpr int tufts_of_plot_cell = 12;
inline constexpr double rim_of_grass = 0.12;

/// Returns the grass of a plot as one mesh with tints; empty where none grows.
///
/// most  number of triangles, for which there are fewer tufts everywhere
[[nodiscard]] Mesh grass_of(const PlotContent& content, const PlotFrame& frame,
                            const CoverField& cover, std::uint64_t most);

}  // namespace sporeprint
