// Requests for colonies: from an address or a body to a ColonySpec, and back to the canonical address and key.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "api/products/product.h"
#include "core/atlas/atlas.h"
#include "core/colony/colony_spec.h"

namespace sporeprint::api {

/// An order with what is to be made of it and the version token that came along.
struct ColonyRequest {
    ColonySpec spec;
    Product product = Product::glb;
    std::optional<std::string> version;
};

/// Reads the {mix} and the query of an address. Whatever is wrong goes to `faults`, all of it.
[[nodiscard]] ColonyRequest read_colony(std::string_view mix, Query query, const Atlas& atlas,
                                        ValidationErrors& errors);

/// Reads a body: {"mix":{id:weight}} beside the query parameters.
[[nodiscard]] ColonyRequest read_colony(std::string_view body, const Atlas& atlas,
                                        ValidationErrors& errors);

/// Canonical address without version: path with the canonical mix, then what differs from its default, in schema order.
[[nodiscard]] std::string canonical_address(const ColonySpec& spec, Product product = Product::glb);

/// Full canonical text of all values, with product, generator version and templates: equal keys, equal bytes.
[[nodiscard]] std::string key_of(const ColonySpec& spec, Product product, std::string_view version);

/// "armillaria_mellea-colony-7.glb"
[[nodiscard]] std::string file_name(const ColonySpec& spec, Product product);

}  // namespace sporeprint::api
