#include "core/grow/world/plot_of_world.h"

#include <gtest/gtest.h>

#include <memory>

namespace sporeprint::plot_of_world_test {
namespace {

const Atlas& atlas() {
    static const std::shared_ptr<const Atlas> atlas = built_in_atlas();
    return *atlas;
}

std::shared_ptr<const World> world_of_preset(const char* id) {
    WorldParams params = params_of(*atlas().find_world(id));
    params.seed = 7;
    params.extent.value = 256;
    return std::make_shared<const World>(
        world_of(params, lookup_in(atlas()), std::make_shared<const Ground>(ground_of(params))));
}

constexpr WorldTime autumn = time_of(80, 270) + ticks_of_day / 2;

TEST(PlotOfWorld, ShowsTheSameBodiesWhateverItsSize) {
    const auto world = world_of_preset("meadow");
    const ExecutionContext services;
    const std::vector<FruitBody> all = bodies_in(*world, {0, 0, 64, 64}, autumn, services);
    ASSERT_GT(all.size(), 10U) << "rings stand in this meadow in autumn";
    const double x = metres(all.front().at.x), y = metres(all.front().at.y);
    const auto small = plot_of_world(world, {x, y, 4.0}, autumn, services),
               large = plot_of_world(world, {x, y, 12.0}, autumn, services);
    const WorldBox box{x - 2.0, y - 2.0, x + 2.0, y + 2.0};
    std::vector<FruitBody> within;
    for (const FruitBody& body : large->bodies)
        if (contains(box, body.at)) within.push_back(body);
    EXPECT_EQ(small->bodies, within);
    EXPECT_FALSE(within.empty());
    EXPECT_EQ(small->content.light(x, y), large->content.light(x, y));
    EXPECT_GT(small->content.light(x, y), 0.5) << "a meadow has light";
}

TEST(PlotOfWorld, GrowsToAFile) {
    const auto world = world_of_preset("meadow");
    const auto plot = plot_of_world(world, {3.0, -2.0, 3.0}, autumn, {});
    PlotOptions options;
    options.texture_size = 256;
    const Grown grown = grow_plot(plot->content, options, atlas());
    EXPECT_GT(grown.triangles, 1000U);
    EXPECT_LT(grown.triangles, most_plot_triangles);
    EXPECT_GT(size_of(grown.glb), 100'000U);
}

}  // namespace
}  // namespace sporeprint::plot_of_world_test
