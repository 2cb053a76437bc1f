// Fruit bodies in the scene of a file.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <vector>

#include "core/gltf/glb.h"
#include "core/grow/world/plot_bodies.h"
#include "core/grow/world/world_materials.h"
#include "core/mesh/mesh.h"

namespace sporeprint {

/// How bodies that look alike are written.
enum class BodyGrouping {
    none,       ///< a node for each body
    merged,     ///< one node for all of a shape, with one mesh of all
    instanced,  ///< one node for all of a shape, with EXT_mesh_gpu_instancing
};

/// Returns how the bodies of a file are written.
///
/// is_crowded  a node for each would be too many
[[nodiscard]] BodyGrouping grouping_of(LeafInstancing instancing, bool is_crowded);

/// Includes what a mesh at a place covers.
void include(Bounds& box, const Mesh& mesh, const GlbTransform& place);

/// What was added to a scene.
struct BodyNodes {
    std::vector<std::size_t> nodes;  ///< of each body, in the order of the bodies
    std::uint64_t vertices = 0, triangles = 0;
    Bounds box{glm::vec3(1e9F), glm::vec3(-1e9F)};  ///< of all of them; reversed if there are none
};

/// Adds bodies with their materials to a scene, which refers to the meshes of the shapes and to those that were merged.
///
/// merged  where meshes of several bodies go; as they are added, the others keep their addresses
[[nodiscard]] BodyNodes add_bodies(GlbScene& scene, WorldMaterials& materials,
                                   const PlotBodies& bodies, BodyGrouping grouping,
                                   std::deque<Mesh>& merged);

}  // namespace sporeprint
