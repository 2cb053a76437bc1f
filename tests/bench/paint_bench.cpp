// How long painting takes: plain and with every feature, by side, clean and worn, and with each instruction set.
#include <benchmark/benchmark.h>

#include <cstdint>
#include <string>
#include <vector>

#include "core/grow/painting.h"
#include "core/math/noise.h"
#include "core/surface/codecs.h"
#include "core/surface/image_blend.h"
#include "core/surface/paint.h"

namespace {

using namespace sporeprint;

// A fly agaric: ramp, streaks, striae, warts, gills in two tiers, a fibrous stem.
PaintParams fly_agaric(int side) {
    PaintParams params;
    params.seed = 7;
    params.side = side;
    params.metrics.cap_radius = quantised_length(0.065);
    params.metrics.cap_arc = quantised_length(0.078);
    params.metrics.hymenium_arc = quantised_length(0.055);
    params.metrics.hymenium_inner = quantised_length(0.01);
    params.metrics.stem_length = quantised_length(0.14);
    params.metrics.stem_radius = quantised_length(0.011);
    CapSurface& cap = params.surface.cap;
    cap.ramp = {{190, 18, 25}, {200, 22, 29}, {204, 36, 32}, {222, 68, 38}};
    cap.streaks = 0.15;
    cap.striae = 0.08;
    params.hymenium.blades = 130;
    params.hymenium.tiers = 2;
    params.warts.count = 95;
    params.warts.size = 0.06;
    params.ornaments.warts = 1.0;
    return params;
}

// A penny bun: pores and a net, the two dearest patterns.
PaintParams penny_bun(int side) {
    PaintParams params = fly_agaric(side);
    params.warts.count = 0;
    params.surface.hymenium.pattern = HymeniumPattern::pores;
    params.surface.stem.net = 0.7;
    return params;
}

void paint_pixels(benchmark::State& state) {
    const PaintParams params = fly_agaric(static_cast<int>(state.range(0)));
    for (auto _ : state) benchmark::DoNotOptimize(paint_raw(params));
    state.counters["texels_per_second"] =
        benchmark::Counter(static_cast<double>(state.range(0) * state.range(0)),
                           benchmark::Counter::kIsIterationInvariantRate);
}
BENCHMARK(paint_pixels)->Arg(256)->Arg(512)->Arg(1024)->Arg(2048)->Unit(benchmark::kMillisecond);

void paint_and_encode(benchmark::State& state) {
    const PaintParams params = fly_agaric(static_cast<int>(state.range(0)));
    std::size_t bytes = 0;
    for (auto _ : state) bytes = paint(params).bytes();
    state.counters["bytes"] = static_cast<double>(bytes);
}
BENCHMARK(paint_and_encode)
    ->Arg(256)
    ->Arg(512)
    ->Arg(1024)
    ->Arg(2048)
    ->Unit(benchmark::kMillisecond);

void paint_and_encode_pores_and_net(benchmark::State& state) {
    const PaintParams params = penny_bun(static_cast<int>(state.range(0)));
    for (auto _ : state) benchmark::DoNotOptimize(paint(params).bytes());
}
BENCHMARK(paint_and_encode_pores_and_net)->Arg(512)->Arg(1024)->Unit(benchmark::kMillisecond);

void encode_alone(benchmark::State& state) {
    const int side = static_cast<int>(state.range(0));
    const RawImages images = paint_raw(fly_agaric(side));
    for (auto _ : state) {
        benchmark::DoNotOptimize(jpeg(images.rgb[0], side, side, 88, Chroma::halved));
        benchmark::DoNotOptimize(jpeg(images.rgb[1], side, side, 92, Chroma::full));
        benchmark::DoNotOptimize(jpeg(images.rgb[2], side, side, 88, Chroma::halved));
    }
}
BENCHMARK(encode_alone)->Arg(512)->Arg(1024)->Unit(benchmark::kMillisecond);

// Two cached paintings, blended to the encoded set; and the blend alone.
void blend_and_encode(benchmark::State& state) {
    const RawImages a = paint_raw(fly_agaric(static_cast<int>(state.range(0))));
    const RawImages b = paint_raw(penny_bun(static_cast<int>(state.range(0))));
    const RawImages* const paintings[] = {&a, &b};
    const double weights[] = {0.375, 0.625};
    for (auto _ : state) benchmark::DoNotOptimize(blend_images(paintings, weights).bytes());
}
BENCHMARK(blend_and_encode)->Arg(256)->Arg(512)->Arg(1024)->Unit(benchmark::kMillisecond);

void blend_pixels(benchmark::State& state) {
    const RawImages a = paint_raw(fly_agaric(512));
    const RawImages b = paint_raw(penny_bun(512));
    const std::size_t count = static_cast<std::size_t>(state.range(0));
    std::vector<const RawImages*> paintings;
    for (std::size_t i = 0; i < count; ++i) paintings.push_back(i % 2 == 0 ? &a : &b);
    const std::vector<double> weights(count, 1.0 / static_cast<double>(count));
    for (auto _ : state) benchmark::DoNotOptimize(blend_raw(paintings, weights));
}
BENCHMARK(blend_pixels)->Arg(2)->Arg(4)->Arg(8)->Unit(benchmark::kMillisecond);

void paint_pixels_with(benchmark::State& state, const std::string& simd) {
    force_simd(simd);
    const PaintParams params = fly_agaric(512);
    for (auto _ : state) benchmark::DoNotOptimize(paint_raw(params));
    force_simd("auto");
}

// A species of the atlas with every effect of weathering at one amount, painted and encoded.
void paint_weathered(benchmark::State& state, const std::string& id, double amount) {
    MushroomSpec spec;
    spec.mix.push_back({id});
    spec.params.texture_size.value = 512;
    PaintParams params = paint_spec_of(spec, *built_in_atlas()).front().painting;
    PaintedWeathering<Plain>::fields(
        [&](auto effect, const Info&) { params.weathering.*effect = amount; });
    for (auto _ : state) benchmark::DoNotOptimize(paint(params).bytes());
}

const int registered = [] {
    const auto atlas = built_in_atlas();
    for (const AtlasEntry& entry : atlas->entries()) {
        const std::string id = entry.species.id.string();
        for (const double amount : {0.0, 1.0})
            benchmark::RegisterBenchmark(
                ("paint_" + std::string(amount > 0.0 ? "worn" : "clean") + "/" + id).c_str(),
                [id, amount](benchmark::State& state) { paint_weathered(state, id, amount); })
                ->Unit(benchmark::kMillisecond);
    }
    for (const std::string& name : simd_names())
        if (name != "auto")
            benchmark::RegisterBenchmark(("paint_pixels_512/" + name).c_str(), paint_pixels_with,
                                         name)
                ->Unit(benchmark::kMillisecond);
    return 0;
}();

}  // namespace
