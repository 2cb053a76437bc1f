// A photograph becomes a shape: the file decoded, the mushroom cut out, its outline fitted.

#include <benchmark/benchmark.h>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/grow/species_from_photo.h"
#include "core/surface/codecs.h"
#include "core/surface/photo_codecs.h"
#include "core/trace/photo_file.h"
#include "core/trace/trace.h"
#include "tests/support/atlas.h"
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

const NearestSpecies& nearest() {
    static const NearestSpecies made(atlas());
    return made;
}

/// What a client sends with a photograph of 2048 pixels.
struct Order {
    Bytes file;
    trace::TraceSpec spec;

    explicit Order(bool has_images) {
        const Picture photo = photograph(2048);
        file = jpeg(photo.rgb, photo.width, photo.height, 92, Chroma::full);
        trace::GestureSpec& gesture = spec.views.side.gesture.emplace();
        for (const glm::dvec2& point : drawn_of(2048).gesture().axis)
            gesture.axis.push_back({point.x, point.y});
        spec.images = has_images;
    }
    [[nodiscard]] MushroomOnPhoto cut() const {
        return mushroom_on(decoded_layers(file, trace::decoded_side, "").picture, std::nullopt,
                           spec);
    }
    [[nodiscard]] SpeciesFromPhoto traced(const MushroomOnPhoto& on) const {
        return species_from_photo(on, {}, spec, atlas(), nearest());
    }
};

void trace_with_cut(benchmark::State& state) {
    const Order order(false);
    static_cast<void>(nearest());
    for (auto _ : state) benchmark::DoNotOptimize(order.traced(order.cut()));
}
BENCHMARK(trace_with_cut)->Unit(benchmark::kMillisecond);

void trace_of_the_same_cut(benchmark::State& state) {
    const Order order(false);
    const MushroomOnPhoto on = order.cut();
    static_cast<void>(nearest());
    for (auto _ : state) benchmark::DoNotOptimize(order.traced(on));
}
BENCHMARK(trace_of_the_same_cut)->Unit(benchmark::kMillisecond);

void trace_with_marks(benchmark::State& state) {
    Order order(false);
    const MushroomOnPhoto on = order.cut();
    const SpeciesFromPhoto first = order.traced(on);
    const auto points = [](std::span<const glm::dvec2> line) {
        std::vector<trace::PhotoPoint> list;
        for (const glm::dvec2& at : line) list.push_back({at.x, at.y});
        return list;
    };
    const trace::Traced& traced = first.traced;
    order.spec.outline = {points(traced.left), points(traced.right), points(traced.axis)};
    order.spec.marks = {points(traced.junctions), points(traced.margins), traced.cap_turn_deg};
    order.spec.form = traced.form;
    for (auto _ : state)
        benchmark::DoNotOptimize(order.traced(outlined_on(on.picture, {2048, 2048}, order.spec)));
}
BENCHMARK(trace_with_marks)->Unit(benchmark::kMillisecond);

void trace_with_images(benchmark::State& state) {
    const Order order(true);
    const MushroomOnPhoto on = order.cut();
    static_cast<void>(nearest());
    for (auto _ : state) benchmark::DoNotOptimize(order.traced(on));
}
BENCHMARK(trace_with_images)->Unit(benchmark::kMillisecond);

void trace_of_a_mask(benchmark::State& state) {
    const trace::Mask mask = drawn_of(1024).mask();
    const trace::Gesture gesture = drawn_of(1024).gesture();
    for (auto _ : state) benchmark::DoNotOptimize(trace::traced(mask, gesture, {0.1}));
}
BENCHMARK(trace_of_a_mask)->Unit(benchmark::kMillisecond);

}  // namespace
