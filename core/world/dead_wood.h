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

/// Orders cells from west to east, and those of a column from south to north.
struct CellOrder {
    bool operator()(CellIndex a, CellIndex b) const { return a.x != b.x ? a.x < b.x : a.y < b.y; }
};

using FallSiteAt = std::function<FallSite(WorldPoint)>;

/// Returns the length that no trunk of a stand exceeds, metres.
[[nodiscard]] double longest_trunk(const Stand& stand);

/// Returns k of the mass e^(-k t) of the thick dead trunks of a kind, per year.
[[nodiscard]] double decay_rate(const StandParams& params, const TreeEcology& ecology);

/// Returns for how long after its death a thick trunk of a kind is there, years: until a sixth of its mass is left.
[[nodiscard]] double years_of_decay(const StandParams& params, const TreeEcology& ecology);

/// A trunk that stands at a place for some time, alive or as a snag.
struct StandingTrunk {
    WorldPoint at;
    std::uint64_t tree = 0;       ///< its id
    WorldTime since = 0, to = 0;  ///< when it stands
    float radius = 0.0F;          ///< with its roots, metres
};

/// A trunk that has fallen, as it would lie if nothing had been in its way.
struct FallenTrunk {
    WorldPoint at;
    WorldTime fell = 0, gone = 0;
    std::uint64_t id = 0;
    float east = 0.0F, north = 0.0F;  ///< its top from its foot, metres
};

/// What trunks of a block and of those round it may fall on, of all times.
struct Falls {
    std::vector<StandingTrunk> standing;
    std::vector<FallenTrunk> fallen;
};

/// Returns what others may fall on of the trees of a block.
///
/// trees     by trees_of()
/// downwind  where the wind blows to, radians from east to north
[[nodiscard]] Falls falls_of(const Stand& stand, std::span<const StandTree> trees,
                             const FallSiteAt& site, double downwind);

/// Returns the dead wood of a block. Storms fell trunks, all others stand for up to 15 years as snags until they fall
/// downwind or downhill. Where it can, a trunk falls beside living trees, snags and older trunks; otherwise it breaks before
/// them. Older trunks of other blocks count as if nothing had been in their way.
///
/// trees    of the block
/// near     falls_of() the block and the eight round it
/// site     as for falls_of(), likewise `downwind`
/// returns  dead trunks by ascending ids, without those that somebody took away
[[nodiscard]] std::vector<DeadWood> dead_wood_of(const Stand& stand,
                                                 std::span<const StandTree> trees,
                                                 std::span<const Falls* const> near,
                                                 const FallSiteAt& site, double downwind);

}  // namespace sporeprint
