// What stomach fungi form inside, as solids: peridioles and receptacles.
#pragma once

#include "core/geometry/ornament_context.h"

namespace sporeprint {

/// Returns the exact counts of all that add_peridioles() and add_receptacles() append.
[[nodiscard]] MeshCount peridiole_count(const Individual& individual, const Detail& detail);
[[nodiscard]] MeshCount receptacle_count(const Individual& individual, const Detail& detail);

/// Appends the peridioles of each species, closed lenses that lie in the cup: the lowest ones touch
/// its face, those without space lie on them. One that rain has splashed out is a point.
void add_peridioles(Mesh& mesh, const Individual& individual, const OrnamentContext& context);

/// Appends the receptacle of each species, one closed surface whose meshes are holes. At amount 0 it
/// is a point in the egg.
void add_receptacles(Mesh& mesh, const Individual& individual, const OrnamentContext& context);

}  // namespace sporeprint
