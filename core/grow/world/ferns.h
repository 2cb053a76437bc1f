// Ferns on a plot: rosettes of fronds, out from May to October.
#pragma once

#include <cstdint>
#include <vector>

#include "core/atlas/atlas.h"
#include "core/grow/world/plot.h"
#include "core/grow/world/plot_parts.h"
#include "core/grow/world/plot_places.h"
#include "core/mesh/mesh.h"
#include "core/plant/leaf.h"
#include "core/world/cover.h"

namespace sporeprint {

/// How ferns look on a day.
struct FernSeason {
    double unrolled = 0.0;  ///< how far fronds are out, 0..1; at 0 there are none
    /// How far they have turned, 0..1, in eighths: each step has images of its own.
    double autumn = 0.0;
};

/// Returns the ferns of a day of the northern year.
///
/// source  chosen by eye for Dryopteris filix-mas in Central Europe: fronds unroll from late April to early June and
///         turn in October
[[nodiscard]] FernSeason ferns_on(int day);

/// The individuals that ferns are copies of.
inline constexpr std::uint32_t fern_shapes = 5;

/// Returns a rosette of fronds that rise from the origin and arch outwards: closed pieces with the texture coordinates
/// of the leaf, and tints.
///
/// frond  the shape of a leaf
/// lod    as of leaf_mesh()
[[nodiscard]] Mesh fern_mesh(const LeafShape& frond, std::uint32_t individual, int lod);

/// Returns the places of the ferns, by individual, in the order of the cells of the world; on a plot that is part of
/// another one are those of the other. They stand in groups where it is damp and shady, and
/// never in a trunk.
///
/// rim  distance from the border within which none stands, metres
[[nodiscard]] std::vector<std::vector<GlbTransform>> fern_places(const PlotContent& content,
                                                                 const PlotFrame& frame,
                                                                 const CoverField& cover,
                                                                 double rim = 0.0);

/// Distance from the border of a slab within which no fern stands, so that few fronds reach beyond it, metres.
inline constexpr double rim_of_ferns = 0.5;

/// The finest level of detail of fronds that many ferns may have.
inline constexpr int least_fern_lod = 2;

/// Returns the ferns of a plot; nothing where none stands.
///
/// lod  of their fronds, as of leaf_mesh()
[[nodiscard]] std::vector<PlotLeaves> ferns_of(const PlotContent& content, const PlotFrame& frame,
                                               const CoverField& cover, int lod, const Atlas& atlas,
                                               double rim = 0.0);

}  // namespace sporeprint
