#include "core/colony/colony_skin.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <vector>

#include "core/surface/charts.h"
#include "tests/support/meshes.h"

namespace sporeprint::colony_colony_skin_test {
namespace {

constexpr const Chart& chart = swept_charts[static_cast<std::size_t>(Part::stem)];

double along_image(const glm::vec2& at) {
    return ((static_cast<double>(at.x) - chart.u) / chart.width - chart.inset) /
           (1.0 - 2.0 * chart.inset);
}

/// Returns members at their places, without adjustments.
std::vector<ColonyMember> unmoved(const ColonySite& site) {
    std::vector<ColonyMember> members(site.places.size());
    for (std::size_t i = 0; i < members.size(); ++i) {
        members[i].place = i;
        members[i].rise = site.places[i].rise;
        members[i].swing = site.places[i].swing;
    }
    return members;
}

Skeleton pole(double length, int nodes, const glm::dvec3& along) {
    Skeleton segments;
    for (int i = 0; i <= nodes; ++i) {
        segments.nodes.push_back({length * i / nodes * along, 0.004});
        if (i > 0)
            segments.segments.push_back(
                {static_cast<std::uint32_t>(i - 1), static_cast<std::uint32_t>(i)});
    }
    return segments;
}

/// A colony on visible roots.
struct RootedColony {
    ColonyParams params;
    ColonyTraits traits;
    StemFit fit{0.004, 0.08, 0.085, 0.03};
    ColonySite site;

    RootedColony() {
        params.habit = traits.habit = Habit::rooted;
        traits.roots = RootsShown::shown;
        site = colony_site(params, traits, colony_growth(params, traits, fit), {fit, fit});
    }
};

TEST(ColonySkin, IsClosedAndUsesTheImageOfTheStem) {
    const RootedColony colony;
    const auto& [params, traits, fit, site] = colony;
    const std::vector<ColonyMember> members = unmoved(site);
    ASSERT_GT(members.size(), 5U);
    for (int lod = 0; lod < 4; ++lod) {
        const Mesh mesh =
            colony_skin(colony_skeleton(site, members, params, traits, 5), {lod, fit.length, true})
                .mesh;
        expect_valid(mesh);
        for (const glm::vec2& at : mesh.texture_coordinates) {
            EXPECT_GT(static_cast<double>(at.x), chart.u + 0.9 * chart.inset * chart.width);
            EXPECT_LT(static_cast<double>(at.x), chart.u + chart.width);
            EXPECT_GT(static_cast<double>(at.y), chart.v + 0.9 * chart.inset * chart.height);
            EXPECT_LT(static_cast<double>(at.y), chart.v + chart.height);
        }
    }
}

// The ground of the image is at the ground, so that soil clings to stems where they leave it.
TEST(ColonySkin, AStemShowsOneImageAndItsGroundAtTheGround) {
    constexpr double deep = 0.04, high = 0.16;
    for (const double buried : {0.0, 0.3})
        for (const double way : {1.0, -1.0}) {
            Skeleton stem = pole(deep + high, 10, {0.0, way, 0.0});
            for (auto& node : stem.nodes) node.place.y += way > 0.0 ? -deep : high;
            const Mesh mesh = colony_skin(stem, {0, 0.085, true, buried}).mesh;
            for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
                const double height =
                    std::clamp(static_cast<double>(mesh.positions[i].y), -deep, high);
                const double expected = height < 0.0 ? buried * (1.0 + height / deep)
                                                     : buried + (1.0 - buried) * height / high;
                EXPECT_NEAR(along_image(mesh.texture_coordinates[i]), expected, 0.04);
            }
        }
}

// Cords lie in the soil: they are thinner than the stems on them, end in the ground, and show soil
// if there is some.
TEST(ColonySkin, RootsAreCordsInTheSoil) {
    const RootedColony colony;
    const auto& [params, traits, fit, site] = colony;
    const Skeleton skeleton = colony_skeleton(site, unmoved(site), params, traits, 5);
    for (std::size_t i = 0; i < site.ground.nodes.size(); ++i) {
        EXPECT_LT(skeleton.nodes[i].radius, site.ground.nodes[i].radius);
        EXPECT_LT(skeleton.nodes[i].place.y, site.ground.nodes[i].radius);
    }
    for (const bool soiled : {false, true}) {
        const ColonySkin made = colony_skin(skeleton, {1, fit.length, true, 0.0, soiled});
        std::size_t in_soil = 0;
        for (const glm::vec2& at : made.mesh.texture_coordinates)
            in_soil += part_at(at.x, at.y) == Part::ground ? 1 : 0;
        EXPECT_EQ(in_soil > made.mesh.positions.size() / 10, soiled);
        EXPECT_LT(in_soil, made.mesh.positions.size() / 2 + made.mesh.positions.size() / 3);
    }
}

// Along a root the image is repeated and mirrored at its own scale, and is constant nowhere.
TEST(ColonySkin, ARootShowsImagesWithMirroredRepeat) {
    constexpr double painted = 0.085, length = 3.4 * painted;
    const Mesh mesh = colony_skin(pole(length, 12, {1.0, 0.0, 0.0}), {0, painted, true}).mesh;
    std::map<int, double> by_ring;  // distance in tenths of millimetres -> place on the image
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        const double x = mesh.positions[i].x;
        if (x > 0.01 && x < length - 0.01)  // between the round ends
            by_ring[static_cast<int>(std::floor(x * 1e4 + 0.5))] =
                along_image(mesh.texture_coordinates[i]);
    }
    ASSERT_GT(by_ring.size(), 30U);
    int turns = 0;
    double before = 0.0, way = 1.0;
    int at = 0;
    for (const auto& [ring, share] : by_ring) {
        if (at > 0 && ring - at > 2) {
            const double slope = (share - before) / ((ring - at) * 1e-4) * painted;
            EXPECT_GT(std::abs(slope), 0.6) << "at " << ring * 1e-4;
            EXPECT_LT(std::abs(slope), 1.5) << "at " << ring * 1e-4;
            if (slope * way < 0.0) {
                ++turns;
                way = -way;
                EXPECT_TRUE(before < 0.001 || before > 0.999) << "it turns where an image ends";
            }
        }
        at = ring;
        before = share;
    }
    EXPECT_EQ(turns, 3);
}

