// The directions from which the frames of an impostor are seen: a square grid over the upper half of
// a sphere, by the hemi-octahedral map.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace sporeprint {

/// Frames in each row and column of an impostor. It is odd, so that one frame is seen straight from
/// above and those of eight azimuths straight from the side.
inline constexpr int frame_grid = 7;
inline constexpr int frame_count = frame_grid * frame_grid;

/// A frame of the grid.
struct FrameCell {
    int column = 0, row = 0;
};

/// The axes of a frame: unit vectors, perpendicular to each other, in the scene.
struct FrameAxes {
    glm::vec3 right{1.0F, 0.0F, 0.0F}, up{0.0F, 1.0F, 0.0F};
    glm::vec3 toward{0.0F, 0.0F, 1.0F};  ///< to the viewer

    /// Returns a vector of the scene in these axes.
    [[nodiscard]] glm::vec3 seen(const glm::vec3& vector) const;
};

/// Returns the unit vector towards the viewer of the frame at a place of the grid.
///
/// place   0..1 in both coordinates: columns to the right, rows downwards
/// source  the octahedral map of its upper half: with a = 2 x - 1 and b = 2 y - 1, the direction of
///         ((a + b) / 2, 1 - max(|a|, |b|), (b - a) / 2)
[[nodiscard]] glm::vec3 direction_at(const glm::vec2& place);

/// Returns the place of a direction, the inverse of direction_at(). One below the horizon has the
/// place of its azimuth on the horizon; straight down is the middle.
///
/// direction  of any length but 0
[[nodiscard]] glm::vec2 place_of(const glm::vec3& direction);

/// Returns the axes of a view from a direction: up is the projection of +Y, and seen straight from
/// above -Z.
///
/// toward  unit vector
[[nodiscard]] FrameAxes axes_of(const glm::vec3& toward);

/// Returns the axes of a frame.
[[nodiscard]] FrameAxes axes_of(FrameCell cell);

}  // namespace sporeprint
