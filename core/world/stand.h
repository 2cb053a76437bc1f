// The trees of a world: patches of trees of one age, which storms fell and which thin out as they grow.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/math/random.h"
#include "core/plant/tree_ecology.h"
#include "core/world/records.h"
#include "core/world/site.h"
#include "core/world/stand_params.h"
#include "core/world/world_mask.h"

namespace sporeprint {

/// One of the kinds of trees of a stand.
struct StandKind {
    std::string id;      ///< of its preset
    double share = 1.0;  ///< of all kinds together 1
    TreeEcology ecology;
};

/// What the trees of a world are drawn from.
struct Stand {
    StandParams params;
    std::uint32_t seed = 1;
    std::vector<StandKind> kinds;      ///< at least one, at most 255
    std::optional<std::uint8_t> lone;  ///< which of the kinds stands at the centre of the world
    /// Share of the seedlings that are there; null for all. A lone tree stands where it is not 0.
    std::shared_ptr<const WorldMask> mask{};
};

/// Returns the height that no tree of a stand exceeds, metres.
[[nodiscard]] double greatest_height(const Stand& stand);

using SiteAt = std::function<Site(WorldPoint)>;

/// The trees of a world are known between these moments: since long before year 0, because mycelia are older than the
/// world and logs are there from its first day.
inline constexpr WorldTime begin_of_trees = time_of(-200), end_of_trees = time_of(241);

/// Returns all trees of a block, of all times.
///
/// A patch is what is nearest to one of the seeds, of which there is one in each square of 22 m. Storms fell it at
/// intervals of a Weibull distribution of shape 2; a cohort is what is born within 12 years after one. A tree dies in
/// the next storm, of age, or when the circle that a stronger neighbour claims reaches its trunk: three rounds within
/// the cohort, one among all.
///
/// block   spans block_side from (64 x, 64 y) metres, without its upper bounds
/// site    what places have to give; the same function for all blocks
/// dim     the same with less light, for kinds that have enough of it: `site` is called only where it decides
/// returns trees by ascending ids; those of neighbouring blocks fit together exactly, since none depends on anything
///         further away than 20 m
/// cost    about 6 ms
[[nodiscard]] std::vector<StandTree> trees_of(const Stand& stand, const SiteAt& site,
                                              CellIndex block, const SiteAt& dim = {});

}  // namespace sporeprint
