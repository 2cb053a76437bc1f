#include "core/scene/exposure.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "core/math/elementary.h"
#include "tests/support/scenes.h"

namespace sporeprint::exposure_test {
namespace {

constexpr glm::dvec3 up(0.0, 1.0, 0.0), to_west(-1.0, 0.0, 0.0), to_east(1.0, 0.0, 0.0),
    to_north(0.0, 0.0, -1.0), to_south(0.0, 0.0, 1.0);

struct Lit {
    Scene scene;
    Surfels surfels;
    TriangleTree tree;

    explicit Lit(const scenes::Made& made)
        : scene(made.scene), surfels(surfels_of(scene, 1, 4000)), tree(scene) {}
    [[nodiscard]] double at(const std::vector<float>& values, const glm::dvec3& place,
                            const glm::dvec3& normal) const {
        return static_cast<double>(values[surfels.nearest(place, normal, 0.6).value()]);
    }
};

/// A pillar with a square section, far from all else.
Lit pillar() {
    return Lit(scenes::Made()
                   .floor(-6, -6, 6, 6, 0, "soil")
                   .box({-0.5F, 0, -0.5F}, {0.5F, 3, 0.5F}, "wood"));
}

TEST(Exposure, OfOpenGroundIsWholeAndOfOpenWallsHalf) {
    const Lit lit = pillar();
    const std::vector<float> sky = sky_of(lit.surfels, lit.tree, 1);
    EXPECT_GT(lit.at(sky, {5.5, 0.0, 5.5}, up), 0.95);
    EXPECT_DOUBLE_EQ(lit.at(sky, {0.0, 3.0, 0.0}, up), 1.0);
    EXPECT_NEAR(lit.at(sky, {0.5, 2.0, 0.0}, to_east), 0.5, 0.05);
    // At the foot of a wide wall half of the sky is left.
    EXPECT_LT(lit.at(sky, {0.55, 0.0, 0.0}, up), 0.8);
}

TEST(Exposure, BelowARoofHasNoSkyNoSunAndNoRain) {
    const Lit lit(
        scenes::Made().floor(-1, -1, 1, 1, 0, "soil").box({-8, 0.5F, -8}, {8, 0.6F, 8}, "wood"));
    const auto dry = [&](const std::vector<float>& values) {
        return lit.at(values, {0.0, 0.0, 0.0}, up);
    };
    EXPECT_LT(dry(sky_of(lit.surfels, lit.tree, 1)), 0.04);
    EXPECT_EQ(dry(sun_on(lit.surfels, lit.tree, sun_of(radians(50.0), 172))), 0.0);
    EXPECT_EQ(dry(rain_on(lit.surfels, lit.tree, wind_rose({}), 1)), 0.0);
}

TEST(Exposure, ToTheSunOfTheSouthAtNoonAndOfAllSidesInSummer) {
    const Lit lit = pillar();
    const std::vector<float> winter = sun_on(lit.surfels, lit.tree, sun_of(radians(50.0), 355));
    EXPECT_NEAR(lit.at(winter, {0.0, 3.0, 0.0}, up), 1.0, 1e-6) << "the level is the measure";
    EXPECT_GT(lit.at(winter, {0.0, 2.0, 0.5}, to_south), 2.0) << "a low sun";
    EXPECT_EQ(lit.at(winter, {0.0, 2.0, -0.5}, to_north), 0.0);
    const std::vector<float> summer = sun_on(lit.surfels, lit.tree, sun_of(radians(50.0), 172));
    EXPECT_GT(lit.at(summer, {0.0, 2.0, -0.5}, to_north), 0.0) << "mornings and evenings";
    EXPECT_NEAR(lit.at(summer, {0.5, 2.0, 0.0}, to_east), lit.at(summer, {-0.5, 2.0, 0.0}, to_west),
                1e-6);
    // South of the equator the sun is in the north.
    const std::vector<float> southern = sun_on(lit.surfels, lit.tree, sun_of(radians(-50.0), 172));
    EXPECT_GT(lit.at(southern, {0.0, 2.0, -0.5}, to_north), 1.0);
    EXPECT_EQ(lit.at(southern, {0.0, 2.0, 0.5}, to_south), 0.0);
    // Its shadow falls on the ground in the north of it in winter.
    EXPECT_LT(lit.at(winter, {0.0, 0.0, -1.0}, up), 0.5);
}

TEST(Exposure, ToRainFromTheWestWetsWestWalls) {
    const Lit lit = pillar();
    const WindRose west = wind_rose({.wind_from_deg = 270, .wind_speed = 6, .wind_focus = 5});
    const std::vector<float> rain = rain_on(lit.surfels, lit.tree, west, 1);
    EXPECT_NEAR(lit.at(rain, {0.0, 3.0, 0.0}, up), 1.0, 1e-6) << "level ground is the measure";
    const double wet = lit.at(rain, {-0.5, 2.0, 0.0}, to_west),
                 dry = lit.at(rain, {0.5, 2.0, 0.0}, to_east);
    EXPECT_GT(wet, 0.3);
    EXPECT_LT(dry, 0.01);
    // Behind the pillar is its rain shadow.
    EXPECT_LT(lit.at(rain, {0.7, 0.0, 0.0}, up), 0.5);
    EXPECT_GT(lit.at(rain, {-2.0, 0.0, 0.0}, up), 0.99);
    // Rain of still air wets no wall.
    const std::vector<float> still =
        rain_on(lit.surfels, lit.tree, wind_rose({.wind_speed = 0}), 1);
    EXPECT_LT(lit.at(still, {-0.5, 2.0, 0.0}, to_west), 1e-6);
    // The wind turned by 90 degrees wets the north wall as much.
    const WindRose north = wind_rose({.wind_from_deg = 0, .wind_speed = 6, .wind_focus = 5});
    const std::vector<float> turned = rain_on(lit.surfels, lit.tree, north, 1);
    EXPECT_NEAR(lit.at(turned, {0.0, 2.0, -0.5}, to_north), wet, 0.1);
}

TEST(Exposure, TellsWhatIsInTheGroundFromWhatIsBelowARoof) {
    const Lit lit(scenes::Made()
                      .floor(-2, -2, 2, 2, 0, "soil")
                      .box({-0.5F, -0.6F, -0.5F}, {0.5F, 0.6F, 0.5F}, "wood")
                      .box({-9, 2, -9}, {9, 2.1F, 9}, "metal"));
    const std::vector<float> sky = sky_of(lit.surfels, lit.tree, 1);
    const std::vector<std::uint8_t> buried = buried_of(lit.surfels, lit.tree, lit.scene, sky);
    const auto at = [&](const glm::dvec3& place, const glm::dvec3& normal) {
        return buried[lit.surfels.nearest(place, normal, 0.6).value()] != 0;
    };
    EXPECT_TRUE(at({0.5, -0.4, 0.0}, to_east)) << "a side of the wood below the ground";
    EXPECT_TRUE(at({0.0, -0.6, 0.0}, -up)) << "its lower end";
    EXPECT_TRUE(at({0.0, 0.0, 0.0}, up)) << "the ground within the wood";
    EXPECT_FALSE(at({0.5, 0.4, 0.0}, to_east));
    EXPECT_FALSE(at({0.0, 0.6, 0.0}, up));
    EXPECT_FALSE(at({1.5, 0.0, 0.0}, up)) << "dark, but below a roof";
}

TEST(Exposure, IsTheSameWithSeveralThreads) {
    const Lit lit = pillar();
    EXPECT_EQ(sky_of(lit.surfels, lit.tree, 1),
              sky_of(lit.surfels, lit.tree, 1, scenes::by_threads));
    EXPECT_EQ(rain_on(lit.surfels, lit.tree, wind_rose({}), 1),
              rain_on(lit.surfels, lit.tree, wind_rose({}), 1, scenes::by_threads));
}

}  // namespace
}  // namespace sporeprint::exposure_test
