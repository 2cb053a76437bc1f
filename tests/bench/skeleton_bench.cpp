// Skins of branching shapes: a wandering root system with side branches, as many nodes as the argument says.

#include <benchmark/benchmark.h>

#include <cmath>
#include <vector>

#include "core/gltf/glb.h"
#include "core/math/random.h"
#include "core/ramification/ramification.h"
#include "core/skeleton/skin.h"
#include "tests/support/glb_parts.h"

namespace {

using namespace sporeprint;

Skeleton roots(std::uint32_t nodes) {
    Random random(5, 1);
    Skeleton skeleton{{{{0, 0, 0}, 0.01}}, {}};
    std::vector<double> headings = {0.0};
    for (std::uint32_t i = 1; i < nodes; ++i) {
        const double goes_on = random.uniform(), from = random.uniform(), turn = random.symmetric();
        const auto parent = goes_on < 0.8 ? i - 1 : static_cast<std::uint32_t>(from * i);
        headings.push_back(headings[parent] + (goes_on < 0.8 ? 0.4 : 3.1) * turn);
        skeleton.nodes.push_back(
            {skeleton.nodes[parent].place +
                 0.08 * glm::dvec3(std::cos(headings.back()), 0.0, std::sin(headings.back())),
             0.01});
        skeleton.segments.push_back({parent, i});
    }
    return skeleton;
}

void skin_of_roots(benchmark::State& state) {
    const Skeleton skeleton = roots(static_cast<std::uint32_t>(state.range(0)));
    std::size_t triangles = 0;
    for (auto _ : state) {
        const SkinnedSkeleton generated = skinned(cleaned(skeleton).skeleton, 2);
        triangles = generated.mesh.triangles();
        benchmark::DoNotOptimize(generated.mesh.positions.data());
    }
    state.counters["triangles"] = static_cast<double>(triangles);
    state.SetComplexityN(state.range(0));
}
BENCHMARK(skin_of_roots)
    ->Arg(1000)
    ->Arg(5000)
    ->Arg(10000)
    ->Unit(benchmark::kMillisecond)
    ->Complexity();

// What Blender's Skin and Subdivision modifiers and its glTF exporter do to the same graph (README.md has the figures).
void skeleton_to_glb(benchmark::State& state) {
    const Skeleton skeleton = roots(static_cast<std::uint32_t>(state.range(0)));
    std::size_t bytes = 0;
    for (auto _ : state) {
        const SkinnedSkeleton generated =
            skinned(cleaned(skeleton).skeleton, 2, SkinPlaces::omitted);
        bytes =
            size_of(glb(generated.mesh, {.name = "roots", .image_urls = {}, .extras_json = {}}));
    }
    state.counters["bytes"] = static_cast<double>(bytes);
}
BENCHMARK(skeleton_to_glb)->Arg(1000)->Arg(5000)->Unit(benchmark::kMillisecond);

void exact_tree(benchmark::State& state) {
    const RamificationMatrix matrix = random_binary_matrix(7);
    for (auto _ : state)
        benchmark::DoNotOptimize(exact_ramification(matrix, 7, 1, 100'000).nodes.data());
}
BENCHMARK(exact_tree)->Unit(benchmark::kMicrosecond);

}  // namespace
