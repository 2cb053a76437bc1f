// Whole mushrooms: cold, as another shape with cached images, and without images.

#include <benchmark/benchmark.h>

#include <memory>
#include <string>

#include "core/grow/mushroom.h"

namespace {

using namespace sporeprint;

MushroomOrder order_of(const std::string& id, int side) {
    MushroomOrder order;
    order.mix.push_back({id});
    order.params.texture_size.value = side;
    return order;
}

void cold(benchmark::State& state, const std::string& id, int side) {
    const auto atlas = built_in_atlas();
    MushroomOrder order = order_of(id, side);
    std::size_t bytes = 0;
    for (auto _ : state) {
        ++order.params.seed;
        const Mushroom made = grow_mushroom(order, *atlas, {"/v1/bench", {}});
        bytes = size_of(made.glb);
    }
    state.counters["bytes"] = static_cast<double>(bytes);
}

void shape_only(benchmark::State& state, const std::string& id) {
    const auto atlas = built_in_atlas();
    MushroomOrder order = order_of(id, 1024);
    std::shared_ptr<const ImageSet> kept;
    std::shared_ptr<const MorphSet> morphs;
    Workshop workshop;
    workshop.memo.morphs = [&](const std::string&, const auto& make) {
        if (!morphs) morphs = make();
        return morphs;
    };
    workshop.memo.images = [&](const std::string&, const auto& make) {
        if (!kept) kept = make();
        return kept;
    };
    (void)grow_mushroom(order, *atlas, {"/v1/bench", {}}, workshop);
    double bend = 0.0;
    for (auto _ : state) {
        order.params.deformation.bend_deg = bend = bend > 20.0 ? 0.0 : bend + 0.01;
        benchmark::DoNotOptimize(grow_mushroom(order, *atlas, {"/v1/bench", {}}, workshop));
    }
}

void without_images(benchmark::State& state, const std::string& id) {
    const auto atlas = built_in_atlas();
    MushroomOrder order = order_of(id, 1024);
    order.params.textures = Textures::none;
    for (auto _ : state) {
        ++order.params.seed;
        benchmark::DoNotOptimize(grow_mushroom(order, *atlas, {"/v1/bench", {}}));
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
