// Dragging on the page's morph bench, with an unbounded memory of what was made: what of each step is found again.

#include <benchmark/benchmark.h>

#include <map>
#include <memory>
#include <string>

#include "core/grow/mushroom.h"

namespace {

using namespace sporeprint;

/// Caches everything, and counts the lookups of paintings.
struct Everything {
    std::map<std::string, std::shared_ptr<const ImageSet>> images;
    std::map<std::string, std::shared_ptr<const RawImages>> paintings;
    std::map<std::string, std::shared_ptr<const MorphSet>> morphs;
    int hits = 0, misses = 0;
    ExecutionContext execution;

    Everything() {
        const auto keep = [](auto& cached, const std::string& key, const auto& make) {
            auto& one = cached[key];
            const bool hit = static_cast<bool>(one);
            if (!hit) one = make();
            return hit;
        };
        execution.caches.images = [this, keep](const std::string& key, const auto& make) {
            keep(images, key, make);
            return images[key];
        };
        execution.caches.paintings = [this, keep](const std::string& key, const auto& make) {
            ++(keep(paintings, key, make) ? hits : misses);
            return paintings[key];
        };
        execution.caches.morphs = [this, keep](const std::string& key, const auto& make) {
            keep(morphs, key, make);
            return morphs[key];
        };
    }
};

MushroomSpec order_of(int side) {
    MushroomSpec spec;
    spec.mix = {{"amanita_muscaria", 500}, {"boletus_edulis", 500}};
    spec.params.texture_size.value = side;
    spec.params.lod = 1;
    return spec;
}

/// Sixty-three steps of the weight from one species to the other, as a drag makes them; time is that of one step.
void weight(benchmark::State& state) {
    const auto atlas = built_in_atlas();
    MushroomSpec spec = order_of(static_cast<int>(2 * state.range(0)));
    double hits = 0.0, misses = 0.0;
    for (auto _ : state) {
        state.PauseTiming();
        auto memory = std::make_unique<Everything>();
        state.ResumeTiming();
        for (int step = 1; step < 64; ++step) {
            spec.mix[0].weight = 1000 - step * 1000 / 64;
            spec.mix[1].weight = step * 1000 / 64;
            benchmark::DoNotOptimize(
                grow_mushroom(spec, *atlas, {"/v1/bench", {}}, memory->execution));
        }
        state.PauseTiming();
        hits = memory->hits;
        misses = memory->misses;
        memory.reset();
        state.ResumeTiming();
    }
    state.counters["painting_hits"] = hits;
    state.counters["painting_misses"] = misses;
    state.counters["steps"] =
        benchmark::Counter(63.0, benchmark::Counter::kIsIterationInvariantRate);
}
BENCHMARK(weight)->Name("drag_of_weight")->Arg(512)->Arg(1024)->Unit(benchmark::kMillisecond);

/// Sixty-four steps of the age, first those of a lone species, then those of a mix.
void age(benchmark::State& state) {
    const auto atlas = built_in_atlas();
    MushroomSpec spec = order_of(static_cast<int>(2 * state.range(0)));
    if (state.range(1) == 1) spec.mix = {{"amanita_muscaria", 1000}};
    for (auto _ : state) {
        state.PauseTiming();
        auto memory = std::make_unique<Everything>();
        state.ResumeTiming();
        for (int step = 1; step <= 64; ++step) {
            spec.params.age = step / 64.0;
            benchmark::DoNotOptimize(
                grow_mushroom(spec, *atlas, {"/v1/bench", {}}, memory->execution));
        }
        state.PauseTiming();
        memory.reset();
        state.ResumeTiming();
    }
    state.counters["steps"] =
        benchmark::Counter(64.0, benchmark::Counter::kIsIterationInvariantRate);
}
BENCHMARK(age)
    ->Name("drag_of_age")
    ->ArgNames({"side", "species"})
    ->Args({512, 1})
    ->Args({512, 2})
    ->Unit(benchmark::kMillisecond);

}  // namespace
