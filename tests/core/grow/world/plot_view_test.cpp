#include "core/grow/world/plot_view.h"

#include <gtest/gtest.h>

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
            const double angle = std::atan2(camera.eye.x, camera.eye.z) * 180.0 / 3.14159265358979;
            EXPECT_NEAR(angle, turn, 1e-6) << name(view);
        }
    EXPECT_EQ(name(static_cast<PlotView>(std::size(all_views))), nullptr);
}

TEST(PlotView, StandsOnTheGround) {
    const SmallWood& wood =
        small_wood();  // its ground rises by 0.12 to the east, falls to the north
    const PlotContent content = wood.content(0.0, 0.0, 10.0);
    const StandingCamera east = camera_of(content, PlotView::standing, 90.0),
                         west = camera_of(content, PlotView::standing, -90.0);
    EXPECT_NEAR(east.eye.y - west.eye.y, 2.0 * 4.8 * 0.12, 0.01);
    EXPECT_NEAR(0.5 * (east.eye.y + west.eye.y), 1.65, 0.01);
}

}  // namespace
}  // namespace sporeprint::grow_plot_view_test
