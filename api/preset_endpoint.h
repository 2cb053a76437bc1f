// What routes of products that grow from presets mean, up to the Job that makes them; each product's own file names its Kind.
#pragma once

#include <memory>
#include <utility>

#include "api/endpoints.h"
#include "api/presets.h"

namespace sporeprint::api {

/// A product as GLB or JSON, by address or by body. What `Recipe` tells of an order:
///   grow(order, extras, depth, workshop)  the file; depth of links to further images
///   measure(order, workshop)       what it comes to, exactly, and where it lies
///   cost(order)                    what growing it costs beside its vertices, bytes and images
///   paint_cost(order)              what painting all of its images costs
///   tell(order, body)              what else its JSON tells; none of it where there is no such function
template <class Kind, class Recipe>
Plan plan_preset(Context& context, const Request& request, PresetRequest<Kind> asked,
                 Faults& faults) {
    if (!faults.empty()) return context.answers.problem(request, faults);
    const Product product = asked.product;
    const auto order = std::make_shared<const typename Kind::Order>(std::move(asked.order));
    Resource resource;
    resource.version = preset_token<Kind>(order->preset);
    resource.address = canonical_address<Kind>(*order, product);
    resource.key = key_of<Kind>(*order, product, resource.version);
    resource.type = type_of(product);
    resource.file_name = preset_file_name(*order, product);
    resource.asked_version = std::move(asked.version);
    resource.is_linked = product == Product::glb && order->params.textures == Textures::linked;
    resource.weigh = [&context, order, product](const Memo&) {
        const Estimate estimated = estimate(*order);
        refuse_over_budget(context.options, estimated);
        Cost cost = Recipe::cost(*order);
        cost.placed_vertices = estimated.vertices;
        if (product == Product::json) return cost;
        cost.bytes = estimated.bytes;
        if (order->params.textures == Textures::embedded) cost += Recipe::paint_cost(*order);
        return cost;
    };
    resource.make = [order, product, address = resource.address,
                     depth = link_depth(context, request),
                     version = resource.version](Loan& loan) -> Body {
        if (product == Product::json) {
            const auto [cost, box] = Recipe::measure(*order, loan.workshop());
            Value body = Value::object();
            body.set("canonical", canonical_address<Kind>(*order, Product::glb));
            body.set("v", version);
            body.set("preset", order->preset);
            body.set("effective", write(order->params));
            body.set("estimate", told(cost));
            body.set("bounds_m", told(box));
            if constexpr (requires { Recipe::tell(*order, body); }) Recipe::tell(*order, body);
            return {slice_of(dump(body))};
        }
        Extras extras;
        extras.canonical = address;
        if (order->params.textures == Textures::linked)
            for (std::size_t i = 0; i < extras.image_addresses.size(); ++i)
                extras.image_addresses[i] =
                    reference_from(depth, with_version(canonical_image_address<Kind>(
                                                           order->preset, static_cast<ImageKind>(i),
                                                           paint_of(order->params)),
                                                       version));
        return Recipe::grow(*order, extras, depth, loan.workshop()).glb;
    };
    return plan_resource(context, request, std::move(resource), faults);
}

/// The image that an address asks for, as HTTP sees it.
template <class Kind>
ImageResource image_of(const PresetSurface<Kind>& asked) {
    std::string of = asked.preset;
    if constexpr (requires { asked.paint.seed; }) of += '-' + std::to_string(asked.paint.seed);
    return {*asked.kind, preset_token<Kind>(asked.preset),
            canonical_image_address<Kind>(asked.preset, *asked.kind, asked.paint), std::move(of),
            asked.version};
}

/// One image of a product.
template <class Kind>
Plan plan_preset_surface(Context& context, const Request& request, const PresetSurface<Kind>& asked,
                         Faults& faults) {
    if (!faults.empty()) return context.answers.problem(request, faults);
    const auto decide = [&](Faults& found) {
        const auto paint = std::make_shared<const typename Kind::Paint>(asked.paint);
        const auto side = static_cast<std::uint64_t>(paint->texture_size.value);
        const std::uint64_t texels = 3 * side * side;
        refuse_texels(context.options, texels, false, found);
        return PaintWork{
            image_key(*paint), cost_of_paint(*paint),
            [paint](const Workshop& workshop) { return painted_images(*paint, workshop); }};
    };
    return plan_image(context, request, image_of(asked), decide, faults);
}

}  // namespace sporeprint::api
