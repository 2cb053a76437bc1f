// One image of a product as an HTTP resource, and the job that paints all images of its set.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "api/products/context.h"
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

/// Plans the response to a request for an image: version, conditions, caches, HEAD, or the job that
/// paints it.
///
/// decide  returns the work; adds what is impossible to its argument
[[nodiscard]] Plan plan_image(Context& context, const Request& request, const ImageResource& image,
                              const std::function<PaintWork(ValidationErrors&)>& decide,
                              ValidationErrors& errors);

}  // namespace sporeprint::api
