#include "core/grow/collision.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <nlohmann/json.hpp>
#include <numeric>
#include <span>
#include <string>
#include <vector>

#include "core/collision/convex_hull.h"
#include "core/grow/colony.h"
#include "core/grow/colony_estimate.h"
#include "core/grow/colony_individuals.h"
#include "core/grow/leaf.h"
#include "core/grow/mushroom.h"
#include "core/grow/tree.h"
#include "core/mesh/measure.h"
#include "core/plant/tree.h"
#include "tests/support/glb_reader.h"
#include "tests/support/meshes.h"
#include "tests/support/orders.h"
#include "tests/support/refusals.h"

namespace sporeprint::grow_collision_test {
namespace {

using nlohmann::json;

json document_of(const Body& body) { return json::parse(dump(json_chunk(joined(body)))); }

bool contains(const CollisionShape& shape, const glm::dvec3& point) {
    if (const auto* const capsule = std::get_if<Capsule>(&shape.solid))
        return capsule->contains(point);
    const Mesh& hull = std::get<Mesh>(shape.solid);
    for (std::size_t i = 0; i + 2 < hull.indices.size(); i += 3) {
        const glm::dvec3 a(hull.positions[hull.indices[i]]), b(hull.positions[hull.indices[i + 1]]),
            c(hull.positions[hull.indices[i + 2]]);
        if (glm::dot(glm::cross(b - a, c - a), point - a) > 0.0) return false;
    }
    return true;
}

/// Returns the convex hulls of sixteen slices of a part of a mesh, with all of their corners.
std::vector<Mesh> thin_slices(const Mesh& mesh, std::uint32_t parts) {
    constexpr int count = 16;
    std::vector<std::array<glm::vec3, 3>> triangles;
    float low = 1e9F, high = -1e9F;
    for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
        const glm::vec2& place = mesh.texture_coordinates[mesh.indices[i]];
        if ((parts >> index_of(part_at(place.x, place.y)) & 1U) == 0) continue;
        triangles.push_back({mesh.positions[mesh.indices[i]], mesh.positions[mesh.indices[i + 1]],
                             mesh.positions[mesh.indices[i + 2]]});
        for (const glm::vec3& at : triangles.back()) {
            low = std::min(low, at.y);
            high = std::max(high, at.y);
        }
    }
    std::vector<Mesh> slices;
    for (int slice = 0; slice < count; ++slice) {
        const float from = low + (high - low) * static_cast<float>(slice) / count,
                    to = low + (high - low) * static_cast<float>(slice + 1) / count;
        std::vector<glm::vec3> points;
        for (const auto& triangle : triangles)
            for (std::size_t k = 0; k < 3; ++k) {
                const glm::vec3 &a = triangle[k], &b = triangle[(k + 1) % 3];
                if (a.y >= from && a.y <= to) points.push_back(a);
                for (const float level : {from, to})
                    if ((a.y < level) != (b.y < level))
                        points.push_back(a + (b - a) * ((level - a.y) / (b.y - a.y)));
            }
        const std::vector<glm::vec3> corners = farthest_points(points, directions(32, 9));
        if (Mesh hull = convex_hull(corners); !hull.indices.empty())
            slices.push_back(std::move(hull));
    }
    return slices;
}

constexpr std::uint32_t on_stem = 1U << index_of(Part::stem),
                        on_cap = ~(on_stem | 1U << index_of(Part::veil));

/// Returns the volume that the solids of some parts share with these parts of the mesh, their
/// hollows filled, of that of both together. Each slice is measured on a grid of its own, as wide
/// again to all sides, since a thin stem that leans fills little of its whole box.
double shared(const Mesh& mesh, const std::vector<CollisionShape>& shapes,
              std::span<const std::uint32_t> parts) {
    const auto in = [](const std::vector<CollisionShape>& all, const glm::dvec3& at) {
        return std::any_of(all.begin(), all.end(),
                           [&](const CollisionShape& one) { return contains(one, at); });
    };
    constexpr int across = 36, steps = 3;
    double both = 0.0, either = 0.0;
    for (const std::uint32_t part : parts) {
        const std::vector<Mesh> slices = thin_slices(mesh, part);
        for (std::size_t i = 0; i < slices.size(); ++i) {
            const std::vector<CollisionShape> filled{{"slice", slices[i]}};
            const Bounds box = bounds(slices[i]);
            glm::dvec3 low(box.min), high(box.max);
            const glm::dvec3 size = high - low;
            low -= glm::dvec3(size.x, i == 0 ? size.y : 0.0, size.z);
            high += glm::dvec3(size.x, i + 1 == slices.size() ? size.y : 0.0, size.z);
            const glm::dvec3 step = (high - low) / glm::dvec3(across, steps, across);
            const double volume = step.x * step.y * step.z;
            for (int x = 0; x < across; ++x)
                for (int y = 0; y < steps; ++y)
                    for (int z = 0; z < across; ++z) {
                        const glm::dvec3 at = low + (glm::dvec3(x, y, z) + 0.5) * step;
                        const bool of_mesh = in(filled, at), of_shapes = in(shapes, at);
                        both += of_mesh && of_shapes ? volume : 0.0;
                        either += of_mesh || of_shapes ? volume : 0.0;
                    }
        }
    }
    return both / either;
}

class CollisionOfSpecies : public testing::TestWithParam<std::string> {};

/// Thin stems are measured most coarsely, and arched rays are filled.
constexpr double least_of_one = 0.7, least_mean = 0.85;

TEST_P(CollisionOfSpecies, SharesMostOfItsVolumeWithTheFilledMesh) {
    std::vector<double> shares;
    for (const double age : {0.2, 0.6, 0.95}) {
        const Individual individual = resolved(textured(order_of(GetParam(), age)));
        const std::vector<CollisionShape> shapes = collision_shapes(individual);
        ASSERT_FALSE(shapes.empty());
        EXPECT_LE(shapes.size(), 16U);
        const Mesh mesh = body_mesh(individual, 1, {.textured = true});
        for (const char* part : {"body", "stem", "cap"}) {
            std::vector<CollisionShape> of_part;
            for (const CollisionShape& shape : shapes)
                if (shape.part == part) of_part.push_back(shape);
            if (of_part.empty()) continue;
            const bool is_cap = part == std::string("cap"), is_stem = part == std::string("stem");
            const std::vector<std::uint32_t> places =
                individual.is_branched() ? std::vector<std::uint32_t>{~0U}
                : is_cap                 ? std::vector<std::uint32_t>{on_cap}
                : is_stem                ? std::vector<std::uint32_t>{on_stem}
                                         : std::vector<std::uint32_t>{on_cap | on_stem};
            shares.push_back(shared(mesh, of_part, places));
            EXPECT_GE(shares.back(), least_of_one)
                << "at " << age << ", " << of_part.size() << " solids of its " << part;
        }
        for (const CollisionShape& shape : shapes)
            if (const auto* const hull = std::get_if<Mesh>(&shape.solid)) {
                EXPECT_EQ(defects(*hull), std::vector<std::string>{});
                EXPECT_LE(hull->positions.size(), static_cast<std::size_t>(most_hull_corners));
            }
    }
    EXPECT_GE(
        std::accumulate(shares.begin(), shares.end(), 0.0) / static_cast<double>(shares.size()),
        least_mean);
}

INSTANTIATE_TEST_SUITE_P(AllSpecies, CollisionOfSpecies, testing::ValuesIn(species_ids()),
                         [](const auto& one) { return one.param; });

MushroomSpec fly_agaric(CollisionFormat format) {
    MushroomSpec spec = order_of("amanita_muscaria");
    spec.params.file.collision = format;
    return spec;
}

std::size_t shapes_of_fly_agaric() {
    return collision_shapes(resolved(order_of("amanita_muscaria"))).size();
}

TEST(Collision, OfAFlyAgaricAreOfItsStemAndAConvexCap) {
    const std::vector<CollisionShape> shapes =
        collision_shapes(resolved(order_of("amanita_muscaria")));
    ASSERT_GE(shapes.size(), 2U);
    EXPECT_EQ(shapes.front().part, "stem");
    EXPECT_EQ(shapes.back().part, "cap");
    EXPECT_TRUE(std::holds_alternative<Mesh>(shapes.back().solid));
}

TEST(Collision, OfAThinStraightStemHasCapsules) {
    const std::vector<CollisionShape> shapes =
        collision_shapes(resolved(order_of("mycena_sanguinolenta")));
    EXPECT_TRUE(std::any_of(shapes.begin(), shapes.end(), [](const CollisionShape& shape) {
        return shape.part == "stem" && std::holds_alternative<Capsule>(shape.solid);
    }));
}

TEST(Collision, IsTheSameAtEveryLevelOfDetailAndWithoutImages) {
    MushroomSpec spec = order_of("boletus_edulis");
    const std::string first = dump(collision_value(body_of(collision_shapes(resolved(spec)))));
    spec.params.lod = 3;
    EXPECT_EQ(dump(collision_value(body_of(collision_shapes(resolved(textured(spec)))))), first);
}

TEST(Collision, ByNodesHasMeshesNamedAsUnrealEngineExpects) {
    const json document =
        document_of(grow_mushroom(fly_agaric(CollisionFormat::nodes), atlas()).glb);
    const std::size_t count = shapes_of_fly_agaric();
    ASSERT_EQ(document["nodes"].size(), 1 + count);
    const std::string name = document["nodes"][0]["name"];
    for (std::size_t i = 1; i <= count; ++i) {
        const json& node = document["nodes"][i];
        EXPECT_EQ(node["name"], "UCX_" + name + "_0" + std::to_string(i - 1));
        const json& primitive = document["meshes"][node["mesh"].get<int>()]["primitives"][0];
        EXPECT_FALSE(primitive.contains("material"));
        EXPECT_FALSE(primitive["attributes"].contains("TEXCOORD_0"));
    }
    EXPECT_EQ(document["scenes"][0]["nodes"].size(), 1 + count);
    EXPECT_EQ(document["nodes"][1]["extras"], json::parse(R"({"collision":"stem"})"));
    EXPECT_FALSE(document.contains("extensionsUsed"));
}

TEST(Collision, ByOmiIsAStaticBodyWithTheMeshInAChild) {
    const json document = document_of(grow_mushroom(fly_agaric(CollisionFormat::omi), atlas()).glb);
    const std::size_t count = shapes_of_fly_agaric();
    ASSERT_EQ(document["nodes"].size(), 2 + count);
    EXPECT_EQ(document["scenes"][0]["nodes"], json::array({1 + count}));
    const json& body = document["nodes"].back();
    ASSERT_EQ(body["children"].size(), 1 + count);
    EXPECT_EQ(body["children"][0], 0);
    EXPECT_EQ(body["extensions"]["OMI_physics_body"],
              json::parse(R"({"motion":{"type":"static"}})"));
    EXPECT_FALSE(body.contains("mesh"));
    EXPECT_TRUE(document["nodes"][0].contains("mesh"));
    const json& shapes = document["extensions"]["OMI_physics_shape"]["shapes"];
    ASSERT_EQ(shapes.size(), count);
    for (const json& shape : shapes) {
        const json& solid = shape[shape["type"].get<std::string>()];
        if (shape["type"] == "capsule")
            EXPECT_GE(solid["height"], 2.0 * solid["radius"].get<double>());
        else
            EXPECT_LT(solid["mesh"], document["meshes"].size());
    }
    EXPECT_EQ(shapes.back()["type"], "convex");
    for (std::size_t i = 0; i < count; ++i) {
        const json& node = document["nodes"][1 + i];
        EXPECT_EQ(node["extensions"]["OMI_physics_body"]["collider"]["shape"], i);
        EXPECT_FALSE(node.contains("mesh"));
    }
    EXPECT_EQ(document["extensionsUsed"],
              json::parse(R"(["OMI_physics_body","OMI_physics_shape"])"));
    EXPECT_FALSE(document.contains("extensionsRequired"));
}

TEST(Collision, ByOmiLeavesOtherLevelsOutsideTheScene) {
    MushroomSpec spec = fly_agaric(CollisionFormat::omi);
    spec.params.file.lods = Lods::msft;
    const json document = document_of(grow_mushroom(spec, atlas()).glb);
    const json& nodes = document["nodes"];
    const std::size_t count = shapes_of_fly_agaric();
    const std::size_t levels = document["asset"]["extras"]["levels"].size();
    EXPECT_GT(levels, 1U);
    ASSERT_EQ(nodes.size(), levels + 1 + count);
    EXPECT_EQ(document["scenes"][0]["nodes"], json::array({levels + count}));
    const json& children = nodes.back()["children"];
    ASSERT_EQ(children.size(), 1 + count);
    EXPECT_EQ(children[0], 0);
    EXPECT_EQ(children[1], levels);
    json others = json::array();
    for (std::size_t i = 1; i < levels; ++i) others.push_back(i);
    EXPECT_EQ(nodes[0]["extensions"]["MSFT_lod"]["ids"], others);
}

TEST(Collision, OfAColonyHasThatOfEachMemberAtItsPlace) {
    ColonySpec spec;
    spec.mix = {{"hypholoma_fasciculare", 1000}};
    spec.params.count = 7;
    spec.params.distinct = 2;
    spec.params.size = 2.0;
    spec.params.textures = Textures::none;
    spec.params.file.collision = CollisionFormat::omi;
    const Colony colony =
        colony_parts(spec, typical_individual(spec, atlas()), atlas(), ExecutionContext{});
    const Bounds box = bounds(colony);
    const double reach = 0.1 * glm::length(glm::dvec3(box.max - box.min));
    std::size_t stems = 0;
    for (const Collider& collider : colony.collision.colliders) {
        ASSERT_LT(collider.shape, colony.collision.shapes.size());
        const CollisionShape& shape = colony.collision.shapes[collider.shape];
        stems += shape.part == "stem" ? 1U : 0U;
        for (int axis = 0; axis < 3; ++axis) {
            EXPECT_GT(collider.place.translation[axis], box.min[axis] - reach);
            EXPECT_LT(collider.place.translation[axis], box.max[axis] + reach);
        }
    }
    EXPECT_GE(stems, colony.members.size());
    EXPECT_GE(colony.collision.colliders.size(), 2 * colony.members.size());
    const json document = document_of(grow_colony(spec, atlas()).glb);
    EXPECT_EQ(document["scenes"][0]["nodes"].size(), 1U);
}

TEST(Collision, OfATreeIsItsTrunk) {
    for (const TreePreset& preset : atlas().trees()) {
        TreeSpec spec{preset.id.string(), params_of(preset)};
        spec.params.size = 0.5;
        const Collision collision = trunk_collision(spec);
        ASSERT_GE(collision.shapes.size(), 1U) << spec.preset;
        EXPECT_LE(collision.shapes.size(), 4U);
        const Tree tree = grown_tree(spec.params.look.shape, spec.params.seed);
        // The foot of the trunk stands on the ground, where its lowest capsule begins.
        const auto& first = std::get<Capsule>(collision.shapes[0].solid);
        EXPECT_NEAR(collision.colliders[0].place.translation.y, 0.5 * first.height() - first.radius,
                    0.35 * first.height());
        EXPECT_LE(first.radius, 0.5 * tree.skeleton.nodes[0].radius + 1e-9);
        EXPECT_GE(first.radius, 0.4 * 0.5 * tree.skeleton.nodes[0].radius);
    }
}

TEST(Collision, IsPartOfTheEstimate) {
    for (const CollisionFormat format : {CollisionFormat::nodes, CollisionFormat::omi}) {
        MushroomSpec spec = fly_agaric(format);
        const double mushroom = static_cast<double>(size_of(grow_mushroom(spec, atlas()).glb));
        spec.params.file.collision = CollisionFormat::none;
        const double plain = static_cast<double>(size_of(grow_mushroom(spec, atlas()).glb));
        const double expected = static_cast<double>(estimate(fly_agaric(format), atlas()).bytes) -
                                static_cast<double>(estimate(spec, atlas()).bytes);
        EXPECT_GT(expected, 0.7 * (mushroom - plain));
        EXPECT_LT(expected, 2.0 * (mushroom - plain));
        ColonySpec colony;
        colony.mix = {{"hypholoma_fasciculare", 1000}};
        colony.params.textures = Textures::none;
        colony.params.file.collision = format;
        const Individual typical = typical_individual(colony, atlas());
        const double more = static_cast<double>(estimate(colony, typical, atlas()).bytes);
        const double size = static_cast<double>(size_of(grow_colony(colony, atlas()).glb));
        colony.params.file.collision = CollisionFormat::none;
        const double less = static_cast<double>(estimate(colony, typical, atlas()).bytes);
        const double without = static_cast<double>(size_of(grow_colony(colony, atlas()).glb));
        EXPECT_GT(more - less, 0.7 * (size - without));
        EXPECT_LT(more - less, 2.6 * (size - without));
    }
}

TEST(Collision, WhatIsImpossibleIsRefusedByName) {
    LeafSpec leaf{"maple", params_of(*atlas().find_leaf("maple"))};
    leaf.params.file.collision = CollisionFormat::nodes;
    EXPECT_TRUE(names(refusal([&] { static_cast<void>(estimate(leaf)); }), "/collision"));
    EXPECT_TRUE(names(refusal([&] { static_cast<void>(grow_leaf(leaf, atlas())); }), "/collision"));
    MushroomSpec spec = fly_agaric(CollisionFormat::omi);
    spec.params.file.compress = Compression::quantize;
    EXPECT_TRUE(names(refusal([&] { static_cast<void>(estimate(spec, atlas())); }), "/collision"));
    spec.params.file.collision = CollisionFormat::nodes;
    EXPECT_NO_THROW(static_cast<void>(grow_mushroom(spec, atlas())));
}

TEST(Collision, AsJsonStatesShapesAndPlaces) {
    Collision collision;
    collision.add({"stem", Capsule{{0.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, 0.25}});
    EXPECT_EQ(
        dump(collision_value(collision)),
        R"({"shapes":[{"part":"stem","capsule":{"radius_m":0.25,"height_m":1.5}}],)"
        R"("colliders":[{"shape":0,"translation_m":[0,0.5,0],"rotation":[0,0,0,1],"scale":1}]})");
}

}  // namespace
}  // namespace sporeprint::grow_collision_test
