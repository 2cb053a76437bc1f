// A scene as the renderer draws it: placed meshes and their materials.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "core/gltf/glb.h"
#include "core/images.h"
#include "core/mesh/mesh.h"
#include "core/render/texture.h"

namespace sporeprint::render {

/// An affine map of a mesh into the scene.
struct Placement {
    glm::mat3 linear{1.0F};
    glm::vec3 translation{0.0F};
    glm::mat3 of_normals{1.0F};  ///< inverse transposed of `linear`

    [[nodiscard]] glm::vec3 point(const glm::vec3& p) const { return linear * p + translation; }
};

/// A primitive of the scene at one place.
struct Draw {
    const Mesh* mesh = nullptr;
    const Mesh* caster = nullptr;  ///< whose shadow is seen from afar: the mesh, or a coarser one
    Bounds box;                    ///< of the mesh
    std::size_t material = 0;
    Placement placement;
    glm::vec3 tint{1.0F};  ///< factor of the base colour
    GlbRole role = GlbRole::body;
};

/// A material; without images it is white and rough.
struct DrawMaterial {
    Texture base_color, normal, orm;
    Texture alpha;  ///< of the base colour, where what has less than `alpha_cutoff` is not drawn
    float alpha_cutoff = 0.0F;
    MaterialLook look;
    /// Share of matt light that passes through, times `thinness` where there is one, and its tint.
    float transmission = 0.0F;
    glm::vec3 tint{1.0F};
    Texture thinness;
};

struct DrawList {
    std::vector<Draw> draws;
    std::vector<DrawMaterial> materials;
    Bounds box;  ///< of all vertices
    bool stands_on_ground = true;

    [[nodiscard]] std::uint64_t triangles() const;
};

/// Returns all primitives of a scene that viewers show. It refers to the meshes of the scene.
///
/// parallel  decodes the images
/// side      of the picture, pixels: images are decoded no larger than it can show
/// throws    GenerationError for a scene without triangles
[[nodiscard]] DrawList draw_list(const GlbScene& scene, const Parallel& parallel,
                                 int side = largest_upload_side);

}  // namespace sporeprint::render
