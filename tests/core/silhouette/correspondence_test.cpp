#include "core/silhouette/correspondence.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/math/elementary.h"
#include "core/math/random.h"
#include "tests/support/orders.h"

namespace sporeprint::silhouette_correspondence_test {
namespace {

Edges random_edges(Random& random, std::size_t count) {
    Edges edges;
    edges.length = random.uniform(0.2, 1.0);
    double heading = random.uniform(-1.0, 1.0);
    for (std::size_t i = 0; i < count; ++i) {
        heading += random.uniform(-1.5, 1.5);
        const auto [s, c] = sine_cosine(heading);
        edges.directions.emplace_back(c, s);
    }
    return edges;
}

Link between(const Link& from, const Link& to) { return {to.a - from.a, to.b - from.b}; }

double work_of(const std::vector<Link>& links, const Edges& a, const Edges& b,
               const BlendWork& work) {
    double sum = 0.0;
    for (std::size_t k = 1; k < links.size(); ++k)
        sum += work.step(a, b, static_cast<std::size_t>(links[k - 1].a),
                         static_cast<std::size_t>(links[k - 1].b), between(links[k - 1], links[k]));
    return sum;
}

bool is_a_step(const Link& step) {
    return std::find(link_steps.begin(), link_steps.end(), step) != link_steps.end();
}

/// Returns the least work over all monotone chains by enumeration.
double least_by_enumeration(const Edges& a, const Edges& b, const BlendWork& work) {
    const int n = static_cast<int>(a.directions.size());
    double least = std::numeric_limits<double>::infinity();
    std::vector<Link> chain{{0, 0}};
    const auto extend = [&](const auto& self) -> void {
        const Link end = chain.back();
        if (end == Link{n, n}) {
            least = std::min(least, work_of(chain, a, b, work));
            return;
        }
        for (const Link& step : link_steps) {
            if (end.a + step.a > n || end.b + step.b > n) continue;
            chain.push_back({end.a + step.a, end.b + step.b});
            self(self);
            chain.pop_back();
        }
    };
    extend(extend);
    return least;
}

TEST(Correspondence, LinksAreOptimalAgainstEveryMonotoneChain) {
    Random random(5, 0);
    for (int trial = 0; trial < 120; ++trial) {
        const std::size_t count = 1 + static_cast<std::size_t>(trial) % 9;
        const Edges a = random_edges(random, count), b = random_edges(random, count);
        BlendWork work;
        work.stretch = random.uniform(0.01, 3.0);
        work.bend = random.uniform(0.1, 4.0);
        work.share_of_long = random.uniform(0.1, 0.9);
        const auto links = least_work_links(a, b, work);
        const double least = least_by_enumeration(a, b, work);
        EXPECT_NEAR(work_of(links, a, b, work), least, 1e-12 * least) << "trial " << trial;
    }
}

TEST(Correspondence, LinksAreMonotoneAndEndAtTheEnds) {
    Random random(6, 0);
    for (int trial = 0; trial < 50; ++trial) {
        const Edges a = random_edges(random, 48), b = random_edges(random, 48);
        const auto links = least_work_links(a, b);
        EXPECT_EQ(links.front(), (Link{0, 0}));
        EXPECT_EQ(links.back(), (Link{48, 48}));
        for (std::size_t k = 1; k < links.size(); ++k)
            EXPECT_TRUE(is_a_step(between(links[k - 1], links[k])));
    }
}

TEST(Correspondence, SwappingTheCurvesSwapsTheLinks) {
    Random random(7, 0);
    for (int trial = 0; trial < 50; ++trial) {
        Edges a = random_edges(random, 20), b = random_edges(random, 20);
        if (trial % 2) {  // few directions, many ties
            for (auto* edges : {&a, &b})
                for (glm::dvec2& d : edges->directions)
                    d = d.x > 0.0 ? glm::dvec2(1.0, 0.0) : glm::dvec2(0.0, 1.0);
            b.length = a.length;
        }
        auto swapped = least_work_links(b, a);
        for (Link& link : swapped) std::swap(link.a, link.b);
        EXPECT_EQ(least_work_links(a, b), swapped) << "trial " << trial;
    }
}

TEST(Correspondence, ACurveCorrespondsToItselfPointByPoint) {
    Random random(8, 0);
    const Edges a = random_edges(random, 30);
    for (const Link& link : least_work_links(a, a)) EXPECT_EQ(link.a, link.b);
    const Outline outline(
        silhouette_of(swept_atlas().entries().front().species.stages.back().model));
    const ShareMap map = correspondence(outline.cap, outline.cap);
    for (int i = 0; i <= 100; ++i) EXPECT_NEAR(map(i / 100.0).at, i / 100.0, 1e-12);
}

/// Returns a curve of length 1 that turns by an angle, radians, at one place.
SubCurve bent_at(double share, double angle) {
    const auto [s, c] = sine_cosine(angle);
    const glm::dvec2 before(share, 0.0), after = (1.0 - share) * glm::dvec2(c, s);
    return SubCurve({{{0.0, 0.0}, before, before, before}, {before, before + after, after, after}});
}

TEST(Correspondence, FeaturesAreMatchedToFeatures) {
    for (const double angle : {1.0, 1.4, -2.0}) {
        const SubCurve one = bent_at(0.4, angle), two = bent_at(0.55, angle);
        EXPECT_NEAR(correspondence(one, two)(0.4).at, 0.55, 0.03) << angle;
        EXPECT_NEAR(correspondence(two, one)(0.55).at, 0.4, 0.03) << angle;
    }
    // The gain has to exceed the work: a slight turn nearly stays where it is.
    EXPECT_NEAR(correspondence(bent_at(0.3, 0.3), bent_at(0.7, 0.3))(0.3).at, 0.3, 0.06);
}

TEST(Correspondence, WithoutGainTheMatchIsByArcLength) {
    const auto arc = [](double radius, double from, double to) {
        std::vector<SplineSegment<glm::dvec2>> segments;
        for (int i = 0; i < 40; ++i) {
            const auto at = [&](int k) {
                const auto [s, c] = sine_cosine(from + (to - from) * k / 40.0);
                return radius * glm::dvec2(s, c);
            };
            segments.push_back({at(i), at(i + 1), at(i + 1) - at(i), at(i + 1) - at(i)});
        }
        return SubCurve(std::move(segments));
    };
    const SubCurve ball = arc(1.0, 3.0, 0.0);
    for (const SubCurve& other : {arc(7.0, 3.0, 0.0), arc(1.0, 2.9, 0.0), arc(2.0, 2.0, 0.0)}) {
        const ShareMap map = correspondence(ball, other);
        for (int i = 0; i <= 100; ++i) EXPECT_NEAR(map(i / 100.0).at, i / 100.0, 0.12);
    }
    const ShareMap same = correspondence(ball, arc(7.0, 3.0, 0.0));
    for (int i = 0; i <= 100; ++i) EXPECT_NEAR(same(i / 100.0).at, i / 100.0, 1e-12);
}

TEST(Correspondence, IsInvariantToScale) {
    Silhouette small = silhouette_of(swept_atlas().entries().front().species.stages.back().model);
    Silhouette large = small;
    for (auto* part : {&large.stem, &large.hymenium, &large.cap})
        for (OutlinePoint& p : *part) p = {p.r * 8.0, p.y * 8.0};
    const Outline other(silhouette_of(swept_atlas().entries().back().species.stages.back().model));
    const ShareMap a = correspondence(Outline(small).cap, other.cap);
    const ShareMap b = correspondence(Outline(large).cap, other.cap);
    for (int i = 0; i <= 100; ++i) EXPECT_NEAR(a(i / 100.0).at, b(i / 100.0).at, 1e-9);
}

TEST(Correspondence, MapsAreMonotoneWithBoundedSlopes) {
    for (const AtlasEntry& one : swept_atlas().entries())
        for (const AtlasEntry& two : swept_atlas().entries()) {
            const Outline a(silhouette_of(one.species.stages.back().model));
            const Outline b(silhouette_of(two.species.stages.front().model));
            for (const CurveName curve : curve_names) {
                if (a.of(curve).empty() || b.of(curve).empty()) continue;
                const ShareMap map = correspondence(a.of(curve), b.of(curve));
                EXPECT_EQ(map(0.0).at, 0.0);
                EXPECT_EQ(map(1.0).at, 1.0);
                for (std::size_t i = 1; i < map.from().size(); ++i) {
                    const double slope =
                        (map.to()[i] - map.to()[i - 1]) / (map.from()[i] - map.from()[i - 1]);
                    EXPECT_GE(slope, 1.0 / 8.0 - 1e-9);
                    EXPECT_LE(slope, 8.0 + 1e-9);
                }
                double last = 0.0;
                for (int i = 1; i <= 1000; ++i) {
                    const auto [at, slope] = map(i / 1000.0);
                    EXPECT_GT(at, last);
                    EXPECT_GT(slope, 0.0);
                    last = at;
                }
            }
        }
}

TEST(Correspondence, LandmarksAreInterpolated) {
    const Outline a(silhouette_of(swept_atlas().entries()[0].species.stages.back().model));
    const Outline b(silhouette_of(swept_atlas().entries()[1].species.stages.back().model));
    const std::vector<Landmark> landmarks{{0.2, 0.4}, {0.5, 0.45}, {0.51, 0.9}};
    const ShareMap map = correspondence(a.cap, b.cap, landmarks);
    for (const Landmark& landmark : landmarks) EXPECT_NEAR(map(landmark.a).at, landmark.b, 1e-12);
    double last = 0.0;
    for (int i = 1; i <= 1000; ++i) {
        EXPECT_GT(map(i / 1000.0).at, last);
        last = map(i / 1000.0).at;
    }
}

TEST(ShareMap, DerivativeIsContinuousAndCorrect) {
    const ShareMap map({0.0, 0.2, 0.3, 0.8, 1.0}, {0.0, 0.05, 0.35, 0.5, 1.0});
    constexpr double h = 1e-6;
    for (int i = 1; i < 400; ++i) {
        const double x = i / 400.0 + 1e-4;
        EXPECT_NEAR(map(x).slope, (map(x + h).at - map(x - h).at) / (2.0 * h), 1e-5);
    }
    for (const double knot : {0.2, 0.3, 0.8})
        EXPECT_NEAR(map(knot - 1e-9).slope, map(knot + 1e-9).slope, 1e-5);
}

}  // namespace
}  // namespace sporeprint::silhouette_correspondence_test
