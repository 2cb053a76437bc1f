#include "core/plant/tree_spec.h"

#include <algorithm>
#include <array>

namespace sporeprint {

namespace {

// Largest number of triangles of a tree's foliage, unless each leaf already has only eight.
constexpr std::size_t most_tree_foliage_triangles = 160'000;

}  // namespace

TreeParams params_of(const TreePreset& preset) {
    TreeParams params;
    params.look.shape = preset.shape;
    params.look.leaf = preset.leaf;
    params.look.leaves = preset.leaves;
    params.look.bark = preset.bark;
    return params;
}

void without_unused_rows(TreeParams& params) {
    if (!params.look.shape.topology.uses_rows()) params.look.shape.topology.rows.clear();
}

TreePaint paint_of(const TreeParams& params) {
    return {{params.texture_size >> params.lod}, params.look.bark};
}

LeafParams leaf_of(const TreeParams& params, const LeafPreset& preset) {
    LeafParams leaf = params_of(preset);
    leaf.autumn = params.autumn;
    leaf.lod = params.lod;
    leaf.texture_size = params.texture_size;
    return leaf;
}

double leaf_share(int lod, double leaves) {
    constexpr std::array<double, 4> shares = {1.0, 0.4, 0.12, 0.03},
                                    least = {0.0, 400.0, 160.0, 50.0};
    const auto level = static_cast<std::size_t>(std::clamp(lod, 0, 3));
    return leaves > 0.0 ? std::max(shares[level], std::min(1.0, least[level] / leaves)) : 1.0;
}

std::size_t leaf_triangles(int lod, std::size_t leaves) {
    std::size_t triangles = lod == 0 ? most_foliage_triangles : lod == 1 ? 12 : 8;
    while (triangles > 8 && triangles * leaves > most_tree_foliage_triangles) triangles -= 4;
    return triangles;
}

}  // namespace sporeprint
