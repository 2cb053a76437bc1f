#include "core/render/close_up.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "tests/support/refusals.h"
#include "tests/support/solids.h"

namespace sporeprint::render::render_close_up_test {
namespace {

PictureParams viewed(View view, double turn_deg = -30.0) {
    PictureParams params;
    params.view = view;
    params.turn_deg = turn_deg;  // the camera stands at +Z
    return params;
}

/// Adds a mesh to another one.
void add(Mesh& mesh, const Mesh& one) {
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    mesh.positions.insert(mesh.positions.end(), one.positions.begin(), one.positions.end());
    mesh.normals.insert(mesh.normals.end(), one.normals.begin(), one.normals.end());
    for (const std::uint32_t i : one.indices) mesh.indices.push_back(first + i);
}

/// Returns a cap on a thin stem that stands on the origin.
Mesh mushroom(float height, float radius) {
    Mesh mesh = ball(radius, {0.0F, height, 0.0F});
    for (glm::vec3& at : mesh.positions) at.y = height + 0.3F * (at.y - height);
    Mesh stem = ball(0.5F * height, {0.0F, 0.5F * height, 0.0F});
    for (glm::vec3& at : stem.positions) at = {0.1F * at.x, at.y, 0.1F * at.z};
    add(mesh, stem);
    return mesh;
}

TEST(CloseUp, TheMarginIsTheOutermostPointTowardsTheCamera) {
    const Mesh mesh = mushroom(0.2F, 0.1F);
    const GlbScene scene = scene_of(mesh);
    const DrawList list = draw_list(scene, in_turn);
    const CloseUp front = close_up_of(list, viewed(View::margin));
    EXPECT_NEAR(glm::distance(front.target, glm::vec3(0.0F, 0.2F, 0.1F)), 0.0F, 1e-4F);
    EXPECT_FLOAT_EQ(front.frame, 0.05F);
    const CloseUp side = close_up_of(list, viewed(View::margin, 60.0));
    EXPECT_NEAR(glm::distance(side.target, glm::vec3(0.1F, 0.2F, 0.0F)), 0.0F, 1e-4F);
}

TEST(CloseUp, TheUndersideIsOnTheLowerFaceOfTheCap) {
    const Mesh mesh = mushroom(0.2F, 0.1F);
    const GlbScene scene = scene_of(mesh);
    const CloseUp found = close_up_of(draw_list(scene, in_turn), viewed(View::underside));
    EXPECT_LT(found.target.y, 0.2F - 0.02F);
    EXPECT_GT(found.target.y, 0.2F - 0.03F);
    EXPECT_NEAR(found.target.z, 0.06F, 1e-3F);
    EXPECT_GT(found.axes.forward.y, 0.5F) << "seen from below";
}

TEST(CloseUp, TheBaseIsALittleAboveTheGround) {
    const Mesh mesh = mushroom(0.2F, 0.1F);
    const GlbScene scene = scene_of(mesh);
    const CloseUp found = close_up_of(draw_list(scene, in_turn), viewed(View::base));
    EXPECT_EQ(found.target.x, 0.0F);
    EXPECT_GT(found.target.y, 0.0F);
    EXPECT_LT(found.target.y, 0.5F * found.frame);
    EXPECT_FLOAT_EQ(found.frame, 0.08F);
    const Mesh tall = mushroom(8.0F, 1.0F);
    const GlbScene tree = scene_of(tall);
    EXPECT_NEAR(close_up_of(draw_list(tree, in_turn), viewed(View::base)).frame, 1.04F, 0.01F);
}

TEST(CloseUp, TheBaseOfWhatGrowsSidewaysIsSeenFromBelow) {
    const Mesh bracket = ball(0.05F, {0.0F, 0.0F, 0.08F});
    const GlbScene scene = scene_of(bracket);
    const CloseUp found = close_up_of(draw_list(scene, in_turn), viewed(View::base));
    EXPECT_EQ(found.target, glm::vec3(0.0F));
    EXPECT_GT(found.axes.forward.y, 0.4F);
    EXPECT_LT(found.axes.forward.z, 0.0F) << "from the side that it grows to";
}

TEST(CloseUp, SmallThingsAreNotSeenWholeInIt) {
    const Mesh mesh = mushroom(0.01F, 0.005F);
    const GlbScene scene = scene_of(mesh);
    const DrawList list = draw_list(scene, in_turn);
    for (const View view : {View::margin, View::underside, View::base})
        EXPECT_NEAR(close_up_of(list, viewed(view)).frame, 0.7F * 0.0115F, 1e-5F);
}

TEST(CloseUp, OfManyItLooksAtTheForemostAndNeverAtWhatCarriesThem) {
    const Mesh mesh = mushroom(0.1F, 0.03F);
    const Mesh log = ball(2.0F, {0.0F, 0.0F, 0.0F});
    GlbScene scene = scene_of(mesh);
    scene.nodes.front().translation = {0.0, 0.0, -1.0};
    scene.nodes.push_back({.name = "near", .mesh = 0, .translation = {0.3, 0.0, 1.0}});
    scene.nodes.push_back({.name = "log", .mesh = scene.meshes.size()});
    scene.meshes.push_back({"log", {{&log, 0}}, GlbRole::carrier});
    const DrawList list = draw_list(scene, in_turn);
    EXPECT_NEAR(
        glm::distance(close_up_of(list, viewed(View::margin)).target, glm::vec3(0.3F, 0.1F, 1.03F)),
        0.0F, 1e-4F);
    EXPECT_NEAR(close_up_of(list, viewed(View::base)).target.x, 0.3F, 1e-6F);
    EXPECT_LT(close_up_of(list, viewed(View::margin, 150.0)).target.z, -0.9F) << "from behind";
}

// Between the middle and the margin of four balls is no mesh: the nearest underside is looked at.
TEST(CloseUp, TheUndersideIsTheNearestOneIfNoneIsAtItsPlace) {
    Mesh mesh;
    for (const glm::vec3 at : {glm::vec3(1.0F, 0.5F, 1.0F), glm::vec3(-1.0F, 0.5F, 1.0F),
                               glm::vec3(1.0F, 0.5F, -1.0F), glm::vec3(-1.0F, 0.5F, -1.0F)})
        add(mesh, ball(0.05F, at));
    const GlbScene scene = scene_of(mesh);
    const CloseUp found = close_up_of(draw_list(scene, in_turn), viewed(View::underside));
    EXPECT_NEAR(std::abs(found.target.x), 1.0F, 0.05F);
    EXPECT_NEAR(found.target.z, 1.0F, 0.05F);
    EXPECT_LT(found.target.y, 0.5F);
}

TEST(CloseUp, WhatDoesNotFaceDownwardsHasNoUnderside) {
    Mesh sheet;
    sheet.positions = {{0.0F, 0.0F, 0.0F}, {0.0F, 0.0F, 1.0F}, {1.0F, 0.0F, 0.0F}};
    sheet.normals.assign(3, {0.0F, 1.0F, 0.0F});
    sheet.indices = {0, 1, 2};
    const GlbScene scene = scene_of(sheet);
    const DrawList list = draw_list(scene, in_turn);
    EXPECT_TRUE(names(refusal([&] { (void)close_up_of(list, viewed(View::underside)); }), "/view",
                      "no underside"));
}

TEST(CloseUp, ItsCameraShowsTheFrameAroundTheTarget) {
    for (const double aspect : {0.5, 1.0, 2.0}) {
        const CloseUp wanted{{0.3F, 0.1F, -0.2F}, camera_axes(40, -20), 0.05F};
        const Camera camera = camera_of(wanted, aspect);
        const glm::vec3 middle = camera.seen(wanted.target);
        EXPECT_NEAR(middle.x, 0.0F, 1e-6F);
        EXPECT_NEAR(middle.y, 0.0F, 1e-6F);
        const glm::vec3 edge = camera.seen(
            wanted.target + (aspect < 1.0 ? wanted.axes.right : wanted.axes.up) * 0.025F);
        const float reach =
            aspect < 1.0 ? edge.x / edge.z / camera.tangent_x : edge.y / edge.z / camera.tangent_y;
        EXPECT_NEAR(reach, 1.0F, 1e-4F) << aspect;
        EXPECT_GT(camera.nearest, 0.0F);
        EXPECT_LT(camera.nearest, middle.z);
    }
}

}  // namespace
}  // namespace sporeprint::render::render_close_up_test
