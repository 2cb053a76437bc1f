#include "core/scene/run_off.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <numeric>
#include <vector>

#include "tests/support/scenes.h"

namespace sporeprint::run_off_test {
namespace {

struct Wet {
    std::shared_ptr<const SceneShape> shape;
    SurfelSubstrates substrates;
    RunOff run_off;

    /// Rain falls straight down on all that faces up.
    explicit Wet(const scenes::Made& made)
        : shape(std::make_shared<const SceneShape>(shape_of_scene(made.shared()))) {
        const SceneConditions conditions = scenes::conditions_for(made.scene);
        substrates = substrates_of(shape->surfels, shape->graph, conditions.soils);
        const std::vector<float> rain =
            rain_on(shape->surfels, shape->tree, wind_rose({.wind_speed = 0}), 1);
        run_off = run_off_of(shape->surfels, shape->graph, shape->tree, substrates, rain);
    }
    /// Returns the mean of the water on surfels of a box that face up.
    [[nodiscard]] double in(const glm::dvec3& low, const glm::dvec3& high) const {
        double sum = 0.0, area = 0.0;
        for (std::size_t i = 0; i < shape->surfels.size(); ++i) {
            const Surfel& one = shape->surfels[i];
            const glm::dvec3 at(one.at);
            if (at.x < low.x || at.y < low.y || at.z < low.z || at.x > high.x || at.y > high.y ||
                at.z > high.z || one.normal.y < 0.3F)
                continue;
            sum += static_cast<double>(run_off.water[i]) * static_cast<double>(one.area);
            area += static_cast<double>(one.area);
        }
        return area > 0.0 ? sum / area : -1.0;
    }
};

TEST(RunOff, LeavesTheRainOnLevelGround) {
    const Wet wet(scenes::Made().floor(-1, -1, 1, 1, 0, "soil"));
    for (const float water : wet.run_off.water) EXPECT_NEAR(water, 1.0F, 1e-5F);
}

TEST(RunOff, MakesTheFootOfASlopeWetterThanItsTop) {
    const Wet wet(scenes::Made().quad({-1, 0, 1}, {1, 0, 1}, {1, 1, -1}, {-1, 1, -1}, "rock"));
    const double top = wet.in({-1, 0.9, -1}, {1, 1, -0.8}),
                 foot = wet.in({-1, 0, 0.5}, {1, 0.2, 1});
    EXPECT_LT(top, 0.5);
    EXPECT_GT(foot, 1.05 * top);
}

TEST(RunOff, DripsFromTheEavesOfARoof) {
    const Wet wet(scenes::Made()
                      .floor(-2, -2, 2, 2, 0, "soil")
                      .quad({-0.5F, 1, 0.5F}, {0.5F, 1, 0.5F}, {0.5F, 1.5F, -0.5F},
                            {-0.5F, 1.5F, -0.5F}, "metal"));
    EXPECT_NEAR(wet.in({-0.4, -1, -0.4}, {0.4, 0.1, 0.4}), 0.0, 0.1) << "below the roof";
    EXPECT_GT(wet.in({-0.4, -1, 0.48}, {0.4, 0.1, 0.6}), 1.5) << "below its eaves";
    EXPECT_NEAR(wet.in({-2, -1, 1}, {2, 0.1, 2}), 1.0, 1e-5);
}

TEST(RunOff, DoesNotDependOnHowFineTheSurfelsAre) {
    const scenes::Made slope =
        scenes::Made().quad({-1, 0, 1}, {1, 0, 1}, {1, 1, -1}, {-1, 1, -1}, "oak wood");
    const Wet fine(slope);
    const Surfels coarse = surfels_of(slope.scene, 1, 1500);
    const TriangleTree tree(slope.scene);
    const SurfelGraph graph = graph_of(coarse, tree);
    const SurfelSubstrates substrates =
        substrates_of(coarse, graph, scenes::conditions_for(slope.scene).soils);
    const RunOff run_off = run_off_of(coarse, graph, tree, substrates,
                                      rain_on(coarse, tree, wind_rose({.wind_speed = 0}), 1));
    double foot = 0.0, area = 0.0;
    for (std::size_t i = 0; i < coarse.size(); ++i) {
        if (coarse[i].at.z < 0.0F || coarse[i].at.z > 0.8F) continue;
        foot += static_cast<double>(run_off.water[i]) * static_cast<double>(coarse[i].area);
        area += static_cast<double>(coarse[i].area);
    }
    EXPECT_NEAR(foot / area, fine.in({-1, 0.1, 0.0}, {1, 0.5, 0.8}), 0.06);
}

TEST(RunOff, LosesNothingButWhatLeavesTheScene) {
    const Wet wet(scenes::Made()
                      .quad({-1, 0, 1}, {1, 0, 1}, {1, 1, -1}, {-1, 1, -1}, "soil")
                      .box({-0.2F, 0, -0.2F}, {0.2F, 1.2F, 0.2F}, "log"));
    std::vector<double> amounts(wet.shape->surfels.size(), 1.0);
    const double gone = wash_down(wet.run_off, 0.7, amounts);
    EXPECT_GT(gone, 0.0);
    EXPECT_NEAR(std::accumulate(amounts.begin(), amounts.end(), gone),
                static_cast<double>(amounts.size()), 1e-6 * static_cast<double>(amounts.size()));
}

TEST(RunOff, LeadsDownAlone) {
    const Wet wet(scenes::Made()
                      .floor(-1, -1, 1, 1, 0, "soil")
                      .box({-0.3F, 0.2F, -0.3F}, {0.3F, 0.6F, 0.3F}, "log"));
    for (std::uint32_t i = 0; i < wet.shape->surfels.size(); ++i)
        for (std::uint32_t k = wet.run_off.first[i]; k < wet.run_off.first[i + 1]; ++k)
            EXPECT_LT(wet.shape->surfels[wet.run_off.ways[k].to].at.y, wet.shape->surfels[i].at.y);
}

}  // namespace
}  // namespace sporeprint::run_off_test
