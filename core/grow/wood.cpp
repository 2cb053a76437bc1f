#include "core/grow/wood.h"

#include <algorithm>

#include "core/grow/product.h"

namespace sporeprint {

ImageSide wood_side(TextureSize texture_size, int lod) {
    return {std::max(texture_size.value >> (lod + 1), 16)};
}

std::string image_key(const WoodPaint& paint, ImageFormat format) {
    return key_of_format(format) + "wood " + name(paint.substrate) + ' ' +
           std::to_string(paint.texture_size.value);
}

std::shared_ptr<const ImageSet> painted_images(const WoodPaint& paint,
                                               const ExecutionContext& execution,
                                               ImageFormat format) {
    return execution.caches.images(image_key(paint, format), [&] {
        const RawImages images = wood_images(paint, execution.parallel);
        throw_if_cancelled(execution);
        return std::make_shared<const ImageSet>(encoded(images, format, execution.parallel));
    });
}

}  // namespace sporeprint
