// Worlds over their ground: the spread of species, the trees of a block, mycelia and fruit bodies, and all of that for a
// plot of a world that nobody has seen. One thread each.

#include <benchmark/benchmark.h>

#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "core/grow/world/parts.h"

namespace {

using namespace sporeprint;

const Atlas& atlas() {
    static const std::shared_ptr<const Atlas> atlas = built_in_atlas();
    return *atlas;
}

WorldParams beech(std::uint32_t seed = 7) {
    WorldParams params = params_of(*atlas().find_world("beech"));
    params.seed = seed;
    return params;
}

const std::shared_ptr<const Ground>& ground() {
    static const auto ground = std::make_shared<const Ground>(ground_of(beech()));
    return ground;
}

const World& world() {
    static const World world = world_of(beech(), lookup_in(atlas()), ground());
    return world;
}

/// Blocks without bound, nothing else.
ExecutionContext with_blocks() {
    ExecutionContext execution;
    auto cache = std::make_shared<std::map<std::string, std::shared_ptr<const Block>>>();
    execution.caches.blocks = [cache](const std::string& key, const auto& make) {
        std::shared_ptr<const Block>& value = (*cache)[key];
        if (!value) value = make();
        return value;
    };
    return execution;
}

constexpr WorldBox plot{-5.0, -5.0, 5.0, 5.0};

/// What is computed of a world over its ground, with twelve species.
void over_ground(benchmark::State& state) {
    const WorldLookup lookup = lookup_in(atlas());
    const std::shared_ptr<const Ground> below = ground();
    for (auto _ : state) benchmark::DoNotOptimize(world_of(beech(), lookup, below));
}

/// One or four species at once.
void spread(benchmark::State& state) {
    const WindCover cover{.closure = 1.0, .crown_top = 30.0};
    static const SpreadGround on = spread_ground(*ground(), beech().climate, cover);
    const std::vector<double> suits(on.grid.nodes(), 1.0);
    const std::vector<Founder> founders = founders_of(on.grid, 7, 1, suits);
    const std::vector<Spreading> species(static_cast<std::size_t>(state.range(0)),
                                         {world().species[0].ecology.spores, suits, founders});
    for (auto _ : state) benchmark::DoNotOptimize(spread_together(on, species));
}

/// Trees and dead wood of a block.
void block(benchmark::State& state) {
    std::int32_t number = 0;
    for (auto _ : state) {
        benchmark::DoNotOptimize(block_of(world(), {number % 7 - 3, number / 7 % 7 - 3}));
        ++number;
    }
}

/// Mycelia of a block in an epoch, its trees known.
void mycelia(benchmark::State& state) {
    const ExecutionContext execution = with_blocks();
    for (auto _ : state) benchmark::DoNotOptimize(mycelia_of_world(world(), {0, 0}, 2, execution));
}

/// The fruit bodies of a block or of a plot at some time of a year, the trees known.
void season(benchmark::State& state) {
    const ExecutionContext execution = with_blocks();
    const bool is_block = state.range(0) == block_side;
    for (auto _ : state) {
        if (is_block)
            benchmark::DoNotOptimize(season_of_world(world(), {0, 0}, 90, execution));
        else
            benchmark::DoNotOptimize(bodies_of_year(world(), plot, 90, execution));
    }
}

/// A plot with its trees and fruit bodies, from nothing at all; the ground alone for comparison.
void never_seen(benchmark::State& state) {
    const WorldLookup lookup = lookup_in(atlas());
    std::uint32_t seed = 100;
    for (auto _ : state) {
        const WorldParams params = beech(++seed);
        auto of = std::make_shared<const Ground>(ground_of(params));
        if (state.range(0) == 0) continue;
        const World here = world_of(params, lookup, std::move(of));
        const ExecutionContext execution = with_blocks();
        benchmark::DoNotOptimize(blocks_round(here, plot, execution));
        benchmark::DoNotOptimize(bodies_in(here, plot, time_of(80, 270), execution));
    }
    state.SetLabel(state.range(0) == 0 ? "ground alone" : "plot of 10 m");
}

BENCHMARK(over_ground)->Name("world_over_ground")->Unit(benchmark::kMillisecond);
BENCHMARK(spread)->Name("world_spread")->Arg(1)->Arg(4)->Unit(benchmark::kMillisecond);
BENCHMARK(block)->Name("world_block")->Unit(benchmark::kMillisecond);
BENCHMARK(mycelia)->Name("world_mycelia")->Unit(benchmark::kMillisecond);
BENCHMARK(season)->Name("world_season")->Arg(64)->Arg(10)->Unit(benchmark::kMillisecond);
BENCHMARK(never_seen)->Name("world_never_seen")->Arg(0)->Arg(1)->Unit(benchmark::kMillisecond);

}  // namespace
