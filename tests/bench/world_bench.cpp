// Worlds: the steps of their ground, a year of weather, the floor of a plot, and maps of a world whose ground is known.

#include <benchmark/benchmark.h>

#include "core/atlas/atlas.h"
#include "core/surface/codecs.h"
#include "core/world/drainage.h"
#include "core/world/erosion.h"
#include "core/world/floor_image.h"
#include "core/world/maps.h"
#include "core/world/weather.h"

namespace {

using namespace sporeprint;

WorldParams eroded_by(double strength) {
    WorldParams params;
    params.terrain.erosion = strength;
    return params;
}

/// The whole ground; erosion in percent.
void ground(benchmark::State& state) {
    WorldParams params = eroded_by(static_cast<double>(state.range(0)) / 100.0);
    for (auto _ : state) {
        ++params.seed;
        benchmark::DoNotOptimize(ground_of(params));
    }
}

void heights(benchmark::State& state) {
    const WorldParams params;
    for (auto _ : state)
        benchmark::DoNotOptimize(heights_of(params.terrain, params.seed, params.extent));
}

void erosion(benchmark::State& state) {
    const WorldParams params;
    const Grid grid = world_grid(params.extent);
    const auto before = heights_of(params.terrain, params.seed, params.extent);
    for (auto _ : state) benchmark::DoNotOptimize(eroded(grid, before, 0.5));
}

/// Flood, multiple flow and wetness index.
void drainage(benchmark::State& state) {
    const WorldParams params;
    const Grid grid = world_grid(params.extent);
    const auto above = eroded(grid, heights_of(params.terrain, params.seed, params.extent), 0.5);
    for (auto _ : state) {
        const FloodedGround flood = flooded(grid, above);
        benchmark::DoNotOptimize(wetness_index(grid, flood, catchments(grid, flood)));
    }
}

void weather(benchmark::State& state) {
    const WorldParams params;
    int year = 0;
    for (auto _ : state) {
        benchmark::DoNotOptimize(weather_of(params.climate, params.seed, year));
        year = (year + 1) % (last_year + 1);
    }
}

/// A map of 512 x 512 places as a PNG file, on one thread.
void map(benchmark::State& state) {
    static const Ground ground = ground_of(eroded_by(0.5));
    const auto kind = static_cast<WorldMap>(state.range(0));
    const MapFrame frame = frame_of({-512.0, -512.0, 512.0, 512.0}, 512);
    for (auto _ : state)
        benchmark::DoNotOptimize(
            png_of_numbers(map_of(kind, {.ground = ground, .soil_water = 60.0}, frame), frame.width,
                           frame.height, {}));
    state.SetLabel(name(kind));
}

/// The images of the floor of a plot of 10 m below oaks and spruces, beside a meadow.
void floor(benchmark::State& state) {
    const Atlas& atlas = *built_in_atlas();
    std::vector<LeafLitter> kinds;
    for (const char* id : {"oak", "needle"}) {
        const LeafPreset* const preset = atlas.find_leaf(id);
        kinds.push_back({preset->shape, preset->palette});
    }
    const WorldBox box{-5.0, -5.0, 5.0, 5.0};
    const CoverField cover = cover_field(box, floor_margin, [](double x, double y) {
        CoverConditions at;
        at.light = 0.5 + 0.08 * x;
        at.wetness = 0.5 + 0.05 * y;
        at.fall = {0.35 - 0.05 * x, 0.35 - 0.05 * y};
        at.has_needles[1] = true;
        return cover_of(at);
    });
    FloorPaint paint;
    paint.box = box;
    paint.side = static_cast<int>(state.range(0));
    paint.kinds = kinds;
    paint.cover = &cover;
    for (auto _ : state) benchmark::DoNotOptimize(floor_images(paint));
}

BENCHMARK(ground)->Name("world_ground")->Arg(0)->Arg(50)->Arg(100)->Unit(benchmark::kMillisecond);
BENCHMARK(heights)->Name("world_heights")->Unit(benchmark::kMillisecond);
BENCHMARK(erosion)->Name("world_erosion")->Unit(benchmark::kMillisecond);
BENCHMARK(drainage)->Name("world_drainage")->Unit(benchmark::kMillisecond);
BENCHMARK(weather)->Name("world_weather")->Unit(benchmark::kMicrosecond);
BENCHMARK(floor)->Name("world_floor")->Arg(512)->Arg(1024)->Unit(benchmark::kMillisecond);
BENCHMARK(map)->Name("world_map")->DenseRange(0, 5)->Unit(benchmark::kMillisecond);

}  // namespace
