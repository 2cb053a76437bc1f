#include "core/grow/world/plot_scenery.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <memory>

#include "core/grow/world/plot_view.h"
#include "core/math/elementary.h"
#include "tests/support/atlas.h"
#include "tests/support/worlds.h"

namespace sporeprint::grow_plot_scenery_test {
namespace {

struct WorldOfTest {
    std::shared_ptr<const World> world;
    CachedParts parts;

    explicit WorldOfTest(const char* preset)
        : world(std::make_shared<const World>(world_over_its_ground(small_world(preset)))) {}

    RgbaImage picture(int day, double x = 0.0, PlotOptions options = {}) {
        const auto plot = plot_of_world(world, {x, 0.0, 4.0}, time_of(60, day) + 8, parts.services);
        PictureParams params;
        params.width = 64;
        params.height = 48;
        options.litter = 2.0;
        return scenery_of(*plot, options, camera_of(plot->content, PlotView::standing, 0.0), params,
                          atlas(), parts.services);
    }
};

WorldOfTest& meadow() {
    static WorldOfTest world("meadow");
    return world;
}

/// Returns the mean of a channel over some rows.
double mean(const RgbaImage& image, int from, int to, std::size_t channel) {
    double sum = 0.0;
    for (int y = from; y < to; ++y)
        for (int x = 0; x < image.width; ++x)
            sum += image.rgba[4 * static_cast<std::size_t>(y * image.width + x) + channel];
    return sum / (image.width * (to - from));
}

TEST(PlotScenery, HasTheSkyAboveAndGrassBelow) {
    int day = 150;
    while (daylight_on(*meadow().world, time_of(60, day)).cloud > 0.3) ++day;
    const RgbaImage image = meadow().picture(day);
    for (std::size_t i = 3; i < image.rgba.size(); i += 4) ASSERT_EQ(image.rgba[i], 255);
    EXPECT_GT(mean(image, 0, 8, 2), mean(image, 0, 8, 0)) << "a clear sky is blue";
    EXPECT_GT(mean(image, 30, 48, 1), 1.2 * mean(image, 30, 48, 2)) << "grass is green";
}

TEST(PlotScenery, IsEqualHoweverOftenItIsDrawn) {
    EXPECT_EQ(meadow().picture(160).rgba, meadow().picture(160).rgba);
}

TEST(PlotScenery, IsDrawnAtTheRimOfAWorldToo) {
    const RgbaImage image = meadow().picture(160, 126.0);
    EXPECT_GT(mean(image, 30, 48, 1), mean(image, 30, 48, 2));
}

TEST(PlotScenery, ShowsTheLayersThatAreChosen) {
    PlotOptions options;
    options.layers = {true, false, false, false};
    const RgbaImage bare = meadow().picture(160, 0.0, options);
    EXPECT_NE(bare.rgba, meadow().picture(160).rgba);
}

TEST(Daylight, OfADayIsThatOfItsWeather) {
    const World& world = *meadow().world;
    const WeatherYear weather = weather_of(world.params.climate, world.params.seed, 60);
    for (int day = 2; day <= days_of_year; ++day) {
        const Daylight light = daylight_on(world, time_of(60, day));
        const bool has_rain = weather[static_cast<std::size_t>(day - 1)].rain > 0.2;
        EXPECT_EQ(light.cloud == 1.0, has_rain) << day;
        EXPECT_EQ(light.visibility < 600.0, has_rain) << day;
        EXPECT_GT(light.to_sun.y, 0.0);
    }
    EXPECT_GT(daylight_on(world, time_of(60, 172)).to_sun.y,
              1.5 * daylight_on(world, time_of(60, 355)).to_sun.y);
}

}  // namespace
}  // namespace sporeprint::grow_plot_scenery_test
