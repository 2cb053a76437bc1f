// Converts the parameters of a painting to the values that the kernels of each part read. Private
// to core/surface.
#pragma once

#include <array>
#include <cstdint>

#include "core/math/random.h"
#include "core/surface/paint.h"
#include "core/surface/plan.h"

namespace sporeprint {

/// Returns a colour in linear light.
[[nodiscard]] Light light_of(Colour colour);

/// Returns the disc of a cap: a piece of a sphere with a meridian of length `arc` and a rim of
/// radius `radius`, metres; deeper caps continue as a cylinder.
[[nodiscard]] DiscPlan cap_disc(double arc, double radius, const Frame& frame);

// Return what the kernel of each part reads; frame: its chart in texels.
[[nodiscard]] CapPlan cap_plan(const PaintParams& params, const Frame& frame);
[[nodiscard]] HymeniumPlan hymenium_plan(const PaintParams& params, const Frame& frame);
[[nodiscard]] StemPlan stem_plan(const PaintParams& params, const Frame& frame);
[[nodiscard]] VeilPlan veil_plan(const PaintParams& params, const Frame& frame);
[[nodiscard]] BladePlan blade_plan(const PaintParams& params, const Frame& frame);
[[nodiscard]] FleshPlan flesh_plan(const PaintParams& params, const Frame& frame);
[[nodiscard]] GroundPlan ground_plan(const PaintParams& params, const Frame& frame);

/// Returns N seeds of one purpose.
template <std::size_t N>
[[nodiscard]] std::array<std::uint32_t, N> seeds(std::uint32_t seed, std::uint32_t purpose) {
    Random stream(seed, purpose);
    std::array<std::uint32_t, N> out{};
    for (std::uint32_t& one : out) one = stream.bits();
    return out;
}

/// Adds the painted warts (kind 0) or scales (kind 1) of a style to a plan whose cap disc is set.
///
/// amount  how much of the veil or cuticle is left, 0..1
/// weight  factor on the size of every piece
void add_patches(const PatchStyle& style, int kind, double amount, std::uint32_t seed,
                 double weight, PaintPlan& plan);

/// Builds the index from rows of the cap's chart to the patches that may cross them.
void sort_patches_into_rows(PaintPlan& plan);

}  // namespace sporeprint
