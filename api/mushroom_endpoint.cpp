#include <utility>

#include "api/endpoints.h"
#include "api/mix.h"
#include "core/grow/mushroom.h"
#include "core/params/messages.h"
#include "core/params/reader.h"

namespace sporeprint::api {

namespace {

/// What an order will come to. Refuses what of it is well-formed but impossible, as far as it can be told without making it (the
/// individual is decided, nothing is built).
Estimate weighed(const Context& context, const MushroomOrder& order, const Memo& memo) {
    if (order.model && order.params.textures == Textures::linked)
        throw Impossible(
            "/textures",
            "a model of your own has no address that images could be linked to; ask for embedded "
            "or none");
    const Estimate cost = estimate(order, *context.atlas, memo);
    refuse_over_budget(context.options, cost, order.mix.size() > 1,
                       order.params.animation != Animation::none);
    return cost;
}

/// About what an order comes to, before its individual is known.
Estimate guessed(const MushroomOrder& order) {
    const MushroomParams& params = order.params;
    const auto side = static_cast<std::uint64_t>(params.texture_size.value) >> params.lod;
    Estimate guess;
    guess.vertices = std::uint64_t{12'000} >> (2 * params.lod);
    const std::uint64_t images = params.textures == Textures::none ? 0 : 3 * side * side;
    guess.texels = images * static_cast<std::uint64_t>(atlases_held(order));
    guess.bytes = 60 * guess.vertices + images / 3;
    return guess;
}

/// The GLB.
Body grown(const Context& context, const MushroomOrder& order, const std::string& address,
           Loan& loan) {
    const Atlas& atlas = *context.atlas;
    Extras extras;
    extras.canonical = address;
    if (order.params.textures == Textures::linked) {
        const Memo& memo = loan.workshop().memo;
        const MushroomOrder surface = surface_order(order, atlas, memo);
        const SurfaceAddress image = surface_address(surface);
        for (std::size_t i = 0; i < extras.image_addresses.size(); ++i)
            extras.image_addresses[i] =
                with_version(canonical_address(surface.mix, static_cast<ImageKind>(i), image),
                             version_token(surface.mix, atlas));
    }
    return grow_mushroom(order, atlas, extras, loan.workshop()).glb;
}

/// How it is known that no outline of this mix touches itself.
Certificate certificate(const MushroomOrder& order, const Individual& individual,
                        const Atlas& atlas, const Remember<MorphSet>& morphs) {
    // resolve() checks the outline that is swept by exact predicates and refuses one that touches itself: who got here has passed.
    // Limbs that branch have none.
    if (order.mix.size() < 2 || individual.is_branched()) return {};
    const SpeciesShapes shapes = species_shapes(order, atlas, morphs);
    return order.mix.size() == 2 ? shapes.set->certificate(shapes.weights[0], shapes.weights[1])
                                 : shapes.set->certificate();
}

/// What would be made, as JSON.
Body described(const Context& context, const MushroomOrder& order, const std::string& version,
               Loan& loan) {
    const Atlas& atlas = *context.atlas;
    const Observer& observer = loan.workshop().observer;
    observer(Step::resolve);
    const Memo& memo = loan.workshop().memo;
    const Individual individual = resolve(order, atlas, memo.morphs);
    observer(Step::build);
    const Bounds box = bounds(mushroom_mesh(order, individual));
    observer(Step::pack);
    Value mix = Value::array();
    for (const MixPart& part : order.mix)
        mix.push(Value::object().set("id", part.id).set("weight", part.weight / 1000.0));
    Value body = Value::object();
    // The address of the GLB: what a person copies from here into a game.
    body.set("canonical", canonical_address(order, Product::glb));
    body.set("v", version);
    body.set("mix", std::move(mix));
    body.set("effective", write(individual.effective));
    body.set("estimate", told(estimate(order, individual)));
    body.set("bounds_m", told(box));
    body.set("certificate", write(certificate(order, individual, atlas, memo.morphs)));
    return {slice_of(dump(body))};
}

}  // namespace

Plan plan_mushroom(Context& context, const Request& request, MushroomRequest asked,
                   Faults& faults) {
    if (!faults.empty()) return context.answers.problem(request, faults);
    const Product product = asked.product;
    const auto order = std::make_shared<const MushroomOrder>(std::move(asked.order));
    Resource resource;
    resource.version = version_token(order->mix, *context.atlas);
    resource.address =
        order->model || !order->arcs.empty() ? std::string() : canonical_address(*order, product);
    resource.key = key_of(*order, product, resource.version);
    resource.type = type_of(product);
    resource.file_name = file_name(*order, product);
    resource.asked_version = std::move(asked.version);
    resource.is_linked = product == Product::glb && order->params.textures == Textures::linked;
    resource.weigh = [&context, order, product](const Memo& memo) {
        return cost_of(weighed(context, *order, memo), product);
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
