// The parameters of a painting turned into what the kernels of each part read. Private to core/surface.
#pragma once

#include <array>
#include <cstdint>

#include "core/math/random.h"
#include "core/surface/paint.h"
#include "core/surface/plan.h"

namespace sporeprint {

/// A colour in linear light.
[[nodiscard]] Light light_of(Colour colour);

/// The disc of a cap: a piece of a sphere whose meridian is `arc` long and whose rim has radius `radius`, metres; deeper caps go on
/// as a cylinder.
[[nodiscard]] DiscPlan cap_disc(double arc, double radius, const Frame& frame);

// What the kernel of each part reads; frame: its chart in texels.
[[nodiscard]] CapPlan cap_plan(const PaintParams& params, const Frame& frame);
[[nodiscard]] HymeniumPlan hymenium_plan(const PaintParams& params, const Frame& frame);
[[nodiscard]] StemPlan stem_plan(const PaintParams& params, const Frame& frame);
[[nodiscard]] VeilPlan veil_plan(const PaintParams& params, const Frame& frame);
[[nodiscard]] BladePlan blade_plan(const PaintParams& params, const Frame& frame);
[[nodiscard]] FleshPlan flesh_plan(const PaintParams& params, const Frame& frame);

/// Seeds of one purpose, as many as a part's kernels ask for.
template <std::size_t N>
[[nodiscard]] std::array<std::uint32_t, N> seeds(std::uint32_t seed, std::uint32_t purpose) {
    Random stream(seed, purpose);
    std::array<std::uint32_t, N> out{};
    for (std::uint32_t& one : out) one = stream.bits();
    return out;
}

/// Adds the painted warts (kind 0) or scales (kind 1) of a style to a plan whose cap's disc is known.
///
/// amount  how much of the veil or skin is left, 0..1; weight: factor on the size of every piece
void add_patches(const PatchStyle& style, int kind, double amount, std::uint32_t seed,
                 double weight, PaintPlan& plan);

/// Notes for each row of the cap's chart which patches may touch it.
void sort_patches_into_rows(PaintPlan& plan);

}  // namespace sporeprint
