#include "core/grow/world/tile.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <glm/vec3.hpp>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "core/grow/mushroom.h"
#include "core/grow/tree.h"
#include "core/grow/world/placements.h"
#include "core/individual/resolve.h"
#include "tests/support/glb_reader.h"
#include "tests/support/orders.h"
#include "tests/support/worlds.h"

namespace sporeprint::grow_world_tile_test {
namespace {

const WorldTime autumn = time_of(80, 270);

/// A world of 256 m, its cached parts, and addresses that name what they are of.
struct Wood {
    CachedParts parts;
    std::shared_ptr<const World> world =
        std::make_shared<const World>(world_over_its_ground(small_world("mixed")));
    TileLinks links;

    Wood() {
        parts.services.caches.morphs = cached_morphs();
        links.tree = [](const TreeSpec& spec) {
            return "tree_" + spec.preset + '_' + std::to_string(spec.params.seed) + ".bin";
        };
        links.mushroom = [](const MushroomSpec& spec) {
            return spec.mix.front().id + '_' + std::to_string(spec.params.seed) + ".bin";
        };
        const auto urls = [](const std::string& of) {
            return ImageUrls{{of + "_c.jpg", of + "_n.jpg", of + "_o.jpg"},
                             {of + "_c.webp", of + "_n.webp", of + "_o.webp"}};
        };
        links.bark = [urls](const TreeSpec& spec) { return urls(spec.preset); };
        links.leaves = [urls](const std::string& leaf, const LeafPaint&) { return urls(leaf); };
        links.skin = [urls](const MushroomSpec& spec) { return urls(spec.mix.front().id); };
        links.wood = [urls](const WoodPaint&) { return urls("wood"); };
    }

