// Worlds: the steps of their ground, a year of weather, and maps of a world whose ground is known.

#include <benchmark/benchmark.h>

#include "core/surface/codecs.h"
#include "core/world/drainage.h"
#include "core/world/erosion.h"
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

BENCHMARK(ground)->Name("world_ground")->Arg(0)->Arg(50)->Arg(100)->Unit(benchmark::kMillisecond);
BENCHMARK(heights)->Name("world_heights")->Unit(benchmark::kMillisecond);
BENCHMARK(erosion)->Name("world_erosion")->Unit(benchmark::kMillisecond);
BENCHMARK(drainage)->Name("world_drainage")->Unit(benchmark::kMillisecond);
BENCHMARK(weather)->Name("world_weather")->Unit(benchmark::kMicrosecond);
BENCHMARK(map)->Name("world_map")->DenseRange(0, 5)->Unit(benchmark::kMillisecond);

}  // namespace
