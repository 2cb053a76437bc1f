// Close-ups by name: where in a scene they look, found on its triangles, and how much they show.
#pragma once

#include <glm/vec3.hpp>

#include "core/render/camera.h"
#include "core/render/draw_list.h"

namespace sporeprint::render {

/// Returns true for the views that show a part of a product from nearby.
[[nodiscard]] bool is_close_up(View view);

/// What a close-up shows.
struct CloseUp {
    glm::vec3 target{0.0F};  ///< the middle of the picture
    CameraAxes axes;
    float frame = 0.0F;  ///< shorter side of the picture at the target, metres
};

/// Returns what a close-up of a scene shows. Of many individuals it looks at the foremost one, which
/// no other hides; never at what carries them. Close-ups of the margin show 5 cm at the outermost
/// point of its upper part, those of the underside 6 cm at a place that faces downwards, between the
/// middle and the margin, and those of the base 8 cm, or an eighth of the height of what is taller
/// than that allows; of small scenes at most seven tenths of their longest side.
///
/// params  with such a view
/// throws  Impossible (path "/view") if nothing faces downwards, as it does in every closed mesh
/// cost    O(vertices + triangles)
[[nodiscard]] CloseUp close_up_of(const DrawList& list, const PictureParams& params);

/// Returns the camera of a close-up. What is nearer to it than a tenth of its distance is left out.
///
/// aspect  width by height of the image
[[nodiscard]] Camera camera_of(const CloseUp& close_up, double aspect);

}  // namespace sporeprint::render
