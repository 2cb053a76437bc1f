// The one program that hashes whole GLB files, from core alone. It has two uses:
//
//   hashes check FILE             compares the hash of each golden request with the one in FILE
//   hashes bless FILE             writes the golden hashes of this build to FILE
//   hashes print [COUNT] [SIMD]   prints the hashes of COUNT random mushrooms, a fifth as many leaves and colonies, and a
//                                 tenth as many trees and traces, some worlds, computed with one instruction set; requests that core refuses are
//                                 printed with the refusal
//   hashes --simd-names           prints the instruction sets of this processor
//
// A line of FILE is: generator_version, what is grown, its age, level of detail, texture size and hash. A leaf has its autumn
// in place of the age, a tree its seed, a colony the number of individuals, a morph the weight of its second species.
// The ground of a world has its seed, and its extent in place of the texture size; a year of weather has its number.
// tests/golden/equal_bytes.sh compares what builds by other compilers print.

#include <xxhash.h>

#include <algorithm>
#include <atomic>
#include <charconv>
#include <cinttypes>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <fstream>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <thread>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "core/grow/colony.h"
#include "core/grow/leaf.h"
#include "core/grow/mushroom.h"
#include "core/grow/set_file.h"
#include "core/grow/tree.h"
#include "core/grow/world/placements.h"
#include "core/grow/world/plot_of_world.h"
#include "core/grow/world/tile.h"
#include "core/math/noise.h"
#include "core/math/random.h"
#include "core/params/query.h"
#include "core/params/value.h"
#include "core/render/render.h"
#include "core/trace/cut.h"
#include "core/trace/trace.h"
#include "core/world/maps.h"
#include "core/world/weather.h"
#include "core/world/world_habitat.h"
#include "tests/support/atlas.h"

