// Services that a pipeline gets from its caller: caches, a progress observer, an executor and a
// stop token.
#pragma once

#include <array>
#include <functional>
#include <memory>
#include <stop_token>
#include <string_view>

#include "core/get_or_compute.h"
#include "core/problems.h"
#include "core/silhouette/morph_set.h"
#include "core/surface/paint.h"

namespace sporeprint {

enum class Step { resolve, build, paint, pack, draw };
inline constexpr std::array all_steps = {Step::resolve, Step::build, Step::paint, Step::pack,
                                         Step::draw};

constexpr const char* name(Step step) {
    switch (step) {
        case Step::resolve:
            return "resolve";
        case Step::build:
            return "build";
        case Step::paint:
            return "paint";
        case Step::pack:
            return "pack";
        case Step::draw:
            return "draw";
    }
    return nullptr;
}

class Atlas;
struct Block;
struct BlockMycelia;
struct BlockSeason;
struct BodyShape;
struct Ground;
struct TerrainMap;
struct TreeMeshes;
struct World;

/// Called when a step begins. The caller measures time, core has no clock.
using Observer = std::function<void(Step)>;

/// Caches of expensive results, each kind with its own keys.
struct Caches {
    GetOrCompute<ImageSet> images = uncached<ImageSet>;
    GetOrCompute<RawImages> paintings = uncached<RawImages>;  ///< inputs of image blending
    GetOrCompute<MorphSet> morphs = uncached<MorphSet>;  ///< correspondence of a set of species
    GetOrCompute<Atlas> offspring = uncached<Atlas>;     ///< atlases of one bred species each
    /// Returns a terrain by its id, or null if it is not stored.
    std::function<std::shared_ptr<const TerrainMap>(std::string_view id)> terrain =
        [](std::string_view) { return nullptr; };
    GetOrCompute<Ground> grounds = uncached<Ground>;  ///< of worlds
    GetOrCompute<World> worlds = uncached<World>;     ///< without their blocks
    GetOrCompute<Block> blocks = uncached<Block>;     ///< of worlds
    GetOrCompute<BlockMycelia> mycelia = uncached<BlockMycelia>;
    GetOrCompute<BlockSeason> seasons = uncached<BlockSeason>;
    GetOrCompute<TreeMeshes> trees = uncached<TreeMeshes>;  ///< that stand on plots
    GetOrCompute<BodyShape> bodies = uncached<BodyShape>;   ///< mushrooms that show others on tiles
};

struct ExecutionContext {
    Caches caches;
    Observer observer = [](Step) {};
    Parallel parallel = in_turn;
    std::stop_token stop;
};

/// throws  Cancelled if a stop was requested
inline void throw_if_cancelled(const ExecutionContext& execution) {
    if (execution.stop.stop_requested()) throw Cancelled();
}

}  // namespace sporeprint
