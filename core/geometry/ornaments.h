// Ornaments: solids that stand on the surface.
#pragma once

#include "core/geometry/ornament_context.h"

namespace sporeprint {

/// Returns the exact counts of all that add_ornaments() appends, absent ornaments included: they
/// depend on the set of species only, not on amounts.
[[nodiscard]] MeshCount ornament_count(const Individual& individual, const OrnamentDetail& detail);

/// Appends warts, scales and bulb scales, each a closed solid sunk a little into the surface; then
/// the ring and the sac, spines, peridioles and receptacles, and the ground. A piece of size 0 is a point on the
/// surface, with unit normals.
void add_ornaments(Mesh& mesh, const Individual& individual, const OrnamentContext& context);

}  // namespace sporeprint
