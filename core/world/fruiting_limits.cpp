#include "core/world/fruiting_limits.h"

#include <algorithm>

namespace sporeprint {

Condition Limits::limiting() const {
    return static_cast<Condition>(std::ranges::min_element(values) - values.begin());
}

Limits limits_at(const Fungi& fungi, const RegionYear& input, const SeasonConditions& conditions,
                 std::size_t species, WorldPoint place, int day) {
    const FungusSpecies& fungus = fungi.species[species];
    const Ecology& ecology = fungus.ecology;
    const WorldTime time = time_of(input.year, day);
    const Site site = fungi.habitat.site_at(place, time);
    const auto index = static_cast<std::uint8_t>(species);
    Limits out;
    const auto set = [&](Condition condition, double value) {
        out.values[static_cast<std::size_t>(condition)] = value;
    };
    set(Condition::establishment, fungi.habitat.establishment(species, place, time));
    set(Condition::light, ecology.light.at(site.light));
    set(Condition::wetness, ecology.wetness.at(site.wetness));
    set(Condition::acidity, ecology.acidity.at(site.acidity));
    const FungusSubstrate substrate = substrate_at(input.around, fungus, place, time);
    set(Condition::substrate, substrate.is_there ? 1.0 : 0.0);
    const bool has_mycelium =
        ecology.guild == Guild::wood
            ? std::ranges::any_of(input.genets,
                                  [&](const Genet& genet) {
                                      return genet.species == index && genet.lives_at(time) &&
                                             substrate.is_there && genet.host == substrate.record;
                                  })
            : owner_of(input.genets, index, place, time) != nullptr;
    set(Condition::mycelium, has_mycelium ? 1.0 : 0.0);
    const auto at = static_cast<std::size_t>(day - 1);
    const FruitingDay& weather = conditions.species[species][at];
    set(Condition::temperature, weather.temperature);
    set(Condition::rain, weather.rain);
    set(Condition::month, weather.month);
    set(Condition::cold, weather.cold);
    set(Condition::moisture,
        moisture_gate(fungi.habitat.wetness_on(site, conditions.soil_water[at])));
    return out;
}

}  // namespace sporeprint
