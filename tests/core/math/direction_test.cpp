#include "core/math/direction.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "core/math/elementary.h"
#include "core/math/random.h"

namespace sporeprint::math_direction_test {
namespace {

glm::dvec3 drawn(Random& random) {
    glm::dvec3 v(0.0);
    v.x = random.symmetric();
    v.y = random.symmetric();
    v.z = random.symmetric();
    return v;
}

TEST(Direction, IsTransportedByTheSmallestRotation) {
    Random random(7, 1, 0);
    for (int i = 0; i < 200; ++i) {
        const glm::dvec3 from = glm::normalize(drawn(random)), to = glm::normalize(drawn(random)),
                         v = drawn(random);
        if (glm::dot(from, to) < -0.99) continue;
        const glm::dvec3 there = carried(v, from, to);
        EXPECT_NEAR(glm::length(there), glm::length(v), 1e-9);
        EXPECT_NEAR(glm::dot(there, to), glm::dot(v, from), 1e-9) << "as far from the heading";
        const glm::dvec3 axis = glm::cross(from, to);
        EXPECT_NEAR(glm::dot(there, axis), glm::dot(v, axis), 1e-9) << "no twist";
        EXPECT_LT(glm::distance(carried(from, from, to), to), 1e-9);
        EXPECT_EQ(carried(v, from, from), v);
    }
    EXPECT_EQ(carried({0, 0, 1}, {0, 1, 0}, {0, -1, 0}), glm::dvec3(0, 0, 1));
}

TEST(Direction, PerpendicularVectorsRotateRightHanded) {
    EXPECT_LT(glm::distance(turned_square({1, 0, 0}, {0, 0, 1}, pi / 2), glm::dvec3(0, 1, 0)),
              1e-12);
    Random random(7, 2, 0);
    for (int i = 0; i < 200; ++i) {
        const glm::dvec3 axis = glm::normalize(drawn(random)), v = drawn(random),
                         flat = square_to(axis, v);
        EXPECT_NEAR(glm::length(flat), 1.0, 1e-12);
        EXPECT_NEAR(glm::dot(flat, axis), 0.0, 1e-9);
        EXPECT_GE(glm::dot(flat, v), 0.0);
        EXPECT_NEAR(glm::dot(turned_square(flat, axis, 0.7), flat), sine_cosine(0.7).cosine, 1e-9);
    }
    EXPECT_NEAR(glm::dot(square_to({0, 1, 0}, {0, 2, 0}), glm::dvec3(0, 1, 0)), 0.0, 1e-12);
    // A direction of nearly no length still gives a perpendicular.
    EXPECT_NEAR(glm::dot(square_to({0, 1, 0}, {0, 1e-17, 1e-17}), glm::dvec3(0, 1, 0)), 0.0, 1e-12);
    EXPECT_NEAR(glm::dot(square_to({0.6, 0.8, 0}, {0, 0, 1e-17}), glm::dvec3(0.6, 0.8, 0)), 0.0,
                1e-12);
}

// Whatever the rotation, also by half a turn, where the real part is nothing.
TEST(Direction, QuaternionsTurnAsTheirMatrices) {
    Random random(9, 1, 0);
    for (int i = 0; i < 200; ++i) {
        const glm::dvec3 up = glm::normalize(drawn(random)), along = square_to(up, drawn(random));
        glm::dmat3 turn(glm::cross(up, along), up, along);
        if (i == 0) turn = glm::dmat3(-1, 0, 0, 0, -1, 0, 0, 0, 1);
        if (i == 1) turn = glm::dmat3(1);
        const glm::dvec4 q = quaternion_of(turn);
        EXPECT_NEAR(glm::dot(q, q), 1.0, 1e-12);
        const glm::dvec3 v = drawn(random);
        EXPECT_LT(glm::distance(rotated(q, v), turn * v), 1e-12);
    }
}

}  // namespace
}  // namespace sporeprint::math_direction_test
