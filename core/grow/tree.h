// The recipe of a tree: an order in, a GLB out.
#pragma once

#include <memory>
#include <string>

#include "core/grow/execution_context.h"
#include "core/grow/product.h"
#include "core/plant/tree_spec.h"

namespace sporeprint {

/// Number of vertices and triangles, texels and bytes, a little more than it will come to; microseconds. Of a tree that is drawn freely, about
/// those of the mean.
///
/// order   with nothing that check() finds
/// throws  Impossible (path "/order") naming the expected number of more than most_tips, (path "/leaves/per_tip") of more than
///         most_leaves, (path "/twig_length") of limbs too long for their radius
[[nodiscard]] Estimate estimate(const TreeOrder& order);

/// What a tree is made of; each part is one draw call. Without leaves the second is empty.
struct TreeMeshes {
    Mesh bark, leaves;

    [[nodiscard]] std::size_t vertices() const {
        return bark.positions.size() + leaves.positions.size();
    }
    [[nodiscard]] std::size_t triangles() const { return bark.triangles() + leaves.triangles(); }
};

/// The meshes alone: the foot of the trunk at the origin.
///
/// throws  InvalidInput, Impossible
[[nodiscard]] TreeMeshes tree_meshes(const TreeOrder& order);

/// Box of both parts.
[[nodiscard]] Bounds bounds(const TreeMeshes& meshes);

/// The estimate of an order whose meshes are there: vertices and triangles are exact.
[[nodiscard]] Estimate measured(const TreeOrder& order, const TreeMeshes& meshes);

/// Key of the images of bark: equal keys, equal images.
[[nodiscard]] std::string image_key(const TreePaint& paint);

/// The images of bark, as the workshop's Memo remembers them or painted now.
///
/// throws  InvalidInput, Cancelled
[[nodiscard]] std::shared_ptr<const ImageSet> painted_images(const TreePaint& paint,
                                                             const Workshop& workshop);

/// Grows a tree: one mesh of two primitives, bark and leaves, in two materials.
///
/// leaf_addresses  of the images of its leaves, for Textures::linked; those of extras are of bark
/// returns  the GLB as shared slices: header with JSON, geometry of bark and leaves, images of bark and leaves
/// throws   InvalidInput, Impossible, GenerationError, Cancelled
[[nodiscard]] Grown grow_tree(const TreeOrder& order, const Extras& extras = {},
                              const ImageAddresses& leaf_addresses = {},
                              const Workshop& workshop = {});

}  // namespace sporeprint
