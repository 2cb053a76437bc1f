#include "core/skeleton/skin.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <map>
#include <utility>
#include <vector>

#include "core/math/random.h"
#include "core/skeleton/fork.h"
#include "tests/support/effort.h"
#include "tests/support/meshes.h"
#include "tests/support/orders.h"

namespace sporeprint::skeleton_skin_test {
namespace {

Skeleton straight(double length, double from, double to) {
    return {{{{0, 0, 0}, from}, {{0, length, 0}, to}}, {{0, 1}}};
}

Skeleton star(const std::vector<glm::dvec3>& tips, double radius) {
    Skeleton skeleton;
    skeleton.nodes.push_back({{0, 0, 0}, radius});
    for (const glm::dvec3& tip : tips) {
        skeleton.segments.push_back({0, static_cast<std::uint32_t>(skeleton.nodes.size())});
        skeleton.nodes.push_back({tip, radius});
    }
    return skeleton;
}

Skeleton ring_of(int nodes, double size, double radius) {
    Skeleton skeleton;
    for (int i = 0; i < nodes; ++i) {
        const double angle = 6.283185307179586 * i / nodes;
        skeleton.nodes.push_back(
            {{size * std::cos(angle), 0.1 * size * std::cos(3 * angle), size * std::sin(angle)},
             radius});
        skeleton.segments.push_back(
            {static_cast<std::uint32_t>(i), static_cast<std::uint32_t>((i + 1) % nodes)});
    }
    return skeleton;
}

// Returns a random graph: near nodes, coincident ones, loops, many segments per node, radii from
// hair to trunk.
Skeleton random_graph(std::uint32_t seed) {
    Random random(seed, 9000);
    const auto draw = [&](double from, double to) { return random.uniform(from, to); };
    Skeleton skeleton;
    const int count = 1 + static_cast<int>(draw(0, 24));
    const double flat = draw(0, 1), crowd = draw(0.02, 1.0), loops = draw(0, 0.2);
    for (int i = 0; i < count; ++i) {
        const double x = draw(-crowd, crowd), y = draw(-crowd, crowd), z = draw(-crowd, crowd);
        const double thick = draw(0, 1);
        skeleton.nodes.push_back({{x, flat * y, z}, 0.003 * std::pow(20.0, thick)});
        if (i == 0) continue;
        const auto to = static_cast<std::uint32_t>(draw(0, i));
        skeleton.segments.push_back({to, static_cast<std::uint32_t>(i)});
        if (draw(0, 1) < loops) {
            const auto other = static_cast<std::uint32_t>(draw(0, i + 1));
            skeleton.segments.push_back({static_cast<std::uint32_t>(i), other});
        }
        if (draw(0, 1) < 0.05) skeleton.nodes.back().place = skeleton.nodes[to].place;
    }
    return skeleton;
}

// Expects that every half-edge has its twin, and that Euler's characteristic is that of the graph.
void expect_manifold(const Skeleton& skeleton, const Scaffold& coarse) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> half_edges;
    for (const auto& quad : coarse.quads)
        for (std::size_t k = 0; k < 4; ++k) {
            ASSERT_NE(quad[k], quad[(k + 1) % 4]);
            ++half_edges[{quad[k], quad[(k + 1) % 4]}];
        }
    std::size_t alone = 0;
    for (const auto& [edge, count] : half_edges) {
        const auto twin = half_edges.find({edge.second, edge.first});
        alone += count != 1 || twin == half_edges.end();
    }
    EXPECT_EQ(alone, 0U);
    const long characteristic = static_cast<long>(coarse.points.size()) -
                                static_cast<long>(half_edges.size() / 2) +
                                static_cast<long>(coarse.quads.size());
    EXPECT_EQ(characteristic, 2 * (static_cast<long>(skeleton.nodes.size()) -
                                   static_cast<long>(skeleton.segments.size())));
}

// Returns the number of quads of a scaffold two of whose corners face opposite directions.
int folded(const Scaffold& coarse) {
    int count = 0;
    for (const auto& quad : coarse.quads) {
        std::array<glm::dvec3, 4> corner;
        for (std::size_t k = 0; k < 4; ++k) {
            const glm::dvec3& here = coarse.points[quad[k]];
            corner[k] = glm::cross(coarse.points[quad[(k + 1) % 4]] - here,
                                   coarse.points[quad[(k + 3) % 4]] - here);
        }
        bool fold = false;
        for (std::size_t a = 0; a < 4; ++a)
            for (std::size_t b = a + 1; b < 4; ++b)
                fold = fold || glm::dot(corner[a], corner[b]) <= 0.0;
        count += fold;
    }
    return count;
}

double volume_of(const Scaffold& coarse) {
    double sixfold = 0.0;
    for (const auto& [a, b, c, d] : coarse.quads) {
        const glm::dvec3 &p = coarse.points[a], &q = coarse.points[c];
        sixfold += glm::dot(p, glm::cross(coarse.points[b], q)) +
                   glm::dot(p, glm::cross(q, coarse.points[d]));
    }
    return sixfold / 6.0;
}

// Returns the radius of the circle with the area of the mesh's section with the plane through `at`
// across `along`, near `at`.
double section_radius(const Mesh& mesh, const glm::dvec3& at, const glm::dvec3& along,
                      double near) {
    double doubled = 0.0;
    for (std::size_t t = 0; t < mesh.indices.size(); t += 3) {
        std::array<glm::dvec3, 3> p;
        std::array<double, 3> side{};
        for (std::size_t k = 0; k < 3; ++k) {
            p[k] = glm::dvec3(mesh.positions[mesh.indices[t + k]]) - at;
            side[k] = glm::dot(p[k], along);
        }
        std::vector<std::pair<bool, glm::dvec3>> cut;
        for (std::size_t k = 0; k < 3; ++k) {
            const std::size_t n = (k + 1) % 3;
            if ((side[k] < 0.0) == (side[n] < 0.0)) continue;
            cut.emplace_back(side[k] < 0.0, p[k] + (p[n] - p[k]) * (side[k] / (side[k] - side[n])));
        }
        if (cut.size() != 2 || glm::length(cut[0].second) > near) continue;
        const glm::dvec3& from = cut[0].first ? cut[1].second : cut[0].second;
        const glm::dvec3& to = cut[0].first ? cut[0].second : cut[1].second;
        doubled += glm::dot(glm::cross(from, to), along);
    }
    return std::sqrt(std::abs(0.5 * doubled) / 3.14159265358979);
}

TEST(SkinnedSkeleton, OfAStraightSegmentIsATube) {
    for (int levels = 1; levels <= 3; ++levels) {
        const SkinnedSkeleton made = skinned(straight(1.0, 0.05, 0.05), levels);
        expect_valid(made.mesh);
        const double cylinder = 3.14159265 * 0.05 * 0.05 * 1.0;
        EXPECT_NEAR(volume(made.mesh), cylinder * 1.04, 0.02 * cylinder) << levels;
        ASSERT_EQ(made.strips.size(), 1U);
        EXPECT_EQ(made.strips[0].length, 1.0);
    }
}

TEST(SkinnedSkeleton, OfASingleNodeIsABall) {
    for (int levels = 1; levels <= 3; ++levels) {
        const SkinnedSkeleton made = skinned({{{{0.5, 0.1, -0.2}, 0.1}}, {}}, levels);
        expect_valid(made.mesh);
        EXPECT_NEAR(volume(made.mesh), 4.18879 * 0.001, 0.12 * 4.18879 * 0.001) << levels;
    }
}

TEST(SkinnedSkeleton, OfARingOfSegmentsIsATorus) {
    const Skeleton skeleton = ring_of(16, 1.0, 0.05);
    const CleanSkeleton clean = cleaned(skeleton);
    EXPECT_EQ(clean.skeleton.nodes.size(), 16U);
    expect_manifold(clean.skeleton, scaffold(clean.skeleton, 2));
    const SkinnedSkeleton made = skinned(clean.skeleton, 2);
    expect_valid(made.mesh);
}

TEST(SkinnedSkeleton, AForkKeepsItsRadiusAtItsCentre) {
    const Skeleton y = star({{0, -1, 0}, {0.7, 0.7, 0}, {-0.7, 0.7, 0}}, 0.05);
    const SkinnedSkeleton made = skinned(cleaned(y).skeleton, 2);
    expect_valid(made.mesh);
    double front = 0.0;
    for (const glm::vec3& p : made.mesh.positions)
        if (std::abs(p.x) < 0.02F && std::abs(p.y) < 0.02F)
            front = std::max(front, static_cast<double>(p.z));
    EXPECT_NEAR(front, 0.05, 0.012);
}

TEST(SkinnedSkeleton, RadiiAreLinearAlongSegments) {
    std::vector<Skeleton> skeletons = {
        straight(1.0, 0.05, 0.02),
        star({{0, -1, 0}, {0.7, 0.7, 0}, {-0.7, 0.7, 0}}, 0.04),
        star({{-1, 0, 0}, {1, 0, 0}, {0, 1, 0}}, 0.05),
        star({{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, 0.04),
        {{{{0, 0, 0}, 0.03}, {{0.4, 0, 0}, 0.05}, {{0.8, 0.3, 0}, 0.02}, {{0.9, 0.9, 0.3}, 0.02}},
         {{0, 1}, {1, 2}, {2, 3}}}};
    for (std::size_t i = 0; i < 2 * skeletons.size(); ++i) {
        const CleanSkeleton clean = cleaned(skeletons[i / 2]);
        const int levels = 2 + static_cast<int>(i % 2);
        const SkinnedSkeleton made = skinned(clean.skeleton, levels);
        for (const Skeleton::Segment& segment : clean.skeleton.segments) {
            const Skeleton::Node &a = clean.skeleton.nodes[segment.from],
                                 &b = clean.skeleton.nodes[segment.to];
            const double length = glm::distance(a.place, b.place);
            const glm::dvec3 along = (b.place - a.place) / length;
            for (int step = 0; step <= 10; ++step) {
                const double from = 2.0 * a.radius, to = length - 2.0 * b.radius;
                const double s = from + (to - from) * (step + 0.013) / 10.1;
                const double law = a.radius + (b.radius - a.radius) * s / length;
                EXPECT_NEAR(section_radius(made.mesh, a.place + s * along, along, 3.0 * law), law,
                            0.05 * law)
                    << "limb " << segment.from << " to " << segment.to << ", " << s / length;
            }
        }
    }
}

TEST(SkinnedSkeleton, OfRandomGraphsIsWatertight) {
    int folds = 0, quads = 0;
    for (std::uint32_t seed = 0; seed < effort(10000, 400); ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        const CleanSkeleton clean = cleaned(random_graph(seed));
        EXPECT_TRUE(broken_limits(clean.skeleton).empty());
        const Scaffold coarse = scaffold(clean.skeleton, 2);
        expect_manifold(clean.skeleton, coarse);
        EXPECT_GT(volume_of(coarse), 0.0);
        folds += folded(coarse);
        quads += static_cast<int>(coarse.quads.size());
        if (seed % 50 == 0)
            expect_valid(skinned(clean.skeleton, 1 + static_cast<int>(seed / 50 % 2)).mesh);
        if (HasFailure()) return;
    }
    EXPECT_EQ(folds, 0) << "of " << quads;
}

TEST(SkinnedSkeleton, CleaningIsIdempotent) {
    const Skeleton y = star({{0, -1, 0}, {0.7, 0.7, 0}, {-0.7, 0.7, 0}}, 0.05);
    const CleanSkeleton clean = cleaned(y);
    ASSERT_EQ(clean.skeleton.nodes.size(), y.nodes.size());
    EXPECT_EQ(clean.skeleton.segments, y.segments);
    for (std::size_t i = 0; i < y.nodes.size(); ++i) {
        EXPECT_EQ(clean.skeleton.nodes[i].place, y.nodes[i].place);
        EXPECT_EQ(clean.node_of[i], i);
    }
}

TEST(SkinnedSkeleton, SegmentsThatMakeNoForkStartInside) {
    // A fourth segment, a twig on a trunk and a sharp angle each start at a node of their own.
    const auto nodes = [](const Skeleton& skeleton) {
        return cleaned(skeleton).skeleton.nodes.size();
    };
    EXPECT_EQ(nodes(star({{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}}, 0.05)), 6U);
    Skeleton twig = star({{0, 1, 0}, {0, -1, 0}, {1, 0, 0}}, 0.1);
    EXPECT_EQ(nodes(twig), 4U);
    twig.nodes[3].radius = 0.01;
    EXPECT_EQ(nodes(twig), 5U);
    EXPECT_EQ(cleaned(twig).skeleton.nodes.back().radius, 0.01);
    EXPECT_EQ(nodes(star({{0, -1, 0}, {0.1, 1, 0}, {-0.1, 1, 0}}, 0.05)), 5U);
    const auto problems = refusal([] {
        (void)scaffold(star({{0, -1, 0}, {0.1, 1, 0}, {-0.1, 1, 0}}, 0.05), 2);
    });
    EXPECT_TRUE(names(problems, "/limbs/2", "too sharp an angle"));
}

TEST(SkinnedSkeleton, BrokenLimitsAreReportedAtTheirPlace) {
    const auto refused = [](const Skeleton& skeleton, const char* path, const char* words) {
        const auto problems = refusal([&] { (void)scaffold(skeleton, 2); });
        EXPECT_TRUE(names(problems, path, words)) << words;
        // Cleaning repairs it.
        EXPECT_TRUE(broken_limits(cleaned(skeleton).skeleton).empty()) << words;
    };
    refused(star({{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}}, 0.05), "/limbs/3",
            "is the fourth of its node");
    Skeleton y = star({{0, -1, 0}, {0.7, 0.7, 0}, {-0.7, 0.7, 0}}, 0.05);
    EXPECT_TRUE(broken_limits(y).empty());
    y.nodes[3].radius = 0.02;
    refused(y, "/limbs/2", "is much thinner than the others of its node");
    y.nodes[3].radius = 0.15;
    refused(y, "/limbs/2", "is much thicker than its fork");
    y.nodes[3] = {{-0.12, 0.12, 0}, 0.05};
    refused(y, "/limbs/2", "is too short to leave its forks");
    y.nodes[3].place = {0.01, 0.0, 0.01};
    refused(y, "/limbs/2", "joins nodes that lie on each other");
    const double up = std::sin(0.7), out = std::cos(0.7);
    refused(
        star({{out, up, 0}, {-0.5 * out, up, 0.866 * out}, {-0.5 * out, up, -0.866 * out}}, 0.02),
        "/limbs/2", "leans too far to the side of the others");
    refused(star({{0, 1, 0}, {0.3, 1, 0}}, 0.02), "/limbs/1", "too sharp an angle");
}

TEST(SkinnedSkeleton, RefusesOversizedGraphsBeforeAnyWork) {
    Skeleton crowd;
    crowd.nodes.resize(most_skeleton_nodes + 1, {{0, 0, 0}, 0.01});
    EXPECT_TRUE(names(refusal([&] { (void)cleaned(crowd); }), "/nodes",
                      "200001 nodes; at most 200000 are skinned"));
    const double infinite = std::numeric_limits<double>::infinity();
    EXPECT_TRUE(names(refusal([&] {
                          (void)cleaned({{{{0, -2e4, 0}, 1}}, {}});
                      }),
                      "/nodes/0/place", "-20000 is outside"));
    EXPECT_TRUE(names(refusal([&] {
                          (void)cleaned({{{{0, 0, infinite}, 1}}, {}});
                      }),
                      "/nodes/0/place", "outside"));
    EXPECT_TRUE(names(refusal([&] {
                          (void)cleaned({{{{0, 0, 0}, 2e3}}, {}});
                      }),
                      "/nodes/0/radius", "2000 is outside"));
}

TEST(SkinnedSkeleton, RefusesInvalidGraphs) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    EXPECT_TRUE(names(refusal([&] { (void)cleaned({{{{nan, 0, 0}, 1}}, {}}); }), "/nodes/0/place"));
    EXPECT_TRUE(names(refusal([&] {
                          (void)cleaned({{{{0, 0, 0}, 0}}, {}});
                      }),
                      "/nodes/0/radius", "0 is outside"));
    EXPECT_TRUE(names(refusal([&] {
                          (void)cleaned({{{{0, 0, 0}, 1}}, {{0, 1}}});
                      }),
                      "/limbs/0", "goes to node 1; there are 1"));
    EXPECT_EQ(cleaned({{{{0, 0, 0}, 1}, {{0, 0, 0}, 1}}, {{0, 1}, {1, 1}}}).skeleton.nodes.size(),
              1U);
    EXPECT_TRUE(skinned({}, 2).mesh.positions.empty());
}

}  // namespace
}  // namespace sporeprint::skeleton_skin_test
