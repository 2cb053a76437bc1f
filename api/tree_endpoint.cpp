#include "api/preset_endpoint.h"
#include "core/grow/leaf.h"
#include "core/grow/tree.h"

namespace sporeprint::api {

namespace {

struct Recipe {
    static Grown grow(const TreeOrder& order, const Extras& extras, int depth,
                      const Workshop& workshop) {
        ImageAddresses of_leaves;
        if (order.params.textures == Textures::linked) {
            const LeafParams leaf = leaf_of(order.params);
            const std::string kind = name(order.params.look.leaf);
            for (std::size_t i = 0; i < of_leaves.size(); ++i)
                of_leaves[i] = reference_from(
                    depth, with_version(canonical_image_address<Leaves>(
                                            kind, static_cast<ImageKind>(i), paint_of(leaf)),
                                        preset_token<Leaves>(kind)));
        }
        return grow_tree(order, extras, of_leaves, workshop);
    }

    static Cost cost(const TreeOrder& order) {
        const double twigs = expected_tips(order.params.look.shape.topology);
        return {.base = 100, .twigs = static_cast<std::uint64_t>(twigs)};
    }

    static Cost paint_cost(const TreeOrder& order) {
        Cost cost = cost_of_paint(paint_of(order.params));
        if (order.params.look.leaves.per_tip > 0)
            cost += cost_of_paint(paint_of(leaf_of(order.params)));
        return cost;
    }

    static std::pair<Estimate, Bounds> measure(const TreeOrder& order, const Workshop& workshop) {
        workshop.observer(Step::build);
        const TreeMeshes meshes = tree_meshes(order);
        workshop.observer(Step::pack);
        return {measured(order, meshes), bounds(meshes)};
    }

    /// The matrix that the tree obeys, and its number of twigs on the mean.
    static void tell(const TreeOrder& order, Value& body) {
        const TreeTopology& topology = order.params.look.shape.topology;
        body.set("matrix", write(matrix_of(topology).rows));
        body.set("expected_twigs", expected_tips(topology));
    }
};

}  // namespace

Cost cost_of_paint(const TreePaint& paint) {
    const auto side = static_cast<std::uint64_t>(paint.texture_size.value);
    return {.bark_atlases = 1, .bark_texels = 3 * side * side};
}

Plan plan_tree(Context& context, const Request& request, PresetRequest<Trees> asked,
               Faults& faults) {
    return plan_preset<Trees, Recipe>(context, request, std::move(asked), faults);
}

Plan plan_surface(Context& context, const Request& request, const PresetSurface<Trees>& asked,
                  Faults& faults) {
    return plan_preset_surface<Trees>(context, request, asked, faults);
}

ImageResource image_of(const Context&, const PresetSurface<Trees>& asked) {
    return image_of<Trees>(asked);
}

}  // namespace sporeprint::api
