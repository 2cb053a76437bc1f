// Colonies: many individuals, few meshes.

#include <benchmark/benchmark.h>

#include "core/grow/colony.h"
#include "core/grow/colony_individuals.h"

namespace {

using namespace sporeprint;

/// 64 individuals, 8 of them distinct, on some 300 root nodes: everything made anew but the images.
void colony_on_roots(benchmark::State& state) {
    const auto atlas = built_in_atlas();
    ColonySpec spec;
    spec.mix = {{"hypholoma_fasciculare", 1000}};
    spec.params.count = 64;
    spec.params.habit = Habit::rooted;
    spec.params.growth.depth = 18;
    spec.params.growth.stem_probability = 0.35;
    spec.params.textures = Textures::none;
    spec.params.seed = 4;
    std::size_t bytes = 0;
    for (auto _ : state) bytes = size_of(grow_colony(spec, *atlas).glb);
    state.counters["individuals"] = static_cast<double>(
        colony_parts(spec, typical_individual(spec, *atlas), *atlas).members.size());
    state.counters["bytes"] = static_cast<double>(bytes);
}

void colony(benchmark::State& state, const char* id) {
    const auto atlas = built_in_atlas();
    ColonySpec spec;
    spec.mix = {{id, 1000}};
    spec.params.textures = Textures::none;
    spec.params.count = static_cast<int>(state.range(0));
    for (auto _ : state) benchmark::DoNotOptimize(grow_colony(spec, *atlas).glb.size());
}

BENCHMARK(colony_on_roots)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(colony, tuft, "armillaria_mellea")
    ->Arg(24)
    ->Arg(256)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(colony, tier, "trametes_versicolor")
    ->Arg(24)
    ->Arg(256)
    ->Unit(benchmark::kMillisecond);

}  // namespace