namespace {

using namespace sporeprint;

/// Returns the XXH3 hash of all slices as sixteen hexadecimal digits.
std::string hash_of(const Body& body) {
    const std::unique_ptr<XXH3_state_t, decltype(&XXH3_freeState)> state(XXH3_createState(),
                                                                         &XXH3_freeState);
    XXH3_64bits_reset(state.get());
    for (const Slice& slice : body) XXH3_64bits_update(state.get(), slice.data(), slice.size);
    char text[17];
    std::snprintf(text, sizeof text, "%016" PRIx64, std::uint64_t{XXH3_64bits_digest(state.get())});
    return text;
}

// ---- golden requests

/// Name of a golden request, "what age lod texture_size", and the function that grows its file.
using Requests = std::map<std::string, std::function<Body()>>;
using Hashes = std::map<std::string, std::string>;

constexpr int small_side = 128;

std::string line_of(const std::string& id, double age, int lod, int side) {
    return id + ' ' + number_text(age) + ' ' + std::to_string(lod) + ' ' + std::to_string(side);
}

/// Returns the order of a species or mix, painted small.
MushroomSpec order_of(Mix mix, double age, int lod, int side = small_side) {
    MushroomSpec spec{.mix = std::move(mix), .model = {}, .params = {}};
    spec.params.age = age;
    spec.params.lod = lod;
    spec.params.texture_size.value = side;
    return spec;
}

/// Adds a mushroom under the name `called`.
void add_mushroom(Requests& requests, const std::shared_ptr<const Atlas>& atlas,
                  const std::string& called, const MushroomSpec& spec) {
    requests[line_of(called, spec.params.age, spec.params.lod, spec.params.texture_size.value)] =
        [spec, atlas] { return grow_mushroom(spec, *atlas).glb; };
}

/// Adds each species at several ages and every level of detail, small; and once as a game would ask for it.
void add_species(Requests& requests, const std::shared_ptr<const Atlas>& atlas) {
    for (const AtlasEntry& entry : atlas->entries()) {
        const std::string id = entry.species.id.string();
        for (const double age : {0.0, 0.3, 0.6, 0.85, 1.0})
            for (int lod = 0; lod < 4; ++lod)
                add_mushroom(requests, atlas, id, order_of({{id, 1000}}, age, lod));
        add_mushroom(requests, atlas, id, order_of({{id, 1000}}, 0.6, 0, 512));
    }
}

/// Returns the ids of the species of one family: those turned round an axis, or corals and antlers.
std::vector<std::string> family_of(const Atlas& atlas, bool branched) {
    std::vector<std::string> ids;
    for (const AtlasEntry& entry : atlas.entries())
        if (std::holds_alternative<Branched>(entry.species.stages.front().model.shape) == branched)
            ids.push_back(entry.species.id.string());
    return ids;
}

std::string name_of(const Mix& mix) {
    std::string name;
    for (const MixPart& part : mix)
        name += (name.empty() ? "" : ",") + part.id + ':' + number_text(part.weight / 1000.0);
    return name;
}

/// Adds each species mixed with the next of its family at one level of detail, and larger mixes at all of them.
void add_mixes(Requests& requests, const std::shared_ptr<const Atlas>& atlas) {
    const auto add = [&](const Mix& mix, double age, int lod) {
        add_mushroom(requests, atlas, "mix/" + name_of(mix), order_of(mix, age, lod));
    };
    for (const bool branched : {false, true}) {
        const auto ids = family_of(*atlas, branched);
        for (std::size_t i = 0; i + 1 < ids.size(); ++i)
            add({{ids[i], 400}, {ids[i + 1], 600}}, 0.6, static_cast<int>(i % 4));
        // From three species up to as many as a mix may have, taken at even distances.
        for (const std::size_t count : {std::size_t{3}, std::size_t{8}}) {
            if (ids.size() < count) continue;
            Mix mix;
            for (std::size_t i = 0; i < count; ++i)
                mix.push_back({ids[i * ids.size() / count], static_cast<int>(1000 / count)});
            mix.back().weight += 1000 % static_cast<int>(count);
            for (int lod = 0; lod < 4; ++lod) add(mix, 0.5, lod);
        }
    }
}

/// Adds what stands between two species, for some near and far pairs: the file at each weight of the second one.
void add_morphs(Requests& requests, const std::shared_ptr<const Atlas>& atlas) {
    constexpr const char* pairs[][2] = {{"amanita_muscaria", "boletus_edulis"},
                                        {"cantharellus_cibarius", "trametes_versicolor"},
                                        {"coprinus_comatus", "phallus_impudicus"},
                                        {"ramaria_formosa", "xylaria_hypoxylon"}};
    for (const auto& [a, b] : pairs)
        for (const int weight : {1, 250, 500, 750, 999})
            for (const int lod : {0, 2}) {
                const MushroomSpec spec = order_of({{a, 1000 - weight}, {b, weight}}, 0.6, lod);
                requests[line_of(std::string("morph/") + a + '~' + b, weight / 1000.0, lod,
                                 small_side)] = [spec, atlas] {
                    return grow_mushroom(spec, *atlas).glb;
                };
            }
}

/// Adds the growth clip of each species and of some mixes, with few and many frames.
void add_clips(Requests& requests, const std::shared_ptr<const Atlas>& atlas) {
    const auto add = [&](const Mix& mix, double age, int lod, int frames) {
        MushroomSpec spec = order_of(mix, age, lod);
        spec.params.animation = Animation::growth;
        spec.params.frames = frames;
        const std::string whose = mix.size() == 1 ? mix.front().id : name_of(mix);
        add_mushroom(requests, atlas, "clip/" + whose + '/' + std::to_string(frames), spec);
    };
    for (const AtlasEntry& entry : atlas->entries()) {
        const std::string id = entry.species.id.string();
        add({{id, 1000}}, 0.6, 2, 9);
        add({{id, 1000}}, 0.37, 3, 2);
    }
    add({{"amanita_muscaria", 1000}}, 0.6, 0, 5);
    add({{"amanita_muscaria", 1000}}, 1.0, 1, 16);
    add({{"amanita_muscaria", 500}, {"boletus_edulis", 500}}, 0.6, 1, 9);
    add({{"ramaria_formosa", 500}, {"xylaria_hypoxylon", 500}}, 0.6, 2, 9);
}

/// Adds some mushrooms between the whole levels of detail, by their number of triangles.
void add_triangles(Requests& requests, const std::shared_ptr<const Atlas>& atlas) {
    for (const char* id : {"amanita_muscaria", "boletus_edulis", "morchella_esculenta",
                           "trametes_versicolor", "ramaria_formosa"})
        for (const int triangles : {12'000, 2'500, 400}) {
            MushroomSpec spec = order_of({{id, 1000}}, 0.6, 0);
            spec.params.triangles = triangles;
            add_mushroom(requests, atlas, "triangles/" + std::to_string(triangles) + '/' + id,
                         spec);
        }
}

/// Adds every effect of the weather at half and at full strength on each species of a list that can have it.
///
/// throws  std::logic_error for an effect that none of these species can have: the list then lacks a species
void add_weathering(Requests& requests, const std::shared_ptr<const Atlas>& atlas) {
    constexpr const char* species[] = {"amanita_muscaria", "boletus_edulis",
                                       "coprinus_comatus", "trametes_versicolor",
                                       "ramaria_formosa",  "disciotis_venosa"};
    WeatheringOf<Maybe>::fields([&](auto effect, const Info& info) {
        bool found = false;
        for (const char* id : species)
            for (const double strength : {0.5, 1.0})
                for (const int lod : {0, 2}) {
                    MushroomSpec spec = order_of({{id, 1000}}, 0.85, lod);
                    spec.params.weathering.*effect = strength;
                    try {
                        static_cast<void>(estimate(spec, *atlas));
                    } catch (const InvalidInput&) {
                        continue;  // This species cannot have the effect.
                    }
                    found = true;
                    add_mushroom(requests, atlas,
                                 std::string("weathering/") + std::string(info.name) + '/' +
                                     number_text(strength) + '/' + id,
                                 spec);
                }
        if (!found)
            throw std::logic_error("no species of the list can have " + std::string(info.name));
    });
}

/// Adds each leaf through the year, at every level of detail, small.
void add_leaves(Requests& requests) {
    for (const LeafPreset& preset : leaf_presets())
        for (const double autumn : {0.0, 0.5, 1.0})
            for (int lod = 0; lod < leaf_lods; ++lod) {
                LeafSpec spec{preset.id.string(), params_of(preset)};
                spec.params.autumn = autumn;
                spec.params.lod = lod;
                spec.params.texture_size.value = small_side;
                requests[line_of("leaf/" + preset.id.string(), autumn, lod, small_side)] = [spec] {
                    return grow_leaf(spec, atlas()).glb;
                };
            }
}

/// Adds some individuals of each tree, at every level of detail, small.
void add_trees(Requests& requests) {
    for (const TreePreset& preset : tree_presets())
        for (const std::uint32_t seed : {1u, 2u, 3u})
            for (int lod = 0; lod < tree_lods; ++lod) {
                TreeSpec spec{preset.id.string(), params_of(preset)};
                spec.params.seed = seed;
                spec.params.lod = lod;
                spec.params.texture_size.value = small_side;
                requests[line_of("tree/" + preset.id.string(), seed, lod, small_side)] = [spec] {
                    return grow_tree(spec, atlas()).glb;
                };
            }
}

template <class T>
void append(Bytes& bytes, const T& value) {
    const auto* const first = reinterpret_cast<const std::uint8_t*>(&value);
    bytes.insert(bytes.end(), first, first + sizeof value);
}

/// Returns the ground of a world, and maps of it.
Body ground_body(const WorldParams& params) {
    const Ground ground = ground_of(params);
    Bytes bytes = ground.streams;
    for (const std::int32_t height : ground.heights) append(bytes, height);
    for (const std::uint16_t index : ground.wetness) append(bytes, index);
    const MapFrame frame = frame_of(extent_of(params), 101);
    for (int i = 0; name(static_cast<WorldMap>(i)); ++i) {
        const auto map = static_cast<WorldMap>(i);
        if (needs_world(map) || map == WorldMap::wind) continue;
        for (const std::uint16_t number :
             map_of(map, {.ground = ground, .soil_water = 60.0}, frame))
            append(bytes, number);
    }
    return {Slice(std::make_shared<const Bytes>(std::move(bytes)))};
}

Body weather_body(const WorldParams& params, int year) {
    Bytes bytes;
    for (const WeatherDay& day : weather_of(params.climate, params.seed, year))
        for (const double value : {day.rain, day.temperature, day.evaporation, day.soil_water})
            append(bytes, value);
    return {Slice(std::make_shared<const Bytes>(std::move(bytes)))};
}

/// Adds the ground of each world, at the smallest extent and one at every extent, and some years of weather.
void add_worlds(Requests& requests) {
    const auto add = [&](const std::string& id, const WorldParams& params) {
        requests[line_of("world/" + id, params.seed, 0, params.extent)] = [params] {
            return ground_body(params);
        };
    };
    for (const WorldPreset& preset : atlas().worlds()) {
        WorldParams params = params_of(preset);
        params.extent.value = 256;
        add(preset.id.string(), params);
        for (const int year : {0, 80, 200})
            requests[line_of("weather/" + preset.id.string(), year, 0, 0)] = [params, year] {
                return weather_body(params, year);
            };
    }
    for (const int extent : {1024, 4096}) {
        WorldParams params;
        params.extent.value = extent;
        add("default", params);
    }
}

/// Returns the trees, dead wood, mycelia and fruit bodies of a block of a world as numbers.
Body block_body(const WorldParams& params, int year) {
    const World world =
        world_of(params, lookup_in(atlas()), std::make_shared<const Ground>(ground_of(params)));
    Bytes bytes;
    const auto append_place = [&](std::uint64_t id, WorldPoint at, WorldTime from, WorldTime to) {
        append(bytes, id);
        append(bytes, at);
        append(bytes, from);
        append(bytes, to);
    };
    const Block block = block_of(world, {0, 0});
    for (const StandTree& tree : block.trees) append_place(tree.id, tree.at, tree.born, tree.died);
    for (const DeadWood& wood : block.dead) {
        append_place(wood.id, wood.at, wood.fell, wood.gone);
        append(bytes, wood.direction);
    }
    for (const Establishment& one : world.establishment)
        bytes.insert(bytes.end(), one.shares.back().begin(), one.shares.back().end());
    const WorldHabitat habitat(world, {0, 0}, block.trees);
    const Fungi fungi{params.seed, world.species, habitat};
    const Surroundings around{block.trees, block.dead};
    const std::vector<Genet> genets = genets_of(fungi, {0, 0}, epoch_of(year), around);
    for (const Genet& one : genets) append_place(one.id, one.centre, one.born, one.died);
    const SeasonConditions conditions =
        conditions_of(world.species, weather_of(params.climate, params.seed, year - 1),
                      weather_of(params.climate, params.seed, year));
    for (const FruitBody& body :
         season_of(fungi, {CellIndex{0, 0}, year, genets, around}, conditions, 1.0))
        append_place(body.id, body.at, body.emerged, body.gone);
    return {Slice(std::make_shared<const Bytes>(std::move(bytes)))};
}

/// Returns a small plot of a world.
Body plot_body(const WorldParams& params) {
    auto world = std::make_shared<const World>(
        world_of(params, lookup_in(atlas()), std::make_shared<const Ground>(ground_of(params))));
    const auto plot = plot_of_world(std::move(world), {3.0, -2.0, 4.0}, time_of(80, 270), {});
    PlotOptions options;
    options.texture_size = 256;
    return grow_plot(plot->content, options, atlas()).glb;
}

/// Returns where things of a world stand, and maps of its light and of the spores of a species.
Body placements_body(const WorldParams& params) {
    const World world =
        world_of(params, lookup_in(atlas()), std::make_shared<const Ground>(ground_of(params)));
    const WorldBox box{-12.0, -8.0, 12.0, 16.0};
    constexpr int year = 80;
    const WorldTime time = time_of(year, 270);
    Bytes bytes;
    for (const Placement& row : placements_in(world, box, time, {}, atlas(), {}).rows) {
        append(bytes, row.id);
        append(bytes, row.host);
        append(bytes, row.place.translation);
        append(bytes, row.place.rotation);
        append(bytes, row.place.scale);
        append(bytes, row.age);
    }
    const MapInputs inputs{
        .ground = *world.ground, .world = &world, .year = year, .crowns = [&](CellIndex block) {
            const double west = block.x * block_side, south = block.y * block_side;
            const WorldBox of_block{west, south, west + block_side, south + block_side};
            return crowns_in(world, blocks_round(world, of_block, {}).trees,
                             {west - 64.0, south - 64.0, west + 128.0, south + 128.0}, time);
        }};
    for (const WorldMap map : {WorldMap::sky, WorldMap::light, WorldMap::canopy, WorldMap::spores})
        for (const std::uint16_t number : map_of(map, inputs, frame_of(box, 49)))
            append(bytes, number);
    return {Slice(std::make_shared<const Bytes>(std::move(bytes)))};
}

/// Returns maps of the wind and of how probable species are.
Body more_maps_body(const WorldParams& params) {
    const World world =
        world_of(params, lookup_in(atlas()), std::make_shared<const Ground>(ground_of(params)));
    constexpr int year = 80;
    const WorldBox box{-12.0, -8.0, 12.0, 16.0};
    const MapInputs inputs{.ground = *world.ground,
                           .world = &world,
                           .year = year,
                           .climate = params.climate,
                           .crowns = [&](CellIndex) {
                               return crowns_in(world, blocks_round(world, box, {}).trees,
                                                {-64.0, -64.0, 64.0, 64.0}, time_of(year, 270));
                           }};
    Bytes bytes;
    for (const WorldMap map : {WorldMap::wind, WorldMap::probability, WorldMap::species})
        for (const std::uint16_t number : map_of(map, inputs, frame_of(box, 49)))
            append(bytes, number);
    return {Slice(std::make_shared<const Bytes>(std::move(bytes)))};
}

/// Returns tiles of each layer and of several sizes.
Body tiles_body(const WorldParams& params) {
    const auto world = std::make_shared<const World>(
        world_of(params, lookup_in(atlas()), std::make_shared<const Ground>(ground_of(params))));
    const ImageUrls urls{{"c.jpg", "n.jpg", "o.jpg"}, {"c.webp", "n.webp", "o.webp"}};
    TileLinks links;
    links.tree = [](const TreeSpec& spec) { return spec.preset + ".bin"; };
    links.mushroom = [](const MushroomSpec& spec) { return spec.mix.front().id + ".bin"; };
    links.bark = [urls](const TreeSpec&) { return urls; };
    links.leaves = [urls](const std::string&, const LeafPaint&) { return urls; };
    links.skin = [urls](const MushroomSpec&) { return urls; };
    links.wood = [urls](const WoodPaint&) { return urls; };
    const Tiling tiling{params.extent};
    Body all;
    const auto add = [&](PlotLayer layer, const TileIndex& tile) {
        const Body one = grow_tile(world, {tiling, tile, layer, TileProfile::web, time_of(80, 270)},
                                   atlas(), links)
                             .glb;
        all.insert(all.end(), one.begin(), one.end());
    };
    for (const TileIndex tile : {TileIndex{0, 0, 0}, {2, 1, 2}, {5, 16, 16}})
        add(PlotLayer::ground, tile);
    for (const TileIndex tile : {TileIndex{2, 1, 2}, {5, 16, 16}}) add(PlotLayer::trees, tile);
    for (const TileIndex tile : {TileIndex{3, 4, 4}, {4, 8, 8}, {5, 16, 16}})
        add(PlotLayer::floor, tile);
    add(PlotLayer::fungi, {3, 4, 4});
    for (const PlotLayer layer : {PlotLayer::ground, PlotLayer::trees})
        all.push_back(Slice(std::make_shared<const Bytes>(
            subtree_of(tiling, {3, 2, 2}, layer, reach_of(*world->ground, params, world->stand)))));
    return all;
}

/// Adds what stands and grows in a block of each world, and two plots and their surroundings.
void add_blocks(Requests& requests) {
    for (const WorldPreset& preset : atlas().worlds()) {
        WorldParams params = params_of(preset);
        params.extent.value = 256;
        requests[line_of("block/" + preset.id.string(), params.seed, 80, 256)] = [params] {
            return block_body(params, 80);
        };
        if (preset.id.view() == "beech" || preset.id.view() == "meadow") {
            requests[line_of("placements/" + preset.id.string(), params.seed, 80, 256)] = [params] {
                return placements_body(params);
            };
            requests[line_of("plot/" + preset.id.string(), params.seed, 80, 256)] = [params] {
                return plot_body(params);
            };
            requests[line_of("more_maps/" + preset.id.string(), params.seed, 80, 256)] = [params] {
                return more_maps_body(params);
            };
            requests[line_of("tiles/" + preset.id.string(), params.seed, 80, 256)] = [params] {
                return tiles_body(params);
            };
        }
    }
}

/// Adds each species' colony in its own habit, at every level of detail, small; and two on roots, instanced.
void add_colonies(Requests& requests, const std::shared_ptr<const Atlas>& atlas) {
    const auto add = [&](const std::string& id, const std::string& called, ColonyParams params) {
        params.texture_size.value = small_side;
        requests[line_of("colony/" + called, params.count, params.lod, small_side)] = [id, params,
                                                                                       atlas] {
            return grow_colony({.mix = {{id, 1000}}, .params = params}, *atlas).glb;
        };
    };
    for (const AtlasEntry& entry : atlas->entries())
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

/// Adds some files of every product with quantised and with compressed geometry.
void add_compressed(Requests& requests, const std::shared_ptr<const Atlas>& species) {
    for (const Compression compress : {Compression::quantize, Compression::meshopt})
        for (int lod = 0; lod < 4; ++lod) {
            const std::string folder = std::string(name(compress)) + '/';
            for (const char* id : {"amanita_muscaria", "ramaria_formosa"}) {
                MushroomSpec spec = order_of({{id, 1000}}, 0.6, lod);
                spec.params.file.compress = compress;
                add_mushroom(requests, species, folder + id, spec);
                spec.params.animation = Animation::growth;
                spec.params.frames = 3;
                if (lod > 1) add_mushroom(requests, species, folder + "clip/" + id, spec);
            }
            ColonySpec colony;
            colony.mix = {{"hypholoma_fasciculare", 1000}};
            colony.params.count = 9;
            colony.params.lod = lod;
            colony.params.texture_size.value = small_side;
            colony.params.file.compress = compress;
            requests[line_of(folder + "colony", 9, lod, small_side)] = [colony, species] {
                return grow_colony(colony, *species).glb;
            };
            TreeSpec tree{"birch", params_of(*tree_preset("birch"))};
            tree.params.lod = lod;
            tree.params.texture_size.value = small_side;
            tree.params.file.compress = compress;
            requests[line_of(folder + "tree", 1, lod, small_side)] = [tree] {
                return grow_tree(tree, atlas()).glb;
            };
            tree.params.instancing = LeafInstancing::gpu;
            tree.params.file.lods = Lods::msft;
            requests[line_of(folder + "tree/instanced", 1, lod, small_side)] = [tree] {
                return grow_tree(tree, atlas()).glb;
            };
            LeafSpec leaf{"maple", params_of(*leaf_preset("maple"))};
            leaf.params.lod = lod;
            leaf.params.texture_size.value = small_side;
            leaf.params.file.compress = compress;
            requests[line_of(folder + "leaf", 1, lod, small_side)] = [leaf] {
                return grow_leaf(leaf, atlas()).glb;
            };
        }
}

/// Adds some files of every product with images as WebP, alone and beside JPEG.
void add_image_formats(Requests& requests, const std::shared_ptr<const Atlas>& species) {
    for (const ImageFormats format : {ImageFormats::webp, ImageFormats::webp_jpg})
        for (int lod = 1; lod < 4; ++lod) {
            const std::string folder = std::string(name(format)) + '/';
            const std::vector<std::pair<std::string, Mix>> mixes = {
                {"amanita_muscaria", {{"amanita_muscaria", 1000}}},
                {"mix", {{"amanita_muscaria", 700}, {"boletus_edulis", 300}}}};
            for (const auto& [id, mix] : mixes) {
                MushroomSpec spec = order_of(mix, 0.6, lod);
                spec.params.file.image_format = format;
                add_mushroom(requests, species, folder + id, spec);
            }
            TreeSpec tree{"birch", params_of(*tree_preset("birch"))};
            tree.params.lod = lod;
            tree.params.texture_size.value = small_side;
            tree.params.file.image_format = format;
            requests[line_of(folder + "tree", 1, lod, small_side)] = [tree] {
                return grow_tree(tree, atlas()).glb;
            };
        }
}

/// Adds a small colony and a small tree that are written with these options.
void add_written(Requests& requests, const std::shared_ptr<const Atlas>& species,
                 const std::string& folder, const FileOptions& file) {
    ColonySpec colony;
    colony.mix = {{"hypholoma_fasciculare", 1000}};
    colony.params.count = 9;
    colony.params.lod = 1;
    colony.params.texture_size.value = small_side;
    colony.params.file = file;
    requests[line_of(folder + "colony", 9, 1, small_side)] = [colony, species] {
        return grow_colony(colony, *species).glb;
    };
    TreeSpec tree{"birch", params_of(*tree_preset("birch"))};
    tree.params.lod = 1;
    tree.params.texture_size.value = small_side;
    tree.params.file = file;
    requests[line_of(folder + "tree", 1, 1, small_side)] = [tree] {
        return grow_tree(tree, atlas()).glb;
    };
}

/// Adds a small leaf that is written with these options.
void add_written_leaf(Requests& requests, const std::string& folder, const FileOptions& file) {
    LeafSpec leaf{"maple", params_of(*leaf_preset("maple"))};
    leaf.params.texture_size.value = small_side;
    leaf.params.file = file;
    requests[line_of(folder + "leaf", 1, 0, small_side)] = [leaf] {
        return grow_leaf(leaf, atlas()).glb;
    };
}

/// Adds products with solids for collision.
void add_collisions(Requests& requests, const std::shared_ptr<const Atlas>& species) {
    for (const CollisionFormat format : {CollisionFormat::nodes, CollisionFormat::omi}) {
        const std::string folder = std::string("collision/") + name(format) + '/';
        const FileOptions file{.collision = format};
        for (const char* id : {"amanita_muscaria", "cantharellus_cibarius", "ramaria_formosa"}) {
            MushroomSpec spec = order_of({{id, 1000}}, 0.6, 1);
            spec.params.file = file;
            add_mushroom(requests, species, folder + id, spec);
        }
        add_written(requests, species, folder, file);
    }
}

/// Adds products with weights of wind.
void add_winds(Requests& requests, const std::shared_ptr<const Atlas>& species) {
    for (const WindFormat format : {WindFormat::uv, WindFormat::attribute, WindFormat::color}) {
        const std::string folder = std::string("wind/") + name(format) + '/';
        const FileOptions file{.wind = format};
        for (const char* id : {"mycena_sanguinolenta", "fomes_fomentarius", "ramaria_formosa"}) {
            MushroomSpec spec = order_of({{id, 1000}}, 0.6, 1);
            spec.params.textures = Textures::embedded;
            spec.params.texture_size.value = small_side;
            spec.params.file = file;
            add_mushroom(requests, species, folder + id, spec);
        }
        add_written(requests, species, folder, file);
        add_written_leaf(requests, folder, file);
    }
}

/// Adds files with variants of their material.
void add_variants(Requests& requests, const std::shared_ptr<const Atlas>& species) {
    for (const char* id : {"amanita_muscaria", "morchella_esculenta", "ramaria_formosa"}) {
        MushroomSpec spec = order_of({{id, 1000}}, 0.6, 1);
        spec.params.textures = Textures::embedded;
        spec.params.texture_size.value = small_side;
        spec.params.variants = Variants::weather;
        add_mushroom(requests, species, std::string("variants/") + id, spec);
    }
}

/// Adds sets in one file.
void add_sets(Requests& requests, const std::shared_ptr<const Atlas>& species) {
    for (const Lods lods : {Lods::nodes, Lods::msft})
        for (const CollisionFormat collision : {CollisionFormat::nodes, CollisionFormat::omi}) {
            SetSpec spec;
            spec.species = {{{"amanita_muscaria", 1000}}, {{"mycena_sanguinolenta", 1000}}};
            spec.params.seeds = 2;
            spec.params.levels = {2, 3};
            spec.mushroom.texture_size.value = small_side;
            spec.mushroom.share = ImageShare::species;
            spec.mushroom.file = {.lods = lods, .collision = collision, .wind = WindFormat::uv};
            spec.packing = SetPacking::one_file;
            const std::string folder = std::string("set/") + name(lods) + '/' + name(collision);
            requests[line_of(folder, 4, 2, small_side)] = [spec, species] {
                return grow_set(spec, planned_set(spec, *species, {}), *species).glb;
            };
        }
    for (const AtlasShare atlas : {AtlasShare::species, AtlasShare::set}) {
        SetSpec spec;
        spec.species = {{{"amanita_muscaria", 1000}}, {{"hygrocybe_conica", 1000}}};
        spec.params.ages = {0.3, 0.6};
        spec.params.levels = {3};
        spec.params.atlas = atlas;
        spec.mushroom.texture_size.value = small_side;
        spec.packing = SetPacking::one_file;
        requests[line_of(std::string("set/atlas/") + name(atlas), 4, 3, small_side)] = [spec,
                                                                                        species] {
            return grow_set(spec, planned_set(spec, *species, {}), *species).glb;
        };
    }
}

/// Adds individuals that have the images of seed 1.
void add_shared(Requests& requests, const std::shared_ptr<const Atlas>& species) {
    for (const char* id : {"amanita_muscaria", "morchella_esculenta", "boletus_edulis"}) {
        MushroomSpec spec = order_of({{id, 1000}}, 0.6, 1);
        spec.params.seed = 8;
        spec.params.textures = Textures::embedded;
        spec.params.texture_size.value = small_side;
        spec.params.share = ImageShare::species;
        add_mushroom(requests, species, std::string("share/") + id, spec);
    }
}

/// Adds all levels of detail of every product in one file.
void add_chains(Requests& requests, const std::shared_ptr<const Atlas>& species) {
    for (const Lods lods : {Lods::nodes, Lods::msft}) {
        const std::string folder = std::string("levels/") + name(lods) + '/';
        FileOptions file{.lods = lods};
        if (lods == Lods::msft) file.compress = Compression::meshopt;
        for (const char* id : {"amanita_muscaria", "ramaria_formosa"}) {
            MushroomSpec spec = order_of({{id, 1000}}, 0.6, 0);
            spec.params.file = file;
            add_mushroom(requests, species, folder + id, spec);
        }
        add_written(requests, species, folder, file);
        add_written_leaf(requests, folder, file);
    }
}

/// Returns what makes a small picture of a product in place of its file.
Extras pictured(View view, Background background = Background::transparent) {
    Extras extras;
    extras.write = [=](const GlbScene& scene, const Parallel& parallel) -> Body {
        PictureParams params;
        params.width = params.height = 64;
        params.view = view;
        params.background = background;
        return {Slice(std::make_shared<const Bytes>(rendered_png(scene, params, parallel)))};
    };
    return extras;
}

/// Adds a picture of each species and of some products, and every view.
void add_pictures(Requests& requests, const std::shared_ptr<const Atlas>& atlas) {
    const auto add = [&](const std::string& id, int lod, View view, Background background) {
        const MushroomSpec spec = order_of({{id, 1000}}, 0.6, lod);
        requests[line_of(std::string("picture/") + name(view) + '/' + name(background) + '/' + id,
                         0.6, lod, small_side)] = [=] {
            return grow_mushroom(spec, *atlas, pictured(view, background)).glb;
        };
    };
    for (const AtlasEntry& entry : atlas->entries())
        add(entry.species.id.string(), 2, View::three_quarter, Background::transparent);
    for (const View view :
         {View::three_quarter, View::front, View::top, View::below, View::turntable})
        for (const Background background :
             {Background::transparent, Background::white, Background::grey, Background::black})
            add("amanita_muscaria", 1, view, background);
    const Extras extras = pictured(View::three_quarter);
    ColonySpec colony;
    colony.mix = {{"hypholoma_fasciculare", 1000}};
    colony.params.count = 9;
    colony.params.lod = 1;
    colony.params.texture_size.value = small_side;
    requests[line_of("picture/colony", 9, 1, small_side)] = [=] {
        return grow_colony(colony, *atlas, extras).glb;
    };
    TreeSpec tree{"birch", params_of(*tree_preset("birch"))};
    tree.params.lod = 1;
    tree.params.texture_size.value = small_side;
    requests[line_of("picture/tree", 1, 1, small_side)] = [=] {
        return grow_tree(tree, *atlas, extras).glb;
    };
    LeafSpec leaf{"maple", params_of(*leaf_preset("maple"))};
    leaf.params.texture_size.value = small_side;
    requests[line_of("picture/leaf", 1, 0, small_side)] = [=] {
        return grow_leaf(leaf, *atlas, extras).glb;
    };
}

/// Adds files and pictures with the light that passes through thin flesh and leaves.
void add_rich(Requests& requests, const std::shared_ptr<const Atlas>& atlas) {
    for (const char* id :
         {"mycena_galericulata", "auricularia_auricula_judae", "ramaria_formosa"}) {
        MushroomSpec spec = order_of({{id, 1000}}, 0.6, 2);
        spec.params.file.materials = MaterialSet::rich;
        add_mushroom(requests, atlas, std::string("rich/") + id, spec);
        requests[line_of(std::string("rich/picture/") + id, 0.6, 2, small_side)] = [=] {
            return grow_mushroom(spec, *atlas, pictured(View::below)).glb;
        };
    }
    FileOptions file;
    file.materials = MaterialSet::rich;
    add_written_leaf(requests, "rich/", file);
}

/// Adds impostors of each product, alone in either format, and at the end of other levels.
void add_impostors(Requests& requests, const std::shared_ptr<const Atlas>& atlas) {
    for (const ImageFormats format : {ImageFormats::jpg, ImageFormats::webp}) {
        const std::string called = std::string("impostor/") + name(format) + '/';
        const auto set = [&](auto params, int lod) {
            params.lod = lod;
            params.texture_size.value = small_side;
            params.file.image_format = format;
            params.file.impostor = lod != impostor_lod;
            params.file.lods = lod != impostor_lod ? Lods::msft : Lods::single;
            return params;
        };
        for (const int lod : {2, impostor_lod}) {
            for (const char* id :
                 {"amanita_muscaria", "cantharellus_cibarius", "ramaria_formosa"}) {
                MushroomSpec spec = order_of({{id, 1000}}, 0.6, lod);
                spec.params = set(spec.params, lod);
                add_mushroom(requests, atlas, called + id, spec);
            }
            ColonySpec colony;
            colony.mix = {{"hypholoma_fasciculare", 1000}};
            colony.params = set(colony.params, lod);
            requests[line_of(called + "colony", 1, lod, small_side)] = [=] {
                return grow_colony(colony, *atlas).glb;
            };
            TreeSpec tree{"birch", params_of(*tree_preset("birch"))};
            tree.params = set(tree.params, lod);
            requests[line_of(called + "tree", 1, lod, small_side)] = [=] {
                return grow_tree(tree, *atlas).glb;
            };
        }
    }
}

Requests golden_requests() {
    const std::shared_ptr<const Atlas> atlas = built_in_atlas();
    Requests requests;
    add_species(requests, atlas);
    add_mixes(requests, atlas);
    add_morphs(requests, atlas);
    add_clips(requests, atlas);
    add_triangles(requests, atlas);
    add_weathering(requests, atlas);
    add_image_formats(requests, atlas);
    add_leaves(requests);
    add_trees(requests);
    add_worlds(requests);
    add_blocks(requests);
    add_colonies(requests, atlas);
    add_compressed(requests, atlas);
    add_chains(requests, atlas);
    add_collisions(requests, atlas);
    add_winds(requests, atlas);
    add_shared(requests, atlas);
    add_sets(requests, atlas);
    add_variants(requests, atlas);
    add_pictures(requests, atlas);
    add_rich(requests, atlas);
    add_impostors(requests, atlas);
    return requests;
}

/// Grows every golden request, on all processors. A request that cannot be grown has its error in place of a hash.
Hashes hashes_of_this_build() {
    const Requests requests = golden_requests();
    std::vector<Requests::const_iterator> spec;
    for (auto at = requests.begin(); at != requests.end(); ++at) spec.push_back(at);
    Hashes hashes;
    std::mutex mutex;
    std::atomic<std::size_t> next = 0;
    const auto work = [&] {
        for (std::size_t i = next++; i < spec.size(); i = next++) {
            std::string hash;
            try {
                hash = hash_of(spec[i]->second());
            } catch (const std::exception& error) {
                hash = std::string("error:") + error.what();
                std::replace(hash.begin(), hash.end(), ' ', '_');
            }
            const std::lock_guard lock(mutex);
            hashes[spec[i]->first] = hash;
            if (hashes.size() % 100 == 0)
                std::fprintf(stderr, "[%zu/%zu]\n", hashes.size(), spec.size());
        }
    };
    {
        std::vector<std::jthread> threads;
        for (unsigned i = 0; i < std::max(1u, std::thread::hardware_concurrency()); ++i)
            threads.emplace_back(work);
    }
    return hashes;
}

/// Reads the golden hashes and the generator version that they belong to.
std::pair<Hashes, int> written(const char* path) {
    Hashes hashes;
    int version = 0;
    std::ifstream file(path);
    std::string species, age, lod, side, hash;
    while (file >> version >> species >> age >> lod >> side >> hash)
        hashes[species + ' ' + age + ' ' + lod + ' ' + side] = hash;
    return {hashes, version};
}

/// Compares this build with the golden hashes; returns the exit status.
int check(const char* path) {
    const auto [golden, version] = written(path);
    if (golden.empty()) {
        std::printf("%s holds no hashes: bless\n", path);
        return 1;
    }
    const Hashes today = hashes_of_this_build();
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

/// Writes the hashes of this build; returns the exit status.
int bless(const char* path) {
    const Hashes today = hashes_of_this_build();
    for (const auto& [request, hash] : today) {
        if (!hash.starts_with("error:")) continue;
        std::printf("%s: %s\n", request.c_str(), hash.c_str());
        return 1;
    }
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

// ---- random requests

/// Sets a third of the optional members, anywhere below, to a random allowed value.
template <class T>
void draw_overrides(T& value, const Info& info, Random& random) {
    if constexpr (std::is_same_v<T, std::optional<double>>) {
        const double chance = random.uniform();
        const double drawn = random.uniform(info.min, info.max);
        if (chance < 0.3) value = drawn;
    } else if constexpr (std::is_same_v<T, std::optional<int>>) {
        const double chance = random.uniform();
        const double drawn = random.uniform(info.min, info.max);
        if (chance < 0.3) value = static_cast<int>(drawn);
    } else if constexpr (Described<T>) {
        T::fields(
            [&](auto member, const Info& sub) { draw_overrides(value.*member, sub, random); });
    }
}

MushroomSpec random_order(std::uint32_t number, const Atlas& atlas) {
    Random random(number, 0x68617368);
    const auto& entries = atlas.entries();
    const auto any_species = [&] { return entries[random.bits() % entries.size()].species.id; };

    MushroomSpec spec;
    spec.mix.push_back({std::string(any_species().view()), 1000});
    spec.params.seed = random.bits();
    spec.params.age = random.uniform();
    spec.params.size = random.uniform(0.25, 4.0);
    spec.params.variation = random.uniform();
    spec.params.lod = static_cast<int>(random.bits() % 4);
    spec.params.texture_size.value = 128;
    const std::uint32_t textures = random.bits() % 8;
    if (textures == 0) spec.params.textures = Textures::none;
    if (random.bits() % 2 == 0) draw_overrides(spec.params, Info{.name = ""}, random);
    return spec;
}

/// Prints the line of one request, and that of a picture where `is_pictured`; returns whether a
/// mushroom was grown.
bool print_line(const MushroomSpec& spec, const Atlas& atlas, bool is_pictured) {
    const std::string request = spec.mix.front().id + '?' + query_text(spec.params);
    try {
        const Mushroom mushroom = grow_mushroom(spec, atlas);
        std::printf("%s %8zu  %s\n", hash_of(mushroom.glb).c_str(), size_of(mushroom.glb),
                    request.c_str());
        if (is_pictured) {
            const Body picture = grow_mushroom(spec, atlas, pictured(View::three_quarter)).glb;
            std::printf("%s %8zu  picture/%s\n", hash_of(picture).c_str(), size_of(picture),
                        request.c_str());
        }
        return true;
    } catch (const InvalidInput& refusal) {
        std::printf("refused  %s  %s\n", request.c_str(), refusal.what());
        return false;
    }
}

/// Prints the line of a leaf of random veins, or that it cannot be.
void print_leaf(std::uint32_t number) {
    Random random(number, 0x6c656166);
    const LeafPreset& preset = leaf_presets()[number % leaf_presets().size()];
    LeafSpec spec{preset.id.string(), params_of(preset)};
    LeafParams& params = spec.params;
    params.seed = random.bits();
    params.variation = random.uniform();
    params.autumn = random.uniform();
    params.lod = static_cast<int>(random.bits() % leaf_lods);
    params.texture_size.value = 128;
    params.shape.curl_deg = random.uniform(-180.0, 180.0);
    params.shape.venation.rise = random.uniform(0.0, 4.0);
    params.shape.venation.border = random.uniform(1.0, 2.0);
    params.shape.venation.side_deg = random.uniform(15.0, 88.0);
    const std::string request =
        "leaf/" + preset.id.string() + '?' + query_text(params, params_of(preset));
    try {
        const Grown leaf = grow_leaf(spec, atlas());
        std::printf("%s %8zu  %s\n", hash_of(leaf.glb).c_str(), size_of(leaf.glb), request.c_str());
    } catch (const InvalidInput& refusal) {
        std::printf("refused  %s  %s\n", request.c_str(), refusal.what());
    }
}

/// Prints the line of a tree of random angles, laws and leaves, or that it cannot be.
void print_tree(std::uint32_t number) {
    Random random(number, 0x74726565);
    const TreePreset& preset = tree_presets()[number % tree_presets().size()];
    TreeSpec spec{preset.id.string(), params_of(preset)};
    TreeParams& params = spec.params;
    TreeShape& shape = params.look.shape;
    params.seed = random.bits();
    params.autumn = random.uniform();
    params.lod = static_cast<int>(random.bits() % tree_lods);
    params.texture_size.value = 128;
    params.look.leaf.id = leaf_presets()[random.bits() % leaf_presets().size()].id;
    params.look.leaves.droop = random.uniform();
    params.look.bark.furrows = random.uniform();
    shape.width_rise = random.uniform(1.0, 3.0);
    shape.length_rise = random.uniform(0.6, 1.4);
    shape.fork_deg = random.uniform(0.0, 80.0);
    shape.side_deg = random.uniform(0.0, 100.0);
    shape.gravitropism = random.uniform(-0.2, 0.2);
    shape.phototropism = random.uniform(0.0, 0.2);
    shape.plagiotropy = random.uniform();
    shape.variation = random.uniform();
    if (random.bits() % 4 == 0) shape.topology.growth = TreeGrowth::sampled;
    const std::string request =
        "tree/" + preset.id.string() + '?' + query_text(params, params_of(preset));
    try {
        const Grown tree = grow_tree(spec, atlas());
        std::printf("%s %8zu  %s\n", hash_of(tree.glb).c_str(), size_of(tree.glb), request.c_str());
    } catch (const InvalidInput& refusal) {
        std::printf("refused  %s  %s\n", request.c_str(), refusal.what());
    }
}

/// Prints the line of a colony of one species, or that it cannot be.
void print_colony(std::uint32_t number, const Atlas& atlas) {
    Random random(number, 0x636f6c6f);
    const auto& entries = atlas.entries();
    ColonySpec spec;
    spec.mix = {{entries[random.bits() % entries.size()].species.id.string(), 1000}};
    ColonyParams& params = spec.params;
    params.seed = random.bits();
    params.count = static_cast<int>(random.uniform(1.0, 48.0));
    params.distinct = static_cast<int>(random.uniform(1.0, 6.0));
    params.age = random.uniform();
    params.size = random.uniform(0.25, 4.0);
    params.lod = static_cast<int>(random.bits() % 4);
    params.texture_size.value = 128;
    if (random.bits() % 2 == 0) params.habit = static_cast<Habit>(random.bits() % 5);
    if (random.bits() % 2 == 0) params.instancing = Instancing::gpu;
    const std::string request = "colony/" + spec.mix.front().id + '?' + query_text(params);
    try {
        const Grown colony = grow_colony(spec, atlas);
        std::printf("%s %8zu  %s\n", hash_of(colony.glb).c_str(), size_of(colony.glb),
                    request.c_str());
    } catch (const InvalidInput& refusal) {
        std::printf("refused  %s  %s\n", request.c_str(), refusal.what());
    }
}

/// Returns a noisy picture of a cap on a stem before a darker ground, by whole numbers alone.
Picture drawn_picture(Random& random) {
    constexpr int side = 480;
    const auto between = [&](int from, int to) {
        return from + static_cast<int>(random.bits() % static_cast<std::uint32_t>(to - from + 1));
    };
    const int stem = between(18, 60), top = between(180, 260), wide = between(100, 190),
              high = between(60, 130), lean = between(-40, 40);
    Picture photo{side, side, {}};
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x) {
            const int u = x - side / 2 - lean * (420 - y) / side, v = y - top;
            const bool is_cap =
                v <= 0 && u * u * high * high + v * v * wide * wide <= wide * wide * high * high;
            const bool is_stem = v > 0 && y < 420 && u > -stem && u < stem;
            const int light = is_cap ? 170 : is_stem ? 200 : 90;
            for (const int tint : {is_cap ? 40 : 0, is_stem ? 10 : 20, is_cap ? -90 : -20})
                photo.rgb.push_back(static_cast<std::uint8_t>(light + tint + between(-30, 30)));
        }
    return photo;
}

/// Prints the line of a picture that is cut out and traced, or that it cannot be.
void print_trace(std::uint32_t number) {
    Random random(number, 0x74726163);
    const Picture photo = drawn_picture(random);
    trace::Gesture gesture;
    gesture.axis = {{240.0, 410.0}, {240.0, 300.0}, {235.0, 190.0}};
    const std::string request = "trace/" + std::to_string(number);
    try {
        const trace::Mask mask = trace::cut_out(photo, gesture);
        Bytes bytes(mask.inside.begin(), mask.inside.end());
        trace::TraceParams params;
        params.form = trace::Form::capped;
        for (const char letter : dump(write(trace::traced(mask, gesture, params).shape)))
            bytes.push_back(static_cast<std::uint8_t>(letter));
        const Body body{Slice(std::make_shared<const Bytes>(std::move(bytes)))};
        std::printf("%s %8zu  %s\n", hash_of(body).c_str(), size_of(body), request.c_str());
    } catch (const InvalidInput& refusal) {
        std::printf("refused  %s  %s\n", request.c_str(), refusal.what());
    }
}

/// Prints the line of a world of random ground and weather.
void print_world(std::uint32_t number) {
    Random random(number, 0x776f726c);
    WorldParams params;
    params.seed = random.bits();
    params.extent.value = Choice<256, 1024, 4096>::values[random.bits() % 3];
    params.terrain.relief = random.uniform(0.0, 600.0);
    params.terrain.feature = random.uniform(50.0, 2000.0);
    params.terrain.roughness = random.uniform(0.3, 0.7);
    params.terrain.erosion = random.uniform();
    params.climate.latitude_deg = random.uniform(-66.0, 66.0);
    params.climate.rain = random.uniform(0.0, 3000.0);
    Body body = ground_body(params);
    for (Slice& slice : weather_body(params, static_cast<int>(random.bits() % 201)))
        body.push_back(std::move(slice));
    std::printf("%s %8zu  world/%u\n", hash_of(body).c_str(), size_of(body), number);
}

/// Prints the hashes of `count` random mushrooms and of leaves, trees, colonies, traces and worlds.
///
/// throws  GenerationError if hardly any of the random requests can be grown
void print(std::uint32_t count) {
    const auto atlas = built_in_atlas();
    for (std::uint32_t number = 0, grown = 0; grown < count; ++number) {
        if (number > 100 * count) throw GenerationError("hardly any random request can be grown");
        if (print_line(random_order(number, *atlas), *atlas, grown % 5 == 0)) ++grown;
    }
    for (std::uint32_t number = 0; number < count / 5; ++number) print_leaf(number);
    for (std::uint32_t number = 0; number < count / 10; ++number) print_tree(number);
    for (std::uint32_t number = 0; number < count / 5; ++number) print_colony(number, *atlas);
    for (std::uint32_t number = 0; number < count / 10; ++number) print_trace(number);
    for (std::uint32_t number = 0; number < count / 50; ++number) print_world(number);
}

int usage() {
    std::fputs("usage: hashes check FILE | bless FILE | print [COUNT] [SIMD] | --simd-names\n",
               stderr);
    return 2;
}

}  // namespace

int main(int argc, char** argv) try {
    const std::vector<std::string_view> arguments(argv + 1, argv + argc);
    const std::string_view what = arguments.empty() ? "" : arguments[0];
    if (what == "check" && argc == 3) return check(argv[2]);
    if (what == "bless" && argc == 3) return bless(argv[2]);
    if (what == "--simd-names" && argc == 2) {
        for (const std::string& name : simd_names()) std::puts(name.c_str());
        return 0;
    }
    if (what != "print" || argc > 4) return usage();
    std::uint32_t count = 200;
    if (argc > 2) {
        const std::string_view text = arguments[1];
        const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), count);
        if (error != std::errc() || end != text.data() + text.size()) return usage();
    }
    if (argc > 3) force_simd(arguments[2]);
    print(count);
    return 0;
} catch (const std::exception& error) {
    std::fprintf(stderr, "hashes: %s\n", error.what());
    return 1;
}
