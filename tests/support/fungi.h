// What tests of mycelia and of fruit bodies share: places that are the same everywhere, a stand of trees, species.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "core/math/elementary.h"
#include "core/math/random.h"
#include "core/world/mycelia.h"
#include "core/world/tree_growth.h"

namespace sporeprint::fungi {

/// Places that are the same everywhere.
class EvenHabitat : public Habitat {
  public:
    Site site;
    double established = 1.0;
    [[nodiscard]] Site site_at(WorldPoint, WorldTime) const override { return site; }
    [[nodiscard]] double establishment(std::size_t, WorldPoint, WorldTime) const override {
        return established;
    }
    /// That of level ground of mean wetness.
    [[nodiscard]] double wetness_on(const Site&, double soil_water) const override {
        return std::clamp(soil_water / 100.0, 0.0, 1.0);
    }
};

inline WorldPoint point(double x, double y) {
    return {static_cast<std::int32_t>(std::floor(x * units_of_metre + 0.5)),
            static_cast<std::int32_t>(std::floor(y * units_of_metre + 0.5))};
}

inline double distance(WorldPoint a, WorldPoint b) {
    const double x = metres(a.x) - metres(b.x), y = metres(a.y) - metres(b.y);
    return std::sqrt(x * x + y * y);
}

/// Trees one after another on the cells of a grid, and the trunks that they leave.
struct Grove {
    std::vector<StandTree> trees;
    std::vector<DeadWood> wood;
    [[nodiscard]] Surroundings around() const { return {trees, wood}; }
};

/// Returns the trees of blocks west to east and south to north, 400 per hectare: one in each cell of 5 m, each followed
/// by the next one.
inline Grove stand_of(int west, int south, int east, int north, int first_year, int last_year) {
    Grove stand;
    constexpr double cell = 5.0;
    const auto first = [](int block) { return static_cast<int>(std::floor(block * 64 / cell)); };
    for (int y = first(south); y < first(north + 1); ++y)
        for (int x = first(west); x < first(east + 1); ++x) {
            Random random(77, 5, static_cast<std::uint32_t>(y * 4096 + x + 8192 * 4096));
            int year = first_year - static_cast<int>(120.0 * random.uniform());
            for (std::uint32_t i = 0; year < last_year; ++i) {
                const double east_of = random.uniform(), north_of = random.uniform();
                const double life = random.uniform(), wait = random.uniform(),
                             height = random.uniform(), turn = random.uniform();
                StandTree tree;
                tree.id = (std::uint64_t{static_cast<std::uint32_t>(x + 8192)} << 40) |
                          (std::uint64_t{static_cast<std::uint32_t>(y + 8192)} << 16) | i;
                tree.at = point((x + east_of) * cell, (y + north_of) * cell);
                tree.born = time_of(year);
                tree.died = time_of(year + 60 + static_cast<int>(120.0 * life));
                tree.height = 22.0 + 10.0 * height;
                stand.trees.push_back(tree);
                DeadWood wood;
                wood.id = tree.id | std::uint64_t{1} << 63;
                wood.tree = tree.id;
                wood.at = tree.at;
                wood.died = tree.died;
                wood.fell = tree.died + static_cast<WorldTime>(10.0 * wait * ticks_of_year);
                wood.gone = tree.died + 45 * ticks_of_year;
                wood.direction = 2.0 * pi * turn;
                wood.length = 0.9 * height_at(tree, tree.died);
                wood.radius = 0.5 * trunk_diameter(height_at(tree, tree.died));
                wood.decay = 0.054;
                stand.wood.push_back(wood);
                year += 60 + static_cast<int>(120.0 * life);
            }
        }
    return stand;
}

inline FungusSpecies species_of(const char* id, Guild guild) {
    FungusSpecies species;
    species.stream = stream_of(id);
    species.ecology.guild = guild;
    species.months = 0b011111100000;  // June to November
    return species;
}

/// Returns a pioneer whose rings advance at a speed.
inline FungusSpecies pioneer(const char* id, double speed, double spread) {
    FungusSpecies species = species_of(id, Guild::ectomycorrhizal);
    species.ecology.ring.pioneer = true;
    species.ecology.genet.speed = speed;
    species.ecology.genet.rate = 0.0005;
    species.ecology.genet.life = 15.0;
    species.ecology.ring.spread = spread;
    return species;
}

inline FungusSpecies laccaria() {
    FungusSpecies species = pioneer("laccaria_laccata", 0.20, 0.14);
    species.ecology.ring.inner = 0.18;
    species.ecology.ring.arcs = 6;
    species.ecology.ring.covered = 0.9;
    species.ecology.fruit.density = 9.0;
    species.ecology.fruit.clusters = 6.0;
    species.ecology.fruit.cluster_spread = 0.063;
    species.ecology.fruit.tufts = 1.6;
    species.ecology.fruit.tuft_spread = 0.012;
    species.cap_radius = 0.015;
    return species;
}

inline FungusSpecies hebeloma() {
    FungusSpecies species = pioneer("hebeloma", 0.134, 0.06);
    species.ecology.ring.arcs = 6;
    species.ecology.ring.covered = 0.8;
    species.ecology.fruit.density = 8.0;
    species.ecology.fruit.clusters = 6.0;
    species.ecology.fruit.cluster_spread = 0.095;
    species.ecology.fruit.tufts = 1.0;
    species.ecology.fruit.tuft_spread = 0.012;
    species.cap_radius = 0.015;
    return species;
}

inline FungusSpecies lactarius() {
    FungusSpecies species = pioneer("lactarius_pubescens", 0.064, 0.05);
    species.ecology.fruit.density = 3.0;
    species.ecology.fruit.clusters = 1.5;
    species.ecology.fruit.cluster_spread = 0.06;
    species.cap_radius = 0.03;
    return species;
}

/// Returns a mycorrhizal species of grown trees.
inline FungusSpecies boletus(const char* id = "boletus") {
    FungusSpecies species = species_of(id, Guild::ectomycorrhizal);
    species.ecology.ring.spread = 0.4;
    species.ecology.fruit.density = 0.25;
    species.months = 0b011111000000;  // July to November
    species.cap_radius = 0.05;
    return species;
}

inline FungusSpecies clitocybe() {
    FungusSpecies species = species_of("clitocybe", Guild::litter);
    species.ecology.genet.speed = 0.3;
    species.ecology.genet.life = 20.0;
    species.ecology.fruit.density = 0.6;
    species.ecology.fruit.clusters = 3.0;
    return species;
}

inline FungusSpecies marasmius() {
    FungusSpecies species = species_of("marasmius_oreades", Guild::grass);
    species.ecology.genet.speed = 0.2;
    species.ecology.genet.life = 30.0;
    species.ecology.genet.reach = 20.0;
    species.ecology.fruit.density = 1.0;
    species.ecology.fruit.clusters = 3.0;
    return species;
}

inline FungusSpecies hypholoma() {
    FungusSpecies species = species_of("hypholoma", Guild::wood);
    species.ecology.decay = {0.2, 0.8};
    species.ecology.genet.speed = 0.5;
    species.ecology.genet.life = 15.0;
    species.ecology.fruit.density = 1.7;
    species.ecology.fruit.tufts = 12.0;
    species.ecology.fruit.tuft_spread = 0.04;
    species.cap_radius = 0.02;
    return species;
}

/// Returns a species of perennial brackets, also on trunks that stand.
inline FungusSpecies fomes() {
    FungusSpecies species = species_of("fomes_fomentarius", Guild::wood);
    species.ecology.decay = {0.0, 0.4};
    species.ecology.on_standing_wood = true;
    species.ecology.genet.speed = 0.5;
    species.ecology.genet.life = 15.0;
    species.ecology.fruit.density = 1.0;
    species.ecology.fruit.clusters = 1.5;
    species.ecology.body = {.days_to_mature = 1500, .days_alive = 2500, .perennial = true};
    species.cap_radius = 0.08;
    return species;
}

/// Returns the species of a forest: six mycorrhizal ones, two of litter, one of turf, three of wood.
inline std::vector<FungusSpecies> forest_species() {
    std::vector<FungusSpecies> species;
    for (const char* id : {"a", "b", "c", "d", "e", "f"}) species.push_back(boletus(id));
    species.push_back(clitocybe());
    species.push_back(clitocybe());
    species.back().stream = stream_of("collybia");
    species.push_back(marasmius());
    species.push_back(hypholoma());
    species.push_back(fomes());
    species.push_back(hypholoma());
    species.back().stream = stream_of("mycena");
    species.back().ecology.decay = {0.4, 0.95};
    // Turf needs light.
    species[8].ecology.light = {{0.6, 1.0}, {0.8, 1.0}};
    return species;
}

/// Returns a young birch in the middle of the block (0, 0), and its age at a moment.
inline StandTree young_birch(WorldTime born) {
    StandTree tree;
    tree.id = 4711;
    tree.at = point(32.0, 32.0);
    tree.born = born;
    tree.died = born + 60 * ticks_of_year;
    tree.height = 18.0;
    return tree;
}

}  // namespace sporeprint::fungi
