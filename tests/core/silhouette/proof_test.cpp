#include "core/silhouette/proof.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <optional>

#include "core/math/random.h"

namespace sporeprint::silhouette_proof_test {
namespace {

/// Returns true if closed segments share a point, in integer arithmetic.
bool meets(const std::array<std::int64_t, 8>& s) {
    const auto side = [](std::int64_t ax, std::int64_t ay, std::int64_t bx, std::int64_t by,
                         std::int64_t cx, std::int64_t cy) {
        const std::int64_t area = (bx - ax) * (cy - ay) - (by - ay) * (cx - ax);
        return area > 0 ? 1 : area < 0 ? -1 : 0;
    };
    const auto within = [](std::int64_t a, std::int64_t b, std::int64_t x) {
        return std::min(a, b) <= x && x <= std::max(a, b);
    };
    const auto [ax, ay, bx, by, cx, cy, dx, dy] = s;
    const int abc = side(ax, ay, bx, by, cx, cy), abd = side(ax, ay, bx, by, dx, dy);
    const int cda = side(cx, cy, dx, dy, ax, ay), cdb = side(cx, cy, dx, dy, bx, by);
    if (abc * abd < 0 && cda * cdb < 0) return true;
    return (abc == 0 && within(ax, bx, cx) && within(ay, by, cy)) ||
           (abd == 0 && within(ax, bx, dx) && within(ay, by, dy)) ||
           (cda == 0 && within(cx, dx, ax) && within(cy, dy, ay)) ||
           (cdb == 0 && within(cx, dx, bx) && within(cy, dy, by));
}

/// Returns the first pair of non-adjacent segments that meet on a polyline of integer coordinates,
/// by testing every pair.
std::optional<std::array<std::size_t, 2>> first_meeting(const Polyline& line) {
    for (std::size_t i = 0; i + 1 < line.size(); ++i)
        for (std::size_t j = i + 2; j + 1 < line.size(); ++j) {
            std::array<std::int64_t, 8> s{};
            const glm::dvec2 ends[] = {line[i], line[i + 1], line[j], line[j + 1]};
            for (std::size_t k = 0; k < 4; ++k) {
                s[2 * k] = static_cast<std::int64_t>(ends[k].x);
                s[2 * k + 1] = static_cast<std::int64_t>(ends[k].y);
            }
            if (meets(s)) return {{i, j}};
        }
    return std::nullopt;
}

TEST(Proof, FirstCrossingAgreesWithExactArithmetic) {
    Random random(23, 0);
    int crossed = 0;
    for (int trial = 0; trial < 4000; ++trial) {
        // A small grid makes points touch, lie on segments and run along one another.
        const std::uint32_t grid = trial % 2 ? 7 : 1000;
        const std::size_t count = 3 + random.bits() % 7;
        std::vector<glm::dvec2> line;
        for (std::size_t i = 0; i < count; ++i) {
            const auto x = static_cast<double>(random.bits() % grid);
            const auto y = static_cast<double>(random.bits() % grid);
            line.emplace_back(x, y);
        }
        const auto expected = first_meeting(line);
        EXPECT_EQ(first_crossing(line), expected) << "trial " << trial;
        crossed += expected ? 1 : 0;
    }
    EXPECT_GT(crossed, 400);
    EXPECT_LT(crossed, 3600);
}

TEST(Proof, FindsTheFirstCrossingOfALongRandomWalk) {
    Random random(29, 0);
    int crossed = 0;
    for (int trial = 0; trial < 600; ++trial) {
        // The walk goes mostly upwards, so that it rarely crosses itself and its far parts are
        // separated.
        Polyline line = {{0.0, 0.0}};
        for (std::size_t i = 0; i < 40 + random.bits() % 40; ++i)
            line.push_back(line.back() + glm::dvec2(static_cast<double>(random.bits() % 9) - 4.0,
                                                    static_cast<double>(random.bits() % 50) - 1.0));
        const auto expected = first_meeting(line);
        EXPECT_EQ(first_crossing(line), expected) << "trial " << trial;
        crossed += expected ? 1 : 0;
    }
    EXPECT_GT(crossed, 50);
    EXPECT_LT(crossed, 500);
}

TEST(Proof, FewPointsNeverCross) {
    EXPECT_FALSE(first_crossing({}));
    EXPECT_FALSE(first_crossing(Polyline{{0.0, 0.0}}));
    EXPECT_FALSE(first_crossing(Polyline{{0.0, 0.0}, {1.0, 0.0}}));
    EXPECT_FALSE(first_crossing(Polyline{{0.0, 0.0}, {1.0, 0.0}, {0.5, 0.0}}));
}

/// Returns a stepped mushroom outline: simple, on the axis at both ends.
Polyline plain() {
    return {{0.0, 0.0}, {1.0, 0.0}, {1.0, 4.0}, {3.0, 4.0}, {3.0, 5.0}, {0.0, 6.0}};
}

Polyline mixed(std::span<const Polyline> shapes, std::span<const double> weights) {
    Polyline mix(shapes.front().size(), glm::dvec2(0.0));
    for (std::size_t s = 0; s < shapes.size(); ++s)
        for (std::size_t i = 0; i < mix.size(); ++i) mix[i] += weights[s] * shapes[s][i];
    return mix;
}

Polyline between(const Polyline& a, const Polyline& b, double t) {
    const std::array<Polyline, 2> both = {a, b};
    return mixed(both, std::array<double, 2>{1.0 - t, t});
}

/// Returns a random outline that is more often simple than not.
Polyline random_outline(Random& random, std::size_t count, double wildness) {
    Polyline line;
    for (std::size_t i = 0; i < count; ++i) {
        const double share = static_cast<double>(i) / static_cast<double>(count - 1);
        const double r = 4.0 * share * (1.0 - share) + wildness * random.uniform(-0.5, 0.5);
        const double y = share + wildness * random.uniform(-0.5, 0.5);
        const bool end = i == 0 || i + 1 == count;
        line.emplace_back(end ? 0.0 : std::max(r, 0.02), y);
    }
    return line;
}

std::vector<double> random_weights(Random& random, std::size_t count) {
    std::vector<double> weights;
    double sum = 0.0;
    for (std::size_t i = 0; i < count; ++i) {
        weights.push_back(-std::log(1.0 - random.uniform()));
        sum += weights.back();
    }
    for (double& weight : weights) weight /= sum;
    return weights;
}

TEST(Proof, StaticShapesAreChecked) {
    const Polyline simple = plain();
    EXPECT_FALSE(first_intersection(simple, simple));
    Polyline crossing = simple;
    crossing[4] = {0.5, 3.0};  // the cap dips into the stem
    const auto at_0 = first_intersection(crossing, simple);
    ASSERT_TRUE(at_0);
    EXPECT_EQ(at_0->t, 0.0);
    Polyline inside_out = simple;
    inside_out[2].x = -0.1;
    const auto beyond = first_intersection(inside_out, simple);
    ASSERT_TRUE(beyond);
    EXPECT_EQ(*beyond, (Intersection{0.0, 2, 2}));
}

TEST(Proof, FindsACrossingAtItsKnownMoment) {
    // The margin moves at constant speed to the far side of the stem: it touches the stem's surface
    // at x = 1, at the midpoint.
    Polyline a = {{0, 0}, {1, 0}, {1, 10}, {3, 10}, {2, 5}, {4, 11}, {0, 12}};
    Polyline b = a;
    b[4] = {0, 5};
    const auto intersection = first_intersection(a, b);
    ASSERT_TRUE(intersection);
    EXPECT_NEAR(intersection->t, 0.5, 1e-12);
    EXPECT_EQ(intersection->i, 1u);
    EXPECT_TRUE(intersection->j == 3u || intersection->j == 4u);
    EXPECT_FALSE(first_crossing(between(a, b, 0.4999)));
    EXPECT_TRUE(first_crossing(between(a, b, 0.5001)));
}

TEST(Proof, FindsACrossingBetweenTwoSimpleEnds) {
    // A spike runs past the tip of another: simple at both ends, touching in between.
    const Polyline a = {{0, 0}, {4, 0}, {4, 1}, {1, 1.4}, {4, 2}, {4, 4}, {0, 5}};
    for (const double far : {0.0, 1.0, 2.0}) {
        Polyline from = a, to = a;
        from[3] = {1.0, 1.4};
        to[3] = {1.0 + far, 1.4};
        EXPECT_FALSE(first_intersection(from, to)) << "a spike that only grows shorter";
    }
    // Two points swap sides: they touch at t = 1/2 only if they are at one height.
    const auto moves = [](double height) {
        Polyline from = {{0, 0}, {5, 0}, {2, 1}, {5, 2}, {5, 3}, {3, 3.5}, {5, 4}, {0, 5}};
        Polyline to = from;
        from[2].y = 1.0;
        to[2] = {2, 1.0 + height};
        return first_intersection(from, to);
    };
    EXPECT_FALSE(moves(0.2));
    EXPECT_TRUE(moves(5.0));
}

TEST(Proof, ANearMissIsNoIntersection) {
    const double slack = 1e-6;
    Polyline a = {{0, 0}, {1, 0}, {1, 10}, {3, 10}, {2, 5}, {4, 11}, {0, 12}};
    Polyline b = a;
    b[4] = {1.0 + slack, 5};
    EXPECT_FALSE(first_intersection(a, b));
    b[4] = {1.0 - slack, 5};
    EXPECT_TRUE(first_intersection(a, b));
}

TEST(Proof, AFoldBackIsFound) {
    // The middle vertex swings over the line of its neighbours through a spike of zero width.
    const Polyline a = {{0, 0}, {2, 0}, {4, 0.5}, {3, 1}, {0, 2}};
    Polyline b = a;
    b[3] = {3, -1};
    b[4] = {0, -2};
    const auto intersection = first_intersection(a, b);
    ASSERT_TRUE(intersection);
    EXPECT_EQ(intersection->j, intersection->i + 1);
}

TEST(Proof, ASubCurveMayShrinkToAPoint) {
    const Polyline a = {{0, 0}, {1, 0}, {1, 2}, {1.5, 2.2}, {2, 2}, {2.5, 1.5}, {2, 3}, {0, 4}};
    Polyline b = a;
    for (std::size_t i = 2; i <= 5; ++i) b[i] = {1.0, 2.0};
    b[6] = {1.1, 3.0};
    EXPECT_FALSE(first_intersection(a, b));
    EXPECT_FALSE(first_intersection(b, a));
    const std::array<Polyline, 2> both = {a, b};
    EXPECT_FALSE(first_unproven_pair(both));
}

TEST(Proof, AgreesWithFineSampling) {
    Random random(31, 0);
    int intersections = 0, none = 0;
    for (int trial = 0; trial < 1500; ++trial) {
        const std::size_t count = 5 + static_cast<std::size_t>(trial) % 5;
        const Polyline a = random_outline(random, count, 0.8),
                       b = random_outline(random, count, 0.8);
        if (first_crossing(a) || first_crossing(b)) continue;
        const auto intersection = first_intersection(a, b);
        (intersection ? intersections : none)++;
        double first_seen = 2.0;
        for (int step = 0; step <= 2000 && first_seen > 1.0; ++step)
            if (first_crossing(between(a, b, step / 2000.0))) first_seen = step / 2000.0;
        if (first_seen <= 1.0) {
            ASSERT_TRUE(intersection) << "trial " << trial << " crosses at " << first_seen;
            EXPECT_LE(intersection->t, first_seen + 1e-9) << "trial " << trial;
        }
        if (intersection && intersection->j > intersection->i + 1) {
            // At the reported moment the two segments are within rounding of each other.
            const Polyline at = between(a, b, intersection->t);
            const auto distance = [&](std::size_t p, std::size_t s) {
                const glm::dvec2 along = at[s + 1] - at[s];
                const double u =
                    std::clamp(glm::dot(at[p] - at[s], along) / glm::dot(along, along), 0.0, 1.0);
                const glm::dvec2 off = at[p] - at[s] - u * along;
                return std::sqrt(glm::dot(off, off));
            };
            const std::size_t i = intersection->i, j = intersection->j;
            EXPECT_LT(
                std::min({distance(i, j), distance(i + 1, j), distance(j, i), distance(j + 1, i)}),
                1e-6);
        }
    }
    EXPECT_GT(intersections, 50);
    EXPECT_GT(none, 50);
}

/// Returns the earliest moment at which an end of one segment is on another, or 2 if never, by
/// testing every pair with the roots of the parabola through three moments.
double first_touch_of_all(const Polyline& a, const Polyline& b) {
    double first = 2.0;
    const auto consider = [&](std::size_t x, std::size_t y, std::size_t z) {
        const auto sides = [&](double t) {
            const glm::dvec2 o = a[x] + t * (b[x] - a[x]);
            return std::array{a[y] + t * (b[y] - a[y]) - o, a[z] + t * (b[z] - a[z]) - o};
        };
        const auto area = [&](double t) {
            const auto [u, v] = sides(t);
            return u.x * v.y - u.y * v.x;
        };
        const double c = area(0.0), half = area(0.5), end = area(1.0);
        const double p = 2.0 * c - 4.0 * half + 2.0 * end, q = 4.0 * half - 3.0 * c - end;
        const double root = q * q - 4.0 * p * c;
        if (root < 0.0) return;
        for (const double sign : {-1.0, 1.0}) {
            const double t = (-q + sign * std::sqrt(root)) / (2.0 * p);
            if (!(t > 0.0 && t < first && t < 1.0)) continue;
            const auto [u, v] = sides(t);
            if (glm::dot(u, v) <= 0.0) first = t;
        }
    };
    for (std::size_t i = 0; i + 1 < a.size(); ++i)
        for (std::size_t j = i + 2; j + 1 < a.size(); ++j) {
            consider(i, j, j + 1);
            consider(i + 1, j, j + 1);
            consider(j, i, i + 1);
            consider(j + 1, i, i + 1);
        }
    return first;
}

TEST(Proof, FindsEveryTouchOfLongOutlines) {
    Random random(43, 0);
    int touched = 0, none = 0;
    for (int trial = 0; trial < 300; ++trial) {
        const std::size_t count = 20 + random.bits() % 50;
        const double wildness = 0.9 / static_cast<double>(count) * (1 + trial % 3);
        Polyline a = random_outline(random, count, wildness),
                 b = random_outline(random, count, wildness);
        for (glm::dvec2& p : b) p.y *= 2.0;
        if (trial % 2) {  // a vertex that runs through the far side
            const std::size_t i = 1 + random.bits() % (count - 2);
            b[i] = {random.uniform(0.1, 2.0), random.uniform(0.0, 2.0)};
        }
        const double expected = first_touch_of_all(a, b);
        const auto intersection = intersection_between(a, b);
        ASSERT_EQ(intersection.has_value() && intersection->j > intersection->i + 1,
                  expected < 1.0 && !(intersection && intersection->j == intersection->i + 1))
            << "trial " << trial;
        (expected < 1.0 ? touched : none)++;
        if (intersection && intersection->j > intersection->i + 1) {
            EXPECT_NEAR(intersection->t, expected, 1e-7);
        }
    }
    EXPECT_GT(touched, 50);
    EXPECT_GT(none, 50);
}

TEST(Proof, UnprovenPairsIncludeEveryCrossingOfEveryMean) {
    Random random(47, 0);
    int crossings = 0;
    for (int trial = 0; trial < 200; ++trial) {
        std::vector<Polyline> shapes(2 + static_cast<std::size_t>(trial) % 4);
        for (Polyline& shape : shapes) shape = random_outline(random, 30, 0.03 * (1 + trial % 5));
        const std::vector<UnprovenPair> all = unproven_pairs(shapes);
        const auto first = first_unproven_pair(shapes);
        ASSERT_EQ(first.has_value(), !all.empty());
        if (first) {
            EXPECT_EQ(*first, all.front());
        }
        for (int draw = 0; draw < 20; ++draw) {
            const auto pair = first_crossing(mixed(shapes, random_weights(random, shapes.size())));
            if (!pair) continue;
            ++crossings;
            EXPECT_NE(std::find(all.begin(), all.end(), UnprovenPair{(*pair)[0], (*pair)[1]}),
                      all.end())
                << "trial " << trial;
        }
    }
    EXPECT_GT(crossings, 200);
}

TEST(Proof, UnprovenPairsOfMeansAreAmongThoseOfTheirShapes) {
    Random random(53, 0);
    std::size_t dispelled = 0, left = 0;
    for (int trial = 0; trial < 200; ++trial) {
        std::vector<Polyline> shapes(2 + static_cast<std::size_t>(trial) % 9);
        const std::size_t count = 10 + random.bits() % 40;
        for (Polyline& shape : shapes) {
            shape = random_outline(random, count, 0.02 * (1 + trial % 6));
            if (trial % 3 == 0)  // a sub-curve that is a point
                for (std::size_t i = 4; i < 8; ++i) shape[i] = shape[3];
        }
        std::vector<Polyline> means;
        for (std::size_t s = 0; s < shapes.size(); ++s)
            means.push_back(mixed(shapes, random_weights(random, shapes.size())));
        const std::vector<UnprovenPair> known = unproven_pairs(shapes), own = unproven_pairs(means);
        EXPECT_EQ(unproven_pairs(means, known), own) << "trial " << trial;
        dispelled += known.size() - own.size();
        left += own.size();
    }
    EXPECT_GT(dispelled, 1000u);
    EXPECT_GT(left, 100u);
}

TEST(Proof, CertificatesHoldOnRandomConvexCombinations) {
    Random random(37, 0);
    int certified = 0, doubted = 0;
    for (int trial = 0; trial < 400; ++trial) {
        const std::size_t count = 5 + static_cast<std::size_t>(trial) % 6;
        std::vector<Polyline> shapes(2 + static_cast<std::size_t>(trial) % 4);
        for (Polyline& shape : shapes)
            shape = random_outline(random, count, 0.1 + 0.15 * (trial % 5));
        if (first_unproven_pair(shapes)) {
            ++doubted;
            continue;
        }
        ++certified;
        for (int draw = 0; draw < 60; ++draw) {
            const Polyline mix = mixed(shapes, random_weights(random, shapes.size()));
            EXPECT_FALSE(first_crossing(mix)) << "trial " << trial;
            for (std::size_t i = 1; i + 1 < mix.size(); ++i) EXPECT_GT(mix[i].x, 0.0);
        }
        for (std::size_t s = 1; s < shapes.size(); ++s)
            EXPECT_FALSE(first_intersection(shapes[0], shapes[s])) << "trial " << trial;
    }
    EXPECT_GT(certified, 50);
    EXPECT_GT(doubted, 50);
}

TEST(Proof, ATurningPairIsCertifiedByASeparatingLine) {
    // Two parallel strokes turn together by 80 degrees: no fixed direction separates them, but each
    // stays on its side of the other.
    std::vector<Polyline> shapes;
    for (const double degrees : {-40.0, 0.0, 40.0}) {
        const double c = std::cos(degrees * 0.0174532925), s = std::sin(degrees * 0.0174532925);
        const auto turned = [&](double x, double y) {
            return glm::dvec2(5.0 + c * x - s * y, 5.0 + s * x + c * y);
        };
        shapes.push_back({{0, -9},
                          turned(-1.0, 0.0),
                          turned(1.0, 0.0),
                          turned(3.0, 0.5),
                          turned(1.0, 1.0),
                          turned(-1.0, 1.0),
                          {0, 30}});
    }
    EXPECT_FALSE(first_unproven_pair(shapes));
    Random random(41, 0);
    for (int draw = 0; draw < 500; ++draw)
        EXPECT_FALSE(first_crossing(mixed(shapes, random_weights(random, 3))));
    // By a half turn they change places: nothing may certify that.
    for (glm::dvec2& p : shapes[2])
        if (p.x > 0.0) p = glm::dvec2(10.0, 10.0) - p;
    EXPECT_TRUE(first_unproven_pair(shapes));
}

}  // namespace
}  // namespace sporeprint::silhouette_proof_test
