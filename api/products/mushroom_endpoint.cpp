#include <algorithm>
#include <utility>
#include <variant>

#include "api/products/catalogue.h"
#include "api/products/endpoints.h"
#include "api/products/mix.h"
#include "core/grow/mushroom.h"
#include "core/params/messages.h"
#include "core/params/reader.h"
#include "core/surface/codecs.h"

namespace sporeprint::api {

namespace {

/// What an order will come to. Refuses what of it is well-formed but impossible, as far as it can be told without making it (the
/// individual is decided, nothing is built).
Estimate weighed(const Context& context, const MushroomSpec& spec, const Caches& caches) {
    if (spec.model && spec.params.textures == Textures::linked)
        throw Impossible(
            "/textures",
            "a model of your own has no address that images could be linked to; ask for embedded "
            "or none");
    const Estimate cost = estimate(spec, *context.atlas, caches);
    refuse_over_budget(context.options, cost, spec.mix.size() > 1,
                       spec.params.animation != Animation::none);
    return cost;
}

/// Frames of an order's clip.
std::uint64_t frames_of(const MushroomSpec& spec) {
    return spec.params.animation == Animation::none
               ? 0
               : static_cast<std::uint64_t>(spec.params.frames);
}

/// What making an order costs that comes to `estimated`, beside finding its correspondence.
Cost cost_of(const MushroomSpec& spec, const Estimate& estimated, Product product,
             const Atlas& atlas) {
    const bool branches = spec.model ? std::holds_alternative<Branched>(spec.model->shape)
                                     : is_branched(spec.mix, atlas);
    Cost cost =
        cost_of_individuals(spec.mix, branches, product == Product::glb ? 1 + frames_of(spec) : 1);
    cost.base = 300;
    cost.vertices = estimated.vertices;
    if (product == Product::json) return cost;
    cost.bytes = estimated.bytes;
    if (spec.params.textures != Textures::embedded) return cost;
    cost.atlases = static_cast<std::uint64_t>(atlases_held(spec));
    cost.texels = estimated.texels;
    if (spec.model)
        for (const Upload* upload :
             {&spec.model->surface.cap.image, &spec.model->surface.hymenium.image,
              &spec.model->surface.stem.image})
            cost.pixels += declared_pixels(upload->bytes);
    return cost;
}

/// About what an order comes to, before its individual is known.
Estimate guessed(const MushroomSpec& spec) {
    const MushroomParams& params = spec.params;
    const auto side = static_cast<std::uint64_t>(params.texture_size.value) >> params.lod;
    Estimate guess;
    guess.vertices = std::uint64_t{12'000} >> (2 * params.lod);
    const std::uint64_t images = params.textures == Textures::none ? 0 : 3 * side * side;
    guess.texels = images * static_cast<std::uint64_t>(atlases_held(spec));
    guess.bytes = 60 * guess.vertices + images / 3;
    const std::uint64_t frames = frames_of(spec);
    guess.bytes += guess.vertices * 24 * frames;
    guess.vertices += guess.vertices * frames;
    return guess;
}

/// The GLB.
///
/// depth  of the links to its images
Body grown(const Context& context, const MushroomSpec& spec, const std::string& address, int depth,
           JobContext& job_context) {
    const Atlas& atlas = *context.atlas;
    Extras extras;
    extras.canonical = address;
    if (spec.params.textures == Textures::linked) {
        const Caches& caches = job_context.execution().caches;
        const MushroomSpec surface = surface_spec(spec, atlas, caches);
        const SurfaceAddress image = surface_address(surface);
        for (std::size_t i = 0; i < extras.image_urls.size(); ++i)
            extras.image_urls[i] = reference_from(
                depth,
                with_version(canonical_address(surface.mix, static_cast<ImageKind>(i), image),
                             version_token(surface.mix, atlas)));
    }
    return grow_mushroom(spec, atlas, extras, job_context.execution()).glb;
}

/// How it is known that no outline of this mix touches itself.
Certificate certificate(const MushroomSpec& spec, const Individual& individual, const Atlas& atlas,
                        const GetOrCompute<MorphSet>& morphs) {
    // resolve() checks the outline that is swept by exact predicates and refuses one that touches itself: who got here has passed.
    // Segments that branch have none.
    if (spec.mix.size() < 2 || individual.is_branched()) return {};
    const SpeciesShapes shapes = species_shapes(spec, atlas, morphs);
    return spec.mix.size() == 2 ? shapes.set->certificate(shapes.weights[0], shapes.weights[1])
                                : shapes.set->certificate();
}

/// What would be made, as JSON.
Body described(const Context& context, const MushroomSpec& spec, const std::string& version,
               JobContext& job_context) {
    const Atlas& atlas = *context.atlas;
    const Observer& observer = job_context.execution().observer;
    observer(Step::resolve);
    const Caches& caches = job_context.execution().caches;
    const Individual individual = resolve(spec, atlas, caches.morphs);
    observer(Step::build);
    const Bounds box = bounds(mushroom_mesh(spec, individual));
    observer(Step::pack);
    Value mix = Value::array();
    for (const MixPart& part : spec.mix)
        mix.push(Value::object().set("id", part.id).set("weight", part.weight / 1000.0));
    Value body = Value::object();
    // The address of the GLB: what a person copies from here into a game.
    body.set("canonical", canonical_address(spec, Product::glb));
    body.set("v", version);
    body.set("mix", std::move(mix));
    body.set("effective", write(individual.effective));
    body.set("estimate", description(estimate(spec, individual)));
    body.set("bounds_m", description(box));
    body.set("certificate", write(certificate(spec, individual, atlas, caches.morphs)));
    return {slice_of(dump(body))};
}

}  // namespace

bool is_branched(const Mix& mix, const Atlas& atlas) {
    const AtlasEntry* const first = mix.empty() ? nullptr : atlas.find(mix.front().id);
    return first && family_of(first->species) == Family::branched;
}

Cost cost_of_individuals(const Mix& mix, bool branches, std::uint64_t count) {
    // Bushes are laid over each other, outlines only blended.
    return branches ? Cost{.branch_graphs = std::max<std::uint64_t>(mix.size(), 1) * count}
                    : Cost{.individuals = count};
}

Cost cost_of_search(const Mix& mix, const Atlas& atlas) {
    if (is_branched(mix, atlas)) return {};
    const std::uint64_t species = std::max<std::uint64_t>(mix.size(), 1);
    return {.outlines = species, .pairs = species * (species - 1) / 2};
}

Plan plan_mushroom(Context& context, const Request& request, MushroomRequest requested,
                   ValidationErrors& errors) {
    if (!errors.empty()) return context.responses.problem(request, errors);
    const Product product = requested.product;
    const auto spec = std::make_shared<const MushroomSpec>(std::move(requested.spec));
    Resource resource;
    resource.version = version_token(spec->mix, *context.atlas);
    resource.address =
        spec->model || !spec->arcs.empty() ? std::string() : canonical_address(*spec, product);
    resource.key = key_of(*spec, product, resource.version);
    resource.type = type_of(product);
    resource.file_name = file_name(*spec, product);
    resource.requested_version = std::move(requested.version);
    resource.is_linked = product == Product::glb && spec->params.textures == Textures::linked;
    resource.estimate_cost = [&context, spec, product](const Caches& caches) {
        return cost_of(*spec, weighed(context, *spec, caches), product, *context.atlas);
    };
    resource.search = cost_of_search(spec->mix, *context.atlas);
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
