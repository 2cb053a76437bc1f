// The meshes and nodes of a colony in its file.
#pragma once

#include <cstddef>
#include <span>
#include <string>

#include "core/gltf/glb.h"
#include "core/grow/colony.h"
#include "core/grow/impostor.h"

namespace sporeprint {

/// Adds the meshes and nodes of one level of detail: one node for the wood, one for roots, stems
/// and ground, and one for each member, or an instanced one for each model.
///
/// colony         with the members and the parameters; outlives the scene, as the meshes do
/// wood_material  index of that of the wood
/// name           level_name()
void add_colony(GlbScene& scene, const Colony& colony, const Mesh& skin, const Mesh& wood,
                std::span<const Mesh> models, std::size_t wood_material, const std::string& name);

/// Adds the material, the mesh and the node of an impostor.
///
/// product  product_name()
/// name     level_name()
void add_cards(GlbScene& scene, const Impostor& impostor, const std::string& product,
               const std::string& name);

}  // namespace sporeprint
