#include "core/math/principal_axes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "core/math/random.h"

namespace sporeprint::math_principal_axes_test {
namespace {

glm::dmat3 product(const glm::dvec3& a, const glm::dvec3& b) { return {a * b.x, a * b.y, a * b.z}; }

TEST(PrincipalAxes, OfADiagonalMatrixAreTheCoordinateAxesByVariance) {
    glm::dmat3 matrix(0.0);
    matrix[0][0] = 1.0;
    matrix[1][1] = 9.0;
    matrix[2][2] = 4.0;
    const PrincipalAxes axes = principal_axes(matrix);
    EXPECT_EQ(axes.directions[0], glm::dvec3(0.0, 1.0, 0.0));
    EXPECT_EQ(axes.directions[1], glm::dvec3(0.0, 0.0, 1.0));
    EXPECT_EQ(axes.directions[2], glm::dvec3(1.0, 0.0, 0.0));
    EXPECT_EQ(axes.variances, (std::array<double, 3>{9.0, 4.0, 1.0}));
}

TEST(PrincipalAxes, ComposeTheMatrixThatTheyCameFrom) {
    Random random(3, 1, 0);
    for (int i = 0; i < 300; ++i) {
        // Sums of one, two or many outer products: lines, planes and bodies.
        glm::dmat3 matrix(0.0);
        for (int k = 0; k <= i % 5; ++k) {
            glm::dvec3 v(0.0);
            for (int axis = 0; axis < 3; ++axis) v[axis] = random.symmetric();
            matrix += product(v, v);
        }
        const PrincipalAxes axes = principal_axes(matrix);
        glm::dmat3 again(0.0);
        for (std::size_t k = 0; k < 3; ++k) {
            EXPECT_NEAR(glm::length(axes.directions[k]), 1.0, 1e-12);
            EXPECT_NEAR(glm::dot(axes.directions[k], axes.directions[(k + 1) % 3]), 0.0, 1e-12);
            EXPECT_GE(axes.variances[k], 0.0);
            again += axes.variances[k] * product(axes.directions[k], axes.directions[k]);
        }
        EXPECT_GE(axes.variances[0], axes.variances[1]);
        EXPECT_GE(axes.variances[1], axes.variances[2]);
        for (int x = 0; x < 3; ++x)
            for (int y = 0; y < 3; ++y) EXPECT_NEAR(again[x][y], matrix[x][y], 1e-12);
    }
}

TEST(PrincipalAxes, OfNothingAreTheCoordinateAxes) {
    const PrincipalAxes axes = principal_axes(glm::dmat3(0.0));
    EXPECT_EQ(axes.directions[2], glm::dvec3(0.0, 0.0, 1.0));
    EXPECT_EQ(axes.variances[0], 0.0);
}

}  // namespace
}  // namespace sporeprint::math_principal_axes_test
