// The distinct individuals of a colony, of which all members are instances, and the dimensions that
// follow from them.
#pragma once

#include <vector>

#include "core/atlas/atlas.h"
#include "core/colony/cap.h"
#include "core/colony/colony_ground.h"
#include "core/colony/colony_spec.h"
#include "core/colony/separation.h"
#include "core/grow/collision.h"
#include "core/grow/colony.h"
#include "core/grow/wind.h"
#include "core/individual/individual.h"

namespace sporeprint {

/// Returns the level of detail of what is painted on the individuals of a colony.
///
/// lod  of the colony
[[nodiscard]] int cap_lod(int lod);

/// Returns the level of detail of the mesh of one individual: one further than that of the colony,
/// or that of the colony if its outline intersects itself with so few rings.
[[nodiscard]] int mesh_lod(const Individual& individual, int lod);

/// Returns true if the meshes have texture coordinates.
[[nodiscard]] bool textured(const ColonySpec& spec);

/// Returns an individual of the age of one of the models, without its variation, with the ground that
/// it stands in.
///
/// which  0 for the oldest, up to `distinct` - 1
[[nodiscard]] Individual average_individual(const ColonySpec& spec, int which, const Atlas& atlas,
                                            const Caches& caches);

/// Returns an individual without variation, from which the lengths of a colony follow.
///
/// throws  InvalidInput, Impossible as resolve()
[[nodiscard]] Individual typical_individual(const ColonySpec& spec, const Atlas& atlas,
                                            const Caches& caches = {});

/// Returns the lengths by which an individual is placed; mushrooms without a stem stand on thin
/// threads.
[[nodiscard]] StemFit fit_of(const Individual& individual, const ColonyTraits& traits);

/// Returns colony_growth().
///
/// throws  Impossible ("/branch_distance") for roots with too many nodes
[[nodiscard]] ColonyRoots growth_of(const ColonyParams& params, const ColonyTraits& traits,
                                    const StemFit& fit);

/// Returns the greatest number of segments of a stem at a level of detail.
[[nodiscard]] int segments_of(const ColonyRoots& growth, int lod);

/// What placement, collision and wind need of the distinct individuals of a colony.
struct ModelSet {
    std::vector<ColonyModel> models;
    std::vector<SwayingStem> stems;  ///< of the whole individuals; empty unless the file has wind
    std::vector<std::vector<CollisionShape>> shapes;  ///< empty unless the file has collision
    std::vector<ColonyFoot> feet;  ///< empty if the members stand on stems of the colony
};

/// Adds the meshes of the distinct individuals of a colony to all its levels.
///
/// colony   with its farther levels
/// fit      of the typical individual; enlarged to the widest mesh if mushrooms stand as a whole
[[nodiscard]] ModelSet add_models(const ColonySpec& spec, const ColonyTraits& traits,
                                  const Atlas& atlas, const ExecutionContext& execution,
                                  Colony& colony, StemFit& fit);

}  // namespace sporeprint
