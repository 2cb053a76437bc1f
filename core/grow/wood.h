// Painting of the wood that fungi stand on, through the cache of images.
#pragma once

#include <memory>
#include <string>

#include "core/grow/execution_context.h"
#include "core/images.h"
#include "core/plant/wood_image.h"

namespace sporeprint {

/// Returns the side of the images of wood in a file: half of that of the fungi, which are nearer to
/// the eye.
///
/// texture_size  of the request
/// lod           0..3
[[nodiscard]] ImageSide wood_side(TextureSize texture_size, int lod);

/// Returns the key of images of wood in the cache.
[[nodiscard]] std::string image_key(const WoodPaint& paint, ImageFormat format);

/// Returns the images of wood from the cache, or paints and encodes them.
///
/// throws  InvalidInput for Substrate::none (path "/substrate"); Cancelled
[[nodiscard]] std::shared_ptr<const ImageSet> painted_images(const WoodPaint& paint,
                                                             const ExecutionContext& execution,
                                                             ImageFormat format);

}  // namespace sporeprint
