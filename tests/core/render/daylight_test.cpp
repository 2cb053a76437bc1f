#include "core/render/daylight.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "core/problems.h"

namespace sporeprint::render::render_daylight_test {
namespace {

constexpr glm::vec3 up(0.0F, 1.0F, 0.0F);

Daylight day_with(double sun_up, double cloud) {
    Daylight day;
    day.to_sun = {1.0, sun_up, 0.0};
    day.cloud = cloud;
    return day;
}

float brightness(const glm::vec3& light) { return (light.x + light.y + light.z) / 3.0F; }

TEST(Daylight, TheLowSunIsWeakerAndRedder) {
    const auto sun = [](double sun_up) {
        glm::vec3 sum(0.0F);
        for (const Light& light : Sky(day_with(sun_up, 0.0)).lights(1).lamps) sum += light.strength;
        return sum;
    };
    const glm::vec3 high = sun(2.0), low = sun(0.1);
    EXPECT_GT(brightness(high), 1.5F * brightness(low));
    EXPECT_GT(low.x / low.z, 1.5F * high.x / high.z);
    EXPECT_TRUE(Sky(day_with(-0.5, 0.0)).lights(1).lamps.empty()) << "it is night";
}

TEST(Daylight, CloudsTakeTheSunAndTheBlue) {
    EXPECT_FALSE(Sky(day_with(1.0, 0.0)).lights(1).lamps.empty());
    EXPECT_TRUE(Sky(day_with(1.0, 1.0)).lights(1).lamps.empty());
    const glm::vec3 clear = Sky(day_with(1.0, 0.0)).at(up), grey = Sky(day_with(1.0, 1.0)).at(up);
    EXPECT_GT(clear.z, 1.8F * clear.x);
    EXPECT_LT(grey.z, 1.2F * grey.x);
}

TEST(Daylight, AnOvercastSkyIsThreeTimesAsBrightAtTheZenith) {
    const Sky sky(day_with(1.0, 1.0));
    EXPECT_NEAR(brightness(sky.at(up)) / brightness(sky.at({0.0F, 0.0F, 1.0F})), 3.0F, 0.01F);
}

TEST(Daylight, HazeTakesAllButAFiftiethOfTheContrastAsFarAsOneSees) {
    Daylight day = day_with(1.0, 0.3);
    day.visibility = 100.0;
    const Sky sky(day);
    const glm::vec3 level(0.0F, 0.0F, -1.0F), black(0.0F), white(1.0F);
    const auto contrast = [&](float distance) {
        return glm::distance(sky.through_air(white, level, distance),
                             sky.through_air(black, level, distance)) /
               glm::distance(white, black);
    };
    EXPECT_FLOAT_EQ(contrast(0.0F), 1.0F);
    EXPECT_NEAR(contrast(100.0F), 0.02F, 0.001F);
    EXPECT_NEAR(glm::distance(sky.through_air(black, level, 1e5F), sky.at(level)), 0.0F, 1e-5F);
}

TEST(Daylight, FewerLightsAreAboutAsBright) {
    const Sky sky(day_with(1.0, 0.2));
    const auto total = [&](int detail) {
        const PictureLights lights = sky.lights(detail);
        glm::vec3 sum(0.0F);
        for (const auto* list : {&lights.lamps, &lights.surroundings})
            for (const Light& light : *list) sum += light.strength;
        return brightness(sum);
    };
    EXPECT_GT(sky.lights(1).surroundings.size(), 2 * sky.lights(4).surroundings.size());
    EXPECT_NEAR(total(4) / total(1), 1.0F, 0.03F);
}

TEST(Daylight, RefusesWhatNoSkyIs) {
    EXPECT_THROW(Sky{day_with(1.0, 1.5)}, InvalidInput);
    Daylight day;
    day.visibility = 0.0;
    EXPECT_THROW(Sky{day}, InvalidInput);
}

}  // namespace
}  // namespace sporeprint::render::render_daylight_test
