// Code that all pipelines share: estimates, metadata of a file, and the images of its materials.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>

#include "core/bytes.h"
#include "core/gltf/glb.h"
#include "core/grow/execution_context.h"
#include "core/grow/levels.h"
#include "core/grow/wind.h"
#include "core/individual/mushroom_spec.h"
#include "core/mesh/mesh.h"
#include "core/params/value.h"

namespace sporeprint {

/// Estimated size of a result, before any work.
struct Estimate {
    std::uint64_t vertices = 0;  ///< including every frame of a clip, since each is built
    std::uint64_t triangles = 0;
    /// Peak number of texels in memory: those of the images and, for a mix, of the images that are
    /// blended.
    std::uint64_t texels = 0;
    std::uint64_t bytes = 0;
    std::uint64_t impostor_texels = 0;  ///< of the images of an impostor, beside the others
};

/// Sets how a scene is written.
void set_options(GlbScene& scene, const FileOptions& file);

/// Throws Impossible for options that exclude each other: (path "/collision") OMI_physics_shape
/// with quantised geometry, which a shape cannot scale; (path "/wind") texture coordinates of wind
/// without those of images, which have to precede them.
void refuse_impossible(const FileOptions& file, Textures textures);

/// Adds the images of a file to its size.
///
/// jpg  size of all of them as JPEG, bytes
void add_image_bytes(Estimate& sum, std::uint64_t jpg, Textures textures, const FileOptions& file);

/// Adds the solids for collision of a file to its size.
///
/// individuals  to which convex solids are fitted
/// capsules     about how many capsules stand for stems and trunks
void add_solid_bytes(Estimate& sum, std::uint64_t individuals, std::uint64_t capsules,
                     const FileOptions& file);

/// URLs of the images of an atlas in each format, indexed by ImageKind.
struct ImageUrls {
    std::array<std::string, 3> jpg, webp;
};

/// Returns the start of the cache keys of images in a format; empty for JPEG.
[[nodiscard]] std::string key_of_format(ImageFormat format);

/// Images of a material that are embedded in a file, which must outlive the material.
struct EmbeddedImages {
    std::shared_ptr<const ImageSet> files, fallback;
};

/// Adds the mesh of a further level of detail of the same file.
void add_level(Estimate& sum, std::uint64_t vertices, std::uint64_t triangles, Textures textures,
               const FileOptions& file);

/// Returns the approximate size of a transform of EXT_mesh_gpu_instancing.
[[nodiscard]] std::uint64_t bytes_of_instance(const FileOptions& file);

/// Returns the bytes that a scene becomes: those of a file, or of a picture of it.
using SceneWriter = std::function<Body(const GlbScene&, const Parallel&)>;

/// Returns the URLs of the images of a mushroom.
using ImageLinks = std::function<ImageUrls(const MushroomSpec&)>;

struct Extras {
    std::string canonical;         ///< canonical URL of the request; empty for none
    ImageUrls image_urls;          ///< if has_addresses(textures)
    ImageLinks variant_urls = {};  ///< of variants
    ImageUrls wood_urls = {};      ///< of what a colony stands on, likewise
    SceneWriter write = glb;       ///< called once
};

/// A finished file.
struct Grown {
    Body glb;
    std::uint64_t vertices = 0;
    std::uint64_t triangles = 0;
};

/// The levels of detail of a file.
struct FileLevels {
    std::span<const Level> list;
    Lods lods = Lods::single;
};

/// Returns a bounding box as JSON: {"min":[x,y,z],"max":[x,y,z]}, whose numbers are exactly those
/// of the vertices.
[[nodiscard]] Value bounds_value(const Bounds& box);

/// Returns asset.extras: the canonical URL, the effective parameters, the bounding box in metres,
/// the number of triangles of the first level of detail, all levels if the file may have several,
/// and the channels of wind if it has them.
[[nodiscard]] Value extras_value(const Extras& extras, Value effective, const Bounds& box,
                                 std::size_t triangles, const FileLevels& levels, const Wind& wind);

/// Sets the images of a material as the parameters request: embedded images, which `paint` returns
/// in a format, linked images, or none.
///
/// returns  the embedded images
/// throws   Impossible (path "/textures") for linked images without URLs; Cancelled
[[nodiscard]] EmbeddedImages attach_images(
    GlbMaterial& material, Textures textures, const FileOptions& file, const ImageUrls& urls,
    const ExecutionContext& execution,
    const std::function<std::shared_ptr<const ImageSet>(ImageFormat)>& paint);

}  // namespace sporeprint
