// How far away lies what the fungi of a place depend on.
#pragma once

#include <span>

#include "core/world/dead_wood.h"
#include "core/world/mycelia.h"

namespace sporeprint {

/// Bells, the draws about a middle, lie within three standard deviations.
inline constexpr double widest_bell = 3.0;

/// Hosts on whose rings bodies stand are nearer to a rectangle than this, metres: 1.5 crowns of 5 m, and what the ring
/// and the clusters on it spread.
inline constexpr double farthest_host = 28.0;

/// Returns how near to another body one of a species may stand at most, as a radius, metres.
[[nodiscard]] double core_of(const FungusSpecies& species);

/// Returns the greatest distance at which two bodies of some species may be too near to each other, metres.
[[nodiscard]] double spacing_of(std::span<const FungusSpecies> species);

/// Returns how far from the middle of their cluster bodies of a species stand at most, metres.
[[nodiscard]] double scatter_of(const Ecology& ecology);

/// Returns how far from a rectangle the centres of the mycelia of the ground lie that have bodies in it, or that have a
/// place there which another one does not get: metres.
///
/// spacing  spacing_of() the species of the world
[[nodiscard]] double mycelia_within(const Ecology& ecology, double spacing);

/// Returns how far from a rectangle trunks end whose mycelia may have bodies in it, metres.
///
/// spacing  likewise
[[nodiscard]] double trunks_within(const Ecology& ecology, double spacing);

/// How far from a rectangle that lies on which its fruit bodies depend, metres.
struct Influence {
    double trees = 0.0;  ///< hosts of mycelia and their litter
    double wood = 0.0;   ///< feet of trunks
    double light = 0.0;  ///< places whose light decides, those of mycelia of turf not counted
};

/// Returns how far away lies what fruit bodies depend on.
[[nodiscard]] Influence influence_on(std::span<const FungusSpecies> species, const Stand& stand);

}  // namespace sporeprint
