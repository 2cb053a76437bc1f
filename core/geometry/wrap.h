// Brackets follow the trunk that they grow on.
#pragma once

#include "core/mesh/mesh.h"

namespace sporeprint {

/// Bends what grows on a flat wall, z = 0, round an upright trunk whose bark touches the wall along
/// the y axis: at the wall, points move back by their distance from the trunk, and less and less the
/// farther they are in front of it. Every line along z keeps the order of its points, so that no
/// surface comes to cross itself.
///
/// radius  of the trunk, metres; from 0.8 of it to either side on, the trunk goes on straight.
///         0: the wall stays flat
void wrap_round_trunk(Mesh& mesh, double radius);

}  // namespace sporeprint
