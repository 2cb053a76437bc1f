#include "core/geometry/axis.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <vector>

#include "core/math/elementary.h"

namespace sporeprint::geometry_axis_test {
namespace {

using Vectors = std::vector<glm::dvec3>;

/// Returns the error of the last frame of a helix of two turns, against the exact frame, which
/// rotates against
/// Frenet's by the torsion.
double helix_error(int steps) {
    constexpr double radius = 1.0, rise = 0.5;
    const double speed = std::sqrt(radius * radius + rise * rise);
    const double end = 4.0 * pi;
    const auto tangent = [&](double t) {
        return glm::dvec3(-radius * std::sin(t), radius * std::cos(t), rise) / speed;
    };
    const auto normal = [](double t) { return glm::dvec3(-std::cos(t), -std::sin(t), 0.0); };
    Vectors positions, tangents;
    for (int i = 0; i <= steps; ++i) {
        const double t = end * i / steps;
        positions.emplace_back(radius * std::cos(t), radius * std::sin(t), rise * t);
        tangents.push_back(tangent(t));
    }
    const glm::dvec3 found = rotation_minimising_normals(positions, tangents, normal(0.0)).back();
    const double angle = -rise / speed * end;  // torsion is rise / speed^2, arc length speed * t
    const glm::dvec3 binormal = glm::cross(tangent(end), normal(end));
    return glm::distance(found, std::cos(angle) * normal(end) + std::sin(angle) * binormal);
}

TEST(Axis, FramesOnAHelixConvergeToFourthOrder) {
    EXPECT_GT(helix_error(32) / helix_error(64), 14.0);
    EXPECT_GT(helix_error(64) / helix_error(128), 14.0);
    EXPECT_LT(helix_error(128), 1e-5);
}

TEST(Axis, FramesDoNotTwistAlongAPlanarCurve) {
    Vectors positions, tangents;
    for (int i = 0; i <= 50; ++i) {
        const double x = 0.1 * i;  // a sine, with inflections where Frenet's frame would flip
        positions.emplace_back(x, std::sin(x), 0.0);
        tangents.push_back(glm::normalize(glm::dvec3(1.0, std::cos(x), 0.0)));
    }
    const glm::dvec3 out_of_plane(0.0, 0.0, 1.0);
    for (const glm::dvec3& n : rotation_minimising_normals(positions, tangents, out_of_plane))
        EXPECT_LT(glm::distance(n, out_of_plane), 1e-14);
}

TEST(Axis, FramesStayUnitAndSquareEvenOverRepeatedPoints) {
    Vectors positions, tangents;
    for (int i = 0; i <= 2000; ++i) {
        const double t = 0.02 * (i / 2);  // every point twice
        positions.emplace_back(std::cos(t), std::sin(2.0 * t), std::sin(3.0 * t));
        tangents.push_back(glm::normalize(
            glm::dvec3(-std::sin(t), 2.0 * std::cos(2.0 * t), 3.0 * std::cos(3.0 * t))));
    }
    const glm::dvec3 first = glm::normalize(glm::cross(tangents[0], glm::dvec3(1.0, 0.0, 0.0)));
    const Vectors normals = rotation_minimising_normals(positions, tangents, first);
    ASSERT_EQ(normals.size(), positions.size());
    for (std::size_t i = 0; i < normals.size(); ++i) {
        EXPECT_NEAR(glm::length(normals[i]), 1.0, 1e-12);
        EXPECT_NEAR(glm::dot(normals[i], tangents[i]), 0.0, 1e-12);
    }
}

DeformationOf<Plain> bent(double degrees) {
    DeformationOf<Plain> deformation;
    deformation.bend_deg = degrees;
    return deformation;
}

double arc_length(const Axis& axis, double base, double top) {
    double arc = 0.0;
    glm::dvec3 last = axis.at(base).origin;
    constexpr int steps = 4000;
    for (int i = 1; i <= steps; ++i) {
        const glm::dvec3 next = axis.at(base + (top - base) * i / steps).origin;
        arc += glm::distance(last, next);
        last = next;
    }
    return arc;
}

TEST(Axis, BendTwistAndLeanKeepTheArcLength) {
    for (const double degrees : {0.0, 10.0, 45.0, 90.0})
        for (const double from : {0.0, 0.5}) {
            DeformationOf<Plain> deformation = bent(degrees);
            deformation.zone_from = from;
            deformation.lean_deg = 20.0;
            deformation.twist_deg = 120.0;
            const Axis axis({}, deformation, {0.3, 2.0}, -0.005, 0.12);
            EXPECT_NEAR(arc_length(axis, -0.005, 0.12), 0.125, 0.125e-6) << degrees;
        }
}

TEST(Axis, AnEvenBendIsAnArcOfACircle) {
    constexpr double height = 0.1;
    for (const double azimuth : {0.0, 1.0, 4.0}) {
        const Axis axis({}, bent(90.0), {azimuth, 0.0}, 0.0, height);
        const double radius = height / (0.5 * pi);
        for (double share = 0.0; share <= 1.0; share += 0.125) {
            const double angle = 0.5 * pi * share, out = radius * (1.0 - std::cos(angle));
            const glm::dvec3 expected(out * std::cos(azimuth), radius * std::sin(angle),
                                      out * std::sin(azimuth));
            EXPECT_LT(glm::distance(axis.at(share * height).origin, expected), 1e-7);
        }
        EXPECT_NEAR(axis.greatest_curvature() * radius, 1.0, 1e-3);
    }
}

TEST(Axis, NothingBendsOutsideTheZoneOfInfluence) {
    DeformationOf<Plain> deformation = bent(60.0);
    deformation.zone_from = 0.4;
    deformation.zone_to = 0.7;
    const Axis axis({}, deformation, {0.0, 0.0}, 0.0, 1.0);
    for (const double y : {0.0, 0.2, 0.39})
        EXPECT_LT(glm::distance(axis.at(y).origin, glm::dvec3(0.0, y, 0.0)), 1e-12);
    const glm::dvec3 above = axis.at(0.72).y;
    EXPECT_NEAR(std::acos(above.y), radians(60.0), 1e-6);
    for (const double y : {0.75, 0.9, 1.0})
        EXPECT_LT(glm::distance(axis.at(y).y, above), 1e-9) << "straight above the zone";
}

TEST(Axis, LeanTipsTheWholeRigidly) {
    DeformationOf<Plain> deformation;
    deformation.lean_deg = 30.0;
    const Axis axis({}, deformation, {0.0, 0.0}, 0.0, 1.0);
    const glm::dvec3 direction(std::sin(radians(30.0)), std::cos(radians(30.0)), 0.0);
    for (const double y : {0.0, 0.3, 1.0})
        EXPECT_LT(glm::distance(axis.at(y).origin, y * direction), 1e-12);
}

TEST(Axis, WithoutDeformationEveryPointStaysWhereItIs) {
    const Axis axis({}, {}, {1.0, 2.0}, -0.006, 0.133);
    for (const double y : {-0.006, 0.0, 0.05, 0.1329, 0.133})
        for (const glm::dvec3& p :
             {glm::dvec3(0.02, y, 0.0), glm::dvec3(-0.01, y, 0.01), glm::dvec3(0.0, y, 0.0)}) {
            const AxisStation station = axis.at(y);
            const glm::dvec3 there = station.point(p);
            EXPECT_EQ(there.x, p.x);
            EXPECT_EQ(there.z, p.z);
            EXPECT_NEAR(there.y, p.y, 1e-15);
        }
}

TEST(Axis, TwistAndTaperEndWhereTheirZoneEnds) {
    DeformationOf<Plain> deformation;
    deformation.twist_deg = 90.0;
    deformation.taper = 0.5;
    const Axis axis({}, deformation, {}, 0.0, 1.0);
    const AxisStation ground = axis.at(0.0), top = axis.at(1.0);
    EXPECT_LT(glm::distance(ground.x, glm::dvec3(1.3, 0.0, 0.0)), 1e-12);
    EXPECT_NEAR(glm::length(top.x), 1.0, 1e-12);
    EXPECT_NEAR(glm::dot(top.x, ground.x), 0.0, 1e-12);
    EXPECT_NEAR(std::abs(top.x.z), 1.0, 1e-12);
}

TEST(Axis, StationsAreRightHandedFramesWithTheirDerivatives) {
    DeformationOf<Plain> deformation = bent(50.0);
    deformation.twist_deg = 70.0;
    deformation.taper = -0.4;
    deformation.lean_deg = 10.0;
    deformation.zone_from = 0.2;
    const std::vector<AxisPoint> controls = {
        {0.0, 0.0, 0.0}, {0.1, 0.4, 0.05}, {-0.05, 0.8, 0.0}, {0.0, 1.0, 0.1}};
    const Axis axis(AxisCurve(controls), deformation, {0.7, 1.9}, 0.0, 0.1);
    for (double y = 0.0031; y < 0.1; y += 0.0093) {
        const AxisStation s = axis.at(y);
        const double size = glm::length(s.x);
        EXPECT_NEAR(glm::length(s.z), size, 1e-12);
        EXPECT_NEAR(glm::length(s.y), 1.0, 1e-12);
        EXPECT_LT(glm::distance(glm::cross(s.x, s.y), s.z), 1e-12);
        const double h = 1e-7;
        const auto difference = [&](auto member) {
            return (axis.at(y + h).*member - axis.at(y - h).*member) / (2.0 * h);
        };
        // Differences of a map that is smooth but for the joints between its 96 cells.
        EXPECT_LT(glm::distance(difference(&AxisStation::origin), s.d_origin), 2e-3);
        EXPECT_LT(glm::distance(difference(&AxisStation::x), s.d_x), 0.5);
        EXPECT_LT(glm::distance(difference(&AxisStation::z), s.d_z), 0.5);
        EXPECT_NEAR(glm::dot(s.d_origin, s.y), 1.0, 2e-3) << "height is arc length";
    }
}

TEST(Axis, AboveTheStemTheFrameIsFrozen) {
    const Axis axis({}, bent(40.0), {0.5, 0.0}, 0.0, 0.1);
    const AxisStation top = axis.at(0.1), above = axis.at(0.25), frozen = axis.frozen_at(0.25);
    EXPECT_EQ(above.origin, top.origin);
    EXPECT_EQ(above.x, top.x);
    EXPECT_EQ(frozen.height, 0.1);
    EXPECT_EQ(frozen.d_x, glm::dvec3(0.0));
    // A cap is moved rigidly: distances are preserved.
    const glm::dvec3 p(0.03, 0.11, 0.01), q(-0.02, 0.13, 0.04);
    EXPECT_NEAR(glm::distance(frozen.point(p), frozen.point(q)), glm::distance(p, q), 1e-12);
}

TEST(Axis, ATemplateAxisIsFollowedAndScaledToTheStem) {
    // A quarter of a circle of any size becomes an arc as long as the stem.
    std::vector<AxisPoint> controls;
    for (int i = 0; i <= 8; ++i) {
        const double angle = 0.5 * pi * i / 8.0;
        controls.push_back({1.7 * (1.0 - std::cos(angle)), 1.7 * std::sin(angle), 0.0});
    }
    const Axis axis(AxisCurve(controls), {}, {}, 0.0, 0.2);
    EXPECT_NEAR(arc_length(axis, 0.0, 0.2), 0.2, 1e-6);
    const double radius = 0.2 / (0.5 * pi);
    EXPECT_LT(glm::distance(axis.at(0.2).origin, glm::dvec3(radius, radius, 0.0)), 2e-3);
}

TEST(Axis, ATemplateAxisWithoutPointsIsStraight) {
    for (const std::vector<AxisPoint>& controls :
         {std::vector<AxisPoint>{{0.5, 0.5, 0.5}},
          std::vector<AxisPoint>{{0.5, 0.5, 0.5}, {0.5, 0.5, 0.5}}}) {
        const Axis axis(AxisCurve(controls), {}, {}, 0.0, 0.2);
        EXPECT_LT(glm::distance(axis.at(0.1).origin, glm::dvec3(0.0, 0.1, 0.0)), 1e-15);
    }
}

}  // namespace
}  // namespace sporeprint::geometry_axis_test
