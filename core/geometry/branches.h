// Turns a branch graph into a mesh: each chain of segments is one closed tube that begins inside
// its parent.
#pragma once

#include <cstdint>
#include <vector>

#include "core/geometry/sweep.h"
#include "core/individual/individual.h"
#include "core/mesh/detail.h"
#include "core/mesh/mesh.h"

namespace sporeprint {

/// Piece of a ring of the cap's chart that goes half round a branch, and back round its other half,
/// radians.
inline constexpr double branch_piece = 1.8;

/// Returns the exact counts of branched_mesh() at a level of detail. The vertex count follows
/// from species and seed alone: no age and no weight changes it. Triangles are counted for segments
/// that are present or, with `keep_absent`, for all segments, as for vertices.
[[nodiscard]] MeshCount branched_mesh_count(const Individual& individual, DetailLevel level,
                                            bool keep_absent = false);

/// Returns the mesh of a branched individual at a level of detail.
///
/// Branches use the chart of the cap, with tips at its pole; trunks use the chart of the stem.
/// Where the triangle limit is low, the tubes with the fewest tips are dropped first, and the
/// remaining ones are widened to represent them.
///
/// options   `stem` is not read
/// returns   closed pieces, one per tip, which intersect each other only at forks, and the spines
///           that hang from them
/// throws    Impossible ("/deformation/bend_deg") if the bend would make the graph intersect itself
/// cost      O(vertices)
[[nodiscard]] Mesh branched_mesh(const Individual& individual, DetailLevel level,
                                 const SweepOptions& options = {});

}  // namespace sporeprint
