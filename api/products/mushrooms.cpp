#include "api/products/mushrooms.h"

#include <algorithm>
#include <functional>
#include <memory>
#include <optional>
#include <utility>
#include <variant>

#include "api/http/schemas.h"
#include "api/products/catalogue.h"
#include "api/products/mix.h"
#include "api/products/pictures.h"
#include "api/products/plan_product.h"
#include "api/products/surfaces.h"
#include "api/products/wood.h"
#include "core/grow/collision.h"
#include "core/grow/impostor.h"
#include "core/grow/level_choice.h"
#include "core/grow/levels.h"
#include "core/grow/mushroom.h"
#include "core/grow/names.h"
#include "core/grow/variants.h"
#include "core/grow/wood.h"
#include "core/params/canonical.h"
#include "core/params/messages.h"
#include "core/params/query.h"
#include "core/params/reader.h"
#include "core/params/schema.h"
#include "core/surface/codecs.h"

namespace sporeprint::api {

MushroomRequest read_mushroom(std::string_view mix, Query query, const Atlas& atlas,
                              ValidationErrors& errors) {
    MushroomRequest request;
    request.spec.mix = read_mix(mix, atlas, errors);
    std::vector<std::pair<std::string, std::string>> rest;
    request.version = take_version(query, rest, errors);
    std::vector<Problem> problems;
    apply_profile(requested_profile(rest), request.spec.params);
    read_query(rest, request.spec.params, problems);
    drop_excluded_defaults(request.spec.params, named_options(rest));
    add_problems(problems, request.spec.params, "", false, errors);
    without_negative_zero(request.spec.params);
    request.spec.params.drop_equal_seeds();
    return request;
}

MushroomRequest read_mushroom(std::string_view body, const Atlas& atlas, ValidationErrors& errors) {
    MushroomRequest request;
    std::optional<Value> body_read = read_body(body, errors);
    if (!body_read) return request;
    Value& json = *body_read;
    std::vector<Problem> problems;
    const Value* mix = json.find("mix");
    const Value* model = json.find("model");
    if (mix && model)
        errors.add(400, "mix", "give either mix or model, not both");
    else if (!mix && !model)
        errors.add(400, "mix",
                   "is missing; give {\"mix\":{\"species id\":1}} or a whole {\"model\":{...}}");
    else if (mix)
        request.spec.mix = read_mix_object(*mix, atlas, errors);
    else {
        std::vector<Problem> of_model;
        read(*model, request.spec.model.emplace(), Info{.name = ""}, "/model", of_model);
        // A missing value may be what makes the model impossible: an outline without points.
        if (of_model.empty()) check(*request.spec.model, Info{.name = ""}, "/model", of_model);
        add_problems(of_model, *request.spec.model, "/model", true, errors);
    }
    request.version = take_version(json, problems);
    for (const char* taken : {"mix", "model"}) json.erase(taken);
    apply_profile(requested_profile(json), request.spec.params);
    read(json, request.spec.params, Info{.name = ""}, "", problems);
    drop_excluded_defaults(request.spec.params, named_options(json));
    add_problems(problems, request.spec.params, "", true, errors);
    without_negative_zero(request.spec.params);
    request.spec.params.drop_equal_seeds();
    if (request.spec.model) without_negative_zero(*request.spec.model);
    return request;
}

std::string version_token(const Mix& mix, const Atlas& atlas) {
    std::string templates;
    for (const MixPart& part : mix)
        if (const AtlasEntry* entry = atlas.find(part.id))
            templates += part.id + ' ' + std::to_string(entry->hash) + '\n';
    return token_of(templates);
}

std::string canonical_address(const MushroomSpec& spec, Product product) {
    return with_query("/v1/mushrooms/" + mix_text(spec.mix) + ending_of(product),
                      query_text(spec.params, with_profile(MushroomParams{}, spec.params)));
}

std::string key_of(const MushroomSpec& spec, Product product, std::string_view version) {
    std::string key = std::string("mushroom") + ending_of(product) + ' ';
    (key += version) += '\n';
    if (spec.model)
        canonical(*spec.model, key);
    else
        key += mix_text(spec.mix);
    for (const Arc& arc : spec.arcs) {
        key += ' ';
        canonical(arc, key);
    }
    key += '\n';
    canonical(spec.params, key);
    return key;
}

namespace {

/// Resolves the individual of a request unless that is done.
const Individual& resolved_individual(const Context& context, const MushroomSpec& spec,
                                      const Caches& caches, Mushrooms::Resolved& resolved) {
    if (!resolved) resolved = resolve(spec, *context.atlas, caches.morphs);
    return *resolved;
}

/// Returns the estimate of a request. Throws for well-formed values that are impossible together,
/// as far as that is known once the individual is resolved; no mesh is built.
Estimate weighed(const Context& context, const MushroomSpec& spec, const Caches& caches,
                 Mushrooms::Resolved& resolved) {
    if (spec.model && has_addresses(spec.params.textures))
        throw Impossible(
            "/textures",
            "a model of your own has no address that images could have; ask for embedded "
            "or none");
    const Estimate cost = estimate(spec, resolved_individual(context, spec, caches, resolved));
    refuse_over_budget(context.options, cost, spec.mix.size() > 1,
                       spec.params.animation != Animation::none, spec.params.file);
    return cost;
}

/// Returns the number of frames of the clip of a request.
std::uint64_t frames_of(const MushroomSpec& spec) {
    return spec.params.animation == Animation::none
               ? 0
               : static_cast<std::uint64_t>(spec.params.frames);
}

/// Returns about the number of triangles of a mushroom at an LOD.
double usual_triangles(int lod) { return static_cast<double>(24'000 >> (2 * lod)); }

/// Returns the images of the wood in the file of a request; nothing if there are none.
std::optional<WoodPaint> wood_in_file(const MushroomSpec& spec, const Individual& individual) {
    if (spec.params.lod == impostor_lod) return std::nullopt;
    return wood_paint(spec, individual, first_level(spec, individual));
}

/// Returns the same for a request whose individual is not resolved yet: by the recorded form of its
/// species, or by the model itself.
std::optional<WoodPaint> guessed_wood(const MushroomSpec& spec, const Atlas& atlas) {
    const MushroomParams& params = spec.params;
    if (params.lod == impostor_lod) return std::nullopt;
    bool is_bracket = false;
    if (spec.model) {
        const auto* const swept = std::get_if<Swept>(&spec.model->shape);
        is_bracket = swept && swept->azimuth.lateral > 0.0;
    }
    for (const MixPart& part : spec.mix)
        if (const AtlasEntry* const entry = atlas.find(part.id))
            is_bracket = is_bracket || entry->species.is_lateral();
    const Substrate substrate = params.substrate.value_or(Substrate::beech);
    if (!is_bracket || substrate == Substrate::none) return std::nullopt;
    const int first =
        params.triangles ? nearest_level(*params.triangles, usual_triangles) : params.lod;
    return WoodPaint{substrate, wood_side(params.texture_size, first)};
}

/// The images of the wood in the file of a request, resolved or guessed.
using WoodOf = std::function<std::optional<WoodPaint>(const MushroomSpec&)>;

/// Returns the cost of generating a request with this estimate, without that of its correspondence.
Cost cost_of(const MushroomSpec& spec, const Estimate& estimated, Product product,
             const Atlas& atlas, const WoodOf& wood_of) {
    const bool branches = spec.model ? std::holds_alternative<Branched>(spec.model->shape)
                                     : is_branched(spec.mix, atlas);
    Cost cost =
        cost_of_individuals(spec.mix, branches, product == Product::glb ? 1 + frames_of(spec) : 1);
    cost.base = 220;
    cost.vertices = estimated.vertices;
    if (spec.params.file.collision != CollisionFormat::none) cost.solids = 1;
    if (product == Product::json) return cost;
    cost.bytes = estimated.bytes;
    if (spec.params.textures != Textures::embedded) return cost;
    const auto atlases = static_cast<std::uint64_t>(atlases_held(spec));
    const std::optional<WoodPaint> wood = wood_of(spec);
    const std::uint64_t of_wood = wood ? texels_of(*wood) : 0, texels = estimated.texels - of_wood;
    for (int set = 0; set < image_sets(spec.params.variants); ++set)
        cost += cost_of_images(spec.params.file, {.atlases = atlases, .texels = texels},
                               texels / atlases);
    if (wood) cost += cost_of_images(spec.params.file, cost_of_paint(*wood), of_wood);
    if (spec.model)
        for (const Upload* upload :
             {&spec.model->surface.cap.image, &spec.model->surface.hymenium.image,
              &spec.model->surface.stem.image})
            cost.pixels += declared_pixels(upload->bytes);
    return cost;
}

/// Returns the same with that of an impostor: what it shows is generated too.
///
/// source  estimate of impostor_source()
Cost cost_with_impostor(const MushroomSpec& spec, const Estimate& estimated, const Estimate& source,
                        Product product, const Atlas& atlas, const WoodOf& wood_of) {
    if (!has_impostor(spec.params.lod, spec.params.file))
        return cost_of(spec, estimated, product, atlas, wood_of);
    Cost cost = cost_of(impostor_source(spec), source, product, atlas, wood_of);
    if (spec.params.lod != impostor_lod) cost += cost_of(spec, estimated, product, atlas, wood_of);
    if (spec.params.file.collision != CollisionFormat::none) cost.solids = 1;
    if (product == Product::json) return cost;
    return cost + cost_of_impostor(spec.params.file, estimated, source.triangles);
}

/// Returns an approximate estimate of a request whose individual is not resolved yet.
Estimate guessed(const MushroomSpec& spec, const Atlas& atlas) {
    const MushroomParams& params = spec.params;
    const int first =
        params.triangles ? nearest_level(*params.triangles, usual_triangles) : params.lod;
    const auto side = static_cast<std::uint64_t>(params.texture_size.value) >> first;
    Estimate guess;
    for (const int lod : levels_in_file(first, params.file)) {
        guess.vertices += std::uint64_t{12'000} >> (2 * lod);
        // Where a file has several levels, there is one between this one and the next.
        if (params.file.lods != Lods::single) guess.vertices += std::uint64_t{6'000} >> (2 * lod);
    }
    guess.triangles = 2 * guess.vertices;
    if (has_impostor(params.lod, params.file))
        add_impostor(guess, params.texture_size, params.file);
    const std::uint64_t images = params.textures == Textures::none ? 0 : 3 * side * side;
    guess.texels = images * static_cast<std::uint64_t>(atlases_held(spec));
    if (const auto wood = guessed_wood(spec, atlas); wood && images > 0)
        guess.texels += texels_of(*wood);
    guess.bytes =
        60 * guess.vertices + static_cast<std::uint64_t>(image_sets(params.variants)) * images / 3;
    const std::uint64_t frames = frames_of(spec);
    guess.bytes += guess.vertices * 24 * frames;
    guess.vertices += guess.vertices * frames;
    return guess;
}

/// Returns the certificate that no outline of this mix intersects itself.
Certificate certificate(const MushroomSpec& spec, const Individual& individual, const Atlas& atlas,
                        const GetOrCompute<MorphSet>& morphs) {
    // resolve() checks the outline that is swept by exact predicates and refuses one that
    // intersects itself, so every individual here has passed. Branched individuals have no
    // certificate.
    if (spec.mix.size() < 2 || individual.is_branched()) return {};
    const SpeciesShapes shapes = species_shapes(spec, atlas, morphs);
    return spec.mix.size() == 2 ? shapes.set->certificate(shapes.weights[0], shapes.weights[1])
                                : shapes.set->certificate();
}

}  // namespace

bool is_branched(const Mix& mix, const Atlas& atlas) {
    const AtlasEntry* const first = mix.empty() ? nullptr : atlas.find(mix.front().id);
    return first && family_of(first->species) == Family::branched;
}

Cost cost_of_individuals(const Mix& mix, bool branches, std::uint64_t count) {
    // Branch graphs are merged; outlines are only blended.
    return branches ? Cost{.branch_graphs = std::max<std::uint64_t>(mix.size(), 1) * count}
                    : Cost{.individuals = count};
}

Cost cost_of_search(const Mix& mix, const Atlas& atlas) {
    if (is_branched(mix, atlas)) return {};
    const std::uint64_t species = std::max<std::uint64_t>(mix.size(), 1);
    return {.outlines = species, .pairs = species * (species - 1) / 2};
}

std::string Mushrooms::version(const MushroomSpec& spec, const Atlas& atlas) {
    return version_token(spec.mix, atlas);
}

std::string Mushrooms::url(const MushroomSpec& spec, Product product, const Atlas&) {
    // A custom model and arcs have no URL.
    return spec.model || !spec.arcs.empty() ? std::string() : canonical_address(spec, product);
}

std::string Mushrooms::key(const MushroomSpec& spec, Product product, const std::string& version) {
    return key_of(spec, product, version);
}

std::string Mushrooms::file_name(const MushroomSpec& spec, Product product, const Atlas&) {
    return sporeprint::file_name(product_name(spec), spec.params.lod, spec.params.triangles,
                                 spec.params.file) +
           ending_of(product);
}

Cost Mushrooms::cost(const Context& context, const MushroomSpec& spec, Product product,
                     const Caches& caches, Resolved& resolved) {
    const Estimate estimated = weighed(context, spec, caches, resolved);
    Estimate source;
    if (has_impostor(spec.params.lod, spec.params.file))
        source =
            estimate(impostor_source(spec), resolved_individual(context, spec, caches, resolved));
    const Cost cost = cost_with_impostor(
        spec, estimated, source, product, *context.atlas, [&](const MushroomSpec& file) {
            return wood_in_file(file, resolved_individual(context, spec, caches, resolved));
        });
    if (spec.model) resolved.reset();
    return cost;
}

Cost Mushrooms::search(const MushroomSpec& spec, const Atlas& atlas) {
    return cost_of_search(spec.mix, atlas);
}

Cost Mushrooms::guess(const MushroomSpec& spec, Product product, const Atlas& atlas) {
    return cost_with_impostor(spec, guessed(spec, atlas), guessed(impostor_source(spec), atlas),
                              product, atlas,
                              [&](const MushroomSpec& file) { return guessed_wood(file, atlas); });
}

ImageUrls Mushrooms::image_urls(const Context& context, const MushroomSpec& spec,
                                const std::string&, const ExecutionContext& execution) {
    const MushroomSpec surface = surface_spec(spec, *context.atlas, execution.caches);
    return mushroom_image_urls("mushrooms", surface, surface_address(surface), *context.atlas);
}

std::optional<ImageUrls> Mushrooms::wood_urls(const MushroomSpec& spec,
                                              const Individual& individual) {
    const std::optional<WoodPaint> wood = wood_in_file(spec, individual);
    if (!wood) return std::nullopt;
    return wood_image_urls("mushrooms", *wood);
}

Body Mushrooms::grow(const Context& context, const MushroomSpec& spec, Resolved& resolved,
                     const Extras& extras, int depth, const ExecutionContext& execution) {
    execution.observer(Step::resolve);
    const Individual& individual = resolved_individual(context, spec, execution.caches, resolved);
    Extras with_wood = extras;
    if (has_addresses(spec.params.textures))
        if (const std::optional<ImageUrls> urls = wood_urls(spec, individual))
            with_wood.wood_urls = references_from(depth, *urls);
    return grow_mushroom(spec, individual, *context.atlas, with_wood, execution).glb;
}

Value Mushrooms::describe(const Context& context, const MushroomSpec& spec, Resolved& resolved,
                          const std::string& version, const ExecutionContext& execution) {
    const Atlas& atlas = *context.atlas;
    execution.observer(Step::resolve);
    const Individual& individual = resolved_individual(context, spec, execution.caches, resolved);
    execution.observer(Step::build);
    const Bounds box = mushroom_bounds(spec, individual);
    execution.observer(Step::pack);
    Value body = Value::object();
    // The URL of the GLB, which users copy into their applications.
    body.set("canonical", canonical_address(spec, Product::glb));
    body.set("v", version);
    body.set("mix", mix_value(spec.mix));
    body.set("effective", write(individual.effective));
    body.set("estimate", description(estimate(spec, individual)));
    body.set("bounds_m", description(box));
    body.set("levels", level_list(levels_of(spec, individual, box)));
    if (spec.params.file.collision != CollisionFormat::none)
        body.set("collision", collision_value(body_of(collision_shapes(individual))));
    body.set("certificate", write(certificate(spec, individual, atlas, execution.caches.morphs)));
    return body;
}

namespace {

template <Product Format>
Plan plan_from_url(RouteCall& call) {
    MushroomRequest requested =
        read_mushroom(call.captured[0], call.target.query, *call.context.atlas, call.errors);
    requested.product = Format;
    if constexpr (Format == Product::bin) as_geometry(requested.spec.params, call.errors);
    return plan_product<Mushrooms>(call.context, call.request, std::move(requested), call.errors);
}

Plan plan_picture_from_url(RouteCall& call) {
    const PictureQuery query = read_picture_query(call.target.query, call.errors);
    return plan_picture<Mushrooms>(
        call, query,
        read_mushroom(call.captured[0], query.product, *call.context.atlas, call.errors));
}

template <ImageFormat Format>
Plan plan_image_from_url(RouteCall& call) {
    return plan_mushroom_image(
        call, "mushrooms", Format,
        without_parameters_of_model<SurfaceAddress, MushroomParams>(call.target.query));
}

template <ImageFormat Format>
Plan plan_wood_image_from_url(RouteCall& call) {
    return plan_wood_image(
        call, "mushrooms", Format,
        without_parameters_of_model<WoodAddress, MushroomParams>(call.target.query));
}

Plan plan_from_body(RouteCall& call) {
    refuse_query(call.target, call.errors);
    return plan_product<Mushrooms>(
        call.context, call.request,
        read_mushroom(call.request.body, *call.context.atlas, call.errors), call.errors);
}

constexpr const char *json = "application/json", *glb = "model/gltf-binary";

constexpr Route routes[] = {
    {.kind = RouteKind::document,
     .method = "GET",
     .pattern = "/v1/mushrooms",
     .id = "list_mushrooms",
     .summary = "The species that mushrooms are grown of, with links.",
     .media_type = json,
     .response_schema = "mushroom_list",
     .document =
         [](const DocumentInputs& inputs) { return product_list(inputs.atlas, "mushrooms"); }},
    {.kind = RouteKind::document,
     .method = "GET",
     .pattern = "/v1/mushrooms/schema",
     .id = "mushroom_schema",
     .summary = "JSON Schema of the query parameters of a mushroom.",
     .media_type = "application/schema+json",
     .document =
         [](const DocumentInputs&) {
             return schema_document<MushroomParams>("Parameters of a mushroom");
         }},
    {.kind = RouteKind::product,
     .method = "GET",
     .pattern = "/v1/mushrooms/{mix}.glb",
     .id = "get_mushroom",
     .summary = "Grows a mushroom and answers with a GLB file.",
     .media_type = glb,
     .query_schema = [](const Atlas&) { return schema<MushroomParams>(); },
     .plan = plan_from_url<Product::glb>},
    {.kind = RouteKind::product,
     .method = "GET",
     .pattern = "/v1/mushrooms/{mix}.bin",
     .id = "get_mushroom_geometry",
     .summary = "The geometry of that file alone, as files name it that share it: tiles of worlds.",
     .media_type = "application/octet-stream",
     .query_schema = [](const Atlas&) { return schema<MushroomParams>(); },
     .plan = plan_from_url<Product::bin>},
    {.kind = RouteKind::product,
     .method = "GET",
     .pattern = "/v1/mushrooms/{mix}.json",
     .id = "describe_mushroom",
     .summary = "What would be grown: canonical address, effective parameters, cost and bounds.",
     .media_type = json,
     .response_schema = "mushroom_description",
     .query_schema = [](const Atlas&) { return schema<MushroomParams>(); },
     .plan = plan_from_url<Product::json>},
    {.kind = RouteKind::product,
     .method = "GET",
     .pattern = "/v1/mushrooms/{mix}.png",
     .id = "draw_mushroom",
     .summary = "A picture of a mushroom.",
     .media_type = "image/png",
     .query_schema = [](const Atlas&) { return picture_schema(schema<MushroomParams>()); },
     .plan = plan_picture_from_url},
    {.kind = RouteKind::product,
     .method = "POST",
     .pattern = "/v1/mushrooms.glb",
     .id = "post_mushroom",
     .summary = "Grows a mushroom from a body: a mix, or a whole model of your own.",
     .media_type = glb,
     .body_type = json,
     .most_body = 4u << 20,  // images may be uploaded
     .request_body = "mushroom_order",
     .plan = plan_from_body},
    {.kind = RouteKind::image,
     .method = "GET",
     .pattern = "/v1/mushrooms/{mix}/{image}.jpg",
     .id = "get_mushroom_image",
     .summary = "One image of a mushroom's atlas; what textures=linked points to.",
     .media_type = "image/jpeg",
     .query_schema = [](const Atlas&) { return schema<SurfaceAddress>(); },
     .plan = plan_image_from_url<ImageFormat::jpg>},
    {.kind = RouteKind::image,
     .method = "GET",
     .pattern = "/v1/mushrooms/{mix}/{image}.webp",
     .id = "get_mushroom_image_webp",
     .summary = "The same as WebP; what textures=linked points to with image_format=webp.",
     .media_type = "image/webp",
     .query_schema = [](const Atlas&) { return schema<SurfaceAddress>(); },
     .plan = plan_image_from_url<ImageFormat::webp>},
    {.kind = RouteKind::image,
     .method = "GET",
     .pattern = "/v1/mushrooms/wood/{wood}/{image}.jpg",
     .id = "get_mushroom_wood_image",
     .summary = "One image of the wood that a bracket grows on; what textures=linked points to, "
                "beside those of its atlas.",
     .media_type = "image/jpeg",
     .query_schema = [](const Atlas&) { return schema<WoodAddress>(); },
     .plan = plan_wood_image_from_url<ImageFormat::jpg>},
    {.kind = RouteKind::image,
     .method = "GET",
     .pattern = "/v1/mushrooms/wood/{wood}/{image}.webp",
     .id = "get_mushroom_wood_image_webp",
     .summary = "The same as WebP; what textures=linked points to with image_format=webp.",
     .media_type = "image/webp",
     .query_schema = [](const Atlas&) { return schema<WoodAddress>(); },
     .plan = plan_wood_image_from_url<ImageFormat::webp>},
};

void add_links(Value& links, const Atlas&) {
    links.set("mushrooms", "/v1/mushrooms").set("mushroom_schema", "/v1/mushrooms/schema");
}

void add_schemas(Value& schemas, const Atlas&) {
    const Value text = typed("string");
    schemas.set("mushroom_params", as_written(schema<MushroomParams>()))
        .set("mushroom_list", objects({{"mushrooms", product_list_schema()}}))
        .set("mushroom_description",
             with_collision(objects({{"canonical", text},
                                     {"v", text},
                                     {"mix", mix_list_schema()},
                                     {"effective", reference("schemas/mushroom_params")},
                                     {"estimate", estimate_schema()},
                                     {"bounds_m", bounds_schema()},
                                     {"levels", levels_schema()},
                                     {"certificate", reference("schemas/certificate")}})))
        .set("certificate", as_written(schema<Certificate>()));
}

void add_bodies(Value& bodies, const Atlas& atlas) {
    Value order = with_members({{"mix", mix_schema()},
                                {"model", with_branched_order(schema<Model>())},
                                {"v", version_member()}},
                               schema<MushroomParams>(), "");
    order.set("oneOf", Value(Value::Array{object({{"required", Value(Value::Array{"mix"})}}),
                                          object({{"required", Value(Value::Array{"model"})}})}));
    bodies.set(
        "mushroom_order",
        json_body("A mix of species, or a whole model of your own, and what is to differ.",
                  std::move(order),
                  object({{"mix", object({{example_id(atlas), 1}})}, {"age", 0.6}, {"seed", 7}})));
}

}  // namespace

const RouteGroup mushroom_routes = {.tag = "mushrooms",
                                    .description =
                                        "Mushrooms of one species, of a mix, or of a "
                                        "model of your own.",
                                    .routes = routes,
                                    .add_links = add_links,
                                    .add_schemas = add_schemas,
                                    .add_bodies = add_bodies};

}  // namespace sporeprint::api
