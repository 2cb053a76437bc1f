#include "core/render/lighting.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <vector>

#include "core/surface/codecs.h"
#include "tests/support/solids.h"

namespace sporeprint::render::render_lighting_test {
namespace {

TEST(Lighting, MirrorsShowTheSurroundingsWithoutAStepAtTheHorizon) {
    for (const float roughness : {0.0F, 0.3F, 0.9F}) {
        for (const float y : {-1.0F, 1.0F}) {
            const glm::vec3 straight(0.0F, y, 0.0F);
            EXPECT_LT(
                glm::distance(mirrored_surroundings(straight, roughness), surroundings(straight)),
                1e-6F);
        }
        glm::vec3 before = mirrored_surroundings({0.0F, -1.0F, 0.0F}, roughness);
        for (int i = -100; i <= 100; ++i) {
            const glm::vec3 here =
                mirrored_surroundings({0.0F, 0.01F * static_cast<float>(i), 0.0F}, roughness);
            EXPECT_LT(glm::distance(here, before), 0.04F);
            before = here;
        }
    }
}

TEST(Lighting, TheSurroundingsIlluminateAsTheirIntegralDoes) {
    // A surface that faces up receives zenith and horizon: the integral of (h + (z - h) y) y over
    // the upper half, divided by that of y.
    const glm::vec3 up(0, 1, 0);
    const glm::vec3 zenith = surroundings(up), horizon = surroundings({1.0F, 1e-6F, 0.0F});
    float sum = 0.0F;
    for (const Light& light : studio_lights(camera_axes(30, 18), 1).surroundings) {
        EXPECT_NEAR(glm::length(light.direction), 1.0F, 1e-5F);
        if (light.direction.y > 0.0F) sum += light.strength.x * glm::dot(light.direction, up);
    }
    EXPECT_NEAR(sum, horizon.x + (zenith.x - horizon.x) * 2.0F / 3.0F, 0.01F);
}

TEST(Lighting, FewerLightsAreAsBright) {
    const CameraAxes axes = camera_axes(0, 0);
    const auto total = [&](int detail) {
        glm::vec3 sum(0.0F);
        const PictureLights lights = studio_lights(axes, detail);
        for (const Light& light : lights.lamps) sum += light.strength;
        for (const Light& light : lights.surroundings) sum += light.strength;
        return sum;
    };
    EXPECT_GT(studio_lights(axes, 1).surroundings.size(),
              2 * studio_lights(axes, 4).surroundings.size());
    EXPECT_NEAR(glm::distance(total(1), total(4)), 0.0F, 0.02F);
}

TEST(Lighting, AConvexBodyDoesNotShadeItsLitSide) {
    const Mesh mesh = ball(0.07F, {0.1F, 0.2F, 0.3F});
    const GlbScene scene = scene_of(mesh);
    const DrawList list = draw_list(scene, in_turn);
    for (const Light& light : studio_lights(camera_axes(30, 18), 1).surroundings) {
        const ShadowMap map(list, light.direction, 128);
        for (std::size_t i = 0; i < mesh.positions.size(); ++i)
            if (glm::dot(mesh.normals[i], light.direction) > 0.1F) {
                ASSERT_EQ(map.light_at(mesh.positions[i], mesh.normals[i]), 1.0F);
                ASSERT_TRUE(map.reaches(mesh.positions[i], mesh.normals[i]));
            }
    }
}

TEST(Lighting, ABodyCastsAShadowOfItsOutline) {
    const float radius = 0.05F;
    const Mesh mesh = ball(radius, {0.0F, 0.2F, 0.0F});
    const GlbScene scene = scene_of(mesh);
    const DrawList list = draw_list(scene, in_turn);
    const ShadowMap map(list, {0.0F, 1.0F, 0.0F}, 128);
    for (const float x : {0.0F, 0.02F, 0.045F, 0.055F, 0.08F, 5.0F})
        EXPECT_EQ(map.light_at({x, 0.0F, 0.0F}, glm::vec3(0.0F)), x < radius ? 0.0F : 1.0F) << x;
    EXPECT_EQ(map.light_at({0.0F, 0.3F, 0.0F}, glm::vec3(0.0F)), 1.0F) << "above it";
    EXPECT_FALSE(map.reaches({0.0F, 0.0F, 0.0F}, glm::vec3(0.0F)));
    EXPECT_TRUE(map.reaches({5.0F, 0.0F, 0.0F}, glm::vec3(0.0F)));
}

TEST(Lighting, LightPassesWhereAnImageIsClear) {
    const Mesh mesh = plate(0.2F, 0.001F, {0.0F, 0.1F, 0.0F});
    const GlbScene scene = scene_of(mesh);
    DrawList list = draw_list(scene, in_turn);
    // The lower face, which is the far one of light from above, is the right half of the image: opaque in its left
    // part alone.
    constexpr int side = 64;
    Bytes rgba(std::size_t{4} * side * side, 200);
    for (std::size_t i = 0; i < std::size_t{side} * side; ++i)
        rgba[4 * i + 3] = i % side < side * 3 / 4 ? 255 : 0;
    list.materials[0].alpha = Texture(png(rgba, side, side), Encoding::alpha, false);
    list.materials[0].alpha_cutoff = 0.5F;
    const glm::vec3 up(0.0F, 1.0F, 0.0F);
    const ShadowMap whole(list, up, 256), focused(list, up, 16, ShadowFocus{list.box, 256});
    for (const ShadowMap* map : {&whole, &focused})
        for (const float x : {-0.08F, -0.02F, 0.02F, 0.08F, 0.3F})
            EXPECT_EQ(map->light_at({x, 0.0F, 0.0F}, glm::vec3(0.0F)), x < 0.0F ? 0.0F : 1.0F) << x;
}

/// Says of all vertices of all draws that they are used.
std::vector<std::vector<bool>> all_of(const DrawList& list) {
    std::vector<std::vector<bool>> used;
    for (const Draw& draw : list.draws) used.emplace_back(draw.mesh->positions.size(), true);
    return used;
}

/// Returns a scene of two balls, of which the second stands on the first and shades it.
GlbScene stacked(const Mesh& ball) {
    GlbScene scene = scene_of(ball);
    scene.nodes.push_back({.name = "upper", .mesh = 0, .translation = {0.0, 0.1, 0.0}});
    return scene;
}

TEST(Lighting, WhatArrivesAndWhatIsStoppedIsAllOfIt) {
    const Mesh mesh = ball(0.05F, {0.0F, 0.2F, 0.0F});
    const GlbScene scene = stacked(mesh);
    const DrawList list = draw_list(scene, in_turn);
    const std::vector<Light> lights = studio_lights(camera_axes(0, 0), 1).surroundings;
    const auto found =
        ambient_light(list, lights, shadow_maps(list, lights, 128, in_turn), all_of(list), in_turn);
    ASSERT_EQ(found.size(), 2u);
    float stopped = 0.0F;
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        glm::vec3 all(0.0F);
        for (const Light& light : lights)
            all += light.strength * std::max(glm::dot(mesh.normals[i], light.direction), 0.0F);
        EXPECT_NEAR(glm::distance(found[0][i].arriving + found[0][i].stopped, all), 0.0F, 1e-4F);
        EXPECT_NEAR(glm::distance(found[1][i].arriving + found[1][i].stopped, all), 0.0F, 1e-4F);
        stopped = std::max(stopped, found[0][i].stopped.x);
    }
    EXPECT_GT(stopped, 0.3F) << "where they touch";
}

TEST(Lighting, IsComputedWhereItIsUsedAlone) {
    const Mesh mesh = ball(0.05F, {0.0F, 0.2F, 0.0F});
    const GlbScene scene = stacked(mesh);
    const DrawList list = draw_list(scene, in_turn);
    const std::vector<Light> lights = studio_lights(camera_axes(0, 0), 1).surroundings;
    const std::vector<ShadowMap> shadows = shadow_maps(list, lights, 128, in_turn);
    const auto all = ambient_light(list, lights, shadows, all_of(list), in_turn);
    std::vector<std::vector<bool>> used(2);
    used[0].assign(mesh.positions.size(), false);
    used[0][7] = true;
    const auto one = ambient_light(list, lights, shadows, used, in_turn);
    EXPECT_TRUE(one[1].empty());
    for (std::size_t i = 0; i < mesh.positions.size(); ++i)
        EXPECT_EQ(one[0][i].arriving, i == 7 ? all[0][i].arriving : glm::vec3(0.0F));
}

TEST(Lighting, OnlyTranslucentSurfacesAskForLightFromBehind) {
    const Mesh mesh = plate(0.1F, 0.002F, {0.0F, 0.2F, 0.0F});
    GlbScene scene = scene_of(mesh);
    const std::vector<Light> lights = studio_lights(camera_axes(0, 0), 1).surroundings;
    const auto found = [&] {
        const DrawList list = draw_list(scene, in_turn);
        return ambient_light(list, lights, shadow_maps(list, lights, 128, in_turn), all_of(list),
                             in_turn)[0];
    };
    const std::vector<Ambient> opaque = found();
    scene.materials[0].transmission.factor = 0.5;
    const std::vector<Ambient> thin = found();
    for (std::size_t i = 0; i < thin.size(); ++i) {
        EXPECT_EQ(opaque[i].behind, glm::vec3(0.0F));
        EXPECT_EQ(opaque[i].stopped_behind, glm::vec3(0.0F));
        EXPECT_EQ(thin[i].arriving, opaque[i].arriving);
        // Nothing is in the way of a level plate, so what one face is lit by is behind the other.
        glm::vec3 behind(0.0F);
        for (const Light& light : lights)
            behind += light.strength * std::max(-glm::dot(mesh.normals[i], light.direction), 0.0F);
        EXPECT_NEAR(glm::distance(thin[i].behind + thin[i].stopped_behind, behind), 0.0F, 1e-4F);
        // At the rim some of it leaves through the rim.
        const glm::vec3& at = mesh.positions[i];
        if (std::max(std::abs(at.x), std::abs(at.z)) < 0.03F) {
            EXPECT_GT(thin[i].behind.x, 0.95F * behind.x);
        }
    }
}

TEST(Lighting, AFocusOnTheWholeSceneShadesAsTheSceneDoes) {
    const Mesh mesh = ball(0.07F, {0.1F, 0.2F, 0.3F});
    const GlbScene scene = scene_of(mesh);
    const DrawList list = draw_list(scene, in_turn);
    const glm::vec3 direction = glm::normalize(glm::vec3(0.3F, 1.0F, 0.2F));
    const ShadowMap plain(list, direction, 128);
    const ShadowMap focused(list, direction, 16, ShadowFocus{list.box, 128});
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        EXPECT_EQ(plain.reaches(mesh.positions[i], mesh.normals[i]),
                  focused.reaches(mesh.positions[i], mesh.normals[i]));
        if (glm::dot(mesh.normals[i], direction) > 0.3F) {
            EXPECT_EQ(focused.light_at(mesh.positions[i], mesh.normals[i]), 1.0F);
        }
    }
}

