#include "core/surface/codecs.h"

#include <png.h>
#include <turbojpeg.h>
#include <webp/decode.h>
#include <webp/encode.h>
#include <zlib.h>

#include <algorithm>
#include <csetjmp>
#include <cstddef>
#include <cstring>
#include <memory>
#include <vector>

#include "core/problems.h"

namespace sporeprint {
namespace {

struct TurboFree {
    void operator()(void* handle) const { tjDestroy(handle); }
};
using TurboHandle = std::unique_ptr<void, TurboFree>;

[[noreturn]] void refuse(const std::string& path, const std::string& why) {
    throw InvalidInput(path, why);
}

void check_size(long long width, long long height, const std::string& path) {
    if (width < 1 || height < 1) refuse(path, "the image has no pixels");
    if (width > largest_upload_side || height > largest_upload_side)
        refuse(path, "the image is " + std::to_string(width) + " x " + std::to_string(height) +
                         " pixels; at most " + std::to_string(largest_upload_side) + " x " +
                         std::to_string(largest_upload_side) + " are allowed");
}

Picture empty_picture(int width, int height) {
    Picture picture;
    picture.width = width;
    picture.height = height;
    picture.rgb.resize(static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * 3);
    return picture;
}

// A progressive file may repeat its scans thousands of times in few bytes; real files have about
// ten.
bool has_too_many_scans(std::span<const std::uint8_t> file) {
    int scans = 0;
    for (std::size_t i = 0; i + 1 < file.size(); ++i)
        if (file[i] == 0xFF && file[i + 1] == 0xDA && ++scans > 64) return true;
    return false;
}

/// least_side  the file is decoded at the least scale at which no side is less; 0: at its own
Picture decoded_jpeg(std::span<const std::uint8_t> file, const std::string& path,
                     int least_side = 0) {
    const TurboHandle handle(tjInitDecompress());
    if (!handle) throw GenerationError("no JPEG decoder");
    int width = 0, height = 0, subsampling = 0, colours = 0;
    if (tjDecompressHeader3(handle.get(), file.data(), static_cast<unsigned long>(file.size()),
                            &width, &height, &subsampling, &colours) != 0)
        refuse(path, "not a readable JPEG file");
    check_size(width, height, path);
    if (has_too_many_scans(file)) refuse(path, "the JPEG file has too many scans");
    int scale = 1;
    while (least_side > 0 && scale < 8 && std::min(width, height) / (2 * scale) >= least_side)
        scale *= 2;
    Picture picture = empty_picture((width + scale - 1) / scale, (height + scale - 1) / scale);
    const int flags = TJFLAG_ACCURATEDCT | TJFLAG_STOPONWARNING | TJFLAG_LIMITSCANS;
    if (tjDecompress2(handle.get(), file.data(), static_cast<unsigned long>(file.size()),
                      picture.rgb.data(), picture.width, 0, picture.height, TJPF_RGB, flags) != 0)
        refuse(path, "not a readable JPEG file");
    return picture;
}

/// Returns the colours of a PNG file, or its alpha as grey.
Picture decoded_png(std::span<const std::uint8_t> file, const std::string& path,
                    bool is_alpha = false) {
    png_image image;
    std::memset(&image, 0, sizeof image);
    image.version = PNG_IMAGE_VERSION;
    if (png_image_begin_read_from_memory(&image, file.data(), file.size()) == 0)
        refuse(path, "not a readable PNG file");
    struct Release {
        png_image* image;
        ~Release() { png_image_free(image); }
    } release{&image};
    check_size(image.width, image.height, path);
    image.format = PNG_FORMAT_RGBA;  // straight alpha: colours are unchanged by it
    Bytes rgba(PNG_IMAGE_SIZE(image));
    Picture picture = empty_picture(static_cast<int>(image.width), static_cast<int>(image.height));
    if (png_image_finish_read(&image, nullptr, rgba.data(), 0, nullptr) == 0)
        refuse(path, "not a readable PNG file");
    for (std::size_t from = 0, to = 0; to < picture.rgb.size(); from += 4, to += 3)
        if (is_alpha)
            std::memset(&picture.rgb[to], rgba[from + 3], 3);
        else
            std::memcpy(&picture.rgb[to], &rgba[from], 3);
    return picture;
}

Picture decoded_webp(std::span<const std::uint8_t> file, const std::string& path) {
    WebPBitstreamFeatures features;
    if (WebPGetFeatures(file.data(), file.size(), &features) != VP8_STATUS_OK)
        refuse(path, "not a readable WebP file");
    check_size(features.width, features.height, path);
    if (features.has_animation != 0)
        refuse(path, "an animated WebP file is not an image of a surface");
    Picture picture = empty_picture(features.width, features.height);
    if (WebPDecodeRGBInto(file.data(), file.size(), picture.rgb.data(), picture.rgb.size(),
                          3 * features.width) == nullptr)
        refuse(path, "not a readable WebP file");
    return picture;
}

bool starts_with(std::span<const std::uint8_t> file, const char* magic, std::size_t size,
                 std::size_t at = 0) {
    return file.size() >= at + size && std::memcmp(file.data() + at, magic, size) == 0;
}

}  // namespace

Bytes jpeg(std::span<const std::uint8_t> rgb, int width, int height, int quality, Chroma chroma) {
    thread_local const TurboHandle handle(tjInitCompress());
    if (!handle) throw GenerationError("no JPEG encoder");
    const int subsampling = chroma == Chroma::halved ? TJSAMP_420 : TJSAMP_444;
    // The buffer has the size of the worst case; pages that are not written are never touched.
    const std::size_t capacity = tjBufSize(width, height, subsampling);
    const auto buffer = std::make_unique_for_overwrite<unsigned char[]>(capacity);
    unsigned char* out = buffer.get();
    unsigned long size = static_cast<unsigned long>(capacity);
    if (tjCompress2(handle.get(), rgb.data(), width, 0, height, TJPF_RGB, &out, &size, subsampling,
                    quality, TJFLAG_NOREALLOC | TJFLAG_ACCURATEDCT) != 0)
        throw GenerationError(std::string("JPEG encoder: ") + tjGetErrorStr2(handle.get()));
    return Bytes(out, out + size);
}

namespace {

/// Imports pixels into a picture of the WebP encoder; returns 0 if that fails.
using WebPImport = int (*)(WebPPicture*, const std::uint8_t*, int);

Bytes encoded_webp(const std::uint8_t* pixels, int bytes_of_pixel, WebPImport import, int width,
                   int height, int quality) {
    WebPConfig config;
    WebPPicture picture;
    if (WebPConfigPreset(&config, WEBP_PRESET_DEFAULT, static_cast<float>(quality)) == 0 ||
        WebPPictureInit(&picture) == 0)
        throw GenerationError("no WebP encoder of this version");
    config.method = 2;
    // Filters read colours beside an outline too.
    config.exact = 1;
    struct Release {
        WebPPicture& picture;
        WebPMemoryWriter& writer;
        ~Release() {
            WebPPictureFree(&picture);
            WebPMemoryWriterClear(&writer);
        }
    };
    WebPMemoryWriter writer;
    WebPMemoryWriterInit(&writer);
    const Release release{picture, writer};
    picture.width = width;
    picture.height = height;
    picture.writer = WebPMemoryWrite;
    picture.custom_ptr = &writer;
    if (import(&picture, pixels, bytes_of_pixel * width) == 0 || WebPEncode(&config, &picture) == 0)
        throw GenerationError("WebP encoder: error " + std::to_string(picture.error_code));
    return {writer.mem, writer.mem + writer.size};
}

}  // namespace

Bytes webp(std::span<const std::uint8_t> rgb, int width, int height, int quality) {
    return encoded_webp(rgb.data(), 3, WebPPictureImportRGB, width, height, quality);
}

Bytes webp_with_alpha(std::span<const std::uint8_t> rgba, int width, int height, int quality) {
    return encoded_webp(rgba.data(), 4, WebPPictureImportRGBA, width, height, quality);
}

namespace {

/// How the pixels of a PNG file are stored.
struct PngLayout {
    int width, height;
    int colours;  ///< of libpng: PNG_COLOR_TYPE_RGBA
    int depth;    ///< bits per channel, 8 or 16
    int bytes;    ///< of a pixel
    std::span<const png_color> palette{};
};

/// Writes a PNG file. It has no variables with destructors, past which libpng must not jump.
///
/// returns  false if the encoder fails
bool write_png(std::span<const std::uint8_t* const> rows, const PngLayout& layout,
               std::span<png_text> texts, Bytes& file) {
    png_structp encoder = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
    png_infop info = encoder == nullptr ? nullptr : png_create_info_struct(encoder);
    const bool is_ready = info != nullptr;
    if (!is_ready || setjmp(png_jmpbuf(encoder)) != 0) {
        png_destroy_write_struct(&encoder, &info);
        return false;
    }
    png_set_write_fn(
        encoder, &file,
        [](png_structp to, png_bytep bytes, png_size_t size) {
            auto& all = *static_cast<Bytes*>(png_get_io_ptr(to));
            all.insert(all.end(), bytes, bytes + size);
        },
        nullptr);
    png_set_IHDR(encoder, info, static_cast<png_uint_32>(layout.width),
                 static_cast<png_uint_32>(layout.height), layout.depth, layout.colours,
                 PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    if (layout.colours == PNG_COLOR_TYPE_RGBA)
        png_set_sRGB(encoder, info, PNG_sRGB_INTENT_RELATIVE);
    if (!layout.palette.empty())
        png_set_PLTE(encoder, info, layout.palette.data(), static_cast<int>(layout.palette.size()));
    if (!texts.empty()) png_set_text(encoder, info, texts.data(), static_cast<int>(texts.size()));
    // Differences of neighbours, and runs of equal ones: two thirds of the time of zlib's level 3
    // without a filter, and a seventh less bytes.
    png_set_filter(encoder, PNG_FILTER_TYPE_BASE, PNG_FILTER_SUB);
    png_set_compression_level(encoder, 1);
    png_set_compression_strategy(encoder, Z_RLE);
    png_write_info(encoder, info);
    if (layout.depth == 16) png_set_swap(encoder);  // a file has the high byte first
    png_write_image(encoder, const_cast<png_bytepp>(rows.data()));
    png_write_end(encoder, nullptr);
    png_destroy_write_struct(&encoder, &info);
    return true;
}

/// Returns a PNG file.
///
/// pixels  rows from top to bottom; numbers of 16 bits in the order of the machine
/// texts   pairs of keyword and text that the file has beside them
/// throws  GenerationError if the encoder fails
Bytes encoded_png(const std::uint8_t* pixels, const PngLayout& layout, const ImageTexts& texts) {
    const std::size_t stride = static_cast<std::size_t>(layout.width) * layout.bytes;
    std::vector<const std::uint8_t*> rows;
    rows.reserve(static_cast<std::size_t>(layout.height));
    for (int y = 0; y < layout.height; ++y)
        rows.push_back(pixels + static_cast<std::size_t>(y) * stride);
    std::vector<png_text> chunks(texts.size());
    for (std::size_t i = 0; i < texts.size(); ++i) {
        chunks[i].compression = PNG_TEXT_COMPRESSION_NONE;
        chunks[i].key = const_cast<char*>(texts[i].first.c_str());
        chunks[i].text = const_cast<char*>(texts[i].second.c_str());
        chunks[i].text_length = texts[i].second.size();
    }
    Bytes file;
    if (!write_png(rows, layout, chunks, file)) throw GenerationError("PNG encoder failed");
    return file;
}

}  // namespace

Bytes png(std::span<const std::uint8_t> rgba, int width, int height) {
    return encoded_png(rgba.data(), {width, height, PNG_COLOR_TYPE_RGBA, 8, 4}, {});
}

Bytes png_of_numbers(std::span<const std::uint16_t> numbers, int width, int height,
                     const ImageTexts& texts) {
    return encoded_png(reinterpret_cast<const std::uint8_t*>(numbers.data()),
                       {width, height, PNG_COLOR_TYPE_GRAY, 16, 2}, texts);
}

Bytes png_of_numbers(std::span<const std::uint8_t> rgb, int width, int height,
                     const ImageTexts& texts) {
    return encoded_png(rgb.data(), {width, height, PNG_COLOR_TYPE_RGB, 8, 3}, texts);
}

Bytes png_of_palette(std::span<const std::uint8_t> numbers, int width, int height,
                     std::span<const PaletteColour> palette, const ImageTexts& texts) {
    std::vector<png_color> colours;
    colours.reserve(palette.size());
    for (const PaletteColour& colour : palette)
        colours.push_back({colour[0], colour[1], colour[2]});
    return encoded_png(numbers.data(), {width, height, PNG_COLOR_TYPE_PALETTE, 8, 1, colours},
                       texts);
}

std::uint64_t declared_pixels(std::span<const std::uint8_t> file) {
    long long width = 0, height = 0;
    if (starts_with(file, "\x89PNG\r\n\x1A\n", 8)) {
        // Signature, length and name of the first chunk, then width and height, the highest byte
        // first.
        if (!starts_with(file, "IHDR", 4, 12) || file.size() < 24) return 0;
        const auto word = [&](std::size_t at) {
            long long value = 0;
            for (std::size_t i = at; i < at + 4; ++i) value = value << 8 | file[i];
            return value;
        };
        width = word(16);
        height = word(20);
    } else if (starts_with(file, "\xFF\xD8\xFF", 3)) {
        const TurboHandle handle(tjInitDecompress());
        int columns = 0, rows = 0, subsampling = 0, colours = 0;
        if (!handle ||
            tjDecompressHeader3(handle.get(), file.data(), static_cast<unsigned long>(file.size()),
                                &columns, &rows, &subsampling, &colours) != 0)
            return 0;
        width = columns;
        height = rows;
    } else if (starts_with(file, "RIFF", 4) && starts_with(file, "WEBP", 4, 8)) {
        WebPBitstreamFeatures features;
        if (WebPGetFeatures(file.data(), file.size(), &features) != VP8_STATUS_OK) return 0;
        width = features.width;
        height = features.height;
    }
    if (width < 1 || height < 1 || width > largest_upload_side || height > largest_upload_side)
        return 0;
    return static_cast<std::uint64_t>(width * height);
}

Picture decoded_picture(std::span<const std::uint8_t> file, const std::string& path) {
    if (starts_with(file, "\x89PNG\r\n\x1A\n", 8)) return decoded_png(file, path);
    if (starts_with(file, "\xFF\xD8\xFF", 3)) return decoded_jpeg(file, path);
    if (starts_with(file, "RIFF", 4) && starts_with(file, "WEBP", 4, 8))
        return decoded_webp(file, path);
    refuse(path, "neither a PNG, a JPEG nor a WebP file");
}

Picture decoded_alpha(std::span<const std::uint8_t> file, const std::string& path) {
    return decoded_png(file, path, true);
}

Picture decoded_smaller(std::span<const std::uint8_t> file, const std::string& path,
                        int least_side) {
    if (starts_with(file, "\xFF\xD8\xFF", 3)) return decoded_jpeg(file, path, least_side);
    return decoded_picture(file, path);
}

}  // namespace sporeprint
