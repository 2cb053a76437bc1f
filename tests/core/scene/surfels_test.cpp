#include "core/scene/surfels.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <numeric>
#include <optional>
#include <vector>

#include "tests/support/scenes.h"

namespace sporeprint::surfels_test {
namespace {

double area(const Surfels& surfels) {
    double sum = 0.0;
    for (const Surfel& one : surfels) sum += static_cast<double>(one.area);
    return sum;
}

Scene hollow() {
    return scenes::Made()
        .floor(-1, -1, 1, 1, 0, "soil")
        .box({-0.3F, 0.0F, -0.3F}, {0.3F, 0.6F, 0.3F}, "log")
        .scene;
}

TEST(Surfels, AreNoNearerThanTheSpacingIfTheyFaceAlike) {
    const Surfels surfels = surfels_of(hollow(), 1);
    EXPECT_DOUBLE_EQ(surfels.spacing(), finest_spacing);
    ASSERT_GT(surfels.size(), 1000U);
    for (std::uint32_t i = 0; i < surfels.size(); ++i)
        surfels.each_near(glm::dvec3(surfels[i].at), surfels.spacing(), [&](std::uint32_t j) {
            if (i == j ||
                glm::dot(surfels[i].normal, surfels[j].normal) <= static_cast<float>(alike_facing))
                return;
            EXPECT_GE(glm::length(glm::dvec3(surfels[i].at) - glm::dvec3(surfels[j].at)),
                      surfels.spacing());
        });
}

TEST(Surfels, LeaveNoPlaceOfTheSurfaceWithoutOne) {
    const Surfels surfels = surfels_of(hollow(), 1);
    int empty = 0;
    for (double x = -0.95; x < 1.0; x += 0.05)
        for (double z = -0.95; z < 1.0; z += 0.05)
            if (!surfels.nearest({x, 0.0, z}, {0.0, 1.0, 0.0}, 1.5 * surfels.spacing())) ++empty;
    EXPECT_LE(empty, 3) << "of 1521";
}

TEST(Surfels, ShareTheWholeAreaAmongThem) {
    const Surfels surfels = surfels_of(hollow(), 1);
    EXPECT_NEAR(area(surfels), 4.0 + 6.0 * 0.36, 1e-3);
    // As many on each square metre of a wall as of the ground.
    double on_log = 0.0;
    for (const Surfel& one : surfels)
        if (one.material == 2) on_log += static_cast<double>(one.area);
    EXPECT_NEAR(on_log, 6.0 * 0.36, 0.02);
}

TEST(Surfels, LieOnTheirTrianglesAndHaveTheirNormals) {
    const Scene scene = hollow();
    for (const Surfel& one : surfels_of(scene, 3)) {
        const SceneTriangle& triangle = scene.triangles[one.triangle];
        EXPECT_EQ(one.material, triangle.material);
        const glm::dvec3 normal = normal_of(scene, one.triangle);
        EXPECT_NEAR(glm::length(normal - glm::dvec3(one.normal)), 0.0, 1e-6);
        const glm::dvec3 corner(scene.positions[triangle.corners[0]]);
        EXPECT_NEAR(glm::dot(glm::dvec3(one.at) - corner, normal), 0.0, 1e-6);
    }
}

TEST(Surfels, HaveBothSidesOfAThinPlank) {
    const Surfels surfels =
        surfels_of(scenes::Made().box({0, 0, 0}, {1, 0.002F, 1}, "wood").scene, 1);
    const glm::dvec3 middle(0.5, 0.001, 0.5);
    EXPECT_TRUE(surfels.nearest(middle, {0.0, 1.0, 0.0}, 0.05));
    EXPECT_TRUE(surfels.nearest(middle, {0.0, -1.0, 0.0}, 0.05));
}

TEST(Surfels, GrowFartherApartWhereThereIsMuchSurface) {
    const Scene wide = scenes::Made().floor(-25, -25, 25, 25, 0, "soil").scene;
    const Surfels surfels = surfels_of(wide, 1, 2000);
    EXPECT_LE(surfels.size(), 2000U);
    EXPECT_GT(surfels.size(), 1200U);
    EXPECT_NEAR(area(surfels), 2500.0, 1.0);
    EXPECT_GT(surfels.spacing(), 0.5);
}

TEST(Surfels, OfAScrapOfPaperAreAtLeastOne) {
    const Surfels surfels =
        surfels_of(scenes::Made().floor(0, 0, 0.001F, 0.001F, 0, "litter").scene, 1);
    ASSERT_EQ(surfels.size(), 1U);
    EXPECT_NEAR(area(surfels), 1e-6, 1e-9);
    EXPECT_EQ(surfels_of(Scene{}, 1).size(), 0U);
}

TEST(Surfels, AreTheSameForTheSameSeedAlone) {
    const Scene scene = hollow();
    EXPECT_TRUE(surfels_of(scene, 5) == surfels_of(scene, 5));
    EXPECT_FALSE(surfels_of(scene, 5) == surfels_of(scene, 6));
}

}  // namespace
}  // namespace sporeprint::surfels_test
