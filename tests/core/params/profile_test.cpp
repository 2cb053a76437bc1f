#include "core/params/profile.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "core/individual/mushroom_spec.h"
#include "core/params/query.h"
#include "core/plant/leaf_spec.h"
#include "core/plant/tree_spec.h"

namespace sporeprint::params_profile_test {
namespace {

std::vector<Profile> all_profiles() {
    std::vector<Profile> all;
    for (int i = 0; name(static_cast<Profile>(i)); ++i) all.push_back(static_cast<Profile>(i));
    return all;
}

TEST(Profile, CoreIsThePlainFile) { EXPECT_EQ(options_of(Profile::core), FileOptions{}); }

TEST(Profile, EngineThatReadsNoRequiredGeometryGetsNone) {
    for (const Profile profile : {Profile::core, Profile::godot, Profile::blender, Profile::unreal})
        EXPECT_EQ(options_of(profile).compress, Compression::none) << name(profile);
    for (const Profile profile : {Profile::core, Profile::unity, Profile::blender, Profile::unreal})
        EXPECT_EQ(options_of(profile).image_format, ImageFormats::jpg) << name(profile);
}

TEST(Profile, UnrealGetsAllLevelsInOneFile) {
    for (const Profile profile : all_profiles())
        EXPECT_EQ(options_of(profile).lods, profile == Profile::unreal ? Lods::msft : Lods::single)
            << name(profile);
}

TEST(Profile, AQueryNamesTheProfileAndWhatDiffersFromIt) {
    for (const Profile profile : all_profiles()) {
        MushroomParams params;
        apply_profile(profile, params);
        EXPECT_EQ(params.file.profile, profile);
        EXPECT_EQ(query_text(params, with_profile(MushroomParams{}, params)),
                  profile == Profile::core ? "" : "profile=" + std::string(name(profile)));
        params.lod = 3;
        params.file.compress = params.file.compress == Compression::quantize
                                   ? Compression::none
                                   : Compression::quantize;
        drop_excluded_defaults(params, {});
        std::string expected = "lod=3";
        if (profile != Profile::core) expected += "&profile=" + std::string(name(profile));
        EXPECT_EQ(query_text(params, with_profile(MushroomParams{}, params)),
                  expected + "&compress=" + name(params.file.compress));
    }
}

template <class Params>
FileOptions file_of(Profile profile) {
    Params params;
    apply_profile(profile, params);
    return params.file;
}

TEST(Profile, OnlyGodotGetsSolidsAndWindWhereTheProductCanUseThem) {
    for (const Profile profile : all_profiles()) {
        const bool godot = profile == Profile::godot;
        const CollisionFormat solids = godot ? CollisionFormat::omi : CollisionFormat::none;
        EXPECT_EQ(file_of<MushroomParams>(profile).collision, solids) << name(profile);
        EXPECT_EQ(file_of<TreeParams>(profile).collision, solids) << name(profile);
        EXPECT_EQ(file_of<LeafParams>(profile).collision, CollisionFormat::none) << name(profile);
        EXPECT_EQ(file_of<MushroomParams>(profile).wind, WindFormat::none) << name(profile);
        EXPECT_EQ(file_of<LeafParams>(profile).wind, WindFormat::none) << name(profile);
        EXPECT_EQ(file_of<TreeParams>(profile).wind, godot ? WindFormat::uv : WindFormat::none)
            << name(profile);
    }
}

TEST(Profile, DefaultsGiveWayToWhatExcludesThemUnlessTheyAreNamed) {
    for (const bool named : {false, true}) {
        TreeParams tree;
        apply_profile(Profile::godot, tree);
        const FileOptions before = tree.file;
        drop_excluded_defaults(tree, {});
        EXPECT_EQ(tree.file, before) << "nothing excludes them";
        tree.file.compress = Compression::quantize;
        tree.instancing = LeafInstancing::gpu;
        drop_excluded_defaults(tree, {.collision = named, .wind = named});
        EXPECT_EQ(tree.file.collision, named ? CollisionFormat::omi : CollisionFormat::none);
        EXPECT_EQ(tree.file.wind, named ? WindFormat::uv : WindFormat::none);

        TreeParams plain;
        apply_profile(Profile::godot, plain);
        plain.textures = Textures::none;
        drop_excluded_defaults(plain, {.collision = named, .wind = named});
        EXPECT_EQ(plain.file.collision, CollisionFormat::omi);
        EXPECT_EQ(plain.file.wind, named ? WindFormat::uv : WindFormat::none);
        // A query names what is excluded, and nothing that follows.
        EXPECT_EQ(query_text(plain, with_profile(TreeParams{}, plain)),
                  named ? "textures=none&profile=godot&wind=uv" : "textures=none&profile=godot");
    }
    MushroomParams mushroom;
    mushroom.file.wind = WindFormat::attribute;
    mushroom.textures = Textures::none;
    drop_excluded_defaults(mushroom, {});
    EXPECT_EQ(mushroom.file.wind, WindFormat::attribute) << "which needs no texture coordinates";
}

}  // namespace
}  // namespace sporeprint::params_profile_test
