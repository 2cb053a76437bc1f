// Lone brackets in their files: the wood behind them, its levels, images, solids and estimates.
#include "core/grow/wood.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "core/grow/collision.h"
#include "core/grow/level_choice.h"
#include "core/mesh/measure.h"
#include "tests/support/glb_reader.h"
#include "tests/support/meshes.h"
#include "tests/support/orders.h"

namespace sporeprint::grow_wood_test {
namespace {

const std::vector<std::string> brackets = {"fomes_fomentarius", "pleurotus_ostreatus",
                                           "trametes_versicolor"};

Grown grown(const MushroomSpec& spec, const Extras& extras = Extras()) {
    return grow_mushroom(spec, atlas(), extras);
}

TEST(WoodBehind, IsWiderAndHigherThanTheBracketAndBehindIt) {
    for (const std::string& id : brackets)
        for (const double age : {0.0, 0.3, 0.6, 1.0})
            for (const std::uint32_t seed : {1U, 2U, 3U}) {
                SCOPED_TRACE(id + " at " + std::to_string(age));
                const MushroomSpec spec = on_wood(order_of(id, age, seed, 1));
                const Individual individual = resolved(spec);
                const auto piece = wood_behind(individual);
                ASSERT_TRUE(piece);
                const Bounds own = bounds(mesh_of(spec)),
                             wood = bounds(wood_mesh(*piece, 1, false)),
                             both = mushroom_bounds(spec, individual);
                EXPECT_LT(wood.min.y, own.min.y);
                EXPECT_GT(wood.max.y, own.max.y);
                EXPECT_LT(wood.min.x, own.min.x);
                EXPECT_GT(wood.max.x, own.max.x);
                EXPECT_LT(wood.min.z, own.min.z) << "nothing comes out of the split face";
                EXPECT_GT(own.max.z, wood.max.z) << "the bracket stands out";
                EXPECT_EQ(both.max, (glm::vec3(wood.max.x, wood.max.y, own.max.z)));
            }
}

TEST(WoodBehind, IsAbsentOnRequestAndBehindWhatStandsOnTheGround) {
    for (const std::string& id : brackets) {
        EXPECT_FALSE(wood_behind(resolved(order_of(id)))) << "substrate=none";
        EXPECT_EQ(wood_count(resolved(order_of(id)), 0).vertices, 0U);
    }
    EXPECT_FALSE(wood_behind(resolved(on_wood(order_of("amanita_muscaria")))));
    EXPECT_FALSE(
        wood_paint(order_of("ramaria_formosa"), resolved(on_wood(order_of("ramaria_formosa"))), 0));
}

TEST(WoodBehind, HasAMeshAndAMaterialOfItsOwn) {
    for (const std::string& id : brackets)
        for (const int lod : {0, 2, 3}) {
            const MushroomSpec spec = painted(on_wood(order_of(id, 0.6, 3, lod)), 256);
            const Grown file = grown(spec);
            const ReadScene scene = expect_scene(joined(file.glb));
            ASSERT_EQ(scene.nodes.size(), 2U);
            EXPECT_TRUE(scene.nodes[0].name.ends_with("_fruitbody")) << scene.nodes[0].name;
            EXPECT_TRUE(scene.nodes[1].name.ends_with("_wood")) << scene.nodes[1].name;
            ASSERT_EQ(scene.materials.size(), 2U);
            const int side = 256 >> lod;
            EXPECT_EQ(scene.images, (std::vector<std::array<int, 2>>{{side, side},
                                                                     {side, side},
                                                                     {side, side},
                                                                     {side / 2, side / 2},
                                                                     {side / 2, side / 2},
                                                                     {side / 2, side / 2}}));
            const Mesh &body = scene.meshes[0][0].mesh, &wood = scene.meshes[1][0].mesh;
            EXPECT_TRUE(same_bits(body.positions, mesh_of(spec).positions));
            const Estimate e = estimate(spec, atlas());
            EXPECT_EQ(e.vertices, body.positions.size() + wood.positions.size());
            EXPECT_EQ(file.vertices, e.vertices);
            EXPECT_EQ(file.triangles, body.triangles() + wood.triangles());
            EXPECT_GE(e.triangles, file.triangles);
            EXPECT_EQ(e.texels, 3U * static_cast<unsigned>(side * side + side * side / 4));
        }
}

TEST(WoodBehind, EveryLevelOfAFileHasItsOwn) {
    MushroomSpec spec = on_wood(textured(order_of("fomes_fomentarius")));
    spec.params.textures = Textures::none;
    for (const Lods lods : {Lods::nodes, Lods::msft}) {
        spec.params.file.lods = lods;
        const Individual individual = resolved(spec);
        const std::size_t levels = levels_in_file(spec, individual).size();
        const Value json = json_chunk(joined(grown(spec).glb));
        std::size_t wood = 0, groups = 0;
        for (const Value& node : json.find("nodes")->items()) {
            if (node.find("children")) ++groups;
            if (node.find("name")->as_string().ends_with("_wood")) ++wood;
        }
        EXPECT_EQ(wood, levels);
        EXPECT_EQ(groups, levels) << "a level is one node with what belongs to it";
        EXPECT_EQ(json.find("meshes")->items().size(), 2 * levels);
        const auto described = levels_of(spec, individual, mushroom_bounds(spec, individual));
        const Value& stated = *json.at_pointer("/asset/extras/levels");
        ASSERT_EQ(stated.items().size(), described.size());
        for (std::size_t i = 0; i < levels; ++i)
            EXPECT_EQ(stated.items()[i].find("vertices")->as_number(),
                      static_cast<double>(described[i].vertices));
    }
}

TEST(WoodBehind, StandsStillInAClipAndInWind) {
    MushroomSpec spec = growing(on_wood(order_of("pleurotus_ostreatus", 0.6, 1, 2)), 3);
    spec.params.file.wind = WindFormat::attribute;
    const Value json = json_chunk(joined(grown(spec).glb));
    const auto& meshes = json.find("meshes")->items();
    ASSERT_EQ(meshes.size(), 2U);
    EXPECT_EQ(meshes[0].at_pointer("/primitives/0/targets")->items().size(), 3U);
    EXPECT_FALSE(meshes[1].at_pointer("/primitives/0/targets"));
    EXPECT_EQ(json.at_pointer("/animations/0/channels/0/target/node")->as_number(), 0.0);
    EXPECT_EQ(json.at_pointer("/asset/extras/wind/sway_m")->as_number(), 0.0);
    // The bracket grows on this wood at every age: what is at the wall stays at the trunk.
    const Individual individual = resolved(spec);
    for (const double age : {0.0, 1.0}) {
        MushroomSpec frame = spec;
        frame.params.age = age;
        Individual at_frame = resolved(frame);
        at_frame.trunk_radius = individual.trunk_radius;
        EXPECT_EQ(mushroom_mesh(frame, at_frame).positions.size(), mesh_of(spec).positions.size());
    }
}

TEST(WoodBehind, ClipsOfAnyNumberOfTrianglesHaveOneTopology) {
    for (int triangles = 150; triangles < 700; triangles += 25) {
        MushroomSpec spec = growing(on_wood(order_of("fomes_fomentarius")), 2);
        spec.params.triangles = triangles;
        EXPECT_NO_THROW((void)grown(spec)) << triangles;
    }
}

TEST(WoodBehind, OfAClipIsWideEnoughForItsWidestFrame) {
    for (const std::string& id : brackets)
        for (const double age : {0.1, 0.6}) {
            const MushroomSpec spec = growing(on_wood(order_of(id, age, 1, 1)), 2);
            const Individual individual = resolved(spec);
            const Bounds wood = bounds(wood_mesh(*wood_behind(individual), 1, false));
            for (const double frame_age : {0.0, 0.6, 1.0}) {
                MushroomSpec frame = on_wood(order_of(id, frame_age, 1, 1));
                Individual at_frame = resolved(frame);
                at_frame.trunk_radius = individual.trunk_radius;
                const Bounds own = bounds(mushroom_mesh(frame, at_frame));
                EXPECT_LT(wood.min.x, own.min.x) << id << " from " << age << " at " << frame_age;
                EXPECT_GT(wood.max.x, own.max.x) << id << " from " << age << " at " << frame_age;
                EXPECT_LT(wood.min.y, own.min.y) << id << " from " << age << " at " << frame_age;
                EXPECT_GT(wood.max.y, own.max.y) << id << " from " << age << " at " << frame_age;
                EXPECT_LT(wood.min.z, own.min.z) << id << " from " << age << " at " << frame_age;
            }
        }
}

TEST(WoodBehind, IsSolid) {
    const auto parts = [](const MushroomSpec& spec) {
        std::size_t wood = 0;
        const auto shapes = collision_shapes(resolved(spec));
        for (const CollisionShape& shape : shapes) wood += shape.part == "wood" ? 1 : 0;
        return std::pair(shapes.size(), wood);
    };
    for (const std::string& id : brackets) {
        const auto [all, wood] = parts(on_wood(order_of(id)));
        const auto [bare, none] = parts(order_of(id));
        EXPECT_GE(wood, 1U) << id;
        EXPECT_EQ(none, 0U) << id;
        // Round its trunk a bracket may need more parts than on a flat wall.
        EXPECT_GE(all, bare + wood) << id;
    }
}

TEST(WoodBehind, ImagesAreSharedByAllBracketsOnTheSameWood) {
    ExecutionContext execution;
    std::vector<std::string> keys;
    execution.caches.images = [&](const std::string& key, const auto& make) {
        keys.push_back(key);
        return make();
    };
    for (const std::string& id : {brackets[1], brackets[2]}) {
        const MushroomSpec spec = painted(on_wood(order_of(id, 0.6, 7, 3)));
        (void)grow_mushroom(spec, atlas(), {}, execution);
    }
    ASSERT_EQ(keys.size(), 4U);
    EXPECT_EQ(keys[1], keys[3]) << "both are of beech";
    EXPECT_NE(keys[0], keys[2]);
}

TEST(WoodBehind, ACustomBracketStandsOnBeech) {
    MushroomSpec spec = on_wood(order_of(""));
    spec.mix.clear();
    spec.model = atlas().find("fomes_fomentarius")->species.stages[3].model;
    EXPECT_EQ(resolved(spec).effective.substrate, Substrate::beech);
    spec.params.substrate = Substrate::oak;
    EXPECT_EQ(resolved(spec).effective.substrate, Substrate::oak);
}

}  // namespace
}  // namespace sporeprint::grow_wood_test
