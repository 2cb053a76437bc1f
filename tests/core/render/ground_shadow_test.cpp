#include "core/render/ground_shadow.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/solids.h"

namespace sporeprint::render::render_ground_shadow_test {
namespace {

/// The shadow of a ball that lies on the ground.
struct Shadow {
    Mesh mesh = ball(0.05F, {0.0F, 0.05F, 0.0F});
    GlbScene scene = scene_of(mesh);
    DrawList list = draw_list(scene, in_turn);
    PictureLights lights = studio_lights(camera_axes(30, 18), 1);
    std::vector<ShadowMap> lamps = shadow_maps(list, lights.lamps, 128, in_turn),
                           sky = shadow_maps(list, lights.surroundings, 128, in_turn);
    GroundShadow ground{list.box, 0.0F, {lights.lamps, lamps}, {lights.surroundings, sky}, in_turn};
};

TEST(GroundShadow, ItIsDarkUnderTheSceneAndFadesWithDistance) {
    const Shadow shadow;
    EXPECT_FALSE(shadow.ground.empty());
    EXPECT_GT(shadow.ground.at(glm::vec3(0.0F)), 0.3F);
    EXPECT_LT(shadow.ground.at({0.2F, 0.0F, 0.0F}), 0.2F);
    EXPECT_EQ(shadow.ground.at({9.0F, 0.0F, 0.0F}), 0.0F);
    EXPECT_TRUE(GroundShadow().empty());
}

TEST(GroundShadow, ItIsTheSameOnAGroundAtAnotherHeight) {
    const Mesh mesh = ball(0.05F, {0.0F, -0.15F, 0.0F});
    const GlbScene scene = scene_of(mesh);
    const DrawList list = draw_list(scene, in_turn);
    const Shadow shadow;
    const std::vector<ShadowMap> lamps = shadow_maps(list, shadow.lights.lamps, 128, in_turn),
                                 sky = shadow_maps(list, shadow.lights.surroundings, 128, in_turn);
    const GroundShadow lower(list.box, -0.2F, {shadow.lights.lamps, lamps},
                             {shadow.lights.surroundings, sky}, in_turn);
    EXPECT_EQ(lower.level(), -0.2F);
    for (const glm::vec3& at :
         {glm::vec3(0.0F), glm::vec3(0.06F, 0.0F, 0.0F), glm::vec3(0.0F, 0.0F, -0.1F)})
        EXPECT_NEAR(lower.at(at), shadow.ground.at(at), 0.02F);
}

TEST(GroundShadow, ItFallsAwayFromTheLamp) {
    const Shadow shadow;
    const glm::vec3 lamp = shadow.lights.lamps.front().direction;
    const glm::vec3 away(-lamp.x, 0.0F, -lamp.z);
    EXPECT_GT(shadow.ground.at(away * 0.1F), shadow.ground.at(away * -0.1F) + 0.2F);
}

// Shadows of single lights of the sky are not seen apart: away from the lamp, darkness has no steps.
TEST(GroundShadow, TheShadowOfTheSkyIsSmooth) {
    const Shadow shadow;
    const glm::vec3 lamp = shadow.lights.lamps.front().direction;
    float before = 0.0F, steepest = 0.0F;
    for (int i = 0; i <= 200; ++i) {
        const float out = 0.05F + 0.001F * static_cast<float>(i);
        const float here = shadow.ground.at(glm::vec3(lamp.x, 0.0F, lamp.z) * out);
        if (i > 0) steepest = std::max(steepest, std::abs(here - before));
        before = here;
    }
    EXPECT_LT(steepest, 0.02F) << "per millimetre";
}

}  // namespace
}  // namespace sporeprint::render::render_ground_shadow_test
