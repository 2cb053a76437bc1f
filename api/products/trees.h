// Trees: the Kind of presets.h, and their routes.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "api/products/presets.h"
#include "core/grow/impostor.h"
#include "core/grow/tree.h"
#include "core/plant/tree_spec.h"

namespace sporeprint::api {

/// The Kind of presets.h for trees.
struct Trees {
    using Preset = TreePreset;
    using Spec = TreeSpec;
    using Params = TreeParams;
    using Paint = TreePaint;
    static constexpr const char *one = "tree", *all = "trees";
    static std::span<const Preset> presets(const Atlas& atlas) { return atlas.trees(); }
    static const Preset* find(const Atlas& atlas, std::string_view id) {
        return atlas.find_tree(id);
    }

    /// Completes a body with a custom matrix: it is named `own`, has its highest order and is not
    /// blended, unless the body says otherwise. Problems of its rows are 422, each with its path;
    /// so are rows that no matrix of the body uses.
    static void take_from_body(Value& body, ValidationErrors& errors);

    /// Removes parameters without effect, so that equal trees have equal text.
    static void settle(Params& params) { without_unused_rows(params); }

    /// Returns true if a URL can express a specification; custom rows cannot be expressed.
    static bool has_address(const Spec& spec, const Atlas& atlas);

    /// Adds members to the item of a preset in the list.
    static void tell(const Preset& preset, Value& item) {
        item.set("order", preset.shape.topology.order);
    }

    /// Returns the text of further templates: those of the leaves that a tree can have.
    static const std::string& more_templates(const Atlas& atlas) { return atlas.leaf_text(); }

    static Grown grow(const TreeSpec& spec, const Atlas& atlas, const Extras& extras, int depth,
                      const ExecutionContext& execution);
    static Measures measure(const TreeSpec& spec, const Atlas& atlas,
                            const ExecutionContext& execution);
    static TreeSpec source(const TreeSpec& spec) { return impostor_source(spec); }
    static Cost cost_of_growing(const TreeSpec& spec);
    static Cost cost_of_paint(const TreePaint& paint);  ///< of these images
    static Cost cost_of_painting(const TreeSpec& spec, const Atlas& atlas);

    /// Adds the matrix of the tree and its expected number of twigs to the JSON description.
    static void add_details(const TreeSpec& spec, Value& body);
};

/// The folder of the images of leaves on trees, which is below that of the trees.
inline constexpr const char* folder_of_leaves = "/v1/trees/leaves/";

/// Returns the URLs of the images of the leaves of trees, with their version tokens.
///
/// leaf  id of the preset of the leaf
[[nodiscard]] ImageUrls foliage_image_urls(const std::string& leaf, const LeafPaint& paint,
                                           const Atlas& atlas);

extern const RouteGroup tree_routes;

}  // namespace sporeprint::api
