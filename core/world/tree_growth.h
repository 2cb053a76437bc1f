// How large a tree of a stand is at a moment, and how much is left of a dead one.
#pragma once

#include "core/world/records.h"

namespace sporeprint {

/// Height of an old tree to which the heights of kinds refer, metres.
inline constexpr double standard_height = 28.0;

/// Returns the height of a tree at a moment of its life, metres.
[[nodiscard]] double height_at(const StandTree& tree, WorldTime time);

/// Returns at which age a tree has a height, years; a thousand million if it never has.
[[nodiscard]] double age_of_height(const StandTree& tree, double height);

/// Returns the radius of the crown of a tree of some height, and of the circle in which it tolerates no lesser one:
/// metres, at most 5.
[[nodiscard]] double crown_radius(double height);

/// Returns the height of a tree whose crown has a radius below 5 m, metres; 0 below that of a seedling.
[[nodiscard]] double height_of_crown(double radius);

/// Returns the diameter of the trunk at breast height of a tree of some height, metres.
[[nodiscard]] double trunk_diameter(double height);

/// Returns which share of the mass of a dead trunk is lost at a moment, 0 to 1.
[[nodiscard]] double mass_lost(const DeadWood& wood, WorldTime time);

/// Returns the radius of a dead trunk at its foot at a moment, metres.
[[nodiscard]] double radius_at(const DeadWood& wood, WorldTime time);

/// Returns the radius of a trunk at a distance from its foot, compared with that at its foot: a fifth at the top.
[[nodiscard]] double taper_at(const DeadWood& wood, double along);

/// Returns for how long wood of a diameter is there, compared with thick wood, 0.5 to 1: beech above 10 cm is gone in
/// 35 years, thinner beech in 18.
[[nodiscard]] double lasting(double diameter);

/// Returns how much of a dead trunk is left, from its foot on, metres. The tops of snags break off, and thin wood is
/// gone before thick wood.
[[nodiscard]] double length_at(const DeadWood& wood, WorldTime time);

/// Returns when a dead trunk has become shorter than a distance from its foot, metres; at most when it is gone.
[[nodiscard]] WorldTime when_shorter(const DeadWood& wood, double along);

}  // namespace sporeprint
