// Crossing of two species: which of their parts an offspring has.
#pragma once

#include "core/breed/breeding.h"
#include "core/model/species.h"

namespace sporeprint {

/// Returns a species with all its lengths times a factor, within their ranges.
[[nodiscard]] Species scaled(Species species, double factor);

/// Returns the largest factor by which the outlines of a species can be scaled within the ranges of
/// their points; infinite for branched species.
[[nodiscard]] double most_scale(const Species& species);

/// Returns the template of a species at an age: that of the stage of this age, or the blend of two.
[[nodiscard]] Model model_at(const Species& species, double age);

/// Returns a species with the stages of one parent and the traits of both. Each trait comes whole from
/// one of them; deformation, weathering, spread and segments are blended. Traits that fit together alone
/// are drawn together: gills and how they are painted, an ornament and its amount, what stands on
/// the ground, its soil and the ecology. Locked parts are those of the first. Outlines and axes are those of the
/// parent whose stages it has.
///
/// pre  both are of one family
[[nodiscard]] Species crossed(const Species& a, const Species& b, const Genes& genes);

}  // namespace sporeprint
