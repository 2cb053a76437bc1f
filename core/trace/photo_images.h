// Images of cap and stem from a photograph, as a model takes them: laid flat, without shade, and closed round the
// mushroom.
#pragma once

#include <glm/vec3.hpp>
#include <optional>
#include <vector>

#include "core/surface/codecs.h"
#include "core/trace/photo.h"
#include "core/trace/trace.h"

namespace sporeprint::trace {

/// Images in the layout of core/surface/charts.h; none for a part of which the photograph shows too little.
struct PhotoImages {
    std::optional<Picture> cap;   ///< disc: the apex in the middle, the margin at the rim
    std::optional<Picture> stem;  ///< strip: from the base to the top, and once round
};

/// Returns the images of a mushroom seen from the side.
///
/// picture, mask  of one size
/// traced         in pixels of the mask
/// height_m       of the mushroom
/// source         [Heitz2018] for the blend that hides the mirror
/// cost           about 60 ms
[[nodiscard]] PhotoImages photo_images(const Picture& picture, const Mask& mask,
                                       const Traced& traced, double height_m);

/// A part of a skin as it is seen from the front: rows along the part, columns by the angle from the front.
struct SkinPatch {
    std::size_t rows = 0, columns = 0;
    double reach = 0.0;  ///< the first and the last column are at -reach and reach, radians
    std::vector<glm::dvec3> light;  ///< linear light
    std::vector<bool> is_seen;

    [[nodiscard]] double angle(std::size_t column) const {
        return reach *
               (2.0 * (static_cast<double>(column) + 0.5) / static_cast<double>(columns) - 1.0);
    }
};

/// Fills what is not seen from what is round it, by pyramids of ever smaller copies (push-pull).
void fill(SkinPatch& patch);

/// Divides a patch by its shade: light b0 + b * normal, fitted to the luminance of each row over its own mean by
/// least squares with weights that fall with the distance.
///
/// has_depth  also by the part of the normal towards the camera; without it only from left to right
void unshade(SkinPatch& patch, bool has_depth);

}  // namespace sporeprint::trace
