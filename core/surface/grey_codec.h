// PNG files of grey values that others have made, decoded within bounds.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace sporeprint {

/// Grey values: rows from top to bottom, without padding.
struct GreyValues {
    int width = 0, height = 0;
    std::vector<std::uint16_t> values;  ///< 0..65535; those of 8 bits times 257
};

/// What the header of a PNG file declares.
struct DeclaredSize {
    int width = 0, height = 0;
    int bits = 16;  ///< of a value, 8 or 16
};

/// Returns the size that the header of a PNG file of grey values declares.
///
/// most    largest width and height
/// path    JSON path reported in InvalidInput, such as "/masks/trees"
/// throws  InvalidInput for a file that is no PNG, is not grey of 8 or 16 bits (without alpha), or is larger
[[nodiscard]] DeclaredSize declared_grey_size(std::span<const std::uint8_t> file, int most,
                                              const std::string& path);

/// Decodes a PNG file of grey values. Its gamma and all that is beside the pixels is ignored.
///
/// throws  InvalidInput as declared_grey_size(), or for a file that is broken or does not end with its last chunk
[[nodiscard]] GreyValues decoded_grey(std::span<const std::uint8_t> file, int most,
                                      const std::string& path);

}  // namespace sporeprint
