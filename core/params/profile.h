// Profiles: the options of a file for each engine.
#pragma once

#include "core/params/shared_params.h"

namespace sporeprint {

/// Returns the options of the file that a profile sets. web_viewer/clients/README.md says what each
/// engine reads, and with which versions that was tried.
[[nodiscard]] constexpr FileOptions options_of(Profile profile) {
    FileOptions file;
    file.profile = profile;
    switch (profile) {
        case Profile::core:
        case Profile::blender:
            break;
        case Profile::unreal:
            file.lods = Lods::msft;
            break;
        case Profile::mobile:
            file.materials = MaterialSet::core;
            [[fallthrough]];
        case Profile::web:
        case Profile::cesium:
            file.compress = Compression::meshopt;
            file.image_format = ImageFormats::webp;
            break;
        case Profile::godot:
            file.image_format = ImageFormats::webp;
            break;
        case Profile::unity:
            file.compress = Compression::quantize;
            break;
    }
    return file;
}

/// Sets what a profile sets: the options of the file and, for phones, the level of detail.
///
/// params  of a product, with its defaults or those of its preset
template <class Params>
constexpr void apply_profile(Profile profile, Params& params) {
    params.file = options_of(profile);
    if (profile == Profile::mobile) params.lod = 1;
}

/// Returns the parameters that a request with this profile starts from, without the profile itself:
/// a query contains what differs from them.
template <class Params>
[[nodiscard]] constexpr Params with_profile(Params params, Profile profile) {
    apply_profile(profile, params);
    params.file.profile = Profile::core;
    return params;
}

}  // namespace sporeprint
