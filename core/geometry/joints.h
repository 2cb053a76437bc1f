// Joints of tubes: where a tube leaves another, both look like one skin.
#pragma once

#include <vector>

#include "core/geometry/tube.h"
#include "core/mesh/mesh.h"

namespace sporeprint {

/// Turns the normals of tubes near their joints towards the gradient of their smooth union, and gives
/// colours the mean of both tubes, so that no line is seen where the surfaces cross; and moves
/// vertices outwards to that union, which fills the crease with a fillet. Where a tube begins it is
/// moved into its parent, from which it comes out as a ridge, without a step. Each tube is united with
/// its parent and that one's, its children and theirs, and the other children of its parent, a trunk
/// with all others. What is added depends on the place alone: a mix has more rings than a single
/// species, and both must bound the same solid.
///
/// mesh     normals and positions of the rows are changed
/// colours  Station::colour per vertex of the mesh, 1 on trunks
/// tubes    parents precede their children
/// cost     O(vertices near joints x stations of their neighbours)
void blend_joints(Mesh& mesh, std::vector<double>& colours, const std::vector<Tube>& tubes);

}  // namespace sporeprint
