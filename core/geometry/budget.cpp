#include "core/geometry/budget.h"

#include <array>
#include <span>

#include "core/geometry/hymenium.h"
#include "core/geometry/ornaments.h"
#include "core/geometry/weathering.h"

namespace sporeprint {

namespace {

MeshCount& operator+=(MeshCount& sum, const MeshCount& more) {
    sum.vertices += more.vertices;
    sum.triangles += more.triangles;
    return sum;
}

MeshCount body_count(const Individual& individual, int lod) {
    const Detail& detail = detail_of(lod);
    const WeatheringCount weathered = weathering_count(individual, lod);
    const bool lower_face = !individual.outline.hymenium.empty();
    const auto rings =
        static_cast<std::uint64_t>(detail.stem_rings + (lower_face ? detail.hymenium_rings : 0) +
                                   flesh_rings(individual, lod) + detail.cap_rings);
    // Rings of one face are joined by quads, and by triangles at either pole.
    return {rings * (weathered.columns + 1) + weathered.vertices,
            2 * (rings - (lower_face ? 4 : 3)) * weathered.columns + weathered.triangles};
}

/// Makes the detail one step coarser; returns false when no step is left.
bool coarsen(Detail& detail, int lod) {
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
    if (lod > 1) return false;
    for (const Step& step : lod == 0 ? std::span<const Step>(near) : std::span<const Step>(middle))
        if (detail.*step.count > step.least) {
            --(detail.*step.count);
            return true;
        }
    if (lod == 0 || detail.patches <= 0.0) return false;
    detail.patches -= 0.125;
    return true;
}

}  // namespace

Budget budget_of(const Individual& individual, int lod) {
    Budget budget;
    budget.ornaments = detail_of(lod);
    const bool solids = has_solids(lod) && !individual.outline.hymenium.empty();
    if (solids) {
        budget.cells = cell_budget(individual);
        budget.blades = blade_budget(individual, budget.cells.pores > 0);
    }
    const MeshCount body = body_count(individual, lod);
    const auto total = [&] {
        MeshCount count = body;
        count += ornament_count(individual, budget.ornaments);
        if (solids) {
            count += solid_count(budget.cells);
            count += solid_count(individual, budget.blades);
        }
        return count;
    };
    budget.count = total();
    const std::uint64_t limit = at_level(most_triangles, lod);
    while (budget.count.triangles > limit &&
           (coarsen(budget.ornaments, lod) || (solids && coarsen(individual, budget.blades))))
        budget.count = total();
    return budget;
}

}  // namespace sporeprint
