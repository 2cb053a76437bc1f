// Products that grow from presets (leaves, trees): from a URL or a body to a specification, back to
// the canonical URL and key, and their routes. `Kind` names the product: Leaves, Trees.
#pragma once

#include <algorithm>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "api/http/schemas.h"
#include "api/products/images.h"
#include "api/products/pictures.h"
#include "api/products/plan_product.h"
#include "api/products/product.h"
#include "core/atlas/atlas.h"
#include "core/grow/names.h"
#include "core/params/canonical.h"
#include "core/params/messages.h"
#include "core/params/query.h"
#include "core/params/reader.h"

namespace sporeprint::api {

/// A specification, the product to generate, and the version token of the request.
template <class Kind>
struct PresetRequest {
    typename Kind::Spec spec;
    Product product = Product::glb;
    std::optional<std::string> version;
};

/// A request for one image of a product from a preset.
template <class Kind>
struct PresetSurface {
    std::string preset;
    std::optional<ImageKind> kind;
    typename Kind::Paint paint;
    std::optional<std::string> version;
};

/// Returns the preset with an id. If there is none, adds 404 for `parameter` and returns the first
/// preset.
template <class Kind>
const typename Kind::Preset& preset_of(const Atlas& atlas, std::string_view id,
                                       const char* parameter, ValidationErrors& errors) {
    if (const auto* preset = Kind::find(atlas, id)) return *preset;
    std::vector<std::string> ids;
    std::string all;
    for (const auto& preset : Kind::presets(atlas)) {
        ids.push_back(preset.id.string());
        (all += all.empty() ? "" : ", ") += ids.back();
    }
    const std::string_view meant = closest(id, ids);
    errors.add(
        404, parameter,
        std::string("unknown ") + Kind::one + ' ' + in_quotes(id) +
            (meant.empty() ? "; there are " + all : "; did you mean " + in_quotes(meant) + "?"));
    return Kind::presets(atlas).front();
}

/// Returns the parameters of a preset without overrides.
///
/// pre  a preset has this id
template <class Kind>
typename Kind::Params own_params(const Atlas& atlas, std::string_view id) {
    if constexpr (requires { params_of(*Kind::find(atlas, id), atlas); })
        return params_of(*Kind::find(atlas, id), atlas);
    else
        return params_of(*Kind::find(atlas, id));
}

/// Replaces a number of triangles by the level of detail that it chooses, so that equal files have
/// one canonical URL. What is impossible is left to the estimate, which reports it.
template <class Kind>
void choose_level(typename Kind::Spec& spec, const ValidationErrors& errors) {
    if (!errors.empty()) return;
    try {
        spec = at_level(spec);
    } catch (const InvalidInput&) {
        return;
    }
}

/// Reads the {preset} and the query of a URL. Problems are added to `errors`.
template <class Kind>
PresetRequest<Kind> read_preset(const Atlas& atlas, std::string_view id, Query query,
                                ValidationErrors& errors) {
    const auto& preset = preset_of<Kind>(atlas, id, "preset", errors);
    PresetRequest<Kind> request{{preset.id.string(), params_of(preset)}, {}, {}};
    std::vector<std::pair<std::string, std::string>> rest;
    request.version = take_version(query, rest, errors);
    std::vector<Problem> problems;
    apply_profile(requested_profile(rest), request.spec.params);
    read_query(rest, request.spec.params, problems);
    drop_excluded_defaults(request.spec.params, named_options(rest));
    add_problems(problems, request.spec.params, "", false, errors);
    without_negative_zero(request.spec.params);
    if constexpr (requires { Kind::settle(request.spec.params); })
        Kind::settle(request.spec.params);
    choose_level<Kind>(request.spec, errors);
    return request;
}

/// Reads a body: {"preset":id} beside the nested query parameters ("venation":{"lobes":7}).
template <class Kind>
PresetRequest<Kind> read_preset(const Atlas& atlas, std::string_view body,
                                ValidationErrors& errors) {
    PresetRequest<Kind> request;
    std::optional<Value> json = read_body(body, errors);
    if (!json) return request;
    std::vector<Problem> problems;
    request.version = take_version(*json, problems);
    const Value* given = json->find("preset");
    const auto& first = Kind::presets(atlas).front();
    if (!given)
        report(problems, "/preset",
               std::string("is missing; give {\"preset\":\"") + first.id.string() + "\"}");
    else if (!given->is_string())
        report(problems, "/preset", "expected text, got " + shown(*given));
    const bool named = given && given->is_string();
    const auto& preset =
        named ? preset_of<Kind>(atlas, given->as_string(), "/preset", errors) : first;
    json->erase("preset");
    if constexpr (requires { Kind::take_from_body(*json, errors); })
        Kind::take_from_body(*json, errors);
    request.spec = {preset.id.string(), params_of(preset)};
    apply_profile(requested_profile(*json), request.spec.params);
    read(*json, request.spec.params, Info{.name = ""}, "", problems);
    drop_excluded_defaults(request.spec.params, named_options(*json));
    add_problems(problems, request.spec.params, "", true, errors);
    without_negative_zero(request.spec.params);
    if constexpr (requires { Kind::settle(request.spec.params); })
        Kind::settle(request.spec.params);
    choose_level<Kind>(request.spec, errors);
    return request;
}

/// Returns the current version token of a preset.
template <class Kind>
std::string preset_token(const Atlas& atlas, const std::string& preset) {
    std::string templates = preset + ' ' + canonical_text(own_params<Kind>(atlas, preset));
    if constexpr (requires { Kind::more_templates(atlas); })
        templates += Kind::more_templates(atlas);
    return token_of(templates);
}

/// Returns the canonical URL without version: the preset, then parameters that differ from it, in
/// schema order; empty if no URL can express the specification.
template <class Kind, class Spec>
std::string canonical_address(const Atlas& atlas, const Spec& spec, Product product) {
    if constexpr (requires { Kind::has_address(spec, atlas); })
        if (!Kind::has_address(spec, atlas)) return {};
    return with_query(
        folder_of(Kind::all) + spec.preset + ending_of(product),
        query_text(spec.params, with_profile(own_params<Kind>(atlas, spec.preset), spec.params)));
}

/// Returns the canonical text of all values: equal keys mean equal bytes.
template <class Kind, class Spec>
std::string key_of(const Spec& spec, Product product, const std::string& version) {
    return std::string(Kind::one) + ending_of(product) + ' ' + version + '\n' + spec.preset + '\n' +
           canonical_text(spec.params);
}

/// Reads {preset}, {image} and query of the URL of an image.
template <class Kind>
PresetSurface<Kind> read_preset_surface(const Atlas& atlas, std::string_view id,
                                        std::string_view image, Query query,
                                        ValidationErrors& errors) {
    const auto& preset = preset_of<Kind>(atlas, id, "preset", errors);
    PresetSurface<Kind> requested{
        preset.id.string(), read_image(image, errors), paint_of(params_of(preset)), {}};
    std::vector<std::pair<std::string, std::string>> rest;
    requested.version = take_version(query, rest, errors);
    std::vector<Problem> problems;
    read_query(rest, requested.paint, problems);
    add_problems(problems, requested.paint, "", false, errors);
    without_negative_zero(requested.paint);
    return requested;
}

/// Returns the canonical URL of an image without version.
///
/// folder  of the images of all presets: "/v1/leaves/"
template <class Kind, class Paint>
std::string canonical_image_address(const Atlas& atlas, const std::string& folder,
                                    const std::string& preset, ImageKind kind, ImageFormat format,
                                    const Paint& paint) {
    return with_query(folder + preset + '/' + file_of(kind, format),
                      query_text(paint, paint_of(own_params<Kind>(atlas, preset))));
}

/// Returns the format of the base colour of a paint in files: JPEG files have no alpha.
template <class Paint>
ImageFormat format_of_colour(const Paint& paint, ImageFormat format) {
    if constexpr (requires { format_in_files(paint, format); })
        return format_in_files(paint, format);
    else
        return format;
}

/// Returns the URLs of the three images of an atlas, with a version token.
template <class Kind, class Paint>
ImageUrls preset_image_urls(const Atlas& atlas, const std::string& folder,
                            const std::string& preset, const Paint& paint,
                            const std::string& version) {
    return image_urls_of([&](ImageKind kind, ImageFormat format) {
        const ImageFormat own =
            kind == ImageKind::base_color ? format_of_colour(paint, format) : format;
        return with_version(canonical_image_address<Kind>(atlas, folder, preset, kind, own, paint),
                            version);
    });
}

/// Returns the document that lists all presets: {"leaves":[{"id","name","links"}]} for leaves.
template <class Kind>
Value preset_list(const Atlas& atlas) {
    const std::string root = folder_of(Kind::all);
    Value list = Value::array();
    for (const auto& preset : Kind::presets(atlas)) {
        const std::string id = preset.id.string();
        Value links = Value::object();
        links.set("self", root + id + ".json").set("model", root + id + ".glb");
        links.set("image", root + id + ".png");
        links.set("schema", root + "schema");
        Value item = Value::object().set("id", id).set("name", preset.name.view());
        if constexpr (requires { Kind::tell(preset, item); }) Kind::tell(preset, item);
        list.push(std::move(item.set("links", std::move(links))));
    }
    return Value::object().set(Kind::all, std::move(list));
}

/// What the JSON of a product from a preset says about its meshes.
struct Measures {
    Estimate estimate;
    Bounds box;
    std::vector<Level> levels;
};

/// The Kind of plan_product.h for a product from presets, whose own Kind has:
///   grow(spec, atlas, extras, depth, execution)    the file; depth of links to further images
///   measure(spec, atlas, execution)        its exact estimate, its bounds, its levels of detail
///   cost_of_growing(spec)                  cost beside its vertices, bytes and images
///   cost_of_describing(spec)               optional: cost of its JSON beside that of growing
///   cost_of_painting(spec, atlas)          cost of painting all of its images
///   add_details(spec, body)                optional: adds further members to its JSON
///   source(spec)                           optional: the spec of what an impostor shows
template <class Kind>
struct PresetProduct {
    using Spec = typename Kind::Spec;
    struct Resolved {};

