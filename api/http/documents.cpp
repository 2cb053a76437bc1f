#include "api/http/documents.h"

#include <algorithm>
#include <array>
#include <fstream>
#include <iterator>
#include <system_error>
#include <utility>

#include "api/http/encoding.h"
#include "api/http/text.h"
#include "core/problems.h"

namespace sporeprint::api {

namespace {

constexpr std::array<std::pair<std::string_view, std::string_view>, 16> types = {{
    {".html", "text/html; charset=utf-8"},
    {".js", "text/javascript; charset=utf-8"},
    {".mjs", "text/javascript; charset=utf-8"},
    {".css", "text/css; charset=utf-8"},
    {".json", "application/json"},
    {".map", "application/json"},
    {".svg", "image/svg+xml"},
    {".txt", "text/plain; charset=utf-8"},
    {".png", "image/png"},
    {".jpg", "image/jpeg"},
    {".webp", "image/webp"},
    {".ico", "image/x-icon"},
    {".glb", "model/gltf-binary"},
    {".wasm", "application/wasm"},
    {".woff2", "font/woff2"},
    {".webmanifest", "application/manifest+json"},
}};

constexpr std::size_t largest_asset = 64u << 20;

}  // namespace

bool compressible(std::string_view content_type) {
    const std::string_view type = trimmed(content_type.substr(0, content_type.find(';')));
    return type.starts_with("text/") || type == "application/json" || type.ends_with("+json") ||
           type.ends_with("+xml") || type == "application/wasm";
}

std::string content_type_of(std::string_view file_name) {
    for (const auto& [ending, type] : types)
        if (lower(file_name).ends_with(ending)) return std::string(type);
    return "application/octet-stream";
}

bool has_hash(std::string_view file_name) {
    const std::string_view stem =
        file_name.substr(0, file_name.find('.', file_name.rfind('-') + 1));
    const std::size_t dash = stem.rfind('-');
    if (dash == std::string_view::npos || stem.size() - dash - 1 < 8 ||
        stem.size() == file_name.size())
        return false;
    const std::string_view hash = stem.substr(dash + 1);
    const auto is_digit = [](char c) { return c >= '0' && c <= '9'; };
    const auto is_letter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); };
    // esbuild writes eight capitals and digits, other tools write hexadecimal digits; a word such
    // as "settings" is no hash.
    const bool all =
        std::all_of(hash.begin(), hash.end(), [&](char c) { return is_digit(c) || is_letter(c); });
    const bool word =
        std::all_of(hash.begin(), hash.end(), [](char c) { return c >= 'a' && c <= 'z'; });
    return all && !word;
}

Document document(std::string content_type, std::string_view text, std::string_view cache_control) {
    Document out;
    out.content_type = std::move(content_type);
    out.cache_control = cache_control;
    out.etag = etag_of(text);
    out.body = slice_of(std::string(text));
    if (compressible(out.content_type)) out.gzipped = gzip({out.body});
    return out;
}

Document json_document(const Value& value, std::string_view content_type) {
    return document(std::string(content_type), dump(value) + '\n');
}

std::map<std::string, Document, std::less<>> read_assets(const std::filesystem::path& folder) {
    std::map<std::string, Document, std::less<>> out;
    std::error_code error;
    const std::filesystem::directory_iterator entries(folder, error);
    if (error) throw InvalidInput(folder.string(), "the folder cannot be read: " + error.message());
    for (const auto& entry : entries) {
        const std::string name = entry.path().filename().string();
        if (!entry.is_regular_file() || name.starts_with('.') || entry.file_size() > largest_asset)
            continue;
        std::ifstream file(entry.path(), std::ios::binary);
        const std::string text{std::istreambuf_iterator<char>(file), {}};
        const bool is_page = name.ends_with(".html");
        out.emplace(name, document(content_type_of(name), text,
                                   has_hash(name) ? immutable_for_a_year
                                   : is_page      ? revalidated
                                                  : cached_for_an_hour));
    }
    return out;
}

}  // namespace sporeprint::api
