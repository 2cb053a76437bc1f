#include "core/world/dead_wood.h"

#include <algorithm>
#include <cmath>

#include "core/math/elementary.h"
#include "core/math/purposes.h"
#include "core/world/tree_growth.h"

namespace sporeprint {

namespace {

/// Share of the mass at which nobody can tell a log from the ground.
constexpr double last_mass = 0.15;

/// How long a snag stands at most.
constexpr double snag_years = 15.0;

/// Slopes less than this do not decide where a trunk falls.
constexpr double least_slope = 0.15;

/// Length of a trunk without its top, as a share of the tree's height, and the radius of its foot compared with that at
/// breast height.
constexpr double trunk_share = 0.9, foot = 1.15;

/// Returns what the death of a tree leaves. Its draws belong to the tree.
DeadWood trunk_of(const Stand& stand, const StandTree& tree, const FallSite& site, double downwind,
                  Random& random) {
    const TreeEcology& ecology = stand.kinds[tree.kind].ecology;
    const double height = height_at(tree, tree.died);
    const double wait = random.uniform(), deviation = random.normal();
    const bool downhill =
        random.uniform() < 0.5 &&
        site.east * site.east + site.north * site.north > least_slope * least_slope;
    const std::uint32_t high = random.bits(), low = random.bits();
    DeadWood out;
    out.id = std::uint64_t{high} << 32 | low;
    out.tree = tree.id;
    out.at = tree.at;
    out.kind = tree.kind;
    out.died = tree.died;
    out.fell = tree.by_storm
                   ? tree.died
                   : tree.died + static_cast<WorldTime>(wait * snag_years * ticks_of_year);
    out.gone =
        tree.died + static_cast<WorldTime>(years_of_decay(stand.params, ecology) * ticks_of_year);
    out.fell = std::min(out.fell, out.gone);
    out.direction = (downhill ? arc_tangent(-site.north, -site.east) : downwind) + 0.5 * deviation;
    out.length = trunk_share * height;
    out.radius = 0.5 * foot * trunk_diameter(height);
    out.decay = decay_rate(stand.params, ecology);
    return out;
}

}  // namespace

double longest_trunk(const Stand& stand) { return trunk_share * greatest_height(stand); }

double decay_rate(const StandParams& params, const TreeEcology& ecology) {
    return ecology.decay / std::max(1.0, params.dead_wood);
}

double years_of_decay(const StandParams& params, const TreeEcology& ecology) {
    return -logarithm(last_mass) / decay_rate(params, ecology);
}

std::vector<DeadWood> dead_wood_of(const Stand& stand, std::span<const StandTree> trees,
                                   const FallSiteAt& site, double downwind) {
    std::vector<DeadWood> out;
    for (const StandTree& tree : trees) {
        Random random(stand.seed, purposes::dead_wood, static_cast<std::uint32_t>(tree.id),
                      {static_cast<std::int32_t>(tree.id >> 32), 0});
        const double taken = random.uniform();
        if (taken >= stand.params.dead_wood ||
            trunk_diameter(height_at(tree, tree.died)) < thinnest_log)
            continue;
        out.push_back(trunk_of(stand, tree, site(tree.at), downwind, random));
    }
    std::sort(out.begin(), out.end(),
              [](const DeadWood& a, const DeadWood& b) { return a.id < b.id; });
    return out;
}

}  // namespace sporeprint
