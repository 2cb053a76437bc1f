#include <algorithm>
#include <utility>

#include "api/endpoints.h"
#include "api/mix.h"
#include "core/grow/colony.h"
#include "core/params/messages.h"
#include "core/params/reader.h"

namespace sporeprint::api {

namespace {

/// Vertices of the mesh that tells what room an individual needs, about: its cap at lod=1.
constexpr std::uint64_t room_vertices = 3000;

/// What making an order costs that comes to `estimated`, beside finding its correspondence.
Cost cost_of(const ColonyOrder& order, const Estimate& estimated, Product product,
             const Atlas& atlas) {
    const auto distinct = static_cast<std::uint64_t>(order.params.distinct);
    Cost cost = cost_of_individuals(order.mix, is_branched(order.mix, atlas), 1 + distinct);
    cost.base = 300;
    cost.vertices = distinct * room_vertices;
    cost.placed_vertices = estimated.vertices;
    cost.members = static_cast<std::uint64_t>(order.params.count);
    if (product == Product::json) return cost;
    cost.bytes = estimated.bytes;
    if (order.params.textures != Textures::embedded) return cost;
    cost.atlases = static_cast<std::uint64_t>(atlases_held(paint_order(order)));
    cost.texels = estimated.texels;
    return cost;
}

bool shows_roots(const ColonyOrder& order, const Atlas& atlas) {
    try {
        return colony_nature(order, atlas).roots == RootsShown::shown;
    } catch (const InvalidInput&) {
        return false;  // what is wrong is told when the order is weighed
    }
}

/// About what an order comes to, before its individuals are known. Of roots nothing can be told.
Estimate guessed(const ColonyOrder& order) {
    const ColonyParams& params = order.params;
    const auto side = static_cast<std::uint64_t>(params.texture_size.value) >> params.lod;
    Estimate guess;
    // Caps are those of the next level; a stem has about six nodes of nine quads, each parted in
    // sixteen near by.
    guess.vertices = (static_cast<std::uint64_t>(params.distinct) * 1000 +
                      static_cast<std::uint64_t>(params.count) * 400) >>
                     (2 * std::min(params.lod, 2));
    const std::uint64_t images = params.textures == Textures::none ? 0 : 3 * side * side;
    guess.texels = images * static_cast<std::uint64_t>(atlases_held(paint_order(order)));
    guess.bytes = 60 * guess.vertices + images / 3;
    return guess;
}

/// The GLB.
///
/// depth  of the links to its images
Body grown(const Context& context, const ColonyOrder& order, const std::string& address, int depth,
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
            extras.image_addresses[i] = reference_from(
                depth,
                with_version(canonical_address(surface.mix, static_cast<ImageKind>(i), image),
                             version_token(surface.mix, atlas)));
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
        const Estimate estimated = estimate(*order, *context.atlas, memo);
        refuse_over_budget(context.options, estimated, order->mix.size() > 1);
        return cost_of(*order, estimated, product, *context.atlas);
    };
    resource.search = cost_of_search(order->mix, *context.atlas);
    if (!shows_roots(*order, *context.atlas))
        resource.guess = cost_of(*order, guessed(*order), product, *context.atlas);
    resource.make = [&context, order, product, address = resource.address,
                     depth = link_depth(context, request), version = resource.version](Loan& loan) {
        return product == Product::glb ? grown(context, *order, address, depth, loan)
                                       : described(context, *order, version, loan);
    };
    return plan_resource(context, request, std::move(resource), faults);
}

}  // namespace sporeprint::api
