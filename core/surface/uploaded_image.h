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

/// Decodes an upload to linear light and downsamples it by factors of two until neither side has
/// more than twice the texels of its chart; the result is empty if there is no upload.
///
/// frame   texels of its chart
/// throws  InvalidInput (with this path) if it cannot be decoded
[[nodiscard]] UploadedImage uploaded_image(const Upload& upload, const Frame& frame,
                                           const std::string& path);

/// Sets the rotation of an image, in turns; see ImageRotations.
void rotate(UploadedImage& image, double turns);

/// Number of angles at which uploaded images are compared.
inline constexpr int profile_samples = 256;

/// Returns the light of an image at profile_samples angles round its axis, each summed over the
/// channels and over samples along the radius (disc) or the axis (strip). The mean of all is
/// subtracted.
[[nodiscard]] std::vector<double> angular_profile(const UploadedImage& image, ChartMap map);

/// Returns the circular shift s for which the sum of a[k] * b[k + s] is largest; of equal sums the
/// one with the smallest |s|.
///
/// pre      a and b have n values each
/// returns  -n / 2 < s <= n / 2
[[nodiscard]] int best_shift(std::span<const double> a, std::span<const double> b);

/// Returns the rotations of the uploaded images of each painting in a mix that align their angular
/// profiles with that of the first upload by best_shift(); their weighted mean is 0. They depend
/// continuously on the weights and are 0 for a single species. Painted parts need none, because all
/// species of one individual are painted from the same random streams.
///
/// paintings  one per species, in an order that does not depend on the weights
/// weights    one each, sum 1
/// throws     InvalidInput if an image cannot be read
[[nodiscard]] std::vector<ImageRotations> aligned_rotations(
    std::span<const PaintParams* const> paintings, std::span<const double> weights);

}  // namespace sporeprint
