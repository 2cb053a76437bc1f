#include "core/world/patches.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "core/math/elementary.h"
#include "core/math/purposes.h"
#include "core/world/cell_random.h"
#include "core/world/tree_growth.h"

namespace sporeprint {

namespace {

/// Patches begin so many years before year 0 at a storm. By year 0, the time since the last one no longer depends on
/// that.
constexpr int years_before = 1500;

/// The Weibull distribution of the time between storms.
constexpr double storm_shape = 2.0, storm_mean = 0.886226925452758;  // gamma(1 + 1/2)

/// So many years after a storm, half of the trees of its cohort are born.
constexpr double mean_birth = 6.0;

}  // namespace

double weibull(double uniform, double mean, double shape, double mean_of_one) {
    return mean / mean_of_one * power(-logarithm(1.0 - uniform), 1.0 / shape);
}

WorldTime time_after(WorldTime begin, double years) {
    return begin + static_cast<WorldTime>(std::floor(years * ticks_of_year));
}

std::int32_t floor_div(std::int32_t number, std::int32_t by) {
    const std::int32_t quotient = number / by;
    return number % by < 0 ? quotient - 1 : quotient;
}

std::int32_t place_in(std::int32_t cell, std::int32_t side, std::uint32_t bits) {
    return cell * side + static_cast<std::int32_t>((std::int64_t{side} * (bits >> 8)) >> 24);
}

std::int64_t square_distance(WorldPoint a, WorldPoint b) {
    const std::int64_t x = a.x - b.x, y = a.y - b.y;
    return x * x + y * y;
}

StandPatch patch_of(const Stand& stand, CellIndex cell) {
    Random random(stand.seed, purposes::patches, 0, cell);
    StandPatch patch;
    patch.cell = cell;
    patch.seed.x = place_in(cell.x, patch_units, random.bits());
    patch.seed.y = place_in(cell.y, patch_units, random.bits());
    const double mean = stand.params.patch_years;
    const double phase = random.uniform();
    WorldTime storm = time_after(-years_before * ticks_of_year, -phase * mean);
    const WorldTime end = end_of_trees;
    while (storm < end) {
        patch.storms.push_back(storm);
        const double draw = random.uniform();
        storm = time_after(storm, std::max(5.0, weibull(draw, mean, storm_shape, storm_mean)));
    }
    patch.storms.push_back(storm);
    return patch;
}

double PatchCanopy::at(WorldPoint place) {
    if (stand_->params.density <= 0.0) return 0.0;
    const double glade = stand_->params.glade * units_of_metre;
    if (static_cast<double>(square_distance(place, {})) < glade * glade) return 0.0;
    const auto& near = round({floor_div(place.x, patch_units), floor_div(place.y, patch_units)});
    const Known* nearest = near.front();
    for (const Known* one : near)
        if (square_distance(place, one->seed) < square_distance(place, nearest->seed))
            nearest = one;
    return nearest->height;
}

const PatchCanopy::Near& PatchCanopy::round(CellIndex cell) {
    const auto [found, is_new] = near_.try_emplace({cell.x, cell.y});
    if (!is_new) return found->second;
    std::size_t i = 0;
    for (std::int32_t dy = -2; dy <= 2; ++dy)
        for (std::int32_t dx = -2; dx <= 2; ++dx)
            found->second[i++] = &patch({cell.x + dx, cell.y + dy});
    return found->second;
}

const PatchCanopy::Known& PatchCanopy::patch(CellIndex cell) {
    const auto [found, is_new] = known_.try_emplace({cell.x, cell.y});
    if (!is_new) return found->second;
    const StandPatch patch = patch_of(*stand_, cell);
    found->second.seed = patch.seed;
    const auto next = std::upper_bound(patch.storms.begin(), patch.storms.end(), time_);
    if (next == patch.storms.begin()) return found->second;
    StandTree tree;
    tree.born = time_after(*std::prev(next), mean_birth);
    for (const StandKind& kind : stand_->kinds)
        tree.height += kind.share * stand_->params.height * kind.ecology.height / standard_height;
    if (tree.born >= time_) return found->second;
    const double height = height_at(tree, time_), radius = crown_radius(height);
    // Crowns over a place, of trees that are thrown at random.
    const double crowns = seedling_density * stand_->params.density * pi * radius * radius;
    found->second.height = height * (1.0 - exponential(-crowns));
    return found->second;
}

}  // namespace sporeprint
