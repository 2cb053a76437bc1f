// From the request for a product to its Resource; common to all products.
#pragma once

#include <array>
#include <memory>
#include <string>
#include <type_traits>
#include <utility>

#include "api/products/product.h"
#include "api/products/resource.h"
#include "core/individual/mushroom_spec.h"
#include "core/params/value.h"

namespace sporeprint::api {

/// Returns the response to a request for a product, as GLB or as its geometry alone, as the JSON that describes it, as a
/// picture, or the job that computes it. Returns a problem response if `errors` is not empty. `Kind` has these
/// static functions of a specification (`Spec`), and a type Resolved, empty at first, in which
/// cost() may leave what it has resolved for grow() and describe():
///   version(spec, atlas)                   current version token
///   document_version(spec, atlas)          optional: that of the JSON, if it depends on more
///   url(spec, product, atlas)              canonical URL without version; "" if it has none
///   key(spec, product, version)            canonical text of all values
///   file_name(spec, product, atlas)
///   cost(context, spec, product, caches, resolved)   cost of generating it; throws if it is
///                                          impossible
///   search(spec, atlas)                    optional: cost of its correspondence (MorphSet)
///   guess(spec, product, atlas)            optional: approximate cost without the correspondence
///   image_urls(context, spec, version, execution)   URLs of its images with their versions
///   variant_urls(context, spec, painted, execution)   optional: those of a variant, unless the
///                                          specification is that of a mushroom
///   grow(context, spec, resolved, extras, depth, execution)   the GLB; depth of links to further
///                                          images
///   describe(context, spec, resolved, version, execution)     the JSON
///
/// requested  the specification, the product and the version token that was requested
template <class Kind, class Requested>
Plan plan_product(Context& context, const Request& request, Requested requested,
                  ValidationErrors& errors) {
    if (!errors.empty()) return context.responses.problem(request, errors);
    using Spec = decltype(requested.spec);
    const Product product = requested.product;
    const auto spec = std::make_shared<const Spec>(std::move(requested.spec));
    // Written by the estimate before the job begins, and by the job itself.
    const auto resolved = std::make_shared<typename Kind::Resolved>();
    Resource resource;
    resource.version = Kind::version(*spec, *context.atlas);
    if constexpr (requires { Kind::document_version(*spec, *context.atlas); })
        if (product == Product::json)
            resource.version = Kind::document_version(*spec, *context.atlas);
    const std::string url = Kind::url(*spec, product, *context.atlas);
    if (!url.empty()) resource.address = with_version(url, resource.version);
    resource.key = Kind::key(*spec, product, resource.version);
    resource.type = type_of(product);
    resource.file_name = Kind::file_name(*spec, product, *context.atlas);
    resource.requested_version = std::move(requested.version);
    resource.is_linked = product == Product::glb && has_addresses(spec->params.textures);
    resource.estimate_cost = [&context, spec, product, resolved](const Caches& caches) {
        return Kind::cost(context, *spec, product, caches, *resolved);
    };
    if constexpr (requires { Kind::search(*spec, *context.atlas); })
        resource.search = Kind::search(*spec, *context.atlas);
    if constexpr (requires { Kind::guess(*spec, product, *context.atlas); })
        resource.guess = Kind::guess(*spec, product, *context.atlas);
    resource.make = [&context, spec, product, resolved, url, depth = link_depth(context, request),
                     version = resource.version](JobContext& job) -> Body {
        if constexpr (requires { (*resolved)->set; })
            if (*resolved && (*resolved)->set) job.count_known_morphs();
        if (product == Product::json)
            return {slice_of(
                dump(Kind::describe(context, *spec, *resolved, version, job.execution())))};
        Extras extras;
        extras.canonical = url;
        if (product == Product::bin) extras.write = geometry_bytes;
        if (has_addresses(spec->params.textures)) {
            const ImageUrls urls = Kind::image_urls(context, *spec, version, job.execution());
            extras.image_urls = references_from(depth, urls);
            if constexpr (std::is_same_v<Spec, MushroomSpec>)
                extras.variant_urls = [&](const MushroomSpec& variant) {
                    return references_from(
                        depth, Kind::image_urls(context, variant, version, job.execution()));
                };
            if constexpr (requires {
                              Kind::variant_urls(context, *spec, MushroomSpec(), job.execution());
                          })
                extras.variant_urls = [&](const MushroomSpec& painted) {
                    return references_from(
                        depth, Kind::variant_urls(context, *spec, painted, job.execution()));
                };
        }
        return Kind::grow(context, *spec, *resolved, extras, depth, job.execution());
    };
    return plan_resource(context, request, std::move(resource), errors);
}

}  // namespace sporeprint::api
