// The parts of a world that several products need, each computed once and cached: blocks of trees, mycelia, seasons.
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "core/atlas/atlas.h"
#include "core/grow/execution_context.h"
#include "core/world/season.h"
#include "core/world/world.h"

namespace sporeprint {

/// Returns how a world finds what an atlas has, which must outlive the result.
[[nodiscard]] WorldLookup lookup_in(const Atlas& atlas);

/// Returns the trees of a block, without its dead wood: cached in execution.caches or computed now.
[[nodiscard]] std::shared_ptr<const Block> trees_of_world(const World& world, CellIndex block,
                                                          const ExecutionContext& execution);

/// Returns the dead wood of a block, without its trees: cached or computed now, from the trees of the blocks about it.
[[nodiscard]] std::shared_ptr<const Block> wood_of_world(const World& world, CellIndex block,
                                                         const ExecutionContext& execution);

/// Returns the mycelia of a block in an epoch, cached or computed now.
[[nodiscard]] std::shared_ptr<const BlockMycelia> mycelia_of_world(
    const World& world, CellIndex block, int epoch, const ExecutionContext& execution);

/// Returns the fruit bodies that stand in a block at some time of a year: those of the year and those of the year
/// before that still stand. Cached or computed now.
///
/// cost  0.1 s where nothing is known of the surroundings, 5 ms where the trees are
[[nodiscard]] std::shared_ptr<const BlockSeason> season_of_world(const World& world,
                                                                 CellIndex block, int year,
                                                                 const ExecutionContext& execution);

/// Returns the trees and the dead wood of the blocks whose crowns may shade a rectangle or the ground near it, or whose
/// trunks may lie in it, by ascending ids.
[[nodiscard]] Block blocks_round(const World& world, const WorldBox& box,
                                 const ExecutionContext& execution);

/// Returns what of that is there at a moment: trees that live, trunks that stand or lie. What is there at other times is
/// many times as much.
[[nodiscard]] Block present_round(const World& world, const WorldBox& box, WorldTime time,
                                  const ExecutionContext& execution);

/// Returns the trees of blocks_round() and of present_round() alone, which costs a third less where nothing is known.
[[nodiscard]] std::vector<StandTree> trees_round(const World& world, const WorldBox& box,
                                                 const ExecutionContext& execution);
[[nodiscard]] std::vector<StandTree> living_round(const World& world, const WorldBox& box,
                                                  WorldTime time,
                                                  const ExecutionContext& execution);

/// Returns the rectangle of a region or of a block.
[[nodiscard]] WorldBox box_of(const Region& region);

/// Returns how the weather of a year of a world allows its species to fruit; year 0 is also the one before it.
[[nodiscard]] SeasonConditions conditions_in(const World& world, int year);

/// Computes the blocks on which the fruit bodies in a rectangle depend, in parallel, so that they are cached.
void compute_surroundings(const World& world, const WorldBox& box,
                          const ExecutionContext& execution);

/// Calls a function with what the fruit bodies of a rectangle depend on in a year, which lives as long as the call.
void with_surroundings(const World& world, const Region& region, int year,
                       const ExecutionContext& execution,
                       const std::function<void(const Fungi&, const RegionYear&)>& use);

/// Returns the fruit bodies in a rectangle that stand at some time of a year, by ascending ids. What they depend on is
/// computed in parallel, and only as far away as it has influence.
[[nodiscard]] std::vector<FruitBody> bodies_of_year(const World& world, const WorldBox& box,
                                                    int year, const ExecutionContext& execution);

/// Returns the fruit bodies in a rectangle at a moment, by ascending ids.
[[nodiscard]] std::vector<FruitBody> bodies_in(const World& world, const WorldBox& box,
                                               WorldTime time, const ExecutionContext& execution);

}  // namespace sporeprint
