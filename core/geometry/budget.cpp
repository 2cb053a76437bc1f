#include "core/geometry/budget.h"

#include <array>
#include <cmath>
#include <span>

#include "core/geometry/collar.h"
#include "core/geometry/hymenium.h"
#include "core/geometry/ornaments.h"
#include "core/geometry/weathering.h"

namespace sporeprint {

namespace {

MeshCount body_count(const Individual& individual, DetailLevel level, bool solids) {
    const Detail detail = detail_of(level);
    const WeatheringCount weathered = weathering_count(individual, level);
    const bool lower_face = !individual.outline.hymenium.empty();
    const auto rings =
        static_cast<std::uint64_t>(detail.stem_rings + (lower_face ? detail.hymenium_rings : 0) +
                                   flesh_rings(individual, level, solids) + detail.cap_rings);
    // Rings of one face are joined by quads, and by triangles at either pole.
    return {rings * (weathered.columns + 1) + weathered.vertices,
            2 * (rings - (lower_face ? 4 : 3)) * weathered.columns + weathered.triangles};
}

/// Makes the detail one step coarser; returns false when no step is left.
bool coarsen(Detail& detail, DetailLevel level) {
    struct Step {
        int Detail::*count;
        int least;
    };
    static constexpr std::array<Step, 4> near = {{{&Detail::patch_sides, 4},
                                                  {&Detail::patch_rings, 0},
                                                  {&Detail::sac_rings, 7},
                                                  {&Detail::patch_sides, 3}}};
    static constexpr std::array<Step, 2> middle = {
        {{&Detail::patch_sides, 3}, {&Detail::sac_rings, 4}}};
    if (level.lod > 1) return false;
    for (const Step& step :
         level.lod == 0 ? std::span<const Step>(near) : std::span<const Step>(middle))
        if (detail.*step.count > step.least) {
            --(detail.*step.count);
            return true;
        }
    return false;
}

/// Builds an eighth less of spines and nets, at every level; returns false when no more can be left
/// out.
bool drop_free_solids(const Individual& individual, Detail& detail) {
    if (individual.spines.empty() && individual.receptacles.empty()) return false;
    if (detail.free_solids <= 0.0) return false;
    detail.free_solids -= 0.125;
    return true;
}

/// Leaves out a further eighth of soil and litter; returns false when none is left.
bool drop_ground(const Individual& individual, Detail& detail) {
    if (individual.grounds.empty() || detail.ground <= 0.0) return false;
    detail.ground -= 0.125;
    return true;
}

/// Leaves out a further eighth of the patches, the smallest ones; returns false when none is left.
bool drop_patches(Detail& detail, DetailLevel level) {
    if (level == 0 || level.lod > 1 || detail.patches <= 0.0) return false;
    detail.patches -= 0.125;
    return true;
}

/// Returns the share of the surplus that a level offers: all at LOD 0, none from LOD 1 on.
double surplus_at(DetailLevel level) {
    if (level.lod > 0) return 0.0;
    return 1.0 - static_cast<double>(level.eighths) / DetailLevel::steps;
}

/// Leaves out a further eighth of the surplus; returns false when none is left.
bool drop_surplus(OrnamentDetail& detail) {
    if (detail.surplus <= 0.0) return false;
    detail.surplus -= 0.125;
    return true;
}

/// The share of a level's triangles that rows beyond the usual ones leave to the ground: one in so
/// many.
constexpr std::uint64_t room_for_ground = 12;

Budget budget_of(const Individual& individual, DetailLevel level, bool solids) {
    Budget budget;
    budget.ornaments = detail_of(level);
    budget.ornaments.surplus = surplus_at(level);
    budget.solids = solids;
    if (solids) {
        budget.cells = cell_budget(individual);
        budget.blades = blade_budget(individual, budget.cells.pores > 0);
        // Levels between whole ones are for distances at which smoothness is not seen.
        if (!level.is_whole()) {
            while (drop_row(budget.blades)) continue;
            coarsen(budget.cells);
        }
    }
    MeshCount body = body_count(individual, level, solids);
    body += collar_count(individual, level);
    const auto total_of = [&](const OrnamentDetail& ornaments) {
        MeshCount count = body;
        count += ornament_count(individual, ornaments);
        if (solids) {
            count += solid_count(budget.cells);
            count += solid_count(individual, budget.blades);
        }
        return count;
    };
    const std::uint64_t limit = triangle_limit(level);
    // Smoothness and the surplus leave triangles for the ground, whether there is any: the ground
    // changes nothing else.
    OrnamentDetail bare = budget.ornaments;
    bare.ground = 0.0;
    while (solids && total_of(bare).triangles > limit - limit / room_for_ground &&
           (drop_row(budget.blades) || drop_row(budget.cells)))
        continue;
    while (total_of(bare).triangles > limit - limit / room_for_ground && drop_surplus(bare))
        continue;
    budget.ornaments.surplus = bare.surplus;
    // The least ground of a mix is a clod of each species, which the share set aside does not pay.
    const bool has_clods = individual.grounds.size() > 1;
    const auto total = [&] { return total_of(budget.ornaments); };
    budget.count = total();
    while (budget.count.triangles > limit &&
           ((has_clods && drop_surplus(budget.ornaments)) ||
            drop_ground(individual, budget.ornaments) || drop_surplus(budget.ornaments) ||
            coarsen(budget.ornaments, level) || (solids && coarsen(individual, budget.blades)) ||
            (!solids && drop_patches(budget.ornaments, level)) ||
            drop_free_solids(individual, budget.ornaments)))
        budget.count = total();
    return budget;
}

}  // namespace

std::uint64_t triangle_limit(DetailLevel level) {
    const auto from = static_cast<double>(at_level(most_triangles, level.lod));
    if (level.is_whole()) return static_cast<std::uint64_t>(from);
    const auto to = static_cast<double>(at_level(most_triangles, level.lod + 1));
    return static_cast<std::uint64_t>(std::floor(between(from, to, level)));
}

Budget budget_of(const Individual& individual, DetailLevel level) {
    const bool solids = has_solids(level) && !individual.outline.hymenium.empty();
    Budget budget = budget_of(individual, level, solids);
    if (solids && !level.is_whole() && budget.count.triangles > triangle_limit(level))
        return budget_of(individual, level, false);
    return budget;
}

}  // namespace sporeprint
