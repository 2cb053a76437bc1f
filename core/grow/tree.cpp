#include "core/grow/tree.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <utility>

#include "core/gltf/glb.h"
#include "core/grow/leaf.h"
#include "core/mesh/index_order.h"
#include "core/params/canonical.h"
#include "core/params/messages.h"
#include "core/params/reader.h"

namespace sporeprint {

namespace {

// One seed for the images of bark, so that all trees of a style share them.
constexpr std::uint32_t bark_seed = 1;

// Bark is rough: 1/4 byte per texel as JPEG; leaves are smoother. 1/5 is between both.
std::uint64_t image_bytes(std::uint64_t texels) { return texels / 5 + 3000; }

std::uint64_t texels_of(const TreeParams& params) {
    const auto side = static_cast<std::uint64_t>(params.texture_size) >> params.lod;
    const std::uint64_t kinds = params.look.leaves.per_tip > 0 ? 2 : 1;
    return params.textures == Textures::none ? 0 : kinds * 3 * side * side;
}

void finish(Mesh& mesh, const TreeParams& params) {
    for (glm::vec3& place : mesh.positions) place *= static_cast<float>(params.size);
    if (params.textures == Textures::none) {
        mesh.texture_coordinates.clear();
        mesh.tangents.clear();
    }
    order_for_vertex_cache(mesh);
}

// Throws Impossible when parameters that are each in range together exceed the bounds of a skeleton.
void refuse_beyond_bounds(const Tree& tree) {
    const std::vector<Problem> faults = faults_of(tree.skeleton);
    if (faults.empty()) return;
    const bool of_radius = faults.front().path.ends_with("/radius");
    throw Impossible(
        of_radius ? "/twig_radius" : "/twig_length",
        std::string(of_radius ? "the radius" : "the place") +
            " of a branch would be out of bounds, for its order makes so much of it: " +
            faults.front().message);
}

// Returns the leaves that remain at a level of detail. At coarse levels a leaf represents others
// near it: it is enlarged about its middle, not away from its twig.
std::vector<PlacedLeaf> leaves_of(const Tree& tree, const TreeParams& params) {
    const std::vector<PlacedLeaf> all = placed_leaves(tree, params.look.leaves, params.seed);
    std::vector<PlacedLeaf> left =
        thinned(all, leaf_share(params.lod, static_cast<double>(all.size())));
    if (params.lod < 2) return left;
    const double middle = 0.5 * shape_of(leaf_of(params)).length;
    for (std::size_t i = 0; i < left.size(); ++i)
        left[i].place -= middle * (left[i].size - all[i].size) * left[i].along;
    return left;
}

}  // namespace

Estimate measured(const TreeOrder& order, const TreeMeshes& meshes) {
    const TreeParams& params = order.params;
    Estimate e;
    e.vertices = meshes.vertices();
    e.triangles = meshes.triangles();
    e.texels = texels_of(params);
    e.bytes = estimated_bytes(e.vertices, e.triangles, params.textures, image_bytes(e.texels));
    return e;
}

Estimate estimate(const TreeOrder& order) {
    const TreeParams& params = order.params;
    const TreeLook& look = params.look;
    const double tips = expected_tips(look.shape.topology);
    if (tips > static_cast<double>(most_tips))
        throw Impossible("/order", "the tree would have about " +
                                       number_text(std::floor(tips + 0.5)) + " twigs; at most " +
                                       std::to_string(most_tips) + " are grown");
    const double all = tips * look.leaves.per_tip;
    if (all > static_cast<double>(most_leaves))
        throw Impossible("/leaves/per_tip", std::to_string(look.leaves.per_tip) + " make about " +
                                                number_text(std::floor(all + 0.5)) + " leaves on " +
                                                number_text(std::floor(tips + 0.5)) +
                                                " twigs; at most " + std::to_string(most_leaves) +
                                                " are placed");
    const TreeCount bark = count_of_bark(look.shape, params.lod);
    const auto leaves = static_cast<std::uint64_t>(std::ceil(leaf_share(params.lod, all) * all));
    const std::uint64_t triangles = leaf_triangles(params.lod, leaves);
    Estimate e;
    e.vertices = static_cast<std::uint64_t>(bark.vertices) + leaves * (triangles + 2);
    e.triangles = static_cast<std::uint64_t>(bark.triangles) + leaves * triangles;
    e.texels = texels_of(params);
    e.bytes = estimated_bytes(e.vertices, e.triangles, params.textures, image_bytes(e.texels));
    return e;
}

TreeMeshes tree_meshes(const TreeOrder& order) {
    const TreeParams& params = order.params;
    require_valid(params);
    static_cast<void>(estimate(order));  // throws if the tree is too large
    const Tree tree = grown_tree(params.look.shape, params.seed);
    refuse_beyond_bounds(tree);
    TreeMeshes meshes{bark_of(tree, params.lod), {}};
    const std::vector<PlacedLeaf> leaves = leaves_of(tree, params);
    if (!leaves.empty())
        meshes.leaves = merged_leaves(
            leaves,
            foliage_leaf(shape_of(leaf_of(params)), leaf_triangles(params.lod, leaves.size())));
    finish(meshes.bark, params);
    if (!leaves.empty()) finish(meshes.leaves, params);
    return meshes;
}

Bounds bounds(const TreeMeshes& meshes) {
    Bounds box = bounds(meshes.bark);
    if (meshes.leaves.positions.empty()) return box;
    const Bounds leaves = bounds(meshes.leaves);
    return {glm::min(box.min, leaves.min), glm::max(box.max, leaves.max)};
}

std::string image_key(const TreePaint& paint) { return "bark " + canonical_text(paint); }

std::shared_ptr<const ImageSet> painted_images(const TreePaint& paint, const Workshop& workshop) {
    require_valid(paint);
    return workshop.memo.images(image_key(paint), [&] {
        const RawImages images =
            bark_images(paint.bark, bark_seed, paint.texture_size, workshop.parallel);
        throw_if_cancelled(workshop);
        return std::make_shared<const ImageSet>(encoded(images, workshop.parallel));
    });
}

Grown grow_tree(const TreeOrder& order, const Extras& extras, const ImageAddresses& leaf_addresses,
                const Workshop& workshop) {
    const TreeParams& params = order.params;
    workshop.observer(Step::build);
    const TreeMeshes meshes = tree_meshes(order);
    throw_if_cancelled(workshop);
    const std::string name = order.preset.empty() ? "tree" : order.preset;
    GlbScene scene;
    scene.materials.push_back({.name = "bark", .goes_round = true});
    scene.meshes.push_back({name, {{&meshes.bark, 0, {}}}});
    scene.nodes.push_back({.name = name});
    const bool leafy = !meshes.leaves.positions.empty();
    if (leafy) {
        scene.materials.push_back({.name = "leaves"});
        scene.meshes[0].primitives.push_back({&meshes.leaves, 1, {}});
    }
    const auto bark_images =
        attach_images(scene.materials[0], params.textures, extras.image_addresses, workshop,
                      [&] { return painted_images(paint_of(params), workshop); });
    std::shared_ptr<const ImageSet> leaf_images;
    if (leafy)
        leaf_images =
            attach_images(scene.materials[1], params.textures, leaf_addresses, workshop,
                          [&] { return painted_images(paint_of(leaf_of(params)), workshop); });
    workshop.observer(Step::pack);
    scene.extras_json = extras_json(extras, write(params), bounds(meshes), meshes.triangles());
    return {glb(scene), meshes.vertices(), meshes.triangles()};
}

}  // namespace sporeprint
