#include "core/colony/root_system.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <vector>

#include "core/math/elementary.h"
#include "core/mesh/measure.h"
#include "core/params/corners.h"
#include "core/skeleton/skin.h"
#include "tests/support/effort.h"
#include "tests/support/refusals.h"

namespace sporeprint::colony_root_system_test {
namespace {

glm::dvec2 ground(const ColonySkeleton& colony, std::uint32_t node) {
    const glm::dvec3 place = colony.skeleton.nodes[node].place;
    return {place.x, place.z};
}

// Returns the angle from one direction to another, degrees, -180..180.
double turn_between(const glm::dvec2& a, const glm::dvec2& b) {
    return std::atan2(a.x * b.y - a.y * b.x, glm::dot(a, b)) * 180.0 / pi;
}

TEST(ColonyRoots, ABranchKeepsItsAngleToTheField) {
    for (const RootField field : {RootField::noise, RootField::curl}) {
        ColonyRoots roots;
        roots.field = field;
        roots.heading_deg = 35.0;
        const ColonySkeleton colony = colony_skeleton(roots, 3);
        std::size_t seen = 0;
        for (const ColonySkeleton::Branch& branch : colony.branches)
            for (std::size_t i = 1; i < branch.nodes.size(); ++i) {
                // After an inserted node the segment keeps its direction.
                if (colony.inserted[branch.nodes[i - 1]] && i > 1) continue;
                const glm::dvec2 from = ground(colony, branch.nodes[i - 1]);
                const glm::dvec2 along = ground(colony, branch.nodes[i]) - from;
                const glm::dvec2 wind = field_heading(roots, 3, from);
                const SineCosine angle = sine_cosine(branch.angle);
                const glm::dvec2 wanted(angle.cosine * wind.x - angle.sine * wind.y,
                                        angle.sine * wind.x + angle.cosine * wind.y);
                EXPECT_NEAR(turn_between(wanted, along), 0.0, 1e-4);
                ++seen;
            }
        EXPECT_GT(seen, 40U);
    }
}

// From the source: in a radial field branches at 0 degrees are straight and lead away from the
// origin, those at 90 are about circles.
TEST(ColonyRoots, InARadialFieldRootsAreRaysOrCircles) {
    ColonyRoots roots;
    roots.field = RootField::radial;
    roots.branch_distance = 100.0;
    roots.decay = 0.0;
    roots.depth = 10;
    const ColonySkeleton rays = colony_skeleton(roots, 3);
    for (const ColonySkeleton::Branch& branch : rays.branches) {
        if (std::abs(branch.angle) > 1e-9) continue;  // the others of the arms spiral
        for (const std::uint32_t node : branch.nodes) EXPECT_NEAR(ground(rays, node).x, 0.0, 1e-9);
        EXPECT_NEAR(glm::length(ground(rays, branch.nodes.back())), 10 * roots.segment_length,
                    1e-9);
    }
    roots.heading_deg = 90.0;
    roots.arms = 1;
    roots.depth = 60;
    const ColonySkeleton circle = colony_skeleton(roots, 3);
    const auto& nodes = circle.branches[0].nodes;
    // A step perpendicular to the radius lengthens it: r' = sqrt(r^2 + l^2), after n steps l
    // sqrt(n).
    EXPECT_NEAR(glm::length(ground(circle, nodes.back())), roots.segment_length * std::sqrt(60.0),
                1e-6);
}

TEST(ColonyRoots, SegmentsAndSectionsDecayWithTheDistanceFromTheBase) {
    ColonyRoots roots;
    roots.decay = 0.08;
    roots.area_decay = 1.0;
    const ColonySkeleton colony = colony_skeleton(roots, 5);
    for (const ColonySkeleton::Branch& branch : colony.branches) {
        double length = 0.0;
        for (std::size_t i = 1; i < branch.nodes.size(); ++i) {
            const std::uint32_t node = branch.nodes[i];
            length += glm::distance(ground(colony, branch.nodes[i - 1]), ground(colony, node));
            const int depth = colony.depths[node];
            EXPECT_NEAR(colony.skeleton.nodes[node].radius,
                        roots.root_radius * std::exp(-0.5 * 0.08 * depth), 1e-12);
            if (colony.inserted[node]) continue;
            EXPECT_NEAR(length, roots.segment_length * std::exp(-0.08 * (depth - 1)), 1e-9);
            length = 0.0;
        }
        EXPECT_EQ(colony.depths[branch.nodes.back()], roots.depth);
    }
}

// Branchings are a Poisson process on length: their numbers are Poisson distributed, the lengths
// between them exponentially.
TEST(ColonyRoots, BranchingsAreAPoissonProcessOnLength) {
    ColonyRoots roots;
    roots.arms = 12;
    roots.depth = 60;
    roots.decay = 0.0;
    roots.segment_length = 0.05;
    roots.branch_distance = 0.3;
    roots.depth = 16;
    double length = 0.0, splits = 0.0;
    std::vector<double> firsts;  // lengths to the first branching, also of arms without one
    std::size_t arms = 0;
    const std::size_t seeds = effort(60, 20);
    for (std::uint32_t seed = 0; seed < seeds; ++seed) {
        const ColonySkeleton colony = colony_skeleton(roots, seed);
        for (const ColonySkeleton::Branch& branch : colony.branches) {
            length += branch.length;
            splits += static_cast<double>(branch.splits.size());
        }
        for (std::size_t arm = 0; arm < 12; ++arm) {
            ++arms;
            const auto& own = colony.branches[arm].splits;
            if (!own.empty()) firsts.push_back(own[0]);
        }
    }
    const double expected = length / roots.branch_distance;
    EXPECT_NEAR(splits, expected, 5.0 * std::sqrt(expected));
    // Kolmogorov-Smirnov test: the share with a first branching before x is 1 - e^(-x / mean); 1.95
    // / sqrt(n) is exceeded once in 1,000.
    std::sort(firsts.begin(), firsts.end());
    double worst = 0.0;
    for (std::size_t i = 0; i < firsts.size(); ++i) {
        const double law = 1.0 - std::exp(-firsts[i] / roots.branch_distance);
        worst = std::max(
            worst, std::abs(law - (static_cast<double>(i) + 0.5) / static_cast<double>(arms)));
    }
    EXPECT_LT(worst, 1.95 / std::sqrt(static_cast<double>(arms)));
}

TEST(ColonyRoots, SideBranchesLeaveSquarelyToBothSides) {
    ColonyRoots roots;
    roots.branch_jitter_deg = 30.0;
    double left = 0.0, all = 0.0, sum = 0.0;
    for (std::uint32_t seed = 0; seed < effort(60, 20); ++seed) {
        const ColonySkeleton colony = colony_skeleton(roots, seed);
        for (std::size_t i = static_cast<std::size_t>(roots.arms); i < colony.branches.size();
             ++i) {
            const ColonySkeleton::Branch& branch = colony.branches[i];
            const double turn = (branch.angle - colony.branches[branch.parent].angle) * 180.0 / pi;
            EXPECT_GE(std::abs(turn), 60.0 - 1e-9);
            EXPECT_LE(std::abs(turn), 120.0 + 1e-9);
            left += turn > 0.0 ? 1.0 : 0.0;
            sum += std::abs(turn) - 90.0;
            all += 1.0;
        }
    }
    EXPECT_GT(all, 500.0);
    EXPECT_NEAR(left / all, 0.5, 5.0 * 0.5 / std::sqrt(all));
    EXPECT_NEAR(sum / all, 0.0, 5.0 * 30.0 / std::sqrt(3.0 * all));
}

TEST(ColonyRoots, StemsAreBernoulliEventsOnNodes) {
    ColonyRoots roots;
    for (const double probability : {0.1, 0.4}) {
        roots.stem_probability = probability;
        double stems = 0.0, nodes = 0.0;
        for (std::uint32_t seed = 0; seed < effort(60, 20); ++seed) {
            const ColonySkeleton colony = colony_skeleton(roots, seed);
            stems += static_cast<double>(colony.stems.size());
            nodes += colony.root_nodes;
        }
        EXPECT_NEAR(stems / nodes, probability,
                    5.0 * std::sqrt(probability * (1.0 - probability) / nodes));
    }
    roots.stem_probability = 0.0;
    EXPECT_TRUE(colony_skeleton(roots, 1).stems.empty());
    roots.stem_probability = 1.0;
    const ColonySkeleton all = colony_skeleton(roots, 1);
    EXPECT_EQ(all.stems.size(), all.root_nodes);
}

TEST(ColonyRoots, StemsAreParabolasAsThickAsTheirNodes) {
    ColonyRoots roots;
    roots.stem_decay = 0.05;
    roots.stem_displacement = 0.03;
    const ColonySkeleton colony = colony_skeleton(roots, 2);
    ASSERT_GT(colony.stems.size(), 5U);
    for (const ColonySkeleton::Stem& stem : colony.stems) {
        const Skeleton::Node& base = colony.skeleton.nodes[stem.root];
        EXPECT_NEAR(stem.height, roots.stem_height * std::exp(-0.05 * colony.depths[stem.root]),
                    1e-12);
        const double away = glm::length(base.place);
        for (const std::uint32_t node : stem.nodes) {
            const Skeleton::Node& here = colony.skeleton.nodes[node];
            EXPECT_EQ(here.radius, base.radius);
            const double share = here.place.y / stem.height;
            EXPECT_NEAR(glm::length(glm::dvec2(here.place.x, here.place.z)),
                        away + (away > 0.0 ? 0.03 * share * share : 0.0), 1e-9);
        }
        EXPECT_NEAR(colony.skeleton.nodes[stem.nodes.back()].place.y, stem.height, 1e-12);
    }
}

TEST(ColonyRoots, HaveAsManyNodesAsExpectedInTheMean) {
    ColonyRoots roots;
    double sum = 0.0, squares = 0.0;
    const auto seeds = static_cast<double>(effort(200, 50));
    for (std::uint32_t seed = 0; seed < static_cast<std::uint32_t>(seeds); ++seed) {
        const double nodes = colony_skeleton(roots, seed).root_nodes;
        sum += nodes;
        squares += nodes * nodes;
    }
    const double mean = sum / seeds;
    EXPECT_NEAR(mean, expected_root_nodes(roots),
                5.0 * std::sqrt((squares / seeds - mean * mean) / seeds));
}

TEST(ColonyRoots, HaveAWatertightSkin) {
    ColonyRoots roots;
    for (std::uint32_t seed = 0; seed < effort(12, 3); ++seed) {
        const ColonySkeleton colony = colony_skeleton(roots, seed);
        const Mesh mesh = skinned(cleaned(colony.skeleton).skeleton, 1).mesh;
        EXPECT_TRUE(defects(mesh).empty());
        EXPECT_GT(volume(mesh), 0.0);
    }
}

TEST(ColonyRoots, AtTheEndsOfTheirRangesAreValidOrRefused) {
    ColonyRoots roots;
    walk_corners(roots, Info{.name = ""}, "", [&](const std::string& path) {
        try {
            const ColonySkeleton colony = colony_skeleton(roots, 1);
            EXPECT_TRUE(validation_errors(colony.skeleton).empty()) << path;
            EXPECT_EQ(colony.skeleton.segments.size() + 1, colony.skeleton.nodes.size()) << path;
        } catch (const Impossible& refused) {
            EXPECT_TRUE(names(refused.problems(), "/branch_distance", "nodes")) << path;
        }
    });
    roots.branch_distance = 0.006;
    roots.depth = 40;
    EXPECT_TRUE(names(refusal([&] { (void)colony_skeleton(roots, 1); }), "/branch_distance",
                      "at most 20000"));
    roots.arms = 0;
    EXPECT_TRUE(names(refusal([&] { (void)colony_skeleton(roots, 1); }), "/arms", "outside 1..12"));
}

TEST(ColonyRoots, TheSameSeedGivesTheSameColony) {
    const ColonySkeleton one = colony_skeleton({}, 4), again = colony_skeleton({}, 4);
    ASSERT_EQ(one.skeleton.nodes.size(), again.skeleton.nodes.size());
    for (std::size_t i = 0; i < one.skeleton.nodes.size(); ++i)
        EXPECT_EQ(one.skeleton.nodes[i].place, again.skeleton.nodes[i].place);
    // More stems do not move any root.
    ColonyRoots more;
    more.stem_probability = 0.9;
    const ColonySkeleton crowded = colony_skeleton(more, 4);
    ASSERT_EQ(one.root_nodes, crowded.root_nodes);
    for (std::size_t i = 0; i < one.root_nodes; ++i)
        EXPECT_EQ(one.skeleton.nodes[i].place, crowded.skeleton.nodes[i].place);
}

}  // namespace
}  // namespace sporeprint::colony_root_system_test
