#include "api/preset_endpoint.h"
#include "core/grow/leaf.h"

namespace sporeprint::api {

namespace {

struct Recipe {
    static Grown grow(const LeafOrder& order, const Extras& extras, int, const Workshop& workshop) {
        return grow_leaf(order, extras, workshop);
    }

    static Cost cost(const LeafOrder&) { return {.base = 150}; }

    static Cost paint_cost(const LeafOrder& order) { return cost_of_paint(paint_of(order.params)); }

    static std::pair<Estimate, Bounds> measure(const LeafOrder& order, const Workshop& workshop) {
        workshop.observer(Step::build);
        const Mesh mesh = leaf_mesh(order);
        workshop.observer(Step::pack);
        return {measured(order, mesh), bounds(mesh)};
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

Plan plan_leaf(Context& context, const Request& request, PresetRequest<Leaves> asked,
               Faults& faults) {
    return plan_preset<Leaves, Recipe>(context, request, std::move(asked), faults);
}

Plan plan_surface(Context& context, const Request& request, const PresetSurface<Leaves>& asked,
                  Faults& faults) {
    return plan_preset_surface<Leaves>(context, request, asked, faults);
}

ImageResource image_of(const Context&, const PresetSurface<Leaves>& asked) {
    return image_of<Leaves>(asked);
}

}  // namespace sporeprint::api
