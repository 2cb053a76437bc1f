// Files of photographs: bounded before anything is decoded, upright, and without anything but their pixels.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

#include "core/surface/codecs.h"

namespace sporeprint {

/// Bounds of an uploaded photograph: bytes of the file, pixels of a side, and pixels in all. PNG, WebP and
/// progressive JPEG files have a bound of their own, for they are whole in memory while they are decoded,
/// and so have interlaced PNG files, which take longest for their bytes.
inline constexpr std::size_t most_photo_bytes = std::size_t{12} << 20U;
inline constexpr int most_photo_side = 12'000;
inline constexpr std::uint64_t most_photo_pixels = 50'000'000, most_whole_pixels = 25'000'000,
                               most_interlaced_pixels = 4'000'000;

/// A picture with alpha.
struct LayeredPicture {
    Picture picture;  ///< where it is transparent, white paper shows through
    Bytes alpha;      ///< of each pixel; empty if the format has none
};

/// Returns the orientation that a JPEG file states in its Exif data, 1..8; 1 if it states none that is valid.
/// Nothing else of the data is read.
[[nodiscard]] int orientation_of(std::span<const std::uint8_t> file);

/// Returns a picture as it is seen, by the orientation of the Exif standard.
///
/// orientation  1..8: 3 is upside down, 6 and 8 lie on a side, 2, 4, 5 and 7 are mirrored too
[[nodiscard]] Picture upright(const Picture& picture, int orientation);

/// Returns the pixels that a JPEG, PNG or WebP file declares in its header; 0 if it is no such file.
///
/// cost  microseconds
[[nodiscard]] std::uint64_t declared_photo_pixels(std::span<const std::uint8_t> file);

/// Decodes a JPEG, PNG or WebP file, whatever its name says. A JPEG file is decoded at the greatest scale of 1,
/// 1/2, 1/4 and 1/8 at which its longest side is no longer than a bound, or at 1/8.
///
/// longest_side  pixels
/// path          reported in InvalidInput, e.g. "/photo"
/// throws        InvalidInput for another format, a broken or animated file, or one beyond the bounds; these
///               are checked on its header, before any pixel is decoded
/// cost          about 30 ms for 12 million pixels of a JPEG file
[[nodiscard]] LayeredPicture decoded_layers(std::span<const std::uint8_t> file, int longest_side,
                                            const std::string& path);

}  // namespace sporeprint
