#include "core/math/spline.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "core/math/random.h"
#include "core/silhouette/outline.h"
#include "core/silhouette/proof.h"

namespace sporeprint::math_spline_test {
namespace {

using Points = std::vector<glm::dvec3>;

Points random_points(std::uint32_t seed, int count) {
    Random random(seed, 0);
    Points points;
    for (int i = 0; i < count; ++i) {
        const double x = random.symmetric();
        const double y = random.symmetric();
        const double z = random.symmetric();
        points.emplace_back(x, y, z);
    }
    return points;
}

TEST(Spline, PassesThroughItsControlPoints) {
    for (std::uint32_t seed = 0; seed < 50; ++seed) {
        const Points points = random_points(seed, 7);
        const auto segments = open_spline(points);
        ASSERT_EQ(segments.size(), 6u);
        for (std::size_t i = 0; i < segments.size(); ++i) {
            EXPECT_EQ(segments[i].at(0.0).position, points[i]);
            EXPECT_LT(glm::distance(segments[i].at(1.0).position, points[i + 1]), 1e-14);
        }
    }
}

TEST(Spline, IsContinuouslyDifferentiableInItsCentripetalParameter) {
    for (std::uint32_t seed = 0; seed < 50; ++seed) {
        const Points points = random_points(seed, 7);
        const auto segments = open_spline(points);
        for (std::size_t i = 0; i + 1 < segments.size(); ++i) {
            const double before = centripetal_step(points[i], points[i + 1]);
            const double after = centripetal_step(points[i + 1], points[i + 2]);
            const glm::dvec3 arriving = segments[i].at(1.0).derivative / before;
            const glm::dvec3 leaving = segments[i + 1].at(0.0).derivative / after;
            EXPECT_LT(glm::distance(arriving, leaving), 1e-12);
        }
    }
}

TEST(Spline, DerivativesAgreeWithFiniteDifferences) {
    const auto segments = open_spline(random_points(3, 6));
    constexpr double h = 1e-5;
    for (const auto& segment : segments)
        for (double t = 0.1; t < 0.95; t += 0.1) {
            const auto sample = segment.at(t);
            const auto ahead = segment.at(t + h), behind = segment.at(t - h);
            EXPECT_LT(
                glm::distance((ahead.position - behind.position) / (2.0 * h), sample.derivative),
                1e-8);
            EXPECT_LT(glm::distance((ahead.derivative - behind.derivative) / (2.0 * h),
                                    sample.second_derivative),
                      1e-8);
        }
}

TEST(Spline, IsStraightThroughCollinearPoints) {
    const glm::dvec3 direction(1.0, 2.0, -0.5);
    Points points;
    for (const double at : {0.0, 0.1, 1.0, 1.3, 4.0}) points.push_back(at * direction);
    for (const auto& segment : open_spline(points))
        for (double t = 0.0; t <= 1.0; t += 0.125) {
            const auto sample = segment.at(t);
            EXPECT_LT(glm::length(glm::cross(sample.position, direction)), 1e-12);
            EXPECT_GE(glm::dot(sample.derivative, direction), 0.0) << "never runs back";
        }
}

TEST(Spline, TwoPointsMakeALine) {
    const auto segments = open_spline({{1.0, 0.0, 0.0}, {3.0, 1.0, 0.0}});
    ASSERT_EQ(segments.size(), 1u);
    EXPECT_LT(glm::distance(segments[0].at(0.5).position, glm::dvec3(2.0, 0.5, 0.0)), 1e-15);
}

TEST(Spline, CoincidentPointsGiveFiniteNumbers) {
    const glm::dvec3 a(0.0), b(1.0, 0.0, 0.0);
    for (const Points& points : {Points{a, a, b}, Points{a, b, b, a}, Points{a, a, a}})
        for (const auto& segment : open_spline(points))
            for (double t = 0.0; t <= 1.0; t += 0.25) {
                const auto sample = segment.at(t);
                EXPECT_TRUE(std::isfinite(glm::dot(sample.position, sample.position)));
                EXPECT_TRUE(std::isfinite(glm::dot(sample.derivative, sample.derivative)));
            }
}

// [Yuksel2011]: of all Catmull-Rom curves, the centripetal one has neither cusps nor loops within a
// segment.
TEST(Spline, NoInnerSegmentHasACuspOrALoop) {
    Random random(5, 0);
    for (int trial = 0; trial < 500; ++trial) {
        glm::dvec2 p[4];
        for (glm::dvec2& point : p) {
            // Steps of very different lengths make other parametrisations loop.
            const double scale = trial % 2 ? 1.0 : random.uniform(0.01, 3.0);
            const double x = random.symmetric();
            const double y = random.symmetric();
            point = scale * glm::dvec2(x, y);
        }
        const double step = centripetal_step(p[1], p[2]);
        const SplineSegment<glm::dvec2> segment{p[1], p[2],
                                                step * centripetal_velocity(p[0], p[1], p[2]),
                                                step * centripetal_velocity(p[1], p[2], p[3])};
        std::vector<glm::dvec2> polyline;
        for (int i = 0; i <= 64; ++i) {
            const auto sample = segment.at(i / 64.0);
            EXPECT_GT(glm::length(sample.derivative), 0.0);
            polyline.push_back(sample.position);
        }
        EXPECT_FALSE(first_crossing(polyline)) << "trial " << trial;
    }
}

TEST(Spline, FollowsACircleToFourthOrder) {
    const auto error = [](int count) {
        Points points;
        for (int i = 0; i < count; ++i) {
            const double angle = 2.0 * 3.14159265358979323846 * i / count;
            points.emplace_back(std::cos(angle), std::sin(angle), 0.0);
        }
        const auto segments = open_spline(points);
        double worst = 0.0;
        for (std::size_t i = 1; i + 1 < segments.size(); ++i)  // the ends have one neighbour only
            for (double t = 0.0; t <= 1.0; t += 0.0625)
                worst = std::max(worst, std::abs(glm::length(segments[i].at(t).position) - 1.0));
        return worst;
    };
    EXPECT_GT(error(16) / error(32), 14.0);
    EXPECT_GT(error(32) / error(64), 14.0);
}

}  // namespace
}  // namespace sporeprint::math_spline_test
