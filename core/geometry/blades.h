// Gills and ridges as solids, and the cross veins between ridges.
#pragma once

#include "core/geometry/attachment.h"

namespace sporeprint {

/// How blades share the triangles there are. What there is of one kind does not change how another looks, as far as the budget
/// allows: else no mix would end where its species begin.
struct BladeBudget {
    int tiers = 0;        ///< of the comb that are built; finer ones are painted only
    int segments = 0;     ///< of a blade on the face
    int below = 0;        ///< of a blade on the stem
    int veins = 0;        ///< between ridges
    int vein_stride = 1;  ///< each so-manieth of all is built
};

/// beside_pores  whether the set has solid pores, which leave blades a sixth of the triangles
[[nodiscard]] BladeBudget blade_budget(const Individual& individual, bool beside_pores);

/// Gives up a tier of blades, or cross veins, or a row of each blade; false when there is nothing left to give up.
bool coarsen(const Individual& individual, BladeBudget& budget);

/// What the blades and veins of an individual come to.
[[nodiscard]] MeshCount solid_count(const Individual& individual, const BladeBudget& budget);

/// Appends them, each a closed solid.
void add_blades(const Roots& roots, const BladeBudget& budget);

}  // namespace sporeprint
