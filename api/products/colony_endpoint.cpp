#include <algorithm>
#include <utility>

#include "api/products/endpoints.h"
#include "api/products/mix.h"
#include "core/grow/colony.h"
#include "core/params/messages.h"
#include "core/params/reader.h"

namespace sporeprint::api {

namespace {

/// Vertices of the mesh that tells what room an individual needs, about: its cap at lod=1.
constexpr std::uint64_t room_vertices = 3000;

/// What making an order costs that comes to `estimated`, beside finding its correspondence.
Cost cost_of(const ColonySpec& spec, const Estimate& estimated, Product product,
             const Atlas& atlas) {
    const auto distinct = static_cast<std::uint64_t>(spec.params.distinct);
    Cost cost = cost_of_individuals(spec.mix, is_branched(spec.mix, atlas), 1 + distinct);
    cost.base = 300;
    cost.vertices = distinct * room_vertices;
    cost.placed_vertices = estimated.vertices;
    cost.members = static_cast<std::uint64_t>(spec.params.count);
    if (product == Product::json) return cost;
    cost.bytes = estimated.bytes;
    if (spec.params.textures != Textures::embedded) return cost;
    cost.atlases = static_cast<std::uint64_t>(atlases_held(paint_mushroom_spec(spec)));
    cost.texels = estimated.texels;
    return cost;
}

bool shows_roots(const ColonySpec& spec, const Atlas& atlas) {
    try {
        return colony_traits(spec, atlas).roots == RootsShown::shown;
    } catch (const InvalidInput&) {
        return false;  // what is wrong is told when the order is weighed
    }
}

/// About what an order comes to, before its individuals are known. Of roots nothing can be told.
Estimate guessed(const ColonySpec& spec) {
    const ColonyParams& params = spec.params;
    const auto side = static_cast<std::uint64_t>(params.texture_size.value) >> params.lod;
    Estimate guess;
    // Caps are those of the next level; a stem has about six nodes of nine quads, each parted in
    // sixteen near by.
    guess.vertices = (static_cast<std::uint64_t>(params.distinct) * 1000 +
                      static_cast<std::uint64_t>(params.count) * 400) >>
                     (2 * std::min(params.lod, 2));
    const std::uint64_t images = params.textures == Textures::none ? 0 : 3 * side * side;
    guess.texels = images * static_cast<std::uint64_t>(atlases_held(paint_mushroom_spec(spec)));
    guess.bytes = 60 * guess.vertices + images / 3;
    return guess;
}

/// The GLB.
///
/// depth  of the links to its images
Body grown(const Context& context, const ColonySpec& spec, const std::string& address, int depth,
           JobContext& job_context) {
    const Atlas& atlas = *context.atlas;
    Extras extras;
    extras.canonical = address;
    if (spec.params.textures == Textures::linked) {
        // Its images are those of a mushroom, larger than that one's level of detail would have them.
        const MushroomSpec surface =
            surface_spec(paint_mushroom_spec(spec), atlas, job_context.execution().caches);
        SurfaceAddress image = surface_address(surface);
        image.texture_size = {spec.params.texture_size >> spec.params.lod};
        for (std::size_t i = 0; i < extras.image_urls.size(); ++i)
            extras.image_urls[i] = reference_from(
                depth,
                with_version(canonical_address(surface.mix, static_cast<ImageKind>(i), image),
                             version_token(surface.mix, atlas)));
    }
    return grow_colony(spec, atlas, extras, job_context.execution()).glb;
}

/// What would be made, as JSON.
Body described(const Context& context, const ColonySpec& spec, const std::string& version,
               JobContext& job_context) {
    const Colony colony = colony_parts(spec, *context.atlas, job_context.execution());
    job_context.execution().observer(Step::pack);
    Value mix = Value::array();
    for (const MixPart& part : spec.mix)
        mix.push(Value::object().set("id", part.id).set("weight", part.weight / 1000.0));
    Value body = Value::object();
    body.set("canonical", canonical_address(spec, Product::glb));
    body.set("v", version);
    body.set("mix", std::move(mix));
    body.set("made", std::uint64_t{colony.members.size()});
    body.set("effective", write(colony.effective));
    body.set("estimate", description(measured(spec, colony)));
    body.set("bounds_m", description(bounds(colony)));
    return {slice_of(dump(body))};
}

}  // namespace

Plan plan_colony(Context& context, const Request& request, ColonyRequest requested,
                 ValidationErrors& errors) {
    if (!errors.empty()) return context.responses.problem(request, errors);
    const Product product = requested.product;
    const auto spec = std::make_shared<const ColonySpec>(std::move(requested.spec));
    Resource resource;
    resource.version = version_token(spec->mix, *context.atlas);
    resource.address = canonical_address(*spec, product);
    resource.key = key_of(*spec, product, resource.version);
    resource.type = type_of(product);
    resource.file_name = file_name(*spec, product);
    resource.requested_version = std::move(requested.version);
    resource.is_linked = product == Product::glb && spec->params.textures == Textures::linked;
    resource.estimate_cost = [&context, spec, product](const Caches& caches) {
        const Estimate estimated = estimate(*spec, *context.atlas, caches);
        refuse_over_budget(context.options, estimated, spec->mix.size() > 1);
        return cost_of(*spec, estimated, product, *context.atlas);
    };
    resource.search = cost_of_search(spec->mix, *context.atlas);
    if (!shows_roots(*spec, *context.atlas))
        resource.guess = cost_of(*spec, guessed(*spec), product, *context.atlas);
    resource.make = [&context, spec, product, address = resource.address,
                     depth = link_depth(context, request),
                     version = resource.version](JobContext& job_context) {
        return product == Product::glb ? grown(context, *spec, address, depth, job_context)
                                       : described(context, *spec, version, job_context);
    };
    return plan_resource(context, request, std::move(resource), errors);
}

}  // namespace sporeprint::api
