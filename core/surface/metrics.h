// Lengths of a shape that painting may depend on, quantised so that similar shapes share their
// images.
#pragma once

#include "core/params/describe.h"

namespace sporeprint {

/// Lengths in steps of 2 %: step n is 1.02^n metres. See quantised_length() and length_of_step().
/// radial_strain is no length: it is in sixteenths.
struct SurfaceMetrics {
    int cap_arc = -150;
    int cap_radius = -150;
    int hymenium_arc = -150;
    int hymenium_inner = -230;
    int stem_length = -130;
    int stem_radius = -230;
    int stem_foot = -600;
    int radial_strain = 0;

    static constexpr void fields(auto visit) {
        using M = SurfaceMetrics;
        visit(&M::cap_arc, Info{.name = "cap_arc",
                                .min = -600,
                                .max = 100,
                                .doc = "Meridian of the upper face, apex to margin."});
        visit(&M::cap_radius, Info{.name = "cap_radius",
                                   .min = -600,
                                   .max = 100,
                                   .doc = "Largest radius of the upper face."});
        visit(&M::hymenium_arc, Info{.name = "hymenium_arc",
                                     .min = -600,
                                     .max = 100,
                                     .doc = "Meridian of the lower face, stem to margin."});
        visit(&M::hymenium_inner, Info{.name = "hymenium_inner",
                                       .min = -600,
                                       .max = 100,
                                       .doc = "Radius where the lower face meets the stem."});
        visit(&M::stem_length, Info{.name = "stem_length",
                                    .min = -600,
                                    .max = 100,
                                    .doc = "Meridian of the stem, ground to hymenium."});
        visit(
            &M::stem_radius,
            Info{
                .name = "stem_radius", .min = -600, .max = 100, .doc = "Mean radius of the stem."});
        visit(&M::stem_foot, Info{.name = "stem_foot",
                                  .min = -600,
                                  .max = 100,
                                  .doc = "Meridian of the stem below the ground."});
        visit(&M::radial_strain,
              Info{.name = "radial_strain",
                   .min = 0,
                   .max = 16,
                   .doc = "Growth strain of the upper face in sixteenths: 0 has stretched alike in "
                          "all directions, 16 far more round the axis."});
    }
    bool operator==(const SurfaceMetrics&) const = default;
};

/// Returns the step nearest to `metres`, in -600..100; lengths below 1e-5 m count as 1e-5 m.
[[nodiscard]] int quantised_length(double metres);

/// Returns the length of a step in metres.
[[nodiscard]] double length_of_step(int step);

}  // namespace sporeprint
