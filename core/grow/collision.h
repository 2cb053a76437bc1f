// Collision of a product: the solids that a physics engine tests, and how a file states them.
#pragma once

#include <string>
#include <vector>

#include "core/collision/collision_shape.h"
#include "core/gltf/glb.h"
#include "core/individual/individual.h"
#include "core/params/shared_params.h"
#include "core/params/value.h"
#include "core/plant/tree_spec.h"

namespace sporeprint {

/// A solid at its place in the product.
struct Collider {
    std::size_t shape = 0;  ///< index into the shapes
    GlbTransform place = {};
};

/// The static body of a product. Its file refers to the meshes of its shapes.
struct Collision {
    std::vector<CollisionShape> shapes;
    std::vector<Collider> colliders;

    /// Adds a shape where it is.
    void add(CollisionShape shape);
};

/// Returns the solids of a mushroom, the same at every level of detail: those of the whole if its
/// hollows are small or if it grows from a wall, then with those of the wood behind it, otherwise
/// those of its cap and its stem. Rings, volvas and warts are left out, because what touches them
/// moves them.
///
/// cost  that of the mesh at LOD 1, and some ten milliseconds
[[nodiscard]] std::vector<CollisionShape> collision_shapes(const Individual& individual);

/// The most capsules along a trunk.
inline constexpr int most_trunk_capsules = 4;

/// Returns capsules along the trunk of a tree, up to where its radius is less than two fifths of
/// that of its foot.
///
/// throws  as grown_tree()
[[nodiscard]] Collision trunk_collision(const TreeSpec& spec);

/// Returns a collision of shapes that are all at their place.
[[nodiscard]] Collision body_of(std::vector<CollisionShape> shapes);

/// Adds the solids to a scene as the file requests.
///
/// nodes: a mesh node `UCX_{name}_00` for each solid, beside the others; its extras state the part,
///        and the radius and height of a capsule
/// omi:   a static body, the last node, whose children are all other roots of the scene and one
///        node for each solid
///
/// scene      complete otherwise
/// name       of the first level of detail
/// collision  must outlive the scene
void add_collision(GlbScene& scene, Collision& collision, const std::string& name,
                   CollisionFormat format);

/// Returns the solids as JSON: {"shapes":[{"part","capsule":{"radius_m","height_m"}} or
/// {"part","convex":{"points_m"}}], "colliders":[{"shape","translation","rotation","scale"}]}.
[[nodiscard]] Value collision_value(const Collision& collision);

}  // namespace sporeprint
