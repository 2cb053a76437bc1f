#include "core/grow/leaf.h"

#include <gtest/gtest.h>

#include <array>
#include <glm/geometric.hpp>
#include <stop_token>
#include <string>
#include <vector>

#include "core/mesh/measure.h"
#include "tests/support/glb_reader.h"
#include "tests/support/keeper.h"
#include "tests/support/meshes.h"
#include "tests/support/orders.h"
#include "tests/support/refusals.h"

namespace sporeprint::grow_leaf_test {
namespace {

LeafSpec order_of(const std::string& preset, int lod = 0, int side = 128) {
    LeafSpec spec{preset, params_of(*leaf_preset(preset))};
    spec.params.lod = lod;
    spec.params.texture_size.value = side;
    return spec;
}

class EveryLeaf : public ::testing::TestWithParam<std::string> {};

std::vector<std::string> ids() {
    std::vector<std::string> found;
    for (const LeafPreset& preset : leaf_presets()) found.push_back(preset.id.string());
    return found;
}

INSTANTIATE_TEST_SUITE_P(Presets, EveryLeaf, ::testing::ValuesIn(ids()),
                         [](const auto& one) { return one.param; });

TEST_P(EveryLeaf, ReadsBackFromItsFile) {
    for (int lod = 0; lod < leaf_lods; ++lod) {
        const Grown leaf = grow_leaf(order_of(GetParam(), lod), atlas());
        const ReadBack found = expect_glb(joined(leaf.glb));
        expect_valid(found.mesh);
        EXPECT_EQ(found.mesh.positions.size(), leaf.vertices);
        EXPECT_EQ(found.mesh.triangles(), leaf.triangles);
        const int side = 128 >> lod;
        EXPECT_EQ(found.images, (std::vector<std::array<int, 2>>(3, {side, side})));
        EXPECT_TRUE(found.node.starts_with(GetParam() + "_leaf_s1_")) << found.node;
        EXPECT_TRUE(found.node.ends_with("_LOD" + std::to_string(lod))) << found.node;
        EXPECT_EQ(found.attributes,
                  (std::vector<std::string>{"NORMAL", "POSITION", "TANGENT", "TEXCOORD_0"}));
    }
}

TEST_P(EveryLeaf, HasFewerTrianglesAtEveryLevelAndOneOutline) {
    double finest = 0.0, before = 1e9;
    for (int lod = 0; lod < leaf_lods; ++lod) {
        const Mesh mesh = leaf_mesh(order_of(GetParam(), lod));
        if (lod < 3)
            EXPECT_LT(static_cast<double>(mesh.triangles()), before) << lod;
        else
            EXPECT_LE(static_cast<double>(mesh.triangles()), before) << "a needle is few already";
        before = static_cast<double>(mesh.triangles());
        // The same individual: its bounding box stays, except for points that few triangles cannot
        // follow. The fan of a frond is as small as its area.
        const Bounds box = bounds(mesh);
        const double length = static_cast<double>(box.max.z - box.min.z);
        if (lod == 0) finest = length;
        EXPECT_NEAR(length / finest, 1.0, lod < 3 ? 0.05 : 0.3) << lod;
    }
    const int leaflets = atlas().find_leaf(GetParam())->shape.leaflets.count;
    EXPECT_LE(before, leaflets > 0 ? 4.0 * leaflets + 30.0 : 28.0)
        << "16 of the limb, 12 of the petiole; or 4 of each leaflet, 30 of the axis";
}

TEST_P(EveryLeaf, IsEstimatedBeforeAnyWork) {
    for (int lod = 0; lod < leaf_lods; ++lod) {
        const LeafSpec spec = order_of(GetParam(), lod, 256);
        const Estimate e = estimate(spec);
        const Grown leaf = grow_leaf(spec, atlas());
        EXPECT_GE(e.vertices, leaf.vertices);
        EXPECT_GE(e.triangles, leaf.triangles);
        EXPECT_EQ(e.texels, 3u * (256u >> lod) * (256u >> lod));
        const auto bytes = static_cast<double>(size_of(leaf.glb));
        EXPECT_GT(static_cast<double>(e.bytes), 0.7 * bytes);
        EXPECT_LT(static_cast<double>(e.bytes), 5.0 * bytes);
    }
}

TEST_P(EveryLeaf, GivesEqualBytesTwiceAndWithManyThreads) {
    const LeafSpec spec = order_of(GetParam(), 0, 128);
    ExecutionContext threads;
    threads.parallel = in_threads;
    const Bytes once = joined(grow_leaf(spec, atlas()).glb);
    EXPECT_EQ(joined(grow_leaf(spec, atlas(), {}, threads).glb), once);
    EXPECT_EQ(joined(grow_leaf(spec, atlas()).glb), once);
}

TEST(GrownLeaf, SizeScalesTheMesh) {
    LeafSpec spec = order_of("ivy");
    const Mesh one = leaf_mesh(spec);
    spec.params.size = 2.0;
    const Mesh twice = leaf_mesh(spec);
    ASSERT_EQ(one.positions.size(), twice.positions.size());
    for (std::size_t i = 0; i < one.positions.size(); ++i) {
        ASSERT_LT(glm::distance(2.0F * one.positions[i], twice.positions[i]), 1e-7F);
        ASSERT_EQ(one.normals[i], twice.normals[i]);
    }
}

TEST(GrownLeaf, SeedsAreIndividuals) {
    LeafSpec spec = order_of("maple", 2);
    const Bytes one = joined(grow_leaf(spec, atlas()).glb);
    spec.params.seed = 2;
    EXPECT_NE(joined(grow_leaf(spec, atlas()).glb), one);
}

TEST(GrownLeaf, AChangeOfShapeReusesTheImages) {
    Keeper keeper;
    LeafSpec spec = order_of("maple", 1);
    const Grown flat = grow_leaf(spec, atlas(), {}, keeper.execution);
    spec.params.shape.curl_deg = 120.0;
    spec.params.shape.petiole = 1.5;
    spec.params.size = 0.5;
    const Grown curled = grow_leaf(spec, atlas(), {}, keeper.execution);
    EXPECT_EQ(keeper.lookups, 2);
    EXPECT_EQ(keeper.made, 1);
    for (const Slice& file : keeper.cached.begin()->second->files) {
        EXPECT_TRUE(shares_bytes(flat.glb, file));
        EXPECT_TRUE(shares_bytes(curled.glb, file));
    }
    EXPECT_EQ(joined(grow_leaf(spec, atlas()).glb), joined(curled.glb));
    spec.params.autumn = 0.5;
    (void)grow_leaf(spec, atlas(), {}, keeper.execution);
    EXPECT_EQ(keeper.made, 2);
    spec.params.snow = 0.5;
    (void)grow_leaf(spec, atlas(), {}, keeper.execution);
    EXPECT_EQ(keeper.made, 3);
}

TEST(GrownLeaf, LinksImagesOrLeavesThemOut) {
    LeafSpec spec = order_of("oak", 2);
    spec.params.textures = Textures::linked;
    EXPECT_TRUE(names(refusal([&] { (void)grow_leaf(spec, atlas()); }), "/textures", "linked"));
    const Extras extras{"/v1/x", {{"/a.jpg", "/b.jpg", "/c.jpg"}, {}}};
    const ReadBack found = expect_glb(joined(grow_leaf(spec, atlas(), extras).glb));
    EXPECT_EQ(found.uris, (std::vector<std::string>{"/a.jpg", "/b.jpg", "/c.jpg"}));
    spec.params.textures = Textures::none;
    const ReadBack bare = expect_glb(joined(grow_leaf(spec, atlas()).glb));
    EXPECT_EQ(bare.attributes, (std::vector<std::string>{"NORMAL", "POSITION"}));
    EXPECT_EQ(bare.textures, 0u);
}

TEST(GrownLeaf, DescribesItselfInExtras) {
    LeafSpec spec = order_of("birch", 1);
    spec.params.shape.venation.nodes = 11;
    const Value json = json_chunk(joined(grow_leaf(spec, atlas(), {"/v1/canonical", {}}).glb));
    EXPECT_EQ(json.at_pointer("/asset/extras/canonical")->as_string(), "/v1/canonical");
    EXPECT_EQ(json.at_pointer("/asset/extras/effective/venation/nodes")->as_number(), 11.0);
    EXPECT_EQ(json.at_pointer("/asset/extras/triangles")->as_number(),
              static_cast<double>(leaf_mesh(spec).triangles()));
    EXPECT_EQ(json.at_pointer("/meshes/0/primitives")->items().size(), 1u);
    EXPECT_EQ(json.at_pointer("/materials")->items().size(), 1u);
    EXPECT_EQ(json.at_pointer("/extensionsUsed"), nullptr);
}

TEST(GrownLeaf, StopsWhenCancelled) {
    std::stop_source source;
    source.request_stop();
    ExecutionContext execution;
    execution.stop = source.get_token();
    EXPECT_THROW((void)grow_leaf(order_of("fern"), atlas(), {}, execution), Cancelled);
}

TEST(GrownLeaf, StepsAreReportedInOrder) {
    std::vector<std::string> steps;
    ExecutionContext execution;
    execution.observer = [&](Step step) { steps.emplace_back(name(step)); };
    (void)grow_leaf(order_of("needle", 3), atlas(), {}, execution);
    EXPECT_EQ(steps, (std::vector<std::string>{"build", "paint", "pack"}));
}

TEST(GrownLeaf, ImpossibleParametersAreRefusedByName) {
    LeafSpec spec = order_of("maple");
    spec.params.shape.venation.lobes.value = 13;
    EXPECT_TRUE(
        names(refusal([&] { (void)grow_leaf(spec, atlas()); }), "/venation/vein_deg", "petiole"));
    spec = order_of("maple");
    spec.params.shape.length = 2.0;
    EXPECT_TRUE(names(refusal([&] { (void)grow_leaf(spec, atlas()); }), "/length", "outside"));
}

}  // namespace
}  // namespace sporeprint::grow_leaf_test
