#include "core/grow/world/plot_parts.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <set>

#include "core/math/direction.h"
#include "core/world/tree_growth.h"
#include "tests/support/atlas.h"
#include "tests/support/meshes.h"
#include "tests/support/plots.h"

namespace sporeprint::grow_plot_parts_test {
namespace {

/// The parts of a plot, and what they depend on.
struct Parts {
    PlotContent content;
    std::vector<TreeFoot> feet;
    FloorHeights floor;
    PlotFrame frame;
    CoverField cover;

    explicit Parts(const PlotContent& of)
        : content(of),
          feet(feet_of(of)),
          floor(*of.ground, of.seed, of.micro, feet),
          frame(of, floor),
          cover(cover_of(of, atlas())) {}

    /// Returns the height of a place of the file above the floor.
    [[nodiscard]] double above_floor(const glm::vec3& at) const {
        const double x = metres(content.centre.x) + static_cast<double>(at.x),
                     y = metres(content.centre.y) - static_cast<double>(at.z);
        return static_cast<double>(at.y) + frame.height() - floor.at(x, y);
    }
};

TEST(PlotTrees, StandOnTheFloorWithTheirHeights) {
    const Parts parts(small_wood().content(0.0, 0.0, 8.0));
    PlotOptions options;
    options.lod = 2;
    const PlotTrees made = trees_of(parts.content, options, parts.frame, 1'000'000, atlas(), {});
    ASSERT_EQ(made.trees.size(), 9U);
    for (const PlotTrees::Placed& tree : made.trees) {
        const auto record = std::find_if(parts.content.trees.begin(), parts.content.trees.end(),
                                         [&](const StandTree& one) { return one.id == tree.id; });
        ASSERT_NE(record, parts.content.trees.end());
        const PlotTrees::Shape& shape = made.shapes[tree.shape];
        EXPECT_EQ(shape.kind, record->kind);
        EXPECT_NEAR(tree.place.scale.y * shape.size.height, height_at(*record, parts.content.time),
                    1e-6);
        const double above = parts.above_floor(glm::vec3(tree.place.translation));
        EXPECT_LE(above, 1e-4) << "no foot hangs in the air";
        EXPECT_GT(above, -0.15);
    }
}

TEST(PlotTrees, HaveAtMostFourShapesOfAKindAndFewerTrianglesOnDemand) {
    SmallWood wood = small_wood();
    for (std::size_t i = 0; i < wood.trees.size(); ++i) {
        wood.trees[i].id = (i << 32U) + i;
        wood.trees[i].kind = 1;
    }
    const Parts parts(wood.content(0.0, 0.0, 8.0));
    const auto count = [&](std::uint64_t most) {
        PlotOptions options;
        const PlotTrees made = trees_of(parts.content, options, parts.frame, most, atlas(), {});
        EXPECT_EQ(made.shapes.size(), 4U);
        std::uint64_t triangles = 0;
        for (const PlotTrees::Placed& tree : made.trees)
            triangles += made.shapes[tree.shape].meshes->triangles();
        return triangles;
    };
    const std::uint64_t all = count(10'000'000);
    EXPECT_LT(count(all / 2), all);
}

TEST(PlotTrees, HaveOneSizeInAllColours) {
    PlotContent content = small_wood().content();
    for (std::size_t kind = 0; kind < content.kinds.size(); ++kind) {
        content.time = time_of(SmallWood::year, 200);
        const TreeSize green = tree_size(tree_spec(content, kind, 1, 2, atlas()), atlas(), {});
        for (const int day : {120, 200, 290}) {
            content.time = time_of(SmallWood::year, day);
            const PlotTrees::Shape shape = tree_shape(content, kind, 1, 2, atlas(), {});
            EXPECT_EQ(shape.size.height, green.height) << day;
            EXPECT_EQ(shape.size.radius, green.radius) << day;
            EXPECT_EQ(tree_size(shape.spec, atlas(), {}).height, green.height) << day;
        }
    }
}

TEST(PlotTrees, WithNeedlesCarrySnowAndHaveTheSameSize) {
    PlotContent content = small_wood().content();
    content.kinds = {"spruce", "beech"};
    content.time = time_of(SmallWood::year, 20);
    const TreeSpec bare = tree_spec(content, 0, 1, 2, atlas());
    EXPECT_EQ(bare.params.snow, 0.0);
    const TreeSize size = tree_size(bare, atlas(), {});
    double before = 0.0;
    for (const double cover : {0.1, 0.4, 0.7, 1.0}) {
        content.snow = cover;
        const TreeSpec snowy = tree_spec(content, 0, 1, 2, atlas());
        EXPECT_GE(snowy.params.snow, before);
        EXPECT_NEAR(snowy.params.snow, 0.6 * cover, 0.0751);
        before = snowy.params.snow;
        EXPECT_EQ(tree_size(snowy, atlas(), {}).height, size.height);
        EXPECT_EQ(tree_spec(content, 1, 1, 2, atlas()).params.snow, 0.0) << "It has no leaves.";
    }
    EXPECT_EQ(before, 0.6);
}

TEST(PlotTrees, HaveLeavesBeyondADistanceFromAnEye) {
    const PlotContent content = small_wood().content();
    TreeSpec spec = tree_spec(content, 0, 1, 2, atlas());
    spec.params.look.leaves.per_tip = 3;
    const TreeMeshes meshes = tree_meshes(spec, atlas());
    const Mesh& all = meshes.leaves;
    ASSERT_GT(all.triangles(), 100U);
    const GlbTransform place{{3.0, -1.0, 2.0}, {0.0, 0.6, 0.0, 0.8}, glm::dvec3(1.2, 0.8, 1.2)};
    const auto at = [&](const Mesh& mesh, std::size_t triangle) {
        glm::dvec3 sum(0.0);
        for (std::size_t k = 0; k < 3; ++k)
            sum += glm::dvec3(mesh.positions[mesh.indices[3 * triangle + k]]) / 3.0;
        return place.translation + rotated(place.rotation, place.scale * sum);
    };
    const glm::dvec3 eye = at(all, all.triangles() / 2);
    std::size_t last = all.triangles() + 1;
    for (const double within : {0.0, 0.5, 1.0, 100.0}) {
        const Mesh left = leaves_beyond(all, place, eye, within);
        EXPECT_LT(left.triangles(), last);
        last = left.triangles();
        std::size_t beyond = 0;
        for (std::size_t i = 0; i < all.triangles(); ++i)
            beyond += glm::distance(at(all, i), eye) >= within ? 1 : 0;
        EXPECT_EQ(left.triangles(), beyond);
        for (std::size_t i = 0; i < left.triangles(); ++i)
            EXPECT_GE(glm::distance(at(left, i), eye), within);
    }
    EXPECT_EQ(leaves_beyond(all, place, eye, 0.0).indices, all.indices);
    EXPECT_EQ(last, 0U);
}

TEST(PlotLogs, LieOnTheGround) {
    const Parts parts(small_wood().content());
    const std::vector<PlotLog> logs = logs_of(parts.content, parts.frame, parts.cover, atlas());
    ASSERT_EQ(logs.size(), 2U);
    for (const PlotLog& log : logs) {
        expect_valid(log.mesh);
        double lowest = 1e9;
        for (const glm::vec3& at : log.mesh.positions) {
            lowest = std::min(lowest, parts.above_floor(at));
            if (!log.lies) continue;
            EXPECT_LE(std::abs(at.x), 2.001F) << "logs are cut where they leave the plot";
            EXPECT_LE(std::abs(at.z), 2.001F);
        }
        EXPECT_LE(lowest, 0.02);
    }
    EXPECT_TRUE(logs[0].lies);
    EXPECT_FALSE(logs[1].lies);
}

TEST(PlotLogs, LieOnTheGroundAllAlong) {
    const Parts parts(small_wood().content(0.0, 0.0, 10.0));
    const std::vector<PlotLog> logs = logs_of(parts.content, parts.frame, parts.cover, atlas());
    // The lowest vertex of each stretch of half a metre.
    std::map<int, double> lowest;
    for (const glm::vec3& at : logs[0].mesh.positions) {
        const int stretch = static_cast<int>(std::floor(2.0F * at.x));
        const auto [found, is_new] = lowest.try_emplace(stretch, 1e9);
        found->second = std::min(found->second, parts.above_floor(at));
    }
    ASSERT_GT(lowest.size(), 15U);
    // Its ends have splinters alone.
    lowest.erase(lowest.begin());
    lowest.erase(std::prev(lowest.end()));
    for (const auto& [stretch, height] : lowest) EXPECT_LE(height, 0.06) << stretch;
}

TEST(PlotLogs, ThatLieCarrySnow) {
    PlotContent content = small_wood().content();
    const Parts summer(content);
    for (const PlotLog& log : logs_of(summer.content, summer.frame, summer.cover, atlas()))
        EXPECT_TRUE(log.snow.positions.empty());
    content.snow = 1.0;
    content.snow_depth = 0.08;
    const Parts winter(content);
    for (const PlotLog& log : logs_of(winter.content, winter.frame, winter.cover, atlas())) {
        EXPECT_EQ(log.snow.positions.empty(), !log.lies);
        if (!log.lies) continue;
        expect_valid(log.snow);
        EXPECT_GT(bounds(log.snow).max.y, bounds(log.mesh).max.y);
    }
}

TEST(PlotLogs, AreGoneBeforeAndAfterTheirTime) {
    PlotContent content = small_wood().content();
    content.time = time_of(95);
    const Parts later(content);
    EXPECT_TRUE(logs_of(later.content, later.frame, later.cover, atlas()).empty());
    content.time = time_of(39);
    const Parts before(content);
    EXPECT_TRUE(logs_of(before.content, before.frame, before.cover, atlas()).empty());
}

TEST(PlotLeaves, LieOnTheFloorInTheRequestedNumber) {
    const Parts parts(small_wood().content());
    const double per_m2 = 40.0;
    const std::vector<PlotLeaves> leaves =
        leaves_of(parts.content, parts.frame, parts.cover, per_m2, atlas());
    ASSERT_FALSE(leaves.empty());
    std::size_t count = 0;
    for (const PlotLeaves& own : leaves) {
        count += own.places.size();
        const Mesh all = own.merged();
        expect_valid(all);
        for (const glm::vec3& at : all.positions) {
            EXPECT_LT(parts.above_floor(at), 0.12);
            EXPECT_GT(parts.above_floor(at), -0.08);
        }
    }
    const double covered = parts.cover.at(0.0, 0.0).all_leaves();
    EXPECT_NEAR(static_cast<double>(count), per_m2 * 16.0 * covered,
                0.35 * per_m2 * 16.0 * covered);
    EXPECT_TRUE(leaves_of(parts.content, parts.frame, parts.cover, 0.0, atlas()).empty());
}

TEST(WoodOf, IsThatOfTheTree) {
    EXPECT_EQ(wood_of(*atlas().find_tree("birch")), Substrate::birch);
    EXPECT_EQ(wood_of(*atlas().find_tree("spruce")), Substrate::spruce);
    EXPECT_EQ(wood_of(*atlas().find_tree("broadleaf")), Substrate::oak);
    EXPECT_EQ(wood_of(*atlas().find_tree("beech")), Substrate::beech);
}

}  // namespace
}  // namespace sporeprint::grow_plot_parts_test
