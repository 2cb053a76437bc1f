// Documents that are computed when the service starts: files of the page, schemas, OpenAPI,
// species.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <string_view>

#include "core/bytes.h"
#include "core/params/value.h"

namespace sporeprint::api {

/// A representation and its gzip variant, which is compressed once.
struct Document {
    std::string content_type;
    std::string cache_control;
    std::string etag;
    Slice body;
    Slice gzipped;  ///< empty when the type is not worth compressing
};

inline constexpr const char* cached_for_an_hour =
    "public, max-age=3600, stale-while-revalidate=86400";
inline constexpr const char* immutable_for_a_year = "public, max-age=31536000, immutable";
inline constexpr const char* revalidated = "no-cache";

/// Cache-Control of what nobody but the client may have, and no cache may store.
inline constexpr const char* private_to_client = "private, no-store";

/// Returns true if bodies of a media type are sent as gzip to clients that accept it: text, JSON,
/// JavaScript, SVG.
[[nodiscard]] bool compressible(std::string_view content_type);

/// Returns the media type of a file by the extension of its name.
[[nodiscard]] std::string content_type_of(std::string_view file_name);

/// Returns true if a file name contains a hash ("app-3F9A1C02.js"), so that its content never
/// changes.
[[nodiscard]] bool has_hash(std::string_view file_name);

[[nodiscard]] Document document(std::string content_type, std::string_view text,
                                std::string_view cache_control = cached_for_an_hour);
[[nodiscard]] Document json_document(const Value& value,
                                     std::string_view content_type = "application/json");

/// Reads the files of a folder once and returns them by name. Names that begin with '.' and files
/// over 64 MB are left out.
///
/// throws  InvalidInput if the folder cannot be read
[[nodiscard]] std::map<std::string, Document, std::less<>> read_assets(
    const std::filesystem::path& folder);

}  // namespace sporeprint::api
