// Leaves: the Kind of presets.h, and their routes.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "api/products/presets.h"
#include "core/grow/leaf.h"
#include "core/plant/leaf_spec.h"

namespace sporeprint::api {

/// The Kind of presets.h for leaves.
struct Leaves {
    using Preset = LeafPreset;
    using Spec = LeafSpec;
    using Params = LeafParams;
    using Paint = LeafPaint;
    static constexpr const char *one = "leaf", *all = "leaves";
    static std::span<const Preset> presets(const Atlas& atlas) { return atlas.leaves(); }
    static const Preset* find(const Atlas& atlas, std::string_view id) {
        return atlas.find_leaf(id);
    }

    static Grown grow(const LeafSpec& spec, const Atlas& atlas, const Extras& extras, int depth,
                      const ExecutionContext& execution);
    static Measures measure(const LeafSpec& spec, const Atlas& atlas,
                            const ExecutionContext& execution);
    static Cost cost_of_growing(const LeafSpec& spec);
    /// Returns the cost of measuring all levels of detail from the requested one on.
    static Cost cost_of_describing(const LeafSpec& spec);
    /// Returns the cost of painting these images.
    static Cost cost_of_paint(const LeafPaint& paint);
    /// Returns the cost of painting the images of a leaf.
    static Cost cost_of_painting(const LeafSpec& spec, const Atlas& atlas);
};

/// Returns the id of the first leaf whose base colour has alpha, or of the first one if none has.
[[nodiscard]] std::string example_needle(const Atlas& atlas);

extern const RouteGroup leaf_routes;

}  // namespace sporeprint::api
