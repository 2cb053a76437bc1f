#include "core/render/render.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <thread>

#include "core/grow/mushroom.h"
#include "core/surface/codecs.h"
#include "tests/support/orders.h"
#include "tests/support/refusals.h"
#include "tests/support/solids.h"

namespace sporeprint::render_render_test {
namespace {

PictureParams square(int side, View view = View::three_quarter) {
    PictureParams params;
    params.width = params.height = side;
    params.view = view;
    return params;
}

const std::uint8_t* pixel(const RgbaImage& image, int x, int y) {
    return &image.rgba.at(static_cast<std::size_t>(y * image.width + x) * 4);
}

double share_above(const RgbaImage& image, int alpha) {
    std::size_t count = 0;
    for (std::size_t i = 3; i < image.rgba.size(); i += 4) count += image.rgba[i] > alpha ? 1 : 0;
    return static_cast<double>(count) * 4.0 / static_cast<double>(image.rgba.size());
}

TEST(Render, ABallCoversADiscOfNineTenthsOfTheWidth) {
    const Mesh mesh = ball(1.0F, {0.0F, -4.0F, 0.0F}, 128, 64);
    const RgbaImage image = rendered(scene_of(mesh), square(128, View::below));
    EXPECT_NEAR(share_above(image, 127), 3.14159 / 4.0 * 0.81, 0.005);
    EXPECT_EQ(pixel(image, 0, 0)[3], 0);
    EXPECT_EQ(pixel(image, 64, 64)[3], 255);
}

TEST(Render, FromAPlaceInTheSceneShowsWhatIsBeforeTheCamera) {
    const Mesh mesh = ball(1.0F, {0.0F, 0.0F, -10.0F}, 128, 64);
    PictureParams params = square(128);
    const auto share = [&](const glm::dvec3& eye, const glm::dvec3& target, double angle = 20.0) {
        return share_above(rendered_from({eye, target, angle}, scene_of(mesh), params,
                                         {Daylight{}, bounds(mesh), false}),
                           127);
    };
    // A ball of radius 1 at distance 10 has a disc of tangent 0.1005; the picture reaches to 0.1763.
    const double wanted = 3.14159 / 4.0 * (0.1005 / 0.1763) * (0.1005 / 0.1763);
    EXPECT_NEAR(share({0, 0, 0}, {0, 0, -1}), wanted, 0.005);
    EXPECT_NEAR(share({10, 0, -10}, {0, 0, -10}), wanted, 0.005) << "from the side";
    EXPECT_NEAR(share({0, 10, -10 + 1e-3}, {0, 0, -10}), wanted, 0.005) << "from above";
    EXPECT_EQ(share({0, 0, 0}, {0, 0, 1}), 0.0) << "it is behind the camera";
    EXPECT_TRUE(names(refusal([&] { share({0, 0, 0}, {0, 0, 1}, 0.5); }), "/angle_deg"));
}

TEST(Render, WhatIsFarCastsTheShadowOfItsCoarserMesh) {
    // A level plate high above the ground, whose coarser mesh is far away: no shadow falls on what is seen.
    const Mesh ground = plate(40.0F, 0.01F, {0.0F, 0.0F, 0.0F}),
               roof = plate(8.0F, 0.01F, {0.0F, 6.0F, -10.0F}),
               elsewhere = plate(1.0F, 0.01F, {30.0F, 6.0F, 30.0F});
    GlbScene scene = scene_of(ground);
    scene.meshes.push_back({"roof", {{&roof, 0, {}}}});
    scene.nodes.push_back({.name = "roof", .mesh = 1});
    Outdoors outdoors{{{0.0, 1.0, 0.0}}, {glm::vec3(0.0F), glm::vec3(0.1F)}, false};
    const auto middle = [&] {
        return pixel(
            rendered_from({{0.0, 2.0, 0.0}, {0.0, 0.0, -10.0}, 40.0}, scene, square(64), outdoors),
            32, 32)[0];
    };
    const int shaded = middle();
    outdoors.casters[&roof] = &elsewhere;
    EXPECT_GT(middle(), shaded + 20);
}

// Each pixel of a close-up of a wall much larger than its frame shows the wall.
TEST(Render, ACloseUpShowsPartsOfTrianglesWithoutGaps) {
    const Mesh mesh = ball(1.0F, {0.0F, 2.0F, 0.0F}, 12, 6);
    const RgbaImage image = rendered(scene_of(mesh), square(96, View::margin));
    for (std::size_t i = 3; i < image.rgba.size(); i += 4) ASSERT_EQ(image.rgba[i], 255) << i;
}

TEST(Render, LightComesFromTheUpperLeft) {
    const Mesh mesh = ball(1.0F, {0.0F, 9.0F, 0.0F});
    const RgbaImage image = rendered(scene_of(mesh), square(96, View::front));
    EXPECT_GT(pixel(image, 36, 28)[0], pixel(image, 62, 62)[0] + 60);
}

TEST(Render, AThinBallIsBrighterInItsShadeAndAnOpaqueOneUnchanged) {
    const Mesh mesh = ball(1.0F, {0.0F, 9.0F, 0.0F});
    GlbScene scene = scene_of(mesh);
    const RgbaImage opaque = rendered(scene, square(96, View::front));
    scene.materials[0].transmission = {0.5, glm::dvec3(1.0), {}, 0.0};
    EXPECT_EQ(rendered(scene, square(96, View::front)).rgba, opaque.rgba) << "too thick";
    scene.materials[0].transmission.mean = 1.0;
    const RgbaImage thin = rendered(scene, square(96, View::front));
    EXPECT_GT(pixel(thin, 70, 72)[0], pixel(opaque, 70, 72)[0] + 10);
    EXPECT_LT(pixel(thin, 36, 28)[0], pixel(opaque, 36, 28)[0]);
}

// Samples on triangles of one smooth surface are shaded once, whichever triangles they are on.
TEST(Render, FinerTrianglesOfABallChangeItsPictureLittle) {
    const Mesh coarse = ball(1.0F, {0.0F, 9.0F, 0.0F}, 96, 48);
    const Mesh fine = ball(1.0F, {0.0F, 9.0F, 0.0F}, 480, 240);
    const RgbaImage a = rendered(scene_of(coarse), square(96, View::front));
    const RgbaImage b = rendered(scene_of(fine), square(96, View::front));
    int count = 0;
    double difference = 0.0;
    for (std::size_t i = 0; i < a.rgba.size(); i += 4) {
        if (a.rgba[i + 3] < 255 || b.rgba[i + 3] < 255) continue;
        ++count;
        difference += std::abs(a.rgba[i] - b.rgba[i]);
    }
    ASSERT_GT(count, 3000);
    EXPECT_LT(difference / count, 1.5);
}

TEST(Render, TheGroundShowsTheShadowAndHidesWhatIsBelowIt) {
    const Mesh mesh = ball(1.0F, {0.0F, 0.9F, 0.0F});
    const RgbaImage on_ground = rendered(scene_of(mesh), square(96));
    int shades = 0;
    for (int x = 0; x < 96; ++x) {
        const int alpha = pixel(on_ground, x, 88)[3];
        shades += alpha > 20 && alpha < 235 ? 1 : 0;
    }
    EXPECT_GT(shades, 15) << "the shadow in front of the ball";
    PictureParams white = square(96);
    white.background = Background::white;
    const RgbaImage opaque = rendered(scene_of(mesh), white);
    EXPECT_EQ(pixel(opaque, 2, 2)[0], 255);
    EXPECT_EQ(share_above(opaque, 254), 1.0);
}

TEST(Render, ThreadsChangeNoPixel) {
    MushroomSpec spec;
    spec.mix.push_back({"amanita_muscaria"});
    spec.params.lod = 2;
    spec.params.texture_size = {256};
    Extras extras;
    std::vector<RgbaImage> images;
    const Parallel in_threads = [](std::span<const std::function<void()>> tasks) {
        std::vector<std::jthread> threads;
        for (const auto& task : tasks) threads.emplace_back(task);
    };
    extras.write = [&](const GlbScene& scene, const Parallel&) -> Body {
        images.push_back(rendered(scene, square(64)));
        images.push_back(rendered(scene, square(64), in_threads));
        return {};
    };
    (void)grow_mushroom(spec, *built_in_atlas(), extras);
    ASSERT_EQ(images.size(), 2u);
    EXPECT_EQ(images[0].rgba, images[1].rgba);
}

TEST(Render, EveryViewOfEverySpeciesShowsSomethingElse) {
    for (const std::string& id : species_ids()) {
        MushroomSpec spec;
        spec.mix.push_back({id});
        spec.params.lod = 3;
        spec.params.texture_size = {128};
        std::set<Bytes> pictures;
        Extras extras;
        extras.write = [&](const GlbScene& scene, const Parallel&) -> Body {
            for (const View view : {View::three_quarter, View::front, View::top, View::below,
                                    View::margin, View::underside, View::base}) {
                const RgbaImage image = rendered(scene, square(48, view));
                EXPECT_GT(share_above(image, 200), 0.01) << id << ' ' << name(view);
                pictures.insert(image.rgba);
            }
            return {};
        };
        (void)grow_mushroom(spec, *built_in_atlas(), extras);
        EXPECT_EQ(pictures.size(), 7u) << id;
    }
}

TEST(Render, APngReadsBackAsItWas) {
    const Mesh mesh = ball(1.0F, {0.0F, 1.0F, 0.0F}, 24, 12);
    PictureParams params;
    params.width = 40;
    params.height = 24;
    params.background = Background::grey;
    params.view = View::turntable;
    const RgbaImage image = rendered(scene_of(mesh), params);
    EXPECT_EQ(image.width, 160);
    EXPECT_EQ(image.height, 48);
    const Picture read = decoded_picture(rendered_png(scene_of(mesh), params), "/png");
    ASSERT_EQ(read.width, image.width);
    ASSERT_EQ(read.height, image.height);
    for (std::size_t i = 0; i < read.rgb.size() / 3; ++i)
        for (std::size_t c = 0; c < 3; ++c)
            ASSERT_EQ(read.rgb[3 * i + c], image.rgba[4 * i + c]) << i;
}

TEST(Render, WhatIsTooLargeIsRefusedByName) {
    const Mesh mesh = ball(1.0F, {}, 8, 4);
    PictureParams params = square(513, View::turntable);
    EXPECT_TRUE(names(refusal([&] { (void)rendered(scene_of(mesh), params); }), "/width", "512"));
    params = square(1025);
    EXPECT_TRUE(names(refusal([&] { (void)rendered(scene_of(mesh), params); }), "/height", "1024"));
    GlbScene scene = scene_of(mesh);
    scene.nodes[0].instances.resize(most_pictured_triangles / mesh.triangles() + 1);
    EXPECT_TRUE(names(refusal([&] { (void)rendered(scene, square(16)); }), "/lod", "Raise lod"));
}

}  // namespace
}  // namespace sporeprint::render_render_test
