#include "core/grow/world/plot_view.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "tests/support/plots.h"

namespace sporeprint::grow_plot_view_test {
namespace {

constexpr PlotView all_views[] = {PlotView::standing, PlotView::kneeling, PlotView::aslant,
                                  PlotView::top};

TEST(PlotView, LooksDownAtThePlotFromEverySide) {
    const PlotContent content = small_wood().content(0.0, 0.0, 10.0);
    for (const PlotView view : all_views)
        for (const double turn : {0.0, 90.0, -135.0}) {
            const StandingCamera camera = camera_of(content, view, turn);
            // The ground rises by an eighth at most.
            EXPECT_GT(camera.eye.y - camera.target.y,
                      -0.14 * glm::distance(camera.eye, camera.target))
                << name(view);
            EXPECT_LT(std::abs(camera.target.x), 5.0) << name(view);
            EXPECT_LT(std::abs(camera.target.z), 5.0) << name(view);
            // Who stands or kneels may step aside.
            const glm::dvec3 way = camera.eye - camera.target;
            const double angle = std::atan2(way.x, way.z) * 180.0 / 3.14159265358979;
            const bool may_move = view == PlotView::standing || view == PlotView::kneeling;
            EXPECT_NEAR(std::remainder(angle - turn, 360.0), 0.0, may_move ? 48.0 : 1e-6)
                << name(view);
        }
    EXPECT_EQ(name(static_cast<PlotView>(std::size(all_views))), nullptr);
}

TEST(PlotView, KneelsBeforeFruitBodies) {
    const SmallWood& wood = small_wood();
    const PlotContent content = wood.content();
    const StandingCamera camera = camera_of(content, PlotView::kneeling, 0.0);
    const bool is_body = std::ranges::any_of(wood.bodies, [&](const FruitBody& body) {
        return std::abs(metres(body.at.x) - camera.target.x) < 1e-9 &&
               std::abs(-metres(body.at.y) - camera.target.z) < 1e-9;
    });
    EXPECT_TRUE(is_body);
    EXPECT_LT(glm::distance(camera.eye, camera.target), 1.2);
    PlotContent without = content;
    without.bodies = {};
    EXPECT_GT(glm::distance(camera_of(without, PlotView::kneeling, 0.0).eye, camera.target), 1.2);
}

TEST(PlotView, StepsAsideWhereATrunkIsInTheWay) {
    SmallWood wood;
    wood.trees.resize(1);
    wood.dead.clear();
    wood.trees[0].at = world_point(0.0, -4.3);
    const PlotContent blocked = wood.content(0.0, 0.0, 10.0);
    const StandingCamera camera = camera_of(blocked, PlotView::standing, 0.0);
    EXPECT_GT(std::hypot(camera.eye.x, -camera.eye.z + 4.3), 0.6);
    EXPECT_NEAR(camera.eye.z, 4.8, 1e-6);
}

TEST(PlotView, StandsOnTheGround) {
    const SmallWood& wood =
        small_wood();  // its ground rises by 0.12 to the east, falls to the north
    PlotContent content = wood.content(0.0, 0.0, 10.0);
    content.trees = {};
    content.dead_wood = {};
    const StandingCamera east = camera_of(content, PlotView::standing, 90.0),
                         west = camera_of(content, PlotView::standing, -90.0);
    EXPECT_NEAR(east.eye.y - west.eye.y, 2.0 * 4.8 * 0.12, 0.01);
    EXPECT_NEAR(0.5 * (east.eye.y + west.eye.y), 1.65, 0.01);
}

}  // namespace
}  // namespace sporeprint::grow_plot_view_test
