#include "core/surface/photo_codecs.h"

#include <png.h>
#include <turbojpeg.h>
#include <webp/decode.h>

#include <algorithm>
#include <cstring>
#include <memory>
#include <string_view>

#include "core/problems.h"

namespace sporeprint {

namespace {

using File = std::span<const std::uint8_t>;

[[noreturn]] void refuse(const std::string& path, const std::string& why) {
    throw InvalidInput(path, why);
}

std::uint32_t number(File file, std::size_t at, std::size_t bytes, bool is_little = false) {
    std::uint32_t value = 0;
    for (std::size_t i = 0; i < bytes; ++i)
        value = value << 8U | file[at + (is_little ? bytes - 1 - i : i)];
    return value;
}

bool has(File file, std::size_t at, std::string_view text) {
    return file.size() >= at + text.size() &&
           std::memcmp(file.data() + at, text.data(), text.size()) == 0;
}

/// Calls a function with the marker and the content of each segment before the first scan of a JPEG file.
/// The function returns false to end.
template <class Visit>
void each_segment(File file, const Visit& visit) {
    std::size_t at = 2;
    while (at + 4 <= file.size() && file[at] == 0xFF) {
        const std::uint8_t marker = file[at + 1];
        if (marker == 0xFF) {
            ++at;
            continue;
        }
        const std::size_t length = number(file, at + 2, 2);
        if (marker == 0xDA || length < 2 || at + 2 + length > file.size()) return;
        if (!visit(marker, file.subspan(at + 4, length - 2))) return;
        at += 2 + length;
    }
}

bool is_progressive(File file) {
    bool found = false;
    each_segment(file, [&](std::uint8_t marker, File) {
        found = marker == 0xC2;
        return !found;
    });
    return found;
}

/// Progressive files may repeat their scans thousands of times in few bytes; real ones have about ten.
bool has_too_many_scans(File file) {
    constexpr int most = 64;
    int scans = 0;
    for (std::size_t i = 0; i + 1 < file.size(); ++i)
        if (file[i] == 0xFF && file[i + 1] == 0xDA && ++scans > most) return true;
    return false;
}

void check_size(long long width, long long height, std::uint64_t most, const char* kind,
                const std::string& path) {
    if (width < 1 || height < 1) refuse(path, "the photograph has no pixels");
    const std::string size =
        "the photograph is " + std::to_string(width) + " x " + std::to_string(height) + " pixels; ";
    if (width > most_photo_side || height > most_photo_side)
        refuse(path, size + "a side has at most " + std::to_string(most_photo_side));
    if (static_cast<std::uint64_t>(width * height) > most)
        refuse(path, size + kind + " has at most " + std::to_string(most) + " in all");
}

Picture empty_picture(int width, int height) {
    return {width, height,
            Bytes(3 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height))};
}

Picture decoded_jpeg(File file, int longest_side, const std::string& path) {
    struct Destroy {
        void operator()(void* handle) const { tjDestroy(handle); }
    };
    const std::unique_ptr<void, Destroy> handle(tjInitDecompress());
    if (!handle) throw GenerationError("no JPEG decoder");
    int width = 0, height = 0, subsampling = 0, colours = 0;
    const auto size = static_cast<unsigned long>(file.size());
    if (tjDecompressHeader3(handle.get(), file.data(), size, &width, &height, &subsampling,
                            &colours) != 0)
        refuse(path, "not a readable JPEG file");
    if (colours == TJCS_CMYK || colours == TJCS_YCCK)
        refuse(path, "the JPEG file has the colours of print (CMYK); save it with RGB colours");
    const bool progressive = is_progressive(file);
    check_size(width, height, progressive ? most_whole_pixels : most_photo_pixels,
               progressive ? "a progressive JPEG file" : "a JPEG file", path);
    if (has_too_many_scans(file)) refuse(path, "the JPEG file has too many scans");
    // The transform itself makes the picture smaller.
    int scale = 1;
    while (scale < 8 && std::max(width, height) > longest_side * scale) scale *= 2;
    Picture picture = empty_picture((width + scale - 1) / scale, (height + scale - 1) / scale);
    const auto decode = [&](File whole) {
        return tjDecompress2(handle.get(), whole.data(), static_cast<unsigned long>(whole.size()),
                             picture.rgb.data(), picture.width, 0, picture.height, TJPF_RGB,
                             TJFLAG_ACCURATEDCT | TJFLAG_LIMITSCANS);
    };
    const auto says = [&](const char* words) {
        return std::string_view(tjGetErrorStr2(handle.get())).find(words) != std::string_view::npos;
    };
    int result = decode(file);
    if (result != 0 && says("Premature end of JPEG file")) {
        // Perhaps no more than the mark of the end is missing.
        Bytes ended(file.begin(), file.end());
        ended.insert(ended.end(), {0xFF, 0xD9});
        result = decode(ended);
    }
    if (result != 0 && says("premature end of data")) refuse(path, "the JPEG file ends early");
    // Cameras write files with stray bytes: what can be decoded is.
    if (result != 0 && tjGetErrorCode(handle.get()) != TJERR_WARNING)
        refuse(path, "not a readable JPEG file");
    return picture;
}

/// Calls a function with the type of each chunk of a PNG file. Returns false if the file ends before its last one.
template <class Visit>
bool each_chunk(File file, const Visit& visit) {
    constexpr std::size_t first = 8, around = 12;  // length, type and checksum
    for (std::size_t at = first; at + around <= file.size();) {
        const std::size_t length = number(file, at, 4);
        if (length > file.size() - at - around) return false;
        visit(file.subspan(at + 4, 4));
        if (has(file, at + 4, "IEND")) return true;
        at += around + length;
    }
    return false;
}

/// Parts pixels of four channels; the colour of what is transparent is that of white paper.
LayeredPicture layered(const Bytes& rgba, int width, int height) {
    LayeredPicture found{empty_picture(width, height), Bytes(rgba.size() / 4)};
    for (std::size_t i = 0; i < found.alpha.size(); ++i) {
        const std::uint32_t alpha = rgba[4 * i + 3];
        found.alpha[i] = static_cast<std::uint8_t>(alpha);
        for (std::size_t c = 0; c < 3; ++c)
            found.picture.rgb[3 * i + c] = static_cast<std::uint8_t>(
                (rgba[4 * i + c] * alpha + 255U * (255U - alpha) + 127U) / 255U);
    }
    return found;
}

LayeredPicture decoded_png(File file, const std::string& path) {
    if (!has(file, 12, "IHDR") || file.size() < 33) refuse(path, "not a readable PNG file");
    const bool interlaced = file[28] != 0;
    check_size(number(file, 16, 4), number(file, 20, 4),
               interlaced ? most_interlaced_pixels : most_whole_pixels,
               interlaced ? "an interlaced PNG file" : "a PNG file", path);
    bool is_animated = false;
    const bool is_whole =
        each_chunk(file, [&](File type) { is_animated = is_animated || has(type, 0, "acTL"); });
    if (is_animated) refuse(path, "an animated PNG file is not a photograph");
    if (!is_whole) refuse(path, "the PNG file ends early");
    png_image image;
    std::memset(&image, 0, sizeof image);
    image.version = PNG_IMAGE_VERSION;
    if (png_image_begin_read_from_memory(&image, file.data(), file.size()) == 0)
        refuse(path, "not a readable PNG file");
    struct Release {
        png_image* image;
        ~Release() { png_image_free(image); }
    } release{&image};
    image.format = PNG_FORMAT_RGBA;
    const int width = static_cast<int>(image.width), height = static_cast<int>(image.height);
    Bytes rgba(PNG_IMAGE_SIZE(image));
    if (png_image_finish_read(&image, nullptr, rgba.data(), 0, nullptr) == 0)
        refuse(path, "not a readable PNG file");
    return layered(rgba, width, height);
}

LayeredPicture decoded_webp(File file, const std::string& path) {
    constexpr std::size_t before = 8;  // the size counts from there
    if (number(file, 4, 4, true) > file.size() - before) refuse(path, "the WebP file ends early");
    WebPDecoderConfig config;
    if (WebPInitDecoderConfig(&config) == 0) throw GenerationError("no WebP decoder");
    if (WebPGetFeatures(file.data(), file.size(), &config.input) != VP8_STATUS_OK)
        refuse(path, "not a readable WebP file");
    check_size(config.input.width, config.input.height, most_whole_pixels, "a WebP file", path);
    if (config.input.has_animation != 0) refuse(path, "an animated WebP file is not a photograph");
    Bytes rgba(4 * static_cast<std::size_t>(config.input.width) *
               static_cast<std::size_t>(config.input.height));
    config.output.colorspace = MODE_RGBA;
    config.output.is_external_memory = 1;
    config.output.u.RGBA.rgba = rgba.data();
    config.output.u.RGBA.stride = 4 * config.input.width;
    config.output.u.RGBA.size = rgba.size();
    const bool is_read = WebPDecode(file.data(), file.size(), &config) == VP8_STATUS_OK;
    WebPFreeDecBuffer(&config.output);
    if (!is_read) refuse(path, "not a readable WebP file");
    return layered(rgba, config.input.width, config.input.height);
}

}  // namespace

