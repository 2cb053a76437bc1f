// A forest that tests of fruit bodies and of what limits them share.
#pragma once

#include <span>
#include <vector>

#include "core/world/season.h"
#include "tests/support/fungi.h"

namespace sporeprint::fungi {

inline constexpr ClimateParams beech{
    .latitude_deg = 51, .temperature = 8.5, .swing = 9, .rain = 850, .rain_days = 0.44};

inline SeasonConditions conditions_in(std::span<const FungusSpecies> species,
                                      const ClimateParams& climate, std::uint32_t seed, int year) {
    return conditions_of(species, weather_of(climate, seed, year - 1),
                         weather_of(climate, seed, year));
}

/// A forest of five blocks by five and the mycelia of the middle three by three, years 80 to 119.
struct Forest {
    EvenHabitat habitat;
    std::vector<FungusSpecies> species = forest_species();
    Grove stand = stand_of(-2, -2, 2, 2, -130, 170);
    std::vector<Genet> genets;

    Forest() {
        habitat.site.light = 0.9;  // so that turf has its fungi too
        for (int y = -1; y <= 1; ++y)
            for (int x = -1; x <= 1; ++x) {
                const std::vector<Genet> more = genets_of(fungi(), {x, y}, 2, stand.around());
                genets.insert(genets.end(), more.begin(), more.end());
            }
    }
    [[nodiscard]] Fungi fungi() const { return {7, species, habitat}; }
    [[nodiscard]] RegionYear in(int year, CellIndex block = {0, 0}) const {
        return {block, year, genets, stand.around()};
    }
    [[nodiscard]] std::vector<FruitBody> bodies(int year, double abundance = 1.0,
                                                const ClimateParams& climate = beech) const {
        return season_of(fungi(), in(year), conditions_in(species, climate, 7, year), abundance);
    }
};

}  // namespace sporeprint::fungi
