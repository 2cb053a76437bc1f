#include "core/colony/colony_ground.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <vector>

#include "core/mesh/measure.h"
#include "tests/support/meshes.h"

namespace sporeprint::colony_colony_ground_test {
namespace {

GroundLayer layer_of(double weight = 1.0) {
    GroundLayer layer;
    layer.style.soil = {0.006, 0.001, 60, 0.0015};
    layer.style.litter.pieces = 20;
    layer.style.strands.count = 6;
    layer.stream = 7;
    layer.weight = weight;
    return layer;
}

ColonyTraits traits_of(Habit habit) {
    ColonyTraits traits;
    traits.habit = habit;
    return traits;
}

/// Feet on a line, as far apart as stated, leaning away from each other.
std::vector<ColonyFoot> feet_on_a_line(int count, double apart) {
    std::vector<ColonyFoot> feet;
    for (int i = 0; i < count; ++i) {
        const double from_middle = i - 0.5 * (count - 1);
        feet.push_back({{apart * from_middle, 0.0, 0.0},
                        glm::normalize(glm::dvec3(0.2 * from_middle, 1.0, 0.0)),
                        0.008,
                        0.012,
                        static_cast<std::uint32_t>(i)});
    }
    return feet;
}

constexpr Habit in_soil[] = {Habit::tuft, Habit::troop, Habit::ring};

TEST(ColonyGround, LiesBelowWhatStandsNeitherOnWoodNorOnVisibleRoots) {
    EXPECT_TRUE(stands_in_soil(traits_of(Habit::tuft)));
    EXPECT_TRUE(stands_in_soil(traits_of(Habit::ring)));
    EXPECT_FALSE(stands_in_soil(traits_of(Habit::tier)));
    ColonyTraits rooted = traits_of(Habit::rooted);
    EXPECT_TRUE(stands_in_soil(rooted));
    rooted.roots = RootsShown::shown;
    EXPECT_FALSE(stands_in_soil(rooted));
    EXPECT_EQ(colony_ground_count({layer_of()}, rooted, 5, 0).triangles, 0U);
}

TEST(ColonyGround, HasTheCountsThatArePredicted) {
    for (const Habit habit : in_soil)
        for (const int count : {1, 5, 24})
            for (int lod = 0; lod < 4; ++lod) {
                const std::vector<GroundLayer> layers = {layer_of(0.6), layer_of(0.0)};
                const Mesh mesh = colony_ground(layers, feet_on_a_line(count, 0.03),
                                                traits_of(habit), count, lod, true);
                const MeshCount expected =
                    colony_ground_count(layers, traits_of(habit), count, lod);
                EXPECT_EQ(mesh.positions.size(), expected.vertices) << count << lod;
                EXPECT_EQ(mesh.triangles(), expected.triangles) << count << lod;
            }
}

TEST(ColonyGround, EveryPieceIsClosedAndTurnedOutwards) {
    for (const Habit habit : in_soil)
        for (int lod = 0; lod < 3; ++lod) {
            const Mesh mesh = colony_ground({layer_of()}, feet_on_a_line(4, 0.02), traits_of(habit),
                                            4, lod, true);
            expect_valid(mesh);
            for (const Mesh& piece : pieces(mesh)) EXPECT_GT(volume(piece), 0.0) << lod;
        }
}

// Many feet have coarser ground, and at far levels none, so that it never outweighs its colony.
TEST(ColonyGround, IsCoarserOfMoreFeetAndAtFartherLevels) {
    const std::vector<GroundLayer> layers = {layer_of()};
    for (const Habit habit : in_soil) {
        const ColonyTraits traits = traits_of(habit);
        for (const int count : {1, 24, 256}) {
            std::uint64_t nearer = 20'001;
            for (int lod = 0; lod < 4; ++lod) {
                const std::uint64_t own = colony_ground_count(layers, traits, count, lod).triangles;
                EXPECT_LE(own, nearer) << count << lod;
                nearer = own;
            }
        }
        EXPECT_GT(colony_ground_count(layers, traits, 256, 0).triangles, 256U);
        EXPECT_GT(colony_ground_count(layers, traits, 24, 3).triangles, 0U);
        EXPECT_LE(colony_ground_count(layers, traits, 256, 3).triangles, 450U);
    }
}

// A tuft has one clod whose outline is that of its stems, not a disc.
TEST(ColonyGround, TheOutlineOfATuftFollowsItsFeet) {
    const std::vector<ColonyFoot> feet = feet_on_a_line(5, 0.015);
    const Mesh mesh = colony_ground({layer_of()}, feet, traits_of(Habit::tuft), 5, 3, false);
    const Bounds box = bounds(mesh);
    const auto size = glm::dvec3(box.max) - glm::dvec3(box.min);
    EXPECT_GT(size.x, 1.6 * size.z);
    EXPECT_LT(static_cast<double>(box.min.x), feet.front().at.x - feet.front().radius);
    EXPECT_GT(static_cast<double>(box.max.x), feet.back().at.x + feet.back().radius);
    EXPECT_LT(static_cast<double>(box.min.y), -0.012) << "its stems end in the clod";
}

TEST(ColonyGround, EachFootHasAClodOfItsOwnShape) {
    const std::vector<ColonyFoot> feet = feet_on_a_line(2, 1.0);
    std::vector<ColonyFoot> one = {feet[0]}, other = {feet[0]};
    other[0].number = 1;
    const ColonyTraits traits = traits_of(Habit::troop);
    const Mesh first = colony_ground({layer_of()}, one, traits, 1, 2, false);
    const Mesh second = colony_ground({layer_of()}, other, traits, 1, 2, false);
    ASSERT_EQ(first.positions.size(), second.positions.size());
    float farthest = 0.0F;
    for (std::size_t i = 0; i < first.positions.size(); ++i)
        farthest = std::max(farthest, glm::distance(first.positions[i], second.positions[i]));
    EXPECT_GT(farthest, 0.0005F);
}

TEST(ColonyGround, TheFootOfAMeshIsWhatIsBelowTheGround) {
    Mesh mesh;
    for (int i = 0; i < 32; ++i) {
        const double turn = 0.19634954084936207 * i;
        const auto x = static_cast<float>(std::cos(turn)), z = static_cast<float>(std::sin(turn));
        mesh.positions.emplace_back(0.01F * x, -0.004F, 0.01F * z);
        mesh.positions.emplace_back(0.03F * x, 0.02F, 0.03F * z);
    }
    const ColonyFoot foot = foot_of(mesh);
    EXPECT_NEAR(foot.radius, 0.01, 1e-6);
    EXPECT_NEAR(foot.depth, 0.004, 1e-8);
}

}  // namespace
}  // namespace sporeprint::colony_colony_ground_test
