// What every recipe has in common: what an order will come to, what a file says of itself, how it wears its images.
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

/// What an order will come to, before any work.
struct Estimate {
    std::uint64_t vertices = 0;  ///< those of every frame of a clip too: each is built
    std::uint64_t triangles = 0;
    std::uint64_t texels =
        0;  ///< held at once, at most: of the images and of what they are dissolved from
    std::uint64_t bytes = 0;
};

/// Bytes of a file with a mesh and images, about.
///
/// image_bytes  of all images, where they are embedded
[[nodiscard]] std::uint64_t estimated_bytes(std::uint64_t vertices, std::uint64_t triangles,
                                            Textures textures, std::uint64_t image_bytes);

/// Addresses of the images of an atlas, by ImageKind.
using ImageAddresses = std::array<std::string, 3>;

struct Extras {
    std::string canonical;           ///< canonical address of the request; empty for none
    ImageAddresses image_addresses;  ///< for Textures::linked
};

/// A file that was grown.
struct Grown {
    Body glb;
    std::uint64_t vertices = 0;
    std::uint64_t triangles = 0;
};

/// asset.extras of a file.
[[nodiscard]] std::string extras_json(const Extras& extras, Value effective, const Bounds& box,
                                      std::size_t triangles);
[[nodiscard]] std::string extras_json(const Extras& extras, Value effective, const Mesh& mesh);

/// Gives `parts` the images that an order asks for: those that `paint` makes, the addresses of `extras`, or none.
///
/// returns  what was painted, for as long as `parts` is used
/// throws   Impossible (path "/textures") for linked ones without addresses; Cancelled
[[nodiscard]] std::shared_ptr<const ImageSet> wear_images(
    GlbParts& parts, Textures textures, const Extras& extras, const Workshop& workshop,
    const std::function<std::shared_ptr<const ImageSet>()>& paint);

/// The same for one material of a scene.
[[nodiscard]] std::shared_ptr<const ImageSet> wear_images(
    GlbMaterial& material, Textures textures, const ImageAddresses& addresses,
    const Workshop& workshop, const std::function<std::shared_ptr<const ImageSet>()>& paint);

}  // namespace sporeprint
