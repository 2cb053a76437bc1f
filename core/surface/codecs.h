// Image codecs: pixels to JPEG, WebP or PNG, and an uploaded PNG, JPEG or WebP file to RGB pixels.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "core/bytes.h"

namespace sporeprint {

/// Decoded pixels: rows from top to bottom, three bytes per pixel, without padding.
struct Picture {
    int width = 0;
    int height = 0;
    Bytes rgb;
};

/// Largest width and height of an uploaded image, pixels.
inline constexpr int largest_upload_side = 2048;

/// Chroma resolution of a JPEG: half that of the luma, or full.
enum class Chroma { halved, full };

/// Encodes an image as a JPEG file with the accurate integer transform, so that the bytes are the
/// same with any instruction set.
///
/// rgb      3 * width * height bytes
/// quality  1..100
/// throws   GenerationError if the encoder fails
[[nodiscard]] Bytes jpeg(std::span<const std::uint8_t> rgb, int width, int height, int quality,
                         Chroma chroma);

/// Encodes an image as a lossy WebP file (VP8, chroma of half the resolution) by method 2 of 6:
/// the next one saves 4 % of the bytes in twice the time.
///
/// rgb      3 * width * height bytes
/// quality  0..100
/// throws   GenerationError if the encoder fails
[[nodiscard]] Bytes webp(std::span<const std::uint8_t> rgb, int width, int height, int quality);

/// Does the same for an image with alpha, which is stored without loss; colours of texels without
/// alpha stay as they are.
///
/// rgba  4 * width * height bytes; colours are not multiplied by alpha
[[nodiscard]] Bytes webp_with_alpha(std::span<const std::uint8_t> rgba, int width, int height,
                                    int quality);

/// Encodes an image as a PNG file.
///
/// rgba    4 * width * height bytes; colours are not multiplied by alpha
/// throws  GenerationError if the encoder fails
[[nodiscard]] Bytes png(std::span<const std::uint8_t> rgba, int width, int height);

/// Keywords and texts of a file, ASCII.
using ImageTexts = std::vector<std::pair<std::string, std::string>>;

/// Encodes numbers of 16 bits as a grey PNG file without a colour space.
///
/// numbers  width * height, rows from top to bottom
/// texts    stored as tEXt
/// throws   GenerationError if the encoder fails
[[nodiscard]] Bytes png_of_numbers(std::span<const std::uint16_t> numbers, int width, int height,
                                   const ImageTexts& texts);

/// Encodes numbers of 24 bits, the highest byte first, as an RGB PNG file without a colour space.
///
/// rgb  3 * width * height bytes
[[nodiscard]] Bytes png_of_numbers(std::span<const std::uint8_t> rgb, int width, int height,
                                   const ImageTexts& texts);

/// The colour of a number of a palette, sRGB.
using PaletteColour = std::array<std::uint8_t, 3>;

/// Encodes numbers of a palette of at most 256 colours as a PNG file of 8 bits.
///
/// numbers  width * height, each less than the number of colours
[[nodiscard]] Bytes png_of_palette(std::span<const std::uint8_t> numbers, int width, int height,
                                   std::span<const PaletteColour> palette, const ImageTexts& texts);

/// Returns the number of pixels that decoded_picture() will decode, as the header of the file
/// declares it; 0 if decoded_picture() refuses the file by its header.
///
/// cost  microseconds
[[nodiscard]] std::uint64_t declared_pixels(std::span<const std::uint8_t> file);

/// Decodes an uploaded image, whose format is detected by its first bytes. Transparency is dropped,
/// animation is refused. The size is checked before any pixel is decoded.
///
/// path     JSON path reported in InvalidInput, e.g. "/surface/cap/image"
/// throws   InvalidInput if the format is not one of the three, the file is broken, or larger than
///          2048 x 2048
[[nodiscard]] Picture decoded_picture(std::span<const std::uint8_t> file, const std::string& path);

/// Decodes the alpha of a PNG file of this generator as a grey picture.
[[nodiscard]] Picture decoded_alpha(std::span<const std::uint8_t> file, const std::string& path);

/// Decodes an image of this generator, a JPEG file at a half, a quarter or an eighth of its size if
/// neither side is then less than `least_side`, which takes less time.
[[nodiscard]] Picture decoded_smaller(std::span<const std::uint8_t> file, const std::string& path,
                                      int least_side);

}  // namespace sporeprint
