// Uploaded images that replace a painted part, and the rotations that align those of several
// species.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "core/params/types.h"
#include "core/surface/charts.h"
#include "core/surface/paint.h"
#include "core/surface/plan.h"

namespace sporeprint {

/// Decodes an upload to linear light and halves it until it has at most twice the resolution of its
/// chart; empty for no upload.
///
/// throws  InvalidInput (at `path`) if it cannot be read
[[nodiscard]] UploadedImage uploaded_image(const Upload& upload, const Frame& frame,
                                           const std::string& path);

/// Sets the rotation of an image, in turns.
void rotate(UploadedImage& image, double turns);

/// Number of angles at which uploaded images are compared.
inline constexpr int profile_samples = 256;

/// Returns the mean light of an image at profile_samples angles round its axis (over the radii of a
/// disc, along a stem), shifted to mean 0.
[[nodiscard]] std::vector<double> angular_profile(const UploadedImage& image, ChartMap map);

/// Returns the circular shift of `b` against `a` with the largest correlation, the smallest of
/// equals; in -profile_samples / 2 < s <= profile_samples / 2.
[[nodiscard]] int best_shift(std::span<const double> a, std::span<const double> b);

/// Returns how far the uploaded images of each painting are rotated in a mix, so that they match as
/// well as a rotation allows. Rotations depend continuously on the weights, and are 0 for a single
/// species. Painted parts need none, because all species of one individual are painted from the
/// same random streams.
///
/// paintings  one per species, in an order that does not depend on the weights
/// weights    one each, sum 1
/// throws     InvalidInput if an image cannot be read
[[nodiscard]] std::vector<ImageRotations> aligned_rotations(
    std::span<const PaintParams* const> paintings, std::span<const double> weights);

}  // namespace sporeprint
