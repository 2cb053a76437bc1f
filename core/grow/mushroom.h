// The recipe of a mushroom: an order in, a GLB out. This is how core is used as a library.
#pragma once

#include "core/atlas/atlas.h"
#include "core/geometry/sweep.h"
#include "core/grow/product.h"
#include "core/individual/mushroom_spec.h"
#include "core/individual/resolve.h"
#include "core/version.h"

namespace sporeprint {

/// Number of vertices (exact), triangles (at most), texels and bytes; microseconds, allocates nothing large.
[[nodiscard]] Estimate estimate(const MushroomOrder& order, const Individual& individual);
[[nodiscard]] Estimate estimate(const MushroomOrder& order, const Atlas& atlas,
                                const Memo& memo = {});

/// The mesh of an individual of either family, its triangles not yet in an order of their own.
///
/// throws  as swept_mesh() and branched_mesh()
[[nodiscard]] Mesh body_mesh(const Individual& individual, int lod,
                             const SweepOptions& options = {});

/// What body_mesh() comes to: vertices exactly, triangles at most, and exactly for what branches.
[[nodiscard]] MeshCount body_count(const Individual& individual, int lod, bool keep_absent = true);

/// The mesh alone.
[[nodiscard]] Mesh mushroom_mesh(const MushroomOrder& order, const Individual& individual);

/// What it is called in a file: the species with the most weight, so that the order of a mix changes nothing.
[[nodiscard]] std::string name_of(const Individual& individual);

/// What the file says of light beyond its images. Slime and water are a clear coat; hairs shine in the cap's own colours.
[[nodiscard]] MaterialLook look_of(const Model& model);

using Mushroom = Grown;

/// Grows a mushroom.
///
/// returns  the GLB as shared slices: header with JSON, geometry, images
/// throws   InvalidInput, GenerationError, Cancelled
[[nodiscard]] Mushroom grow_mushroom(const MushroomOrder& order, const Atlas& atlas,
                                     const Extras& extras = {}, const Workshop& workshop = {});

}  // namespace sporeprint
