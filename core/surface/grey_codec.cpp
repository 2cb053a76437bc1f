#include "core/surface/grey_codec.h"

#include <png.h>

#include <algorithm>
#include <array>
#include <csetjmp>
#include <cstddef>
#include <cstring>

#include "core/problems.h"

namespace sporeprint {

namespace {

/// Bytes of the signature and of the first chunk, IHDR, with its length, name and sum.
constexpr std::size_t bytes_of_head = 8 + 25;

/// A file as libpng reads it.
struct Source {
    std::span<const std::uint8_t> file;
    std::size_t at = 0;
};

void read_bytes(png_structp decoder, png_bytep to, png_size_t size) {
    Source& source = *static_cast<Source*>(png_get_io_ptr(decoder));
    if (size > source.file.size() - source.at) png_error(decoder, "end of file");
    std::memcpy(to, source.file.data() + source.at, size);
    source.at += size;
}

/// Errors of libpng are reported by the caller; it has no output of its own.
[[noreturn]] void leave(png_structp decoder, png_const_charp) { png_longjmp(decoder, 1); }
void ignore(png_structp, png_const_charp) {}

/// Decodes into rows. It has no variables with destructors, past which libpng must not jump.
///
/// rows     with space for 2 bytes a pixel each
/// returns  whether the file is whole and nothing follows its last chunk
bool read_rows(Source& source, std::span<png_bytep> rows, int most, bool has_16_bits) {
    png_structp decoder = png_create_read_struct(PNG_LIBPNG_VER_STRING, nullptr, leave, ignore);
    png_infop info = decoder == nullptr ? nullptr : png_create_info_struct(decoder);
    if (info == nullptr || setjmp(png_jmpbuf(decoder)) != 0) {
        png_destroy_read_struct(&decoder, &info, nullptr);
        return false;
    }
    png_set_read_fn(decoder, &source, read_bytes);
    png_set_user_limits(decoder, static_cast<png_uint_32>(most), static_cast<png_uint_32>(most));
    // Chunks beside the pixels, which may be compressed, are skipped; errors of the pixels are errors.
    png_set_keep_unknown_chunks(decoder, PNG_HANDLE_CHUNK_NEVER, nullptr, -1);
    png_set_benign_errors(decoder, 0);
    png_read_info(decoder, info);
    if (has_16_bits) png_set_swap(decoder);  // a file has the high byte first
    static_cast<void>(png_set_interlace_handling(decoder));
    png_read_update_info(decoder, info);
    png_read_image(decoder, rows.data());
    png_read_end(decoder, nullptr);
    png_destroy_read_struct(&decoder, &info, nullptr);
    return source.at == source.file.size();
}

[[noreturn]] void refuse(const std::string& path, const std::string& message) {
    throw InvalidInput(path, message);
}

}  // namespace

DeclaredSize declared_grey_size(std::span<const std::uint8_t> file, int most,
                                const std::string& path) {
    constexpr std::array<std::uint8_t, 16> begin = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1A, '\n',
                                                    0,    0,   0,   13,  'I',  'H',  'D',  'R'};
    if (file.size() < bytes_of_head || !std::equal(begin.begin(), begin.end(), file.begin()))
        refuse(path, "this is not a PNG file");
    const auto word = [&](std::size_t at) {
        std::uint32_t value = 0;
        for (std::size_t i = at; i < at + 4; ++i) value = value << 8U | file[i];
        return value;
    };
    const std::uint32_t width = word(16), height = word(20);
    const auto largest = static_cast<std::uint32_t>(most);
    if (width < 1 || height < 1 || width > largest || height > largest)
        refuse(path, "the image has " + std::to_string(width) + " x " + std::to_string(height) +
                         " pixels; at most " + std::to_string(most) + " x " + std::to_string(most) +
                         " are allowed");
    const int depth = file[24], colours = file[25];
    if (colours != PNG_COLOR_TYPE_GRAY || (depth != 8 && depth != 16))
        refuse(path, "the image is not grey of 8 or 16 bits without transparency");
    return {static_cast<int>(width), static_cast<int>(height), depth};
}

GreyValues decoded_grey(std::span<const std::uint8_t> file, int most, const std::string& path) {
    const DeclaredSize size = declared_grey_size(file, most, path);
    GreyValues out{size.width, size.height, {}};
    const auto width = static_cast<std::size_t>(size.width),
               height = static_cast<std::size_t>(size.height);
    out.values.resize(width * height);
    const bool has_16_bits = file[24] == 16;
    // Bytes of 8 bits come into the second half of their row, so that they can be widened in place.
    std::vector<png_bytep> rows;
    rows.reserve(height);
    for (std::size_t row = 0; row < height; ++row)
        rows.push_back(reinterpret_cast<png_bytep>(&out.values[row * width]) +
                       (has_16_bits ? 0 : width));
    Source source{file};
    if (!read_rows(source, rows, most, has_16_bits))
        refuse(path, "the PNG file is broken, cut off, or followed by other bytes");
    if (!has_16_bits)
        for (std::size_t row = 0; row < height; ++row)
            for (std::size_t i = 0; i < width; ++i)
                out.values[row * width + i] = static_cast<std::uint16_t>(257U * rows[row][i]);
    return out;
}

}  // namespace sporeprint
