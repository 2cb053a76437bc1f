#include "core/render/shading.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "core/render/daylight.h"
#include "tests/support/solids.h"

namespace sporeprint::render::render_shading_test {
namespace {

/// A ball far below, whose shadows reach no point of a test.
struct OpenStudio {
    Mesh mesh = ball(0.01F, {0.0F, -9.0F, 0.0F}, 8, 4);
    GlbScene scene = scene_of(mesh);
    DrawList list = draw_list(scene, in_turn);
    std::vector<Light> lights = studio_lights(camera_axes(30, 18), 1).lamps;
    std::vector<ShadowMap> shadows = shadow_maps(list, lights, 64, in_turn);
};

TEST(Shading, GroupsOfLightsSumToAll) {
    const OpenStudio open;
    SurfacePoint point;
    point.normal = point.smooth_normal = point.to_camera = glm::normalize(glm::vec3(0.2, 0.9, 0.4));
    point.roughness = 0.5F;
    point.ambient.arriving = glm::vec3(0.3F);
    const MaterialLook none;
    const glm::vec3 all = reflected(point, none, {open.lights, open.shadows, 1}, 0);
    glm::vec3 mean(0.0F);
    for (std::size_t group = 0; group < 4; ++group)
        mean += reflected(point, none, {open.lights, open.shadows, 4}, group) * 0.25F;
    EXPECT_NEAR(glm::distance(all, mean), 0.0F, 0.01F);
    EXPECT_GT(all.x, 0.2F);
}

TEST(Shading, BlackMattSkinReflectsLittleAndASlimyOneMore) {
    const OpenStudio open;
    SurfacePoint point;
    point.base_color = glm::vec3(0.0F);
    point.ambient.arriving = glm::vec3(0.4F);
    point.roughness = 1.0F;
    point.normal = point.smooth_normal = glm::vec3(0, 1, 0);
    point.to_camera = glm::normalize(glm::vec3(0.3, 0.8, 0.5));
    MaterialLook look;
    const Lamps studio{open.lights, open.shadows, 1};
    const float matt = reflected(point, look, studio, 0).y;
    EXPECT_LT(matt, 0.1F);
    EXPECT_GT(matt, 0.0F);
    look.coat = 0.7;
    EXPECT_GT(reflected(point, look, studio, 0).y, matt + 0.005F);
}

TEST(Shading, ThinFleshLetsLightFromBehindThroughUnlessOtherFleshStopsIt) {
    const Mesh mesh = plate(0.1F, 0.002F);
    GlbScene scene = scene_of(mesh);
    const std::vector<Light> above{{glm::vec3(0, 1, 0), glm::vec3(1.0F)}};
    SurfacePoint lower;  // in the middle of the lower face
    lower.at = {0.0F, -0.001F, 0.0F};
    lower.normal = lower.smooth_normal = lower.to_camera = glm::vec3(0, -1, 0);
    const auto seen = [&](float transmission) {
        const DrawList list = draw_list(scene, in_turn);
        const std::vector<ShadowMap> shadows = shadow_maps(list, above, 64, in_turn);
        lower.transmission = transmission;
        lower.tint = glm::vec3(1.0F, 0.5F, 0.25F);
        return reflected(lower, {}, {above, shadows, 1}, 0);
    };
    const glm::vec3 opaque = seen(0.0F), thin = seen(0.5F), thinner = seen(1.0F);
    EXPECT_EQ(opaque, glm::vec3(0.0F));
    EXPECT_GT(thin.x, 0.3F);
    EXPECT_NEAR(thin.y / thin.x, 0.5F, 1e-3F);
    EXPECT_NEAR(thinner.x / thin.x, 2.0F, 1e-3F);
    // A second plate above stops most of it.
    scene.nodes.push_back({.name = "upper", .mesh = 0, .translation = {0.0, 0.05, 0.0}});
    EXPECT_LT(seen(0.5F).x, 0.7F * thin.x);
    EXPECT_GT(seen(0.5F).x, 0.0F);
}

TEST(Shading, ThinFleshReflectsLessThanThickFleshOfItsColour) {
    const OpenStudio open;
    SurfacePoint point;
    point.normal = point.smooth_normal = point.to_camera = open.lights.front().direction;
    const Lamps studio{open.lights, open.shadows, 1};
    const float thick = reflected(point, {}, studio, 0).y;
    point.transmission = 0.5F;
    const float thin = reflected(point, {}, studio, 0).y;
    EXPECT_LT(thin, thick);
    EXPECT_GT(thin, 0.5F * thick);
}

// Light that white flesh stops returns nearly whole after many reflections; black flesh returns none.
TEST(Shading, HollowsInBrightFleshAreBrighterThanOneReflectionMakesThem) {
    const auto seen = [](float color, float occlusion) {
        SurfacePoint point;
        point.base_color = glm::vec3(color);
        point.ambient.arriving = glm::vec3(1.0F);
        point.occlusion = occlusion;
        return reflected(point, {}, {}, 0).y / color;
    };
    for (const float color : {0.05F, 0.5F, 0.95F}) {
        EXPECT_LT(seen(color, 0.5F), seen(color, 1.0F)) << color;
        EXPECT_GT(seen(color, 0.5F), 0.5F * seen(color, 1.0F)) << color;
    }
    const auto share = [&](float color) { return seen(color, 0.5F) / seen(color, 1.0F); };
    EXPECT_GT(share(0.95F), 0.9F);
    EXPECT_GT(share(0.5F), share(0.05F) + 0.1F);
    EXPECT_LT(share(0.5F), 0.7F);
}

TEST(Shading, OutdoorsCrownsLetSomeOfTheLightPassThatTheyStop) {
    const OpenStudio open;
    const Sky sky(Daylight{});
    SurfacePoint point;
    point.base_color = glm::vec3(0.05F);
    point.roughness = 1.0F;
    point.normal = point.smooth_normal = glm::vec3(0, 1, 0);
    point.to_camera = glm::normalize(glm::vec3(0.3, 0.8, 0.5));
    point.ambient.stopped = glm::vec3(1.0F);
    const MaterialLook none;
    const float inside = reflected(point, none, {{}, {}, 1}, 0).y,
                outdoors = reflected(point, none, {{}, {}, 1, &sky}, 0).y;
    // Of a dark surface more than its own hollows return, and far less than an open place has.
    EXPECT_GT(outdoors, 2.0F * inside);
    EXPECT_LT(outdoors, 0.2F * point.base_color.y);
    // Flesh has hollows of its own.
    point.scatters = true;
    EXPECT_EQ(reflected(point, none, {{}, {}, 1, &sky}, 0).y,
              reflected(point, none, {{}, {}, 1}, 0).y);
}

TEST(Shading, RoughGroundOutdoorsShowsNoSkyAsAMirror) {
    const Sky sky(Daylight{});
    const glm::vec3 up = glm::normalize(glm::vec3(0.6F, 0.5F, 0.0F));
    EXPECT_EQ(sky.mirrored(up, 1.0F), glm::vec3(0.0F));
    EXPECT_GT(sky.mirrored(up, 0.5F).y, 0.1F);
    float last = sky.mirrored(up, 0.6F).y;
    for (float roughness = 0.65F; roughness <= 1.0F; roughness += 0.05F) {
        EXPECT_LT(sky.mirrored(up, roughness).y, last);
        last = sky.mirrored(up, roughness).y;
    }
}

TEST(Shading, WaterBelowCrownsMirrorsThemMoreThanTheSkyNearTheHorizon) {
    const Sky sky(Daylight{});
    const auto way = [](float up) { return glm::vec3(std::sqrt(1.0F - up * up), up, 0.0F); };
    constexpr float smooth = 0.1F;
    for (const float up : {0.1F, 0.4F, 0.9F}) {
        EXPECT_EQ(sky.mirrored(way(up), smooth, 1.0F), sky.mirrored(way(up), smooth));
        EXPECT_EQ(sky.mirrored(way(up), smooth, 0.0F), glm::vec3(0.0F));
        float last = 0.0F;
        for (const float arriving : {0.05F, 0.2F, 0.5F, 0.8F, 1.0F}) {
            const float seen = sky.mirrored(way(up), smooth, arriving).y;
            EXPECT_GT(seen, last) << up << ' ' << arriving;
            last = seen;
        }
    }
    const auto share = [&](float up) {
        return sky.mirrored(way(up), smooth, 0.5F).y / sky.mirrored(way(up), smooth).y;
    };
    EXPECT_LT(share(0.2F), 0.5F * share(0.6F));
    EXPECT_GT(share(0.9F), 0.5F);
}

TEST(Shading, WithoutLightOnlyWhatGlowsIsSeen) {
    SurfacePoint point;
    point.base_color = glm::vec3(0.5F);
    MaterialLook look;
    EXPECT_EQ(reflected(point, look, {}, 0), glm::vec3(0.0F));
    look.glow = glm::dvec3(0.0, 0.25, 0.0);
    EXPECT_EQ(reflected(point, look, {}, 0), glm::vec3(0.0F, 0.5F, 0.0F));
}

TEST(Shading, ToneMappingKeepsOrderAndStaysBelowOne) {
    glm::vec3 last(-1.0F);
    for (float light = 0.0F; light < 50.0F; light += 0.05F) {
        const glm::vec3 shown = tone_mapped(glm::vec3(light, 0.5F * light, 0.1F * light));
        EXPECT_GE(shown.x, last.x - 1e-6F);
        EXPECT_GE(shown.x, shown.y);
        EXPECT_GE(shown.y, shown.z);
        EXPECT_GE(shown.z, 0.0F);
        EXPECT_LE(shown.x, 1.0F);
        last = shown;
    }
    EXPECT_GT(last.x, 0.97F);
}

}  // namespace
}  // namespace sporeprint::render::render_shading_test
