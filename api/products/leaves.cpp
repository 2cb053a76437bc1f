#include "api/products/leaves.h"

#include "core/params/schema.h"

namespace sporeprint::api {

Grown Leaves::grow(const LeafSpec& spec, const Atlas& atlas, const Extras& extras, int,
                   const ExecutionContext& execution) {
    return grow_leaf(spec, atlas, extras, execution);
}

Measures Leaves::measure(const LeafSpec& spec, const Atlas&, const ExecutionContext& execution) {
    execution.observer(Step::build);
    const std::vector<Level> levels = levels_of(spec);
    execution.observer(Step::pack);
    return {measured(spec, levels), bounds(leaf_mesh(spec)), levels};
}

/// Returns the cost of cutting what is eaten out of the mesh of a level of detail.
static std::uint64_t cost_of_openings(const LeafSpec& spec, int lod) {
    const LeafShape& shape = spec.params.shape;
    if (shape.leaflets.count > 0 || !(shape.eaten > 0.0)) return 0;
    // A needle is too narrow for openings.
    if (lamina_area(shape) < 0.08 * shape.length * shape.length) return 0;
    return lod == 0 ? 2800 : lod == 1 ? 1100 : 0;
}

Cost Leaves::cost_of_growing(const LeafSpec& spec) {
    return {.base = 150 + cost_of_openings(spec, spec.params.lod)};
}

Cost Leaves::cost_of_describing(const LeafSpec& spec) {
    LeafSpec chain = spec;
    chain.params.file.lods = Lods::nodes;
    std::uint64_t openings = 0;
    for (int lod = spec.params.lod; lod < leaf_lods; ++lod) openings += cost_of_openings(spec, lod);
    return {.base = 100 + 2 * openings, .vertices = estimate(chain).vertices};
}

Cost Leaves::cost_of_painting(const LeafSpec& spec, const Atlas&) {
    return cost_of_paint(paint_of(spec.params));
}

Cost Leaves::cost_of_paint(const LeafPaint& paint) {
    const auto side = static_cast<std::uint64_t>(paint.texture_size.value);
    // Images show one lamina, also those of a compound leaf.
    LeafShape simple;
    simple.venation = paint.venation;
    const auto vertices = static_cast<std::uint64_t>(most_of_leaf(simple, 0).vertices);
    return {.leaf_atlases = 1,
            .leaf_rows = side,
            .leaf_texels = 3 * side * side,
            .leaf_row_vertices = side * vertices};
}

std::string example_needle(const Atlas& atlas) {
    for (const LeafPreset& preset : atlas.leaves())
        if (has_alpha(paint_of(params_of(preset)))) return preset.id.string();
    return atlas.leaves().front().id.string();
}

namespace {

Value params_schema(const Atlas&) {
    return from_preset<LeafShape, LeafPalette>(schema<LeafParams>());
}

constexpr const char *json = "application/json", *glb = "model/gltf-binary";

std::string example_preset(const Atlas& atlas) { return atlas.leaves().front().id.string(); }

constexpr Route routes[] = {
    {.kind = RouteKind::document,
     .method = "GET",
     .pattern = "/v1/leaves",
     .id = "list_leaves",
     .summary = "The leaves to begin with.",
     .media_type = json,
     .response_schema = "leaf_list",
     .document = [](const DocumentInputs& inputs) { return preset_list<Leaves>(inputs.atlas); }},
    {.kind = RouteKind::document,
     .method = "GET",
     .pattern = "/v1/leaves/schema",
     .id = "leaf_schema",
     .summary = "JSON Schema of the query parameters of a leaf.",
     .media_type = "application/schema+json",
     .document =
         [](const DocumentInputs&) {
             return from_preset<LeafShape, LeafPalette>(
                 schema_document<LeafParams>("Parameters of a leaf"));
         }},
    {.kind = RouteKind::product,
     .method = "GET",
     .pattern = "/v1/leaves/{preset}.glb",
     .id = "get_leaf",
     .summary = "Grows a leaf and answers with a GLB file.",
     .media_type = glb,
     .example = example_preset,
     .query_schema = params_schema,
     .plan = plan_preset_url<Leaves, Product::glb>},
    {.kind = RouteKind::product,
     .method = "GET",
     .pattern = "/v1/leaves/{preset}.json",
     .id = "describe_leaf",
     .summary = "What would be grown: canonical address, effective parameters, cost and bounds.",
     .media_type = json,
     .example = example_preset,
     .response_schema = "leaf_description",
     .query_schema = params_schema,
     .plan = plan_preset_url<Leaves, Product::json>},
    {.kind = RouteKind::product,
     .method = "GET",
     .pattern = "/v1/leaves/{preset}.png",
     .id = "draw_leaf",
     .summary = "A picture of a leaf.",
     .media_type = "image/png",
     .example = example_preset,
     .query_schema = [](const Atlas& atlas) { return picture_schema(params_schema(atlas)); },
     .plan = plan_preset_picture<Leaves>},
    {.kind = RouteKind::product,
     .method = "POST",
     .pattern = "/v1/leaves.glb",
     .id = "post_leaf",
     .summary = "Grows a leaf from a body: a preset and what is to differ from it.",
     .media_type = glb,
     .body_type = json,
     .request_body = "leaf_order",
     .plan = plan_preset_body<Leaves>},
    {.kind = RouteKind::image,
     .method = "GET",
     .pattern = "/v1/leaves/{preset}/{image}.jpg",
     .id = "get_leaf_image",
     .summary = "One image of a leaf's atlas; what textures=linked points to.",
     .media_type = "image/jpeg",
     .example = example_preset,
     .query_schema =
         [](const Atlas&) { return from_preset<LeafShape, LeafPalette>(schema<LeafPaint>()); },
     .plan = plan_own_image<Leaves, ImageFormat::jpg>},
    {.kind = RouteKind::image,
     .method = "GET",
     .pattern = "/v1/leaves/{preset}/{image}.png",
     .id = "get_leaf_image_png",
     .summary = "The base colour as PNG, with alpha where it shows shoots of needles or sprays.",
     .media_type = "image/png",
     .example = example_needle,
     .query_schema =
         [](const Atlas&) { return from_preset<LeafShape, LeafPalette>(schema<LeafPaint>()); },
     .plan = plan_own_image<Leaves, ImageFormat::png>},
    {.kind = RouteKind::image,
     .method = "GET",
     .pattern = "/v1/leaves/{preset}/{image}.webp",
     .id = "get_leaf_image_webp",
     .summary = "The same as WebP; what textures=linked points to with image_format=webp.",
     .media_type = "image/webp",
     .example = example_preset,
     .query_schema =
         [](const Atlas&) { return from_preset<LeafShape, LeafPalette>(schema<LeafPaint>()); },
     .plan = plan_own_image<Leaves, ImageFormat::webp>},
};

void add_links(Value& links, const Atlas&) {
    links.set("leaves", "/v1/leaves").set("leaf_schema", "/v1/leaves/schema");
}

void add_schemas(Value& schemas, const Atlas&) {
    const Value text = typed("string");
    schemas.set("leaf_params", as_written(schema<LeafParams>()))
        .set("leaf_list",
             objects({{"leaves",
                       list_of(objects({{"id", text}, {"name", text}, {"links", map_of(text)}}))}}))
        .set("leaf_description", preset_description_schema("leaf_params"));
}

void add_bodies(Value& bodies, const Atlas& atlas) {
    bodies.set("leaf_order",
               json_body("A preset and what is to differ from it.",
                         preset_body_schema<Leaves>(atlas, params_schema(atlas)),
                         object({{"preset", example_preset(atlas)},
                                 {"autumn", 0.5},
                                 {"venation", object({{"lobes", 7}, {"vein_deg", 40}})}})));
}

}  // namespace

const RouteGroup leaf_routes = {.tag = "leaves",
                                .description = "Leaves with their veins.",
                                .routes = routes,
                                .add_links = add_links,
                                .add_schemas = add_schemas,
                                .add_bodies = add_bodies};

}  // namespace sporeprint::api
