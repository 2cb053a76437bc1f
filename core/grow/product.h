// Code that all pipelines share: estimates, metadata of a file, and the images of its materials.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>

#include "core/bytes.h"
#include "core/gltf/glb.h"
#include "core/grow/execution_context.h"
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
};

/// Returns the storage of geometry that a parameter requests.
[[nodiscard]] GlbGeometry storage_of(Compression compress);

/// Returns the approximate size of a file with a mesh and images, bytes.
///
/// image_bytes  size of all images; counted for Textures::embedded only
[[nodiscard]] std::uint64_t estimated_bytes(std::uint64_t vertices, std::uint64_t triangles,
                                            Textures textures, const FileOptions& file,
                                            std::uint64_t image_bytes);

/// URLs of the images of an atlas, indexed by ImageKind.
using ImageUrls = std::array<std::string, 3>;

struct Extras {
    std::string canonical;  ///< canonical URL of the request; empty for none
    ImageUrls image_urls;   ///< for Textures::linked
};

/// A finished file.
struct Grown {
    Body glb;
    std::uint64_t vertices = 0;
    std::uint64_t triangles = 0;
};

/// Returns the JSON text of asset.extras: the canonical URL, the effective parameters, the bounding
/// box in metres and the number of triangles.
[[nodiscard]] std::string extras_json(const Extras& extras, Value effective, const Bounds& box,
                                      std::size_t triangles);
[[nodiscard]] std::string extras_json(const Extras& extras, Value effective, const Mesh& mesh);

/// Sets the images of `parts` as `textures` requests: embedded images, which `paint` returns, the
/// URLs of `extras`, or none.
///
/// returns  the embedded images, which must outlive `parts`; nullptr if there are none
/// throws   Impossible (path "/textures") for linked images without URLs; Cancelled
[[nodiscard]] std::shared_ptr<const ImageSet> attach_images(
    GlbParts& parts, Textures textures, const Extras& extras, const ExecutionContext& execution,
    const std::function<std::shared_ptr<const ImageSet>()>& paint);

/// Does the same for one material of a scene.
[[nodiscard]] std::shared_ptr<const ImageSet> attach_images(
    GlbMaterial& material, Textures textures, const ImageUrls& addresses,
    const ExecutionContext& execution,
    const std::function<std::shared_ptr<const ImageSet>()>& paint);

}  // namespace sporeprint
