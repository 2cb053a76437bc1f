#include <utility>

#include "api/endpoints.h"
#include "api/mix.h"
#include "core/grow/mushroom.h"
#include "core/params/messages.h"
#include "core/params/reader.h"

namespace sporeprint::api {

namespace {

/// What an order will come to; adds to `faults` what of it is well-formed but impossible, as far as it can be told without
/// making it (the individual is decided, nothing is built).
Estimate weighed(const Context& context, const MushroomOrder& order, bool posted, Faults& faults) {
    const ServiceOptions& options = context.options;
    const auto where = [&](const char* parameter) {
        return posted ? '/' + std::string(parameter) : std::string(parameter);
    };
    if (order.mix.size() > 1)
        faults.add(422, "mix",
                   "species cannot be mixed yet; ask for one of " + mix_text(order.mix) + " alone");
    if (order.model && order.params.textures == Textures::linked)
        faults.add(422, where("textures"),
                   "a model of your own has no address that images could be linked to; ask for "
                   "embedded or none");
    if (!faults.empty()) return {};
    Estimate cost;
    try {
        cost = estimate(order, *context.atlas);
    } catch (const Impossible& impossible) {
        faults.add(422, named(impossible, posted));
    } catch (const InvalidInput& invalid) {
        faults.add(400, named(invalid, posted));
    }
    if (cost.vertices > options.most_vertices)
        faults.add(422, where("lod"),
                   std::to_string(cost.vertices) + " vertices would be made; at most " +
                       std::to_string(options.most_vertices) + " are. Raise lod");
    if (cost.texels > options.most_texels)
        faults.add(422, where("texture_size"),
                   std::to_string(cost.texels) + " texels would be painted; at most " +
                       std::to_string(options.most_texels) +
                       " are. Lower texture_size or raise lod");
    return cost;
}

/// The GLB.
Body grown(const Context& context, const MushroomOrder& order, const std::string& address,
           Loan& loan) {
    const Atlas& atlas = *context.atlas;
    Extras extras;
    extras.canonical = address;
    if (order.params.textures == Textures::linked) {
        const MushroomOrder surface = surface_order(order, atlas);
        const SurfaceAddress image =
            surface_address(surface, surface_metrics(resolve(order, atlas)));
        for (std::size_t i = 0; i < extras.image_addresses.size(); ++i)
            extras.image_addresses[i] =
                with_version(canonical_address(surface.mix, static_cast<ImageKind>(i), image),
                             version_token(surface.mix, atlas));
    }
    return grow_mushroom(order, atlas, extras, loan.workshop()).glb;
}

Value vector_value(const glm::vec3& vector) {
    return Value(Value::Array{write(vector.x), write(vector.y), write(vector.z)});
}

/// What would be made, as JSON.
Body described(const Context& context, const MushroomOrder& order, const std::string& version,
               Loan& loan) {
    const Atlas& atlas = *context.atlas;
    const Observer& observer = loan.workshop().observer;
    observer(Step::resolve);
    const Individual individual = resolve(order, atlas);
    observer(Step::build);
    const Bounds box = bounds(mushroom_mesh(order, individual));
    observer(Step::pack);
    const Estimate cost = estimate(order, atlas);
    Value mix = Value::array();
    for (const MixPart& part : order.mix)
        mix.push(Value::object().set("id", part.id).set("weight", part.weight / 1000.0));
    Value body = Value::object();
    // The address of the GLB: what a person copies from here into a game.
    body.set("canonical", canonical_address(order, Product::glb));
    body.set("v", version);
    body.set("mix", std::move(mix));
    body.set("effective", write(individual.effective));
    body.set("estimate", Value::object()
                             .set("vertices", cost.vertices)
                             .set("triangles", cost.triangles)
                             .set("bytes", cost.bytes));
    body.set("bounds_m",
             Value::object().set("min", vector_value(box.min)).set("max", vector_value(box.max)));
    // resolve() refuses crossing outlines by exact predicates on the sampled polyline; who got here has passed.
    body.set("certificate", Value::object().set("simple", true).set("method", "exact"));
    return {slice_of(dump(body))};
}

}  // namespace

Plan plan_mushroom(Context& context, const Request& request, MushroomRequest asked,
                   Faults& faults) {
    if (!faults.empty()) return context.answers.problem(request, faults);
    const bool posted = request.method == "POST";
    const Product product = asked.product;
    const auto order = std::make_shared<const MushroomOrder>(std::move(asked.order));
    Resource resource;
    resource.version = version_token(order->mix, *context.atlas);
    resource.address = order->model ? std::string() : canonical_address(*order, product);
    resource.key = key_of(*order, product, resource.version);
    resource.type = product == Product::glb ? "model/gltf-binary" : "application/json";
    resource.file_name = file_name(*order, product);
    resource.asked_version = std::move(asked.version);
    resource.weigh = [&context, order, product, posted](Faults& found) {
        const Estimate estimated = weighed(context, *order, posted, found);
        return product == Product::glb ? Cost{estimated.vertices, estimated.texels, estimated.bytes}
                                       : Cost{estimated.vertices, 0, estimated.vertices * 32};
    };
    resource.make = [&context, order, product, address = resource.address,
                     version = resource.version](Loan& loan) {
        return product == Product::glb ? grown(context, *order, address, loan)
                                       : described(context, *order, version, loan);
    };
    return plan_resource(context, request, std::move(resource), faults);
}

}  // namespace sporeprint::api
