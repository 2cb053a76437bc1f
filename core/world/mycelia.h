// The mycelia of a block of a world: where and when they begin, how far they have spread, and which of them has a
// place.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "core/model/ecology.h"
#include "core/world/records.h"
#include "core/world/region.h"
#include "core/world/site.h"

namespace sporeprint {

/// A species of fungi in a world.
struct FungusSpecies {
    Ecology ecology;
    std::uint32_t stream = 0;           ///< stream_of its id: its draws
    std::uint16_t months = 0;           ///< in which it fruits: bit 0 is January
    std::uint32_t kinds = 0xFFFFFFFFU;  ///< bit k: it lives with kind k of the stand
    double cap_radius = 0.02;           ///< metres
    /// Returns whether it lives with a kind of the stand.
    [[nodiscard]] bool lives_with(std::uint8_t kind) const {
        return kind < 32 && (kinds >> kind & 1U) != 0;
    }
};

/// Returns which kinds of a stand an ecology lives with, one bit for each; all if it names none.
///
/// kinds  names of the kinds of the stand, at most 32
[[nodiscard]] std::uint32_t kinds_of(const Ecology& ecology, std::span<const std::string> kinds);

/// What mycelia and fruit bodies depend on besides trees. Values are functions of their arguments and the world alone.
class Habitat {
  public:
    Habitat() = default;
    Habitat(const Habitat&) = delete;
    Habitat& operator=(const Habitat&) = delete;
    virtual ~Habitat() = default;

    [[nodiscard]] virtual Site site_at(WorldPoint place, WorldTime time) const = 0;
    /// Returns how likely spores of a species have arrived and grown, 0..1.
    [[nodiscard]] virtual double establishment(std::size_t species, WorldPoint place,
                                               WorldTime time) const = 0;
    /// Returns the share of a species that a place may have, 0..1: suitability is multiplied by it.
    [[nodiscard]] virtual double share([[maybe_unused]] std::size_t species,
                                       [[maybe_unused]] WorldPoint place) const {
        return 1.0;
    }
    /// Returns how wet the ground of a site is on a day, 0..1.
    ///
    /// soil_water  mean of the world on that day, mm
    [[nodiscard]] virtual double wetness_on(const Site& site, double soil_water) const = 0;
};

/// The fungi of a world.
struct Fungi {
    std::uint32_t seed = 0;  ///< of the world
    std::span<const FungusSpecies> species;
    const Habitat& habitat;
};

/// Trees and dead wood of a block and its eight neighbours, or those that influence.h names, in any order. More of
/// either changes nothing.
struct Surroundings {
    std::span<const StandTree> trees;
    std::span<const DeadWood> wood;
};

/// Age from which on trees have the mycorrhizas of grown ones, and litter lies under them, years.
inline constexpr double age_of_host = 12.0;

/// No mycelium of the ground begins nearer to the centre of another one of its species, metres [DahlbergStenlid1990].
inline constexpr double founding_distance = 1.5;

/// Returns the smallest of the responses of a species to a site.
[[nodiscard]] double suitability(const Ecology& ecology, const Site& site);

/// Returns how far a mycelium has spread in all directions, metres; 0 before its birth.
[[nodiscard]] double radius_at(const Genet& genet, WorldTime time);

/// Returns when a mycelium arrives at a distance from its centre, years; infinity if it never does.
[[nodiscard]] double arrival(const Genet& genet, double distance);

/// Returns the mycelium that has a place at a moment, or null: of those of the species that live and have arrived, the
/// one that arrived first. So none grows through another, and two margins stop where they meet.
///
/// source  cones in space and time: [Stevenson1976] after Parker-Rhodes
[[nodiscard]] const Genet* owner_of(std::span<const Genet> genets, std::uint8_t species,
                                    WorldPoint place, WorldTime time);

/// Whether there is at a place what a species lives on.
struct FungusSubstrate {
    bool is_there = false;
    std::uint64_t record =
        0;  ///< id of its host, or of the trunk or the tree whose litter it is; 0 for turf
};

/// Returns what a species would live on at a place: the nearest tree that is a host and whose roots reach it, litter of
/// the nearest tree, wood within 0.3 m that has decayed as far as it must have, or turf, which is everywhere.
[[nodiscard]] FungusSubstrate substrate_at(const Surroundings& around, const FungusSpecies& species,
                                           WorldPoint place, WorldTime time);

/// Returns the mycelia whose centres lie in a block and that live at some time of an epoch, sorted by id. An epoch
/// before or after has the same ones where they live in both, and neighbouring blocks have none of them.
///
/// Mycelia begin at random places and times (on wood: at random places of the bark; pioneers: with their host), and
/// grow up where spores have arrived, the least satisfied response allows it, there is what they live on, and no older
/// mycelium of their species has the place. The last condition is evaluated in three rounds, so that what happens more
/// than three times the reach away has no influence; an odd number of rounds leaves none inside another.
///
/// epoch   the years from 40 epoch to 40 epoch + 39; may be negative
/// around  trees and wood of all times
/// cost    about 1 ms for 12 species
[[nodiscard]] std::vector<Genet> genets_of(const Fungi& fungi, CellIndex block, int epoch,
                                           const Surroundings& around);

/// Returns the mycelia on which the fruit bodies in a rectangle depend, among them perhaps others: those of the ground
/// as near as influence.h says, and all of the trunks that lie or stand as near. Those of genets_of() are the same.
[[nodiscard]] std::vector<Genet> genets_round(const Fungi& fungi, const Region& region, int epoch,
                                              const Surroundings& around);

}  // namespace sporeprint
