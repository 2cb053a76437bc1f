// The recipe of a mushroom: an order in, a GLB out. This is how core is used as a library.
#pragma once

#include "core/atlas/atlas.h"
#include "core/bytes.h"
#include "core/grow/workshop.h"
#include "core/mesh/mesh.h"
#include "core/model/request.h"
#include "core/model/resolve.h"
#include "core/version.h"

namespace sporeprint {

/// What an order will come to, before any work.
struct Estimate {
    std::uint64_t vertices = 0;  ///< those of every frame of a clip too: each is built
    std::uint64_t triangles = 0;
    std::uint64_t texels =
        0;  ///< held at once, at most: of the images and of what they are dissolved from
    std::uint64_t bytes = 0;
};

/// Number of vertices (exact), triangles (at most), texels and bytes; microseconds, allocates nothing large.
[[nodiscard]] Estimate estimate(const MushroomOrder& order, const Individual& individual);
[[nodiscard]] Estimate estimate(const MushroomOrder& order, const Atlas& atlas,
                                const Memo& memo = {});

/// The mesh alone.
[[nodiscard]] Mesh mushroom_mesh(const MushroomOrder& order, const Individual& individual);

struct Extras {
    std::string canonical;  ///< canonical address of the request; empty for none
    std::array<std::string, 3> image_addresses;  ///< by ImageKind, for Textures::linked
};

struct Mushroom {
    Body glb;
    std::uint64_t vertices = 0;
    std::uint64_t triangles = 0;
};

/// Grows a mushroom.
///
/// returns  the GLB as shared slices: header with JSON, geometry, images
/// throws   InvalidInput, GenerationError, Cancelled
[[nodiscard]] Mushroom grow_mushroom(const MushroomOrder& order, const Atlas& atlas,
                                     const Extras& extras = {}, const Workshop& workshop = {});

}  // namespace sporeprint