    static std::string version(const Spec& spec, const Atlas& atlas) {
        return preset_token<Kind>(atlas, spec.preset);
    }
    static std::string url(const Spec& spec, Product product, const Atlas& atlas) {
        return canonical_address<Kind>(atlas, spec, product);
    }
    static std::string key(const Spec& spec, Product product, const std::string& version) {
        return key_of<Kind>(spec, product, version);
    }
    static std::string file_name(const Spec& spec, Product product, const Atlas& atlas) {
        return sporeprint::file_name(product_name(spec, atlas), spec.params.lod,
                                     spec.params.triangles, spec.params.file) +
               ending_of(product);
    }

    static Cost cost(const Context& context, const Spec& spec, Product product, const Caches&,
                     Resolved&) {
        const Estimate estimated = estimate(spec);
        refuse_over_budget(context.options, estimated, false, false, spec.params.file);
        if constexpr (requires { Kind::source(spec); })
            if (has_impostor(spec.params.lod, spec.params.file)) {
                // What an impostor shows is generated too.
                const Spec shown = Kind::source(spec);
                const Estimate source = estimate(shown);
                refuse_over_budget(context.options, source, false, false, shown.params.file);
                Cost cost = cost_of_levels(context, shown, source, product);
                if (spec.params.lod != impostor_lod)
                    cost += cost_of_levels(context, spec, estimated, product);
                if (product == Product::json) return cost;
                return cost + cost_of_impostor(spec.params.file, estimated, source.triangles);
            }
        return cost_of_levels(context, spec, estimated, product);
    }

