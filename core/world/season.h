// The fruit bodies of a piece of a world in a year: on which days mycelia fruit, how many bodies there are, and where.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/world/fruiting_weather.h"
#include "core/world/mycelia.h"
#include "core/world/records.h"
#include "core/world/region.h"
#include "core/world/weather.h"

namespace sporeprint {

/// What is needed for the fruit bodies of a rectangle in a year.
struct RegionYear {
    Region region;
    int year = 0;
    /// Those of genets_round() the rectangle in the epoch of the year, or of a block and its eight neighbours.
    std::span<const Genet> genets;
    Surroundings around;  ///< as far as influence.h says
};

/// Returns the fruit bodies in a rectangle: those that emerge in a year, at the end of which some of them still stand, and
/// the brackets of perennial species that stand at some time of it. Sorted by id.
///
/// A mycelium fruits as soon as it has had enough good days, and again two weeks later at the earliest. Bodies stand in
/// tufts and these in clusters; on arcs of rings, or on bark. A body that is nearer to one of higher priority than the
/// two tolerate does not grow, whether or not the other one does, so that bodies farther away do not matter.
///
/// abundance  factor of the number of bodies, 0..10; with a higher one all bodies of a lower one stand where they did
/// cost       about 1 ms for 12 species
/// source     clusters of clusters: [Thomas1949]
[[nodiscard]] std::vector<FruitBody> season_of(const Fungi& fungi, const RegionYear& input,
                                               const SeasonConditions& conditions,
                                               double abundance);

/// Returns the age of a body, 0 to 1: 0.6 when it is mature, 1 when it is gone. Logistic until it is mature, then
/// linear; never decreasing.
[[nodiscard]] double age_at(const FruitBody& body, WorldTime time);

/// Returns how many bodies of each species stand at noon of each day of a year: [species][day].
[[nodiscard]] std::vector<std::array<std::uint32_t, days_of_year>> daily_counts(
    std::span<const FruitBody> bodies, std::size_t species, int year);

}  // namespace sporeprint
