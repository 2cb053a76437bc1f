#include "core/world/influence.h"

#include <algorithm>

namespace sporeprint {

namespace {

/// How near two bodies come, in radii of their caps: those in tufts crowd.
constexpr double core = 0.5, core_in_tufts = 0.2;

/// The radius of the thickest trunk, and how much farther than a trunk bark may be by rounding.
constexpr double thickest = 0.5;

/// How far roots and litter of a tree reach, metres.
constexpr double roots = 10.0;

}  // namespace

double core_of(const FungusSpecies& species) {
    const bool is_tufted = species.ecology.fruit.tufts > 1.2;
    return species.cap_radius * (is_tufted ? core_in_tufts : core);
}

double spacing_of(std::span<const FungusSpecies> species) {
    double spacing = 0.0;
    for (const FungusSpecies& one : species) spacing = std::max(spacing, 2.0 * core_of(one));
    return spacing;
}

double scatter_of(const Ecology& ecology) {
    return widest_bell * (ecology.fruit.cluster_spread + ecology.fruit.tuft_spread);
}

double mycelia_within(const Ecology& ecology, double spacing) {
    return ecology.genet.reach + widest_bell * ecology.ring.spread + scatter_of(ecology) + spacing;
}

double trunks_within(const Ecology& ecology, double spacing) {
    return scatter_of(ecology) + spacing + 2.0 * thickest;
}

Influence influence_on(std::span<const FungusSpecies> species, const Stand& stand) {
    const double spacing = spacing_of(species);
    Influence out;
    out.trees = farthest_host;
    for (const FungusSpecies& one : species) {
        const Ecology& ecology = one.ecology;
        if (ecology.guild == Guild::wood) {
            out.wood = std::max(out.wood, trunks_within(ecology, spacing) + longest_trunk(stand));
            continue;
        }
        if (ecology.guild == Guild::grass) continue;
        // Bodies depend on a mycelium, this one on two others in turn that find what they live on, and these on a third
        // one, whose spores alone count. That of a pioneer begins at its host.
        const double away = mycelia_within(ecology, spacing);
        const double step = std::max(ecology.genet.reach, founding_distance);
        out.light = std::max(out.light, away + 2.0 * step);
        out.trees = std::max({out.trees, away + 2.0 * step + roots, away + 3.0 * step});
    }
    return out;
}

}  // namespace sporeprint
