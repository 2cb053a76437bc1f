// Image codecs: RGB pixels to JPEG, and an uploaded PNG, JPEG or WebP to RGB pixels.
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "core/bytes.h"

namespace sporeprint {

/// Rows from top to bottom, three bytes a pixel, without padding.
struct Picture {
    int width = 0;
    int height = 0;
    Bytes rgb;
};

/// Largest width and height of an uploaded image.
inline constexpr int largest_upload_side = 2048;

/// How finely a JPEG keeps colour: at half the resolution of the brightness, or in full.
enum class Chroma { halved, full };

/// JPEG file of an image, by the slow exact transform: the same bytes with any instruction set.
///
/// rgb      3 * width * height bytes
/// quality  1..100
/// throws   GenerationError if the encoder fails
[[nodiscard]] Bytes jpeg(std::span<const std::uint8_t> rgb, int width, int height, int quality,
                         Chroma chroma);

/// Pixels of an uploaded image, told by its first bytes; transparency is dropped, animation is
/// refused.
/// The size is read and checked before any pixel is decoded.
///
/// path     what InvalidInput names, e.g. "/surface/cap/image"
/// throws   InvalidInput if it is none of the three, broken, or larger than 2048 x 2048
[[nodiscard]] Picture decoded_picture(std::span<const std::uint8_t> file, const std::string& path);

}  // namespace sporeprint
