#include "core/plant/snow_cap.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

#include "core/mesh/measure.h"
#include "core/problems.h"
#include "tests/support/meshes.h"

namespace sporeprint::plant_snow_cap_test {
namespace {

constexpr double radius = 0.2, length = 4.0;

/// A level trunk along x.
TrunkSection level(double s) { return {{s, 1.0, 0.0}, radius}; }

SnowCapParams deep(double depth) {
    SnowCapParams params;
    params.length = length;
    params.depth = depth;
    return params;
}

double highest(const Mesh& mesh) {
    float most = 0.0F;
    for (const glm::vec3& at : mesh.positions) most = std::max(most, at.y);
    return static_cast<double>(most) - 1.0;
}

TEST(SnowCap, LiesOnTheUpperSideFromTheBarkUpwards) {
    const Mesh mesh = snow_cap(deep(0.06), level);
    ASSERT_FALSE(mesh.positions.empty());
    expect_valid(mesh);
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        const glm::vec3 from_axis = mesh.positions[i] - glm::vec3(mesh.positions[i].x, 1.0F, 0.0F);
        EXPECT_GT(from_axis.y, 0.0F);
        EXPECT_GT(glm::length(from_axis), 0.85F * static_cast<float>(radius));
        EXPECT_GT(glm::dot(mesh.normals[i], from_axis), 0.0F) << "of the outer side";
    }
    EXPECT_NEAR(highest(mesh), radius + 0.06, 0.035);
    EXPECT_GT(volume(mesh), 0.3 * 0.06 * 2.0 * radius * length);
}

TEST(SnowCap, IsDeeperInDeeperSnowButNotThanThinTrunksHold) {
    EXPECT_LT(highest(snow_cap(deep(0.03), level)), highest(snow_cap(deep(0.09), level)));
    EXPECT_LE(highest(snow_cap(deep(1.0), level)), radius + 1.4 * radius);
}

TEST(SnowCap, IsNotThereWithoutSnowNorOnSteepTrunks) {
    EXPECT_TRUE(snow_cap(deep(0.0), level).positions.empty());
    SnowCapParams none = deep(0.05);
    none.cover = 0.0;
    EXPECT_TRUE(snow_cap(none, level).positions.empty());
    const auto upright = [](double s) { return TrunkSection{{0.0, s, 0.0}, radius}; };
    EXPECT_TRUE(snow_cap(deep(0.05), upright).positions.empty());
}

TEST(SnowCap, EndsBeforeBrokenEndsOfTheTrunk) {
    const Mesh mesh = snow_cap(deep(0.1), level);
    // A broken end is up to 0.9 radii shorter than its trunk.
    for (const glm::vec3& at : mesh.positions) {
        if (glm::length(glm::vec2(at.y - 1.0F, at.z)) < 1.02F * static_cast<float>(radius))
            continue;
        EXPECT_GT(at.x, 0.9 * radius);
        EXPECT_LT(at.x, length - 0.9 * radius);
    }
}

TEST(SnowCap, OfLessCoverHasGaps) {
    SnowCapParams thin = deep(0.05);
    thin.length = 30.0;
    thin.cover = 0.5;
    SnowCapParams whole = thin;
    whole.cover = 1.0;
    EXPECT_LT(snow_cap(thin, level).triangles(), snow_cap(whole, level).triangles());
}

TEST(SnowCap, RefusesWhatCannotBe) {
    SnowCapParams params = deep(0.05);
    params.length = 0.0;
    EXPECT_THROW(static_cast<void>(snow_cap(params, level)), InvalidInput);
    params = deep(0.05);
    params.step = 0.0;
    EXPECT_THROW(static_cast<void>(snow_cap(params, level)), InvalidInput);
    params = deep(0.05);
    params.columns = 2;
    EXPECT_THROW(static_cast<void>(snow_cap(params, level)), InvalidInput);
}

}  // namespace
}  // namespace sporeprint::plant_snow_cap_test
