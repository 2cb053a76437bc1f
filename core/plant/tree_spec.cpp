#include "core/plant/tree_spec.h"

#include <algorithm>

namespace sporeprint {

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
    // An impostor has no bark of its own.
    return {{params.texture_size >> std::min(params.lod, last_lod)}, params.look.bark};
}

LeafParams leaf_of(const TreeParams& params, const LeafPreset& preset) {
    LeafParams leaf = params_of(preset);
    leaf.spring = params.spring;
    leaf.autumn = params.autumn;
    leaf.snow = params.snow;
    // All leaves of a tree share one image: the same hole in each would be seen.
    leaf.shape.eaten = leaf.palette.marks = 0.0;
    leaf.lod = std::min(params.lod, last_lod);
    leaf.texture_size = params.texture_size;
    return leaf;
}

}  // namespace sporeprint
