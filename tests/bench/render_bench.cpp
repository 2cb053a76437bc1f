// Pictures: a mushroom, a colony and a tree that are grown already, drawn on one thread.

#include <benchmark/benchmark.h>

#include <cstdint>
#include <functional>

#include "core/grow/colony.h"
#include "core/grow/mushroom.h"
#include "core/grow/tree.h"
#include "core/render/render.h"
#include "tests/support/atlas.h"

namespace sporeprint {
namespace {

/// Draws the scene that `grow` writes, with images of the level of detail decoded each time.
void draw(benchmark::State& state, int side, const std::function<void(const Extras&)>& grow) {
    PictureParams params;
    params.width = params.height = side;
    Extras extras;
    extras.write = [&](const GlbScene& scene, const Parallel&) -> Body {
        for (auto _ : state) benchmark::DoNotOptimize(rendered_png(scene, params));
        return {};
    };
    grow(extras);
}

/// Arguments: level of detail, side of the picture.
void picture_of_mushroom(benchmark::State& state) {
    MushroomSpec spec;
    spec.mix.push_back({"amanita_muscaria"});
    spec.params.lod = static_cast<int>(state.range(0));
    draw(state, static_cast<int>(state.range(1)),
         [&](const Extras& extras) { (void)grow_mushroom(spec, *built_in_atlas(), extras); });
}
BENCHMARK(picture_of_mushroom)
    ->Args({1, 256})
    ->Args({0, 256})
    ->Args({0, 512})
    ->Args({0, 1024})
    ->Unit(benchmark::kMillisecond);

void picture_of_colony(benchmark::State& state) {
    ColonySpec spec;
    spec.mix.push_back({"hypholoma_fasciculare"});
    spec.params.lod = 1;
    draw(state, 256,
         [&](const Extras& extras) { (void)grow_colony(spec, *built_in_atlas(), extras); });
}
BENCHMARK(picture_of_colony)->Unit(benchmark::kMillisecond);

void picture_of_tree(benchmark::State& state) {
    TreeSpec spec{"broadleaf", params_of(*tree_preset("broadleaf"))};
    spec.params.lod = 1;
    draw(state, 256, [&](const Extras& extras) { (void)grow_tree(spec, atlas(), extras, {}, {}); });
}
BENCHMARK(picture_of_tree)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace sporeprint
