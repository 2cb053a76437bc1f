// Pictures of grown mushrooms in front of a background, with the pixels that are the mushroom: what a tracer
// is tested on.
#pragma once

#include <cstdint>
#include <string>

#include "core/model/model.h"
#include "core/render/picture_params.h"
#include "core/trace/gesture.h"
#include "core/trace/photo.h"

namespace sporeprint {

/// How hard a photograph is to cut: plain paper of low contrast; a sharp forest floor behind and below; the
/// same with leaves before the foot and neighbours beside it.
enum class Scenery { plain, forest, crowded };

/// A photograph and the truth about it.
struct Photograph {
    Picture picture;
    trace::Mask truth;
    trace::Gesture gesture;  ///< lines along the middle of the truth: what a careful person draws
};

/// What is photographed.
struct Sitter {
    std::string species;
    double age = 0.7;
    std::uint32_t seed = 1;
    View view = View::front;
    int side = 1024;  ///< of the picture, pixels
};

/// Returns a photograph with noise of a sensor. A mask that is cut off by a leaf before the foot has the
/// leaf's pixels outside.
[[nodiscard]] Photograph photograph(const Sitter& sitter, Scenery scenery);

/// Returns lines as a careful person draws them: up the middle of stem and cap, and across the widest row.
[[nodiscard]] trace::Gesture drawn_by_hand(const trace::Mask& truth);

/// Returns the pixels of a model that grows without variation and ground.
[[nodiscard]] trace::Mask silhouette_of(const Model& model, View view, int side);

/// Returns the area of the intersection of two masks of one size over that of their union.
[[nodiscard]] double intersection_over_union(const trace::Mask& a, const trace::Mask& b);

}  // namespace sporeprint
