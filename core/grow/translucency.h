// The light that passes through thin flesh and leaves: what a material with materials=rich states of
// it.
#pragma once

#include <cstdint>
#include <vector>

#include "core/bytes.h"
#include "core/gltf/glb.h"
#include "core/grow/execution_context.h"
#include "core/individual/individual.h"
#include "core/mesh/mesh.h"
#include "core/params/shared_params.h"
#include "core/surface/image_tiles.h"

namespace sporeprint {

/// How thin the flesh is at each texel of a skin.
struct Thinness {
    int side = 0;       ///< texels
    Bytes shares;       ///< of light that passes, 255 for all: exp(-thickness / translucency)
    double mean = 0.0;  ///< of the vertices, 0..1
    bool operator==(const Thinness&) const = default;
};

/// Returns the thinness of a mesh with texture coordinates; texels that no triangle covers have that
/// of those beside them.
///
/// translucency  depth in which light falls to 1/e, metres; > 0
/// side          texels
[[nodiscard]] Thinness thinness_of(const Mesh& mesh, double translucency, int side,
                                   const Parallel& parallel);

/// The thinness of an individual, and the tint that its flesh gives to light.
struct Flesh {
    Thinness thinness;  ///< side 0 for opaque flesh
    glm::dvec3 tint{1.0};
};

/// Returns the flesh of an individual: the same at every level of detail, because all levels share
/// the layout of the images.
[[nodiscard]] Flesh flesh_of(const Individual& individual, const Parallel& parallel);

/// Returns what a material states of the flesh of an individual: nothing unless materials=rich is
/// requested, or if the flesh is opaque.
[[nodiscard]] GlbTransmission transmission_of(const Individual& individual, const FileOptions& file,
                                              const ExecutionContext& execution);

/// Does the same for the tiles of an atlas, whose tint is the strongest of each channel.
///
/// tiles  at least one
[[nodiscard]] GlbTransmission transmission_of(TileGrid grid, const std::vector<Flesh>& tiles);

/// Returns about the bytes of the image of an individual, at most, in a file with these options.
[[nodiscard]] std::uint64_t bytes_of_thinness(Textures textures, const FileOptions& file);

/// Returns what the material of leaves states: the same everywhere, more yellow than the light that
/// leaves reflect.
[[nodiscard]] GlbTransmission transmission_of_leaves(const FileOptions& file);

}  // namespace sporeprint
