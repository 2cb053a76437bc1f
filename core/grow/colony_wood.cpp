#include "core/grow/colony_wood.h"

#include <algorithm>
#include <cmath>

#include "core/colony/habit.h"

namespace sporeprint {

namespace {

/// Returns the piece of wood that a tier stands on, metres at size 1.
///
/// lowest, highest  middles of its members
WoodPiece wood_of(const ColonyParams& params, const ColonyTraits& traits, const StemFit& fit,
                  double lowest, double highest) {
    const double radius = trunk_radius(params, fit);
    const double beyond = std::max(1.2 * std::max(fit.height, fit.cap_radius), 0.5 * radius);
    return {radius, lowest - beyond, highest + beyond, traits.seed, 0.0, traits.substrate};
}

}  // namespace

MeshCount expected_wood(const ColonySpec& spec, const ColonyTraits& traits, const StemFit& fit,
                        int lod) {
    if (traits.substrate == Substrate::none) return {};
    const TierRows rows = tier_rows(traits, fit.cap_radius * spec.params.cap_scale, fit.height,
                                    trunk_radius(spec.params, fit));
    const double height =
        rows.height * std::ceil(static_cast<double>(spec.params.count) / rows.in_row);
    const MeshCount count = wood_count(wood_of(spec.params, traits, fit, 0.0, height), lod);
    // Rows of brackets are uneven, and the wood reaches beyond the outermost.
    return {count.vertices + count.vertices / 3, count.triangles + count.triangles / 3};
}

WoodPiece wood_below(const std::vector<ColonyMember>& members, const ColonyParams& params,
                     const ColonyTraits& traits, const StemFit& fit) {
    double lowest = 0.0, highest = 0.0;
    for (const ColonyMember& member : members) {
        lowest = std::min(lowest, member.pose.at.y);
        highest = std::max(highest, member.pose.at.y);
    }
    return wood_of(params, traits, fit, lowest, highest);
}

}  // namespace sporeprint
