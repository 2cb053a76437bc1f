#include "core/plant/root_flare.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <string>

#include "core/mesh/measure.h"
#include "core/plant/tree_spec.h"
#include "tests/support/atlas.h"
#include "tests/support/meshes.h"

namespace sporeprint::plant_root_flare_test {
namespace {

struct Grown {
    Tree tree;
    Bark bark;
    double radius = 0.0;
};

Grown grown(const char* preset, std::uint32_t seed, int lod) {
    Grown made;
    made.tree = grown_tree(params_of(*atlas().find_tree(preset)).look.shape, seed);
    made.bark = bark_of(made.tree, lod);
    made.radius = made.tree.skeleton.nodes.front().radius;
    return made;
}

/// Returns the largest distance from the axis below a height.
double reach(const Mesh& mesh, double below) {
    double most = 0.0;
    for (const glm::vec3& p : mesh.positions)
        if (static_cast<double>(p.y) < below)
            most = std::max(most, std::hypot(static_cast<double>(p.x), static_cast<double>(p.z)));
    return most;
}

TEST(PlantFoot, LetsTheTrunkAloneReachBelowTheGround) {
    for (const char* preset : {"broadleaf", "birch", "spruce"})
        for (int lod = 0; lod < tree_lods; ++lod) {
            SCOPED_TRACE(std::string(preset) + " at level " + std::to_string(lod));
            const Grown before = grown(preset, 3, lod);
            Grown after = before;
            plant_foot(after.bark, after.tree);
            expect_valid(after.bark.mesh);
            EXPECT_LT(bounds(after.bark.mesh).min.y,
                      bounds(before.bark.mesh).min.y - 0.9 * after.radius);
            EXPECT_GT(volume(after.bark.mesh), volume(before.bark.mesh));
            for (std::size_t i = 0; i < after.bark.mesh.positions.size(); ++i)
                if (static_cast<double>(before.bark.mesh.positions[i].y) > 0.1 * before.radius) {
                    EXPECT_EQ(after.bark.mesh.positions[i], before.bark.mesh.positions[i]);
                }
        }
}

TEST(RootFlare, WidensTheFootAndNothingElse) {
    for (const char* preset : {"broadleaf", "birch", "spruce", "poplar"})
        for (const std::uint32_t seed : {1U, 2U, 3U})
            for (int lod = 0; lod < tree_lods; ++lod) {
                SCOPED_TRACE(std::string(preset) + " at level " + std::to_string(lod));
                const Grown before = grown(preset, seed, lod);
                Grown after = before;
                flare_roots(after.bark, after.tree, 1.0, seed, lod);
                expect_valid(after.bark.mesh);
                // There are more triangles, and no more than was counted.
                const std::size_t more = after.bark.mesh.triangles() - before.bark.mesh.triangles();
                TreeShape shape = params_of(*atlas().find_tree(preset)).look.shape;
                shape.root_flare = 1.0;
                EXPECT_LE(static_cast<double>(more), count_of_flare(shape, lod).triangles);
                EXPECT_GT(more, 0U);
                EXPECT_EQ(after.bark.edges.size(), after.bark.mesh.positions.size());
                EXPECT_GT(volume(after.bark.mesh), volume(before.bark.mesh));
                const double low = 0.3 * before.radius;
                EXPECT_GT(reach(after.bark.mesh, low), 1.3 * reach(before.bark.mesh, low));
                EXPECT_LT(reach(after.bark.mesh, low), 2.6 * reach(before.bark.mesh, low));
                for (std::size_t i = 0; i < before.bark.mesh.positions.size(); ++i) {
                    const glm::vec3 was = before.bark.mesh.positions[i],
                                    is = after.bark.mesh.positions[i];
                    // Roots dip below the ground.
                    EXPECT_LE(is.y, was.y);
                    EXPECT_GT(static_cast<double>(is.y),
                              static_cast<double>(was.y) - before.radius);
                    if (static_cast<double>(was.y) > 7.0 * before.radius) {
                        EXPECT_EQ(was, is);
                    }
                }
            }
}

TEST(RootFlare, OfZeroChangesNothingAndEachSeedHasOtherRoots) {
    const Grown plain = grown("broadleaf", 1, 0);
    const auto flared = [&](double flare, std::uint32_t seed) {
        Bark bark = plain.bark;
        flare_roots(bark, plain.tree, flare, seed, 0);
        return bark.mesh;
    };
    EXPECT_TRUE(same_bits(flared(0.0, 1), plain.bark.mesh));
    EXPECT_TRUE(same_bits(flared(1.0, 1), flared(1.0, 1)));
    EXPECT_NE(flared(1.0, 1).positions, flared(1.0, 2).positions);
}

TEST(RootFlare, NormalsFollow) {
    Grown made = grown("poplar", 4, 0);
    flare_roots(made.bark, made.tree, 1.5, 4, 0);
    const Mesh& mesh = made.bark.mesh;
    int along = 0, all = 0;
    for (std::size_t t = 0; t < mesh.indices.size(); t += 3) {
        const auto at = [&](std::size_t k) {
            return glm::dvec3(mesh.positions[mesh.indices[t + k]]);
        };
        const glm::dvec3 face = glm::cross(at(1) - at(0), at(2) - at(0));
        if (at(0).y < 0.1 * made.radius || at(0).y > 4.0 * made.radius ||
            !(glm::length(face) > 0.0))
            continue;
        glm::dvec3 mean(0.0);
        for (std::size_t k = 0; k < 3; ++k) mean += glm::dvec3(mesh.normals[mesh.indices[t + k]]);
        ++all;
        along += glm::dot(glm::normalize(face), glm::normalize(mean)) > 0.9 ? 1 : 0;
    }
    EXPECT_GT(all, 50);
    EXPECT_GT(along, all * 95 / 100);
    for (std::size_t i = 0; i < mesh.normals.size(); ++i) {
        EXPECT_NEAR(glm::length(mesh.normals[i]), 1.0F, 1e-5F);
        EXPECT_NEAR(glm::dot(mesh.normals[i], glm::vec3(mesh.tangents[i])), 0.0F, 1e-4F);
    }
}

}  // namespace
}  // namespace sporeprint::plant_root_flare_test
