// Dead wood: what becomes of the trees of a stand when they die.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "core/world/stand.h"

namespace sporeprint {

/// Trunks thinner than this at breast height leave nothing larger than twigs, metres.
inline constexpr double thinnest_log = 0.07;

/// How the ground slopes at a place, and where the wind blows to.
struct FallSite {
    double east = 0.0, north = 0.0;  ///< rise per metre
};

using FallSiteAt = std::function<FallSite(WorldPoint)>;

/// Returns the length that no trunk of a stand exceeds, metres.
[[nodiscard]] double longest_trunk(const Stand& stand);

/// Returns k of the mass e^(-k t) of the dead trunks of a kind, per year.
[[nodiscard]] double decay_rate(const StandParams& params, const TreeEcology& ecology);

/// Returns for how long after its death a trunk of a kind is there, years: until a sixth of its mass is left.
[[nodiscard]] double years_of_decay(const StandParams& params, const TreeEcology& ecology);

/// Returns what is left of the trees of a block that died: trunks that storms felled, or snags that stand for up to 15
/// years until they fall downwind or downhill.
///
/// trees     by trees_of()
/// downwind  where the wind blows to, radians from east to north
/// returns   dead trunks by ascending ids, without those that somebody took away
[[nodiscard]] std::vector<DeadWood> dead_wood_of(const Stand& stand,
                                                 std::span<const StandTree> trees,
                                                 const FallSiteAt& site, double downwind);

}  // namespace sporeprint
