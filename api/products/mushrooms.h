// Requests for mushrooms: from an address or a body to a MushroomSpec, and back to the canonical address and key.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "api/products/product.h"
#include "core/atlas/atlas.h"
#include "core/individual/mushroom_spec.h"

namespace sporeprint::api {

/// An order with what is to be made of it and the version token that came along.
struct MushroomRequest {
    MushroomSpec spec;
    Product product = Product::glb;
    std::optional<std::string> version;
};

/// Reads the {mix} and the query of an address. Whatever is wrong goes to `faults`, all of it.
[[nodiscard]] MushroomRequest read_mushroom(std::string_view mix, Query query, const Atlas& atlas,
                                            ValidationErrors& errors);

/// Reads a body: {"mix":{id:weight}} or {"model":{…}}, beside the query parameters nested ("weathering":{"fade":0.4}).
[[nodiscard]] MushroomRequest read_mushroom(std::string_view body, const Atlas& atlas,
                                            ValidationErrors& errors);

/// Today's version token of what a mix (or, when empty, a model) is made with: generator version, '-', 8 hexadecimal digits of
/// the hash of the templates used.
[[nodiscard]] std::string version_token(const Mix& mix, const Atlas& atlas);

/// Canonical address without version: path with the canonical mix, then what differs from its default, in schema order.
/// The order has no model.
[[nodiscard]] std::string canonical_address(const MushroomSpec& spec,
                                            Product product = Product::glb);

/// Full canonical text of all values, with product, generator version and templates: equal keys, equal bytes.
[[nodiscard]] std::string key_of(const MushroomSpec& spec, Product product,
                                 std::string_view version);

/// "amanita_muscaria-7.glb"
[[nodiscard]] std::string file_name(const MushroomSpec& spec, Product product);

}  // namespace sporeprint::api
