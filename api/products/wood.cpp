#include "api/products/wood.h"

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "api/products/images.h"
#include "api/products/resource.h"
#include "core/grow/wood.h"
#include "core/params/messages.h"
#include "core/params/query.h"

namespace sporeprint::api {

namespace {

std::string version_of(const WoodPaint& paint) {
    return token_of(std::string("wood ") + name(paint.substrate));
}

/// Returns the canonical URL of an image without version.
std::string address_of(const char* product, const WoodPaint& paint, ImageKind kind,
                       ImageFormat format) {
    return with_query(
        folder_of(product) + "wood/" + name(paint.substrate) + '/' + file_of(kind, format),
        query_text(WoodAddress{paint.texture_size}, WoodAddress{}));
}

/// Returns the wood with a name. If there is none, adds 404 and returns that of beech.
Substrate wood_named(std::string_view named, ValidationErrors& errors) {
    std::vector<std::string> names;
    for (const Substrate wood : all_woods) {
        if (named == name(wood)) return wood;
        names.emplace_back(name(wood));
    }
    const std::string_view meant = closest(named, names);
    errors.add(404, "wood",
               "unknown wood " + in_quotes(named) +
                   (meant.empty() ? "" : "; did you mean " + in_quotes(meant) + "?"));
    return Substrate::beech;
}

}  // namespace

ImageUrls wood_image_urls(const char* product, const WoodPaint& paint) {
    return image_urls_of([&](ImageKind kind, ImageFormat format) {
        return with_version(address_of(product, paint, kind, format), version_of(paint));
    });
}

Cost cost_of_paint(const WoodPaint& paint) {
    return {.bark_atlases = 1, .bark_texels = 4 * texels_of(paint)};
}

Plan plan_wood_image(RouteCall& call, const char* product, ImageFormat format, Query query) {
    Context& context = call.context;
    WoodAddress address;
    std::vector<std::pair<std::string, std::string>> rest;
    const std::optional<std::string> version = take_version(query, rest, call.errors);
    std::vector<Problem> problems;
    read_query(rest, address, problems);
    add_problems(problems, address, "", false, call.errors);
    const WoodPaint paint{wood_named(call.captured[0], call.errors), address.texture_size};
    const std::optional<ImageKind> kind = read_image(call.captured[1], call.errors);
    if (!call.errors.empty()) return context.responses.problem(call.request, call.errors);
    const auto decide = [&](ValidationErrors& found) {
        return paint_work(context, paint, cost_of_paint(paint), format, found);
    };
    const ImageResource image{*kind,
                              format,
                              version_of(paint),
                              address_of(product, paint, *kind, format),
                              std::string(name(paint.substrate)) + "_wood",
                              version};
    return plan_image(context, call.request, image, decide, call.errors);
}

}  // namespace sporeprint::api