int orientation_of(File file) {
    constexpr std::uint32_t orientation_tag = 0x0112, two_bytes = 3;
    int found = 1;
    if (!has(file, 0, "\xFF\xD8")) return found;
    each_segment(file, [&](std::uint8_t marker, File content) {
        if (marker != 0xE1 || !has(content, 0, std::string_view("Exif\0\0", 6))) return true;
        const File tiff = content.subspan(6);
        if (tiff.size() < 8) return false;
        const bool is_little = has(tiff, 0, "II");
        if (!is_little && !has(tiff, 0, "MM")) return false;
        const std::size_t directory = number(tiff, 4, 4, is_little);
        if (directory + 2 > tiff.size()) return false;
        const std::size_t entries = number(tiff, directory, 2, is_little);
        for (std::size_t i = 0; i < entries; ++i) {
            const std::size_t entry = directory + 2 + 12 * i;
            if (entry + 12 > tiff.size()) return false;
            if (number(tiff, entry, 2, is_little) != orientation_tag) continue;
            const std::uint32_t value = number(tiff, entry + 8, 2, is_little);
            if (number(tiff, entry + 2, 2, is_little) == two_bytes && value >= 1 && value <= 8)
                found = static_cast<int>(value);
            return false;
        }
        return false;
    });
    return found;
}

