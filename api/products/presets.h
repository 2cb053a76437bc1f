// Requests for what grows from presets (leaves, trees): from an address or a body to an order, and back to the canonical address and key.
#pragma once

#include <algorithm>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "api/products/product.h"
#include "core/params/canonical.h"
#include "core/params/messages.h"
#include "core/params/query.h"
#include "core/params/reader.h"
#include "core/plant/leaf_spec.h"
#include "core/plant/tree_spec.h"

namespace sporeprint::api {

/// Leaves, as what follows knows them: names, presets, and what they are ordered and painted by.
struct Leaves {
    using Preset = LeafPreset;
    using Order = LeafSpec;
    using Params = LeafParams;
    using Paint = LeafPaint;
    static constexpr const char *one = "leaf", *all = "leaves";
    static std::span<const Preset> presets() { return leaf_presets(); }
};

/// Trees. What a kind has beside names, presets and types it says by functions that others need not have.
struct Trees {
    using Preset = TreePreset;
    using Order = TreeSpec;
    using Params = TreeParams;
    using Paint = TreePaint;
    static constexpr const char *one = "tree", *all = "trees";
    static std::span<const Preset> presets() { return tree_presets(); }

    /// What a matrix of one's own means in a body: it is called `own`, its order is the highest that it has, and it is blended with
    /// nothing, unless the body says otherwise. Its faults are 422, each by its row; rows that no matrix asks for are one.
    static void take_from_body(Value& body, ValidationErrors& errors);

    /// One text for one tree.
    static void settle(Params& params) { without_unused_rows(params); }

    /// Rows of one's own are in no address.
    static bool has_address(const Order& spec);

    /// What else the list tells of a preset.
    static void tell(const Preset& preset, Value& item) {
        item.set("order", preset.shape.topology.order);
    }

