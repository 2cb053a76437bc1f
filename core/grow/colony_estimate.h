// The size of a colony, before it is built and after, and its levels of detail.
#pragma once

#include <span>
#include <vector>

#include "core/grow/colony.h"
#include "core/grow/levels.h"

namespace sporeprint {

/// Returns the spec at the whole level of detail whose expected number of drawn triangles, every
/// instance counted, is nearest to `triangles`, without that; a spec without it unchanged.
///
/// typical  typical_individual() of the spec
/// throws   as estimate()
[[nodiscard]] ColonySpec at_level(ColonySpec spec, const Individual& typical, const Atlas& atlas);

/// Returns the approximate numbers of vertices and triangles in the file (seldom too low), texels
/// and bytes. Nothing is built.
///
/// typical  typical_individual() of the spec
/// throws   as colony_traits(); Impossible ("/branch_distance") for roots with too many nodes
[[nodiscard]] Estimate estimate(const ColonySpec& spec, const Individual& typical,
                                const Atlas& atlas);

/// Returns the requested level of detail and all below it, with estimated counts. A colony is
/// replaced as a whole: its stems are one mesh, and each cap is cut to fit the stem of its level.
///
/// typical  typical_individual() of the spec
/// box      of the colony
/// throws   as estimate()
[[nodiscard]] std::vector<Level> levels_of(const ColonySpec& spec, const Individual& typical,
                                           const Atlas& atlas, const Bounds& box);

/// Returns the number of vertices and triangles of the meshes of a level, each counted once.
[[nodiscard]] MeshCount count_of(const Mesh& skin, const Mesh& wood, std::span<const Mesh> models);

/// Returns the estimate of a built colony, with exact vertex and triangle counts.
///
/// spec  at_level() of a request
[[nodiscard]] Estimate measured(const ColonySpec& spec, const Colony& colony);

}  // namespace sporeprint
