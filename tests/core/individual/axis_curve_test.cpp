#include "core/individual/axis_curve.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <vector>

#include "core/geometry/axis.h"
#include "core/math/elementary.h"

namespace sporeprint::individual_axis_curve_test {
namespace {

/// Returns an arc of a circle that turns by `angle` towards azimuth `towards`.
AxisCurve arc(double angle, double towards = 0.0) {
    std::vector<AxisPoint> controls;
    for (int i = 0; i <= 64; ++i) {
        const double a = angle * i / 64.0, out = (1.0 - std::cos(a)) / angle;
        controls.push_back({out * std::cos(towards), std::sin(a) / angle, out * std::sin(towards)});
    }
    return AxisCurve(controls);
}

AxisCurve blend_of(const std::vector<std::pair<AxisCurve, double>>& parts) {
    AxisCurve blend;
    for (const auto& [curve, weight] : parts) blend.add(curve, weight);
    return blend;
}

double farthest(const AxisCurve& a, const AxisCurve& b) {
    const auto s = a.tangents(), t = b.tangents();
    double most = 0.0;
    for (std::size_t i = 0; i < s.size(); ++i) most = std::max(most, glm::distance(s[i], t[i]));
    return most;
}

TEST(AxisCurve, IsStraightWithoutControlPoints) {
    for (const AxisCurve& straight :
         {AxisCurve(), AxisCurve({{0.0, 0.0, 0.0}, {0.0, 0.5, 0.0}, {0.0, 1.0, 0.0}}),
          AxisCurve({{0.3, 0.0, 0.1}})}) {
        for (const glm::dvec3& tangent : straight.tangents())
            EXPECT_LT(glm::distance(tangent, glm::dvec3(0.0, 1.0, 0.0)), 1e-12);
        EXPECT_LT(straight.greatest_turn(), 1e-12);
    }
}

TEST(AxisCurve, FollowsItsControlPoints) {
    const auto tangents = arc(0.5 * pi).tangents();
    ASSERT_EQ(tangents.size(), AxisCurve::stations + 1u);
    for (std::size_t i = 0; i < tangents.size(); ++i) {
        const double angle = 0.5 * pi * static_cast<double>(i) / AxisCurve::stations;
        EXPECT_LT(glm::distance(tangents[i], glm::dvec3(std::sin(angle), std::cos(angle), 0.0)),
                  0.02);
        EXPECT_NEAR(glm::length(tangents[i]), 1.0, 1e-14);
    }
    // The spline starts along its first chord, so it turns a little faster there.
    EXPECT_GE(arc(0.5 * pi).greatest_turn(), 0.5 * pi);
    EXPECT_LE(arc(0.5 * pi).greatest_turn(), pi);
}

TEST(AxisCurve, OppositeBendsCancelAndKeepTheLength) {
    for (const double angle : {0.4, 1.0, 1.5})
        for (const double towards : {0.0, 2.2}) {
            const AxisCurve one = arc(angle, towards), other = arc(angle, towards + pi);
            EXPECT_GT(farthest(one, AxisCurve()), 0.3);
            const AxisCurve half = blend_of({{one, 0.5}, {other, 0.5}});
            EXPECT_LT(farthest(half, AxisCurve()), 1e-12);
            // For all weights the axis is as long as its stem and nowhere more curved than the
            // ends.
            for (const double t : {0.1, 0.3, 0.5, 0.8}) {
                const AxisCurve between = blend_of({{one, 1.0 - t}, {other, t}});
                EXPECT_LE(between.greatest_turn(), one.greatest_turn() + 1e-12);
                const Axis axis(between, {}, {}, 0.0, 0.1);
                double length = 0.0;
                for (int i = 0; i < 2000; ++i)
                    length += glm::distance(axis.at(0.1 * i / 2000).origin,
                                            axis.at(0.1 * (i + 1) / 2000).origin);
                EXPECT_NEAR(length, 0.1, 1e-7);
            }
        }
}

TEST(AxisCurve, HalfABendHasHalfTheAngle) {
    const AxisCurve half = blend_of({{arc(1.2), 0.5}, {AxisCurve(), 0.5}});
    EXPECT_EQ(half, arc(1.2).scaled(0.5));
    const glm::dvec3 end = half.tangents().back(), whole = arc(1.2).tangents().back();
    EXPECT_NEAR(std::atan2(end.x, end.y), 0.5 * std::atan2(whole.x, whole.y), 1e-12);
    EXPECT_NEAR(end.z, 0.0, 1e-14);
}

TEST(AxisCurve, ABlendWithItselfIsUnchanged) {
    const AxisCurve bent({{0.0, 0.0, 0.0}, {0.1, 0.4, 0.05}, {-0.05, 0.8, 0.1}, {0.2, 1.0, 0.3}});
    EXPECT_LT(farthest(blend_of({{bent, 0.2}, {bent, 0.3}, {bent, 0.5}}), bent), 1e-12);
}

TEST(AxisCurve, BlendsOfManyDoNotDependOnTheirOrder) {
    const AxisCurve a = arc(1.0), b = arc(0.7, 1.9), c = arc(1.4, 4.0);
    EXPECT_LT(farthest(blend_of({{a, 0.2}, {b, 0.5}, {c, 0.3}}),
                       blend_of({{c, 0.3}, {a, 0.2}, {b, 0.5}})),
              1e-14);
}

TEST(AxisCurve, FollowsReversals) {
    // The axis goes straight up, then straight down: the smallest rotation is not unique.
    const AxisCurve back({{0.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 0.0}});
    for (const glm::dvec3& tangent : back.tangents()) EXPECT_NEAR(glm::length(tangent), 1.0, 1e-12);
    EXPECT_LT(glm::distance(back.tangents().back(), glm::dvec3(0.0, -1.0, 0.0)), 1e-9);
}

}  // namespace
}  // namespace sporeprint::individual_axis_curve_test
