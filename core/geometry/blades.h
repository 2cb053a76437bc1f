// Gills and ridges as solids, and the cross veins between ridges.
#pragma once

#include "core/geometry/attachment.h"

namespace sporeprint {

/// Number and resolution of the blades of one mesh. Within the triangle limit the counts of one
/// kind do not affect how another kind looks; otherwise weight 1 would not reproduce the
/// single-species mesh.
struct BladeBudget {
    int tiers = 0;     ///< tiers of the gill layout that are built; finer ones are painted only
    int segments = 0;  ///< per blade, on the face
    int below = 0;     ///< per blade, on the stem
    int veins = 0;     ///< cross veins between ridges
    int vein_segments = 0;  ///< per cross vein
    int vein_stride = 1;    ///< every `vein_stride`-th cross vein is built
};

/// Returns the blade budget of an individual.
///
/// beside_pores  whether the set has solid pores too, which leave a sixth of the triangles to
///               blades
[[nodiscard]] BladeBudget blade_budget(const Individual& individual, bool beside_pores);

/// Leaves out a row of each blade or cross vein that only makes it smoother; returns false when none
/// is left.
bool drop_row(BladeBudget& budget);

/// Makes the budget one step coarser: drops a tier of blades, or cross veins, or a row of each
/// blade. Returns false when no step is left.
bool coarsen(const Individual& individual, BladeBudget& budget);

/// Returns the exact vertex and triangle counts of the blades and veins.
[[nodiscard]] MeshCount solid_count(const Individual& individual, const BladeBudget& budget);

/// Appends blades and veins, each a closed solid.
void add_blades(const Attachment& attachment, const BladeBudget& budget);

}  // namespace sporeprint
