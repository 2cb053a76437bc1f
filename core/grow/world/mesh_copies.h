// A small mesh that occurs often.
#pragma once

#include <vector>

#include "core/gltf/glb.h"
#include "core/mesh/mesh.h"

namespace sporeprint {

struct MeshCopies {
    Mesh one;  ///< of which all are copies
    std::vector<GlbTransform> places;

    /// Returns all of them as one mesh, whose tints are those of the places, times those of the mesh if it has some.
    [[nodiscard]] Mesh merged() const;
};

}  // namespace sporeprint
