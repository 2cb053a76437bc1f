#include "core/collision/collision_shape.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <glm/geometric.hpp>

#include "core/collision/convex_hull.h"
#include "core/math/elementary.h"
#include "core/mesh/measure.h"

namespace sporeprint::collision_collision_shape_test {
namespace {

/// Returns the side of a solid of revolution about +y, closed at both ends.
template <class Radius>
Mesh turned(float height, int rings, Radius radius) {
    constexpr int columns = 32;
    Mesh mesh;
    const auto index = [&](int ring, int column) {
        return static_cast<std::uint32_t>(ring * columns + column % columns);
    };
    for (int ring = 0; ring <= rings; ++ring) {
        const float y = height * static_cast<float>(ring) / static_cast<float>(rings);
        for (int column = 0; column < columns; ++column) {
            const SineCosine at = sine_cosine(2.0 * pi * column / columns);
            const double r = radius(y);
            mesh.positions.emplace_back(r * at.cosine, y, r * at.sine);
        }
    }
    for (int ring = 0; ring < rings; ++ring)
        for (int column = 0; column < columns; ++column)
            for (const std::uint32_t i :
                 {index(ring, column), index(ring + 1, column), index(ring, column + 1),
                  index(ring, column + 1), index(ring + 1, column), index(ring + 1, column + 1)})
                mesh.indices.push_back(i);
    return mesh;
}

std::vector<CollisionShape> fitted(const Mesh& mesh) {
    return fitted_shapes("body", mesh.positions, mesh.indices);
}

TEST(Capsule, HasTheVolumeOfACylinderAndASphere) {
    const Capsule capsule{{0.0, 1.0, 0.0}, {0.0, 4.0, 0.0}, 0.5};
    EXPECT_DOUBLE_EQ(capsule.height(), 4.0);
    EXPECT_NEAR(capsule.volume(), pi * 0.25 * 3.0 + 4.0 / 3.0 * pi * 0.125, 1e-12);
    EXPECT_TRUE(capsule.contains({0.49, 2.0, 0.0}));
    EXPECT_TRUE(capsule.contains({0.0, 4.49, 0.0}));
    EXPECT_FALSE(capsule.contains({0.4, 4.4, 0.0}));
}

TEST(Capsule, ItsRotationTurnsUpwardsToItsEnd) {
    for (const glm::dvec3& way : directions(7, 4)) {
        const glm::dvec4 q = rotation_of({glm::dvec3(1.0), glm::dvec3(1.0) + 2.0 * way, 0.1});
        const glm::dvec3 u(q), up(0.0, 1.0, 0.0);
        const glm::dvec3 turned = up + 2.0 * glm::cross(u, glm::cross(u, up) + q.w * up);
        EXPECT_LT(glm::distance(turned, way), 1e-9);
        EXPECT_NEAR(glm::length(q), 1.0, 1e-12);
    }
    EXPECT_EQ(rotation_of({glm::dvec3(1.0), glm::dvec3(1.0), 0.1}), glm::dvec4(0.0, 0.0, 0.0, 1.0));
}

TEST(Capsule, ItsHullLiesWithinItAndNearlyFillsIt) {
    const Capsule capsule{{0.1, 0.0, 0.0}, {0.3, 0.5, 0.2}, 0.1};
    const Mesh hull = hull_of(capsule);
    EXPECT_LE(hull.positions.size(), 50U);
    EXPECT_EQ(defects(hull), std::vector<std::string>{});
    EXPECT_LT(volume(hull), capsule.volume());
    EXPECT_GT(overlap(capsule, hull), 0.78);
}

TEST(Overlap, IsOneForTheSameSolidAndNothingForSolidsApart) {
    const Capsule capsule{{0.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, 0.25};
    std::vector<glm::vec3> points;
    for (const glm::dvec3& way : directions(40, 19)) {
        points.emplace_back(capsule.from + 0.25 * way);
        points.emplace_back(capsule.to + 0.25 * way);
    }
    EXPECT_GT(overlap(capsule, convex_hull(points)), 0.97);
    EXPECT_EQ(overlap({{5.0, 0.0, 0.0}, {5.0, 1.0, 0.0}, 0.25}, convex_hull(points)), 0.0);
}

TEST(FittedShapes, OfAStemAreOneCapsule) {
    const Mesh stem = turned(1.0F, 20, [](double) { return 0.08; });
    const std::vector<CollisionShape> shapes = fitted(stem);
    ASSERT_EQ(shapes.size(), 1U);
    const auto& capsule = std::get<Capsule>(shapes[0].solid);
    EXPECT_NEAR(capsule.radius, 0.08, 0.005);
    EXPECT_NEAR(capsule.height(), 1.0, 0.02);
    EXPECT_EQ(shapes[0].part, "body");
}

TEST(FittedShapes, OfADiscAreOneConvexMeshOfFewCornersAndTheSameVolume) {
    const Mesh disc = turned(0.1F, 2, [](double) { return 0.5; });
    const std::vector<CollisionShape> shapes = fitted(disc);
    ASSERT_EQ(shapes.size(), 1U);
    const auto& hull = std::get<Mesh>(shapes[0].solid);
    EXPECT_LE(hull.positions.size(), static_cast<std::size_t>(most_hull_corners));
    EXPECT_EQ(defects(hull), std::vector<std::string>{});
    EXPECT_NEAR(volume(hull), pi * 0.25 * 0.1, 0.004);
}

TEST(FittedShapes, OfAnHourglassAreSlices) {
    const Mesh waist = turned(2.0F, 40, [](double y) { return 0.1 + 0.5 * std::abs(y - 1.0); });
    const std::vector<CollisionShape> shapes = fitted(waist);
    EXPECT_GT(shapes.size(), 1U);
    EXPECT_LE(shapes.size(), 8U);
}

TEST(FittedShapes, OfNothingAndOfAPlaneAreNone) {
    EXPECT_TRUE(fitted_shapes("body", {}, {}).empty());
    const std::array<glm::vec3, 3> flat = {glm::vec3(0.0F), glm::vec3(1.0F, 0.0F, 0.0F),
                                           glm::vec3(0.0F, 0.0F, 1.0F)};
    EXPECT_TRUE(fitted_shapes("body", flat, std::array<std::uint32_t, 3>{0, 1, 2}).empty());
}

TEST(CapsulesAlong, AChainCoverItInEqualPieces) {
    std::vector<glm::dvec3> points;
    std::vector<double> radii;
    for (int i = 0; i <= 12; ++i) {
        points.emplace_back(0.0, 0.25 * i, 0.0);
        radii.push_back(0.2 - 0.01 * i);
    }
    const std::vector<CollisionShape> shapes = capsules_along("trunk", points, radii, 4);
    ASSERT_EQ(shapes.size(), 4U);
    for (std::size_t i = 0; i < shapes.size(); ++i) {
        const auto& piece = std::get<Capsule>(shapes[i].solid);
        EXPECT_NEAR(piece.from.y, 0.75 * static_cast<double>(i), 1e-12);
        EXPECT_NEAR(piece.to.y, 0.75 * static_cast<double>(i + 1), 1e-12);
        EXPECT_NEAR(piece.radius, 0.2 - 0.01 * (3.0 * static_cast<double>(i) + 1.5), 1e-12);
    }
    EXPECT_EQ(
        capsules_along("trunk", std::span(points).first(2), std::span(radii).first(2), 4).size(),
        1U);
}

}  // namespace
}  // namespace sporeprint::collision_collision_shape_test