    /// Returns the cost of the levels of detail that are meshes.
    static Cost cost_of_levels(const Context& context, const Spec& spec, const Estimate& estimated,
                               Product product) {
        Cost cost = Kind::cost_of_growing(spec);
        cost.placed_vertices = estimated.vertices;
        if (product == Product::json) {
            if constexpr (requires { Kind::cost_of_describing(spec); })
                cost += Kind::cost_of_describing(spec);
            return cost;
        }
        cost.bytes = estimated.bytes;
        if (spec.params.textures == Textures::embedded)
            cost += cost_of_images(spec.params.file, Kind::cost_of_painting(spec, *context.atlas),
                                   estimated.texels);
        return cost;
    }

    static ImageUrls image_urls(const Context& context, const Spec& spec,
                                const std::string& version, const ExecutionContext&) {
        return preset_image_urls<Kind>(*context.atlas, folder_of(Kind::all), spec.preset,
                                       paint_of(spec.params), version);
    }

    static Body grow(const Context& context, const Spec& spec, Resolved&, const Extras& extras,
                     int depth, const ExecutionContext& execution) {
        return Kind::grow(spec, *context.atlas, extras, depth, execution).glb;
    }

    static Value describe(const Context& context, const Spec& spec, Resolved&,
                          const std::string& version, const ExecutionContext& execution) {
        const auto [cost, box, levels] = Kind::measure(spec, *context.atlas, execution);
        Value body = Value::object();
        body.set("canonical", canonical_address<Kind>(*context.atlas, spec, Product::glb));
        body.set("v", version);
        body.set("preset", spec.preset);
        body.set("effective", write(spec.params));
        body.set("estimate", description(cost));
        body.set("bounds_m", description(box));
        body.set("levels", level_list(levels));
        if constexpr (requires { Kind::add_details(spec, body); }) Kind::add_details(spec, body);
        return body;
    }
};

/// Handles GET /v1/{kind}/{preset}.glb, .json and .bin.
template <class Kind, Product Format>
Plan plan_preset_url(RouteCall& call) {
    auto requested =
        read_preset<Kind>(*call.context.atlas, call.captured[0], call.target.query, call.errors);
    requested.product = Format;
    if constexpr (Format == Product::bin) as_geometry(requested.spec.params, call.errors);
    return plan_product<PresetProduct<Kind>>(call.context, call.request, std::move(requested),
                                             call.errors);
}

/// Handles GET /v1/{kind}/{preset}.png.
template <class Kind>
Plan plan_preset_picture(RouteCall& call) {
    const PictureQuery query = read_picture_query(call.target.query, call.errors);
    return plan_picture<PresetProduct<Kind>>(
        call, query,
        read_preset<Kind>(*call.context.atlas, call.captured[0], query.product, call.errors));
}

/// Handles POST /v1/{kind}.glb.
template <class Kind>
Plan plan_preset_body(RouteCall& call) {
    refuse_query(call.target, call.errors);
    return plan_product<PresetProduct<Kind>>(
        call.context, call.request,
        read_preset<Kind>(*call.context.atlas, call.request.body, call.errors), call.errors);
}

/// Plans the response to a request for an image of a preset.
///
/// folder  of the images: "/v1/leaves/"
/// query   without parameters of the model
template <class Kind, ImageFormat Format>
Plan plan_preset_image(RouteCall& call, const std::string& folder, Query query) {
    Context& context = call.context;
    const Atlas& atlas = *context.atlas;
    const auto requested =
        read_preset_surface<Kind>(atlas, call.captured[0], call.captured[1], query, call.errors);
    if (!call.errors.empty()) return context.responses.problem(call.request, call.errors);
    if (Format == ImageFormat::png && requested.kind != ImageKind::base_color) {
        call.errors.add(404, "image",
                        in_quotes(file_of(*requested.kind, Format)) +
                            " does not exist: base_color alone is a PNG file; ask for " +
                            file_of(*requested.kind, ImageFormat::jpg) + " or " +
                            file_of(*requested.kind, ImageFormat::webp));
        return context.responses.problem(call.request, call.errors);
    }
    // What stands beside a base colour with alpha is of the set of that one.
    const ImageFormat painted = requested.kind == ImageKind::base_color
                                    ? Format
                                    : format_of_colour(requested.paint, Format);
    const auto decide = [&](ValidationErrors& found) {
        return paint_work(context, requested.paint, Kind::cost_of_paint(requested.paint), painted,
                          found);
    };
    std::string of = requested.preset;
    if constexpr (requires { requested.paint.seed; })
        of += '-' + std::to_string(requested.paint.seed);
    const ImageResource image{
        *requested.kind,
        Format,
        preset_token<Kind>(atlas, requested.preset),
        canonical_image_address<Kind>(atlas, folder, requested.preset, *requested.kind, Format,
                                      requested.paint),
        std::move(of),
        requested.version};
    return plan_image(context, call.request, image, decide, call.errors);
}

/// Handles GET /v1/{kind}/{preset}/{image}.jpg, .png and .webp.
template <class Kind, ImageFormat Format>
Plan plan_own_image(RouteCall& call) {
    return plan_preset_image<Kind, Format>(
        call, folder_of(Kind::all),
        without_parameters_of_model<typename Kind::Paint, typename Kind::Params>(
            call.target.query));
}

/// Returns the schema of the body of POST /v1/{kind}.glb.
///
/// params  schema of its parameters
template <class Kind>
Value preset_body_schema(const Atlas& atlas, Value params) {
    Value ids = Value::array();
    for (const auto& preset : Kind::presets(atlas)) ids.push(preset.id.view());
    return with_members({{"preset", object({{"type", "string"},
                                            {"enum", std::move(ids)},
                                            {"description", "What to begin with."}})},
                         {"v", version_member()}},
                        std::move(params), "preset");
}

/// Returns the schema of descriptions of a product from presets.
///
/// params  name of the schema of its parameters
inline Value preset_description_schema(const char* params) {
    const Value text = typed("string");
    return objects({{"canonical", text},
                    {"v", text},
                    {"preset", text},
                    {"effective", reference(std::string("schemas/") + params)},
                    {"estimate", estimate_schema()},
                    {"bounds_m", bounds_schema()},
                    {"levels", levels_schema()}});
}

}  // namespace sporeprint::api