Picture upright(const Picture& picture, int orientation) {
    if (orientation <= 1 || orientation > 8) return picture;
    const bool is_turned = orientation >= 5;
    const int width = is_turned ? picture.height : picture.width,
              height = is_turned ? picture.width : picture.height;
    Picture found = empty_picture(width, height);
    const int right = picture.width - 1, bottom = picture.height - 1;
    std::size_t to = 0;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x, to += 3) {
            // Where the stored picture has what is seen at x and y.
            int u = is_turned ? y : x, v = is_turned ? x : y;
            if (orientation == 2 || orientation == 3 || orientation == 7 || orientation == 8)
                u = right - u;
            if (orientation == 3 || orientation == 4 || orientation == 6 || orientation == 7)
                v = bottom - v;
            const std::size_t from =
                3 * (static_cast<std::size_t>(v) * static_cast<std::size_t>(picture.width) +
                     static_cast<std::size_t>(u));
            std::memcpy(&found.rgb[to], &picture.rgb[from], 3);
        }
    return found;
}

std::uint64_t declared_photo_pixels(File file) {
    std::uint64_t found = 0;
    if (has(file, 0, "\xFF\xD8\xFF")) {
        each_segment(file, [&](std::uint8_t marker, File content) {
            // All frames but those of tables that share their range.
            const bool is_frame = marker >= 0xC0 && marker <= 0xCF && marker != 0xC4 &&
                                  marker != 0xC8 && marker != 0xCC;
            if (!is_frame || content.size() < 5) return true;
            found = std::uint64_t{number(content, 1, 2)} * number(content, 3, 2);
            return false;
        });
    } else if (has(file, 12, "IHDR") && file.size() >= 24) {
        found = std::uint64_t{number(file, 16, 4)} * number(file, 20, 4);
    } else {
        int width = 0, height = 0;
        if (WebPGetInfo(file.data(), file.size(), &width, &height) != 0)
            found = static_cast<std::uint64_t>(width) * static_cast<std::uint64_t>(height);
    }
    return found;
}

LayeredPicture decoded_layers(File file, int longest_side, const std::string& path) {
    if (file.size() > most_photo_bytes)
        refuse(path, "the file has " + std::to_string(file.size()) + " bytes; at most " +
                         std::to_string(most_photo_bytes) + " are allowed");
    if (has(file, 0, "\xFF\xD8\xFF"))
        return {upright(decoded_jpeg(file, longest_side, path), orientation_of(file)), {}};
    if (has(file, 0, "\x89PNG\r\n\x1A\n")) return decoded_png(file, path);
    if (has(file, 0, "RIFF") && has(file, 8, "WEBP")) return decoded_webp(file, path);
    refuse(path, "neither a JPEG, a PNG nor a WebP file");
}

}  // namespace sporeprint
