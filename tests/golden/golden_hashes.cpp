// Compares a hash of each of many whole GLB files with the one written down, or writes them down.
//   golden_hashes check FILE     golden_hashes bless FILE
// A line of the file: generator_version species age lod texture_size hash; a leaf has its preset and autumn in their
// place, a tree its preset and seed, a colony its species and the number of individuals.

#include <xxhash.h>

#include <cinttypes>
#include <cstdio>
#include <exception>
#include <fstream>
#include <map>
#include <memory>
#include <string>

#include "core/grow/colony.h"
#include "core/grow/leaf.h"
#include "core/grow/mushroom.h"
#include "core/grow/tree.h"
#include "core/params/value.h"

namespace {

using namespace sporeprint;

std::string hash_of(const Body& body) {
    const std::unique_ptr<XXH3_state_t, decltype(&XXH3_freeState)> state(XXH3_createState(),
                                                                         &XXH3_freeState);
    XXH3_64bits_reset(state.get());
    for (const Slice& slice : body) XXH3_64bits_update(state.get(), slice.data(), slice.size);
    char text[17];
    std::snprintf(text, sizeof text, "%016" PRIx64, std::uint64_t{XXH3_64bits_digest(state.get())});
    return text;
}

using Hashes = std::map<std::string, std::string>;  // "species age lod texture_size" -> hash

std::string line_of(const std::string& id, double age, int lod, int side) {
    return id + ' ' + number_text(age) + ' ' + std::to_string(lod) + ' ' + std::to_string(side);
}

/// Each leaf through the year, at every level of detail, small.
void add_leaves(Hashes& hashes) {
    for (const LeafPreset& preset : leaf_presets())
        for (const double autumn : {0.0, 0.5, 1.0})
            for (int lod = 0; lod < leaf_lods; ++lod) {
                LeafOrder order{preset.id, params_of(preset)};
                order.params.autumn = autumn;
                order.params.lod = lod;
                order.params.texture_size.value = 128;
                hashes[line_of(std::string("leaf/") + preset.id, autumn, lod, 128)] =
                    hash_of(grow_leaf(order).glb);
            }
}

/// Some individuals of each tree, at every level of detail, small.
void add_trees(Hashes& hashes) {
    for (const TreePreset& preset : tree_presets())
        for (const std::uint32_t seed : {1u, 2u, 3u})
            for (int lod = 0; lod < tree_lods; ++lod) {
                TreeOrder order{preset.id, params_of(preset)};
                order.params.seed = seed;
                order.params.lod = lod;
                order.params.texture_size.value = 128;
                hashes[line_of(std::string("tree/") + preset.id, seed, lod, 128)] =
                    hash_of(grow_tree(order).glb);
            }
}

/// Each species' colony in its own habit, at every level of detail, small; and two on roots, instanced.
void add_colonies(Hashes& hashes, const Atlas& atlas) {
    const auto add = [&](const std::string& id, const std::string& called, ColonyParams params) {
        params.texture_size.value = 128;
        hashes[line_of("colony/" + called, params.count, params.lod, 128)] =
            hash_of(grow_colony({.mix = {{id, 1000}}, .params = params}, atlas).glb);
    };
    for (const AtlasEntry& entry : atlas.entries())
        for (int lod = 0; lod < 4; ++lod) {
            ColonyParams params;
            params.count = 9;
            params.distinct = 3;
            params.lod = lod;
            add(entry.species.id.string(), entry.species.id.string(), params);
        }
    for (const char* id : {"hypholoma_fasciculare", "lycoperdon_perlatum"}) {
        ColonyParams params;
        params.count = 64;
        params.habit = Habit::rooted;
        params.instancing = Instancing::gpu;
        add(id, std::string(id) + "/rooted", params);
    }
}

/// Each species at several ages and every level of detail, small; and once as a game would ask for it. Then leaves, trees and colonies.
Hashes hashes_of_today() {
    const auto atlas = built_in_atlas();
    Hashes hashes;
    const auto add = [&](const AtlasEntry& entry, double age, int lod, int side) {
        MushroomOrder order{.mix = {{entry.species.id.string(), 1000}}, .model = {}, .params = {}};
        order.params.age = age;
        order.params.lod = lod;
        order.params.texture_size.value = side;
        hashes[line_of(entry.species.id.string(), age, lod, side)] =
            hash_of(grow_mushroom(order, *atlas).glb);
    };
    for (const AtlasEntry& entry : atlas->entries()) {
        for (const double age : {0.0, 0.3, 0.6, 0.85, 1.0})
            for (int lod = 0; lod < 4; ++lod) add(entry, age, lod, 128);
        add(entry, 0.6, 0, 512);
    }
    add_leaves(hashes);
    add_trees(hashes);
    add_colonies(hashes, *atlas);
    return hashes;
}

/// The hashes written down, and the generator version they belong to.
std::pair<Hashes, int> written(const char* path) {
    Hashes hashes;
    int version = 0;
    std::ifstream file(path);
    std::string species, age, lod, side, hash;
    while (file >> version >> species >> age >> lod >> side >> hash)
        hashes[species + ' ' + age + ' ' + lod + ' ' + side] = hash;
    return {hashes, version};
}

int check(const char* path) {
    const auto [golden, version] = written(path);
    if (golden.empty()) {
        std::printf("%s holds no hashes: bless\n", path);
        return 1;
    }
    const Hashes today = hashes_of_today();
    std::size_t changed = 0, missing = 0, gone = 0;
    for (const auto& [request, hash] : today) {
        const auto old = golden.find(request);
        if (old == golden.end()) {
            ++missing;
        } else if (old->second != hash) {
            if (changed++ < 10) std::printf("other bytes: %s\n", request.c_str());
        }
    }
    for (const auto& [request, hash] : golden) gone += today.contains(request) ? 0 : 1;
    if (changed + missing + gone == 0 && version == generator_version) {
        std::printf("%zu files have the bytes they had\n", today.size());
        return 0;
    }
    std::printf("%zu of %zu files changed, %zu are new, %zu are gone\n", changed, today.size(),
                missing, gone);
    std::puts(changed > 0 && version == generator_version ? "raise generator_version, then bless"
                                                          : "bless");
    return 1;
}

int bless(const char* path) {
    const Hashes today = hashes_of_today();
    std::ofstream file(path);
    for (const auto& [request, hash] : today)
        file << generator_version << ' ' << request << ' ' << hash << '\n';
    file.close();
    if (!file) {
        std::printf("%s cannot be written\n", path);
        return 1;
    }
    std::printf("%zu hashes written\n", today.size());
    return 0;
}

}  // namespace

int main(int argc, char** argv) try {
    const std::string what = argc == 3 ? argv[1] : "";
    if (what == "check") return check(argv[2]);
    if (what == "bless") return bless(argv[2]);
    std::fputs("usage: golden_hashes check FILE | golden_hashes bless FILE\n", stderr);
    return 2;
} catch (const std::exception& error) {
    std::fprintf(stderr, "golden_hashes: %s\n", error.what());
    return 1;
}
