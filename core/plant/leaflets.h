// Leaflets: how the blades of a compound leaf, such as a frond or a shoot of needles, stand on its
// axis.
#pragma once

#include <glm/vec3.hpp>
#include <vector>

#include "core/params/describe.h"

namespace sporeprint {

/// The parameters of the leaflets of a leaf.
struct Leaflets {
    int count = 0;
    double length = 0.25;
    double angle_deg = 65.0;
    double turn_deg = 180.0;
    double flat = 0.0;
    double narrow_base = 0.3;
    double narrow_tip = 0.8;

    static constexpr void fields(auto visit) {
        using L = Leaflets;
        visit(&L::count, Info{.name = "count",
                              .min = 0,
                              .max = 80,
                              .doc = "Leaflets, the last at the tip of the axis; 0: a simple leaf, "
                                     "to which the rest does not apply."});
        visit(&L::length, Info{.name = "length",
                               .min = 0.02,
                               .max = 1,
                               .doc = "Of the longest leaflet, in lengths of the axis."});
        visit(&L::angle_deg, Info{.name = "angle_deg",
                                  .unit = "deg",
                                  .min = 10,
                                  .max = 100,
                                  .doc = "Between a leaflet and the axis; less towards its tip."});
        visit(&L::turn_deg, Info{.name = "turn_deg",
                                 .unit = "deg",
                                 .min = 0,
                                 .max = 180,
                                 .doc = "Turn about the axis from one leaflet to the next: 180 in "
                                        "two rows, 137.5 all round."});
        visit(&L::flat, Info{.name = "flat",
                             .min = 0,
                             .max = 1,
                             .doc = "How far leaflets that stand all round are parted to both "
                                    "sides."});
        visit(&L::narrow_base, Info{.name = "narrow_base",
                                    .min = 0,
                                    .max = 0.95,
                                    .doc = "How much shorter leaflets are at the root."});
        visit(&L::narrow_tip, Info{.name = "narrow_tip",
                                   .min = 0,
                                   .max = 0.95,
                                   .doc = "How much shorter they are at the tip."});
    }
    bool operator==(const Leaflets&) const = default;
};
static_assert(well_described<Leaflets>());

/// Where a leaflet stands on the straight axis of unit length, which runs along +z, its upper face
/// up. Its own length is `size`.
struct PlacedLeaflet {
    double at = 0.0;  ///< of its root along the axis
    double size = 1.0;
    glm::dvec3 along{0.0, 0.0, 1.0}, up{0.0, 1.0, 0.0};

    /// Returns the position of a point of a leaflet of length 1 with its root at the origin.
    [[nodiscard]] glm::dvec3 place(const glm::dvec3& point) const;
};

/// Returns the leaflets from the root to the tip; the last reaches the end of the axis.
[[nodiscard]] std::vector<PlacedLeaflet> placed_leaflets(const Leaflets& leaflets);

}  // namespace sporeprint
