// Turns a bush into a mesh: each limb with what goes on from it is one closed tube that begins inside of its bearer.
#pragma once

#include <cstdint>
#include <vector>

#include "core/geometry/sweep.h"
#include "core/individual/individual.h"
#include "core/mesh/detail.h"
#include "core/mesh/mesh.h"

namespace sporeprint {

/// What branched_mesh() comes to at a level of detail, 0..3, exactly. Vertices follow from the species and the seed alone: no age and no
/// weight changes them. Triangles are those of the limbs that are there; `keep_absent`: of all of them, as often as there are vertices.
[[nodiscard]] MeshCount limb_count(const Bush& bush, int lod, bool keep_absent = false);

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
