// Grey PNG files, also broken ones, written chunk by chunk.
#pragma once

#include <zlib.h>

#include <cstdint>
#include <string_view>
#include <vector>

#include "core/bytes.h"

namespace sporeprint {

/// What the header of a file declares.
struct PngHeader {
    std::uint32_t width = 1, height = 1;
    std::uint8_t depth = 8, colours = 0;  ///< colours: 0 for grey
};

inline void append_word(Bytes& out, std::uint32_t word) {
    for (int shift = 24; shift >= 0; shift -= 8)
        out.push_back(static_cast<std::uint8_t>(word >> shift & 255U));
}

inline void append_chunk(Bytes& file, std::string_view name, const Bytes& data) {
    append_word(file, static_cast<std::uint32_t>(data.size()));
    Bytes chunk(name.begin(), name.end());
    chunk.insert(chunk.end(), data.begin(), data.end());
    file.insert(file.end(), chunk.begin(), chunk.end());
    append_word(file, static_cast<std::uint32_t>(
                          crc32(0, chunk.data(), static_cast<unsigned>(chunk.size()))));
}

/// Returns a PNG file.
///
/// rows  bytes of its rows, each after the number of its filter
inline Bytes png_file(const PngHeader& header, const Bytes& rows) {
    Bytes file = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1A, '\n'}, head;
    append_word(head, header.width);
    append_word(head, header.height);
    for (const int byte : {int{header.depth}, int{header.colours}, 0, 0, 0})
        head.push_back(static_cast<std::uint8_t>(byte));
    append_chunk(file, "IHDR", head);
    uLongf size = compressBound(static_cast<uLong>(rows.size()));
    Bytes packed(size);
    compress(packed.data(), &size, rows.data(), static_cast<uLong>(rows.size()));
    packed.resize(size);
    append_chunk(file, "IDAT", packed);
    append_chunk(file, "IEND", {});
    return file;
}

/// Returns a square PNG file of 8 bits.
///
/// value  returns the value of a column and a row, 0..255
template <class Value>
Bytes grey_png(int side, const Value& value) {
    Bytes rows;
    for (int row = 0; row < side; ++row) {
        rows.push_back(0);
        for (int column = 0; column < side; ++column)
            rows.push_back(static_cast<std::uint8_t>(value(column, row)));
    }
    const auto length = static_cast<std::uint32_t>(side);
    return png_file({length, length, 8, 0}, rows);
}

}  // namespace sporeprint
