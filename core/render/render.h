// Pictures of scenes: a rasteriser with shadows of a studio's lamps and sky. The bytes are equal on
// every machine.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <map>

#include "core/bytes.h"
#include "core/gltf/glb.h"
#include "core/images.h"
#include "core/mesh/mesh.h"
#include "core/render/daylight.h"
#include "core/render/picture_params.h"

namespace sporeprint {

/// Pixels of a picture: rows from top to bottom, red, green, blue and alpha of each, sRGB; colours
/// are not multiplied by alpha.
struct RgbaImage {
    int width = 0;
    int height = 0;
    Bytes rgba;
};

/// Triangles that a picture may show, each instance counted.
inline constexpr std::uint64_t most_pictured_triangles = 4'000'000;

/// Returns the number of lights whose shadows a picture of so many triangles has: fewer for small
/// pictures and for many triangles.
[[nodiscard]] std::size_t pictured_lights(const PictureParams& params, std::uint64_t triangles);

/// Draws a scene. Its images are those that it embeds; linked ones are white. The ground, y = 0,
/// shows the shadow alone, and hides what is below it, except from below and where more than two
/// thirds of the height are below it. A scene that does not stand on it has one below its wood, if it
/// has wood.
///
/// params    valid
/// returns   the picture, for a turntable the sheet of all views
/// throws    GenerationError for a scene without triangles; Impossible (path "/lod") for more than
///           most_pictured_triangles; what `parallel` throws
/// cost      O(lights * triangles + pixels)
[[nodiscard]] RgbaImage rendered(const GlbScene& scene, const PictureParams& params,
                                 const Parallel& parallel = in_turn);

/// Returns the same as a PNG file.
[[nodiscard]] Bytes rendered_png(const GlbScene& scene, const PictureParams& params,
                                 const Parallel& parallel = in_turn);

/// A camera that stands in a scene.
struct StandingCamera {
    glm::dvec3 eye{0.0, 1.6, 0.0};
    glm::dvec3 target{0.0, 0.0,
                      -1.0};  ///< what is in the middle of the picture; not straight above the eye
    double angle_deg = 70.0;  ///< of view, across the picture, 1..150
};

/// What is round a scene outdoors.
struct Outdoors {
    Daylight light;
    Bounds near;            ///< the part of the scene whose shadows are seen from near
    bool shows_sky = true;  ///< behind the scene, in place of the background of the parameters
    /// Coarser meshes that cast the shadows of some meshes of the scene beyond what is near; they live as long as it does.
    std::map<const Mesh*, const Mesh*> casters = {};
};

/// Draws what a camera in a scene sees outdoors; what is nearer than 5 cm is left out. Nothing hides what is below the
/// ground. The picture is as bright in the mean, whatever the light, as a camera's exposure would make it.
///
/// params   size and background count
/// returns  the picture
/// throws   as rendered(); InvalidInput (path "/angle_deg") for other angles, and for daylight that cannot be
[[nodiscard]] RgbaImage rendered_from(const StandingCamera& camera, const GlbScene& scene,
                                      const PictureParams& params, const Outdoors& outdoors,
                                      const Parallel& parallel = in_turn);

}  // namespace sporeprint
