// The order in which a mesh's triangles are drawn.
#pragma once

#include "core/mesh/mesh.h"

namespace sporeprint {

/// Orders triangles so that a graphics processor finds most corners among the last sixteen that it has worked out: about 0.66
/// vertices a triangle on a grid instead of one. Vertices, the set of triangles and the order of their corners stay.
///
/// cost    10 ns a triangle, a twentieth of what making it costs: cheaper than to keep it by a key
/// source  [Sander2007] tipsify, as meshoptimizer has it: whole numbers only, so every machine finds the same order
void order_for_vertex_cache(Mesh& mesh);

}  // namespace sporeprint
