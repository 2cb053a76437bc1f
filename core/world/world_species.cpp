#include "core/world/world_species.h"

#include <cstdint>
#include <optional>
#include <utility>

#include "core/math/random.h"
#include "core/params/messages.h"

namespace sporeprint {

namespace {

/// Returns months half a year later.
std::uint16_t southern(std::uint16_t months) {
    return static_cast<std::uint16_t>(((months << 6U) | (months >> 6U)) & 0xFFFU);
}

}  // namespace

std::vector<FungusSpecies> fungi_of(std::span<const std::string> ids, const ClimateParams& climate,
                                    std::span<const std::string> kinds, const WorldLookup& lookup,
                                    const SharedEdits& edits, std::vector<Problem>& problems) {
    std::vector<FungusSpecies> out;
    out.reserve(ids.size());
    for (const std::string& id : ids) {
        std::optional<SpeciesRecord> record = lookup.species(id);
        if (!record) {
            report(problems, "fungi.species", "there is no species " + in_quotes(id));
            continue;
        }
        if (edits)
            if (const auto own = edits->ecologies.find(id); own != edits->ecologies.end()) {
                record->ecology = own->second.ecology;
                record->months = bits_of_months(own->second.months);
            }
        FungusSpecies species;
        species.ecology = std::move(record->ecology);
        species.stream = stream_of(id);
        species.months = climate.latitude_deg < 0.0 ? southern(record->months) : record->months;
        species.kinds = kinds_of(species.ecology, kinds);
        species.cap_radius = record->cap_radius;
        out.push_back(std::move(species));
    }
    return out;
}

}  // namespace sporeprint
