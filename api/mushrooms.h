// Requests for mushrooms: from an address or a body to a MushroomOrder, and back to the canonical address and key.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "api/errors.h"
#include "core/atlas/atlas.h"
#include "core/model/request.h"

namespace sporeprint::api {

/// What is made of an order.
enum class Product { glb, json };

/// An order with what is to be made of it and the version token that came along.
struct MushroomRequest {
    MushroomOrder order;
    Product product = Product::glb;
    std::optional<std::string> version;
};

/// Takes `v` out of a query; what remains goes to `rest`.
[[nodiscard]] std::optional<std::string> take_version(
    std::span<const std::pair<std::string, std::string>> query,
    std::vector<std::pair<std::string, std::string>>& rest, Faults& faults);

/// Takes `v` out of a body.
[[nodiscard]] std::optional<std::string> take_version(Value& body, std::vector<Problem>& problems);

/// Reads the {mix} and the query of an address. Whatever is wrong goes to `faults`, all of it.
[[nodiscard]] MushroomRequest read_mushroom(
    std::string_view mix, std::span<const std::pair<std::string, std::string>> query,
    const Atlas& atlas, Faults& faults);

/// Reads a body: {"mix":{id:weight}} or {"model":{…}}, beside the query parameters nested ("weathering":{"fade":0.4}).
[[nodiscard]] MushroomRequest read_mushroom(std::string_view body, const Atlas& atlas,
                                            Faults& faults);

/// Makes each -0 of a described struct 0, so that equal keys cannot differ in the sign of a zero.
template <class T>
void without_negative_zero(T& value) {
    if constexpr (Described<T>) {
        T::fields([&](auto member, const Info&) { without_negative_zero(value.*member); });
    } else if constexpr (is_variant<T>) {
        std::visit([](auto& one) { without_negative_zero(one); }, value);
    } else if constexpr (is_optional<T>) {
        if (value) without_negative_zero(*value);
    } else if constexpr (is_list<T>) {
        for (auto& item : value) without_negative_zero(item);
    } else if constexpr (std::is_floating_point_v<T>) {
        value += T{};
    }
}

/// Today's version token of what a mix (or, when empty, a model) is made with: generator version, '-', 8 hexadecimal digits of
/// the hash of the templates used.
[[nodiscard]] std::string version_token(const Mix& mix, const Atlas& atlas);

/// Canonical address without version: path with the canonical mix, then what differs from its default, in schema order.
/// The order has no model.
[[nodiscard]] std::string canonical_address(const MushroomOrder& order,
                                            Product product = Product::glb);

/// Appends `v` as the last parameter.
[[nodiscard]] std::string with_version(std::string address, std::string_view version);

/// Full canonical text of all values, with product, generator version and templates: equal keys, equal bytes.
[[nodiscard]] std::string key_of(const MushroomOrder& order, Product product,
                                 std::string_view version);

/// "amanita_muscaria-7.glb"
[[nodiscard]] std::string file_name(const MushroomOrder& order, Product product);

}  // namespace sporeprint::api
