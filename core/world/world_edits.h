// What a world has in place of what its parameters and the atlas say: ecologies, founders and masks of its own.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/model/ecology.h"
#include "core/params/describe.h"
#include "core/world/spread.h"
#include "core/world/world_mask.h"

namespace sporeprint {

/// Names of the masks that are not of one species.
inline constexpr const char *mask_of_trees = "trees", *mask_of_fungi = "fungi";

/// Where, how and when a species lives and fruits.
struct SpeciesEcology {
    Ecology ecology;
    std::vector<int> months;

    static constexpr void fields(auto visit) {
        using S = SpeciesEcology;
        visit(&S::ecology, Info{.name = ""});
        visit(&S::months,
              Info{.name = "months",
                   .min = 1,
                   .max = 12,
                   .most = 12,
                   .doc = "Months in which it fruits in the northern hemisphere; all of "
                          "them if the list is empty."});
    }
    bool operator==(const SpeciesEcology &) const = default;
};
static_assert(well_described<SpeciesEcology>());

/// Returns months as bits, bit 0 for January: all of them for an empty list.
[[nodiscard]] std::uint16_t bits_of_months(std::span<const int> months);

/// What a world has of its own, by the ids of its species.
struct WorldEdits {
    template <class T>
    using BySpecies = std::map<std::string, T, std::less<>>;

    /// In place of the ecology and the months of the atlas.
    BySpecies<SpeciesEcology> ecologies{};
    /// In place of the founders that are drawn, for a species that has some here.
    BySpecies<std::vector<Founder>> founders{};
    /// Of mask_of_trees, mask_of_fungi and species. Suitability is multiplied by the last two; a body stands nowhere
    /// where one of them is 0.
    BySpecies<std::shared_ptr<const WorldMask>> masks{};
    /// Canonical text, which settled() sets: two edits have it in common if they are equal.
    std::string text{};

    [[nodiscard]] bool empty() const {
        return ecologies.empty() && founders.empty() && masks.empty();
    }
    /// Returns the mask of a name, or null.
    [[nodiscard]] std::shared_ptr<const WorldMask> mask(std::string_view name) const;
    /// Returns the memory that it takes.
    [[nodiscard]] std::size_t bytes() const;
};

using SharedEdits = std::shared_ptr<const WorldEdits>;

/// Brings an ecology into one form: months sorted and without repetition.
[[nodiscard]] SpeciesEcology settled(SpeciesEcology own);

/// Brings edits into one form: founders and months sorted and without repetition, no mask that takes nothing away; and
/// sets their text.
[[nodiscard]] WorldEdits settled(WorldEdits edits);

}  // namespace sporeprint