    /// What else it is made with: the leaves that it may bear.
    static std::string more_templates();
};

template <class Kind>
struct PresetRequest {
    typename Kind::Order spec;
    Product product = Product::glb;
    std::optional<std::string> version;
};

/// One image of what grows from a preset.
template <class Kind>
struct PresetSurface {
    std::string preset;
    std::optional<ImageKind> kind;
    typename Kind::Paint paint;
    std::optional<std::string> version;
};

/// The preset of that id; of the first, with 404 for `parameter`, when there is none.
template <class Kind>
const typename Kind::Preset& preset_of(std::string_view id, const char* parameter,
                                       ValidationErrors& errors) {
    std::vector<std::string> ids;
    for (const auto& preset : Kind::presets()) {
        if (id == preset.id) return preset;
        ids.emplace_back(preset.id);
    }
    const std::string_view meant = closest(id, ids);
    errors.add(404, parameter,
               std::string("unknown ") + Kind::one + ' ' + in_quotes(id) +
                   (meant.empty() ? "" : "; did you mean " + in_quotes(meant) + "?"));
    return Kind::presets().front();
}

/// The parameters of a preset that is there.
template <class Kind>
typename Kind::Params own_params(std::string_view id) {
    ValidationErrors none;
    return params_of(preset_of<Kind>(id, "", none));
}

/// Reads the {preset} and the query of an address.
template <class Kind>
PresetRequest<Kind> read_preset(std::string_view id, Query query, ValidationErrors& errors) {
    const auto& preset = preset_of<Kind>(id, "preset", errors);
    PresetRequest<Kind> request{{preset.id, params_of(preset)}, {}, {}};
    std::vector<std::pair<std::string, std::string>> rest;
    request.version = take_version(query, rest, errors);
    std::vector<Problem> problems;
    read_query(rest, request.spec.params, problems);
    add_problems(problems, request.spec.params, "", false, errors);
    without_negative_zero(request.spec.params);
    if constexpr (requires { Kind::settle(request.spec.params); })
        Kind::settle(request.spec.params);
    return request;
}

/// Reads a body: {"preset":id} beside the query parameters nested ("venation":{"lobes":7}).
template <class Kind>
PresetRequest<Kind> read_preset(std::string_view body, ValidationErrors& errors) {
    PresetRequest<Kind> request;
    std::optional<Value> json = read_body(body, errors);
    if (!json) return request;
    std::vector<Problem> problems;
    request.version = take_version(*json, problems);
    const Value* given = json->find("preset");
    const auto& first = Kind::presets().front();
    if (!given)
        report(problems, "/preset",
               std::string("is missing; give {\"preset\":\"") + first.id + "\"}");
    else if (!given->is_string())
        report(problems, "/preset", "expected text, got " + shown(*given));
    const bool named = given && given->is_string();
    const auto& preset = named ? preset_of<Kind>(given->as_string(), "/preset", errors) : first;
    json->erase("preset");
    if constexpr (requires { Kind::take_from_body(*json, errors); })
        Kind::take_from_body(*json, errors);
    request.spec = {preset.id, params_of(preset)};
    read(*json, request.spec.params, Info{.name = ""}, "", problems);
    add_problems(problems, request.spec.params, "", true, errors);
    without_negative_zero(request.spec.params);
    if constexpr (requires { Kind::settle(request.spec.params); })
        Kind::settle(request.spec.params);
    return request;
}

/// Today's version token of what is made from a preset.
template <class Kind>
std::string preset_token(const std::string& preset) {
    std::string templates = preset + ' ' + canonical_text(own_params<Kind>(preset));
    if constexpr (requires { Kind::more_templates(); }) templates += Kind::more_templates();
    return token_of(templates);
}

/// Canonical address without version: the preset, then what differs from it, in schema order; empty where no address says it.
template <class Kind, class Order>
std::string canonical_address(const Order& spec, Product product) {
    if constexpr (requires { Kind::has_address(spec); })
        if (!Kind::has_address(spec)) return {};
    return with_query(std::string("/v1/") + Kind::all + '/' + spec.preset + ending_of(product),
                      query_text(spec.params, own_params<Kind>(spec.preset)));
}

/// Full canonical text of all values: equal keys, equal bytes.
template <class Kind, class Order>
std::string key_of(const Order& spec, Product product, const std::string& version) {
    return std::string(Kind::one) + ending_of(product) + ' ' + version + '\n' + spec.preset + '\n' +
           canonical_text(spec.params);
}

/// "maple-7.glb"
template <class Order>
std::string preset_file_name(const Order& spec, Product product) {
    return spec.preset + '-' + std::to_string(spec.params.seed) + ending_of(product);
}

/// Reads {preset}, {image} and query of an address under /v1/surfaces.
template <class Kind>
PresetSurface<Kind> read_preset_surface(std::string_view id, std::string_view image, Query query,
                                        ValidationErrors& errors) {
    const auto& preset = preset_of<Kind>(id, "preset", errors);
    PresetSurface<Kind> requested{
        preset.id, read_image(image, errors), paint_of(params_of(preset)), {}};
    std::vector<std::pair<std::string, std::string>> rest;
    requested.version = take_version(query, rest, errors);
    std::vector<Problem> problems;
    read_query(rest, requested.paint, problems);
    add_problems(problems, requested.paint, "", false, errors);
    without_negative_zero(requested.paint);
    return requested;
}

/// Canonical address of an image without version.
template <class Kind, class Paint>
std::string canonical_image_address(const std::string& preset, ImageKind kind, const Paint& paint) {
    return with_query(
        std::string("/v1/surfaces/") + Kind::all + '/' + preset + '/' + name(kind) + ".jpg",
        query_text(paint, paint_of(own_params<Kind>(preset))));
}

/// {"leaves":[{"id","name","links"}]}
template <class Kind>
Value preset_list() {
    const std::string root = std::string("/v1/") + Kind::all + '/';
    Value list = Value::array();
    for (const auto& preset : Kind::presets()) {
        Value links = Value::object();
        links.set("self", root + preset.id + ".json").set("model", root + preset.id + ".glb");
        links.set("schema", root + "schema");
        Value item = Value::object().set("id", preset.id).set("name", preset.name);
        if constexpr (requires { Kind::tell(preset, item); }) Kind::tell(preset, item);
        list.push(std::move(item.set("links", std::move(links))));
    }
    return Value::object().set(Kind::all, std::move(list));
}

}  // namespace sporeprint::api
