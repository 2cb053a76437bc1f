// Tiles of a world whose ground, blocks, seasons and shapes are known, one thread: whole tiles of each layer and size,
// and the stages of the ground. `bytes` is the size of the file, in kB.

#include <benchmark/benchmark.h>

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/grow/tree.h"
#include "core/grow/world/parts.h"
#include "core/grow/world/plot_bodies.h"
#include "core/grow/world/plot_of_world.h"
#include "core/grow/world/tile.h"
#include "core/grow/world/tile_ground.h"
#include "core/world/canopy_light.h"

namespace {

using namespace sporeprint;

const Atlas& atlas() {
    static const std::shared_ptr<const Atlas> atlas = built_in_atlas();
    return *atlas;
}

const std::shared_ptr<const World>& world() {
    static const auto world = [] {
        WorldParams params = params_of(*atlas().find_world("mixed"));
        params.seed = 7;
        return std::make_shared<const World>(world_of(
            params, lookup_in(atlas()), std::make_shared<const Ground>(ground_of(params))));
    }();
    return world;
}

/// Caches without bound of all that tiles share.
const ExecutionContext& with_parts() {
    static const ExecutionContext execution = [] {
        ExecutionContext out;
        const auto cached = [](auto& cache) {
            cache = [known =
                         std::make_shared<std::map<std::string, decltype(cache("", nullptr))>>()](
                        const std::string& key, const auto& make) {
                auto& value = (*known)[key];
                if (!value) value = make();
                return value;
            };
        };
        cached(out.caches.blocks);
        cached(out.caches.mycelia);
        cached(out.caches.seasons);
        cached(out.caches.trees);
        cached(out.caches.bodies);
        cached(out.caches.morphs);
        return out;
    }();
    return execution;
}

const TileLinks& links() {
    static const TileLinks links = [] {
        const ImageUrls urls{{"c.jpg", "n.jpg", "o.jpg"}, {"c.webp", "n.webp", "o.webp"}};
        TileLinks out;
        out.tree = [](const TreeSpec& spec) { return spec.preset + ".bin"; };
        out.mushroom = [](const MushroomSpec& spec) { return spec.mix.front().id + ".bin"; };
        out.bark = [urls](const TreeSpec&) { return urls; };
        out.leaves = [urls](const std::string&, const LeafPaint&) { return urls; };
        out.skin = [urls](const MushroomSpec&) { return urls; };
        out.wood = [urls](const WoodPaint&) { return urls; };
        return out;
    }();
    return links;
}

constexpr WorldTime autumn = time_of(80, 270);

/// Returns the level of the tiles of a size.
int level_of(double side) {
    const Tiling tiling{1024};
    int level = 0;
    while (tiling.side(level) > side) ++level;
    return level;
}

/// Returns one of four tiles near the centre of the world.
TileIndex tile_near(double side, int number) {
    const int level = level_of(side), middle = (1 << level) / 2;
    if (level == 0) return {};
    return {level, middle - number % 2, middle - number / 2 % 2};
}

/// A whole tile, in turn one of four.
void tile(benchmark::State& state) {
    const auto layer = static_cast<PlotLayer>(state.range(0));
    const auto side = static_cast<double>(state.range(1));
    std::size_t bytes = 0;
    const auto grown = [&](int number) {
        const TileRequest request{Tiling{1024}, tile_near(side, number), layer, TileProfile::web,
                                  autumn};
        return grow_tile(world(), request, atlas(), links(), {}, with_parts()).glb;
    };
    for (int number = 0; number < 4; ++number)
        for (const Slice& slice : grown(number)) bytes += slice.size;
    int number = 0;
    for (auto _ : state) benchmark::DoNotOptimize(grown(number++));
    state.SetLabel(name(layer));
    state.counters["bytes"] = static_cast<double>(bytes) / 4000.0;
}

/// The ground of a tile with all that it depends on.
struct GroundContent {
    Block around;
    std::optional<CanopyLight> canopy;
    PlotContent content;

    explicit GroundContent(double side) {
        const WorldBox box = Tiling{1024}.box(tile_near(side, 0));
        content = content_of(
            *world(), {0.5 * (box.west + box.east), 0.5 * (box.south + box.north), side}, autumn);
        if (side > coarsest_of_trees) return;
        around = present_round(*world(), box, autumn, with_parts());
        content.trees = around.trees;
        canopy.emplace(
            crowns_in(*world(), around.trees, grown(box, plot_margin + shade_reach), autumn));
        content.light = light_below(*world(), *canopy);
    }
    GroundContent(const GroundContent&) = delete;
    GroundContent& operator=(const GroundContent&) = delete;
    ~GroundContent() = default;
};

/// What stands round a tile, and the light that it leaves.
void surroundings(benchmark::State& state) {
    for (auto _ : state)
        benchmark::DoNotOptimize(GroundContent(static_cast<double>(state.range(0))));
}

/// What covers a tile.
void cover(benchmark::State& state) {
    const auto side = static_cast<double>(state.range(0));
    const GroundContent known(side);
    for (auto _ : state)
        benchmark::DoNotOptimize(cover_of(known.content, atlas(), cover_step_of_tile(side)));
}

/// Cover and images before they are encoded.
void images(benchmark::State& state) {
    const GroundContent known(static_cast<double>(state.range(0)));
    for (auto _ : state)
        benchmark::DoNotOptimize(TileGround(*world(), known.content).images(atlas()));
}

/// The same with their files.
void files(benchmark::State& state) {
    const GroundContent known(static_cast<double>(state.range(0)));
    double bytes = 0.0;
    for (auto _ : state) {
        const ImageSet set = TileGround(*world(), known.content).files(atlas());
        bytes = static_cast<double>(set.bytes());
    }
    state.counters["bytes"] = bytes / 1000.0;
}

/// The heights and the mesh of a tile.
void slab(benchmark::State& state) {
    const GroundContent known(static_cast<double>(state.range(0)));
    const PlotContent& content = known.content;
    for (auto _ : state) {
        const std::vector<TreeFoot> feet = feet_of(content);
        const FloorHeights floor(*content.ground, content.seed, content.micro, feet);
        benchmark::DoNotOptimize(TileGround(*world(), content).slab(floor, 0.0));
    }
}

void sizes(benchmark::internal::Benchmark* one) {
    one->Arg(8)->Arg(16)->Arg(64)->Arg(128)->Arg(1024)->Unit(benchmark::kMillisecond);
}

BENCHMARK(tile)
    ->Name("tile")
    ->ArgsProduct({{static_cast<int>(PlotLayer::ground)}, {8, 16, 32, 64, 128, 1024}})
    ->ArgsProduct({{static_cast<int>(PlotLayer::trees)}, {8, 16, 32, 128}})
    ->ArgsProduct({{static_cast<int>(PlotLayer::floor), static_cast<int>(PlotLayer::fungi)},
                   {8, 16, 32}})
    ->Unit(benchmark::kMillisecond);
BENCHMARK(surroundings)->Name("tile_surroundings")->Apply(sizes);
BENCHMARK(cover)->Name("tile_cover")->Apply(sizes);
BENCHMARK(images)->Name("tile_ground_images")->Apply(sizes);
BENCHMARK(files)->Name("tile_ground_files")->Apply(sizes);
BENCHMARK(slab)->Name("tile_ground_slab")->Apply(sizes);

}  // namespace
