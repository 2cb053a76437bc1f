#include "core/render/clipping.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <glm/geometric.hpp>
#include <numeric>

#include "core/math/random.h"
#include "core/render/visibility.h"

namespace sporeprint::render::render_clipping_test {
namespace {

constexpr int side = 96;

Camera near_camera() {
    Camera camera;
    camera.nearest = 0.1F;
    return camera;
}

/// Returns where a corner in the axes of a camera is in a square image.
SnappedCorner in_image(const glm::vec3& at, const Camera& camera) {
    const float half = 0.5F * side;
    return snapped({half + at.x / at.z * half / camera.tangent_x,
                    half - at.y / at.z * half / camera.tangent_y, 1.0F / at.z});
}

/// Returns how often each pixel is in a part of a triangle.
std::vector<int> coverage(const ClippedTriangles& parts, const Camera& camera) {
    std::vector<int> count(static_cast<std::size_t>(side) * side, 0);
    for (std::size_t i = 0; i < parts.indices.size(); i += 3)
        rasterize(in_image(parts.corners[parts.indices[i]], camera),
                  in_image(parts.corners[parts.indices[i + 1]], camera),
                  in_image(parts.corners[parts.indices[i + 2]], camera), side, side,
                  [&](int x, int y, float) { ++count[static_cast<std::size_t>(y * side + x)]; });
    return count;
}

TEST(Clipping, WhatIsInsideStaysAsItIsAndWhatIsOutsideGoes) {
    const std::vector<glm::vec3> vertices{{-0.1F, -0.1F, 1.0F}, {0.1F, -0.1F, 1.0F},
                                          {0.0F, 0.1F, 1.0F},   {3.0F, 0.0F, 1.0F},
                                          {4.0F, 0.0F, 1.0F},   {3.0F, 1.0F, 1.0F}};
    const std::vector<std::uint32_t> indices{3, 4, 5, 0, 1, 2};
    const ClippedTriangles parts = clipped(vertices, indices, near_camera());
    EXPECT_EQ(parts.corners, vertices);
    EXPECT_EQ(parts.indices, (std::vector<std::uint32_t>{0, 1, 2}));
    EXPECT_EQ(parts.of, (std::vector<std::uint32_t>{3}));
}

TEST(Clipping, AllCornersAreInTheImage) {
    const Camera camera = near_camera();
    Random random(7, 0);
    const auto point = [&] {
        const double x = random.uniform(-2.0, 2.0), y = random.uniform(-2.0, 2.0),
                     z = random.uniform(-2.0, 2.0);
        return glm::vec3(glm::dvec3(x, y, z));
    };
    std::size_t found = 0;
    for (int round = 0; round < 2000; ++round) {
        std::vector<glm::vec3> vertices;
        for (int i = 0; i < 3; ++i) vertices.push_back(point());
        const std::vector<std::uint32_t> indices{0, 1, 2};
        const ClippedTriangles parts = clipped(vertices, indices, camera);
        for (const std::uint32_t i : parts.indices) {
            const glm::vec3& at = parts.corners[i];
            EXPECT_GE(at.z, camera.nearest - 1e-5F);
            EXPECT_LE(std::abs(at.x), at.z * camera.tangent_x + 1e-5F);
            EXPECT_LE(std::abs(at.y), at.z * camera.tangent_y + 1e-5F);
        }
        found += parts.of.size();
    }
    EXPECT_GT(found, 200U);
}

// A fan of triangles around a point in the image covers all of it, far beyond its borders.
TEST(Clipping, PartsOfNeighboursMeetWithoutGapsAndOverlaps) {
    const Camera camera = near_camera();
    Random random(11, 0);
    for (int round = 0; round < 200; ++round) {
        const auto count = static_cast<std::uint32_t>(random.uniform(3.0, 12.0));
        const double tilt_x = random.uniform(-0.5, 0.5), tilt_y = random.uniform(-0.5, 0.5),
                     middle_x = random.uniform(-0.2, 0.2), middle_y = random.uniform(-0.2, 0.2);
        const auto on_plane = [&](double x, double y) {
            return glm::vec3(glm::dvec3(x, y, 1.0 + tilt_x * x + tilt_y * y));
        };
        std::vector<glm::vec3> vertices{on_plane(middle_x, middle_y)};
        const double turn = random.uniform(0.0, 6.0);
        std::vector<std::uint32_t> indices;
        for (std::uint32_t i = 0; i < count; ++i) {
            const double angle = turn + 6.283185307179586 * i / count,
                         reach = random.uniform(1.2, 9.0);
            vertices.push_back(on_plane(reach * std::cos(angle), reach * std::sin(angle)));
            indices.insert(indices.end(), {0, i + 1, (i + 1) % count + 1});
        }
        const std::vector<int> times = coverage(clipped(vertices, indices, camera), camera);
        EXPECT_EQ(std::count(times.begin(), times.end(), 1),
                  static_cast<std::ptrdiff_t>(times.size()))
            << round;
    }
}

TEST(Clipping, WhatIsNearerThanAllowedIsLeftOut) {
    const Camera camera = near_camera();
    const std::vector<glm::vec3> wall{
        {-9.0F, -9.0F, 0.09F}, {9.0F, -9.0F, 0.09F}, {0.0F, 9.0F, 0.09F}};
    const std::vector<std::uint32_t> indices{0, 1, 2};
    EXPECT_TRUE(clipped(wall, indices, camera).indices.empty());
}

TEST(Clipping, PartsTellTheTriangleTheyAreOf) {
    const Camera camera = near_camera();
    const std::vector<glm::vec3> vertices{{-5.0F, -5.0F, 1.0F}, {5.0F, -5.0F, 1.0F},
                                          {0.0F, 9.0F, 1.0F},   {-5.0F, -5.0F, 2.0F},
                                          {5.0F, -5.0F, 2.0F},  {0.0F, 9.0F, 2.0F}};
    const std::vector<std::uint32_t> indices{0, 1, 2, 3, 4, 5};
    const ClippedTriangles parts = clipped(vertices, indices, camera);
    ASSERT_GT(parts.of.size(), 2U);
    EXPECT_EQ(parts.of.size() * 3, parts.indices.size());
    for (std::size_t i = 0; i < parts.of.size(); ++i)
        EXPECT_EQ(parts.corners[parts.indices[3 * i]].z, parts.of[i] == 0 ? 1.0F : 2.0F);

    Visibility shown(side, side);
    std::vector<SnappedCorner> corners;
    for (const glm::vec3& at : parts.corners) corners.push_back(in_image(at, camera));
    shown.show(4, parts.indices, corners, 0, side, parts.of);
    EXPECT_TRUE(std::all_of(shown.corner.begin(), shown.corner.end(), [](std::uint32_t corner) {
        return corner == 0;
    })) << "the nearer triangle covers the image";
}

}  // namespace
}  // namespace sporeprint::render::render_clipping_test
