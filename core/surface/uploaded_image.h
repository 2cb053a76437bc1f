// Given images: an upload instead of a painting, and how those of several species are turned onto each other.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "core/params/types.h"
#include "core/surface/charts.h"
#include "core/surface/paint.h"
#include "core/surface/plan.h"

namespace sporeprint {

/// The decoded upload in linear light, halved until it is no more than twice as fine as its chart; empty for none.
///
/// throws  InvalidInput (at `path`) if it cannot be read
[[nodiscard]] GivenImage given_image(const Upload& upload, const Frame& frame,
                                     const std::string& path);

/// Turns what is shown of an image by so many turns.
void turn(GivenImage& image, double turns);

/// Places round the axis that given images are compared at.
inline constexpr int profile_places = 256;

/// Mean light of an image round its axis at profile_places angles: over the radii of a disc's image, along a stem's. Mean 0.
[[nodiscard]] std::vector<double> round_profile(const GivenImage& image, ChartMap map);

/// Places by which `b` lies further on than `a`: the most alike of all circular shifts, the smallest of equals; in
/// -profile_places / 2 < s <= profile_places / 2.
[[nodiscard]] int best_shift(std::span<const double> a, std::span<const double> b);

/// How far each painting's given images are turned in a mix, so that they lie on each other as well as turning can make them.
/// Turns move with the weights, so that a species alone stands as it was given; no painting turns against none.
/// What is painted needs none of this: all species of one individual are painted from the same streams.
///
/// paintings  one per species, in an order that does not depend on the weights
/// weights    one each, sum 1
/// throws     InvalidInput if an image cannot be read
[[nodiscard]] std::vector<GivenTurns> aligned_turns(std::span<const PaintParams* const> paintings,
                                                    std::span<const double> weights);

}  // namespace sporeprint
