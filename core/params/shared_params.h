// Parameters that all products share: scale, level of detail and images.
#pragma once

#include "core/params/describe.h"

namespace sporeprint {

/// How the images are delivered.
enum class Textures { embedded, linked, none };

constexpr const char* name(Textures textures) {
    switch (textures) {
        case Textures::embedded:
            return "embedded";
        case Textures::linked:
            return "linked";
        case Textures::none:
            return "none";
    }
    return nullptr;
}

/// How geometry is stored in a file.
enum class Compression { none, quantize, meshopt };

constexpr const char* name(Compression compression) {
    switch (compression) {
        case Compression::none:
            return "none";
        case Compression::quantize:
            return "quantize";
        case Compression::meshopt:
            return "meshopt";
    }
    return nullptr;
}

/// The format of images: one of ImageFormat, or both.
enum class ImageFormats { jpg, webp, webp_jpg };

constexpr const char* name(ImageFormats formats) {
    switch (formats) {
        case ImageFormats::jpg:
            return "jpg";
        case ImageFormats::webp:
            return "webp";
        case ImageFormats::webp_jpg:
            return "webp_jpg";
    }
    return nullptr;
}

/// The side of the LOD 0 atlas in texels.
using TextureSize = Choice<128, 256, 512, 1024, 2048>;

inline constexpr Info size_info{
    .name = "size", .min = 0.25, .max = 4, .doc = "Scale of the whole."};
inline constexpr Info lod_info{
    .name = "lod",
    .min = 0,
    .max = 3,
    .doc = "Level of detail: the same individual with fewer triangles and smaller images."};
inline constexpr Info texture_size_info{
    .name = "texture_size",
    .unit = "texels",
    .doc = "Side of the image atlas at LOD 0; it halves with every level."};
inline constexpr Info textures_info{.name = "textures",
                                    .doc = "Images inside the file, linked by address, or none."};

/// How a file is written for the program that reads it. It belongs to every product and does not
/// change what grows.
struct FileOptions {
    Compression compress = Compression::none;
    ImageFormats image_format = ImageFormats::jpg;

    static constexpr void fields(auto visit) {
        using O = FileOptions;
        visit(&O::compress,
              Info{.name = "compress",
                   .doc = "Geometry as floats, which every loader reads; quantised to 16 bits, for "
                          "loaders of KHR_mesh_quantization; or quantised and compressed, for "
                          "those of EXT_meshopt_compression."});
        visit(&O::image_format,
              Info{.name = "image_format",
                   .doc = "Images as JPEG, which every loader reads; as WebP, a third of the "
                          "bytes, for loaders of EXT_texture_webp; or both, the JPEG images for "
                          "loaders without it."});
    }
    bool operator==(const FileOptions&) const = default;
};

inline constexpr Info file_info{.name = "", .doc = "How the file is written."};

}  // namespace sporeprint
