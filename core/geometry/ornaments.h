// Ornaments: solids that stand on the surface (warts, scales, bulb scales, the ring and the sac).
#pragma once

#include "core/geometry/curl.h"
#include "core/geometry/damage_cuts.h"
#include "core/geometry/damage_dents.h"
#include "core/geometry/sweep.h"
#include "core/individual/individual.h"

namespace sporeprint {

/// Everything that ornaments need to know about the body they stand on.
struct OrnamentContext {
    const Outline& outline;
    const Deformer& deformer;
    const RestSurface& rest_surface;
    const Detail& detail;
    DetailLevel level;
    std::uint32_t seed;
    bool textured;
    bool keep_absent;        ///< whether ornaments of size 0 keep their triangles
    const MarginCuts& cuts;  ///< of the margin
    const Curl& curl;        ///< of the remaining margin
    const Dents& dents;
    const Individual& individual;
};

/// Returns the exact counts of all that add_patches(), add_ring() and add_sac() append, absent
/// ornaments included: they depend on the set of species only, not on amounts.
[[nodiscard]] MeshCount ornament_count(const Individual& individual, const Detail& detail);

/// Appends warts, scales and bulb scales, each a closed solid sunk a little into the surface. A
/// piece of size 0 is a point on the surface, with unit normals.
void add_patches(Mesh& mesh, const Individual& individual, const OrnamentContext& context);

/// Appends the ring, a closed thin shell attached to the stem; at size 0 it is a circle round the
/// stem.
void add_ring(Mesh& mesh, const Individual& individual, const OrnamentContext& context);

/// Appends the sac-like volva, a closed thin shell round the base of the stem, torn at its edge; at
/// size 0 it is a circle round the stem.
void add_sac(Mesh& mesh, const Individual& individual, const OrnamentContext& context);

}  // namespace sporeprint
