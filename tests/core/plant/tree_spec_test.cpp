#include "core/plant/tree_spec.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "core/params/canonical.h"
#include "core/params/query.h"
#include "tests/support/atlas.h"
#include "tests/support/refusals.h"

namespace sporeprint::plant_tree_spec_test {
namespace {

TEST(TreeSpec, APresetHasItsOwnParametersByDefault) {
    for (const TreePreset& preset : tree_presets()) {
        const TreeParams params = params_of(preset);
        EXPECT_EQ(params.look.shape, preset.shape) << preset.id.string();
        EXPECT_EQ(params.look.leaves, preset.leaves) << preset.id.string();
        EXPECT_EQ(params.look.bark, preset.bark) << preset.id.string();
        EXPECT_EQ(params.look.leaf, preset.leaf);
        EXPECT_EQ(problems_in(params), std::vector<Problem>{}) << preset.id.string();
        EXPECT_EQ(query_text(params, params_of(preset)), "") << preset.id.string();
        TreeParams same = params;
        without_unused_rows(same);
        EXPECT_EQ(same, params) << preset.id.string() << " keeps only rows that it uses";
    }
}

TEST(TreeSpec, AnUnknownLeafIsReportedWithTheLeavesOfTheAtlas) {
    TreeParams params = params_of(*tree_preset("birch"));
    params.look.leaf.id = "elm";
    EXPECT_TRUE(
        names(problems_in(params), "/leaf", "'elm' is not one of maple, oak, beech, birch"));
    std::vector<Problem> problems;
    const std::pair<std::string, std::string> pair{"leaf", "elm"};
    params = params_of(*tree_preset("birch"));
    read_query({&pair, 1}, params, problems);
    EXPECT_TRUE(names(problems, "leaf", "'elm' is not one of maple, oak"));
    EXPECT_EQ(params.look.leaf.id.view(), "birch");
}

TEST(TreeSpec, ImagesDoNotDependOnParametersOfTheShape) {
    const TreeParams params = params_of(*tree_preset("birch"));
    TreeParams other = params;
    other.seed = 9;
    other.size = 2.0;
    other.look.shape.fork_deg = 50.0;
    other.look.leaves.per_tip = 1;
    other.look.leaf.id = "maple";
    other.spring = 1.0;
    other.autumn = 0.5;
    other.snow = 0.5;
    EXPECT_EQ(paint_of(other), paint_of(params));
    EXPECT_NE(paint_of(leaf_of(other, *leaf_preset("maple"))),
              paint_of(leaf_of(params, *leaf_preset("birch"))));
    other.lod = 2;
    EXPECT_EQ(paint_of(other).texture_size.value, 256);
    other.lod = 0;
    other.look.bark.furrows = 0.9;
    EXPECT_NE(paint_of(other), paint_of(params));
}

// All leaves of a tree show one image: a hole or a mark would be in each of them.
TEST(TreeSpec, UsesTheImagesOfItsLeafAloneUnmarked) {
    TreeParams params = params_of(*tree_preset("broadleaf"));
    params.seed = 77;
    params.spring = 0.5;
    params.autumn = 0.4;
    params.snow = 0.3;
    params.texture_size.value = 256;
    params.lod = 1;
    LeafParams alone = params_of(*leaf_preset("oak"));
    alone.spring = 0.5;
    alone.autumn = 0.4;
    alone.snow = 0.3;
    alone.texture_size.value = 256;
    alone.lod = 1;
    alone.shape.eaten = alone.palette.marks = 0.0;
    EXPECT_EQ(paint_of(leaf_of(params, *leaf_preset("oak"))), paint_of(alone));
}

TEST(TreeSpec, RowsAreUsedIfAMatrixIsOwn) {
    TreeParams params = params_of(*tree_preset("broadleaf"));
    params.look.shape.topology.rows = {{0.5, 0.5}};
    EXPECT_EQ(problems_in(params), std::vector<Problem>{}) << "there, but not asked for";
    without_unused_rows(params);
    EXPECT_TRUE(params.look.shape.topology.rows.empty());

    TreeTopology& topology = params.look.shape.topology;
    topology.matrix = MatrixKind::own;
    EXPECT_TRUE(names(problems_in(params), "/rows", "no rows are given"));
    topology.rows = {{0.5, 0.5}};
    EXPECT_TRUE(names(problems_in(params), "/order", "7 needs 6 rows"));
    topology.order = 2;
    EXPECT_EQ(problems_in(params), std::vector<Problem>{});
    topology.tips = MatrixKind::own;
    topology.tip_order = 4;
    EXPECT_TRUE(names(problems_in(params), "/tip_order", "4 needs 3 rows"));
    topology.tip_order = 2;
    EXPECT_EQ(problems_in(params), std::vector<Problem>{});
    topology.tip_order = 1;
    topology.blend = 0.5;
    topology.toward = MatrixKind::perfect;
    EXPECT_EQ(matrix_of(topology).rows, (std::vector<std::vector<double>>{{0.25, 0.75}}))
        << "half way from one's own to only forks";
}

TEST(TreeSpec, EveryErrorOfAMatrixIsNamedByItsRow) {
    TreeParams params = params_of(*tree_preset("broadleaf"));
    TreeTopology& topology = params.look.shape.topology;
    topology.matrix = MatrixKind::own;
    topology.order = 4;
    topology.rows = {{0.5, 0.4}, {0.5, 0.5, 0.0}, {0.5, 0.5}};
    const std::vector<Problem> found = problems_in(params);
    EXPECT_TRUE(names(found, "/rows/0", "sum to 0.9"));
    EXPECT_TRUE(names(found, "/rows/1/2", "would hardly ever end"));
    EXPECT_TRUE(names(found, "/rows/2", "the row of order 4 has 4"));
    topology.rows = {{1.25, -0.25}};
    EXPECT_TRUE(names(problems_in(params), "/rows/0/1", "-0.25 is outside 0..1"));
}

TEST(TreeSpec, OrdersAreExpectedAsTheyGrow) {
    for (const TreePreset& preset : tree_presets()) {
        SCOPED_TRACE(preset.id.string());
        const std::vector<ExpectedOrder> expected = expected_orders(preset.shape);
        double all = 0.0, grown = 0.0, tips = 0.0;
        constexpr std::uint32_t seeds = 8;
        for (std::uint32_t seed = 1; seed <= seeds; ++seed)
            for (const Ramification::Node& node :
                 grown_tree(preset.shape, seed).ramification.nodes) {
                grown += 1.0 / seeds;
                tips += (node.order == 1 ? 1.0 : 0.0) / seeds;
            }
        for (const ExpectedOrder& order : expected) {
            EXPECT_GT(order.length, 0.0);
            EXPECT_GT(order.radius, 0.0);
            all += order.edges;
        }
        // Exact numbers are of whole branches: a few of a high order may be a third too low.
        EXPECT_NEAR(all / grown, 1.0, 0.35);
        EXPECT_NEAR(expected.front().edges / tips, 1.0, 0.35);
    }
}

}  // namespace
}  // namespace sporeprint::plant_tree_spec_test
