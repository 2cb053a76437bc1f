#include "api/batch/labels.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "core/problems.h"

namespace sporeprint::api {

namespace {

// A GLB file begins with its magic, version and length; then come the length and the type of the JSON chunk.
constexpr std::size_t length_at = 12, json_at = 20;
constexpr std::string_view magic = "glTF", json_type = "JSON";

std::uint32_t number_at(std::string_view bytes, std::size_t at) {
    std::uint32_t number = 0;
    for (std::size_t i = 4; i-- > 0;)
        number = number << 8U | static_cast<unsigned char>(bytes[at + i]);
    return number;
}

/// Returns the first bytes of a body, as many as there are of so many.
std::string first_of(const Body& body, std::size_t count) {
    std::string out;
    for (const Slice& slice : body) {
        if (out.size() >= count) break;
        out.append(reinterpret_cast<const char*>(slice.data()),
                   std::min(slice.size, count - out.size()));
    }
    return out;
}

}  // namespace

Value labels_of(const Body& body) {
    const std::string head = first_of(body, json_at);
    if (head.size() < json_at || !head.starts_with(magic) ||
        std::string_view(head).substr(length_at + 4, 4) != json_type)
        return {};
    const std::size_t length = number_at(head, length_at);
    const std::string text = first_of(body, json_at + length);
    if (text.size() < json_at + length) return {};
    std::vector<Problem> problems;
    const Value file = parse(std::string_view(text).substr(json_at), problems);
    const Value* const extras = file.at_pointer("/asset/extras");
    return problems.empty() && extras != nullptr ? *extras : Value();
}

std::string_view extension_of(std::string_view target) {
    std::string_view path = target.substr(0, target.find('?'));
    path.remove_prefix(path.rfind('/') == path.npos ? 0 : path.rfind('/') + 1);
    const std::size_t dot = path.rfind('.');
    return dot == path.npos ? std::string_view() : path.substr(dot + 1);
}

}  // namespace sporeprint::api
