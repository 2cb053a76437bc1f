// Paintings for tests.
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <thread>
#include <vector>

#include "core/surface/paint.h"

namespace sporeprint {

/// Returns parameters with every surface effect, coarse enough to be visible on small images.
inline PaintParams motley(HymeniumPattern pattern, int side = 256) {
    PaintParams params;
    params.seed = 7;
    params.side = side;
    params.metrics.cap_radius = quantised_length(0.05);
    params.metrics.cap_arc = quantised_length(0.06);
    params.metrics.hymenium_arc = quantised_length(0.042);
    params.metrics.hymenium_inner = quantised_length(0.01);
    params.metrics.stem_length = quantised_length(0.10);
    params.metrics.stem_radius = quantised_length(0.01);
    params.metrics.stem_foot = quantised_length(0.005);
    CapSurface& cap = params.surface.cap;
    cap.ramp = {{200, 22, 29}, {120, 70, 90}, {226, 71, 30}};
    cap.fibrils = 0.4;
    cap.fibril_count = 24;
    cap.zones = 0.4;
    cap.patches = 0.3;
    cap.patch_size = 0.02;
    cap.streaks = 0.4;
    cap.veins = 0.4;
    cap.striae = 0.3;
    cap.bumps = 0.6;
    cap.hollow_tint = 0.5;
    params.relief.folds = 0.03;
    params.relief.pits = 0.03;
    params.relief.tiers = 0.01;
    params.carried = {0.3, 0.3, 0.3};
    params.surface.hymenium.pattern = pattern;
    params.surface.hymenium.mottle = 0.5;
    params.surface.hymenium.edge = {120, 20, 20};
    params.surface.hymenium.felt = 0.4;
    params.surface.hymenium.cracks = 0.4;
    params.hymenium.blades = 20;
    params.hymenium.tiers = 1;
    params.hymenium.forking = 0.5;
    params.hymenium.pores_per_mm = 0.4;
    StemSurface& stem = params.surface.stem;
    stem.bands = 0.5;
    stem.net = 0.6;
    stem.bumps = 0.6;
    params.warts.count = 30;
    params.warts.size = 0.08;
    params.warts.height = 1.2;  // a spine that leaves a footprint
    params.ornaments.warts = 0.7;
    params.scales.count = 40;
    params.scales.size = 0.08;
    params.scales.lift = 0.2;
    params.ornaments.scales = 0.7;
    params.weathering.fade = 0.3;
    params.weathering.wetness = 0.3;
    return params;
}

struct Texel {
    int r, g, b;
};

/// Returns a texel of one image.
inline Texel texel(const RawImages& images, ImageKind kind, int x, int y) {
    const Bytes& rgb = images.rgb[static_cast<std::size_t>(kind)];
    const std::size_t at =
        3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(images.side) +
             static_cast<std::size_t>(x));
    return {rgb[at], rgb[at + 1], rgb[at + 2]};
}

/// Runs each task on a thread of its own, the last one first.
inline void all_at_once(std::span<const std::function<void()>> tasks) {
    std::vector<std::jthread> threads;
    for (std::size_t i = tasks.size(); i > 0; --i) threads.emplace_back(tasks[i - 1]);
}

}  // namespace sporeprint