    [[nodiscard]] Grown tile(const TileIndex& index, PlotLayer layer,
                             TileProfile profile = TileProfile::web) const {
        const TileRequest request{Tiling{256}, index, layer, profile, autumn};
        return grow_tile(world, request, atlas(), links, {}, parts.services);
    }
    [[nodiscard]] Value json(const TileIndex& index, PlotLayer layer,
                             TileProfile profile = TileProfile::web) const {
        return json_chunk(joined(tile(index, layer, profile).glb));
    }
};

const Wood& wood() {
    static const Wood own;
    return own;
}

/// Returns the ids that the nodes of a file name.
std::set<std::string> ids_in(const Value& json) {
    std::set<std::string> ids;
    for (const Value& node : json.find("nodes")->items()) {
        const Value* const extras = node.find("extras");
        if (extras == nullptr) continue;
        if (const Value* const id = extras->find("id")) ids.insert(id->as_string());
        if (const Value* const list = extras->find("ids"))
            for (const Value& id : list->items()) ids.insert(id.as_string());
    }
    return ids;
}

std::set<std::string> ids_placed(const WorldBox& box, PlacementKind kind) {
    PlacementChoice choice;
    choice.kinds.fill(false);
    choice.kinds[static_cast<std::size_t>(kind)] = true;
    std::set<std::string> ids;
    const Placements placed =
        placements_in(*wood().world, box, autumn, choice, atlas(), wood().parts.services);
    for (const Placement& row : placed.rows) ids.insert(id_text(row.id));
    return ids;
}

TEST(Tile, FourChildrenShowTheTreesOfTheirParent) {
    const std::set<std::string> parent = ids_in(wood().json({3, 4, 4}, PlotLayer::trees));
    std::set<std::string> children;
    for (int y = 8; y < 10; ++y)
        for (int x = 8; x < 10; ++x)
            for (const std::string& id : ids_in(wood().json({4, x, y}, PlotLayer::trees)))
                EXPECT_TRUE(children.insert(id).second) << "no tree is on two tiles";
    EXPECT_GT(parent.size(), 5U);
    EXPECT_EQ(children, parent);
    EXPECT_EQ(parent, ids_placed(Tiling{256}.box({3, 4, 4}), PlacementKind::tree));
}

TEST(Tile, ShowsTheFruitBodiesThatPlacementsList) {
    std::set<std::string> shown;
    const WorldBox box = Tiling{256}.box({3, 4, 4});
    for (int y = 16; y < 20; ++y)
        for (int x = 16; x < 20; ++x) shown.merge(ids_in(wood().json({5, x, y}, PlotLayer::fungi)));
    EXPECT_FALSE(shown.empty());
    EXPECT_EQ(shown, ids_placed(box, PlacementKind::fungus));
}

TEST(Tile, GroundAtABorderIsThatOfTheNeighbourBitForBit) {
    for (const auto& [left, right] :
         {std::pair{TileIndex{5, 16, 16}, TileIndex{5, 17, 16}}, {{2, 1, 1}, {2, 2, 1}}}) {
        const auto border = [&](const TileIndex& index, float side) {
            const Bytes file = joined(wood().tile(index, PlotLayer::ground, TileProfile::core).glb);
            const Value json = json_chunk(file);
            const Value::Array& origin =
                json.find("nodes")->items().front().find("translation")->items();
            std::vector<std::array<double, 3>> places;
            const ReadScene scene = expect_scene(file);
            for (const glm::vec3& at : scene.meshes[0][0].mesh.positions)
                if (at.x == side)
                    places.push_back({origin[0].as_number() + static_cast<double>(at.x),
                                      origin[1].as_number() + static_cast<double>(at.y),
                                      origin[2].as_number() + static_cast<double>(at.z)});
            return places;
        };
        const float half = static_cast<float>(0.5 * Tiling{256}.side(left.level));
        const auto west = border(left, half), east = border(right, -half);
        ASSERT_GE(west.size(), 33U);
        // The vertices of the top, which come first.
        for (std::size_t i = 0; i < 33; ++i)
            EXPECT_EQ(west[i], east[i]) << "vertex " << i << " of level " << left.level;
    }
}

/// Returns the positions of the first mesh of a file, with the scale and the translation of its node if it is quantised.
std::vector<glm::dvec3> places_in(const Bytes& file, const Value& json) {
    const auto number = [&](const std::string& pointer) {
        const Value* const found = json.at_pointer(pointer);
        EXPECT_NE(found, nullptr) << pointer;
        return found ? found->as_number() : 0.0;
    };
    std::uint32_t of_json = 0;
    std::memcpy(&of_json, file.data() + 12, sizeof of_json);
    const auto count = static_cast<std::size_t>(number("/accessors/0/count"));
    const std::uint8_t* from =
        file.data() + 28 + of_json + static_cast<std::size_t>(number("/bufferViews/0/byteOffset"));
    // Numbers of glTF are of single precision, in which the scale is the power of two that was written.
    const auto scale = static_cast<float>(number("/nodes/1/scale/1"));
    std::vector<glm::dvec3> places;
    for (std::size_t i = 0; i < count; ++i, from += 8) {
        std::array<std::int16_t, 3> at{};
        std::memcpy(at.data(), from, sizeof at);
        places.push_back(static_cast<double>(scale) * glm::dvec3(at[0], at[1], at[2]));
    }
    return places;
}

TEST(Tile, GroundOfBothProfilesHasTheSameHeightsBitForBit) {
    for (const TileIndex index :
         {TileIndex{0, 0, 0}, {1, 1, 0}, {2, 1, 1}, {4, 7, 9}, {5, 16, 16}}) {
        const Bytes web = joined(wood().tile(index, PlotLayer::ground).glb);
        const Value json = json_chunk(web);
        EXPECT_EQ(json.find("extensionsRequired")->items().front().as_string(),
                  "KHR_mesh_quantization");
        const std::vector<glm::dvec3> places = places_in(web, json);
        const Bytes core = joined(wood().tile(index, PlotLayer::ground, TileProfile::core).glb);
        const ReadScene scene = expect_scene(core);
        const std::vector<glm::vec3>& same = scene.meshes[0][0].mesh.positions;
        ASSERT_EQ(places.size(), same.size());
        // The vertices of the top; those of walls are behind each other's.
        for (std::size_t i = 0; i < 33 * 33; ++i)
            EXPECT_EQ(places[i], glm::dvec3(same[i])) << "vertex " << i << " of " << index.level;
    }
}

std::size_t kilobytes(const Grown& grown) {
    std::size_t bytes = 0;
    for (const Slice& slice : grown.glb) bytes += slice.size;
    return bytes / 1000;
}

TEST(Tile, OfTheProfileWebKeepsItsBudgetOfBytes) {
    EXPECT_LE(kilobytes(wood().tile({5, 16, 16}, PlotLayer::ground)), 220U);
    for (const int level : {0, 1, 2, 3, 4})
        EXPECT_LE(kilobytes(wood().tile({level, (1 << level) / 2, 0}, PlotLayer::ground)), 120U)
            << level;
    for (const TileIndex index : {TileIndex{5, 16, 16}, {4, 8, 8}, {3, 4, 4}, {1, 1, 1}})
        EXPECT_LE(kilobytes(wood().tile(index, PlotLayer::trees)), 70U) << index.level;
    // Where many species stand together it has more; in the mean of the middle of the wood it has not.
    for (const auto& [level, most] : {std::pair{5, 20U}, {4, 20U}, {3, 26U}}) {
        std::size_t sum = 0;
        const int middle = (1 << level) / 2;
        for (int y = middle - 2; y < middle + 2; ++y)
            for (int x = middle - 2; x < middle + 2; ++x)
                sum += kilobytes(wood().tile({level, x, y}, PlotLayer::fungi));
        EXPECT_LE(sum / 16, most) << level;
    }
}

TEST(Tile, OfTheProfileCoreContainsAllThatItShows) {
    for (const auto& [index, layer] : {std::pair{TileIndex{5, 16, 16}, PlotLayer::ground},
                                       {{5, 16, 17}, PlotLayer::trees},
                                       {{3, 4, 4}, PlotLayer::floor},
                                       {{5, 16, 16}, PlotLayer::floor},
                                       {{4, 8, 9}, PlotLayer::floor},
                                       {{3, 4, 4}, PlotLayer::fungi}}) {
        const ReadScene scene =
            expect_scene(joined(wood().tile(index, layer, TileProfile::core).glb));
        EXPECT_TRUE(scene.required.empty()) << name(layer);
        EXPECT_TRUE(scene.uris.empty()) << name(layer);
    }
}

TEST(Tile, OfTheProfileWebSharesGeometryWithTheFilesOfItsShapes) {
    const Value json = wood().json({5, 16, 17}, PlotLayer::trees);
    bool is_found = false;
    for (const Value& buffer : json.find("buffers")->items()) {
        const Value* const uri = buffer.find("uri");
        if (uri == nullptr) continue;
        is_found = true;
        const std::string address = uri->as_string();
        for (const StandKind& kind : wood().world->stand.kinds)
            for (std::uint32_t seed = 1; seed <= 4; ++seed) {
                if (address != "tree_" + kind.id + '_' + std::to_string(seed) + ".bin") continue;
                TreeSpec spec{kind.id, params_of(*atlas().find_tree(kind.id))};
                spec.params.seed = seed;
                spec.params.lod = 2;
                spec.params.foot_soil = false;
                spec.params.texture_size.value = 2048;
                std::size_t bytes = 0;
                const TreeMeshes meshes = tree_meshes(spec, atlas());
                for (const Mesh* mesh : {&meshes.bark, &meshes.leaves})
                    if (!mesh->positions.empty())
                        bytes +=
                            mesh->positions.size() * (mesh->tints.empty() ? 44 : 48) +
                            (mesh->indices.size() * (mesh->positions.size() > 65535 ? 4 : 2) + 3) /
                                4 * 4;
                EXPECT_EQ(buffer.find("byteLength")->as_number(), bytes) << address;
            }
    }
    EXPECT_TRUE(is_found);
}

TEST(Tile, ContentLiesInItsBox) {
    const Tiling tiling{256};
    const TileReach reach =
        reach_of(*wood().world->ground, wood().world->params, wood().world->stand);
    for (const auto& [index, layer] : {std::pair{TileIndex{0, 0, 0}, PlotLayer::ground},
                                       {{2, 1, 2}, PlotLayer::ground},
                                       {{1, 1, 0}, PlotLayer::trees},
                                       {{5, 12, 19}, PlotLayer::trees},
                                       {{3, 3, 5}, PlotLayer::floor},
                                       {{5, 16, 16}, PlotLayer::floor},
                                       {{3, 4, 4}, PlotLayer::fungi}}) {
        const Value json = wood().json(index, layer);
        const Value& bounds = *json.find("asset")->find("extras")->find("bounds_m");
        const Value::Array& origin =
            json.find("nodes")->items().front().find("translation")->items();
        const auto at = [&](const char* end, std::size_t axis) {
            return bounds.find(end)->items()[axis].as_number() + origin[axis].as_number();
        };
        const TileBox box = box_of(tiling, index, layer, reach);
        EXPECT_GE(at("min", 0), box.west) << name(layer);
        EXPECT_LE(at("max", 0), box.east) << name(layer);
        EXPECT_GE(at("min", 1), box.low) << name(layer);
        EXPECT_LE(at("max", 1), box.high) << name(layer);
        EXPECT_GE(-at("max", 2), box.south) << name(layer);
        EXPECT_LE(-at("min", 2), box.north) << name(layer);
    }
}

TEST(Tile, OfASizeWithoutContentShowsNothing) {
    const Grown grown = wood().tile({0, 0, 0}, PlotLayer::fungi);
    EXPECT_EQ(grown.triangles, 0U);
    EXPECT_EQ(json_chunk(joined(grown.glb)).find("meshes"), nullptr);
    EXPECT_THROW(static_cast<void>(wood().tile({6, 0, 0}, PlotLayer::ground)), InvalidInput);
}

TEST(Tile, IsTheSameInAnyOrderAndOnSeveralThreads) {
    const Wood other;
    for (const TileIndex index : {TileIndex{5, 17, 15}, TileIndex{5, 15, 15}})
        for (const PlotLayer layer : {PlotLayer::fungi, PlotLayer::floor, PlotLayer::trees})
            EXPECT_EQ(joined(other.tile(index, layer).glb), joined(wood().tile(index, layer).glb));
}

}  // namespace
}  // namespace sporeprint::grow_world_tile_test
