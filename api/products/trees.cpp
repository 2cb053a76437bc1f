#include "api/products/trees.h"

#include <cmath>

#include "api/products/leaves.h"
#include "core/grow/collision.h"
#include "core/params/schema.h"
#include "core/plant/foliage.h"

namespace sporeprint::api {

namespace {

/// Returns the rows of a body; nothing if they are not lists of numbers.
std::optional<RamificationMatrix> rows_of(const Value& given) {
    if (!given.is_array() || given.items().size() >= most_order) return std::nullopt;
    RamificationMatrix matrix;
    for (const Value& row : given.items()) {
        if (!row.is_array() || row.items().size() > most_order) return std::nullopt;
        std::vector<double>& entries = matrix.rows.emplace_back();
        for (const Value& entry : row.items()) {
            if (!entry.is_number()) return std::nullopt;
            entries.push_back(entry.as_number());
        }
    }
    return matrix;
}

bool says(const Value& body, const char* key, const char* text) {
    const Value* given = body.find(key);
    return given && given->is_string() && given->as_string() == text;
}

}  // namespace

ImageUrls foliage_image_urls(const std::string& leaf, const LeafPaint& paint, const Atlas& atlas) {
    return preset_image_urls<Leaves>(atlas, folder_of_leaves, leaf, paint,
                                     preset_token<Leaves>(atlas, leaf));
}

void Trees::take_from_body(Value& body, ValidationErrors& errors) {
    const Value* given = body.find("rows");
    const std::optional<RamificationMatrix> matrix = given ? rows_of(*given) : std::nullopt;
    if (!matrix) return;  // the reader reports problems of syntax
    const char* own = name(MatrixKind::own);
    // A tree without a custom matrix has no rows; its effective parameters contain an empty list.
    if (given->items().empty() && body.find("matrix") && !says(body, "matrix", own) &&
        !says(body, "toward", own) && !says(body, "tips", own))
        return;
    const bool requested =
        says(body, "matrix", own) || says(body, "toward", own) || says(body, "tips", own);
    if (!body.find("matrix") && !requested) body.set("matrix", own);
    if (says(body, "matrix", own)) {
        // The blend and order of the preset belong to its own matrix.
        if (!body.find("order")) body.set("order", matrix->order());
        if (!body.find("blend")) body.set("blend", 0.0);
    } else if (!requested) {
        errors.add(422, "/rows",
                   "rows count where matrix, toward or tips is 'own'; none of them is");
    }
    const std::vector<Problem> problems = validation_errors(*matrix, "/rows");
    errors.add(422, problems);
    if (problems.empty()) return;
    // Each problem is reported once: the rest is read as if the rows were absent.
    for (const char* key : {"matrix", "toward", "tips"})
        if (says(body, key, own)) body.erase(key);
    body.erase("rows");
}

bool Trees::has_address(const TreeSpec& spec, const Atlas& atlas) {
    const auto& rows = spec.params.look.shape.topology.rows;
    return rows.empty() || rows == own_params<Trees>(atlas, spec.preset).look.shape.topology.rows;
}

Grown Trees::grow(const TreeSpec& spec, const Atlas& atlas, const Extras& extras, int depth,
                  const ExecutionContext& execution) {
    ImageUrls of_leaves;
    if (has_addresses(spec.params.textures)) {
        of_leaves = references_from(
            depth, foliage_image_urls(spec.params.look.leaf.id.string(),
                                      paint_on_tree(leaf_of(spec.params, atlas)), atlas));
    }
    return grow_tree(spec, atlas, extras, of_leaves, execution);
}

Measures Trees::measure(const TreeSpec& spec, const Atlas& atlas,
                        const ExecutionContext& execution) {
    execution.observer(Step::build);
    const std::vector<TreeMeshes> meshes = level_meshes(spec, atlas);
    execution.observer(Step::pack);
    const Bounds box = bounds(meshes.empty() ? tree_meshes(spec, atlas) : meshes.front());
    return {measured(spec, meshes), box, levels_of(spec, atlas, box)};
}

Cost Trees::cost_of_growing(const TreeSpec& spec) {
    const TreeParams& params = spec.params;
    const double twigs = expected_tips(params.look.shape.topology);
    const auto leaves = static_cast<std::size_t>(std::ceil(twigs * params.look.leaves.per_tip));
    // Leaves are gathered from all twigs into groups at coarse levels, and for solids the trunk is
    // grown once more.
    std::size_t times = params.file.collision != CollisionFormat::none ? 1 : 0;
    for (const int lod : levels_in_file(params.lod, params.file))
        times += foliage_count(lod, leaves) < leaves ? 2 : 1;
    return {.base = 100, .twigs = times * static_cast<std::uint64_t>(twigs)};
}

Cost Trees::cost_of_painting(const TreeSpec& spec, const Atlas& atlas) {
    Cost cost = cost_of_paint(paint_of(spec.params));
    if (spec.params.look.leaves.per_tip > 0)
        cost += Leaves::cost_of_paint(paint_on_tree(leaf_of(spec.params, atlas)));
    return cost;
}

void Trees::add_details(const TreeSpec& spec, Value& body) {
    const TreeTopology& topology = spec.params.look.shape.topology;
    body.set("matrix", write(matrix_of(topology).rows));
    body.set("expected_twigs", expected_tips(topology));
    if (spec.params.file.collision != CollisionFormat::none)
        body.set("collision", collision_value(trunk_collision(spec)));
}

Cost Trees::cost_of_paint(const TreePaint& paint) {
    const auto side = static_cast<std::uint64_t>(paint.texture_size.value);
    return {.bark_atlases = 1, .bark_texels = 3 * side * side};
}

namespace {

/// Returns parameters that allow the leaves of an atlas, from which schemas are made.
TreeParams any_params(const Atlas& atlas) {
    TreeParams params;
    params.look.leaf.among = atlas.leaf_ids();
    return params;
}

Value params_schema(const Atlas& atlas) { return from_preset<TreeLook>(schema(any_params(atlas))); }

constexpr const char *json = "application/json", *glb = "model/gltf-binary";

std::string example_preset(const Atlas& atlas) { return atlas.trees().front().id.string(); }

std::string example_leaf(const Atlas& atlas) { return atlas.leaves().front().id.string(); }

/// Returns true for parameters of a tree that say nothing about its leaves: all but the season and the snow.
bool is_of_tree_alone(std::string_view name) {
    return name != "spring" && name != "autumn" && name != "snow" &&
           is_query_name<TreeParams>(name);
}

Value leaf_paint_schema(const Atlas&) {
    Value leaf = from_preset<LeafShape, LeafPalette>(schema<LeafPaint>());
    LeafPaint::fields([&](auto, const Info& info) {
        if (is_of_tree_alone(info.name)) leaf.find("properties")->erase(info.name);
    });
    return leaf;
}

template <ImageFormat Format>
Plan plan_leaf_image(RouteCall& call) {
    std::vector<std::pair<std::string, std::string>> query;
    for (const auto& pair : call.target.query)
        if (!is_of_tree_alone(pair.first)) query.push_back(pair);
    return plan_preset_image<Leaves, Format>(call, folder_of_leaves, query);
}

constexpr Route routes[] = {
    {.kind = RouteKind::document,
     .method = "GET",
     .pattern = "/v1/trees",
     .id = "list_trees",
     .summary = "The trees to begin with.",
     .media_type = json,
     .response_schema = "tree_list",
     .document = [](const DocumentInputs& inputs) { return preset_list<Trees>(inputs.atlas); }},
    {.kind = RouteKind::document,
     .method = "GET",
     .pattern = "/v1/trees/schema",
     .id = "tree_schema",
     .summary = "JSON Schema of the query parameters of a tree.",
     .media_type = "application/schema+json",
     .document =
         [](const DocumentInputs& inputs) {
             return from_preset<TreeLook>(
                 schema_document("Parameters of a tree", any_params(inputs.atlas)));
         }},
    {.kind = RouteKind::product,
     .method = "GET",
     .pattern = "/v1/trees/{preset}.glb",
     .id = "get_tree",
     .summary = "Grows a tree and answers with a GLB file.",
     .media_type = glb,
     .example = example_preset,
     .query_schema = params_schema,
     .plan = plan_preset_url<Trees, Product::glb>},
    {.kind = RouteKind::product,
     .method = "GET",
     .pattern = "/v1/trees/{preset}.bin",
     .id = "get_tree_geometry",
     .summary = "The geometry of that file alone, as files name it that share it: tiles of worlds.",
     .media_type = "application/octet-stream",
     .example = example_preset,
     .query_schema = params_schema,
     .plan = plan_preset_url<Trees, Product::bin>},
    {.kind = RouteKind::product,
     .method = "GET",
     .pattern = "/v1/trees/{preset}.json",
     .id = "describe_tree",
     .summary =
         "What would be grown: canonical address, effective parameters, matrix, cost and bounds.",
     .media_type = json,
     .example = example_preset,
     .response_schema = "tree_description",
     .query_schema = params_schema,
     .plan = plan_preset_url<Trees, Product::json>},
    {.kind = RouteKind::product,
     .method = "GET",
     .pattern = "/v1/trees/{preset}.png",
     .id = "draw_tree",
     .summary = "A picture of a tree.",
     .media_type = "image/png",
     .example = example_preset,
     .query_schema = [](const Atlas& atlas) { return picture_schema(params_schema(atlas)); },
     .plan = plan_preset_picture<Trees>},
    {.kind = RouteKind::product,
     .method = "POST",
     .pattern = "/v1/trees.glb",
     .id = "post_tree",
     .summary =
         "Grows a tree from a body: a preset and what is to differ from it, also a ramification "
         "matrix of your own.",
     .media_type = glb,
     .body_type = json,
     .request_body = "tree_order",
     .plan = plan_preset_body<Trees>},
    {.kind = RouteKind::image,
     .method = "GET",
     .pattern = "/v1/trees/{preset}/{image}.jpg",
     .id = "get_tree_image",
     .summary =
         "One image of a tree's bark; what textures=linked points to, beside those of its leaves.",
     .media_type = "image/jpeg",
     .example = example_preset,
     .query_schema = [](const Atlas&) { return from_preset<TreeLook>(schema<TreePaint>()); },
     .plan = plan_own_image<Trees, ImageFormat::jpg>},
    {.kind = RouteKind::image,
     .method = "GET",
     .pattern = "/v1/trees/{preset}/{image}.webp",
     .id = "get_tree_image_webp",
     .summary =
         "One image of a tree's bark; what textures=linked points to, beside those of its leaves.",
     .media_type = "image/webp",
     .example = example_preset,
     .query_schema = [](const Atlas&) { return from_preset<TreeLook>(schema<TreePaint>()); },
     .plan = plan_own_image<Trees, ImageFormat::webp>},
    {.kind = RouteKind::image,
     .method = "GET",
     .pattern = "/v1/trees/leaves/{preset}/{image}.jpg",
     .id = "get_tree_leaf_image",
     .summary = "One image of a tree's leaves; what textures=linked points to, beside its bark.",
     .media_type = "image/jpeg",
     .example = example_leaf,
     .query_schema = leaf_paint_schema,
     .plan = plan_leaf_image<ImageFormat::jpg>},
    {.kind = RouteKind::image,
     .method = "GET",
     .pattern = "/v1/trees/leaves/{preset}/{image}.png",
     .id = "get_tree_leaf_image_png",
     .summary = "The base colour as PNG, with alpha where it shows shoots of needles or sprays.",
     .media_type = "image/png",
     .example = example_needle,
     .query_schema = leaf_paint_schema,
     .plan = plan_leaf_image<ImageFormat::png>},
    {.kind = RouteKind::image,
     .method = "GET",
     .pattern = "/v1/trees/leaves/{preset}/{image}.webp",
     .id = "get_tree_leaf_image_webp",
     .summary = "The same as WebP; what textures=linked points to with image_format=webp.",
     .media_type = "image/webp",
     .example = example_leaf,
     .query_schema = leaf_paint_schema,
     .plan = plan_leaf_image<ImageFormat::webp>},
};

void add_links(Value& links, const Atlas&) {
    links.set("trees", "/v1/trees").set("tree_schema", "/v1/trees/schema");
}

void add_schemas(Value& schemas, const Atlas& atlas) {
    const Value text = typed("string"), whole = typed("integer");
    Value description = preset_description_schema("tree_params");
    for (const auto& [key, value] : {Value::Member("matrix", list_of(list_of(typed("number")))),
                                     Value::Member("expected_twigs", typed("number"))}) {
        description.find("properties")->set(key, value);
        description.find("required")->push(key);
    }
    schemas.set("tree_params", as_written(schema(any_params(atlas))))
        .set("tree_list", objects({{"trees", list_of(objects({{"id", text},
                                                              {"name", text},
                                                              {"order", whole},
                                                              {"links", map_of(text)}}))}}))
        .set("tree_description", with_collision(std::move(description)));
}

void add_bodies(Value& bodies, const Atlas& atlas) {
    const auto row = [](std::initializer_list<double> shares) {
        Value list = Value::array();
        for (const double share : shares) list.push(share);
        return list;
    };
    bodies.set(
        "tree_order",
        json_body("A preset and what is to differ from it, also a ramification matrix of your own.",
                  preset_body_schema<Trees>(atlas, params_schema(atlas)),
                  object({{"preset", example_preset(atlas)},
                          {"rows", Value(Value::Array{row({0.6, 0.4}), row({0.3, 0.4, 0.3})})},
                          {"leaves", object({{"per_tip", 6}})}})));
}

}  // namespace

const RouteGroup tree_routes = {
    .tag = "trees",
    .description = "Trees, shrubs and herbs that branch by a ramification matrix.",
    .routes = routes,
    .add_links = add_links,
    .add_schemas = add_schemas,
    .add_bodies = add_bodies};

}  // namespace sporeprint::api
