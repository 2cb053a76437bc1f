#include "core/scene/scene_spores.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <memory>
#include <numeric>
#include <vector>

#include "tests/support/scenes.h"

namespace sporeprint::scene_spores_test {
namespace {

std::shared_ptr<const SceneShape> shape_of(const scenes::Made& made) {
    return std::make_shared<const SceneShape>(shape_of_scene(made.shared()));
}

SceneHabitat blown(const std::shared_ptr<const SceneShape>& shape, double from, double speed) {
    SceneConditions conditions = scenes::conditions_for(*shape->scene);
    conditions.climate.wind_from_deg = from;
    conditions.climate.wind_speed = speed;
    conditions.climate.wind_focus = 5.0;
    return habitat_of(shape, conditions);
}

std::vector<double> arriving(const SceneHabitat& habitat) {
    return arriving_spores(habitat, wind_rose(habitat.conditions.climate), {}, 1);
}

/// Returns the mean of values on surfels that face like a normal, by their areas.
template <class Values>
double mean(const SceneHabitat& habitat, const Values& values, const glm::dvec3& normal) {
    double sum = 0.0, area = 0.0;
    for (std::size_t i = 0; i < values.size(); ++i) {
        const Surfel& one = habitat.surfels()[i];
        if (glm::dot(glm::dvec3(one.normal), normal) < 0.9) continue;
        sum += static_cast<double>(values[i]) * static_cast<double>(one.area);
        area += static_cast<double>(one.area);
    }
    return sum / area;
}

constexpr glm::dvec3 up(0.0, 1.0, 0.0), west(-1.0, 0.0, 0.0), east(1.0, 0.0, 0.0),
    north(0.0, 0.0, -1.0);

TEST(SceneSpores, ArriveOnOpenGroundAsOnThatOfNoScene) {
    const auto shape = shape_of(scenes::Made().floor(-3, -3, 3, 3, 0, "grass"));
    const SceneHabitat habitat = blown(shape, 270, 3);
    EXPECT_NEAR(mean(habitat, arriving(habitat), up), 1.0, 0.15);
    // Without wind they sink.
    const SceneHabitat still = blown(shape, 270, 0);
    EXPECT_NEAR(mean(still, arriving(still), up), 1.0, 0.15);
}

TEST(SceneSpores, ArriveUpwindAndNotInAClosedBox) {
    const auto shape = shape_of(scenes::Made()
                                    .floor(-3, -3, 3, 3, 0, "soil")
                                    .box({-0.5F, 0, -0.5F}, {0.5F, 1.5F, 0.5F}, "wood"));
    const SceneHabitat from_west = blown(shape, 270, 4), from_north = blown(shape, 0, 4);
    const std::vector<double> a = arriving(from_west), b = arriving(from_north);
    EXPECT_GT(mean(from_west, a, west), 2.0 * mean(from_west, a, east));
    EXPECT_GT(mean(from_north, b, north), 2.0 * mean(from_north, b, east));
    EXPECT_GT(mean(from_west, a, west), 3.0 * mean(from_north, b, west))
        << "the wind turned by 90 degrees takes them elsewhere";

    const auto hollow = shape_of(scenes::Made()
                                     .floor(-1, -1, 1, 1, 0, "soil")
                                     .box({-1.2F, -0.1F, -1.2F}, {1.2F, 1, 1.2F}, "wood"));
    const SceneHabitat closed = blown(hollow, 270, 4);
    const std::vector<double> inside = arriving(closed);
    for (std::uint32_t i = 0; i < inside.size(); ++i)
        if (hollow->surfels[i].at.y == 0.0F && glm::length(hollow->surfels[i].at) < 0.7F) {
            EXPECT_EQ(inside[i], 0.0);
        }
}

TEST(SceneSpores, FlyWithTheWind) {
    const auto shape = shape_of(scenes::Made().floor(-5, -5, 5, 5, 0, "grass"));
    const std::vector<float> suits(shape->surfels.size(), 1.0F);
    const auto shift = [&](double from, double settling) {
        const SceneHabitat habitat = blown(shape, from, 4);
        SporeHabit spores;
        spores.settling = settling;
        glm::dvec3 sum(0.0);
        double count = 0.0;
        for (const SporePath& path :
             spore_paths(habitat, wind_rose(habitat.conditions.climate), spores, 1, suits)) {
            sum +=
                glm::dvec3(shape->surfels[path.to].at) - glm::dvec3(shape->surfels[path.from].at);
            count += 1.0;
        }
        EXPECT_GT(count, 100.0);
        return sum / count;
    };
    const glm::dvec3 to_east = shift(270, 0.0015), to_south = shift(0, 0.0015);
    EXPECT_GT(to_east.x, 0.05);
    EXPECT_LT(std::abs(to_east.z), 0.5 * to_east.x);
    EXPECT_GT(to_south.z, 0.05);
    EXPECT_LT(shift(270, 0.05).x, to_east.x) << "heavy spores fall sooner";
}

TEST(SceneSpores, SpreadOverYearsWhereTheSpeciesCanLive) {
    const auto shape = shape_of(scenes::Made()
                                    .floor(-1.5F, -1.5F, 0, 1.5F, 0, "grass")
                                    .floor(0, -1.5F, 1.5F, 1.5F, 0, "rock"));
    const SceneHabitat habitat = scenes::habitat_in(shape);
    const SceneEstablishment spread = scene_spread(habitat, scenes::grass_species());
    const auto cover = [&](double year, bool on_grass) {
        double sum = 0.0;
        for (std::uint32_t i = 0; i < shape->surfels.size(); ++i)
            if ((habitat.substrates.soils[i] == Soil::grass) == on_grass) sum += spread.at(i, year);
        return sum;
    };
    EXPECT_GT(cover(0, true), 0.0);
    double before = 0.0;
    for (const double year : {0.0, 10.0, 40.0, 100.0, 200.0}) {
        EXPECT_GE(cover(year, true), before);
        before = cover(year, true);
        EXPECT_EQ(cover(year, false), 0.0) << "nothing lives on rock";
    }
    EXPECT_EQ(cover(-50.0, true), cover(0.0, true));
    const SceneEstablishment none = scene_spread(habitat, scenes::wood_species());
    EXPECT_EQ(none.at(0, 200.0), 0.0);
    EXPECT_TRUE(spread == scene_spread(habitat, scenes::grass_species()));
}

}  // namespace
}  // namespace sporeprint::scene_spores_test
