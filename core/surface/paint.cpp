#include "core/surface/paint.h"

#include <hwy/aligned_allocator.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "core/math/elementary.h"
#include "core/math/purposes.h"
#include "core/math/random.h"
#include "core/problems.h"
#include "core/surface/canvas.h"
#include "core/surface/charts.h"
#include "core/surface/part_plans.h"
#include "core/surface/plan.h"
#include "core/surface/uploaded_image.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/surface/image_blend.inl"
#include <hwy/foreach_target.h>

#include "core/surface/image_blend.inl"

namespace sporeprint {

HWY_EXPORT(paint_rows);
HWY_EXPORT(row_buffers_size);
HWY_EXPORT(fill_coarse);
HWY_EXPORT(blend_rows);
HWY_EXPORT(blend_buffers_size);
HWY_EXPORT(weathered_light);

namespace {

constexpr float single(double value) { return static_cast<float>(value); }

void fill(CoarseField& field, const DiscPlan& disc, const Frame& frame, int cells, float frequency,
          std::uint32_t seed) {
    field.values.resize(static_cast<std::size_t>(cells + 1) * static_cast<std::size_t>(cells + 1));
    HWY_DYNAMIC_DISPATCH(fill_coarse)
    (disc, frame.inset, cells, frequency, seed, field.values.data());
}

PaintPlan paint_plan(const PaintParams& params, const ImageRotations& turns) {
    struct Given {
        const Upload* upload;
        const char* path;
        double turn;
    };
    const std::array<Given, 3> uploads = {
        {{&params.surface.cap.image, "/surface/cap/image", turns.cap},
         {&params.surface.hymenium.image, "/surface/hymenium/image", turns.hymenium},
         {&params.surface.stem.image, "/surface/stem/image", turns.stem}}};
    PaintPlan plan;
    plan.side = params.side;
    plan.frames = chart_frames(plan.side);
    plan.cap = cap_plan(params, plan.frames[0]);
    plan.hymenium = hymenium_plan(params, plan.frames[1]);
    plan.stem = stem_plan(params, plan.frames[2]);
    plan.veil = veil_plan(params, plan.frames[3]);
    plan.blade = blade_plan(params, plan.frames[4]);
    plan.flesh = flesh_plan(params, plan.frames[5]);
    plan.ground = ground_plan(params, plan.frames[6]);
    plan.fade = single(params.weathering.fade);
    plan.wetness = single(params.weathering.wetness);
    for (std::size_t i = 0; i < 3; ++i) {
        plan.uploads[i] = uploaded_image(*uploads[i].upload, plan.frames[i], uploads[i].path);
        rotate(plan.uploads[i], uploads[i].turn);
    }
    const auto coarse = seeds<5>(params.paint_seed(), purposes::clouds);
    plan.disc_step = plan.side >= 512 ? 2 : 1;
    plan.strip_step = std::clamp(plan.side / 256, 1, 8);
    plan.coarse_cells = std::min(64, plan.side / 2);
    fill(plan.cap_fields[0], plan.cap.disc, plan.frames[0], plan.coarse_cells, 2.3F, coarse[0]);
    fill(plan.cap_fields[1], plan.cap.disc, plan.frames[0], plan.coarse_cells, 5.5F, coarse[1]);
    fill(plan.cap_fields[2], plan.cap.disc, plan.frames[0], plan.coarse_cells, 8.5F, coarse[2]);
    fill(plan.hymenium_fields[0], plan.hymenium.disc, plan.frames[1], plan.coarse_cells, 2.7F,
         coarse[3]);
    fill(plan.hymenium_fields[1], plan.hymenium.disc, plan.frames[1], plan.coarse_cells, 8.0F,
         coarse[4]);
    if (params.surface.cap.image.empty()) {
        add_patches(params.scales, 1, params.ornaments.scales, params.seed, 1.0, plan);
        add_patches(params.warts, 0, params.ornaments.warts, params.seed, 1.0, plan);
    }
    sort_patches_into_rows(plan);
    plan_damage(params, plan);
    return plan;
}

int checked_side(const PaintParams& params) {
    const int side = params.side;
    if (!proper_side(side))
        throw InvalidInput("/side",
                           std::to_string(side) + " is not a power of two from 16 to 2048");
    return side;
}

void paint_canvas(const PaintParams& params, const ImageRotations& turns, const Parallel& parallel,
                  Canvas& canvas) {
    const PaintPlan plan = paint_plan(params, turns);
    const PaintTarget target = canvas.target();
    std::vector<std::function<void()>> pieces;
    for (const Part part : all_parts) {
        const int height = plan.frames[index_of(part)].height;
        for (int from = 0; from < height; from += rows_per_piece) {
            const int to = std::min(from + rows_per_piece, height);
            pieces.emplace_back([&plan, &target, part, from, to] {
                thread_local hwy::AlignedFreeUniquePtr<std::uint8_t[]> buffers;
                if (!buffers)
                    buffers = hwy::AllocateAligned<std::uint8_t>(
                        HWY_DYNAMIC_DISPATCH(row_buffers_size)());
                HWY_DYNAMIC_DISPATCH(paint_rows)(plan, part, from, to, buffers.get(), target);
            });
        }
    }
    parallel(pieces);
}

}  // namespace

RawImages paint_raw(const PaintParams& params, const Parallel& parallel,
                    const ImageRotations& turns) {
    Canvas canvas(checked_side(params));
    paint_canvas(params, turns, parallel, canvas);
    return raw(canvas);
}

ImageSet paint(const PaintParams& params, const Parallel& parallel, ImageFormat format) {
    Canvas canvas(checked_side(params));
    paint_canvas(params, {}, parallel, canvas);
    return encoded(canvas, format, parallel);
}

namespace {

// Adds the patches of one kind of all paintings to a plan. Those with equal places are merged: they
// have the mean size, height, lift and amount of veil.
void add_merged_patches(std::span<const PaintParams* const> paintings,
                        std::span<const double> weights, int kind, PatchStyle PaintParams::*style,
                        double PaintedOrnaments::*amount, PaintPlan& plan) {
    std::vector<bool> done(paintings.size(), false);
    for (std::size_t i = 0; i < paintings.size(); ++i) {
        const PatchStyle& one = paintings[i]->*style;
        if (one.count == 0 || done[i]) continue;
        PatchStyle all = one;
        all.size = all.height = all.lift = 0.0;
        double left = 0.0, weight = 0.0;
        for (std::size_t j = i; j < paintings.size(); ++j) {
            const PatchStyle& two = paintings[j]->*style;
            if (!two.has_places_of(one)) continue;
            done[j] = true;
            if (!paintings[j]->surface.cap.image.empty()) continue;  // uploaded, not painted
            weight += weights[j];
            all.size += weights[j] * two.size;
            all.height += weights[j] * two.height;
            all.lift += weights[j] * two.lift;
            left += weights[j] * paintings[j]->ornaments.*amount;
        }
        if (!(weight > 0.0)) continue;
        all.size /= weight;
        all.height /= weight;
        all.lift /= weight;
        add_patches(all, kind, left / weight, paintings[i]->seed, weight, plan);
    }
}

}  // namespace

PaintPlan patch_blend_plan(std::span<const PaintParams* const> paintings,
                           std::span<const double> weights) {
    PaintPlan plan;
    plan.side = paintings[0]->side;
    plan.frames = chart_frames(plan.side);
    const auto mean = [&](auto of) {
        double sum = 0.0;
        for (std::size_t i = 0; i < paintings.size(); ++i) sum += weights[i] * of(*paintings[i]);
        return sum;
    };
    using P = const PaintParams&;
    plan.cap.disc =
        cap_disc(mean([](P p) { return length_of_step(p.metrics.cap_arc); }),
                 mean([](P p) { return length_of_step(p.metrics.cap_radius); }), plan.frames[0]);
    plan.fade = single(mean([](P p) { return p.weathering.fade; }));
    plan.wetness = single(mean([](P p) { return p.weathering.wetness; }));
    const auto light = [&](Colour VeilSurface::*colour) {
        const auto channel = [&](float Light::*which) {
            return single(mean(
                [&](P p) { return static_cast<double>(light_of(p.surface.veil.*colour).*which); }));
        };
        return Light{channel(&Light::r), channel(&Light::g), channel(&Light::b)};
    };
    plan.veil.colour = light(&VeilSurface::colour);
    plan.veil.tip = light(&VeilSurface::tip);
    plan.veil.roughness = single(mean([](P p) { return p.surface.veil.roughness; }));
    float roughness = plan.veil.roughness;
    HWY_DYNAMIC_DISPATCH(weathered_light)(plan, plan.veil.colour, roughness);
    roughness = plan.veil.roughness;
    HWY_DYNAMIC_DISPATCH(weathered_light)(plan, plan.veil.tip, roughness);
    plan.veil.roughness = roughness;
    add_merged_patches(paintings, weights, 1, &PaintParams::scales, &PaintedOrnaments::scales,
                       plan);
    add_merged_patches(paintings, weights, 0, &PaintParams::warts, &PaintedOrnaments::warts, plan);
    sort_patches_into_rows(plan);
    return plan;
}

void blend_piece(const BlendPlan& plan, Part part, int from, int to, const PaintTarget& target) {
    thread_local hwy::AlignedFreeUniquePtr<std::uint8_t[]> buffers;
    if (!buffers)
        buffers = hwy::AllocateAligned<std::uint8_t>(HWY_DYNAMIC_DISPATCH(blend_buffers_size)());
    HWY_DYNAMIC_DISPATCH(blend_rows)(plan, part, from, to, buffers.get(), target);
}

}  // namespace sporeprint
