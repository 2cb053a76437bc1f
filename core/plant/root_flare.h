// The foot of a trunk, which widens into its roots.
#pragma once

#include <cstdint>

#include "core/plant/tree.h"

namespace sporeprint {

/// Widens the trunk towards the ground, most where roots leave it: the distance of bark from the axis
/// grows by a factor that falls to nothing within some radii of the trunk above the ground. Rays from
/// the axis keep their order, so that no surface comes to cross itself; branches are not moved.
///
/// The skin is refined there first, so that roots are round.
///
/// bark   of the tree at this level; normals follow, tangents keep their direction
/// flare  0 leaves it unchanged; at 1 the foot is about twice as wide as the trunk
/// seed   of the places of the roots
void flare_roots(Bark& bark, const Tree& tree, double flare, std::uint32_t seed, int lod);

/// Lets the trunk reach below the ground by its radius, for a tree that stands on ground that may slope. Before
/// flare_roots().
void plant_foot(Bark& bark, const Tree& tree);

/// Returns slightly high estimates of the vertices and triangles that flare_roots() adds.
[[nodiscard]] TreeCount count_of_flare(const TreeShape& shape, int lod);

}  // namespace sporeprint