TEST(ColonySkin, EachStemIsOnePieceThatEndsInsideItsNeck) {
    ColonyParams params;
    for (const Habit habit : {Habit::tuft, Habit::troop, Habit::tier})
        for (const double thick : {0.002, 0.004, 0.016}) {
            ColonyTraits traits;
            traits.habit = habit;
            const StemFit fit{thick, 0.08, 0.085, 0.03};
            const ColonySite site =
                colony_site(params, traits, colony_growth(params, traits, fit), {fit, fit});
            const std::vector<ColonyMember> members = unmoved(site);
            const ColonySkin skin = colony_skin(colony_skeleton(site, members, params, traits, 8),
                                                {0, fit.length, true});
            const Mesh& mesh = skin.mesh;
            expect_valid(mesh);
            EXPECT_EQ(pieces(mesh).size(), members.size())
                << name(habit) << " " << thick << ": no stem falls apart";
            if (habit == Habit::tier) continue;  // thick stems turn up there within their own width
            for (std::size_t m = 0; m < members.size(); ++m) {
                const ColonyMember& member = members[m];
                const ColonyPlace& place = site.places[member.place];
                const glm::dvec3 top = place.at(1.0), along = glm::normalize(place.along(1.0));
                double nearest = -1e9;
                for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
                    // Stems intersect before they are moved apart: only its own.
                    if (skin.stems[i] != m + 1) continue;
                    const glm::dvec3 from = glm::dvec3(mesh.positions[i]) - top;
                    const double up = glm::dot(from, along);
                    if (glm::length(from - up * along) < 0.3 * place.radius &&
                        std::abs(up) < 3.0 * place.radius)
                        nearest = std::max(nearest, up);
                }
                EXPECT_LT(nearest, 0.0) << "under the junction";
                EXPECT_GT(nearest, -0.9 * place.radius) << "and above the bottom of the neck";
            }
        }
}

TEST(ColonySkin, WithoutStemsOrRootsThereIsNone) {
    EXPECT_TRUE(colony_skin({}, {}).mesh.positions.empty());
}

}  // namespace
}  // namespace sporeprint::colony_colony_skin_test
