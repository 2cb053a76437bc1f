// The images of an impostor: orthographic views of a scene from all sides, each with colour,
// coverage, normals and depth.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>

#include "core/bytes.h"
#include "core/gltf/glb.h"
#include "core/images.h"
#include "core/impostor/frames.h"
#include "core/mesh/mesh.h"

namespace sporeprint {

/// The part of a frame that shows something, texels: from the left and upper edge of the first ones
/// to the right and lower edge of the last ones.
struct FrameContent {
    int left = 0, top = 0, right = 0, bottom = 0;
};

/// Returns the side of images with frames of this side: the next power of two, which all readers
/// support. What is to the right of the last frames and below them is unused.
[[nodiscard]] constexpr int atlas_side(int frame_side) {
    int side = 1;
    while (side < frame_grid * frame_side) side *= 2;
    return side;
}

/// The views of a scene, all of the same square around one point.
struct ImpostorAtlas {
    int frame_side = 0;      ///< texels
    glm::vec3 centre{0.0F};  ///< of all frames, metres: the middle of the bounding box
    float radius = 0.0F;     ///< half the side of the square that a frame shows, metres
    Bounds box;              ///< of the scene
    /// side() rows of as many texels, the frame of column c and row r at (c, r) * frame_side.
    /// Where nothing is seen, alpha is 0 and the other channels continue what is beside.
    Bytes
        base_color;  ///< red, green, blue (sRGB, with half of the occlusion) and alpha, the coverage
    Bytes normal;    ///< in the axes of the frame: right, up, toward
    /// Depth, roughness, depth: 255 times (1 + distance towards the viewer from the plane through the
    /// centre / radius) / 2. Roughness is the mean of 8 x 8 texels, so that what lossy images mix of the
    /// channels leaves depth smooth.
    Bytes orm;
    std::array<FrameContent, frame_count> content;  ///< [row][column]
    /// Length of the mean of the unit normals of a few texels, the mean of all frames: 1 for a smooth
    /// surface, about 0.5 for leaves that are smaller than a texel. The image has unit vectors, so that
    /// only this says how far the normals of what a texel shows differ.
    float normal_length = 1.0F;

    [[nodiscard]] int side() const { return atlas_side(frame_side); }
    [[nodiscard]] const FrameContent& content_of(FrameCell cell) const {
        return content[static_cast<std::size_t>(cell.row * frame_grid + cell.column)];
    }
};

/// Largest and smallest side of a frame, texels.
inline constexpr int least_frame_side = 32, largest_frame_side = 512;

/// Draws all frames of a scene: of each texel four samples of what is in front, without light.
///
/// scene       with embedded images, or with none: then it is white and rough
/// frame_side  texels, a multiple of 8, so that no texel of the first three smaller copies of an
///             image has parts of two frames
/// throws      GenerationError for a scene without triangles or another side; what `parallel` throws
/// cost        O(frames * (triangles + texels of a frame))
[[nodiscard]] ImpostorAtlas impostor_atlas(const GlbScene& scene, int frame_side,
                                           const Parallel& parallel = in_turn);

/// Returns the cutoff of alpha with which smaller copies of an image cover the same area as the image
/// itself, as nearly as one number can: about one half for a solid shape, less for thin ones, which
/// would vanish at a distance.
///
/// rgba     side * side texels
/// returns  0.25..0.5
[[nodiscard]] double cutoff_of(const Bytes& rgba, int side);

/// Encodes the images of an atlas; the base colour beside JPEG images is a PNG.
[[nodiscard]] ImageSet encoded(const ImpostorAtlas& atlas, ImageFormat format,
                               const Parallel& parallel = in_turn);

}  // namespace sporeprint
