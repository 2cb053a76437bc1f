// Thin shells round the stem: the ring and the sac.
#pragma once

#include "core/geometry/ornament_context.h"

namespace sporeprint {

/// Returns the exact counts of the ring and the sac together.
[[nodiscard]] MeshCount shell_count(const Individual& individual, const OrnamentDetail& detail);

/// Appends the ring, a closed thin shell attached to the stem; at size 0 it is a circle round the
/// stem.
void add_ring(Mesh& mesh, const Individual& individual, const OrnamentContext& context);

/// Appends the sac-like volva, a closed thin shell round the base of the stem, torn at its edge; at
/// size 0 it is a circle round the stem.
void add_sac(Mesh& mesh, const Individual& individual, const OrnamentContext& context);

}  // namespace sporeprint
