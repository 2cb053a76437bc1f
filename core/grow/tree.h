// Pipeline of a tree: from a request to a GLB file.
#pragma once

#include <algorithm>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "core/atlas/atlas.h"
#include "core/grow/execution_context.h"
#include "core/grow/product.h"
#include "core/plant/tree_spec.h"

namespace sporeprint {

/// Returns the spec at the whole level of detail whose expected number of drawn triangles is nearest
/// to `triangles`, without that; a spec without it unchanged. All functions below do so themselves.
///
/// pre     check() reports nothing for the spec
/// throws  as estimate()
[[nodiscard]] TreeSpec at_level(TreeSpec spec);

/// Returns slightly high estimates of vertices and triangles, texels and bytes; takes microseconds.
/// For a sampled topology the expected numbers are used.
///
/// pre     check() reports nothing for the spec
/// throws  Impossible (path "/instancing") for instanced leaves with wind, (path "/order") naming
///         the expected number if it exceeds most_tips, (path "/leaves/per_tip") if it exceeds
///         most_leaves, (path "/twig_length") for segments too long for their radius
[[nodiscard]] Estimate estimate(const TreeSpec& spec);

/// The meshes of a tree; each is one draw call.
struct TreeMeshes {
    Mesh bark;
    /// All leaves, or one of those that stand at the places; empty for a bare tree.
    Mesh leaves;
    std::vector<GlbTransform> places;  ///< empty unless leaves are instanced
    Wind wind;                         ///< the same at every level of detail

    [[nodiscard]] std::size_t vertices() const {
        return bark.positions.size() + leaves.positions.size();
    }
    /// Returns the number of triangles that are drawn.
    [[nodiscard]] std::size_t triangles() const {
        return bark.triangles() + leaves.triangles() * std::max<std::size_t>(places.size(), 1);
    }
};

/// Returns the leaf of which a tree has many copies, from its preset in the atlas.
///
/// throws  InvalidInput (path "/leaf") if the atlas has no such leaf
[[nodiscard]] LeafParams leaf_of(const TreeParams& params, const Atlas& atlas);

/// Returns the meshes alone, in metres; the base of the trunk is at the origin. For an impostor they
/// are those that it shows.
///
/// throws  InvalidInput, also (path "/leaf") if the atlas has no such leaf; Impossible
[[nodiscard]] TreeMeshes tree_meshes(const TreeSpec& spec, const Atlas& atlas);

/// Returns the same for each level of detail of the file, finest first; none for an impostor alone.
[[nodiscard]] std::vector<TreeMeshes> level_meshes(const TreeSpec& spec, const Atlas& atlas);

/// Returns the bounding box of both meshes.
[[nodiscard]] Bounds bounds(const TreeMeshes& meshes);

/// Returns the requested level of detail and all below it, with estimated counts.
///
/// box     of the meshes
/// throws  as estimate()
[[nodiscard]] std::vector<Level> levels_of(const TreeSpec& spec, const Atlas& atlas,
                                           const Bounds& box);

/// Returns the estimate of a spec whose meshes are built, with exact vertex and triangle counts.
///
/// levels  level_meshes() of the spec
[[nodiscard]] Estimate measured(const TreeSpec& spec, std::span<const TreeMeshes> levels);

/// Returns the cache key of the images of bark: equal keys, equal images.
[[nodiscard]] std::string image_key(const TreePaint& paint, ImageFormat format);

/// Returns the images of bark, cached in execution.caches or painted now.
///
/// throws  InvalidInput, Cancelled
[[nodiscard]] std::shared_ptr<const ImageSet> painted_images(const TreePaint& paint,
                                                             const ExecutionContext& execution,
                                                             ImageFormat format = ImageFormat::jpg);

/// Builds a tree: for each level of detail one mesh of two primitives, bark and leaves; two
/// materials.
///
/// extras     its image URLs are those of the bark
/// leaf_urls  URLs of the images of its leaves, if has_addresses(textures)
/// returns    the GLB as shared slices: header with JSON, geometry and images of bark and leaves
/// throws     InvalidInput, also (path "/leaf") if the atlas has no such leaf; Impossible,
///            GenerationError, Cancelled
[[nodiscard]] Grown grow_tree(const TreeSpec& spec, const Atlas& atlas, const Extras& extras = {},
                              const ImageUrls& leaf_urls = {},
                              const ExecutionContext& execution = {});

}  // namespace sporeprint