TEST(Lighting, AShadowInAFocusHasASoftEdgeOfThreeTexels) {
    const Mesh mesh = plate(0.1F, 0.002F);
    const GlbScene scene = scene_of(mesh);
    const DrawList list = draw_list(scene, in_turn);
    const Bounds focus{{-0.2F, -0.2F, -0.2F}, {0.2F, 0.2F, 0.2F}};
    const ShadowMap hard(list, {0.0F, 1.0F, 0.0F}, 101),
        soft(list, {0.0F, 1.0F, 0.0F}, 16, ShadowFocus{focus, 102});
    // From below the plate to beside it.
    const auto width_of_edge = [](const ShadowMap& map) {
        float width = 0.0F, last = 0.0F;
        for (float x = 0.0F; x < 0.19F; x += 0.0002F) {
            const float light = map.light_at({x, -0.1F, 0.0F}, {});
            EXPECT_GE(light, last - 1e-6F);
            last = light;
            if (light > 0.0F && light < 1.0F) width += 0.0002F;
        }
        EXPECT_EQ(last, 1.0F);
        return width;
    };
    constexpr float texel = 0.4F / 100.0F;
    EXPECT_LT(width_of_edge(hard), 1.1F * texel);
    EXPECT_NEAR(width_of_edge(soft), 3.0F * texel, 0.3F * texel);
}

TEST(Lighting, WhatIsBesideTheFocusIsShadedByTheMapOfTheWhole) {
    const Mesh mesh = ball(0.07F, {0.1F, 0.2F, 0.3F});
    const GlbScene scene = scene_of(mesh);
    const DrawList list = draw_list(scene, in_turn);
    const glm::vec3 up(0.0F, 1.0F, 0.0F);
    // The focus lies beside the ball, whose shadow falls on a point below it.
    const ShadowMap map(list, up, 64, ShadowFocus{{{1.0F, 0.0F, 1.0F}, {1.5F, 0.5F, 1.5F}}, 64});
    EXPECT_EQ(map.light_at({0.1F, 0.0F, 0.3F}, {}), 0.0F);
    EXPECT_EQ(map.light_at({1.2F, 0.0F, 1.2F}, {}), 1.0F);
}

}  // namespace
}  // namespace sporeprint::render::render_lighting_test
