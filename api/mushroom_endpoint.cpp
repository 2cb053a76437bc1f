#include <algorithm>
#include <utility>
#include <variant>

#include "api/catalogue.h"
#include "api/endpoints.h"
#include "api/mix.h"
#include "core/grow/mushroom.h"
#include "core/params/messages.h"
#include "core/params/reader.h"
#include "core/surface/codecs.h"

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

/// Frames of an order's clip.
std::uint64_t frames_of(const MushroomOrder& order) {
    return order.params.animation == Animation::none
               ? 0
               : static_cast<std::uint64_t>(order.params.frames);
}

/// What making an order costs that comes to `estimated`, beside finding its correspondence.
Cost cost_of(const MushroomOrder& order, const Estimate& estimated, Product product,
             const Atlas& atlas) {
    const bool branches = order.model ? std::holds_alternative<Branched>(order.model->shape)
                                      : is_branched(order.mix, atlas);
    Cost cost = cost_of_individuals(order.mix, branches,
                                    product == Product::glb ? 1 + frames_of(order) : 1);
    cost.base = 300;
    cost.vertices = estimated.vertices;
    if (product == Product::json) return cost;
    cost.bytes = estimated.bytes;
    if (order.params.textures != Textures::embedded) return cost;
    cost.atlases = static_cast<std::uint64_t>(atlases_held(order));
    cost.texels = estimated.texels;
    if (order.model)
        for (const Upload* upload :
             {&order.model->surface.cap.image, &order.model->surface.hymenium.image,
              &order.model->surface.stem.image})
            cost.pixels += declared_pixels(upload->bytes);
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
    const std::uint64_t frames = frames_of(order);
    guess.bytes += guess.vertices * 24 * frames;
    guess.vertices += guess.vertices * frames;
    return guess;
}

/// The GLB.
///
/// depth  of the links to its images
Body grown(const Context& context, const MushroomOrder& order, const std::string& address,
           int depth, Loan& loan) {
    const Atlas& atlas = *context.atlas;
    Extras extras;
    extras.canonical = address;
    if (order.params.textures == Textures::linked) {
        const Memo& memo = loan.workshop().memo;
        const MushroomOrder surface = surface_order(order, atlas, memo);
        const SurfaceAddress image = surface_address(surface);
        for (std::size_t i = 0; i < extras.image_addresses.size(); ++i)
            extras.image_addresses[i] = reference_from(
                depth,
                with_version(canonical_address(surface.mix, static_cast<ImageKind>(i), image),
                             version_token(surface.mix, atlas)));
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

bool is_branched(const Mix& mix, const Atlas& atlas) {
    const AtlasEntry* const first = mix.empty() ? nullptr : atlas.find(mix.front().id);
    return first && family_of(first->species) == Family::branched;
}

Cost cost_of_individuals(const Mix& mix, bool branches, std::uint64_t count) {
    // Bushes are laid over each other, outlines only blended.
    return branches ? Cost{.bushes = std::max<std::uint64_t>(mix.size(), 1) * count}
                    : Cost{.individuals = count};
}

Cost cost_of_search(const Mix& mix, const Atlas& atlas) {
    if (is_branched(mix, atlas)) return {};
    const std::uint64_t species = std::max<std::uint64_t>(mix.size(), 1);
    return {.outlines = species, .pairs = species * (species - 1) / 2};
}

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
        return cost_of(*order, weighed(context, *order, memo), product, *context.atlas);
    };
    resource.search = cost_of_search(order->mix, *context.atlas);
    resource.guess = cost_of(*order, guessed(*order), product, *context.atlas);
    resource.make = [&context, order, product, address = resource.address,
                     depth = link_depth(context, request), version = resource.version](Loan& loan) {
        return product == Product::glb ? grown(context, *order, address, depth, loan)
                                       : described(context, *order, version, loan);
    };
    return plan_resource(context, request, std::move(resource), faults);
}

}  // namespace sporeprint::api
