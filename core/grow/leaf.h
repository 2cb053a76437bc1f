// The recipe of a leaf: an order in, a GLB out.
#pragma once

#include <memory>
#include <string>

#include "core/grow/execution_context.h"
#include "core/grow/product.h"
#include "core/plant/leaf_spec.h"

namespace sporeprint {

/// Number of vertices and triangles (at most), texels and bytes; nanoseconds.
[[nodiscard]] Estimate estimate(const LeafOrder& order);

/// The mesh alone: root of the petiole at the origin, the limb along +z, its upper face up.
///
/// throws  InvalidInput
[[nodiscard]] Mesh leaf_mesh(const LeafOrder& order);

/// The estimate of an order whose mesh is there: vertices and triangles are exact.
[[nodiscard]] Estimate measured(const LeafOrder& order, const Mesh& mesh);

/// Key of a leaf's images: equal keys, equal images.
[[nodiscard]] std::string image_key(const LeafPaint& paint);

/// The images, as the workshop's Memo remembers them or painted now.
///
/// throws  InvalidInput, Cancelled
[[nodiscard]] std::shared_ptr<const ImageSet> painted_images(const LeafPaint& paint,
                                                             const Workshop& workshop);

/// Grows a leaf.
///
/// returns  the GLB as shared slices: header with JSON, geometry, images
/// throws   InvalidInput, Impossible, GenerationError, Cancelled
[[nodiscard]] Grown grow_leaf(const LeafOrder& order, const Extras& extras = {},
                              const Workshop& workshop = {});

}  // namespace sporeprint
