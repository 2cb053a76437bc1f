// What routes of products that grow from presets mean, up to the Job that makes them; each product's own file names its Kind.
#pragma once

#include <memory>
#include <utility>

#include "api/products/endpoints.h"
#include "api/products/presets.h"

namespace sporeprint::api {

/// A product as GLB or JSON, by address or by body. What `Recipe` tells of an order:
///   grow(order, extras, depth, workshop)  the file; depth of links to further images
///   measure(order, workshop)       what it comes to, exactly, and where it lies
///   cost(order)                    what growing it costs beside its vertices, bytes and images
///   paint_cost(order)              what painting all of its images costs
///   tell(order, body)              what else its JSON tells; none of it where there is no such function
template <class Kind, class Recipe>
Plan plan_preset(Context& context, const Request& request, PresetRequest<Kind> requested,
                 ValidationErrors& errors) {
    if (!errors.empty()) return context.responses.problem(request, errors);
    const Product product = requested.product;
    const auto spec = std::make_shared<const typename Kind::Order>(std::move(requested.spec));
    Resource resource;
    resource.version = preset_token<Kind>(spec->preset);
    resource.address = canonical_address<Kind>(*spec, product);
    resource.key = key_of<Kind>(*spec, product, resource.version);
    resource.type = type_of(product);
    resource.file_name = preset_file_name(*spec, product);
    resource.requested_version = std::move(requested.version);
    resource.is_linked = product == Product::glb && spec->params.textures == Textures::linked;
    resource.estimate_cost = [&context, spec, product](const Caches&) {
        const Estimate estimated = estimate(*spec);
        refuse_over_budget(context.options, estimated);
        Cost cost = Recipe::cost(*spec);
        cost.placed_vertices = estimated.vertices;
        if (product == Product::json) return cost;
        cost.bytes = estimated.bytes;
        if (spec->params.textures == Textures::embedded) cost += Recipe::paint_cost(*spec);
        return cost;
    };
    resource.make = [spec, product, address = resource.address,
                     depth = link_depth(context, request),
                     version = resource.version](JobContext& job_context) -> Body {
        if (product == Product::json) {
            const auto [cost, box] = Recipe::measure(*spec, job_context.execution());
            Value body = Value::object();
            body.set("canonical", canonical_address<Kind>(*spec, Product::glb));
            body.set("v", version);
            body.set("preset", spec->preset);
            body.set("effective", write(spec->params));
            body.set("estimate", description(cost));
            body.set("bounds_m", description(box));
            if constexpr (requires { Recipe::tell(*spec, body); }) Recipe::tell(*spec, body);
            return {slice_of(dump(body))};
        }
        Extras extras;
        extras.canonical = address;
        if (spec->params.textures == Textures::linked)
            for (std::size_t i = 0; i < extras.image_urls.size(); ++i)
                extras.image_urls[i] = reference_from(
                    depth, with_version(
                               canonical_image_address<Kind>(
                                   spec->preset, static_cast<ImageKind>(i), paint_of(spec->params)),
                               version));
        return Recipe::grow(*spec, extras, depth, job_context.execution()).glb;
    };
    return plan_resource(context, request, std::move(resource), errors);
}

/// The image that an address asks for, as HTTP sees it.
template <class Kind>
ImageResource image_of(const PresetSurface<Kind>& requested) {
    std::string of = requested.preset;
    if constexpr (requires { requested.paint.seed; })
        of += '-' + std::to_string(requested.paint.seed);
    return {*requested.kind, preset_token<Kind>(requested.preset),
            canonical_image_address<Kind>(requested.preset, *requested.kind, requested.paint),
            std::move(of), requested.version};
}

/// One image of a product.
template <class Kind>
Plan plan_preset_surface(Context& context, const Request& request,
                         const PresetSurface<Kind>& requested, ValidationErrors& errors) {
    if (!errors.empty()) return context.responses.problem(request, errors);
    const auto decide = [&](ValidationErrors& found) {
        const auto paint = std::make_shared<const typename Kind::Paint>(requested.paint);
        const auto side = static_cast<std::uint64_t>(paint->texture_size.value);
        const std::uint64_t texels = 3 * side * side;
        refuse_texels(context.options, texels, false, found);
        return PaintWork{image_key(*paint), cost_of_paint(*paint),
                         [paint](const ExecutionContext& execution) {
                             return painted_images(*paint, execution);
                         }};
    };
    return plan_image(context, request, image_of(requested), decide, errors);
}

}  // namespace sporeprint::api
