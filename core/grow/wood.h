// The wood that fungi stand on: the piece behind a bracket, and painting through the cache of images.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "core/grow/execution_context.h"
#include "core/grow/product.h"
#include "core/images.h"
#include "core/individual/individual.h"
#include "core/mesh/detail.h"
#include "core/plant/wood_image.h"

namespace sporeprint {

/// Returns the piece of wood behind a bracket, metres: split not far behind the bark, so that the
/// bracket stays the larger part of a picture; nothing for what stands on none.
[[nodiscard]] std::optional<WoodPiece> wood_behind(const Individual& individual);

/// Returns the level of detail of wood beside one of a mushroom.
[[nodiscard]] int wood_lod(DetailLevel level);

/// Returns the number of vertices and triangles of the wood behind a bracket; none for what stands
/// on none.
[[nodiscard]] MeshCount wood_count(const Individual& individual, DetailLevel level);

/// Returns the images of the wood in a file of a mushroom; nothing for what stands on none.
///
/// first  level of detail with which the file begins
[[nodiscard]] std::optional<WoodPaint> wood_paint(const MushroomSpec& spec,
                                                  const Individual& individual, DetailLevel first);

/// Returns the side of the images of wood in a file: half of that of the fungi, which are nearer to
/// the eye.
///
/// texture_size  of the request
/// lod           0..3
[[nodiscard]] ImageSide wood_side(TextureSize texture_size, int lod);

/// Returns the number of texels of the images of wood.
[[nodiscard]] std::uint64_t texels_of(const WoodPaint& paint);

/// Returns the key of images of wood in the cache.
[[nodiscard]] std::string image_key(const WoodPaint& paint, ImageFormat format);

/// Returns the images of wood from the cache, or paints and encodes them.
///
/// throws  InvalidInput for Substrate::none (path "/substrate"); Cancelled
[[nodiscard]] std::shared_ptr<const ImageSet> painted_images(const WoodPaint& paint,
                                                             const ExecutionContext& execution,
                                                             ImageFormat format);

/// Adds the material of wood to a scene, with its images as the parameters request.
///
/// returns  the embedded images, which must outlive the scene
/// throws   as attach_images()
[[nodiscard]] EmbeddedImages add_wood_material(GlbScene& scene, const WoodPaint& paint,
                                               Textures textures, const FileOptions& file,
                                               const Extras& extras,
                                               const ExecutionContext& execution);

}  // namespace sporeprint
