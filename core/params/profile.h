// Profiles: the options of a file for each engine.
#pragma once

#include <string>
#include <vector>

#include "core/params/messages.h"
#include "core/params/shared_params.h"
#include "core/problems.h"

namespace sporeprint {

/// Returns the options of the file that a profile sets where the product can use them
/// (apply_profile). web_viewer/clients/README.md says what each engine reads, and with which versions
/// that was tried.
///
/// unreal has no collision=nodes: glTFRuntime would draw those meshes. No profile but godot has
/// weights of wind, because nothing else that reads its files moves them without further code.
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
            file.collision = CollisionFormat::omi;
            file.wind = WindFormat::uv;
            break;
        case Profile::unity:
            file.compress = Compression::quantize;
            break;
    }
    return file;
}

/// Which options of a profile a product can use. Parameters that differ from this have a constant
/// `profile_fit`.
struct ProfileFit {
    bool solids = true;  ///< it has solids for a physics engine
    /// It is expected to move in wind. Others have no weights of wind by default: Godot bakes
    /// lightmaps with the texture coordinates that would hold them.
    bool wind = false;
};

template <class Params>
[[nodiscard]] constexpr ProfileFit profile_fit_of() {
    if constexpr (requires { Params::profile_fit; })
        return Params::profile_fit;
    else
        return {};
}

/// Returns the level of detail of a request that names none.
[[nodiscard]] constexpr int lod_of(Profile profile) { return profile == Profile::mobile ? 1 : 0; }

/// Sets what a profile sets: the options of the file and, for phones, the level of detail.
///
/// params  of a product, with its defaults or those of its preset
template <class Params>
constexpr void apply_profile(Profile profile, Params& params) {
    params.file = options_of(profile);
    if (!profile_fit_of<Params>().solids) params.file.collision = CollisionFormat::none;
    if (!profile_fit_of<Params>().wind) params.file.wind = WindFormat::none;
    if (profile == Profile::mobile) params.lod = lod_of(profile);
}

/// The options of a profile that other options can exclude, and whether a request names them itself.
struct NamedOptions {
    bool collision = false;
    bool wind = false;
};

/// Takes back what a profile has set but other options of the request exclude, so that no request
/// is refused for an option that it does not name.
///
/// params  apply_profile(), and then what the request gives
template <class Params>
constexpr void drop_excluded_defaults(Params& params, NamedOptions named) {
    FileOptions& file = params.file;
    if (!named.collision && file.collision == CollisionFormat::omi &&
        file.compress != Compression::none)
        file.collision = CollisionFormat::none;
    bool without_wind = file.wind == WindFormat::uv && params.textures == Textures::none;
    if constexpr (requires { params.has_instanced_leaves(); })
        without_wind = without_wind || params.has_instanced_leaves();
    if (!named.wind && without_wind) file.wind = WindFormat::none;
}

/// Returns the parameters that a request with the profile of `params` starts from, without the
/// profile itself: a query contains what differs from them. What options of `params` exclude is not
/// among them, so that a query names it if it is given nevertheless.
///
/// defaults  of the product, or those of its preset
template <class Params>
[[nodiscard]] constexpr Params with_profile(Params defaults, const Params& params) {
    apply_profile(params.file.profile, defaults);
    Params allowed = params;
    allowed.file.collision = defaults.file.collision;
    allowed.file.wind = defaults.file.wind;
    drop_excluded_defaults(allowed, {});
    defaults.file.collision = allowed.file.collision;
    defaults.file.wind = allowed.file.wind;
    defaults.file.profile = Profile::core;
    return defaults;
}

/// Refuses a number of triangles beside a level of detail: only one of them can choose the level.
///
/// params  of any product
template <class Params>
void refuse_two_levels(const Params& params, const std::string& path,
                       std::vector<Problem>& problems) {
    if (params.triangles && params.lod != lod_of(params.file.profile))
        report(problems, path + "/triangles",
               std::to_string(*params.triangles) + " chooses the level of detail, and lod=" +
                   std::to_string(params.lod) + " does too; give one of them");
}

}  // namespace sporeprint
