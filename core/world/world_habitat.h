// The conditions that the fungi of a block find: its ground, the crowns above it, and the spores that have arrived.
#pragma once

#include <map>
#include <span>
#include <vector>

#include "core/world/canopy_light.h"
#include "core/world/mycelia.h"
#include "core/world/world.h"

namespace sporeprint {

/// Crowns grow slowly: the light below them is that of the middle of so many years.
inline constexpr int light_years = 40;

/// Returns the crown of a tree in summer.
[[nodiscard]] Crown crown_of(const World& world, const StandTree& tree, WorldTime time);

/// The habitat of a block of a world. Not for use by several threads.
class WorldHabitat : public Habitat {
  public:
    /// world  must outlive the habitat
    /// trees  of the block and its eight neighbours, in any order; likewise
    WorldHabitat(const World& world, CellIndex block, std::span<const StandTree> trees);

    [[nodiscard]] Site site_at(WorldPoint place, WorldTime time) const override;
    [[nodiscard]] double establishment(std::size_t species, WorldPoint place,
                                       WorldTime time) const override;
    [[nodiscard]] double wetness_on(const Site& site, double soil_water) const override;

  private:
    [[nodiscard]] const CanopyLight& canopy_at(WorldTime time) const;

    const World& world_;
    std::vector<const StandTree*> trees_;  ///< near the block, by ids
    mutable std::map<int, CanopyLight> canopies_;
};

}  // namespace sporeprint
