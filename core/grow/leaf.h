// Pipeline of a leaf: from a request to a GLB file.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "core/atlas/atlas.h"
#include "core/grow/execution_context.h"
#include "core/grow/product.h"
#include "core/plant/leaf_spec.h"

namespace sporeprint {

/// Returns the spec at the whole level of detail whose largest number of triangles is nearest to
/// `triangles`, without that; a spec without it unchanged. All functions below do so themselves.
///
/// pre  check() reports nothing for the spec
[[nodiscard]] LeafSpec at_level(LeafSpec spec);

/// Returns upper bounds of vertices and triangles, texels and bytes; takes microseconds.
[[nodiscard]] Estimate estimate(const LeafSpec& spec);

/// Returns the mesh alone: base of the petiole at the origin, the lamina along +z, its upper face
/// up.
///
/// throws  InvalidInput
[[nodiscard]] Mesh leaf_mesh(const LeafSpec& spec);

/// Returns the requested level of detail and all below it.
///
/// throws  InvalidInput
/// cost    that of building them
[[nodiscard]] std::vector<Level> levels_of(const LeafSpec& spec);

/// Returns the estimate of a spec with exact vertex and triangle counts.
///
/// levels  levels_of() the spec
[[nodiscard]] Estimate measured(const LeafSpec& spec, std::span<const Level> levels);

/// Returns the cache key of a leaf's images: equal keys, equal images.
[[nodiscard]] std::string image_key(const LeafPaint& paint, ImageFormat format);

/// Returns whether the base colour has alpha.
[[nodiscard]] bool has_alpha(const LeafPaint& paint);

/// Returns the format of the images in files: a base colour with alpha is a PNG file beside JPEG files.
[[nodiscard]] ImageFormat format_in_files(const LeafPaint& paint, ImageFormat format);

/// Returns the alpha below which texels of a leaf are not drawn; 0 if all are.
[[nodiscard]] double alpha_cutoff_of(const LeafPaint& paint);

/// Returns the images, cached in execution.caches or painted now.
///
/// format   as encoded() has it: of JPEG images none has alpha
/// throws  InvalidInput, Cancelled
[[nodiscard]] std::shared_ptr<const ImageSet> painted_images(const LeafPaint& paint,
                                                             const ExecutionContext& execution,
                                                             ImageFormat format = ImageFormat::jpg);

/// Builds a leaf.
///
/// returns  the GLB as shared slices: header with JSON, geometry, images
/// throws   InvalidInput, Impossible, GenerationError, Cancelled
[[nodiscard]] Grown grow_leaf(const LeafSpec& spec, const Atlas& atlas, const Extras& extras = {},
                              const ExecutionContext& execution = {});

}  // namespace sporeprint
