// Dissolves several paintings of one atlas into one: the surface of a mushroom between species.
#pragma once

#include <span>

#include "core/surface/paint.h"

namespace sporeprint {

/// Cross-dissolves paintings: colours in linear light, normals by their slopes, occlusion and roughness as they are.
///
/// A weighted mean of unlike paintings is flatter than each of them. So what stands out from the mean of its surroundings is
/// stretched until its deviation over the chart is the weighted mean of the paintings' deviations; never by more than
/// 1 / sqrt(sum w^2), which is right for paintings that have nothing in common. Paintings of one individual share their noise and
/// need less; equal ones need none. No texel passes what one of the paintings has at its place: it is bent back smoothly.
///
/// laid       what was painted, of which the warts and scales were left out (unlaid()): they are laid on the dissolved cap, as
///            large as their paintings weigh, as the solid ones are; empty for none
/// paintings  1..9, equal sides, each 3 * side * side bytes an image
/// weights    one each, >= 0, sum 1 (within 1e-6); a weight of 1 gives that painting, byte for byte
/// returns    the atlas; the same bytes however the work is shared and with every instruction set
/// throws     InvalidInput if counts, sides or weights are not as stated; Cancelled
/// cost       O(paintings * side^2)
/// source     [Heitz2018] for the blending that keeps mean and variance; differs: the gain is measured, not assumed
[[nodiscard]] RawImages dissolve_raw(std::span<const RawImages* const> paintings,
                                     std::span<const double> weights,
                                     const Parallel& parallel = in_turn,
                                     std::span<const PaintParams* const> laid = {});

/// The same, encoded as paint() encodes.
[[nodiscard]] ImageSet dissolve(std::span<const RawImages* const> paintings,
                                std::span<const double> weights, const Parallel& parallel = in_turn,
                                std::span<const PaintParams* const> laid = {});

/// The same painting without warts and scales.
[[nodiscard]] PaintParams unlaid(PaintParams params);

}  // namespace sporeprint
