#include "core/silhouette/outline.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <cmath>
#include <functional>
#include <string>

#include "tests/support/effort.h"
#include "tests/support/orders.h"

namespace sporeprint::silhouette_outline_test {
namespace {

/// Returns a plain agaric, 10 cm high.
Silhouette agaric() {
    Silhouette s;
    s.stem = {{0.0, 0.0}, {0.01, 0.002}, {0.009, 0.04}, {0.008, 0.08}};
    s.hymenium = {{0.008, 0.08}, {0.02, 0.081}, {0.04, 0.078}};
    s.cap = {{0.04, 0.078}, {0.035, 0.09}, {0.02, 0.098}, {0.0, 0.1}};
    return s;
}

std::vector<Problem> problems_of(const Silhouette& silhouette) {
    std::vector<Problem> problems = problems_in(silhouette);
    if (problems.empty()) problems = refusal([&] { (void)Outline(silhouette, "/s"); });
    return problems;
}

std::vector<Problem> problems_after(const std::function<void(Silhouette&)>& harm) {
    Silhouette s = agaric();
    harm(s);
    return problems_of(s);
}

TEST(Outline, CoincidingControlPointsAreNamed) {
    const auto problems = problems_after(
        [](Silhouette& s) { s.hymenium.insert(s.hymenium.begin() + 1, s.hymenium[1]); });
    ASSERT_EQ(problems.size(), 1u);
    EXPECT_EQ(problems[0].path, "/hymenium/2");
    EXPECT_EQ(problems[0].message, "coincides with the point before it");
}

TEST(Outline, PassesThroughEveryControlPoint) {
    for (const AtlasEntry& entry : swept_atlas().entries())
        for (const Stage& stage : entry.species.stages) {
            const Silhouette& s = silhouette_of(stage.model);
            const Outline outline(s);
            const auto check = [&](const SubCurve& curve, const std::vector<OutlinePoint>& points) {
                const auto samples =
                    curve.empty() ? std::vector<OutlineSample>{} : curve.sampled(4000);
                for (const OutlinePoint& p : points) {
                    double nearest = 1.0;
                    for (const OutlineSample& q : samples)
                        nearest = std::min(nearest,
                                           (p.r - q.r) * (p.r - q.r) + (p.y - q.y) * (p.y - q.y));
                    EXPECT_LT(std::sqrt(nearest), 1e-3 * curve.length());
                }
            };
            check(outline.stem, s.stem);
            check(outline.hymenium, s.hymenium);
            check(outline.cap, s.cap);
        }
}

TEST(Outline, SubCurvesMeetBitForBit) {
    for (const AtlasEntry& entry : swept_atlas().entries())
        for (const Stage& stage : entry.species.stages) {
            const Outline outline(silhouette_of(stage.model));
            const auto meet = [](const SubCurve& a, const SubCurve& b) {
                for (const int count : {2, 3, 8, 31}) {
                    const OutlineSample end = a.sampled(count).back();
                    const OutlineSample start = b.sampled(count).front();
                    EXPECT_EQ(end.r, start.r);
                    EXPECT_EQ(end.y, start.y);
                    EXPECT_EQ(end.share, 1.0);
                    EXPECT_EQ(start.share, 0.0);
                }
            };
            EXPECT_EQ(outline.stem.sampled(5).front().r, 0.0);
            EXPECT_EQ(outline.cap.sampled(5).back().r, 0.0);
            if (outline.hymenium.empty()) {
                meet(outline.stem, outline.cap);
            } else {
                meet(outline.stem, outline.hymenium);
                meet(outline.hymenium, outline.cap);
            }
        }
}

TEST(Outline, SharesAreFractionsOfArcLength) {
    const Outline outline(agaric());
    for (const SubCurve* curve : {&outline.stem, &outline.hymenium, &outline.cap}) {
        double arc = 0.0;
        OutlineSample last = curve->at(0.0);
        constexpr int steps = 5000;
        for (int i = 1; i <= steps; ++i) {
            const OutlineSample next = curve->at(static_cast<double>(i) / steps);
            arc += std::hypot(next.r - last.r, next.y - last.y);
            EXPECT_NEAR(next.share, static_cast<double>(i) / steps, 1e-12);
            // 24 chords per segment approximate the arc: its speed is even to a few per cent.
            EXPECT_NEAR(arc / curve->length(), static_cast<double>(i) / steps, 2e-3);
            last = next;
        }
        EXPECT_NEAR(arc, curve->length(), 1e-3 * curve->length());
    }
}

TEST(Outline, TangentsAreUnitAndPointForward) {
    const Outline outline(agaric());
    for (const SubCurve* curve : {&outline.stem, &outline.hymenium, &outline.cap})
        for (int i = 1; i < 200; ++i) {
            const OutlineSample here = curve->at(i / 200.0);
            const OutlineSample ahead = curve->at(i / 200.0 + 1e-4);
            const OutlineSample behind = curve->at(i / 200.0 - 1e-4);
            EXPECT_NEAR(std::hypot(here.tangent_r, here.tangent_y), 1.0, 1e-12);
            const double r = ahead.r - behind.r, y = ahead.y - behind.y;
            EXPECT_NEAR((r * here.tangent_r + y * here.tangent_y) / std::hypot(r, y), 1.0, 1e-4);
        }
}

TEST(Outline, IsPerpendicularToTheAxisAtItsPoles) {
    const Outline outline(agaric());
    EXPECT_NEAR(outline.stem.at(0.0).tangent_y, 0.0, 1e-12);
    EXPECT_NEAR(outline.cap.at(1.0).tangent_y, 0.0, 1e-12);
    EXPECT_NEAR(outline.stem.at(0.0).tangent_r, 1.0, 1e-12);
    EXPECT_NEAR(outline.cap.at(1.0).tangent_r, -1.0, 1e-12);
}

TEST(Outline, SmoothMarginsHaveContinuousTangentsAndCornersDoNot) {
    Silhouette s = agaric();
    const auto turn = [&] {
        const Outline outline(s);
        const OutlineSample a = outline.hymenium.at(1.0), b = outline.cap.at(0.0);
        return a.tangent_r * b.tangent_r + a.tangent_y * b.tangent_y;
    };
    s.margin = Join::smooth;
    EXPECT_NEAR(turn(), 1.0, 1e-9);
    s.margin = Join::corner;
    EXPECT_LT(turn(), 0.5);
}

TEST(Outline, PlacesMorePointsAtBends) {
    Silhouette s = agaric();  // a straight stem that ends in a tight curl
    s.stem = {{0.0, 0.0},   {0.01, 0.001},   {0.01, 0.04},
              {0.01, 0.07}, {0.012, 0.0745}, {0.014, 0.07}};
    s.hymenium = {{0.014, 0.07}, {0.03, 0.075}};
    s.cap = {{0.03, 0.075}, {0.02, 0.09}, {0.0, 0.1}};
    const Outline outline(s);
    int in_curl = 0;
    for (const OutlineSample& sample : outline.stem.sampled(30))
        in_curl += sample.y > 0.068 ? 1 : 0;
    EXPECT_GE(in_curl, 8) << "an eighth of the length holds most of the turning";
}

TEST(Outline, CrossingOutlinesAreRefusedAndNamed) {
    const auto problems = problems_after([](Silhouette& s) { s.cap[1] = {0.03, 0.07}; });
    ASSERT_EQ(problems.size(), 1u);
    EXPECT_NE(problems[0].message.find("crosses itself"), std::string::npos);
    EXPECT_TRUE(problems[0].path.starts_with("/s/hymenium/")) << problems[0].path;
    EXPECT_NE(problems[0].message.find("/s/cap/"), std::string::npos) << problems[0].message;
    Silhouette crossing = agaric();
    crossing.cap[1] = {0.03, 0.07};
    EXPECT_THROW((void)Outline(crossing), Impossible);
}

TEST(Outline, TouchingTheAxisBetweenTheEndsIsRefusedAndNamed) {
    EXPECT_TRUE(names(problems_after([](Silhouette& s) { s.stem[2].r = 0.0; }), "/s/stem/2",
                      "reaches the axis"));
    EXPECT_TRUE(names(problems_after([](Silhouette& s) { s.cap[2].r = 0.0; }), "/s/cap/2",
                      "reaches the axis"));
    // Between two points off the axis the curve may swing across it.
    const auto swings = problems_after([](Silhouette& s) {
        s.stem = {{0.0, 0.0}, {0.03, 0.0}, {1e-5, 0.03}, {1e-5, 0.04}, {0.03, 0.07}, {0.008, 0.08}};
    });
    EXPECT_TRUE(names(swings, "/s/stem/2", "reaches the axis"));
}

TEST(Outline, BadControlPointsAreRefusedAndNamed) {
    EXPECT_TRUE(problems_of(agaric()).empty());
    const auto expect = [](const std::string& path, const std::string& words,
                           const std::function<void(Silhouette&)>& harm) {
        EXPECT_TRUE(names(problems_after(harm), path, words));
    };
    expect("/stem/2/r", "-0.01", [](Silhouette& s) { s.stem[2].r = -0.01; });
    expect("/cap/1/y", "", [](Silhouette& s) { s.cap[1].y = 1e9; });
    expect("/cap/1/r", "", [](Silhouette& s) { s.cap[1].r = std::nan(""); });
    expect("/stem", "1000", [](Silhouette& s) { s.stem.assign(1000, {0.01, 0.02}); });
    expect("/stem", "at least 2", [](Silhouette& s) { s.stem.clear(); });
    expect("/hymenium", "at least 2", [](Silhouette& s) { s.hymenium.resize(1); });
    expect("/cap", "at least 2", [](Silhouette& s) { s.cap.clear(); });
    expect("/stem/0/r", "off the axis", [](Silhouette& s) { s.stem[0].r = 0.001; });
    expect("/cap/3/r", "off the axis", [](Silhouette& s) { s.cap[3].r = 0.001; });
    expect("/hymenium/0", "last point of the stem", [](Silhouette& s) { s.hymenium[0].y = 0.07; });
    expect("/cap/0", "last point of the hymenium", [](Silhouette& s) { s.cap[0].y = 0.07; });
    expect("/cap/0", "last point of the stem", [](Silhouette& s) { s.hymenium.clear(); });
}

TEST(Outline, CoincidentControlPointsDoNotBreakIt) {
    Silhouette s = agaric();
    s.stem.insert(s.stem.begin() + 2, s.stem[2]);
    const auto problems = problems_of(s);
    if (problems.empty())
        for (const OutlineSample& sample : Outline(s).stem.sampled(64)) {
            EXPECT_TRUE(std::isfinite(sample.r) && std::isfinite(sample.y));
            EXPECT_NEAR(std::hypot(sample.tangent_r, sample.tangent_y), 1.0, 1e-9);
        }
}

TEST(Outline, RandomOutlinesAreValidOrRefused) {
    EXPECT_TRUE(rc::check("random outlines", [] {
        Silhouette s;
        arbitrary(s, Info{.name = ""});
        // Points are joined and put on the axis more often than at random.
        if (s.stem.size() > 1 && s.cap.size() > 1 && *rc::gen::inRange(0, 4) > 0) {
            s.stem.front().r = 0.0;
            s.cap.back().r = 0.0;
            if (s.hymenium.size() > 1) s.hymenium.front() = s.stem.back();
            if (s.hymenium.size() == 1) s.hymenium.clear();
            s.cap.front() = s.hymenium.empty() ? s.stem.back() : s.hymenium.back();
        }
        if (!problems_in(s).empty()) return;
        try {
            const Outline outline(s);
            for (const SubCurve* curve : {&outline.stem, &outline.hymenium, &outline.cap})
                for (const OutlineSample& sample : curve->sampled(200)) {
                    RC_ASSERT(std::isfinite(sample.y));
                    RC_ASSERT(sample.r > 0.0 ||
                              (sample.share == (curve == &outline.cap ? 1.0 : 0.0)));
                    RC_ASSERT(std::abs(std::hypot(sample.tangent_r, sample.tangent_y) - 1.0) <
                              1e-6);
                }
        } catch (const Impossible& refused) {
            RC_ASSERT(refused.problems().size() == 1u);
            RC_ASSERT(refused.problems()[0].path.starts_with("/model/silhouette/"));
        }
    }));
}

TEST(Outline, TheBuriedShareOfAStemEndsAtTheGround) {
    int buried = 0;
    for (const std::string& id : swept_ids())
        for (const double age : {0.0, 0.3, 0.6, 1.0}) {
            const SubCurve stem = resolved(order_of(id, age, 1)).outline.stem;
            const double share = buried_share(stem);
            if (share == 0.0) {
                EXPECT_GE(stem.at(0.0).y, 0.0) << id;
                continue;
            }
            if (share == 1.0) continue;  // a bracket's stem may be below its middle
            EXPECT_LT(stem.at(0.0).y, 0.0) << id;
            EXPECT_NEAR(stem.at(share).y, 0.0, stem.length() / 64.0) << id;
            ++buried;
        }
    EXPECT_GT(buried, 80);
}

// The individual's proportions and the blend between stages must not make the outline cross itself.
TEST(Outline, NoIndividualOfTheAtlasCrossesItselfAtAnyAge) {
    for (const std::string& id : swept_ids())
        for (int step = 0; step < 64; ++step)
            for (std::uint32_t seed = 0; seed < effort(6); ++seed) {
                MushroomSpec order = order_of(id, step / 63.0, 1000 * seed + 7);
                order.params.variation = 1.0;
                const auto problems = refusal([&] { (void)resolved(order); });
                EXPECT_TRUE(problems.empty())
                    << id << " at age " << order.params.age << ", seed " << order.params.seed
                    << ": " << problems[0].path << ' ' << problems[0].message;
            }
}

}  // namespace
}  // namespace sporeprint::silhouette_outline_test
