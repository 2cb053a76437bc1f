#include "api/products/colonies.h"

#include <algorithm>
#include <utility>

#include "api/http/schemas.h"
#include "api/products/catalogue.h"
#include "api/products/mix.h"
#include "api/products/mushrooms.h"
#include "api/products/pictures.h"
#include "api/products/plan_product.h"
#include "api/products/surfaces.h"
#include "api/products/wood.h"
#include "core/grow/colony.h"
#include "core/grow/colony_estimate.h"
#include "core/grow/colony_individuals.h"
#include "core/grow/impostor.h"
#include "core/grow/names.h"
#include "core/grow/variants.h"
#include "core/grow/wood.h"
#include "core/params/canonical.h"
#include "core/params/query.h"
#include "core/params/reader.h"
#include "core/params/schema.h"

namespace sporeprint::api {

ColonyRequest read_colony(std::string_view mix, Query query, const Atlas& atlas,
                          ValidationErrors& errors) {
    ColonyRequest request;
    request.spec.mix = read_mix(mix, atlas, errors);
    std::vector<std::pair<std::string, std::string>> rest;
    request.version = take_version(query, rest, errors);
    std::vector<Problem> problems;
    apply_profile(requested_profile(rest), request.spec.params);
    read_query(rest, request.spec.params, problems);
    drop_excluded_defaults(request.spec.params, named_options(rest));
    add_problems(problems, request.spec.params, "", false, errors);
    without_negative_zero(request.spec.params);
    return request;
}

ColonyRequest read_colony(std::string_view body, const Atlas& atlas, ValidationErrors& errors) {
    ColonyRequest request;
    std::optional<Value> body_read = read_body(body, errors);
    if (!body_read) return request;
    Value& json = *body_read;
    std::vector<Problem> problems;
    if (const Value* mix = json.find("mix"))
        request.spec.mix = read_mix_object(*mix, atlas, errors);
    else
        errors.add(400, "mix", "is missing; give {\"mix\":{\"species id\":1}}");
    request.version = take_version(json, problems);
    json.erase("mix");
    apply_profile(requested_profile(json), request.spec.params);
    read(json, request.spec.params, Info{.name = ""}, "", problems);
    drop_excluded_defaults(request.spec.params, named_options(json));
    add_problems(problems, request.spec.params, "", true, errors);
    without_negative_zero(request.spec.params);
    return request;
}

std::string canonical_address(const ColonySpec& spec, Product product) {
    return with_query("/v1/colonies/" + mix_text(spec.mix) + ending_of(product),
                      query_text(spec.params, with_profile(ColonyParams{}, spec.params)));
}

std::string key_of(const ColonySpec& spec, Product product, std::string_view version) {
    std::string key = std::string("colony") + ending_of(product) + ' ';
    ((key += version) += '\n') += mix_text(spec.mix);
    key += '\n';
    canonical(spec.params, key);
    return key;
}

namespace {

/// Approximate vertices of the mesh that measures the space of an individual: its cap at lod=1.
constexpr std::uint64_t spacing_vertices = 3000;

/// Returns the images of the wood that a colony stands on; nothing if it stands on none.
///
/// spec  at_level() of a request
std::optional<WoodPaint> wood_paint_of(const ColonySpec& spec, const Atlas& atlas) {
    try {
        const Substrate substrate = colony_traits(spec, atlas).substrate;
        if (substrate == Substrate::none || spec.params.lod == impostor_lod) return std::nullopt;
        return WoodPaint{substrate, wood_side(spec.params.texture_size, spec.params.lod)};
    } catch (const InvalidInput&) {
        return std::nullopt;  // the estimate reports the problem
    }
}

/// Returns the habit of a colony; that of a troop if the request is invalid, which the estimate
/// reports.
Habit habit_of(const ColonySpec& spec, const Atlas& atlas) {
    try {
        return colony_traits(spec, atlas).habit;
    } catch (const InvalidInput&) {
        return Habit::troop;
    }
}

/// Returns the cost of generating a request with this estimate, without that of its correspondence.
Cost cost_of(const ColonySpec& spec, const Estimate& estimated, Product product,
             const Atlas& atlas) {
    const auto distinct = static_cast<std::uint64_t>(spec.params.distinct);
    Cost cost = cost_of_individuals(spec.mix, is_branched(spec.mix, atlas), 1 + distinct);
    cost.base = 300;
    cost.vertices = distinct * spacing_vertices;
    cost.placed_vertices = estimated.vertices;
    cost.members = static_cast<std::uint64_t>(spec.params.count);
    if (habit_of(spec, atlas) == Habit::tuft) cost.member_pairs = cost.members * cost.members;
    if (spec.params.file.collision != CollisionFormat::none) cost.solids = distinct;
    if (product == Product::json) return cost;
    cost.bytes = estimated.bytes;
    if (spec.params.textures != Textures::embedded || estimated.texels == 0) return cost;
    const auto atlases = static_cast<std::uint64_t>(atlases_held(paint_mushroom_spec(spec)));
    const std::optional<WoodPaint> wood = wood_paint_of(spec, atlas);
    const std::uint64_t of_wood = wood ? texels_of(*wood) : 0;
    const std::uint64_t texels = (estimated.texels - of_wood) / atlases;
    for (int set = 0; set < image_sets(spec.params.variants); ++set)
        cost += cost_of_images(spec.params.file, {.atlases = atlases, .texels = atlases * texels},
                               texels);
    if (wood) cost += cost_of_images(spec.params.file, cost_of_paint(*wood), of_wood);
    return cost;
}

/// Returns the same with that of an impostor: what it shows is generated too.
///
/// source  estimate of impostor_source()
Cost cost_with_impostor(const ColonySpec& spec, const Estimate& estimated, const Estimate& source,
                        Product product, const Atlas& atlas) {
    if (!has_impostor(spec.params.lod, spec.params.file))
        return cost_of(spec, estimated, product, atlas);
    Cost cost = cost_of(spec, estimated, product, atlas);
    // The places of an impostor alone, and its box, are those of what it shows.
    if (spec.params.lod == impostor_lod) cost.placed_vertices += source.vertices;
    if (product == Product::json) return cost;
    return cost + cost_of(impostor_source(spec), source, product, atlas) +
           cost_of_impostor(spec.params.file, estimated,
                            source.triangles * Colonies::instances_of_each(spec));
}

bool shows_roots(const ColonySpec& spec, const Atlas& atlas) {
    try {
        return colony_traits(spec, atlas).roots == RootsShown::shown;
    } catch (const InvalidInput&) {
        return false;  // the estimate reports the problem
    }
}

/// Resolves the typical individual of a request unless that is done.
const Individual& resolved_individual(const Context& context, const ColonySpec& spec,
                                      const Caches& caches, Colonies::Resolved& resolved) {
    if (!resolved) resolved = typical_individual(spec, *context.atlas, caches);
    return *resolved;
}

/// Returns an approximate estimate of a request whose individuals are not resolved yet, without
/// roots, which cannot be estimated.
Estimate guessed(const ColonySpec& spec, const Atlas& atlas) {
    const ColonyParams& params = spec.params;
    const auto side = static_cast<std::uint64_t>(params.texture_size.value) >> params.lod;
    Estimate guess;
    // Caps are those of the next level of detail; a stem has about six nodes of nine quads, each
    // subdivided into sixteen near the viewer.
    for (const int lod : levels_in_file(params.lod, params.file))
        guess.vertices += (static_cast<std::uint64_t>(params.distinct) * 1000 +
                           static_cast<std::uint64_t>(params.count) * 400) >>
                          (2 * std::min(lod, 2));
    const std::uint64_t images = params.textures == Textures::none ? 0 : 3 * side * side;
    guess.texels = images * static_cast<std::uint64_t>(atlases_held(paint_mushroom_spec(spec)));
    if (const auto wood = wood_paint_of(spec, atlas); wood && images > 0)
        guess.texels += texels_of(*wood);
    guess.bytes =
        60 * guess.vertices + static_cast<std::uint64_t>(image_sets(params.variants)) * images / 3;
    guess.triangles = 2 * guess.vertices;
    if (has_impostor(params.lod, params.file))
        add_impostor(guess, params.texture_size, params.file);
    return guess;
}

}  // namespace

std::string Colonies::version(const ColonySpec& spec, const Atlas& atlas) {
    return version_token(spec.mix, atlas);
}

std::string Colonies::url(const ColonySpec& spec, Product product, const Atlas&) {
    return canonical_address(spec, product);
}

std::string Colonies::key(const ColonySpec& spec, Product product, const std::string& version) {
    return key_of(spec, product, version);
}

std::string Colonies::file_name(const ColonySpec& spec, Product product, const Atlas&) {
    return sporeprint::file_name(product_name(spec), spec.params.lod, spec.params.triangles,
                                 spec.params.file) +
           ending_of(product);
}

Cost Colonies::cost(const Context& context, const ColonySpec& requested, Product product,
                    const Caches& caches, Resolved& resolved) {
    const Individual& typical = resolved_individual(context, requested, caches, resolved);
    const ColonySpec spec = at_level(requested, typical, *context.atlas);
    const Estimate estimated = estimate(spec, typical, *context.atlas);
    refuse_over_budget(context.options, estimated, spec.mix.size() > 1, false, spec.params.file);
    Estimate source;
    if (has_impostor(spec.params.lod, spec.params.file)) {
        const ColonySpec shown = impostor_source(spec);
        source = estimate(shown, typical, *context.atlas);
        refuse_over_budget(context.options, source, spec.mix.size() > 1, false, shown.params.file);
    }
    return cost_with_impostor(spec, estimated, source, product, *context.atlas);
}

Cost Colonies::search(const ColonySpec& spec, const Atlas& atlas) {
    return cost_of_search(spec.mix, atlas);
}

std::optional<Cost> Colonies::guess(const ColonySpec& spec, Product product, const Atlas& atlas) {
    if (shows_roots(spec, atlas)) return std::nullopt;
    return cost_with_impostor(spec, guessed(spec, atlas), guessed(impostor_source(spec), atlas),
                              product, atlas);
}

std::uint64_t Colonies::instances_of_each(const ColonySpec& spec) {
    const int count = spec.params.count, distinct = std::min(spec.params.distinct, count);
    return static_cast<std::uint64_t>((count + distinct - 1) / distinct);
}

ImageUrls Colonies::image_urls(const Context& context, const ColonySpec& spec,
                               const std::string& version, const ExecutionContext& execution) {
    if (spec.params.triangles) {
        const Individual typical = typical_individual(spec, *context.atlas, execution.caches);
        return image_urls(context, at_level(spec, typical, *context.atlas), version, execution);
    }
    return variant_urls(context, spec, paint_mushroom_spec(spec), execution);
}

ImageUrls Colonies::variant_urls(const Context& context, const ColonySpec& spec,
                                 const MushroomSpec& painted, const ExecutionContext& execution) {
    // Its images are those of a mushroom, of higher resolution than its level of detail alone would
    // have.
    const MushroomSpec surface = surface_spec(painted, *context.atlas, execution.caches);
    SurfaceAddress image = surface_address(surface);
    image.texture_size = {spec.params.texture_size >> spec.params.lod};
    return mushroom_image_urls("colonies", surface, image, *context.atlas);
}

Body Colonies::grow(const Context& context, const ColonySpec& spec, Resolved& resolved,
                    const Extras& extras, int depth, const ExecutionContext& execution) {
    execution.observer(Step::resolve);
    const Individual& typical = resolved_individual(context, spec, execution.caches, resolved);
    Extras with_wood = extras;
    if (has_addresses(spec.params.textures))
        if (const auto wood =
                wood_paint_of(at_level(spec, typical, *context.atlas), *context.atlas))
            with_wood.wood_urls = references_from(depth, wood_image_urls("colonies", *wood));
    return grow_colony(spec, typical, *context.atlas, with_wood, execution).glb;
}

Value Colonies::describe(const Context& context, const ColonySpec& requested, Resolved& resolved,
                         const std::string& version, const ExecutionContext& execution) {
    execution.observer(Step::resolve);
    const Individual& typical = resolved_individual(context, requested, execution.caches, resolved);
    const ColonySpec spec = at_level(requested, typical, *context.atlas);
    const Colony colony = colony_parts(spec, typical, *context.atlas, execution);
    execution.observer(Step::pack);
    Value body = Value::object();
    body.set("canonical", canonical_address(requested, Product::glb));
    body.set("v", version);
    body.set("mix", mix_value(spec.mix));
    body.set("made", std::uint64_t{colony.members.size()});
    body.set("effective", write(colony.effective));
    body.set("estimate", description(measured(spec, colony)));
    const Bounds box = bounds(colony);
    body.set("bounds_m", description(box));
    body.set("levels", level_list(levels_of(spec, typical, *context.atlas, box)));
    if (spec.params.file.collision != CollisionFormat::none)
        body.set("collision", collision_value(colony.collision));
    return body;
}

namespace {

template <Product Format>
Plan plan_from_url(RouteCall& call) {
    ColonyRequest requested =
        read_colony(call.captured[0], call.target.query, *call.context.atlas, call.errors);
    requested.product = Format;
    return plan_product<Colonies>(call.context, call.request, std::move(requested), call.errors);
}

Plan plan_picture_from_url(RouteCall& call) {
    const PictureQuery query = read_picture_query(call.target.query, call.errors);
    return plan_picture<Colonies>(
        call, query,
        read_colony(call.captured[0], query.product, *call.context.atlas, call.errors));
}

template <ImageFormat Format>
Plan plan_image_from_url(RouteCall& call) {
    return plan_mushroom_image(
        call, "colonies", Format,
        without_parameters_of_model<SurfaceAddress, ColonyParams>(call.target.query));
}

template <ImageFormat Format>
Plan plan_wood_image_from_url(RouteCall& call) {
    return plan_wood_image(
        call, "colonies", Format,
        without_parameters_of_model<WoodAddress, ColonyParams>(call.target.query));
}

Plan plan_from_body(RouteCall& call) {
    refuse_query(call.target, call.errors);
    return plan_product<Colonies>(call.context, call.request,
                                  read_colony(call.request.body, *call.context.atlas, call.errors),
                                  call.errors);
}

constexpr const char *json = "application/json", *glb = "model/gltf-binary";

constexpr Route routes[] = {
    {.kind = RouteKind::document,
     .method = "GET",
     .pattern = "/v1/colonies",
     .id = "list_colonies",
     .summary = "The species that colonies are grown of, with links.",
     .media_type = json,
     .response_schema = "colony_list",
     .document =
         [](const DocumentInputs& inputs) { return product_list(inputs.atlas, "colonies"); }},
    {.kind = RouteKind::document,
     .method = "GET",
     .pattern = "/v1/colonies/schema",
     .id = "colony_schema",
     .summary = "JSON Schema of the query parameters of a colony.",
     .media_type = "application/schema+json",
     .document =
         [](const DocumentInputs&) {
             return schema_document<ColonyParams>("Parameters of a colony");
         }},
    {.kind = RouteKind::product,
     .method = "GET",
     .pattern = "/v1/colonies/{mix}.glb",
     .id = "get_colony",
     .summary = "Grows a colony: roots, stems and caps, each cap stored once.",
     .media_type = glb,
     .query_schema = [](const Atlas&) { return schema<ColonyParams>(); },
     .plan = plan_from_url<Product::glb>},
    {.kind = RouteKind::product,
     .method = "GET",
     .pattern = "/v1/colonies/{mix}.json",
     .id = "describe_colony",
     .summary = "What would be grown: canonical address, how many found room, effective "
                "parameters, cost and bounds.",
     .media_type = json,
     .response_schema = "colony_description",
     .query_schema = [](const Atlas&) { return schema<ColonyParams>(); },
     .plan = plan_from_url<Product::json>},
    {.kind = RouteKind::product,
     .method = "GET",
     .pattern = "/v1/colonies/{mix}.png",
     .id = "draw_colony",
     .summary = "A picture of a colony.",
     .media_type = "image/png",
     .query_schema = [](const Atlas&) { return picture_schema(schema<ColonyParams>()); },
     .plan = plan_picture_from_url},
    {.kind = RouteKind::product,
     .method = "POST",
     .pattern = "/v1/colonies.glb",
     .id = "post_colony",
     .summary = "Grows a colony from a body: a mix and what is to differ from its habit.",
     .media_type = glb,
     .body_type = json,
     .request_body = "colony_order",
     .plan = plan_from_body},
    {.kind = RouteKind::image,
     .method = "GET",
     .pattern = "/v1/colonies/{mix}/{image}.jpg",
     .id = "get_colony_image",
     .summary = "One image of a colony's atlas; what textures=linked points to.",
     .media_type = "image/jpeg",
     .query_schema = [](const Atlas&) { return schema<SurfaceAddress>(); },
     .plan = plan_image_from_url<ImageFormat::jpg>},
    {.kind = RouteKind::image,
     .method = "GET",
     .pattern = "/v1/colonies/{mix}/{image}.webp",
     .id = "get_colony_image_webp",
     .summary = "The same as WebP; what textures=linked points to with image_format=webp.",
     .media_type = "image/webp",
     .query_schema = [](const Atlas&) { return schema<SurfaceAddress>(); },
     .plan = plan_image_from_url<ImageFormat::webp>},
    {.kind = RouteKind::image,
     .method = "GET",
     .pattern = "/v1/colonies/wood/{wood}/{image}.jpg",
     .id = "get_wood_image",
     .summary = "One image of the wood that a tier stands on; what textures=linked points to, "
                "beside those of its atlas.",
     .media_type = "image/jpeg",
     .query_schema = [](const Atlas&) { return schema<WoodAddress>(); },
     .plan = plan_wood_image_from_url<ImageFormat::jpg>},
    {.kind = RouteKind::image,
     .method = "GET",
     .pattern = "/v1/colonies/wood/{wood}/{image}.webp",
     .id = "get_wood_image_webp",
     .summary = "The same as WebP; what textures=linked points to with image_format=webp.",
     .media_type = "image/webp",
     .query_schema = [](const Atlas&) { return schema<WoodAddress>(); },
     .plan = plan_wood_image_from_url<ImageFormat::webp>},
};

void add_links(Value& links, const Atlas&) {
    links.set("colonies", "/v1/colonies").set("colony_schema", "/v1/colonies/schema");
}

void add_schemas(Value& schemas, const Atlas&) {
    const Value text = typed("string");
    schemas.set("colony_params", as_written(schema<ColonyParams>()))
        .set("colony_list", objects({{"colonies", product_list_schema()}}))
        .set("colony_description",
             with_collision(objects({{"canonical", text},
                                     {"v", text},
                                     {"mix", mix_list_schema()},
                                     {"made", typed("integer")},
                                     {"effective", reference("schemas/colony_params")},
                                     {"estimate", estimate_schema()},
                                     {"bounds_m", bounds_schema()},
                                     {"levels", levels_schema()}})));
}

void add_bodies(Value& bodies, const Atlas& atlas) {
    bodies.set(
        "colony_order",
        json_body("A mix of species and what is to differ from its habit.",
                  with_members({{"mix", mix_schema()}, {"v", version_member()}},
                               schema<ColonyParams>(), "mix"),
                  object({{"mix", object({{example_id(atlas), 1}})}, {"count", 12}, {"seed", 7}})));
}

}  // namespace

const RouteGroup colony_routes = {
    .tag = "colonies",
    .description = "Many mushrooms that stand together, with their roots.",
    .routes = routes,
    .add_links = add_links,
    .add_schemas = add_schemas,
    .add_bodies = add_bodies};

}  // namespace sporeprint::api
