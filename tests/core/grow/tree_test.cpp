#include "core/grow/tree.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <numeric>
#include <stop_token>
#include <string>
#include <vector>

#include "core/grow/leaf.h"
#include "core/math/direction.h"
#include "core/mesh/measure.h"
#include "core/plant/leaf_image.h"
#include "core/plant/leaf_spray.h"
#include "tests/support/atlas.h"
#include "tests/support/drawing.h"
#include "tests/support/effort.h"
#include "tests/support/glb_reader.h"
#include "tests/support/keeper.h"
#include "tests/support/meshes.h"
#include "tests/support/orders.h"
#include "tests/support/refusals.h"

namespace sporeprint::grow_tree_test {
namespace {

TreeSpec order_of(const std::string& preset, int lod = 0, int side = 128) {
    TreeSpec spec{preset, params_of(*tree_preset(preset))};
    spec.params.lod = lod;
    spec.params.texture_size.value = side;
    return spec;
}

class EveryTree : public ::testing::TestWithParam<std::string> {};

std::vector<std::string> ids() {
    std::vector<std::string> found;
    for (const TreePreset& preset : tree_presets()) found.push_back(preset.id.string());
    return found;
}

INSTANTIATE_TEST_SUITE_P(Presets, EveryTree, ::testing::ValuesIn(ids()),
                         [](const auto& one) { return one.param; });

TEST_P(EveryTree, ReadsBackFromItsFileAsTwoDrawCalls) {
    for (int lod = 0; lod < tree_lods; ++lod) {
        const Grown tree = grow_tree(order_of(GetParam(), lod), atlas());
        const ReadScene found = expect_scene(joined(tree.glb));
        ASSERT_EQ(found.meshes.size(), 1u);
        ASSERT_EQ(found.meshes[0].size(), 2u);
        ASSERT_EQ(found.nodes.size(), 1u);
        EXPECT_TRUE(found.nodes[0].name.starts_with(GetParam() + "_tree_s1_"));
        EXPECT_TRUE(found.nodes[0].name.ends_with("_LOD" + std::to_string(lod)));
        std::size_t vertices = 0, triangles = 0;
        for (const ReadPrimitive& part : found.meshes[0]) {
            vertices += part.mesh.positions.size();
            triangles += part.mesh.triangles();
            EXPECT_EQ(part.attributes, (std::vector<std::string>{"COLOR_0", "NORMAL", "POSITION",
                                                                 "TANGENT", "TEXCOORD_0"}));
        }
        EXPECT_EQ(vertices, tree.vertices);
        EXPECT_EQ(triangles, tree.triangles);
        ASSERT_EQ(found.materials.size(), 2u);
        EXPECT_TRUE(found.materials[0].name.starts_with(GetParam() + "_bark_"));
        EXPECT_EQ(found.materials[0].wrap_s, 10497) << "bark goes round";
        EXPECT_TRUE(found.materials[1].name.find("_leaf_") != std::string::npos);
        EXPECT_EQ(found.materials[1].wrap_s, 33071);
        const int side = 128 >> lod;
        EXPECT_EQ(found.images, (std::vector<std::array<int, 2>>(6, {side, side})));
    }
}

// The file has one leaf; a reader that draws it at each place sees the tree of merged leaves.
TEST_P(EveryTree, InstancedLeavesStandWhereMergedOnesDo) {
    for (int lod = 1; lod < tree_lods; ++lod) {
        TreeSpec spec = order_of(GetParam(), lod);
        const TreeMeshes merged = tree_meshes(spec, atlas());
        spec.params.instancing = LeafInstancing::gpu;
        const Grown tree = grow_tree(spec, atlas());
        const ReadScene found = expect_scene(joined(tree.glb));
        ASSERT_EQ(found.meshes.size(), 2u);
        ASSERT_EQ(found.nodes.size(), 2u);
        EXPECT_EQ(found.meshes[0][0].mesh.positions, merged.bark.positions);
        const Mesh& leaf = found.meshes[1][0].mesh;
        const std::vector<ReadInstance>& places = found.nodes[1].instances;
        ASSERT_EQ(places.size() * leaf.positions.size(), merged.leaves.positions.size());
        EXPECT_EQ(tree.vertices, merged.bark.positions.size() + leaf.positions.size());
        EXPECT_EQ(tree.triangles, merged.triangles()) << "all that are drawn";
        double farthest = 0.0;
        for (std::size_t i = 0; i < places.size(); ++i)
            for (std::size_t k = 0; k < leaf.positions.size(); ++k) {
                const glm::dvec3 at = glm::dvec3(places[i].translation) +
                                      rotated(glm::dvec4(places[i].rotation),
                                              glm::dvec3(places[i].scale * leaf.positions[k]));
                const glm::dvec3 expected(merged.leaves.positions[i * leaf.positions.size() + k]);
                farthest = std::max(farthest, glm::distance(at, expected));
            }
        EXPECT_LT(farthest, 2e-5);
        const Bounds box = bounds(merged), instanced = bounds(tree_meshes(spec, atlas()));
        EXPECT_LT(glm::distance(box.min, instanced.min), 2e-5F);
        EXPECT_LT(glm::distance(box.max, instanced.max), 2e-5F);
        const auto bytes = static_cast<double>(size_of(tree.glb));
        const Estimate e = estimate(spec);
        EXPECT_GT(static_cast<double>(e.bytes), 0.7 * bytes) << lod;
        EXPECT_LT(static_cast<double>(e.bytes), 6.5 * bytes) << lod;
        EXPECT_GE(1.15 * static_cast<double>(e.triangles), static_cast<double>(tree.triangles));
    }
}

TEST_P(EveryTree, HasFewerTrianglesAtEveryLevelAndOneCrown) {
    Bounds finest;
    double before = 1e12;
    for (int lod = 0; lod < tree_lods; ++lod) {
        const TreeMeshes meshes = tree_meshes(order_of(GetParam(), lod), atlas());
        const auto triangles = static_cast<double>(meshes.triangles());
        // A shrub of 8,000 triangles has little to save.
        EXPECT_LT(triangles, (before < 10'000.0 ? 0.8 : 0.67) * before) << lod;
        before = triangles;
        const Bounds box = bounds(meshes);
        if (lod == 0) finest = box;
        const glm::vec3 size = box.max - box.min, whole = finest.max - finest.min;
        EXPECT_NEAR(static_cast<double>(size.y / whole.y), 1.0, lod < 3 ? 0.1 : 0.3) << lod;
        EXPECT_LE(meshes.leaves.triangles(), 16u * most_leaves);
        EXPECT_GE(box.min.y, -0.2F) << "nothing stands below the ground by more than a root";
    }
}

/// Returns the images of a tree's leaves.
RawImages foliage_images(const TreeSpec& spec) {
    const LeafPreset& leaf = *leaf_preset(spec.params.look.leaf.id.string());
    return leaf_images(leaf.shape, leaf.palette, 0.0, 1, 512, layout_on_trees(leaf.shape));
}

/// Returns which share of each pixel of a picture, `pixels` wide, a tree covers.
///
/// images  of its leaves
std::vector<double> coverage(const TreeMeshes& tree, const RawImages& images,
                             const ViewDirection& view, ImagePlane plane) {
    constexpr int samples = 8;
    const int pixels = plane.pixels;
    plane.pixels *= samples;
    const Drawing bark = drawn(tree.bark, view, plane),
                  leaves = drawn(tree.leaves, view, plane, ~0U, &images);
    std::vector<double> shares(static_cast<std::size_t>(pixels * pixels));
    for (int y = 0; y < plane.pixels; ++y)
        for (int x = 0; x < plane.pixels; ++x)
            if (bark.at(x, y) || leaves.at(x, y))
                shares[static_cast<std::size_t>(y / samples * pixels + x / samples)] +=
                    1.0 / (samples * samples);
    return shares;
}

// A tree of 40 pixels covers the same pixels at every level: the sum of what they differ by, relative
// to the area of the silhouette.
TEST_P(EveryTree, HasTheSameSilhouetteAtEveryLevel) {
    const RawImages images = foliage_images(order_of(GetParam()));
    for (const std::uint32_t seed : {1U, 2U}) {
        TreeSpec spec = order_of(GetParam());
        spec.params.seed = seed;
        const TreeMeshes finest = tree_meshes(spec, atlas());
        const Bounds box = bounds(finest);
        const glm::vec3 size = box.max - box.min;
        const ImagePlane plane{0.5F * (box.min + box.max), 1.1 * std::max({size.x, size.y, size.z}),
                               40};
        constexpr std::array azimuths = {0.0, 60.0, 120.0};
        std::vector<std::vector<double>> was;
        was.reserve(azimuths.size());
        for (const double azimuth : azimuths)
            was.push_back(coverage(finest, images, {azimuth, 0.0}, plane));
        for (spec.params.lod = 1; spec.params.lod < tree_lods; ++spec.params.lod) {
            const TreeMeshes coarse = tree_meshes(spec, atlas());
            double differ = 0.0, whole = 0.0;
            for (std::size_t view = 0; view < azimuths.size(); ++view) {
                const std::vector<double> is =
                    coverage(coarse, images, {azimuths[view], 0.0}, plane);
                for (std::size_t i = 0; i < is.size(); ++i) {
                    differ += std::abs(is[i] - was[view][i]);
                    whole += was[view][i];
                }
            }
            // Between slim needles more light passes than through the leaves that stand for them, and a branch reaches
            // farther than the ten leaves that it stands for.
            EXPECT_LE(differ / whole, spec.params.lod < last_lod ? 0.125 : 0.14)
                << seed << ' ' << spec.params.lod;
        }
    }
}

// A far level covers as much as the level before it, from all sides together and nearly so from each.
TEST_P(EveryTree, CoversAsMuchAtFarLevels) {
    const RawImages images = foliage_images(order_of(GetParam()));
    for (const std::uint32_t seed : {1U, 2U}) {
        TreeSpec spec = order_of(GetParam(), last_lod);
        spec.params.seed = seed;
        const Bounds box = bounds(tree_meshes(spec, atlas()));
        const glm::vec3 size = box.max - box.min;
        const ImagePlane plane{0.5F * (box.min + box.max), 1.2 * std::max({size.x, size.y, size.z}),
                               40};
        std::vector<double> before;
        for (const int lod : {last_lod, first_far_lod, first_far_lod + 1, last_far_lod}) {
            spec.params.lod = lod;
            const TreeMeshes meshes = tree_meshes(spec, atlas());
            std::vector<double> areas;
            // Not all of the sides for which the sizes were chosen.
            for (const double azimuth : {0.0, 30.0, 60.0, 90.0, 120.0, 150.0}) {
                const std::vector<double> shares = coverage(meshes, images, {azimuth, 0.0}, plane);
                areas.push_back(std::accumulate(shares.begin(), shares.end(), 0.0));
            }
            double all = 0.0, all_before = 0.0;
            for (std::size_t i = 0; i < before.size(); ++i) {
                all += areas[i];
                all_before += before[i];
                EXPECT_NEAR(areas[i] / before[i], 1.0, 0.35) << seed << ' ' << lod << ' ' << i;
            }
            if (!before.empty()) {
                EXPECT_NEAR(all / all_before, 1.0, 0.15) << seed << ' ' << lod;
            }
            before = std::move(areas);
        }
    }
}

TEST_P(EveryTree, HasFarLevelsInFilesOfSeveralLevels) {
    TreeSpec spec = order_of(GetParam(), first_far_lod);
    const Grown one = grow_tree(spec, atlas());
    EXPECT_LE(one.triangles, 400U);
    const ReadScene alone = expect_scene(joined(one.glb));
    EXPECT_EQ(alone.images, (std::vector<std::array<int, 2>>(6, {16, 16})));
    spec.params.file.lods = Lods::nodes;
    const std::vector<TreeMeshes> levels = level_meshes(spec, atlas());
    ASSERT_EQ(levels.size(), static_cast<std::size_t>(far_lods));
    const Grown all = grow_tree(spec, atlas());
    EXPECT_LE(all.triangles, 400U + 96U + 24U);
    const ReadScene found = expect_scene(joined(all.glb));
    ASSERT_EQ(found.meshes.size(), levels.size());
    const Bounds box = bounds(levels[0]);
    double before = 2.0;
    for (const Level& level : levels_of(spec, atlas(), box)) {
        EXPECT_LT(level.screen_coverage, before);
        EXPECT_GT(level.screen_coverage, 0.0);
        before = level.screen_coverage;
    }
    const Estimate e = estimate(spec);
    EXPECT_GE(e.triangles, all.triangles);
    EXPECT_GE(e.vertices, all.vertices);
    spec.params.file.impostor = true;
    EXPECT_TRUE(names(refusal([&] { (void)estimate(spec); }), "/impostor", "lod=5"));
    // What few triangles are nearest to.
    TreeSpec few = order_of(GetParam());
    few.params.triangles = 100;
    EXPECT_EQ(at_level(few).params.lod, first_far_lod + 1);
}

// The leaves that reach farthest are at every level, and no other reaches beyond them.
TEST_P(EveryTree, ReachesEquallyFarAtNeighbouringLevels) {
    for (std::uint32_t seed = 1; seed <= effort(6, 1); ++seed) {
        Bounds before;
        for (int lod = 0; lod < tree_lods; ++lod) {
            TreeSpec spec = order_of(GetParam(), lod);
            spec.params.seed = seed;
            spec.params.autumn = std::min(1.0, 0.2 * (seed - 1.0));
            const Bounds box = bounds(tree_meshes(spec, atlas()));
            const glm::vec3 size = box.max - box.min, last = before.max - before.min;
            for (int axis = 0; lod > 0 && axis < 3; ++axis)
                EXPECT_NEAR(static_cast<double>(size[axis] / last[axis]), 1.0, 0.03)
                    << seed << ' ' << lod << ' ' << axis;
            before = box;
        }
    }
}

TEST_P(EveryTree, IsEstimatedBeforeAnyWork) {
    for (int lod = 0; lod < tree_lods; ++lod)
        for (std::uint32_t seed = 1; seed <= effort(4, 1); ++seed) {
            TreeSpec spec = order_of(GetParam(), lod, 256);
            spec.params.seed = seed;
            const Estimate e = estimate(spec);
            const Grown tree = grow_tree(spec, atlas());
            EXPECT_GE(1.15 * static_cast<double>(e.vertices), static_cast<double>(tree.vertices));
            EXPECT_GE(1.15 * static_cast<double>(e.triangles), static_cast<double>(tree.triangles));
            EXPECT_LT(static_cast<double>(e.vertices), 4.5 * static_cast<double>(tree.vertices));
            EXPECT_EQ(e.texels, 6u * (256u >> lod) * (256u >> lod));
            const auto bytes = static_cast<double>(size_of(tree.glb));
            EXPECT_GT(static_cast<double>(e.bytes), 0.7 * bytes) << lod;
            EXPECT_LT(static_cast<double>(e.bytes), 4.5 * bytes) << lod;
        }
}

TEST_P(EveryTree, GivesEqualBytesTwiceAndWithManyThreads) {
    const TreeSpec spec = order_of(GetParam(), 1, 128);
    ExecutionContext threads;
    threads.parallel = in_threads;
    const Bytes once = joined(grow_tree(spec, atlas()).glb);
    EXPECT_EQ(joined(grow_tree(spec, atlas(), {}, {}, threads).glb), once);
    EXPECT_EQ(joined(grow_tree(spec, atlas()).glb), once);
}

TEST_P(EveryTree, LeavesSitOnItsTwigs) {
    const TreePreset& preset = *tree_preset(GetParam());
    const Tree tree = grown_tree(preset.shape, 3);
    for (const PlacedLeaf& leaf : placed_leaves(tree, preset.leaves, 3)) {
        const std::uint32_t twig = leaf.id / 64;
        const glm::dvec3 from = tree.skeleton.nodes[tree.skeleton.segments[twig].from].place;
        const glm::dvec3 to = tree.skeleton.nodes[twig + 1].place;
        const glm::dvec3 way = to - from;
        const double t =
            std::clamp(glm::dot(leaf.place - from, way) / glm::dot(way, way), 0.0, 1.0);
        ASSERT_LT(glm::distance(leaf.place, from + t * way),
                  1e-9 + tree.skeleton.nodes[twig + 1].radius);
    }
}

// Tints are in the file where viewers multiply a base colour by them, and nowhere else.
TEST(GrownTree, HasTintsUnlessColoursAreTakenOrNothingIsColoured) {
    using Names = std::vector<std::string>;
    const auto attributes = [](const TreeSpec& spec) {
        const ReadScene found = expect_scene(joined(grow_tree(spec, atlas()).glb));
        EXPECT_EQ(found.meshes[0][0].attributes, found.meshes[0][1].attributes);
        return found.meshes[0][1].attributes;
    };
    TreeSpec spec = order_of("shrub", 3);
    const Names textured = {"COLOR_0", "NORMAL", "POSITION", "TANGENT", "TEXCOORD_0"};
    EXPECT_EQ(attributes(spec), textured);
    for (const Compression compress : {Compression::quantize, Compression::meshopt}) {
        TreeSpec small = spec;
        small.params.file.compress = compress;
        EXPECT_NE(dump(json_chunk(joined(grow_tree(small, atlas()).glb))).find("COLOR_0"),
                  std::string::npos);
    }
    TreeSpec instanced = spec;
    instanced.params.instancing = LeafInstancing::gpu;
    EXPECT_NE(dump(json_chunk(joined(grow_tree(instanced, atlas()).glb))).find("_COLOR_0"),
              std::string::npos);
    spec.params.file.wind = WindFormat::color;
    EXPECT_TRUE(tree_meshes(spec, atlas()).leaves.tints.empty()) << "colours are weights of wind";
    spec.params.file.wind = WindFormat::none;
    spec.params.look.leaves.hue_spread = 0.0;
    EXPECT_EQ(attributes(spec), (Names{"NORMAL", "POSITION", "TANGENT", "TEXCOORD_0"}));
    spec.params.look.leaves.hue_spread = 0.5;
    spec.params.textures = Textures::none;
    EXPECT_EQ(attributes(spec), (Names{"NORMAL", "POSITION"}));
}

TEST(GrownTree, SizeScalesTheMeshes) {
    TreeSpec spec = order_of("herb");
    const TreeMeshes one = tree_meshes(spec, atlas());
    spec.params.size = 2.0;
    const TreeMeshes twice = tree_meshes(spec, atlas());
    ASSERT_EQ(one.bark.positions.size(), twice.bark.positions.size());
    for (std::size_t i = 0; i < one.bark.positions.size(); ++i)
        ASSERT_EQ(2.0F * one.bark.positions[i], twice.bark.positions[i]);
    for (std::size_t i = 0; i < one.leaves.positions.size(); ++i)
        ASSERT_EQ(2.0F * one.leaves.positions[i], twice.leaves.positions[i]);
}

TEST(GrownTree, SeedsDifferInShapeAndShareImages) {
    Keeper keeper;
    TreeSpec spec = order_of("shrub", 2);
    const Bytes one = joined(grow_tree(spec, atlas(), {}, {}, keeper.execution).glb);
    EXPECT_EQ(keeper.made, 2) << "bark and leaves";
    spec.params.seed = 2;
    spec.params.look.shape.fork_deg = 40.0;
    EXPECT_NE(joined(grow_tree(spec, atlas(), {}, {}, keeper.execution).glb), one);
    EXPECT_EQ(keeper.made, 2);
    spec.params.autumn = 0.5;
    (void)grow_tree(spec, atlas(), {}, {}, keeper.execution);
    EXPECT_EQ(keeper.made, 3) << "leaves turn, bark does not";
    // A leaf alone is larger on its image.
    LeafSpec leaf{"maple", leaf_of(spec.params, atlas())};
    (void)grow_leaf(leaf, atlas(), {}, keeper.execution);
    EXPECT_EQ(keeper.made, 4);
}

TEST(GrownTree, LinksImagesOrLeavesThemOut) {
    TreeSpec spec = order_of("poplar", 2);
    spec.params.textures = Textures::linked;
    EXPECT_TRUE(names(refusal([&] { (void)grow_tree(spec, atlas()); }), "/textures", "linked"));
    const Extras extras{"/v1/x", {{"/a.jpg", "/b.jpg", "/c.jpg"}, {}}};
    const ReadScene found = expect_scene(
        joined(grow_tree(spec, atlas(), extras, {{"/d.jpg", "/e.jpg", "/f.jpg"}, {}}).glb));
    EXPECT_EQ(found.uris, (std::vector<std::string>{"/a.jpg", "/b.jpg", "/c.jpg", "/d.jpg",
                                                    "/e.jpg", "/f.jpg"}));
    spec.params.textures = Textures::none;
    const ReadScene bare = expect_scene(joined(grow_tree(spec, atlas()).glb));
    for (const ReadPrimitive& part : bare.meshes[0])
        EXPECT_EQ(part.attributes, (std::vector<std::string>{"NORMAL", "POSITION"}));
    EXPECT_TRUE(bare.images.empty());
}

TEST(GrownTree, WithoutLeavesItIsBarkAlone) {
    TreeSpec spec = order_of("birch", 2);
    spec.params.look.leaves.per_tip = 0;
    const Grown tree = grow_tree(spec, atlas());
    const ReadScene found = expect_scene(joined(tree.glb));
    EXPECT_EQ(found.meshes[0].size(), 1u);
    EXPECT_EQ(found.materials.size(), 1u);
    EXPECT_EQ(found.images.size(), 3u);
    EXPECT_EQ(estimate(spec).texels, 3u * 32u * 32u);
}

TEST(GrownTree, DescribesItselfInExtras) {
    TreeSpec spec = order_of("birch", 2);
    spec.params.look.shape.main_deg = 11.0;
    const Value json = json_chunk(joined(grow_tree(spec, atlas(), {"/v1/canonical", {}}).glb));
    EXPECT_EQ(json.at_pointer("/asset/extras/canonical")->as_string(), "/v1/canonical");
    EXPECT_EQ(json.at_pointer("/asset/extras/effective/main_deg")->as_number(), 11.0);
    EXPECT_EQ(json.at_pointer("/asset/extras/effective/rows/0/1")->as_number(),
              spec.params.look.shape.topology.rows[0][1]);
    const TreeMeshes meshes = tree_meshes(spec, atlas());
    EXPECT_EQ(json.at_pointer("/asset/extras/triangles")->as_number(),
              static_cast<double>(meshes.triangles()));
    EXPECT_EQ(static_cast<float>(json.at_pointer("/asset/extras/bounds_m/max/1")->as_number()),
              bounds(meshes).max.y);
    EXPECT_EQ(json.at_pointer("/extensionsUsed"), nullptr);
}

TEST(GrownTree, AnUnknownLeafIsRefused) {
    TreeSpec spec = order_of("herb", 2);
    spec.params.look.leaf = {"elm"};
    for (const auto grow : {+[](const TreeSpec& one) { (void)tree_meshes(one, atlas()); },
                            +[](const TreeSpec& one) { (void)grow_tree(one, atlas()); }})
        EXPECT_TRUE(names(refusal([&] { grow(spec); }), "/leaf", "'elm' is not one of maple, oak"));
    spec.params.look.leaf = {"fern"};
    EXPECT_FALSE(tree_meshes(spec, atlas()).leaves.positions.empty());
}

TEST(GrownTree, StopsWhenCancelled) {
    std::stop_source source;
    source.request_stop();
    ExecutionContext execution;
    execution.stop = source.get_token();
    EXPECT_THROW((void)grow_tree(order_of("herb"), atlas(), {}, {}, execution), Cancelled);
}

TEST(GrownTree, InstancedLeavesAtAllLevelsAreGroups) {
    TreeSpec spec = order_of("herb");
    spec.params.instancing = LeafInstancing::gpu;
    spec.params.file.lods = Lods::msft;
    const Value json = json_chunk(joined(grow_tree(spec, atlas()).glb));
    std::vector<std::string> names;
    for (const Value& node : json.find("nodes")->items())
        names.emplace_back(node.find("name")->as_string());
    ASSERT_EQ(names.size(), 12u);
    EXPECT_EQ(names[1], names[0] + "_bark");
    EXPECT_EQ(names[2], names[0] + "_leaves");
    EXPECT_EQ(dump(*json.at_pointer("/nodes/0/children")), "[1,2]");
    EXPECT_EQ(dump(*json.at_pointer("/nodes/0/extensions/MSFT_lod/ids")), "[3,6,9]");
    EXPECT_EQ(dump(*json.at_pointer("/scenes/0/nodes")), "[0]");
    // Levels with all leaves have them at the same places, once in the file.
    const auto places = [&](const char* node) {
        return dump(*json.at_pointer("/nodes/" + std::string(node) +
                                     "/extensions/EXT_mesh_gpu_instancing/attributes"));
    };
    EXPECT_EQ(places("2"), places("5"));
}

TEST(GrownTree, ImpossibleParametersAreRefusedByNameBeforeAnyWork) {
    const auto refused = [](auto change) {
        TreeSpec spec = order_of("broadleaf");
        change(spec.params.look);
        return refusal([&] { (void)estimate(spec); });
    };
    EXPECT_TRUE(names(refused([](TreeLook& look) { look.shape.topology.order = 12; }), "/order",
                      "at most 40000"));
    EXPECT_TRUE(names(refused([](TreeLook& look) {
                          look.shape.topology.matrix = look.shape.topology.toward =
                              MatrixKind::random_binary;
                          look.leaves.per_tip = 40;
                      }),
                      "/leaves/per_tip", "40 make about 109240 leaves on 2731 twigs"));
    EXPECT_TRUE(names(refused([](TreeLook& look) {
                          look.shape.twig_length = 1.0;
                          look.shape.twig_radius = 0.0001;
                          look.shape.length_rise = 4.0;
                          look.shape.width_law = OrderLaw::constant;
                      }),
                      "/twig_radius", "so thin for their length"));
    TreeSpec spec = order_of("broadleaf");
    spec.params.instancing = LeafInstancing::gpu;
    spec.params.file.wind = WindFormat::attribute;
    EXPECT_TRUE(names(refusal([&] { (void)estimate(spec); }), "/instancing", "wind=none"));
    spec = order_of("broadleaf");
    spec.params.look.shape.topology.matrix = MatrixKind::own;
    spec.params.look.shape.topology.rows = {{0.5, 0.25}};
    const auto found = refusal([&] { (void)grow_tree(spec, atlas()); });
    EXPECT_TRUE(names(found, "/rows/0", "sum to 0.75"));
    EXPECT_TRUE(names(found, "/order", "7 needs 6 rows"));
}

}  // namespace
}  // namespace sporeprint::grow_tree_test
