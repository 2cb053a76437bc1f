// Blends several paintings of one atlas into one, for mushrooms between species.
#pragma once

#include <span>

#include "core/surface/paint.h"

namespace sporeprint {

/// Blends paintings: colours in linear light, normals by their slopes, occlusion and roughness
/// directly.
///
/// A weighted mean of different paintings has less contrast than each of them. So the difference
/// from the local mean is amplified until its deviation over the chart is the weighted mean of the
/// paintings' deviations; at most by 1 / sqrt(sum w^2), which is right for uncorrelated paintings.
/// Paintings of one individual share their noise and need less; equal ones need none. No texel
/// leaves the range of the paintings at its place: it approaches the limit smoothly.
///
/// paintings   1..9, equal sides, each 3 * side * side bytes per image
/// weights     one each, >= 0, sum 1 (within 1e-6); a weight of 1 gives that painting, byte for
///             byte
/// patches_of  parameters whose warts and scales were left out of the paintings
///             (without_patches()); they are added after blending, scaled by the weights as the
///             solid ones are; empty for none
/// returns     the atlas; the same bytes however the work is split, and with every instruction set
/// throws      InvalidInput if counts, sides or weights are not as stated; Cancelled
/// cost        O(paintings * side^2)
/// source      [Heitz2018] for blending that preserves mean and variance; differs: the gain is
///             measured, not assumed
[[nodiscard]] RawImages blend_raw(std::span<const RawImages* const> paintings,
                                  std::span<const double> weights,
                                  const Parallel& parallel = in_turn,
                                  std::span<const PaintParams* const> patches_of = {});

/// Blends and encodes as paint() does.
[[nodiscard]] ImageSet blend_images(std::span<const RawImages* const> paintings,
                                    std::span<const double> weights,
                                    const Parallel& parallel = in_turn,
                                    std::span<const PaintParams* const> patches_of = {},
                                    ImageFormat format = ImageFormat::jpg);

/// Returns the same parameters without warts and scales.
[[nodiscard]] PaintParams without_patches(PaintParams params);

}  // namespace sporeprint
