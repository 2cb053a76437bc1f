#include "core/plant/foot_soil.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/vector_relational.hpp>
#include <string>
#include <vector>

#include "core/mesh/measure.h"
#include "core/plant/root_flare.h"
#include "core/plant/tree_spec.h"
#include "tests/support/atlas.h"
#include "tests/support/meshes.h"

namespace sporeprint::plant_foot_soil_test {
namespace {

constexpr double flare = 0.7;

struct Grown {
    Tree tree;
    Bark bark;
    std::size_t before = 0, added = 0;
};

Grown grown(const char* preset, std::uint32_t seed, int lod) {
    Grown made;
    made.tree = grown_tree(params_of(*atlas().find_tree(preset)).look.shape, seed);
    made.bark = bark_of(made.tree, lod);
    flare_roots(made.bark, made.tree, flare, seed, lod);
    made.before = made.bark.mesh.positions.size();
    made.added = add_foot_soil(made.bark, made.tree, flare, seed, lod);
    return made;
}

TEST(BarkFootSoil, IsALowClosedMoundOfTheExpectedCount) {
    for (const char* preset : {"broadleaf", "birch", "shrub"})
        for (const std::uint32_t seed : {1U, 2U})
            for (int lod = 0; lod < tree_lods; ++lod) {
                SCOPED_TRACE(std::string(preset) + " at level " + std::to_string(lod));
                const Grown made = grown(preset, seed, lod);
                const Mesh& mesh = made.bark.mesh;
                expect_valid(mesh);
                EXPECT_EQ(made.bark.edges.size(), mesh.positions.size());
                EXPECT_EQ(made.before + made.added, mesh.positions.size());
                const TreeCount count = count_of_foot_soil(atlas().find_tree(preset)->shape, lod);
                EXPECT_EQ(static_cast<double>(mesh.positions.size() - made.before), count.vertices);
                const double radius = made.tree.skeleton.nodes.front().radius;
                double reach = 0.0, top = 0.0;
                for (std::size_t i = made.before; i < mesh.positions.size(); ++i) {
                    const glm::dvec3 p(mesh.positions[i]);
                    reach = std::max(reach, std::hypot(p.x, p.z));
                    top = std::max(top, p.y);
                    EXPECT_GT(p.y, -0.2 * radius);
                }
                EXPECT_GT(reach, 2.0 * radius);
                EXPECT_LT(reach, 8.0 * radius);
                EXPECT_GT(top, 0.2 * radius);
                EXPECT_LT(top, radius);
            }
}

TEST(BarkFootSoil, OfNoFlareIsNone) {
    Grown made = grown("broadleaf", 1, 2);
    const std::size_t all = made.bark.mesh.positions.size();
    EXPECT_EQ(add_foot_soil(made.bark, made.tree, 0.0, 1, 2), 0U);
    EXPECT_EQ(made.bark.mesh.positions.size(), all);
}

TEST(BarkFootSoil, TintsAreFactorsAndBlackenTheFootAlone) {
    const Grown made = grown("birch", 1, 0);
    const std::size_t all = made.bark.mesh.positions.size();
    std::vector<glm::vec3> tints(all, glm::vec3(1.0F));
    tint_foot(tints, made.bark, made.tree, flare, 1, made.added, 0.9, glm::vec3(0.7F));
    const double radius = made.tree.skeleton.nodes.front().radius;
    double darkest = 1.0;
    for (std::size_t i = 0; i < all; ++i) {
        EXPECT_TRUE(glm::all(glm::greaterThan(tints[i], glm::vec3(0.0F))));
        EXPECT_TRUE(glm::all(glm::lessThanEqual(tints[i], glm::vec3(1.0F))));
        if (static_cast<double>(made.bark.mesh.positions[i].y) > 10.0 * radius) {
            EXPECT_EQ(tints[i], glm::vec3(1.0F));
        } else if (i < made.before) {
            darkest = std::min(darkest, static_cast<double>(tints[i].x));
        }
    }
    EXPECT_LT(darkest, 0.3);
}

TEST(BarkFootSoil, TintsOfBarkAreTheSameWithoutSoil) {
    Grown made = grown("birch", 1, 0);
    std::vector<glm::vec3> with(made.before + made.added, glm::vec3(1.0F)),
        without(made.before, glm::vec3(1.0F));
    tint_foot(with, made.bark, made.tree, flare, 1, made.added, 0.9, glm::vec3(0.7F));
    made.bark.mesh.positions.resize(made.before);
    tint_foot(without, made.bark, made.tree, flare, 1, 0, 0.9, glm::vec3(0.7F));
    with.resize(made.before);
    EXPECT_EQ(with, without);
}

}  // namespace
}  // namespace sporeprint::plant_foot_soil_test
