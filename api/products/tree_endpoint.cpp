#include "api/products/preset_endpoint.h"
#include "core/grow/leaf.h"
#include "core/grow/tree.h"

namespace sporeprint::api {

namespace {

struct Recipe {
    static Grown grow(const TreeSpec& spec, const Extras& extras, int depth,
                      const ExecutionContext& execution) {
        ImageUrls of_leaves;
        if (spec.params.textures == Textures::linked) {
            const LeafParams leaf = leaf_of(spec.params);
            const std::string kind = name(spec.params.look.leaf);
            for (std::size_t i = 0; i < of_leaves.size(); ++i)
                of_leaves[i] = reference_from(
                    depth, with_version(canonical_image_address<Leaves>(
                                            kind, static_cast<ImageKind>(i), paint_of(leaf)),
                                        preset_token<Leaves>(kind)));
        }
        return grow_tree(spec, extras, of_leaves, execution);
    }

    static Cost cost(const TreeSpec& spec) {
        const double twigs = expected_tips(spec.params.look.shape.topology);
        return {.base = 100, .twigs = static_cast<std::uint64_t>(twigs)};
    }

    static Cost paint_cost(const TreeSpec& spec) {
        Cost cost = cost_of_paint(paint_of(spec.params));
        if (spec.params.look.leaves.per_tip > 0)
            cost += cost_of_paint(paint_of(leaf_of(spec.params)));
        return cost;
    }

    static std::pair<Estimate, Bounds> measure(const TreeSpec& spec,
                                               const ExecutionContext& execution) {
        execution.observer(Step::build);
        const TreeMeshes meshes = tree_meshes(spec);
        execution.observer(Step::pack);
        return {measured(spec, meshes), bounds(meshes)};
    }

    /// The matrix that the tree obeys, and its number of twigs on the mean.
    static void tell(const TreeSpec& spec, Value& body) {
        const TreeTopology& topology = spec.params.look.shape.topology;
        body.set("matrix", write(matrix_of(topology).rows));
        body.set("expected_twigs", expected_tips(topology));
    }
};

}  // namespace

Cost cost_of_paint(const TreePaint& paint) {
    const auto side = static_cast<std::uint64_t>(paint.texture_size.value);
    return {.bark_atlases = 1, .bark_texels = 3 * side * side};
}

Plan plan_tree(Context& context, const Request& request, PresetRequest<Trees> requested,
               ValidationErrors& errors) {
    return plan_preset<Trees, Recipe>(context, request, std::move(requested), errors);
}

Plan plan_surface(Context& context, const Request& request, const PresetSurface<Trees>& requested,
                  ValidationErrors& errors) {
    return plan_preset_surface<Trees>(context, request, requested, errors);
}

ImageResource image_of(const Context&, const PresetSurface<Trees>& requested) {
    return image_of<Trees>(requested);
}

}  // namespace sporeprint::api
