#include <utility>

#include "api/endpoints.h"
#include "api/mix.h"
#include "core/grow/colony.h"
#include "core/params/messages.h"
#include "core/params/reader.h"

namespace sporeprint::api {

namespace {

/// About what an order comes to, before its individuals are known.
Estimate guessed(const ColonyOrder& order) {
    const ColonyParams& params = order.params;
    const auto side = static_cast<std::uint64_t>(params.texture_size.value) >> params.lod;
    Estimate guess;
    guess.vertices = (static_cast<std::uint64_t>(params.distinct) * 4000 + 60'000) >> params.lod;
    const std::uint64_t images = params.textures == Textures::none ? 0 : 3 * side * side;
    guess.texels = images * static_cast<std::uint64_t>(atlases_held(paint_order(order)));
    guess.bytes = 60 * guess.vertices + images / 3;
    return guess;
}

/// The GLB.
Body grown(const Context& context, const ColonyOrder& order, const std::string& address,
           Loan& loan) {
    const Atlas& atlas = *context.atlas;
    Extras extras;
    extras.canonical = address;
    if (order.params.textures == Textures::linked) {
        // Its images are those of a mushroom, larger than that one's level of detail would have them.
        const MushroomOrder surface =
            surface_order(paint_order(order), atlas, loan.workshop().memo);
        SurfaceAddress image = surface_address(surface);
        image.texture_size = {order.params.texture_size >> order.params.lod};
        for (std::size_t i = 0; i < extras.image_addresses.size(); ++i)
            extras.image_addresses[i] =
                with_version(canonical_address(surface.mix, static_cast<ImageKind>(i), image),
                             version_token(surface.mix, atlas));
    }
    return grow_colony(order, atlas, extras, loan.workshop()).glb;
}

/// What would be made, as JSON.
Body described(const Context& context, const ColonyOrder& order, const std::string& version,
               Loan& loan) {
    const Colony colony = colony_parts(order, *context.atlas, loan.workshop());
    loan.workshop().observer(Step::pack);
    Value mix = Value::array();
    for (const MixPart& part : order.mix)
        mix.push(Value::object().set("id", part.id).set("weight", part.weight / 1000.0));
    Value body = Value::object();
    body.set("canonical", canonical_address(order, Product::glb));
    body.set("v", version);
    body.set("mix", std::move(mix));
    body.set("made", std::uint64_t{colony.members.size()});
    body.set("effective", write(colony.effective));
    body.set("estimate", told(measured(order, colony)));
    body.set("bounds_m", told(bounds(colony)));
    return {slice_of(dump(body))};
}

}  // namespace

Plan plan_colony(Context& context, const Request& request, ColonyRequest asked, Faults& faults) {
    if (!faults.empty()) return context.answers.problem(request, faults);
    const Product product = asked.product;
    const auto order = std::make_shared<const ColonyOrder>(std::move(asked.order));
    Resource resource;
    resource.version = version_token(order->mix, *context.atlas);
    resource.address = canonical_address(*order, product);
    resource.key = key_of(*order, product, resource.version);
    resource.type = type_of(product);
    resource.file_name = file_name(*order, product);
    resource.asked_version = std::move(asked.version);
    resource.is_linked = product == Product::glb && order->params.textures == Textures::linked;
    resource.weigh = [&context, order, product](const Memo& memo) {
        const Estimate cost = estimate(*order, *context.atlas, memo);
        refuse_over_budget(context.options, cost, order->mix.size() > 1);
        return cost_of(cost, product);
    };
    resource.guess = cost_of(guessed(*order), product);
    resource.make = [&context, order, product, address = resource.address,
                     version = resource.version](Loan& loan) {
        return product == Product::glb ? grown(context, *order, address, loan)
                                       : described(context, *order, version, loan);
    };
    return plan_resource(context, request, std::move(resource), faults);
}

}  // namespace sporeprint::api
