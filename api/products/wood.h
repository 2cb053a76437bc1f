// Images of the wood that fungi stand on: their URLs and routes.
#pragma once

#include "api/products/context.h"
#include "api/products/product.h"
#include "core/grow/product.h"
#include "core/plant/wood_image.h"

namespace sporeprint::api {

/// The query parameter of an image of wood.
struct WoodAddress {
    ImageSide texture_size{1024};

    static constexpr void fields(auto visit) {
        visit(&WoodAddress::texture_size,
              Info{.name = "side", .unit = "texels", .doc = "Side of this image."});
    }
    bool operator==(const WoodAddress&) const = default;
};

/// Returns the URLs of the images of wood with their versions.
///
/// product  "colonies" or "mushrooms": the folder of the models that stand on it
[[nodiscard]] ImageUrls wood_image_urls(const char* product, const WoodPaint& paint);

/// Returns the cost of painting the images of wood: twice that of as much bark, for what grows on it.
[[nodiscard]] Cost cost_of_paint(const WoodPaint& paint);

/// Plans the response to a request for an image of wood: /v1/{product}/wood/{wood}/{image}.
///
/// query  without parameters of the model
[[nodiscard]] Plan plan_wood_image(RouteCall& call, const char* product, ImageFormat format,
                                   Query query);

}  // namespace sporeprint::api
