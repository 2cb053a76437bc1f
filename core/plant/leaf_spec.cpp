#include "core/plant/leaf_spec.h"

#include "core/plant/leaf_spray.h"

namespace sporeprint {

LeafParams params_of(const LeafPreset& preset) {
    LeafParams params;
    params.shape = preset.shape;
    params.palette = preset.palette;
    return params;
}

LeafPaint paint_of(const LeafParams& params) {
    LeafPaint paint;
    paint.seed = params.seed;
    paint.variation = params.variation;
    paint.spring = params.spring;
    paint.autumn = params.autumn;
    paint.snow = params.snow;
    paint.texture_size = {params.texture_size >> params.lod};
    paint.relief = params.shape.relief;
    // Images of compound leaves show no damage.
    paint.eaten = params.shape.leaflets.count > 0 ? 0.0 : params.shape.eaten;
    paint.venation = params.shape.venation;
    paint.palette = params.palette;
    return paint;
}

LeafPaint paint_on_tree(const LeafParams& params) {
    LeafPaint paint = paint_of(params);
    paint.sprays = shows_sprays(params.shape);
    return paint;
}

LeafShape shape_of(const LeafParams& params) {
    return individual_leaf(params.shape, params.seed, params.variation);
}

}  // namespace sporeprint
