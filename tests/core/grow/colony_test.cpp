#include "core/grow/colony.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "core/grow/colony_estimate.h"
#include "core/grow/colony_individuals.h"
#include "core/grow/variants.h"
#include "core/params/corners.h"
#include "core/params/query.h"
#include "tests/support/effort.h"
#include "tests/support/glb_reader.h"
#include "tests/support/intrusion.h"
#include "tests/support/meshes.h"
#include "tests/support/orders.h"
#include "tests/support/refusals.h"

namespace sporeprint::grow_colony_test {
namespace {

ExecutionContext with_cached_morphs() {
    ExecutionContext execution;
    execution.caches.morphs = cached_morphs();
    return execution;
}

ColonySpec colony_of(const std::string& id, int count = 12, int distinct = 4) {
    ColonySpec spec;
    spec.mix = {{id, 1000}};
    spec.params.count = count;
    spec.params.distinct = distinct;
    spec.params.textures = Textures::none;
    return spec;
}

Individual typical(const ColonySpec& spec) {
    return typical_individual(spec, atlas(), with_cached_morphs().caches);
}

Colony parts_of(const ColonySpec& spec) {
    return colony_parts(spec, typical(spec), atlas(), with_cached_morphs());
}
Grown grown(const ColonySpec& spec) { return grow_colony(spec, atlas(), {}, with_cached_morphs()); }

std::size_t vertices_of_ground(const Mesh& mesh) {
    return static_cast<std::size_t>(
        std::count_if(mesh.texture_coordinates.begin(), mesh.texture_coordinates.end(),
                      [](const glm::vec2& at) { return part_at(at.x, at.y) == Part::ground; }));
}

// The ground is in the mesh of the stems, or in a mesh of its own; individuals have none, because it
// would lean with them.
TEST(Colony, StandsInSoilUnlessItIsClean) {
    for (const char* id : {"russula_emetica", "hypholoma_fasciculare", "lycoperdon_perlatum"}) {
        ColonySpec spec = colony_of(id, 5, 2);
        spec.params.textures = Textures::embedded;
        const Colony natural = parts_of(spec);
        EXPECT_GT(vertices_of_ground(natural.skin), 100U) << id;
        for (const Mesh& model : natural.models) EXPECT_EQ(vertices_of_ground(model), 0U) << id;
        spec.params.base = Base::clean;
        const Colony clean = parts_of(spec);
        EXPECT_EQ(vertices_of_ground(clean.skin), 0U) << id;
        ASSERT_EQ(clean.members.size(), natural.members.size()) << id;
        for (std::size_t i = 0; i < clean.members.size(); ++i) {
            EXPECT_EQ(clean.members[i].pose.at, natural.members[i].pose.at) << id;
        }
    }
}

class EveryColony : public ::testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Species, EveryColony, ::testing::ValuesIn(species_ids()),
                         [](const auto& one) { return one.param; });

TEST_P(EveryColony, ReadsBackFromItsFileAtEveryLevel) {
    std::size_t before = ~std::size_t{0};
    for (int lod = 0; lod < 4; ++lod) {
        ColonySpec spec = colony_of(GetParam(), 9, 3);
        spec.params.lod = lod;
        const Grown colony = grown(spec);
        const ReadScene found = expect_scene(joined(colony.glb));
        EXPECT_TRUE(found.required.empty());
        const bool has_wood = colony_traits(spec, atlas()).substrate != Substrate::none;
        EXPECT_LE(found.meshes.size(), has_wood ? 5U : 4U) << "three caps, a skin and wood";
        EXPECT_EQ(found.materials.size(), has_wood ? 2U : 1U);
        std::size_t vertices = 0, triangles = 0;
        for (const auto& mesh : found.meshes) {
            ASSERT_EQ(mesh.size(), 1U);
            vertices += mesh[0].mesh.positions.size();
            triangles += mesh[0].mesh.triangles();
        }
        EXPECT_EQ(vertices, colony.vertices);
        EXPECT_EQ(triangles, colony.triangles);
        EXPECT_LE(triangles, before);
        before = triangles;
        std::vector<bool> shown(found.meshes.size(), false);
        for (const ReadNode& node : found.nodes) shown[static_cast<std::size_t>(node.mesh)] = true;
        EXPECT_EQ(std::count(shown.begin(), shown.end(), false), 0) << "nothing is stored unseen";
    }
}

// For few and many members, in every habit: each level has fewer triangles than the one before and
// covers the same area.
TEST_P(EveryColony, HasFewerTrianglesAtEveryLevel) {
    const std::size_t habits = effort(6, 1);
    for (int habit = -1; habit < static_cast<int>(habits) - 1; ++habit)
        for (const int count : {1, 2, 16, 17, 40, 256}) {
            if (count != 17 && habit >= 0) continue;
            ColonySpec spec = colony_of(GetParam(), count, 3);
            if (habit >= 0) spec.params.habit = static_cast<Habit>(habit);
            std::uint64_t drawn = 0, stored = 0;
            glm::vec3 size(0.0F);
            for (int lod = 0; lod < 4; ++lod) {
                spec.params.lod = lod;
                Colony colony;
                try {
                    colony = parts_of(spec);
                } catch (const InvalidInput&) {
                    break;  // what this species cannot have, or a seed that bears nothing
                }
                const std::uint64_t triangles = instanced_triangles(colony),
                                    own = measured(spec, colony).triangles;
                Bounds box = bounds(colony);
                // Soil below the ground is not seen, and crowds of mushrooms leave it out.
                if (colony_traits(spec, atlas()).habit != Habit::tier) box.min.y = 0.0F;
                if (lod > 0) {
                    // A cup whose outline would intersect itself with fewer rings keeps those of
                    // the level before. With many stems most triangles are those of the skin,
                    // and a stem has at least one segment.
                    const bool is_cup =
                        atlas().find(GetParam())->species.facts.form == GrowthForm::cup;
                    const double bar = lod < 3 ? 1.0 : is_cup ? 1.001 : 0.93;
                    EXPECT_LT(static_cast<double>(triangles), bar * static_cast<double>(drawn))
                        << habit << ' ' << count << ' ' << lod;
                    EXPECT_LT(own, stored + (lod == 3 && is_cup ? 1 : 0))
                        << habit << ' ' << count << ' ' << lod;
                }
                for (int axis = 0; lod == 3 && count >= 16 && axis < 3; ++axis)
                    EXPECT_NEAR(static_cast<double>((box.max - box.min)[axis] / size[axis]), 1.0,
                                0.08)
                        << habit << ' ' << count << ' ' << axis;
                drawn = triangles;
                stored = own;
                size = box.max - box.min;
            }
        }
}

TEST_P(EveryColony, IsEstimatedBeforeAnyWork) {
    for (const bool rooted : {false, true})
        for (const int lod : {0, 2}) {
            ColonySpec spec = colony_of(GetParam(), 20, 5);
            spec.params.lod = lod;
            if (rooted && colony_traits(spec, atlas()).lateral) continue;
            if (rooted) spec.params.habit = Habit::rooted;
            const Estimate e = estimate(spec, typical(spec), atlas());
            const Grown colony = grown(spec);
            const auto bytes = static_cast<double>(size_of(colony.glb));
            // The number of nodes of roots is random, and the mean of it is estimated.
            const double least = rooted ? 0.5 : 0.8;
            EXPECT_GT(static_cast<double>(e.vertices),
                      least * static_cast<double>(colony.vertices));
            EXPECT_GT(static_cast<double>(e.triangles),
                      least * static_cast<double>(colony.triangles));
            EXPECT_GT(static_cast<double>(e.bytes), least * bytes) << rooted << lod;
            EXPECT_LT(static_cast<double>(e.bytes), 6.0 * bytes) << rooted << lod;
        }
}

TEST_P(EveryColony, IsTheSameAtEveryLevelOfDetail) {
    ColonySpec spec = colony_of(GetParam());
    const Colony near = parts_of(spec);
    ASSERT_FALSE(near.members.empty());
    for (int lod = 1; lod < 4; ++lod) {
        spec.params.lod = lod;
        const Colony far = parts_of(spec);
        ASSERT_EQ(far.members.size(), near.members.size());
        for (std::size_t i = 0; i < near.members.size(); ++i) {
            EXPECT_EQ(far.members[i].model, near.members[i].model);
            EXPECT_EQ(far.members[i].pose.at, near.members[i].pose.at);
            EXPECT_EQ(far.members[i].pose.turn, near.members[i].pose.turn);
        }
        EXPECT_LT(distance(bounds(far), bounds(near)), 0.06 * diagonal(bounds(near))) << lod;
    }
}

/// Returns the largest overlap of any two members of a colony, in diameters of the smaller one;
/// stems included.
double deepest(const Colony& colony) {
    std::vector<std::optional<Solid>> solids;
    std::vector<std::vector<glm::dvec3>> samples;
    std::vector<double> reach, across;
    for (const Mesh& model : colony.models) {
        solids.emplace_back();
        if (!model.positions.empty()) solids.back().emplace(model);
        samples.push_back(samples_of(model));
        double far = 0.0, wide = 0.0;
        for (const glm::vec3& p : model.positions) {
            far = std::max(far, glm::length(glm::dvec3(p)));
            wide = std::max(wide, std::sqrt(static_cast<double>(p.x * p.x + p.z * p.z)));
        }
        reach.push_back(far);
        across.push_back(2.0 * wide);
    }
    double worst = 0.0;
    for (const ColonyMember& one : colony.members)
        for (const ColonyMember& other : colony.members) {
            if (&one == &other) continue;
            const double far = glm::length(one.pose.at - other.pose.at);
            if (far > one.pose.scale * reach[one.model] + other.pose.scale * reach[other.model])
                continue;
            const double diameter = std::min(one.pose.scale * across[one.model],
                                             other.pose.scale * across[other.model]);
            for (const glm::dvec3& point : samples[one.model]) {
                const glm::dvec3 at = other.pose.own(one.pose.world(point));
                worst =
                    std::max(worst, solids[other.model]->depth(at) * other.pose.scale / diameter);
            }
        }
    return worst;
}

// Tests the measure used below: overlapping caps are detected, with the right depth.
TEST(ColonyCaps, OverlapIsMeasured) {
    Colony colony = parts_of(colony_of("lycoperdon_perlatum", 2, 1));
    ASSERT_EQ(colony.members.size(), 2U);
    EXPECT_EQ(deepest(colony), 0.0);
    const double across = 2.0 * bounds(colony.models[0]).max.x * colony.members[0].pose.scale;
    colony.members[1].pose = colony.members[0].pose;
    colony.members[1].pose.at.x += 0.9 * across;
    EXPECT_GT(deepest(colony), 0.02);
    EXPECT_LT(deepest(colony), 0.12);
    colony.members[1].pose.at.x -= 0.5 * across;
    EXPECT_GT(deepest(colony), 0.2);
}

TEST(ColonyCaps, OverlapByAtMostAFiftieth) {
    const std::array<const char*, 5> species = {"hypholoma_fasciculare", "armillaria_mellea",
                                                "mycena_haematopus", "macrolepiota_procera",
                                                "cantharellus_cibarius"};
    std::size_t made = 0, steps = 0;
    const auto seeds = static_cast<std::uint32_t>(effort(100));
    for (std::uint32_t seed = 1; seed <= seeds; ++seed) {
        ColonySpec spec = colony_of(species[seed % species.size()], 24, 6);
        spec.params.seed = seed;
        if (seed % 2 == 0) {
            spec.params.habit = Habit::rooted;
            spec.params.growth.stem_probability = 0.5;
        } else {
            spec.params.habit = Habit::tuft;
        }
        const Colony colony = parts_of(spec);
        EXPECT_LT(deepest(colony), 0.02) << spec.mix[0].id << " seed " << seed;
        made += colony.members.size();
        for (const ColonyMember& member : colony.members) steps += member.steps > 0 ? 1 : 0;
    }
    EXPECT_GT(made, 14U * seeds) << "most find room";
    EXPECT_GT(steps, seeds) << "and many had to give way, or nothing was tried";
}

TEST(ColonyCaps, WholeIndividualsDoNotOverlapEither) {
    for (const char* id : {"lycoperdon_perlatum", "trametes_versicolor", "pleurotus_ostreatus",
                           "geastrum_triplex", "tremella_mesenterica"})
        for (const std::uint32_t seed : {1U, 2U, 3U}) {
            ColonySpec spec = colony_of(id, 20, 5);
            spec.params.seed = seed;
            const Colony colony = parts_of(spec);
            EXPECT_LT(deepest(colony), 0.02) << id << seed;
            EXPECT_GT(colony.members.size(), 8U) << id;
        }
}

// The law of the source holds for every stem that was not moved by placement.
TEST(ColonyCaps, FollowTheLawOfTheSourceOnTheirStems) {
    ColonySpec spec = colony_of("hypholoma_fasciculare", 64, 1);
    spec.params.habit = Habit::rooted;
    spec.params.cap_scale = 0.8;
    const Colony colony = parts_of(spec);
    const ColonyRootsOf<Maybe>& growth = colony.effective.growth;
    std::size_t unmoved = 0;
    for (const ColonyMember& member : colony.members) {
        if (member.steps > 0) continue;
        ++unmoved;
        EXPECT_NEAR(glm::length(member.swing) * (glm::length(member.swing) > 0 ? 1.0 : 0.0),
                    glm::length(member.swing) > 0 ? *growth.stem_displacement : 0.0, 1e-12);
        EXPECT_LE(member.rise.y, *growth.stem_height + 1e-12);
        const glm::dvec3 axis = member.pose.turn[1];
        EXPECT_LT(glm::length(axis - glm::normalize(member.rise + 2.0 * member.swing)), 1e-12)
            << "its frame is that of its stem";
        // As wide as the stem at the junction, times cap_scale: height falls as exp(-decay), radius
        // as exp(-decay / 2).
        const double depth = std::log(*growth.stem_height / member.rise.y) / *growth.stem_decay;
        const double radius =
            *growth.root_radius * std::exp(-0.5 * *growth.decay * *growth.area_decay * depth);
        EXPECT_NEAR(member.pose.scale * colony.junction, 0.8 * radius, 0.35 * radius);
    }
    EXPECT_GT(unmoved, 5U);
}

TEST(ColonyCaps, GrowWithCapScaleAndColoniesWithSize) {
    ColonySpec spec = colony_of("mycena_galericulata", 1, 1);
    spec.params.habit = Habit::troop;
    const Colony one = parts_of(spec);
    spec.params.cap_scale = 2.0;
    const Colony wide = parts_of(spec);
    EXPECT_NEAR(wide.members[0].pose.scale, 2.0 * one.members[0].pose.scale, 1e-12);
    spec.params.size = 3.0;
    const Colony large = parts_of(spec);
    EXPECT_LT(distance(bounds(large), {3.0F * bounds(wide).min, 3.0F * bounds(wide).max}), 1e-5);
}

TEST(ColonyFile, BytesGrowWithDistinctNotWithCount) {
    const auto bytes = [](int count, int distinct, Instancing instancing) {
        ColonySpec spec = colony_of("lycoperdon_perlatum", count, distinct);
        spec.params.instancing = instancing;
        spec.params.habit = Habit::troop;
        spec.params.base = Base::clean;  // soil is another mesh, with a budget of its own
        return static_cast<double>(size_of(grown(spec).glb));
    };
    // All four are among 32.
    const double few = bytes(32, 4, Instancing::nodes);
    EXPECT_LT(bytes(128, 4, Instancing::nodes) - few, 96 * 260.0);
    EXPECT_LT(bytes(128, 4, Instancing::gpu) - bytes(32, 4, Instancing::gpu), 96 * 41.0 + 64.0);
    EXPECT_GT(bytes(128, 8, Instancing::nodes), 1.8 * few);
}

TEST(ColonyFile, InstancesHaveTheTransformsOfNodes) {
    for (const char* id : {"armillaria_mellea", "trametes_versicolor"}) {
        ColonySpec spec = colony_of(id);
        const ReadScene nodes = expect_scene(joined(grown(spec).glb));
        spec.params.instancing = Instancing::gpu;
        const ReadScene gpu = expect_scene(joined(grown(spec).glb));
        EXPECT_EQ(gpu.required, std::vector<std::string>{"EXT_mesh_gpu_instancing"});
        EXPECT_EQ(gpu.meshes.size(), nodes.meshes.size());
        std::map<int, std::vector<ReadInstance>> by_mesh;
        for (const ReadNode& node : gpu.nodes)
            for (const ReadInstance& instance : node.instances)
                by_mesh[node.mesh].push_back(instance);
        std::map<int, std::size_t> seen;
        const auto value = [](const std::vector<double>& of, std::size_t i, double rest) {
            return static_cast<float>(of.empty() ? rest : of[i]);
        };
        for (const ReadNode& node : nodes.nodes) {
            if (node.name.ends_with("_stems") || node.name.ends_with("_wood") ||
                node.name.ends_with("_ground"))
                continue;
            ASSERT_LT(seen[node.mesh], by_mesh[node.mesh].size());
            const ReadInstance& instance = by_mesh[node.mesh][seen[node.mesh]++];
            for (int k = 0; k < 3; ++k) {
                const auto i = static_cast<std::size_t>(k);
                EXPECT_EQ(instance.translation[k], value(node.translation, i, 0.0));
                EXPECT_EQ(instance.rotation[k], value(node.rotation, i, 0.0));
                EXPECT_EQ(instance.scale[k], value(node.scale, i, 1.0));
            }
        }
    }
}

TEST(ColonyFile, MembersHaveThePosesOfItsNodes) {
    const ColonySpec spec = colony_of("armillaria_mellea", 6, 2);
    const Colony colony = parts_of(spec);
    const ReadScene found = expect_scene(joined(grown(spec).glb));
    ASSERT_EQ(found.nodes.size(), colony.members.size() + 1);
    for (std::size_t i = 0; i < colony.members.size(); ++i) {
        const ReadNode& node = found.nodes[i + 1];
        const Pose& pose = colony.members[i].pose;
        const glm::dvec3 point(0.01, 0.02, -0.03);
        // v + 2 q x (q x v + w v)
        const glm::dvec3 q(node.rotation[0], node.rotation[1], node.rotation[2]);
        const glm::dvec3 turned =
            point + 2.0 * glm::cross(q, glm::cross(q, point) + node.rotation[3] * point);
        const glm::dvec3 at(node.translation[0], node.translation[1], node.translation[2]);
        EXPECT_LT(glm::length(at + node.scale[0] * turned - pose.world(point)), 1e-6);
    }
}

TEST(ColonyFile, AllMembersUseTheImagesOfOneMushroom) {
    ColonySpec spec = colony_of("armillaria_mellea", 5, 2);
    spec.params.textures = Textures::embedded;
    spec.params.texture_size.value = 256;
    spec.params.lod = 1;
    const ReadScene found = expect_scene(joined(grown(spec).glb));
    EXPECT_EQ(found.images, (std::vector<std::array<int, 2>>(3, {128, 128})))
        << "the size of the colony's level";
    for (const auto& mesh : found.meshes)
        EXPECT_EQ(mesh[0].attributes,
                  (std::vector<std::string>{"NORMAL", "POSITION", "TANGENT", "TEXCOORD_0"}));
    spec.params.textures = Textures::linked;
    EXPECT_TRUE(names(refusal([&] { (void)grown(spec); }), "/textures"));
}

TEST(ColonyFile, AllOfItsMeshesHaveTheVariantsOfItsMaterial) {
    for (const Instancing instancing : {Instancing::nodes, Instancing::gpu}) {
        ColonySpec spec = colony_of("hypholoma_fasciculare", 6, 2);
        spec.params.lod = 2;
        spec.params.textures = Textures::embedded;
        spec.params.texture_size.value = 256;
        spec.params.instancing = instancing;
        const Bytes plain = joined(grown(spec).glb);
        spec.params.variants = Variants::weather;
        const Bytes file = joined(grown(spec).glb);
        const Value json = json_chunk(file);
        std::vector<std::string> names;
        for (const Value& variant :
             json.at_pointer("/extensions/KHR_materials_variants/variants")->items())
            names.push_back(variant.find("name")->as_string());
        EXPECT_EQ(names, (std::vector<std::string>{"dry", "wet", "aged", "frosted"}));
        const auto& materials = json.find("materials")->items();
        ASSERT_EQ(materials.size(), 5U);
        EXPECT_EQ(json.find("images")->items().size(), 12U);
        EXPECT_EQ(*json.find("materials")->items()[0].find("name"),
                  *json_chunk(plain).find("materials")->items()[0].find("name"))
            << "the requested material is that of a colony without variants";
        for (const Value& mesh : json.find("meshes")->items())
            for (const Value& primitive : mesh.find("primitives")->items()) {
                EXPECT_EQ(primitive.find("material")->as_number(), 0.0);
                const Value* const mappings =
                    primitive.at_pointer("/extensions/KHR_materials_variants/mappings");
                ASSERT_NE(mappings, nullptr) << "stems too";
                EXPECT_EQ(mappings->items().size(), 4U);
            }
        const auto coat = [&](std::size_t material) {
            const Value* const found = materials[material].at_pointer(
                "/extensions/KHR_materials_clearcoat/clearcoatFactor");
            return found ? found->as_number() : 0.0;
        };
        EXPECT_GT(coat(2), coat(1)) << "wet over dry";
        EXPECT_NE(materials[4].at_pointer("/extensions/KHR_materials_sheen"), nullptr) << "rime";
        const double estimated = static_cast<double>(estimate(spec, typical(spec), atlas()).bytes);
        EXPECT_NEAR(estimated / static_cast<double>(file.size()), 1.0, 0.5);
    }
}

TEST(ColonyFile, VariantsPaintTheSameMushroomAfterOtherWeather) {
    ColonySpec spec = colony_of("hypholoma_fasciculare", 6, 2);
    spec.params.textures = Textures::embedded;
    spec.params.variants = Variants::weather;
    const MushroomSpec painted = paint_mushroom_spec(spec);
    const PaintParams requested = paint_spec_of(spec, painted, atlas()).at(0).painting;
    for (const Variant& variant : variants_of(painted, typical(spec))) {
        PaintParams own = paint_spec_of(spec, variant.painted, atlas()).at(0).painting;
        EXPECT_EQ(own.weathering == requested.weathering, !variant.has_own_images) << variant.name;
        own.weathering = requested.weathering;
        EXPECT_EQ(own, requested) << variant.name << ": nothing else is painted differently";
    }
}

TEST(ColonyFile, VariantsNeedImagesAndExtensions) {
    ColonySpec spec = colony_of("hypholoma_fasciculare", 6, 2);
    spec.params.variants = Variants::weather;
    const auto refused = [&] {
        return refusal([&] { (void)estimate(spec, typical(spec), atlas()); });
    };
    EXPECT_TRUE(names(refused(), "/variants", "textures"));
    EXPECT_TRUE(names(refusal([&] { (void)grown(spec); }), "/variants", "textures"));
    spec.params.textures = Textures::embedded;
    spec.params.file.materials = MaterialSet::core;
    EXPECT_TRUE(names(refused(), "/variants", "materials"));
}

TEST(ColonyFile, IsDeterministicAndDependsOnTheSeed) {
    ColonySpec spec = colony_of("hypholoma_fasciculare");
    spec.params.habit = Habit::rooted;
    const Bytes once = joined(grown(spec).glb);
    EXPECT_EQ(once, joined(grown(spec).glb));
    spec.params.seed = 2;
    EXPECT_NE(once, joined(grown(spec).glb));
}

TEST(ColonyFile, TiersStandOnWoodAndTouchIt) {
    for (const char* id : {"fomes_fomentarius", "trametes_versicolor", "tremella_mesenterica"}) {
        ColonySpec spec = colony_of(id, 9, 3);
        for (int lod = 0; lod < 4; ++lod) {
            spec.params.lod = lod;
            const Colony colony = parts_of(spec);
            expect_valid(colony.wood);
            EXPECT_EQ(colony.effective.substrate, colony_traits(spec, atlas()).substrate);
            const double radius = spec.params.size * *colony.effective.trunk_radius;
            const Bounds wood = bounds(colony.wood);
            for (const ColonyMember& member : colony.members) {
                const glm::dvec3 at = member.pose.at + glm::dvec3(0.0, 0.0, radius);
                EXPECT_LE(std::hypot(at.x, at.z), 1.0001 * radius) << id << ": nothing hovers";
                EXPECT_GT(at.y, static_cast<double>(wood.min.y)) << id;
                EXPECT_LT(at.y, static_cast<double>(wood.max.y)) << id;
            }
        }
        spec.params.lod = 2;
        const Colony with = parts_of(spec);
        const auto scene = expect_scene(joined(grown(spec).glb));
        ASSERT_EQ(scene.materials.size(), 2U);
        spec.params.substrate = Substrate::none;
        const Colony without = parts_of(spec);
        EXPECT_TRUE(without.wood.positions.empty());
        ASSERT_EQ(with.members.size(), without.members.size()) << "it moves nobody";
        EXPECT_EQ(with.members.front().pose.at, without.members.front().pose.at);
        EXPECT_EQ(expect_scene(joined(grown(spec).glb)).materials.size(), 1U);
    }
}

TEST(ColonyFile, AMixIsOneMushroomInManyInstances) {
    ColonySpec spec = colony_of("", 8, 3);
    spec.mix = {{"armillaria_mellea", 500}, {"hypholoma_fasciculare", 500}};
    (void)expect_scene(joined(grown(spec).glb));
    spec.mix = {{"armillaria_mellea", 500}, {"trametes_versicolor", 500}};
    EXPECT_EQ(colony_traits(spec, atlas()).habit, Habit::tier);
    (void)expect_scene(joined(grown(spec).glb));
}

TEST(ColonyFile, DescribesTheResult) {
    ColonySpec spec = colony_of("hypholoma_fasciculare", 64, 4);
    spec.params.habit = Habit::rooted;
    const Colony colony = parts_of(spec);
    EXPECT_LT(colony.members.size(), 64U) << "there are not as many stems";
    EXPECT_EQ(colony.effective.count, 64);
    EXPECT_EQ(colony.effective.habit, Habit::rooted);
    ColonyRootsOf<Maybe>::fields([&](auto member, const Info& info) {
        EXPECT_TRUE(colony.effective.growth.*member) << info.name;
    });
    // Requesting the effective parameters gives the same colony.
    ColonySpec again = spec;
    again.params = colony.effective;
    const Colony second = parts_of(again);
    EXPECT_EQ(second.members.size(), colony.members.size());
    EXPECT_TRUE(same_bits(second.skin, colony.skin));
}

TEST(ColonyBudget, IsCheckedBeforeAnyWork) {
    ColonySpec spec = colony_of("hypholoma_fasciculare");
    spec.params.habit = Habit::rooted;
    spec.params.growth.depth = 60;
    spec.params.growth.branch_distance = 0.005;
    EXPECT_TRUE(names(refusal([&] { (void)estimate(spec, typical(spec), atlas()); }),
                      "/branch_distance", "nodes"));
    EXPECT_TRUE(names(refusal([&] { (void)parts_of(spec); }), "/branch_distance", "nodes"));
    ExecutionContext stopped = with_cached_morphs();
    std::stop_source source;
    source.request_stop();
    stopped.stop = source.get_token();
    const ColonySpec other = colony_of("hypholoma_fasciculare");
    EXPECT_THROW((void)colony_parts(other, typical(other), atlas(), stopped), Cancelled);
}

// Every parameter at both ends of its range makes a valid colony, or is refused for a reason.
TEST(ColonyCorners, AreValidOrRefusedByName) {
    for (const char* id : {"hypholoma_fasciculare", "lycoperdon_perlatum", "trametes_versicolor"})
        for (const bool rooted : {true, false}) {
            ColonySpec spec = colony_of(id, 5, 2);
            spec.params.lod = 1;
            if (rooted && std::string(id) == "trametes_versicolor") continue;
            if (rooted) spec.params.habit = Habit::rooted;
            corners(spec.params, [&](const std::string& path) {
                SCOPED_TRACE(std::string(id) + path);
                if (path == "/textures") return;
                try {
                    const Colony colony = parts_of(spec);
                    if (!colony.skin.positions.empty()) expect_valid(colony.skin);
                    for (const ColonyMember& member : colony.members)
                        EXPECT_TRUE(std::isfinite(member.pose.at.y) && member.pose.scale > 0.0);
                } catch (const InvalidInput& refused) {
                    EXPECT_FALSE(refused.problems().empty());
                }
            });
        }
}

}  // namespace
}  // namespace sporeprint::grow_colony_test
