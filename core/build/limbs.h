// Turns a bush into a mesh: each limb with what goes on from it is one closed tube that begins inside of its bearer.
#pragma once

#include <cstdint>
#include <vector>

#include "core/build/detail.h"
#include "core/build/sweep.h"
#include "core/mesh/mesh.h"
#include "core/model/individual.h"

namespace sporeprint {

/// Vertices and triangles of a bush at a level of detail, 0..3. They follow from its species and its seed alone: no age and no
/// weight changes them.
[[nodiscard]] MeshCount limb_count(const Bush& bush, int lod);

/// Mesh of a branched individual at a level of detail, 0..3.
///
/// Limbs wear the cap's chart, their tips its pole; trunks wear the stem's. Where triangles are few the limbs that bear fewest tips go
/// first, and what is left grows as wide as what it stands for.
///
/// options   its stem is not read
/// returns   closed pieces, one to a tip, which pierce each other only where limbs fork
/// throws    Impossible ("/deformation/bend_deg") for a bush that would be bent through itself
/// cost      O(vertices)
[[nodiscard]] Mesh branched_mesh(const Individual& individual, int lod,
                                 const SweepOptions& options = {});

}  // namespace sporeprint
