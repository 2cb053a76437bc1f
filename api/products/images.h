// One image of a product as an HTTP resource, and the job that paints all images of its set.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "api/products/context.h"
#include "api/products/resource.h"
#include "core/surface/paint.h"

namespace sporeprint::api {

/// One image of an atlas as an HTTP resource.
struct ImageResource {
    ImageKind kind = ImageKind::base_color;
    ImageFormat format = ImageFormat::jpg;
    std::string version;  ///< current version token
    std::string address;  ///< canonical URL without version
    std::string of;       ///< first part of the file name: "amanita_muscaria-7"
    std::optional<std::string> requested_version;
};

/// The work of painting an atlas.
struct PaintWork {
    Key key;  ///< equal keys, equal images
    Cost cost;
    std::function<Images(const ExecutionContext&)> paint;
};

/// Returns the work of painting square images of one kind of paint; adds the refusal of images that
/// are too large to `found`.
///
/// paint  with its texture_size; core paints it by painted_images() and names it by image_key()
/// cost   of painting it, without that of other formats
template <class Paint>
[[nodiscard]] PaintWork paint_work(const Context& context, const Paint& paint, Cost cost,
                                   ImageFormat format, ValidationErrors& found) {
    const auto side = static_cast<std::uint64_t>(paint.texture_size.value);
    refuse_texels(context.options, 3 * side * side, false, found);
    if (format == ImageFormat::webp) cost.webp_texels = 3 * side * side;
    return {image_key(paint, format), cost, [paint, format](const ExecutionContext& execution) {
                return painted_images(paint, execution, format);
            }};
}

/// Plans the response to a request for an image: version, conditions, caches, HEAD, or the job that
/// paints it.
///
/// decide  returns the work; adds what is impossible to its argument
[[nodiscard]] Plan plan_image(Context& context, const Request& request, const ImageResource& image,
                              const std::function<PaintWork(ValidationErrors&)>& decide,
                              ValidationErrors& errors);

}  // namespace sporeprint::api
