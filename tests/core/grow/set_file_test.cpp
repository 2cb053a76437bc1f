#include "core/grow/set_file.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <string>
#include <vector>

#include "core/grow/mushroom.h"
#include "tests/support/glb_reader.h"
#include "tests/support/orders.h"
#include "tests/support/refusals.h"

namespace sporeprint::grow_set_file_test {
namespace {

/// Returns a request for two species at one age, three seeds and two levels of detail in one file.
SetSpec small_set() {
    SetSpec spec;
    spec.species = {{{"amanita_muscaria", 1000}}, {{"mycena_sanguinolenta", 1000}}};
    spec.params.seeds = 3;
    spec.params.levels = {2, 3};
    spec.mushroom.texture_size.value = 128;
    spec.mushroom.share = ImageShare::species;
    spec.mushroom.file.lods = Lods::msft;
    spec.packing = SetPacking::one_file;
    return spec;
}

Bytes file_of(const SetSpec& spec) {
    return joined(grow_set(spec, planned_set(spec, atlas(), {}), atlas()).glb);
}

const Value& individuals_of(const Value& json) {
    return *json.find("asset")->find("extras")->find("individuals");
}

TEST(SetFile, ContainsEveryIndividualAtEveryLevel) {
    const SetSpec spec = small_set();
    const SetPlan plan = planned_set(spec, atlas(), {});
    const Bytes file = joined(grow_set(spec, plan, atlas()).glb);
    const Value json = json_chunk(file);
    const auto& nodes = json.find("nodes")->items();
    const auto& meshes = json.find("meshes")->items();
    EXPECT_EQ(nodes.size(), 2U * 3U * 2U);
    EXPECT_EQ(meshes.size(), nodes.size());
    EXPECT_EQ(json.find("materials")->items().size(), 2U) << "one for each species";
    EXPECT_EQ(json.find("images")->items().size(), 6U);
    std::set<std::string> names;
    for (const Value& node : nodes) names.insert(node.find("name")->as_string());
    EXPECT_EQ(names.size(), nodes.size());
    const auto& individuals = individuals_of(json).items();
    ASSERT_EQ(individuals.size(), plan.individuals.size());
    for (std::size_t i = 0; i < individuals.size(); ++i) {
        const SetIndividual& planned = plan.individuals[i];
        EXPECT_EQ(individuals[i].find("species")->as_string(),
                  spec.species[planned.species].front().id);
        EXPECT_EQ(individuals[i].find("seed")->as_number(), planned.params.seed);
        const auto& levels = individuals[i].find("levels")->items();
        ASSERT_EQ(levels.size(), 2U);
        for (std::size_t level = 0; level < 2; ++level) {
            const auto node = static_cast<std::size_t>(levels[level].find("node")->as_number());
            EXPECT_EQ(nodes[node].find("name")->as_string(),
                      individuals[i].find("name")->as_string() + "_LOD" +
                          std::to_string(spec.params.levels[level]));
        }
        EXPECT_GT(levels[0].find("triangles")->as_number(),
                  levels[1].find("triangles")->as_number());
        EXPECT_GE(levels[0].find("screen_coverage")->as_number(),
                  levels[1].find("screen_coverage")->as_number());
    }
    // Only the first levels are shown.
    EXPECT_EQ(json.find("scenes")->items()[0].find("nodes")->items().size(), 6U);
}

TEST(SetFile, ItsMeshesAreThoseOfTheirOwnFiles) {
    SetSpec spec = small_set();
    spec.params.levels = {2};
    spec.mushroom.textures = Textures::none;
    const SetPlan plan = planned_set(spec, atlas(), {});
    const ReadScene scene = expect_scene(joined(grow_set(spec, plan, atlas()).glb));
    ASSERT_EQ(scene.meshes.size(), plan.individuals.size());
    for (std::size_t i = 0; i < scene.meshes.size(); ++i) {
        const MushroomSpec one = file_spec(spec, plan.individuals[i], 0);
        const Mesh alone = mushroom_mesh(one, resolve(one, atlas()));
        EXPECT_EQ(scene.meshes[i].front().mesh.positions, alone.positions);
        EXPECT_EQ(scene.meshes[i].front().mesh.indices, alone.indices);
    }
}

TEST(SetFile, IndividualsStandApart) {
    const SetSpec spec = small_set();
    const Value json = json_chunk(file_of(spec));
    const auto& nodes = json.find("nodes")->items();
    struct Place {
        double x, z, half;
    };
    std::vector<Place> places;
    for (const Value& one : individuals_of(json).items()) {
        const auto node =
            static_cast<std::size_t>(one.find("levels")->items()[0].find("node")->as_number());
        const Value* at = nodes[node].find("translation");
        const auto coordinate = [&](std::size_t axis) {
            return at ? at->items()[axis].as_number() : 0.0;
        };
        const auto& low = one.at_pointer("/bounds_m/min")->items();
        const auto& high = one.at_pointer("/bounds_m/max")->items();
        const double half = 0.5 * std::max(high[0].as_number() - low[0].as_number(),
                                           high[2].as_number() - low[2].as_number());
        for (const Place& other : places)
            EXPECT_GT(
                std::max(std::abs(coordinate(0) - other.x), std::abs(coordinate(2) - other.z)),
                half + other.half);
        places.push_back({coordinate(0), coordinate(2), half});
    }
}

TEST(SetFile, IndividualsWithOwnImagesHaveOwnMaterials) {
    SetSpec spec = small_set();
    const std::size_t shared = file_of(spec).size();
    spec.mushroom.share = ImageShare::individual;
    const Bytes file = file_of(spec);
    EXPECT_EQ(json_chunk(file).find("materials")->items().size(), 6U);
    EXPECT_GT(file.size(), shared);
}

TEST(SetFile, EstimatesCountSharedImagesOnce) {
    for (const Compression compress : {Compression::none, Compression::meshopt})
        for (const ImageShare share : {ImageShare::species, ImageShare::individual}) {
            SetSpec spec = small_set();
            spec.mushroom.texture_size.value = 512;
            spec.mushroom.share = share;
            spec.mushroom.file.compress = compress;
            const auto size = static_cast<double>(file_of(spec).size());
            const auto estimated =
                static_cast<double>(planned_set(spec, atlas(), {}).total().bytes);
            EXPECT_NEAR(estimated / size, 1.0, 0.45) << name(compress) << ' ' << name(share);
        }
}

TEST(SetFile, WindIsRelativeToTheLargestDisplacement) {
    SetSpec spec = small_set();
    spec.mushroom.file.wind = WindFormat::attribute;
    const Value json = json_chunk(file_of(spec));
    const Value& wind = *json.find("asset")->find("extras")->find("wind");
    double most = 0.0;
    const SetPlan plan = planned_set(spec, atlas(), {});
    for (const SetIndividual& one : plan.individuals)
        most = std::max(
            most, displacement_of_top(swaying_stem(resolve(file_spec(spec, one, 0), atlas()))));
    EXPECT_DOUBLE_EQ(wind.find("sway_m")->as_number(), most);
}

TEST(SetFile, CollisionHasTheSolidsOfAllIndividuals) {
    for (const CollisionFormat format : {CollisionFormat::nodes, CollisionFormat::omi}) {
        SetSpec spec = small_set();
        spec.mushroom.file.collision = format;
        const Value json = json_chunk(file_of(spec));
        std::size_t solids = 0;
        for (const Value& node : json.find("nodes")->items()) {
            const std::string& own = node.find("name")->as_string();
            solids += own.starts_with("UCX_") || own.find("_collider") != std::string::npos ? 1 : 0;
        }
        EXPECT_GE(solids, 6U);
        const std::size_t roots = json.find("scenes")->items()[0].find("nodes")->items().size();
        EXPECT_EQ(roots, format == CollisionFormat::omi ? 1U : 6U + solids);
    }
}

TEST(SetFile, WhatOneFileCannotHaveIsRefused) {
    SetSpec spec = small_set();
    spec.mushroom.file.lods = Lods::single;
    EXPECT_TRUE(names(refusal([&] { refuse_in_one_file(spec); }), "/lods", "msft"));
    EXPECT_TRUE(names(refusal([&] { (void)file_of(spec); }), "/lods", "msft"));
    spec.params.levels = {3};
    refuse_in_one_file(spec);
    spec.mushroom.animation = Animation::growth;
    EXPECT_TRUE(names(refusal([&] { refuse_in_one_file(spec); }), "/animation", "growth"));
    spec.mushroom.animation = Animation::none;
    spec.mushroom.file.wind = WindFormat::uv;
    spec.mushroom.textures = Textures::none;
    EXPECT_TRUE(names(refusal([&] { refuse_in_one_file(spec); }), "/wind", "uv"));
}

}  // namespace
}  // namespace sporeprint::grow_set_file_test
