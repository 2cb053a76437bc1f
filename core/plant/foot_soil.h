// The soil about the foot of a trunk, out of which its roots rise.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "core/plant/tree.h"

namespace sporeprint {

/// Adds a low mound of soil and litter about the foot of a trunk, whose roots run out into it: a closed
/// piece with an uneven border a little under the ground, highest at the trunk. It shows the image of the bark, whose colour tints turn to
/// that of soil.
///
/// bark     of the tree at this level, with its flare; the piece is appended
/// flare    that of the roots; 0 adds nothing
/// seed     of the border and of the crumbs
/// returns  how many vertices it has
std::size_t add_foot_soil(Bark& bark, const Tree& tree, double flare, std::uint32_t seed, int lod);

/// Returns the counts of what add_foot_soil() adds.
[[nodiscard]] TreeCount count_of_foot_soil(const TreeShape& shape, int lod);

/// Turns the tints of the last vertices of a bark to those of soil, and darkens the foot of the trunk,
/// which is damp and fissured.
///
/// tints    of the bark
/// of_soil  how many vertices add_foot_soil() has added; 0 if the tree has no soil about its foot
/// black    how dark the fissures of the foot are, 0..1
/// light    that bark reflects, linear, which soil does not
void tint_foot(std::vector<glm::vec3>& tints, const Bark& bark, const Tree& tree, double flare,
               std::uint32_t seed, std::size_t of_soil, double black, const glm::vec3& light);

}  // namespace sporeprint
