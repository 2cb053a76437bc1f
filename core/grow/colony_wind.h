// How wind moves a colony: the sway of each of its meshes.
#pragma once

#include <span>
#include <vector>

#include "core/colony/colony_skin.h"
#include "core/grow/colony.h"
#include "core/grow/wind.h"

namespace sporeprint {

/// Returns the sway of each model at the top of its stem. All members of a model have that of one
/// mesh, and their stems have the same, so that no cap leaves its stem.
///
/// stems  of the models, for those that have their own
[[nodiscard]] std::vector<Sway> sway_of_models(const std::vector<ColonyMember>& members,
                                               const ColonyTraits& traits,
                                               std::span<const SwayingStem> stems);

/// Sets the sway of the meshes of all models: that of the top of their stems, or, of whole
/// individuals, zero at the ground and rising to it.
///
/// stems  as for sway_of_models()
/// tops   sway_of_models()
void add_sway(Colony& colony, const ColonyTraits& traits, std::span<const SwayingStem> stems,
              std::span<const Sway> tops);

/// Returns the sway of roots and stems: zero on roots, and along a stem from zero to that of its
/// model.
///
/// tops  sway_of_models()
[[nodiscard]] std::vector<Sway> sway_of(const ColonySkin& skin, const ColonySite& site,
                                        const std::vector<ColonyMember>& members,
                                        std::span<const Sway> tops);

/// Returns how far wind moves a colony: by its longest stem.
///
/// typical  stem of the typical individual
[[nodiscard]] Wind wind_of(const ColonySite& site, const std::vector<ColonyMember>& members,
                           const ColonyTraits& traits, SwayingStem typical,
                           const ColonyParams& params);

}  // namespace sporeprint
