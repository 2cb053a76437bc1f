#include "core/collision/convex_hull.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <vector>

#include "core/math/elementary.h"
#include "core/mesh/measure.h"
#include "tests/support/meshes.h"

namespace sporeprint::collision_convex_hull_test {
namespace {

std::vector<glm::vec3> corners_of_a_cube() {
    std::vector<glm::vec3> points;
    for (const float x : {0.0F, 1.0F})
        for (const float y : {0.0F, 1.0F})
            for (const float z : {0.0F, 1.0F}) points.emplace_back(x, y, z);
    return points;
}

/// Returns by how much a point lies outside a convex mesh, metres.
double outside(const Mesh& hull, const glm::vec3& point) {
    double most = -1e300;
    for (std::size_t i = 0; i + 2 < hull.indices.size(); i += 3) {
        const glm::dvec3 a(hull.positions[hull.indices[i]]), b(hull.positions[hull.indices[i + 1]]),
            c(hull.positions[hull.indices[i + 2]]);
        const glm::dvec3 normal = glm::cross(b - a, c - a);
        const double length = glm::length(normal);
        if (length > 1e-12) most = std::max(most, glm::dot(normal, glm::dvec3(point) - a) / length);
    }
    return most;
}

TEST(ConvexHull, OfACubeHasItsCornersVolumeAndArea) {
    std::vector<glm::vec3> points = corners_of_a_cube();
    points.emplace_back(0.5F, 0.5F, 0.5F);  // inside
    points.emplace_back(0.5F, 0.5F, 1.0F);  // on a face
    points.emplace_back(0.5F, 1.0F, 1.0F);  // on an edge
    const Mesh hull = convex_hull(points);
    EXPECT_NEAR(volume(hull), 1.0, 1e-9);
    EXPECT_NEAR(area(hull), 6.0, 1e-9);
    EXPECT_EQ(defects(hull), std::vector<std::string>{});
    for (const glm::vec3& corner : corners_of_a_cube())
        EXPECT_NE(std::find(hull.positions.begin(), hull.positions.end(), corner),
                  hull.positions.end());
}

TEST(ConvexHull, OfManyPointsOfASphereHasNearlyItsVolume) {
    std::vector<glm::vec3> points;
    for (const glm::dvec3& direction : directions(64, 31)) points.emplace_back(2.0 * direction);
    EXPECT_NEAR(volume(convex_hull(points)), 4.0 / 3.0 * pi * 8.0, 0.3);
}

TEST(ConvexHull, OfPointsInAPlaneIsEmpty) {
    EXPECT_TRUE(convex_hull({}).indices.empty());
    EXPECT_TRUE(convex_hull(std::vector<glm::vec3>(9, glm::vec3(1.0F))).indices.empty());
    std::vector<glm::vec3> flat, line;
    for (int i = 0; i < 20; ++i) {
        flat.emplace_back(static_cast<float>(i % 5), 0.0F, static_cast<float>(i));
        line.emplace_back(static_cast<float>(i), static_cast<float>(i), 0.0F);
    }
    EXPECT_TRUE(convex_hull(flat).indices.empty());
    EXPECT_TRUE(convex_hull(line).indices.empty());
}

RC_GTEST_PROP(ConvexHullProperty, ItIsClosedAndConvexAndContainsAllPoints, ()) {
    // Few different coordinates, so that many points are in one plane or one line.
    const int steps = *rc::gen::element(2, 8, 1024);
    const auto coordinate = rc::gen::map(rc::gen::inRange(0, steps), [steps](int i) {
        return static_cast<float>(i) / static_cast<float>(steps);
    });
    const auto triples = *rc::gen::container<std::vector<std::tuple<float, float, float>>>(
        *rc::gen::inRange<std::size_t>(4, 80), rc::gen::tuple(coordinate, coordinate, coordinate));
    std::vector<glm::vec3> points;
    for (const auto& [x, y, z] : triples) points.emplace_back(x, y, z);
    // Makes the grid that of the coordinates, so that what is flat remains flat.
    points.emplace_back(0.0F, 0.0F, 0.0F);
    points.emplace_back(1.0F, 1.0F, 1.0F);
    const Mesh hull = convex_hull(points);
    if (hull.indices.empty()) {
        // All of them are in one plane.
        for (const glm::vec3& a : points)
            for (const glm::vec3& b : points)
                for (const glm::vec3& c : {points[0], points[1]})
                    RC_ASSERT(std::abs(glm::dot(glm::cross(a - points[0], b - points[0]),
                                                c - points[0])) < 1e-4F);
        return;
    }
    RC_ASSERT(defects(hull).empty());
    // A flat hull may have a volume below the rounding of its sum.
    RC_ASSERT(volume(hull) > -1e-9);
    // Euler's formula for a closed surface of triangles without handles.
    RC_ASSERT(hull.triangles() == 2 * hull.positions.size() - 4);
    for (const glm::vec3& point : points) RC_ASSERT(outside(hull, point) < 1e-4);
}

TEST(FarthestPoints, AreThoseOfTheHullThatReachFarthest) {
    const std::vector<glm::vec3> points = {
        {0.0F, 0.0F, 0.0F}, {0.0F, 3.0F, 0.0F}, {0.1F, 0.2F, 0.0F}, {5.0F, 0.0F, 0.0F}};
    const std::vector<glm::vec3> found = farthest_points(points, directions(1, 1));
    EXPECT_EQ(found, (std::vector<glm::vec3>{points[0], points[1], points[3]}));
    EXPECT_TRUE(farthest_points({}, directions(4, 3)).empty());
}

TEST(Directions, AreUnitVectorsAndDifferent) {
    const std::vector<glm::dvec3> all = directions(12, 5);
    ASSERT_EQ(all.size(), 62U);
    for (std::size_t i = 0; i < all.size(); ++i) {
        EXPECT_NEAR(glm::length(all[i]), 1.0, 1e-12);
        for (std::size_t j = 0; j < i; ++j) EXPECT_GT(glm::distance(all[i], all[j]), 0.1);
    }
}

}  // namespace
}  // namespace sporeprint::collision_convex_hull_test
