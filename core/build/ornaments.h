// What stands on the surface as solids of its own: warts, scales, bulb scales and the ring.
#pragma once

#include "core/build/sweep.h"
#include "core/model/patches.h"

namespace sporeprint {

/// What ornaments stand on.
struct Ground {
    const Outline& outline;
    const Deformer& deformer;
    const Waves& waves;
    const Detail& detail;
    std::uint32_t seed;
    bool textured;
};

/// Appends warts, scales and bulb scales, each a closed solid a little sunk into the surface.
void add_patches(Mesh& mesh, const Model& model, const Ground& ground);

/// Appends the ring: a closed thin shell attached to the stem.
void add_ring(Mesh& mesh, const Model& model, const Ground& ground);

}  // namespace sporeprint
