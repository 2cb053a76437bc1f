#include "core/grow/wind.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <glm/geometric.hpp>
#include <string>
#include <vector>

#include "core/grow/colony.h"
#include "core/grow/colony_estimate.h"
#include "core/grow/colony_individuals.h"
#include "core/grow/leaf.h"
#include "core/grow/mushroom.h"
#include "core/grow/tree.h"
#include "tests/support/glb_reader.h"
#include "tests/support/orders.h"
#include "tests/support/refusals.h"

namespace sporeprint::grow_wind_test {
namespace {

bool is_share(float value) { return value >= 0.0F && value <= 1.0F; }

void expect_shares(const Mesh& mesh) {
    ASSERT_EQ(mesh.sway.size(), mesh.positions.size());
    for (const Sway& sway : mesh.sway)
        ASSERT_TRUE(is_share(sway.bend) && is_share(sway.flutter) && is_share(sway.phase) &&
                    is_share(sway.branch))
            << sway.bend << ' ' << sway.flutter << ' ' << sway.phase << ' ' << sway.branch;
}

SwayingStem stem_of(const std::string& id) {
    return swaying_stem(resolve(order_of(id, 0.6, 1), atlas()));
}

TEST(Deflection, IsThatOfACantilever) {
    EXPECT_EQ(deflection(-1.0), 0.0);
    EXPECT_EQ(deflection(0.0), 0.0);
    EXPECT_EQ(deflection(1.0), 1.0);
    EXPECT_DOUBLE_EQ(deflection(0.5), 0.3125);
    // A beam of length 1 leaves its clamp along its axis, and its end turns by 3/2 of the deflection.
    constexpr double step = 1e-6;
    EXPECT_NEAR(deflection(step) / step, 0.0, 1e-5);
    EXPECT_NEAR((deflection(1.0) - deflection(1.0 - step)) / step, 1.5, 1e-5);
    EXPECT_NEAR(deflection(3.0) - deflection(2.0), 1.5, 1e-12);
}

TEST(Wind, AMushroomBendsFromTheGroundToItsTop) {
    for (const std::string& id : species_ids()) {
        SCOPED_TRACE(id);
        const MushroomSpec spec = order_of(id, 0.6, 1);
        const Individual individual = resolve(spec, atlas());
        Mesh mesh = body_mesh(individual, 3);
        const SwayingStem stem = swaying_stem(individual);
        mesh.sway = sway_of(mesh, stem);
        expect_shares(mesh);
        float most = 0.0F;
        std::vector<std::pair<float, float>> by_height;
        for (std::size_t i = 0; i < mesh.sway.size(); ++i) {
            most = std::max(most, mesh.sway[i].bend);
            by_height.emplace_back(mesh.positions[i].y, mesh.sway[i].bend);
            if (mesh.positions[i].y <= 0.0F) {
                EXPECT_EQ(mesh.sway[i].bend, 0.0F);
            }
        }
        std::sort(by_height.begin(), by_height.end());
        for (std::size_t i = 1; i < by_height.size(); ++i)
            EXPECT_LE(by_height[i - 1].second, by_height[i].second);
        if (individual.grows_from_wall()) {
            EXPECT_EQ(most, 0.0F);
            EXPECT_EQ(displacement_of_top(stem), 0.0);
        } else {
            EXPECT_GT(most, 0.7F);
            EXPECT_GT(displacement_of_top(stem), 0.0);
            EXPECT_LE(displacement_of_top(stem), 0.3 * stem.top);
        }
    }
}

TEST(Wind, ThinStemsBendMoreThanStoutOnes) {
    const auto bend = [](const std::string& id) {
        const SwayingStem stem = stem_of(id);
        return displacement_of_top(stem) / stem.top;
    };
    EXPECT_GT(bend("mycena_sanguinolenta"), 3.0 * bend("amanita_muscaria"));
    EXPECT_GT(bend("amanita_muscaria"), 3.0 * bend("boletus_edulis"));
    EXPECT_LT(bend("boletus_edulis"), 0.02);
    EXPECT_EQ(displacement_of_top({}), 0.0);
}

TEST(Wind, LeavesMoveWithTheirTwigsAndFlutter) {
    TreeSpec spec{"birch", params_of(*tree_preset("birch"))};
    spec.params.file.wind = WindFormat::attribute;
    spec.params.size = 2.0;
    const TreeMeshes near = tree_meshes(spec, atlas());
    expect_shares(near.bark);
    expect_shares(near.leaves);
    spec.params.lod = 3;
    const TreeMeshes far = tree_meshes(spec, atlas());
    EXPECT_EQ(near.wind.sway, far.wind.sway);
    EXPECT_EQ(near.wind.flutter, far.wind.flutter);
    float most = 0.0F;
    for (const Sway& of : near.leaves.sway) most = std::max(most, of.flutter);
    EXPECT_EQ(most, 1.0F);
    for (const Sway& of : near.bark.sway) EXPECT_EQ(of.flutter, 0.0F);
    spec.params.file.wind = WindFormat::none;
    EXPECT_TRUE(tree_meshes(spec, atlas()).leaves.sway.empty());
}

TEST(Wind, NoCapLeavesTheStemOfItsColony) {
    for (const char* id : {"hypholoma_fasciculare", "mycena_sanguinolenta"}) {
        SCOPED_TRACE(id);
        ColonySpec spec;
        spec.mix = {{id, 1000}};
        spec.params.count = 12;
        spec.params.distinct = 4;
        spec.params.lod = 1;
        spec.params.file.wind = WindFormat::uv;
        const Colony colony = colony_parts(spec, typical_individual(spec, atlas()), atlas());
        expect_shares(colony.skin);
        EXPECT_GT(colony.wind.sway, 0.0);
        std::size_t moving = 0, of_stems = 0;
        for (std::size_t i = 0; i < colony.skin.sway.size(); ++i) {
            const glm::vec2& at = colony.skin.texture_coordinates[i];
            const bool is_soil = part_at(at.x, at.y) == Part::ground;
            of_stems += is_soil ? 0 : 1;
            moving += colony.skin.sway[i].bend > 0.0F ? 1 : 0;
            if (is_soil) {
                EXPECT_EQ(colony.skin.sway[i].bend, 0.0F);
            }
        }
        EXPECT_LT(of_stems, colony.skin.sway.size());
        EXPECT_GT(moving, of_stems / 4);
        for (std::size_t i = 0; i < colony.skin.positions.size(); ++i)
            if (colony.skin.positions[i].y < 0.0F) {
                EXPECT_EQ(colony.skin.sway[i].bend, 0.0F);
            }
        for (const ColonyMember& member : colony.members) {
            const Mesh& cap = colony.models[member.model];
            ASSERT_EQ(cap.sway.size(), cap.positions.size());
            std::size_t nearest = 0;
            const glm::vec3 top(member.pose.at);
            for (std::size_t i = 0; i < colony.skin.positions.size(); ++i)
                if (glm::distance(colony.skin.positions[i], top) <
                    glm::distance(colony.skin.positions[nearest], top))
                    nearest = i;
            const Sway stem = colony.skin.sway[nearest], own = cap.sway.front();
            EXPECT_EQ(stem.phase, own.phase);
            EXPECT_EQ(stem.branch, own.branch);
            EXPECT_NEAR(stem.bend / own.bend, 1.0, 0.1);
        }
    }
}

TEST(Wind, WholeIndividualsOfAColonyStandOnStillGround) {
    ColonySpec spec;
    spec.mix = {{"trametes_versicolor", 1000}};
    spec.params.count = 5;
    spec.params.distinct = 2;
    spec.params.lod = 2;
    spec.params.file.wind = WindFormat::attribute;
    const Colony brackets = colony_parts(spec, typical_individual(spec, atlas()), atlas());
    EXPECT_EQ(brackets.wind.sway, 0.0);
    for (const Mesh& model : brackets.models)
        for (const Sway& of : model.sway) EXPECT_EQ(of.bend, 0.0F);
    spec.mix = {{"ramaria_formosa", 1000}};
    const Colony corals = colony_parts(spec, typical_individual(spec, atlas()), atlas());
    EXPECT_GT(corals.wind.sway, 0.0);
    for (const Mesh& model : corals.models) {
        for (std::size_t i = 0; i < model.sway.size(); ++i)
            if (model.positions[i].y <= 0.0F) {
                EXPECT_EQ(model.sway[i].bend, 0.0F);
            }
    }
}

/// Returns the attributes of the first primitive of a mushroom's file.
std::vector<std::string> attributes_of(WindFormat format, Textures textures) {
    MushroomSpec spec = order_of("mycena_sanguinolenta", 0.6, 1);
    spec.params.lod = 3;
    spec.params.texture_size.value = 128;
    spec.params.textures = textures;
    spec.params.file.wind = format;
    const ReadBack read = expect_glb(joined(grow_mushroom(spec, atlas()).glb));
    EXPECT_EQ(read.trouble, "");
    return read.attributes;
}

TEST(Wind, AFileHasTheChannelsThatItNames) {
    using Names = std::vector<std::string>;
    EXPECT_EQ(attributes_of(WindFormat::none, Textures::none), (Names{"NORMAL", "POSITION"}));
    EXPECT_EQ(attributes_of(WindFormat::attribute, Textures::none),
              (Names{"NORMAL", "POSITION", "_WIND"}));
    EXPECT_EQ(attributes_of(WindFormat::color, Textures::none),
              (Names{"COLOR_0", "NORMAL", "POSITION"}));
    EXPECT_EQ(attributes_of(WindFormat::uv, Textures::embedded),
              (Names{"NORMAL", "POSITION", "TANGENT", "TEXCOORD_0", "TEXCOORD_1", "TEXCOORD_2"}));

    LeafSpec leaf{"oak", params_of(*leaf_preset("oak"))};
    leaf.params.textures = Textures::none;
    leaf.params.file.wind = WindFormat::attribute;
    const Value json = json_chunk(joined(grow_leaf(leaf, atlas()).glb));
    const Value& wind = *json.find("asset")->find("extras")->find("wind");
    EXPECT_EQ(wind.find("channels")->find("bend")->as_string(), "_WIND.x");
    EXPECT_EQ(wind.find("channels")->find("flutter")->as_string(), "_WIND.y");
    EXPECT_EQ(wind.find("channels")->find("phase")->as_string(), "_WIND.z");
    EXPECT_EQ(wind.find("channels")->find("branch")->as_string(), "_WIND.w");
    EXPECT_DOUBLE_EQ(wind.find("sway_m")->as_number(), leaf_sway * leaf.params.shape.length);
    EXPECT_DOUBLE_EQ(wind.find("flutter_m")->as_number(), leaf_flutter * leaf.params.shape.length);
}

TEST(Wind, TextureCoordinatesNeedThoseOfImages) {
    MushroomSpec spec = order_of("boletus_edulis", 0.6, 1);
    spec.params.textures = Textures::none;
    spec.params.file.wind = WindFormat::uv;
    EXPECT_TRUE(names(refusal([&] { (void)estimate(spec, atlas()); }), "/wind", "uv"));
    LeafSpec leaf{"oak", params_of(*leaf_preset("oak"))};
    leaf.params.textures = Textures::none;
    leaf.params.file.wind = WindFormat::uv;
    EXPECT_TRUE(names(refusal([&] { (void)estimate(leaf); }), "/wind", "uv"));
    EXPECT_TRUE(names(refusal([&] { (void)grow_mushroom(spec, atlas()); }), "/wind", "uv"));
    EXPECT_TRUE(names(refusal([&] { (void)grow_leaf(leaf, atlas()); }), "/wind", "uv"));
    ColonySpec colony;
    colony.mix = {{"boletus_edulis", 1000}};
    colony.params.textures = Textures::none;
    colony.params.file.wind = WindFormat::uv;
    EXPECT_TRUE(names(refusal([&] { (void)grow_colony(colony, atlas()); }), "/wind", "uv"));
    TreeSpec tree{"birch", params_of(*tree_preset("birch"))};
    tree.params.textures = Textures::none;
    tree.params.file.wind = WindFormat::uv;
    EXPECT_TRUE(names(refusal([&] { (void)grow_tree(tree, atlas()); }), "/wind", "uv"));
}

}  // namespace
}  // namespace sporeprint::grow_wind_test
