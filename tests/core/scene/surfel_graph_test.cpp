#include "core/scene/surfel_graph.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <limits>
#include <vector>

#include "core/scene/surfel_search.h"
#include "tests/support/scenes.h"

namespace sporeprint::surfel_graph_test {
namespace {

struct Net {
    Scene scene;
    Surfels surfels;
    TriangleTree tree;
    SurfelGraph graph;

    explicit Net(const scenes::Made& made, std::size_t most = most_surfels)
        : scene(made.scene),
          surfels(surfels_of(scene, 1, most)),
          tree(scene),
          graph(graph_of(surfels, tree)) {}

    [[nodiscard]] std::uint32_t at(const glm::dvec3& place, const glm::dvec3& normal) const {
        return surfels.nearest(place, normal, 0.2).value();
    }
    /// Returns the length of the shortest way, infinity if there is none.
    [[nodiscard]] double way(std::uint32_t from, std::uint32_t to) const {
        SurfelSearch search(graph, surfels.size());
        const SearchStart start{from, 0.0, 1e3};
        double found = std::numeric_limits<double>::infinity();
        search.run(
            std::span(&start, 1), 1e3, [](std::uint32_t) { return true; },
            [&](const SearchFind& find) {
                if (find.surfel == to) found = find.cost;
                return find.surfel != to;
            });
        return found;
    }
};

constexpr glm::dvec3 up(0.0, 1.0, 0.0), east(1.0, 0.0, 0.0);

TEST(SurfelGraph, JoinsAllOfLevelGroundByWaysThatAreLittleTooLong) {
    const Net net(scenes::Made().floor(-1, -1, 1, 1, 0, "soil"));
    const std::uint32_t from = net.at({-0.9, 0.0, -0.9}, up), to = net.at({0.9, 0.0, 0.9}, up);
    const double straight =
        glm::length(glm::dvec3(net.surfels[from].at) - glm::dvec3(net.surfels[to].at));
    EXPECT_GE(net.way(from, to), straight);
    EXPECT_LE(net.way(from, to), 1.12 * straight);
}

TEST(SurfelGraph, IsMutual) {
    const Net net(scenes::Made()
                      .floor(-0.5F, -0.5F, 0.5F, 0.5F, 0, "soil")
                      .box({-0.1F, -0.1F, -0.1F}, {0.1F, 0.3F, 0.1F}, "log"));
    for (std::uint32_t i = 0; i < net.surfels.size(); ++i)
        for (const SurfelGraph::Way& way : net.graph.ways(i)) {
            ASSERT_NE(way.to, i);
            bool is_back = false;
            for (const SurfelGraph::Way& back : net.graph.ways(way.to))
                is_back = is_back || (back.to == i && back.length == way.length);
            EXPECT_TRUE(is_back);
            EXPECT_LE(static_cast<double>(way.length),
                      neighbour_spacings * net.surfels.spacing() + 1e-6);
        }
}

TEST(SurfelGraph, LeadsOverEdgesAndUpFromTheGround) {
    const Net net(scenes::Made()
                      .floor(-1, -1, 1, 1, 0, "soil")
                      .box({-0.2F, -0.1F, -0.2F}, {0.2F, 0.4F, 0.2F}, "log"));
    const std::uint32_t ground = net.at({0.6, 0.0, 0.0}, up), side = net.at({0.2, 0.2, 0.0}, east),
                        top = net.at({0.0, 0.4, 0.0}, up);
    EXPECT_NEAR(net.way(ground, side), 0.4 + 0.2, 0.1);
    EXPECT_NEAR(net.way(ground, top), 0.4 + 0.4 + 0.2, 0.15);
}

TEST(SurfelGraph, DoesNotLeadOverAGapOrThroughAPlank) {
    // The gap is as wide as a way may be.
    const float gap = static_cast<float>(0.8 * finest_spacing);
    const Net halves(scenes::Made()
                         .floor(-0.5F, -0.5F, 0, 0.5F, 0, "soil")
                         .floor(gap, -0.5F, 0.5F, 0.5F, 0, "soil"));
    EXPECT_TRUE(
        std::isinf(halves.way(halves.at({-0.3, 0.0, 0.0}, up), halves.at({0.3, 0.0, 0.0}, up))));
    // A sheet without edges in 1 cm above another one.
    const Net sheets(scenes::Made()
                         .floor(-0.5F, -0.5F, 0.5F, 0.5F, 0, "soil")
                         .floor(-0.5F, -0.5F, 0.5F, 0.5F, 0.01F, "wood"));
    for (std::uint32_t i = 0; i < sheets.surfels.size(); ++i)
        for (const SurfelGraph::Way& way : sheets.graph.ways(i))
            EXPECT_EQ(sheets.surfels[i].material, sheets.surfels[way.to].material);
    // A wall on the ground that has no ends: its sides are joined by nothing.
    const Net wall(scenes::Made()
                       .floor(-0.5F, -0.5F, 0.5F, 0.5F, 0, "soil")
                       .box({-0.02F, -0.1F, -0.6F}, {0.02F, 0.2F, 0.6F}, "rock"));
    for (std::uint32_t i = 0; i < wall.surfels.size(); ++i)
        for (const SurfelGraph::Way& way : wall.graph.ways(i)) {
            const Surfel &a = wall.surfels[i], &b = wall.surfels[way.to];
            const bool are_beside = std::abs(a.at.x) > 0.02F && std::abs(b.at.x) > 0.02F;
            if (a.at.y == 0.0F && b.at.y == 0.0F && are_beside) {
                EXPECT_EQ(a.at.x > 0.0F, b.at.x > 0.0F);
            }
        }
}

TEST(SurfelGraph, IsTheSameWithSeveralThreads) {
    const Net net(scenes::Made()
                      .floor(-1, -1, 1, 1, 0, "soil")
                      .box({-0.2F, -0.1F, -0.2F}, {0.2F, 0.4F, 0.2F}, "log"));
    EXPECT_TRUE(net.graph == graph_of(net.surfels, net.tree, scenes::by_threads));
}

TEST(SurfelGraph, OfNothingHasNoWays) {
    const TriangleTree tree{Scene{}};
    EXPECT_EQ(graph_of({}, tree), SurfelGraph());
}

}  // namespace
}  // namespace sporeprint::surfel_graph_test
