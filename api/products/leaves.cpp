#include "api/products/preset_endpoint.h"
#include "core/grow/leaf.h"

namespace sporeprint::api {

namespace {

struct Recipe {
    static Grown grow(const LeafSpec& spec, const Extras& extras, int,
                      const ExecutionContext& execution) {
        return grow_leaf(spec, extras, execution);
    }

    static Cost cost(const LeafSpec&) { return {.base = 150}; }

    static Cost paint_cost(const LeafSpec& spec) { return cost_of_paint(paint_of(spec.params)); }

    static std::pair<Estimate, Bounds> measure(const LeafSpec& spec,
                                               const ExecutionContext& execution) {
        execution.observer(Step::build);
        const Mesh mesh = leaf_mesh(spec);
        execution.observer(Step::pack);
        return {measured(spec, mesh), bounds(mesh)};
    }
};

}  // namespace

Cost cost_of_paint(const LeafPaint& paint) {
    const auto side = static_cast<std::uint64_t>(paint.texture_size.value);
    const auto vertices = static_cast<std::uint64_t>(most_of_leaf(paint.venation, 0).vertices);
    return {.leaf_atlases = 1,
            .leaf_rows = side,
            .leaf_texels = 3 * side * side,
            .leaf_row_vertices = side * vertices};
}

Plan plan_leaf(Context& context, const Request& request, PresetRequest<Leaves> requested,
               ValidationErrors& errors) {
    return plan_preset<Leaves, Recipe>(context, request, std::move(requested), errors);
}

Plan plan_surface(Context& context, const Request& request, const PresetSurface<Leaves>& requested,
                  ValidationErrors& errors) {
    return plan_preset_surface<Leaves>(context, request, requested, errors);
}

ImageResource image_of(const Context&, const PresetSurface<Leaves>& requested) {
    return image_of<Leaves>(requested);
}

}  // namespace sporeprint::api
