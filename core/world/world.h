// A world as its blocks are computed from: its parameters, its ground, its stand and its fungi.
#pragma once

#include <array>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/images.h"
#include "core/model/ecology.h"
#include "core/world/dead_wood.h"
#include "core/world/ground.h"
#include "core/world/horizon.h"
#include "core/world/mycelia.h"
#include "core/world/spread.h"
#include "core/world/stand.h"
#include "core/world/weather.h"
#include "core/world/world_edits.h"
#include "core/world/world_params.h"

namespace sporeprint {

/// What a world needs to know of a species.
struct SpeciesRecord {
    Ecology ecology;
    std::uint16_t months = 0;  ///< in which it fruits in the north: bit 0 is January
    double cap_radius = 0.02;  ///< metres
};

/// The kinds of trees and the species that a world can have, by their ids; nullptr for those that are not known.
struct WorldLookup {
    std::function<const TreeEcology*(std::string_view id)> tree;
    std::function<std::optional<SpeciesRecord>(std::string_view id)> species;
};

/// Returns the stand of a world.
///
/// throws  InvalidInput (path "stand.kinds" or "stand.lone") for a kind that is not known
[[nodiscard]] Stand stand_of(const WorldParams& params, const WorldLookup& lookup);

/// A world, ready to be looked at. About 3 MB with its ground, and 0.2 MB for each species.
struct World {
    WorldParams params;
    Stand stand;
    std::shared_ptr<const Ground> ground;
    Horizon horizon;
    SunDay sun;                 ///< of midsummer
    double autumn_water = 0.0;  ///< mean of the soil's water in September and October, mm
    std::vector<std::string> species_ids;
    std::vector<FungusSpecies> species;
    std::vector<Establishment> establishment;  ///< of each species
    std::string key;                           ///< all parameters and edits, for caches
    SharedEdits edits;                         ///< null if it has none
    /// The masks of each species; empty if no species has one.
    std::vector<std::vector<std::shared_ptr<const WorldMask>>> masks;

    /// Returns what a place has to give to what grows there, crowns not considered.
    [[nodiscard]] Site site_at(WorldPoint at) const;
    /// Returns the same with less light: that of the sky alone, without the sun. It costs a fifth.
    [[nodiscard]] Site dim_site_at(WorldPoint at) const;
    /// Returns the ground at a place; beyond the world it is that of its rim.
    [[nodiscard]] Place place_at(WorldPoint at) const;
    /// Returns the share of a species that a place may have by the masks of the world, 0..1.
    [[nodiscard]] double share_at(std::size_t of_species, WorldPoint at) const;
    /// Returns the direction to which the wind blows most, radians from east to north.
    [[nodiscard]] double downwind() const;
    /// Returns the memory that it takes, its ground not counted.
    [[nodiscard]] std::size_t bytes() const;
};

/// Returns the key of a world for caches.
///
/// edits  settled, or null
[[nodiscard]] std::string world_key(const WorldParams& params, const SharedEdits& edits = nullptr);

/// Computes a world over its ground.
///
/// parallel  spreads species side by side
/// edits     settled, or null; those of species that the world does not have are ignored
/// throws  InvalidInput as stand_of() does, or (path "fungi.species") for a species that is not known
/// cost    50 ms, and 15 ms for each species
[[nodiscard]] World world_of(const WorldParams& params, const WorldLookup& lookup,
                             std::shared_ptr<const Ground> ground,
                             const Parallel& parallel = in_turn, SharedEdits edits = nullptr);

/// What stands and lies in one block, of all times.
struct Block {
    std::vector<StandTree> trees;  ///< by ascending ids
    std::vector<DeadWood> dead;    ///< likewise
    Falls falls;                   ///< from which dead wood is computed

    /// Returns the memory that it takes.
    [[nodiscard]] std::size_t bytes() const;
};

/// The mycelia of a block that live at some time of an epoch, by ascending ids.
struct BlockMycelia {
    std::vector<Genet> genets;

    /// Returns the memory that it takes.
    [[nodiscard]] std::size_t bytes() const {
        return sizeof(*this) + genets.size() * sizeof(Genet);
    }
};

/// The fruit bodies of a block that stand at some time of a year, by ascending ids.
struct BlockSeason {
    std::vector<FruitBody> bodies;

    /// Returns the memory that it takes.
    [[nodiscard]] std::size_t bytes() const {
        return sizeof(*this) + bodies.size() * sizeof(FruitBody);
    }
};

/// Computes the trees of a block of a world, by ascending ids.
///
/// cost    about 15 ms
[[nodiscard]] std::vector<StandTree> trees_of_block(const World& world, CellIndex block);

/// Computes what trunks may fall on of the trees of a block.
[[nodiscard]] Falls falls_of_block(const World& world, std::span<const StandTree> trees);

/// Computes the dead wood of a block of a world, by ascending ids.
///
/// trees   of the block
/// near    falls of the block and of the eight round it
/// cost    about 5 ms
[[nodiscard]] std::vector<DeadWood> wood_of_block(const World& world,
                                                  std::span<const StandTree> trees,
                                                  std::span<const Falls* const> near);

/// Computes a block of a world, without its falls.
///
/// cost    that of the trees of nine blocks
[[nodiscard]] Block block_of(const World& world, CellIndex block);

/// Returns a block and the eight round it, itself in the middle of the list.
[[nodiscard]] std::array<CellIndex, 9> blocks_about(CellIndex block);

/// Returns the blocks that a rectangle is part of, by rows from the south.
[[nodiscard]] std::vector<CellIndex> blocks_of(const WorldBox& box);

/// Returns whether a place belongs to a rectangle: its west and south sides do, the others do not.
[[nodiscard]] bool contains(const WorldBox& box, WorldPoint at);

}  // namespace sporeprint
