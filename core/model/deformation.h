// Deformation of a shape: bend, twist, lean, taper, imperfection and irregularity.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/params/describe.h"
#include "core/params/types.h"

namespace sporeprint {

/// The paper's deformation D. `M` is Plain in a Model and std::optional in a request.
template <template <class> class M>
struct DeformationOf {
    M<double> bend_deg{};
    M<double> twist_deg{};
    M<double> lean_deg{};
    M<double> taper{};
    M<double> zone_from{};
    M<double> zone_to = preset<M>(1.0);
    M<double> imperfection{};
    M<double> irregularity{};

    static constexpr void fields(auto visit) {
        using D = DeformationOf;
        visit(&D::bend_deg, Info{.name = "bend_deg",
                                 .unit = "deg",
                                 .min = 0,
                                 .max = 90,
                                 .doc = "How far the stem turns over its bending zone; the "
                                        "direction is the individual's own."});
        visit(&D::twist_deg, Info{.name = "twist_deg",
                                  .unit = "deg",
                                  .min = -180,
                                  .max = 180,
                                  .doc = "Twist of the stem's surface over its bending zone."});
        visit(&D::lean_deg, Info{.name = "lean_deg",
                                 .unit = "deg",
                                 .min = 0,
                                 .max = 45,
                                 .doc = "Lean of the whole mushroom from the vertical."});
        visit(&D::taper, Info{.name = "taper",
                              .min = -1,
                              .max = 1,
                              .doc = "Stem wider (positive) or narrower (negative) at the start of "
                                     "the bending zone."});
        visit(&D::zone_from, Info{.name = "zone_from",
                                  .min = 0,
                                  .max = 0.9,
                                  .doc = "Where the zone of influence of bend, twist and taper "
                                         "begins; 0 is the ground, 1 the stem top."});
        visit(&D::zone_to, Info{.name = "zone_to",
                                .min = 0.1,
                                .max = 1,
                                .doc = "Where the zone of influence ends; 1 is the stem top."});
        visit(&D::imperfection, Info{.name = "imperfection",
                                     .min = 0,
                                     .max = 1,
                                     .doc = "Dents and bulges by local free-form deformation."});
        visit(
            &D::irregularity,
            Info{.name = "irregularity",
                 .min = 0,
                 .max = 1,
                 .doc =
                     "How far the whole is from a surface of revolution: the outline of the cap "
                     "deviates from an oval by up to a tenth of its radius, the margin lifts, the "
                     "stem stands beside the middle, winds and swells."});
    }
    void check(const std::string& path, std::vector<Problem>& problems) const {
        const std::optional<double> from = zone_from, to = zone_to;
        // In binary, 1 - 0.9 is slightly less than 0.1.
        if (from && to && *to - *from < 0.1 - 1e-9)
            problems.push_back({path + "/zone_to", "must exceed zone_from by at least 0.1"});
    }
    bool operator==(const DeformationOf&) const = default;
};

}  // namespace sporeprint
