#include "core/individual/proportion.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "core/math/random.h"
#include "tests/support/orders.h"

namespace sporeprint::individual_proportion_test {
namespace {

/// The outline of a species' mature template, in metres.
struct Drawn {
    MorphSet set;
    OutlineNodes nodes;
    double open;
};

Drawn drawn(const std::string& id) {
    const Silhouette& silhouette = mature_silhouette(id);
    MorphSet set({{silhouette, 1.0, 0, 0.6}});
    OutlineNodes nodes = set.nodes(std::vector<double>{1.0});
    return {std::move(set), std::move(nodes), silhouette.hymenium.empty() ? 0.0 : 1.0};
}

double greatest_radius_of(const std::vector<OutlineNode>& nodes) {
    double radius = 0.0;
    for (const OutlineNode& node : nodes) radius = std::max(radius, node.position.x);
    return radius;
}

TEST(Proportion, FactorsOfOneChangeNoBit) {
    for (const std::string& id : swept_ids()) {
        const Drawn d = drawn(id);
        const OutlineNodes same = proportioned(d.nodes, {}, d.open);
        for (const CurveName curve : curve_names)
            for (std::size_t i = 0; i < d.nodes.of(curve).size(); ++i) {
                EXPECT_LT(glm::distance(same.of(curve)[i].position, d.nodes.of(curve)[i].position),
                          1e-16);
                EXPECT_EQ(same.of(curve)[i].velocity, d.nodes.of(curve)[i].velocity);
            }
    }
}

TEST(Proportion, StretchesTheStatedParts) {
    for (const std::string& id : swept_ids()) {
        const Drawn d = drawn(id);
        const OutlineNodes s = proportioned(d.nodes, {1.2, 1.3, 1.4}, d.open);
        EXPECT_NEAR(s.stem.back().position.y, 1.2 * d.nodes.stem.back().position.y, 1e-15);
        EXPECT_NEAR(greatest_radius_of(s.stem), 1.3 * greatest_radius_of(d.nodes.stem), 1e-15);
        EXPECT_NEAR(s.cap.back().position.y - s.cap.front().position.y,
                    1.4 * (d.nodes.cap.back().position.y - d.nodes.cap.front().position.y), 1e-15);
        EXPECT_EQ(s.cap.back().position.x, 0.0);
        EXPECT_EQ(s.stem.front().position.x, 0.0);
    }
}

TEST(Proportion, AnOpenCapKeepsItsDiameterAndAClubWidensAsAWhole) {
    const Drawn open = drawn("amanita_muscaria"), club = drawn("clavariadelphus_pistillaris");
    EXPECT_EQ(greatest_radius_of(proportioned(open.nodes, {1.0, 1.3, 1.0}, 1.0).cap),
              greatest_radius_of(open.nodes.cap));
    EXPECT_NEAR(greatest_radius_of(proportioned(club.nodes, {1.0, 1.3, 1.0}, 0.0).cap),
                1.3 * greatest_radius_of(club.nodes.cap), 1e-15);
}

TEST(Proportion, VelocitiesAreTransformedByTheJacobian) {
    const Proportions by{1.15, 1.25, 0.85};
    for (const std::string& id : swept_ids())
        for (const double open : {0.0, 0.4, 1.0}) {
            const Drawn d = drawn(id);
            const OutlineNodes moved = proportioned(d.nodes, by, open);
            for (const CurveName curve : curve_names) {
                const auto& nodes = d.nodes.of(curve);
                // The ends share a stretch with their neighbours, and are landmarks of the map.
                for (std::size_t i = 1; i + 1 < nodes.size(); ++i) {
                    constexpr double h = 1e-7;
                    const auto nudged = [&](double step) {
                        OutlineNodes all = d.nodes;
                        all.of(curve)[i].position += step * nodes[i].velocity;
                        return proportioned(std::move(all), by, open).of(curve)[i].position;
                    };
                    const glm::dvec2 found = (nudged(h) - nudged(-h)) / (2.0 * h);
                    const glm::dvec2 reported = moved.of(curve)[i].velocity;
                    EXPECT_LT(glm::distance(found, reported), 1e-4 * glm::length(reported) + 1e-9)
                        << id << ' ' << name(curve) << ' ' << i;
                }
            }
        }
}

TEST(Proportion, SmoothJoinsStaySmooth) {
    for (const std::string& id : swept_ids()) {
        const Drawn d = drawn(id);
        const OutlineNodes moved = proportioned(d.nodes, {1.2, 0.8, 1.3}, d.open);
        const auto bend = [](const OutlineNode& in, const OutlineNode& out) {
            const double sine = in.velocity.x * out.velocity.y - in.velocity.y * out.velocity.x;
            return std::atan2(sine, glm::dot(in.velocity, out.velocity));
        };
        const auto both = [&](CurveName before, CurveName after) {
            if (d.nodes.of(before).empty()) return;
            const OutlineNode &in = d.nodes.of(before).back(), &out = d.nodes.of(after).front();
            if (std::abs(bend(in, out)) > 1e-6) return;  // a corner
            EXPECT_NEAR(bend(moved.of(before).back(), moved.of(after).front()), 0.0, 1e-6) << id;
        };
        both(CurveName::stem, d.nodes.hymenium.empty() ? CurveName::cap : CurveName::hymenium);
        both(CurveName::hymenium, CurveName::cap);
        EXPECT_EQ(moved.stem.back().position, d.nodes.hymenium.empty()
                                                  ? moved.cap.front().position
                                                  : moved.hymenium.front().position);
        if (!d.nodes.hymenium.empty()) {
            EXPECT_EQ(moved.hymenium.back().position, moved.cap.front().position);
        }
    }
}

TEST(Proportion, EveryWidthOfASpreadKeepsRadiiInOrder) {
    for (const double wider : {std::exp(-0.8), 0.7, 1.0, 1.6, std::exp(0.8)}) {
        // The radii of a straight horizontal lower face must stay ascending.
        OutlineNodes nodes;
        nodes.stem = {{{0.0, 0.0}, {0.01, 0.0}}, {{0.01, 0.1}, {0.0, 0.1}}};
        for (int i = 0; i <= 200; ++i)
            nodes.hymenium.push_back({{0.01 + 0.0005 * i, 0.1}, {0.1, 0.0}});
        nodes.cap = {{{0.11, 0.1}, {0.0, 0.1}}, {{0.0, 0.2}, {-0.1, 0.0}}};
        const OutlineNodes moved = proportioned(nodes, {1.0, wider, 1.0}, 1.0);
        for (std::size_t i = 1; i < moved.hymenium.size(); ++i) {
            EXPECT_GT(moved.hymenium[i].position.x, moved.hymenium[i - 1].position.x) << wider;
            EXPECT_GT(moved.hymenium[i].velocity.x, 0.0) << wider;
        }
    }
}

TEST(Proportion, FindsTheSelfIntersectingCurve) {
    const Drawn d = drawn("russula_vinosa");
    const Outline sound(d.nodes);
    for (int lod = 0; lod < 4; ++lod) EXPECT_FALSE(self_intersecting_curve(sound, lod)) << lod;
    OutlineNodes crossed = d.nodes;
    for (OutlineNode& node : crossed.cap) node.position.y -= 2.0 * (node.position.y - 0.03);
    crossed.cap.front().position = crossed.hymenium.back().position;
    EXPECT_TRUE(self_intersecting_curve(Outline(crossed), 0));
    OutlineNodes pierced = d.nodes;
    for (std::size_t i = 0; i < 3; ++i) pierced.cap[pierced.cap.size() / 2 + i].position.x = -0.001;
    EXPECT_EQ(self_intersecting_curve(Outline(pierced), 0), CurveName::cap);
    // A lower face that has shrunk to a point crosses nothing.
    OutlineNodes closed = d.nodes;
    for (OutlineNode& node : closed.hymenium) node = {closed.stem.back().position, {0.0, 0.0}};
    const glm::dvec2 gap = closed.stem.back().position - closed.cap.front().position;
    for (OutlineNode& node : closed.cap)
        node.position.x *= closed.stem.back().position.x / d.nodes.cap.front().position.x;
    for (OutlineNode& node : closed.cap) node.position.y += gap.y;
    closed.cap.front().position = closed.stem.back().position;
    EXPECT_FALSE(self_intersecting_curve(Outline(closed), 1));
}

}  // namespace
}  // namespace sporeprint::individual_proportion_test
