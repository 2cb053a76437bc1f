#include "server/bake/item.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "api/batch/labels.h"
#include "api/http/encoding.h"
#include "api/http/response_builder.h"
#include "api/http/response_text.h"
#include "api/products/product.h"
#include "server/bake/aside_file.h"

namespace sporeprint::server {

namespace {

constexpr std::size_t digits_of_keys = 9;

/// Hexadecimal digits that tell apart files whose names would be equal.
constexpr std::size_t digits_of_names = 8;

constexpr int first_server_error = 500;

/// Returns the problem of a response without the number of its request, by which nobody can find anything here.
Value lasting_problem_of(const api::Response& response) {
    Value problem = api::problem_of(response);
    problem.erase("instance");
    return problem;
}

/// Returns the name that a download of an item would have, made different from those of all other items.
std::string file_name_of(const BakedItem& item, std::string_view disposition) {
    constexpr std::string_view before = "filename=\"";
    std::string stem;
    const std::size_t at = disposition.find(before);
    if (at != disposition.npos) {
        stem = disposition.substr(at + before.size());
        stem.erase(std::min(stem.find('"'), stem.size()));
    } else {
        const std::string_view path =
            std::string_view(item.target).substr(0, item.target.find('?'));
        stem = path.substr(path.rfind('/') + 1);
    }
    stem.erase(std::min(stem.rfind('.'), stem.size()));
    for (char& c : stem)
        if (c == '/' || c == '\\' || c == '%' || static_cast<unsigned char>(c) < ' ') c = '_';
    return stem + "-" + api::digest_of(item.url).substr(0, digits_of_names) + "." +
           extension_of(item);
}

/// Returns the address of an item as a list spells it, with the version that its canonical address has in the query; the
/// canonical one where it has none there, or something was drawn.
std::string listed_of(const BakedItem& item) {
    const std::size_t query = item.url.find('?'), at = item.url.find("v=", query);
    if (!item.drawn.is_null() || query == item.url.npos || at == item.url.npos) return item.url;
    if (item.target.find("v=") != item.url.npos) return item.target;
    const std::size_t version = at + 2;
    return api::with_version(item.target,
                             item.url.substr(version, item.url.find('&', version) - version));
}

}  // namespace

BakedItem baked_item(api::Service& service, const api::BatchManifest& manifest,
                     std::uint64_t number) {
    const api::BatchItem planned = manifest.item(number);
    BakedItem out;
    out.number = number;
    out.target = planned.target;
    if (!planned.drawn.empty()) out.drawn = Value(planned.drawn);
    api::Request request;
    request.method = "GET";
    request.target = planned.target;
    const api::Response response = api::handle(service, request);
    out.status = response.status;
    if (response.status >= first_server_error)
        throw std::runtime_error("item " + std::to_string(number) + " (" + planned.target +
                                 ") could not be made: " + dump(lasting_problem_of(response)));
    if (out.failed()) {
        out.problem = lasting_problem_of(response);
        return out;
    }
    out.body = response.body;
    out.url = api::header_of(response, "Content-Location");
    if (out.url.empty()) out.url = planned.target;
    out.etag = api::header_of(response, "ETag");
    out.type = api::header_of(response, "Content-Type");
    out.encoding = api::header_of(response, "Content-Encoding");
    Sha256 sha256;
    for (const Slice& slice : out.body) sha256.add(slice.data(), slice.size);
    out.sha256 = sha256.hex();
    out.file = file_name_of(out, api::header_of(response, "Content-Disposition"));
    if (manifest.has_labels()) out.labels = api::labels_of(out.body);
    return out;
}

std::string padded(std::uint64_t number, std::size_t least) {
    const std::string digits = std::to_string(number);
    return std::string(least - std::min(least, digits.size()), '0') + digits;
}

std::string key_of(std::uint64_t number) { return padded(number, digits_of_keys); }

std::string extension_of(const BakedItem& item) {
    const std::string_view extension = api::extension_of(item.target);
    return extension.empty() ? "bin" : std::string(extension);
}

std::string labels_text(const BakedItem& item) {
    if (extension_of(item) == "json") return {};
    Value labels = Value::object();
    labels.set("url", Value(item.url)).set("etag", Value(item.etag));
    if (!item.drawn.is_null()) labels.set("drawn", item.drawn);
    if (!item.labels.is_null()) labels.set("labels", item.labels);
    return dump(labels) + "\n";
}

std::string index_line(const BakedItem& item, Value::Member place) {
    Value line = Value::object();
    line.set("key", Value(key_of(item.number)));
    if (item.failed()) {
        line.set("target", Value(item.target)).set("status", Value(item.status));
    } else {
        line.set("url", Value(item.url))
            .set("etag", Value(item.etag))
            .set("type", Value(item.type));
        if (const std::string listed = listed_of(item); listed != item.url)
            line.set("listed", Value(listed));
        if (!item.encoding.empty()) line.set("encoding", Value(item.encoding));
        line.set("sha256", Value(item.sha256)).set("bytes", Value(size_of(item.body)));
        line.set(place.first, std::move(place.second));
    }
    if (!item.drawn.is_null()) line.set("drawn", item.drawn);
    if (!item.labels.is_null()) line.set("labels", item.labels);
    if (item.failed()) line.set("problem", item.problem);
    return dump(line);
}

}  // namespace sporeprint::server
