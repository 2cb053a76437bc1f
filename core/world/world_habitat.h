// The conditions that the fungi of a block find: its ground, the crowns above it, and the spores that have arrived.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <map>
#include <span>
#include <vector>

#include "core/world/canopy_light.h"
#include "core/world/mycelia.h"
#include "core/world/region.h"
#include "core/world/world.h"

namespace sporeprint {

/// Crowns grow slowly: the light below them is that of the middle of so many years.
inline constexpr int light_years = 40;

/// Returns the crown of a tree in summer.
[[nodiscard]] Crown crown_of(const World& world, const StandTree& tree, WorldTime time);

/// Returns lists of trees among which all of a rectangle are. They stay as long as the habitat.
using TreesIn = std::function<std::vector<std::span<const StandTree>>(const Region&)>;

/// The habitat of a piece of a world. Not for use by several threads.
class WorldHabitat : public Habitat {
  public:
    /// world   must outlive the habitat
    /// region  in which most of the places lie whose light is needed; others cost more
    WorldHabitat(const World& world, const Region& region, TreesIn trees);
    /// trees  of the block and its eight neighbours, in any order; must outlive the habitat
    WorldHabitat(const World& world, CellIndex block, std::span<const StandTree> trees);

    [[nodiscard]] Site site_at(WorldPoint place, WorldTime time) const override;
    [[nodiscard]] double establishment(std::size_t species, WorldPoint place,
                                       WorldTime time) const override;
    [[nodiscard]] double share(std::size_t species, WorldPoint place) const override;
    [[nodiscard]] double wetness_on(const Site& site, double soil_water) const override;

  private:
    [[nodiscard]] const CanopyLight& canopy_at(WorldPoint place, WorldTime time) const;
    [[nodiscard]] std::vector<Crown> crowns_over(const Region& region, WorldTime time) const;

    const World& world_;
    Region region_;
    TreesIn trees_;
    mutable std::map<int, CanopyLight> canopies_;  ///< of the rectangle, by steps
    /// Of squares that are not in the rectangle: by their columns, rows and steps.
    mutable std::map<std::array<std::int32_t, 3>, CanopyLight> farther_;
};

}  // namespace sporeprint
