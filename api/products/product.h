// What requests for all products have in common: version token, body, canonical address, what their JSON tells.
#pragma once

#include <algorithm>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "api/http/errors.h"
#include "core/grow/product.h"
#include "core/params/describe.h"
#include "core/params/query.h"
#include "core/params/value.h"

namespace sporeprint::api {

/// The decoded names and values of a query.
using Query = std::span<const std::pair<std::string, std::string>>;

/// What is made of an order.
enum class Product { glb, json };

/// Ending of the name of what is made: ".glb" or ".json".
[[nodiscard]] const char* ending_of(Product product);

/// Media type of what is made.
[[nodiscard]] const char* type_of(Product product);

/// Takes `v` out of a query; what remains goes to `rest`.
[[nodiscard]] std::optional<std::string> take_version(
    Query query, std::vector<std::pair<std::string, std::string>>& rest, ValidationErrors& errors);

/// Takes `v` out of a body.
[[nodiscard]] std::optional<std::string> take_version(Value& body, std::vector<Problem>& problems);

/// The JSON object of a body; empty, with the reason in `faults`, when it is none.
[[nodiscard]] std::optional<Value> read_body(std::string_view body, ValidationErrors& errors);

/// Adds what was found while `params` were read: values that are each in range but impossible together are 422, all else is 400.
///
/// path    JSON pointer of `params` in the body; "" for all of it, and for a query
/// posted  the problems name places in a body; otherwise they name parameters of a query
template <class Params>
void add_problems(const std::vector<Problem>& problems, const Params& params,
                  const std::string& path, bool posted, ValidationErrors& errors) {
    if (problems.empty()) return;
    std::vector<Problem> impossible;  // A value out of its range was not taken over.
    check(params, Info{.name = ""}, path, impossible);
    for (const Problem& problem : problems) {
        const bool together =
            std::any_of(impossible.begin(), impossible.end(), [&](const Problem& one) {
                return (posted ? one.path : query_name(one.path)) == problem.path &&
                       one.message == problem.message;
            });
        errors.add(together ? 422 : 400, problem.path, problem.message);
    }
}

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

/// Today's version token of what is made with `templates`: generator version, '-', 8 hexadecimal digits of their hash.
[[nodiscard]] std::string token_of(std::string_view templates);

/// A path and its query, where there is one.
[[nodiscard]] std::string with_query(std::string path, const std::string& query);

/// Appends `v` as the last parameter.
[[nodiscard]] std::string with_version(std::string address, std::string_view version);

/// Reference to an address under /v1 from a document whose own address has `depth` segments between /v1/ and its name: relative, so
/// that it holds under any prefix.
///
/// address  "/v1/surfaces/..."
/// depth    0 for /v1/mushrooms.glb, 1 for /v1/mushrooms/x.glb, 2 for /v1/morphs/a/b.glb
[[nodiscard]] std::string reference_from(int depth, std::string_view address);

/// Reads the {image} of an address; 404 for none of them.
[[nodiscard]] std::optional<ImageKind> read_image(std::string_view image, ValidationErrors& errors);

/// Members of what the JSON of a product tells.
[[nodiscard]] Value description(const Estimate& estimate);
[[nodiscard]] Value description(const Bounds& bounds);

}  // namespace sporeprint::api
