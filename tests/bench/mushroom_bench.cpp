// Whole mushrooms: cold, as another shape with cached images, and without images.

#include <benchmark/benchmark.h>

#include <memory>
#include <string>

#include "core/grow/mushroom.h"

namespace {

using namespace sporeprint;

MushroomSpec order_of(const std::string& id, int side) {
    MushroomSpec spec;
    spec.mix.push_back({id});
    spec.params.texture_size.value = side;
    return spec;
}

void cold(benchmark::State& state, const std::string& id, int side) {
    const auto atlas = built_in_atlas();
    MushroomSpec spec = order_of(id, side);
    std::size_t bytes = 0;
    for (auto _ : state) {
        ++spec.params.seed;
        const Mushroom generated = grow_mushroom(spec, *atlas, {"/v1/bench", {}});
        bytes = size_of(generated.glb);
    }
    state.counters["bytes"] = static_cast<double>(bytes);
}

void shape_only(benchmark::State& state, const std::string& id) {
    const auto atlas = built_in_atlas();
    MushroomSpec spec = order_of(id, 1024);
    std::shared_ptr<const ImageSet> cached;
    std::shared_ptr<const MorphSet> morphs;
    ExecutionContext execution;
    execution.caches.morphs = [&](const std::string&, const auto& make) {
        if (!morphs) morphs = make();
        return morphs;
    };
    execution.caches.images = [&](const std::string&, const auto& make) {
        if (!cached) cached = make();
        return cached;
    };
    (void)grow_mushroom(spec, *atlas, {"/v1/bench", {}}, execution);
    double bend = 0.0;
    for (auto _ : state) {
        spec.params.deformation.bend_deg = bend = bend > 20.0 ? 0.0 : bend + 0.01;
        benchmark::DoNotOptimize(grow_mushroom(spec, *atlas, {"/v1/bench", {}}, execution));
    }
}

void without_images(benchmark::State& state, const std::string& id) {
    const auto atlas = built_in_atlas();
    MushroomSpec spec = order_of(id, 1024);
    spec.params.textures = Textures::none;
    for (auto _ : state) {
        ++spec.params.seed;
        benchmark::DoNotOptimize(grow_mushroom(spec, *atlas, {"/v1/bench", {}}));
    }
}

[[maybe_unused]] const bool registered = [] {
    const auto atlas = built_in_atlas();
    for (const AtlasEntry& entry : atlas->entries()) {
        const std::string id = entry.species.id.string();
        for (const int side : {512, 1024})
            benchmark::RegisterBenchmark(("cold/" + id + "/" + std::to_string(side)).c_str(),
                                         [id, side](benchmark::State& s) { cold(s, id, side); })
                ->Unit(benchmark::kMillisecond);
        benchmark::RegisterBenchmark(("shape_only/" + id).c_str(), [id](benchmark::State& s) {
            shape_only(s, id);
        })->Unit(benchmark::kMicrosecond);
        benchmark::RegisterBenchmark(("without_images/" + id).c_str(), [id](benchmark::State& s) {
            without_images(s, id);
        })->Unit(benchmark::kMicrosecond);
    }
    return true;
}();

}  // namespace
