// Pipeline of a mushroom: from a request to a GLB file. This is the entry point of core as a
// library.
#pragma once

#include "core/atlas/atlas.h"
#include "core/geometry/sweep.h"
#include "core/grow/product.h"
#include "core/individual/mushroom_spec.h"
#include "core/individual/resolve.h"
#include "core/mesh/detail.h"
#include "core/version.h"

namespace sporeprint {

/// Returns the number of vertices (exact), triangles (at most), texels and bytes. Takes
/// microseconds and allocates nothing large.
[[nodiscard]] Estimate estimate(const MushroomSpec& spec, const Individual& individual);
[[nodiscard]] Estimate estimate(const MushroomSpec& spec, const Atlas& atlas,
                                const Caches& caches = {});

/// Returns the mesh of a swept or branched individual, with triangles not yet reordered for the
/// vertex cache.
///
/// throws  as swept_mesh() and branched_mesh()
[[nodiscard]] Mesh body_mesh(const Individual& individual, DetailLevel level,
                             const SweepOptions& options = {});

/// Returns the counts of body_mesh(): vertices exactly; triangles at most, and exactly for branched
/// individuals.
[[nodiscard]] MeshCount body_count(const Individual& individual, DetailLevel level,
                                   bool keep_absent = true);

/// Returns the mesh of the first level of detail of a file alone; for an impostor that which it
/// shows.
[[nodiscard]] Mesh mushroom_mesh(const MushroomSpec& spec, const Individual& individual);

/// Returns the bounding box of that mesh and of the wood behind it.
[[nodiscard]] Bounds mushroom_bounds(const MushroomSpec& spec, const Individual& individual);

/// Returns about the largest distance of the outline of a mesh at a level of detail from the true
/// one, metres: that of the polygons around its widest part and over its cap, or that of the gaps
/// that missing branches leave.
///
/// radius  of the widest part, metres
[[nodiscard]] double outline_error(const Individual& individual, DetailLevel level, double radius);

/// Returns the requested level of detail and those below it: the levels of a file of several, else
/// the whole ones, each of which is a file of its own.
///
/// box  of the mesh
[[nodiscard]] std::vector<Level> levels_of(const MushroomSpec& spec, const Individual& individual,
                                           const Bounds& box);

/// Returns the material beyond its images. Slime and water are a clear coat; velvet shines in the
/// cap's own colours.
[[nodiscard]] MaterialLook look_of(const Model& model);

using Mushroom = Grown;

/// Builds a mushroom.
///
/// returns  the GLB as shared slices: header with JSON, geometry, images
/// throws   InvalidInput, GenerationError, Cancelled
[[nodiscard]] Mushroom grow_mushroom(const MushroomSpec& spec, const Atlas& atlas,
                                     const Extras& extras = {},
                                     const ExecutionContext& execution = {});

/// Does the same for a spec that is resolved already.
///
/// individual  resolve() of the spec
[[nodiscard]] Mushroom grow_mushroom(const MushroomSpec& spec, const Individual& individual,
                                     const Atlas& atlas, const Extras& extras,
                                     const ExecutionContext& execution);

}  // namespace sporeprint
