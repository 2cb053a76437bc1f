#include "core/silhouette/morph_set.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "core/build/detail.h"
#include "tests/support/orders.h"

namespace sporeprint {
namespace {

double greatest(const Silhouette& s) {
    double most = 0.0;
    for (const auto* part : {&s.stem, &s.hymenium, &s.cap})
        for (const OutlinePoint& p : *part) most = std::max({most, p.r, p.y - s.stem.front().y});
    return most;
}

/// The control shapes of one species, of about unit size when mature.
std::vector<ControlShape> shapes_of(const AtlasEntry& entry, std::size_t kin) {
    std::vector<ControlShape> shapes;
    double size = 1.0;
    for (const Stage& stage : entry.species.stages)
        if (stage.age == 0.6) size = greatest(silhouette_of(stage.model));
    for (const Stage& stage : entry.species.stages)
        shapes.push_back({silhouette_of(stage.model), size, kin, stage.age});
    return shapes;
}

MorphSet set_of(std::initializer_list<std::size_t> species, std::span<const Arc> arcs = {},
                double arcs_age = 0.6) {
    std::vector<ControlShape> shapes;
    std::size_t kin = 0;
    for (const std::size_t s : species) {
        const auto own = shapes_of(atlas().entries()[s], kin++);
        shapes.insert(shapes.end(), own.begin(), own.end());
    }
    return MorphSet(std::move(shapes), arcs, arcs_age);
}

std::vector<double> only(const MorphSet& set, std::size_t shape) {
    std::vector<double> weights(set.size(), 0.0);
    weights[shape] = 1.0;
    return weights;
}

TEST(MorphSet, EndpointsAreTheControlShapes) {
    for (const AtlasEntry& entry : atlas().entries()) {
        const auto shapes = shapes_of(entry, 0);
        const MorphSet set(shapes);
        for (std::size_t s = 0; s < shapes.size(); ++s) {
            const Outline outline(set.nodes(only(set, s)), set.places());
            const Outline own(shapes[s].silhouette);
            for (const CurveName curve : curve_names) {
                const auto truth = own.of(curve).empty() ? std::vector<OutlineSample>{}
                                                         : own.of(curve).sampled(4000);
                double worst = 0.0;
                for (const OutlineSample& ring : outline.rings(curve, 0)) {
                    double nearest = 1.0;
                    for (const OutlineSample& p : truth)
                        nearest = std::min(nearest, std::hypot(ring.r * shapes[s].size - p.r,
                                                               ring.y * shapes[s].size - p.y));
                    worst = std::max(worst, nearest);
                }
                EXPECT_LT(worst, 5e-4 * greatest(shapes[s].silhouette))
                    << entry.species.id.string() << " stage " << s << ' ' << name(curve);
            }
        }
    }
}

TEST(MorphSet, CountsAndPlacesAreThoseOfTheLevelsOfDetail) {
    const MorphSet set = set_of({0, 1});
    const Outline outline(set.nodes(only(set, 0)), set.places());
    for (int lod = 0; lod < 4; ++lod) {
        const Detail& detail = details[static_cast<std::size_t>(lod)];
        EXPECT_EQ(outline.rings(CurveName::stem, lod).size(),
                  static_cast<std::size_t>(detail.stem_rings));
        EXPECT_EQ(outline.rings(CurveName::hymenium, lod).size(),
                  static_cast<std::size_t>(detail.hymenium_rings));
        EXPECT_EQ(outline.rings(CurveName::cap, lod).size(),
                  static_cast<std::size_t>(detail.cap_rings));
    }
}

TEST(MorphSet, SubCurvesMeetBitForBitAndEndOnTheAxis) {
    const MorphSet set = set_of({0, 2, 3, 5});
    std::vector<double> weights(set.size(), 1.0 / static_cast<double>(set.size()));
    const Outline outline(set.nodes(weights), set.places());
    for (int lod = 0; lod < 4; ++lod) {
        const auto stem = outline.rings(CurveName::stem, lod);
        const auto hymenium = outline.rings(CurveName::hymenium, lod);
        const auto cap = outline.rings(CurveName::cap, lod);
        EXPECT_EQ(stem.front().r, 0.0);
        EXPECT_EQ(cap.back().r, 0.0);
        EXPECT_EQ(stem.back().r, hymenium.front().r);
        EXPECT_EQ(stem.back().y, hymenium.front().y);
        EXPECT_EQ(hymenium.back().r, cap.front().r);
        EXPECT_EQ(hymenium.back().y, cap.front().y);
        for (const auto& rings : {stem, hymenium, cap}) {
            EXPECT_EQ(rings.front().share, 0.0);
            EXPECT_EQ(rings.back().share, 1.0);
            for (std::size_t i = 1; i < rings.size(); ++i)
                EXPECT_GT(rings[i].share, rings[i - 1].share);
            for (const OutlineSample& ring : rings)
                EXPECT_NEAR(std::hypot(ring.tangent_r, ring.tangent_y), 1.0, 1e-12);
        }
    }
}

TEST(MorphSet, AMissingHymeniumIsAPoint) {
    std::size_t club = 0;
    while (!silhouette_of(atlas().entries()[club].species.stages[0].model).hymenium.empty()) ++club;
    const MorphSet alone = set_of({club});
    EXPECT_TRUE(alone.nodes(only(alone, 0)).hymenium.empty());
    const MorphSet mixed = set_of({0, club});
    const Outline outline(mixed.nodes(only(mixed, mixed.size() - 1)), mixed.places());
    EXPECT_EQ(outline.hymenium.length(), 0.0);
    const OutlineSample end = outline.stem.at(1.0);
    for (const OutlineSample& ring : outline.rings(CurveName::hymenium, 0)) {
        EXPECT_EQ(ring.r, end.r);
        EXPECT_EQ(ring.y, end.y);
        EXPECT_EQ(ring.tangent_r, end.tangent_r);
        EXPECT_EQ(ring.tangent_y, end.tangent_y);
    }
}

TEST(MorphSet, SmoothJoinsStaySmoothInEveryMix) {
    // Margins of these are smooth in every stage.
    const MorphSet set = set_of({0, 1, 4});
    for (std::size_t other = 1; other < set.size(); ++other)
        for (const double t : {0.0, 0.3, 0.7}) {
            std::vector<double> weights(set.size(), 0.0);
            weights[0] = 1.0 - t;
            weights[other] = t;
            const OutlineNodes nodes = set.nodes(weights);
            const glm::dvec2 in = nodes.hymenium.back().velocity, out = nodes.cap.front().velocity;
            EXPECT_NEAR(glm::dot(in, out), std::sqrt(glm::dot(in, in) * glm::dot(out, out)),
                        1e-9 * glm::dot(in, in));
        }
}

TEST(MorphSet, ArcsAreReadBackWhereTheyBind) {
    const std::vector<Arc> arcs{{CurveName::cap, 0.3, 0.5}, {CurveName::stem, 0.7, 0.6}};
    for (const double age : {0.0, 0.45, 0.6, 1.0}) {
        const MorphSet set = set_of({0, 1}, arcs, age);
        for (const Arc& arc : arcs) {
            // A fine row of links between the two outlines at this age passes through the arc.
            double nearest = 1.0;
            for (const Arc& link : set.arcs(age, 2000))
                if (link.curve == arc.curve)
                    nearest =
                        std::min(nearest, std::abs(link.a - arc.a) + std::abs(link.b - arc.b));
            EXPECT_LT(nearest, 0.006) << "age " << age;
        }
    }
}

TEST(MorphSet, CrossingArcsAreRefusedAndNamed) {
    const auto refused = [](std::vector<Arc> arcs) {
        return refusal([&] { (void)set_of({0, 1}, arcs); });
    };
    const auto crossing = refused(
        {{CurveName::cap, 0.3, 0.5}, {CurveName::stem, 0.1, 0.9}, {CurveName::cap, 0.4, 0.4}});
    ASSERT_EQ(crossing.size(), 1u);
    EXPECT_TRUE(names(crossing, "/arcs/2", "crosses arc 0"));
    EXPECT_TRUE(names(refused({{CurveName::cap, 0.3, 0.5}, {CurveName::cap, 0.3, 0.6}}), "/arcs/1",
                      "crosses arc 0"));
    EXPECT_TRUE(names(refused({{CurveName::cap, 0.0, 0.5}}), "/arcs/0", "between 0 and 1"));
    EXPECT_TRUE(names(refused({{CurveName::cap, 0.5, 1.5}}), "/arcs/0", "between 0 and 1"));
    EXPECT_TRUE(refused({{CurveName::cap, 0.5, 0.6}, {CurveName::cap, 0.5, 0.6}}).empty());
    EXPECT_TRUE(
        names(refusal([] { (void)set_of({0}, std::vector<Arc>{{}}); }), "/arcs/0", "exactly two"));
}

}  // namespace
}  // namespace sporeprint
