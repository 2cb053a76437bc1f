// Uploaded photographs as they are traced.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "core/surface/photo_codecs.h"
#include "core/trace/photo.h"

namespace sporeprint::trace {

/// Longest side of a decoded photograph, pixels; larger ones are made smaller.
inline constexpr int decoded_side = 2048;

/// A decoded photograph.
struct PhotoFile {
    Picture picture;
    /// The pixels that are at least half opaque, of a picture that is cut out already: between 2 and 98 % of
    /// it are transparent.
    std::optional<Mask> cut_out;
};

/// Decodes a JPEG, PNG or WebP file within the bounds of core/surface/photo_codecs.h. A picture that is cut out
/// and reaches the border of its file is whole, so it gets a border of white paper, 2 % of its longest side.
///
/// path    reported in InvalidInput, e.g. "/photo"
/// throws  InvalidInput, see decoded_layers()
[[nodiscard]] PhotoFile decoded_photo(std::span<const std::uint8_t> file, const std::string& path);

}  // namespace sporeprint::trace
