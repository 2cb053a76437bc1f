// What stands on the surface as solids of its own: warts, scales, bulb scales, the ring and the sac.
#pragma once

#include "core/geometry/curl.h"
#include "core/geometry/damage_cuts.h"
#include "core/geometry/damage_dents.h"
#include "core/geometry/sweep.h"
#include "core/individual/individual.h"

namespace sporeprint {

/// What ornaments stand on.
struct Ground {
    const Outline& outline;
    const Deformer& deformer;
    const Skin& skin;
    const Detail& detail;
    int lod;
    std::uint32_t seed;
    bool textured;
    bool keep_absent;  ///< whether what has no size keeps its triangles
    const Cuts& cuts;  ///< of the margin
    const Curl& curl;  ///< of what is left of it
    const Dents& dents;
    const Individual& individual;
};

/// Pieces of a layer: those that are gone too, so that no amount changes the number of vertices.
[[nodiscard]] int piece_count(const PatchLayer& layer, const Detail& detail);

/// Appends warts, scales and bulb scales, each a closed solid a little sunk into the surface. A piece of which nothing is left
/// is a point on the surface, with unit normals.
void add_patches(Mesh& mesh, const Individual& individual, const Ground& ground);

/// Vertices of the ring and the sac, which are there for a set of species or are not, whatever the amounts.
[[nodiscard]] int shell_rings(const Individual& individual, const Detail& detail);

/// Appends the ring: a closed thin shell attached to the stem; a line round it when nothing is left.
void add_ring(Mesh& mesh, const Individual& individual, const Ground& ground);

/// Appends the sac-like volva: a closed thin shell round the base of the stem, torn at its edge; a line round it when nothing is
/// left.
void add_sac(Mesh& mesh, const Individual& individual, const Ground& ground);

}  // namespace sporeprint
