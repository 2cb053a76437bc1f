#include "core/params/profile.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "core/individual/mushroom_spec.h"
#include "core/params/query.h"

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
        const MushroomParams start = with_profile(MushroomParams{}, profile);
        EXPECT_EQ(query_text(params, start),
                  profile == Profile::core ? "" : "profile=" + std::string(name(profile)));
        params.lod = 3;
        params.file.compress = params.file.compress == Compression::quantize
                                   ? Compression::none
                                   : Compression::quantize;
        std::string expected = "lod=3";
        if (profile != Profile::core) expected += "&profile=" + std::string(name(profile));
        EXPECT_EQ(query_text(params, start), expected + "&compress=" + name(params.file.compress));
    }
}

}  // namespace
}  // namespace sporeprint::params_profile_test
