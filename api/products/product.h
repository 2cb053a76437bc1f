// Functions common to requests for all products: version token, body, canonical URL, JSON
// description.
#pragma once

#include <algorithm>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "api/http/errors.h"
#include "api/http/response_builder.h"
#include "core/grow/product.h"
#include "core/params/describe.h"
#include "core/params/profile.h"
#include "core/params/query.h"
#include "core/params/value.h"

namespace sporeprint::api {

/// The decoded names and values of a query.
using Query = std::span<const std::pair<std::string, std::string>>;

/// What is generated: a file, its description, a picture, or the geometry of the file alone.
enum class Product { glb, json, png, bin };

/// Returns the extension of the file: ".glb", ".json", ".png" or ".bin".
[[nodiscard]] const char* ending_of(Product product);

/// Returns the media type of the file.
[[nodiscard]] const char* type_of(Product product);

/// Removes `v` from a query and returns it; the other parameters are appended to `rest`.
[[nodiscard]] std::optional<std::string> take_version(
    Query query, std::vector<std::pair<std::string, std::string>>& rest, ValidationErrors& errors);

/// Removes `v` from a body and returns it.
[[nodiscard]] std::optional<std::string> take_version(Value& body, std::vector<Problem>& problems);

/// Returns the profile that a query or body names; core if it names none. Names that are no profile
/// are reported when the parameters are read.
[[nodiscard]] Profile requested_profile(Query query);
[[nodiscard]] Profile requested_profile(const Value& body);

/// Returns which of the options that a profile sets a query or body names itself.
[[nodiscard]] NamedOptions named_options(Query query);
[[nodiscard]] NamedOptions named_options(const Value& body);

/// Returns the JSON object of a body; nothing, with the reason in `errors`, if it is none.
[[nodiscard]] std::optional<Value> read_body(std::string_view body, ValidationErrors& errors);

/// Adds the problems of reading `params` to `errors`: values that are each in range but impossible
/// together are 422, all others 400.
///
/// path    JSON pointer of `params` in the body; "" for the whole body, and for a query
/// posted  the problems name places in a body; otherwise they name parameters of a query
template <class Params>
void add_problems(const std::vector<Problem>& problems, const Params& params,
                  const std::string& path, bool posted, ValidationErrors& errors) {
    if (problems.empty()) return;
    std::vector<Problem> impossible;  // A value out of range was not assigned.
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

/// Replaces each -0 of a described struct by 0, so that equal keys cannot differ in the sign of a
/// zero.
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

/// Returns the current version token of products generated from `templates`: generator version,
/// '-', 8 hexadecimal digits of their hash.
[[nodiscard]] std::string token_of(std::string_view templates);

/// Returns a path with its query, if there is one.
[[nodiscard]] std::string with_query(std::string path, const std::string& query);

/// Returns the URL of the folder of a product: "/v1/mushrooms/" for "mushrooms".
[[nodiscard]] std::string folder_of(std::string_view product);

/// Appends `v` as the last parameter of a URL.
[[nodiscard]] std::string with_version(std::string address, std::string_view version);

/// Returns 410 for a version token that is not the current one, or a problem that precedes it.
///
/// parameter  name of the token: "v", or "/v" in a body
/// address    canonical URL with the current version; empty if there is none
[[nodiscard]] Response superseded(const ResponseBuilder& responses, const Request& request,
                                  const char* parameter, const std::string& requested,
                                  const std::string& version, const std::string& address,
                                  ValidationErrors& errors);

/// Returns a reference to the URL of an image from a file whose own URL has `depth` segments between
/// /v1/ and its name. The reference is relative, so that it is valid under any prefix; from a file
/// at depth 1 it stays below the file's folder, which some loaders require.
///
/// address  "/v1/mushrooms/..."; of the file's own product if depth is 1
/// depth    0 for /v1/mushrooms.glb, 1 for /v1/mushrooms/x.glb, 2 for /v1/morphs/a/b.glb
[[nodiscard]] std::string reference_from(int depth, std::string_view address);

/// Returns the same for the URLs of images.
[[nodiscard]] ImageUrls references_from(int depth, ImageUrls urls);

/// Returns the file name of an image in its folder: "base_color.jpg".
[[nodiscard]] std::string file_of(ImageKind kind, ImageFormat format);

/// Returns a query without the parameters of `Model` that `Image` lacks: some loaders append the
/// query of a model to the URLs of its images.
template <class Image, class Model>
[[nodiscard]] std::vector<std::pair<std::string, std::string>> without_parameters_of_model(
    Query query) {
    std::vector<std::pair<std::string, std::string>> rest;
    for (const auto& pair : query)
        if (is_query_name<Image>(pair.first) || !is_query_name<Model>(pair.first))
            rest.push_back(pair);
    return rest;
}

/// Makes parameters of a file those of its geometry alone, which other files name: it is of the file with linked images.
/// Options that such geometry cannot have are 422.
template <class Params>
void as_geometry(Params& params, ValidationErrors& errors) {
    params.textures = Textures::linked;
    const auto refuse = [&](bool is_impossible, const char* parameter) {
        if (is_impossible)
            errors.add(422, parameter,
                       "geometry alone is one mesh of plain numbers; ask for the .glb with it");
    };
    refuse(params.file.compress != Compression::none, "compress");
    refuse(params.file.lods != Lods::single, "lods");
    if constexpr (requires { params.animation; })
        refuse(params.animation != Animation::none, "animation");
}

/// Returns the URLs of all images of an atlas; `url` returns that of one kind and format.
[[nodiscard]] ImageUrls image_urls_of(
    const std::function<std::string(ImageKind, ImageFormat)>& url);

/// Reads the {image} of a URL; adds 404 if it is unknown.
[[nodiscard]] std::optional<ImageKind> read_image(std::string_view image, ValidationErrors& errors);

/// Returns the cost of the images in the formats that a file has: the painting once for each, and
/// the encoding of WebP.
///
/// painting  cost of painting them and encoding them as JPEG
/// texels    of all images of the file
[[nodiscard]] Cost cost_of_images(const FileOptions& file, const Cost& painting,
                                  std::uint64_t texels);

/// Returns the cost of drawing and encoding the frames of an impostor, beside that of generating what
/// they show.
///
/// estimated  estimate of the file
/// triangles  that each frame shows, each instance counted
/// throws     Impossible (path "/impostor" or "/lod") for more than a million
[[nodiscard]] Cost cost_of_impostor(const FileOptions& file, const Estimate& estimated,
                                    std::uint64_t triangles);

/// Returns members of the JSON description of a product.
[[nodiscard]] Value description(const Estimate& estimate);
[[nodiscard]] Value description(const Bounds& bounds);

}  // namespace sporeprint::api
