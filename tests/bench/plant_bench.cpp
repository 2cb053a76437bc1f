// Leaves, trees and root systems: meshes alone, without paint.

#include <benchmark/benchmark.h>

#include "core/colony/root_system.h"
#include "core/plant/leaf_image.h"
#include "core/plant/tree.h"
#include "core/skeleton/skin.h"
#include "tests/support/atlas.h"

namespace {

using namespace sporeprint;

void leaf(benchmark::State& state) {
    const LeafPreset& preset = leaf_presets()[static_cast<std::size_t>(state.range(0))];
    state.SetLabel(preset.id.string());
    for (auto _ : state) benchmark::DoNotOptimize(leaf_mesh(preset.shape, 0).positions.data());
}
BENCHMARK(leaf)->DenseRange(0, 6)->Unit(benchmark::kMicrosecond);

// Both faces and the petiole, three images of 1024, not encoded.
void leaf_painting(benchmark::State& state) {
    const LeafPreset& preset = leaf_presets()[static_cast<std::size_t>(state.range(0))];
    state.SetLabel(preset.id.string());
    for (auto _ : state)
        benchmark::DoNotOptimize(
            leaf_images(preset.shape, preset.palette, 0.5, 1, 1024).rgb[0].data());
}
BENCHMARK(leaf_painting)->DenseRange(0, 6)->Unit(benchmark::kMillisecond);

// Order 7, 2,731 twigs: skeleton, bark at the finest level, one leaf to a twig.
void tree_of_order_7(benchmark::State& state) {
    TreeShape shape = tree_preset("broadleaf")->shape;
    shape.topology.matrix = MatrixKind::random_binary;
    shape.topology.blend = 0.0;
    const Mesh foliage = foliage_leaf(leaf_preset("oak")->shape);
    std::size_t triangles = 0;
    for (auto _ : state) {
        const Tree tree = grown_tree(shape, 1);
        const Mesh bark = bark_of(tree, static_cast<int>(state.range(0))).mesh;
        const Mesh leaves = merged_leaves(placed_leaves(tree, {.per_tip = 1}, 1), foliage);
        triangles = bark.triangles() + leaves.triangles();
        benchmark::DoNotOptimize(leaves.positions.data());
    }
    state.counters["triangles"] = static_cast<double>(triangles);
}
BENCHMARK(tree_of_order_7)->DenseRange(0, tree_lods - 1)->Unit(benchmark::kMillisecond);

void skin_of_a_root_system(benchmark::State& state) {
    for (auto _ : state) {
        const ColonySkeleton colony = colony_skeleton({}, 1);
        benchmark::DoNotOptimize(
            skinned(cleaned(colony.skeleton).skeleton, 2).mesh.positions.data());
    }
}
BENCHMARK(skin_of_a_root_system)->Unit(benchmark::kMillisecond);

}  // namespace
