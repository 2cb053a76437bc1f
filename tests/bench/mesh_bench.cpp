// Geometry alone: the mesh of each species at each level of detail, and the parts it is made of.

#include <benchmark/benchmark.h>

#include <string>

#include "core/grow/mushroom.h"
#include "core/silhouette/outline.h"
#include "tests/support/glb_parts.h"

namespace {

using namespace sporeprint;

MushroomSpec order_of(const std::string& id, int lod) {
    MushroomSpec spec;
    spec.mix.push_back({id});
    spec.params.lod = lod;
    spec.params.textures = Textures::linked;  // texture coordinates and tangents, no painting
    return spec;
}

void mesh(benchmark::State& state, const std::string& id, int lod) {
    const auto atlas = built_in_atlas();
    const MushroomSpec spec = order_of(id, lod);
    const Individual individual = resolve(spec, *atlas);
    std::size_t triangles = 0;
    for (auto _ : state) {
        const Mesh generated = mushroom_mesh(spec, individual);
        triangles = generated.triangles();
        benchmark::DoNotOptimize(generated.positions.data());
    }
    state.counters["triangles"] = static_cast<double>(triangles);
}

void resolved(benchmark::State& state, const std::string& id) {
    const auto atlas = built_in_atlas();
    const MushroomSpec spec = order_of(id, 0);
    for (auto _ : state) benchmark::DoNotOptimize(resolve(spec, *atlas));
}

void outlined(benchmark::State& state, const std::string& id) {
    const auto atlas = built_in_atlas();
    const Individual individual = resolve(order_of(id, 0), *atlas);
    const auto& silhouette = std::get<Swept>(individual.parts[0].model.shape).silhouette;
    for (auto _ : state) benchmark::DoNotOptimize(Outline(silhouette));
}

void packed(benchmark::State& state, const std::string& id) {
    const auto atlas = built_in_atlas();
    const MushroomSpec spec = order_of(id, 0);
    const Mesh generated = mushroom_mesh(spec, resolve(spec, *atlas));
    const GlbParts parts{
        .name = id, .images = nullptr, .image_urls = {"a", "b", "c"}, .extras_json = "{}"};
    for (auto _ : state) benchmark::DoNotOptimize(glb(generated, parts));
}

[[maybe_unused]] const bool registered = [] {
    const auto atlas = built_in_atlas();
    for (const AtlasEntry& entry : atlas->entries()) {
        const std::string id = entry.species.id.string();
        for (int lod = 0; lod < 4; ++lod)
            benchmark::RegisterBenchmark(("mesh/" + id + "/lod" + std::to_string(lod)).c_str(),
                                         [id, lod](benchmark::State& s) { mesh(s, id, lod); })
                ->Unit(benchmark::kMicrosecond);
        benchmark::RegisterBenchmark(("resolve/" + id).c_str(), [id](benchmark::State& s) {
            resolved(s, id);
        })->Unit(benchmark::kMicrosecond);
        if (std::holds_alternative<Swept>(entry.species.stages.front().model.shape))
            benchmark::RegisterBenchmark(("outline/" + id).c_str(), [id](benchmark::State& s) {
                outlined(s, id);
            })->Unit(benchmark::kMicrosecond);
        benchmark::RegisterBenchmark(("pack/" + id).c_str(), [id](benchmark::State& s) {
            packed(s, id);
        })->Unit(benchmark::kMicrosecond);
    }
    return true;
}();

}  // namespace
