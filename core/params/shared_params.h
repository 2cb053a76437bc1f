// Parameters that all products share: scale, level of detail and images.
#pragma once

#include <cstdint>
#include <vector>

#include "core/params/describe.h"

namespace sporeprint {

/// How the images are delivered.
enum class Textures { embedded, linked, external, none };

constexpr const char* name(Textures textures) {
    switch (textures) {
        case Textures::embedded:
            return "embedded";
        case Textures::linked:
            return "linked";
        case Textures::external:
            return "external";
        case Textures::none:
            return "none";
    }
    return nullptr;
}

/// Returns whether a file has addresses of its images instead of images.
constexpr bool has_addresses(Textures textures) {
    return textures == Textures::linked || textures == Textures::external;
}

/// Which individuals have the same images.
enum class ImageShare { individual, species };

constexpr const char* name(ImageShare share) {
    switch (share) {
        case ImageShare::individual:
            return "individual";
        case ImageShare::species:
            return "species";
    }
    return nullptr;
}

/// Which other materials a file has beside the requested one.
enum class Variants { none, weather };

constexpr const char* name(Variants variants) {
    switch (variants) {
        case Variants::none:
            return "none";
        case Variants::weather:
            return "weather";
    }
    return nullptr;
}

/// Returns the seed of what is painted on an individual.
[[nodiscard]] constexpr std::uint32_t painted_seed(std::uint32_t seed, ImageShare share) {
    return share == ImageShare::species ? 1 : seed;
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

/// Which optional extensions materials have.
enum class MaterialSet { rich, full, core };

constexpr const char* name(MaterialSet materials) {
    switch (materials) {
        case MaterialSet::rich:
            return "rich";
        case MaterialSet::full:
            return "full";
        case MaterialSet::core:
            return "core";
    }
    return nullptr;
}

/// The program for which a file is written.
enum class Profile { core, web, mobile, godot, unity, unreal, blender, cesium };

constexpr const char* name(Profile profile) {
    switch (profile) {
        case Profile::core:
            return "core";
        case Profile::web:
            return "web";
        case Profile::mobile:
            return "mobile";
        case Profile::godot:
            return "godot";
        case Profile::unity:
            return "unity";
        case Profile::unreal:
            return "unreal";
        case Profile::blender:
            return "blender";
        case Profile::cesium:
            return "cesium";
    }
    return nullptr;
}

/// The levels of detail in a file.
enum class Lods { single, nodes, msft };

constexpr const char* name(Lods lods) {
    switch (lods) {
        case Lods::single:
            return "single";
        case Lods::nodes:
            return "nodes";
        case Lods::msft:
            return "msft";
    }
    return nullptr;
}

/// How a file describes the solids of a physics engine.
enum class CollisionFormat { none, nodes, omi };

constexpr const char* name(CollisionFormat collision) {
    switch (collision) {
        case CollisionFormat::none:
            return "none";
        case CollisionFormat::nodes:
            return "nodes";
        case CollisionFormat::omi:
            return "omi";
    }
    return nullptr;
}

/// Where a file has the weights by which wind moves its vertices.
enum class WindFormat { none, uv, attribute, color };

constexpr const char* name(WindFormat wind) {
    switch (wind) {
        case WindFormat::none:
            return "none";
        case WindFormat::uv:
            return "uv";
        case WindFormat::attribute:
            return "attribute";
        case WindFormat::color:
            return "color";
    }
    return nullptr;
}

/// The side of the LOD 0 atlas in texels.
using TextureSize = Choice<128, 256, 512, 1024, 2048>;
/// The side of an image at any level of detail, texels.
using ImageSide = Choice<16, 32, 64, 128, 256, 512, 1024, 2048>;

inline constexpr Info size_info{
    .name = "size", .min = 0.25, .max = 4, .doc = "Scale of the whole."};
/// The last level of detail of every product that is its mesh.
inline constexpr int last_lod = 3;
/// The level after it of all products but leaves: an impostor, cards with pictures of the product.
inline constexpr int impostor_lod = last_lod + 1;
/// The level of detail of the meshes that an impostor shows.
inline constexpr int impostor_source_lod = 1;
inline constexpr Info lod_info{
    .name = "lod",
    .min = 0,
    .max = impostor_lod,
    .doc =
        "Level of detail: the same individual with fewer triangles and smaller images. 4 is an "
        "impostor: cards with pictures from all sides, for the distance.",
    .default_from = "profile"};
inline constexpr Info mesh_lod_info{
    .name = "lod",
    .min = 0,
    .max = last_lod,
    .doc =
        "Level of detail: the same individual with fewer triangles and smaller images. 0 is for "
        "close-ups; games begin with triangles=12000 or with 1.",
    .default_from = "profile"};
inline constexpr Info triangles_info{
    .name = "triangles",
    .min = 1,
    .max = 10'000'000,
    .doc =
        "Instead of lod: the level of detail whose number of triangles is nearest to this one in "
        "ratio. It is a target, not a bound: the json states the level and its real number. For "
        "a mushroom levels between the whole ones count too, with the images of the nearest "
        "whole one; for all others the whole levels by their expected numbers. Games take 12000 "
        "for a mushroom that is looked at; lod=0 is for close-ups.",
    .group = "file",
    .default_from = "lod"};

inline constexpr Info texture_size_info{
    .name = "texture_size",
    .unit = "texels",
    .doc = "Side of the image atlas at LOD 0; it halves with every level."};
inline constexpr Info textures_info{.name = "textures",
                                    .doc =
                                        "Images inside the file, linked by address, external "
                                        "(addresses in the extras of materials, for clients "
                                        "that load and share images themselves), or none."};

inline constexpr Info share_info{
    .name = "share",
    .doc =
        "species: individuals that differ in seed alone have the same images, those of seed 1, "
        "and with them warts, scales and gills at the same places; the shapes still differ.",
    .group = "file"};

/// What is at the foot of a stem.
enum class Base { natural, clean };

constexpr const char* name(Base base) {
    switch (base) {
        case Base::natural:
            return "natural";
        case Base::clean:
            return "clean";
    }
    return nullptr;
}

inline constexpr Info base_info{
    .name = "base",
    .doc =
        "natural: the foot of the stem stands in a clod of soil with litter on it and strands of "
        "mycelium in it, and soil clings to the stem, as is usual for the species; clean: as if "
        "it were washed."};

inline constexpr Info variants_info{
    .name = "variants",
    .doc =
        "weather: variants of the material beside the requested one, dry, wet, aged and frosted, "
        "by KHR_materials_variants; four sets of images instead of one.",
    .group = "file"};

/// How a file is written for the program that reads it. It belongs to every product and does not
/// change what grows.
struct FileOptions {
    Profile profile = Profile::core;
    Compression compress = Compression::none;
    ImageFormats image_format = ImageFormats::jpg;
    MaterialSet materials = MaterialSet::full;
    Lods lods = Lods::single;
    bool impostor = false;
    CollisionFormat collision = CollisionFormat::none;
    WindFormat wind = WindFormat::none;

    static constexpr void fields(auto visit) {
        using O = FileOptions;
        visit(&O::profile,
              Info{.name = "profile",
                   .doc = "The engine that reads the file: sets the defaults of lod and of the "
                          "options below, each of which may still be given; collision and wind "
                          "only where other options allow them. core is plain glTF, which every "
                          "loader reads.",
                   .group = "file"});
        visit(&O::compress,
              Info{.name = "compress",
                   .doc = "Geometry as floats, which every loader reads; quantised to 16 bits, for "
                          "loaders of KHR_mesh_quantization; or quantised and compressed, for "
                          "those of EXT_meshopt_compression.",
                   .group = "file",
                   .default_from = "profile"});
        visit(&O::image_format,
              Info{.name = "image_format",
                   .doc = "Images as JPEG, which every loader reads; as WebP, a third of the "
                          "bytes, for loaders of EXT_texture_webp; or both, the JPEG images for "
                          "loaders without it.",
                   .group = "file",
                   .default_from = "profile"});
        visit(
            &O::materials,
            Info{.name = "materials",
                 .doc = "Materials of core glTF alone, which is cheapest to draw; full: with clear "
                        "coat, sheen and strength of emission, by optional extensions; rich: "
                        "also with the light that passes through thin flesh and leaves, by "
                        "KHR_materials_diffuse_transmission. Readers without it show what full "
                        "has; the alpha of its image, how thin the flesh is (1: a film, 0: "
                        "opaque), is there for shaders of one's own. An impostor has none.",
                 .group = "file",
                 .default_from = "profile"});
        visit(
            &O::lods,
            Info{.name = "lods",
                 .doc = "Levels of detail in the file: that of lod or triangles alone, or all from "
                        "it to the last with the images of the first; a mushroom has a further "
                        "level between two that differ by more than four times. nodes: nodes "
                        "named _LOD0, _LOD1 and so on at one place, for modelling programs "
                        "(viewers draw all of them). msft: by MSFT_lod, where other readers show "
                        "the first.",
                 .group = "file",
                 .default_from = "profile"});
        visit(&O::impostor,
              Info{.name = "impostor",
                   .doc = "Whether the levels of detail of lods=nodes or lods=msft end with an "
                          "impostor, that of lod=4: cards with pictures from all sides. A leaf has "
                          "none.",
                   .group = "file"});
        visit(&O::collision,
              Info{.name = "collision",
                   .doc = "Solids for a physics engine, the same at every level of detail: a "
                          "capsule or convex meshes for stem and cap, for each individual of a "
                          "colony, and for the trunk of a tree. nodes: meshes named UCX_..., as "
                          "Unreal Engine expects, which viewers show. omi: a static body by "
                          "OMI_physics_body and OMI_physics_shape, which Godot reads, with "
                          "geometry as floats only. A leaf has none.",
                   .group = "file",
                   .default_from = "profile"});
        visit(&O::wind,
              Info{.name = "wind",
                   .doc = "Weights by which a shader moves the vertices in wind: bend (0 at the "
                          "ground), flutter of leaves, phase, number of the branch. uv: as "
                          "TEXCOORD_1 and TEXCOORD_2, which most engines import. attribute: as "
                          "_WIND, for three.js. color: as COLOR_0, by which viewers "
                          "multiply the colours. extras.wind of the file names the channels and "
                          "states the displacements in metres.",
                   .group = "file",
                   .default_from = "profile"});
    }
    /// Refuses an impostor after a single level, beside which it would be shown.
    void check(const std::string& path, std::vector<Problem>& problems) const {
        if (impostor && lods == Lods::single)
            report(problems, path + "/impostor",
                   "an impostor ends several levels; ask for lods=msft or lods=nodes too, or for "
                   "lod=4 alone");
    }
    bool operator==(const FileOptions&) const = default;
};

/// Returns whether a file has an impostor: alone, or after other levels of detail.
[[nodiscard]] constexpr bool has_impostor(int lod, const FileOptions& file) {
    return lod == impostor_lod || file.impostor;
}

/// Returns the levels of detail of a file that are meshes of the product, finest first; none for an
/// impostor alone.
[[nodiscard]] inline std::vector<int> levels_in_file(int lod, const FileOptions& file) {
    if (lod == impostor_lod) return {};
    std::vector<int> levels{lod};
    while (file.lods != Lods::single && levels.back() < last_lod)
        levels.push_back(levels.back() + 1);
    return levels;
}

inline constexpr Info file_info{.name = "", .doc = "How the file is written."};

}  // namespace sporeprint
