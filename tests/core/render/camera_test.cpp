#include "core/render/camera.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "tests/support/solids.h"

namespace sporeprint::render::render_camera_test {
namespace {

TEST(Camera, ItsAxesAreARightHandedFrame) {
    for (const double azimuth : {-180.0, -30.0, 0.0, 77.0, 315.0})
        for (const double elevation : {-90.0, -32.0, 0.0, 18.0, 90.0}) {
            const CameraAxes axes = camera_axes(azimuth, elevation);
            for (const glm::vec3& axis : {axes.right, axes.up, axes.forward})
                EXPECT_NEAR(glm::length(axis), 1.0F, 1e-6F);
            EXPECT_NEAR(glm::distance(glm::cross(axes.right, axes.up), -axes.forward), 0.0F, 1e-6F);
        }
    EXPECT_NEAR(glm::distance(camera_axes(0, 0).forward, glm::vec3(0, 0, -1)), 0.0F, 1e-6F)
        << "the front of a product is +Z";
    EXPECT_NEAR(glm::distance(camera_axes(90, 0).forward, glm::vec3(-1, 0, 0)), 0.0F, 1e-6F);
}

/// Returns the largest distance of a vertex from the middle of the image, in halves of it.
double reach(const DrawList& list, const Camera& camera) {
    double most = 0.0;
    for (const Draw& draw : list.draws)
        for (const glm::vec3& at : draw.mesh->positions) {
            const glm::vec3 p = camera.seen(draw.placement.point(at));
            EXPECT_GT(p.z, 0.0F);
            most = std::max({most, std::abs(static_cast<double>(p.x / p.z / camera.tangent_x)),
                             std::abs(static_cast<double>(p.y / p.z / camera.tangent_y))});
        }
    return most;
}

TEST(Camera, ItIsAsNearAsTheMarginAllows) {
    const Mesh mesh = ball(0.05F, {0.3F, 0.02F, -1.0F});
    const GlbScene scene = scene_of(mesh);
    const DrawList list = draw_list(scene, in_turn);
    for (const double aspect : {0.2, 1.0, 3.0})
        for (const double elevation : {-32.0, 3.0, 90.0}) {
            const CameraAxes axes = camera_axes(40, elevation);
            const Camera camera = fitted_cameras(list, {&axes, 1}, aspect, -1.0F).front();
            EXPECT_NEAR(reach(list, camera), 0.9, 1e-3) << aspect << ' ' << elevation;
        }
}

// A ball sunk to its middle is as large in the picture as the half of it that is seen.
TEST(Camera, WhatIsUnderTheGroundTakesNoRoom) {
    const Mesh sunk = ball(0.05F, {0.0F, 0.0F, 0.0F});
    Mesh half = sunk;
    for (glm::vec3& at : half.positions) at.y = std::max(at.y, 0.0F);
    const GlbScene scene = scene_of(sunk), upper = scene_of(half);
    const DrawList list = draw_list(scene, in_turn), upper_list = draw_list(upper, in_turn);
    const CameraAxes axes = camera_axes(30, 18);
    const Camera camera = fitted_cameras(list, {&axes, 1}, 1.0, 0.0F).front(),
                 expected = fitted_cameras(upper_list, {&axes, 1}, 1.0, -1.0F).front();
    EXPECT_NEAR(glm::length(camera.position - expected.position), 0.0F, 1e-7F);
    EXPECT_GT(reach(list, camera), 0.9 + 1e-3);
}

TEST(Camera, ViewsOfATurntableHaveOneScale) {
    const Mesh mesh = ball(0.05F, {0.3F, 0.02F, 0.0F});
    const GlbScene scene = scene_of(mesh);
    const DrawList list = draw_list(scene, in_turn);
    std::vector<CameraAxes> axes;
    PictureParams params;
    params.view = View::turntable;
    for (int frame = 0; frame < 8; ++frame) {
        const glm::dvec2 angles = angles_of(params, frame);
        EXPECT_DOUBLE_EQ(angles.x, 45.0 * frame);
        axes.push_back(camera_axes(angles.x, angles.y));
    }
    double most = 0.0;
    const std::vector<Camera> cameras = fitted_cameras(list, axes, 1.0, -1.0F);
    for (const Camera& camera : cameras) {
        most = std::max(most, reach(list, camera));
        // The axis of the turntable is that of the product.
        EXPECT_NEAR(glm::length(camera.seen(glm::vec3(0.0F))),
                    glm::length(cameras.front().seen(glm::vec3(0.0F))), 1e-5F);
    }
    EXPECT_NEAR(most, 0.9, 1e-3);
}

}  // namespace
}  // namespace sporeprint::render::render_camera_test
