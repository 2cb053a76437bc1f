// A file of one mesh, one primitive, one material and one node.
#pragma once

#include <array>
#include <span>
#include <string>

#include "core/gltf/glb.h"

namespace sporeprint {

struct GlbParts {
    std::string name;                       ///< of node, mesh and material
    const ImageSet* images = nullptr;       ///< embedded when given
    std::array<std::string, 3> image_urls;  ///< linked when not empty
    std::string extras_json;                ///< a JSON object for asset.extras; empty for none
    MaterialLook look = {};
    std::span<const MorphTarget> targets = {};  ///< weights are 0 until a viewer sets them
    const WeightClip* clip = nullptr;           ///< of the targets
    GlbGeometry geometry = GlbGeometry::floats;
};

/// Returns glb() of the scene.
[[nodiscard]] inline Body glb(const Mesh& mesh, const GlbParts& parts) {
    GlbScene scene;
    scene.materials.push_back({.name = parts.name,
                               .images = parts.images,
                               .image_urls = parts.image_urls,
                               .look = parts.look});
    scene.meshes.push_back({parts.name, {{&mesh, 0, parts.targets}}});
    scene.nodes.push_back({.name = parts.name, .mesh = 0});
    scene.extras_json = parts.extras_json;
    scene.clip = parts.clip;
    scene.geometry = parts.geometry;
    return glb(scene);
}

}  // namespace sporeprint
