// The camera of a picture, and the projection of points to it.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "core/render/draw_list.h"
#include "core/render/picture_params.h"

namespace sporeprint::render {

/// The axes of a camera: unit vectors, perpendicular to each other, in the scene.
struct CameraAxes {
    glm::vec3 right{1.0F, 0.0F, 0.0F}, up{0.0F, 1.0F, 0.0F}, forward{0.0F, 0.0F, -1.0F};
};

/// Returns the axes of a camera that looks at the scene from a direction.
///
/// azimuth    degrees from +Z to +X
/// elevation  degrees above the horizon, -90..90
[[nodiscard]] CameraAxes camera_axes(double azimuth, double elevation);

/// A perspective camera.
struct Camera {
    CameraAxes axes;
    glm::vec3 position{0.0F};
    float tangent_x = 0.25F, tangent_y = 0.25F;  ///< of half the angles of view
    float nearest = 0.0F;  ///< what is nearer is left out; 0 if the whole scene is in the image

    /// Returns a point of the scene in the axes of the camera: right, up, forward.
    [[nodiscard]] glm::vec3 seen(const glm::vec3& point) const;

    /// Returns the direction in the axes of the camera, with forward 1, through a point of an image.
    ///
    /// at  0..1 from left to right and from top to bottom
    [[nodiscard]] glm::vec3 ray(const glm::vec2& at) const {
        return {(2.0F * at.x - 1.0F) * tangent_x, (1.0F - 2.0F * at.y) * tangent_y, 1.0F};
    }

    /// Returns a direction in the axes of the camera as one of the scene.
    [[nodiscard]] glm::vec3 in_scene(const glm::vec3& direction) const {
        return axes.right * direction.x + axes.up * direction.y + axes.forward * direction.z;
    }
};

/// Returns a camera at the origin with the angles of view of all pictures.
///
/// aspect  width by height of the image
[[nodiscard]] Camera camera_with(const CameraAxes& axes, double aspect);

/// Returns azimuth and elevation of a view, degrees.
///
/// frame  of a turntable, 0..7; 0 for all other views, of which close-ups have elevations of their own
[[nodiscard]] glm::dvec2 angles_of(const PictureParams& params, int frame);

/// Returns a camera for each of some axes, all at the same place relative to their own axes: the
/// nearest from which all of the scene is in every image, with a margin.
///
/// aspect  width by height of the images
/// lowest  height that is seen: what lies lower is under the ground, and hidden
[[nodiscard]] std::vector<Camera> fitted_cameras(const DrawList& list,
                                                 std::span<const CameraAxes> axes, double aspect,
                                                 float lowest);

}  // namespace sporeprint::render
