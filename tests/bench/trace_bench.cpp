// A photograph becomes a shape: the file decoded, the mushroom cut out, its outline fitted.

#include <benchmark/benchmark.h>

#include <cstddef>
#include <cstdint>

#include "core/surface/codecs.h"
#include "core/trace/cut.h"
#include "core/trace/photo_file.h"
#include "core/trace/trace.h"
#include "tests/support/drawn_mushroom.h"

namespace {

using namespace sporeprint;

DrawnMushroom drawn_of(int side) {
    DrawnMushroom drawn;
    drawn.side = side;
    drawn.pixels = 0.7 * side;
    drawn.bend_deg = 12.0;
    drawn.lean_deg = -6.0;
    return drawn;
}

/// A brown mushroom before green, both with grain.
Picture photograph(int side) {
    const trace::Mask mask = drawn_of(side).mask();
    Picture photo{side, side, {}};
    std::uint32_t state = 7;
    for (const std::uint8_t inside : mask.inside) {
        state = state * 1664525U + 1013904223U;
        const auto grain = static_cast<int>(state >> 26U);
        for (const int base :
             {inside != 0 ? 130 : 40, inside != 0 ? 90 : 90, inside != 0 ? 60 : 30})
            photo.rgb.push_back(static_cast<std::uint8_t>(base + grain));
    }
    return photo;
}

void photo_of_12_megapixels(benchmark::State& state) {
    const Picture photo = photograph(3464);
    const Bytes file = jpeg(photo.rgb, photo.width, photo.height, 85, Chroma::halved);
    for (auto _ : state) benchmark::DoNotOptimize(trace::decoded_photo(file, "/photo"));
}
BENCHMARK(photo_of_12_megapixels)->Unit(benchmark::kMillisecond);

void trace_with_cut(benchmark::State& state) {
    const Picture photo = photograph(2048);
    const trace::Gesture gesture = drawn_of(2048).gesture();
    for (auto _ : state) benchmark::DoNotOptimize(trace::traced(photo, gesture, {0.1}));
}
BENCHMARK(trace_with_cut)->Unit(benchmark::kMillisecond);

void trace_of_a_mask(benchmark::State& state) {
    const trace::Mask mask = drawn_of(1024).mask();
    const trace::Gesture gesture = drawn_of(1024).gesture();
    for (auto _ : state) benchmark::DoNotOptimize(trace::traced(mask, gesture, {0.1}));
}
BENCHMARK(trace_of_a_mask)->Unit(benchmark::kMillisecond);

}  // namespace
