#include "core/mesh/thickness.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <functional>
#include <span>
#include <thread>

#include "tests/support/meshes.h"
#include "tests/support/solids.h"

namespace sporeprint::mesh_thickness_test {
namespace {

/// Returns the vertex of a face nearest to a place.
std::size_t nearest(const Mesh& mesh, const glm::vec3& place, const glm::vec3& normal) {
    std::size_t best = 0;
    float least = 1e9F;
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        const float apart = glm::distance(mesh.positions[i], place);
        if (mesh.normals[i] != normal || apart >= least) continue;
        least = apart;
        best = i;
    }
    return best;
}

constexpr glm::vec3 up(0.0F, 1.0F, 0.0F);

TEST(Thickness, ThatOfAPlateIsTheDistanceOfItsFaces) {
    const Mesh mesh = plate(0.1F, 0.003F);
    EXPECT_GT(volume(mesh), 0.0);
    const std::vector<float> found = thickness(mesh, 0.02);
    for (const float side : {1.0F, -1.0F})
        EXPECT_NEAR(found[nearest(mesh, {0.0F, side * 0.0015F, 0.0F}, up * side)], 0.003F, 1e-6F);
    for (const float x : found) {
        EXPECT_GT(x, 0.0F);
        EXPECT_LE(x, 0.02F);
    }
}

TEST(Thickness, ThatOfABallIsItsDiameterEverywhere) {
    for (const float radius : {0.0005F, 0.02F}) {
        const Mesh mesh = ball(radius, {0.3F, -0.1F, 0.2F});
        for (const float x : thickness(mesh, 0.1)) EXPECT_NEAR(x / radius, 2.0F, 0.03F);
    }
}

TEST(Thickness, LargerOnesAreCutOff) {
    for (const float x : thickness(ball(0.02F, glm::vec3(0.0F)), 0.004)) EXPECT_EQ(x, 0.004F);
}

TEST(Thickness, WhatIsInsideOfAnotherPartIsInside) {
    // A tile that lies on a plate and reaches a third of its own thickness into it.
    Mesh mesh = plate(0.1F, 0.004F);
    append(mesh, plate(0.03F, 0.003F, {0.0F, 0.0025F, 0.0F}));
    const std::vector<float> found = thickness(mesh, 0.02);
    EXPECT_NEAR(found[nearest(mesh, {0.0F, 0.004F, 0.0F}, up)], 0.006F, 1e-6F);
    EXPECT_NEAR(found[nearest(mesh, {0.04F, 0.002F, 0.04F}, up)], 0.004F, 1e-6F);
}

TEST(Thickness, IsTheSameInAnyOrderOfTasks) {
    const Mesh mesh = ball(0.01F, glm::vec3(0.0F), 96, 48);
    const std::vector<float> one = thickness(mesh, 0.015);
    const auto backwards = [](std::span<const std::function<void()>> tasks) {
        std::vector<std::thread> threads;
        for (std::size_t i = tasks.size(); i > 0; --i) threads.emplace_back(tasks[i - 1]);
        for (std::thread& thread : threads) thread.join();
    };
    EXPECT_TRUE(same_bits(one, thickness(mesh, 0.015, backwards)));
}

}  // namespace
}  // namespace sporeprint::mesh_thickness_test
