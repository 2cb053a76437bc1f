// Plots of worlds: a piece of a wood or meadow as one GLB file, and what is on it as JSON.
#pragma once

#include "api/products/context.h"
#include "core/params/value.h"

namespace sporeprint::api {

/// The files of a plot.
enum class PlotFile {
    glb,
    json  ///< what stands, lies and grows on it
};

/// Handles GET /v1/worlds/{world}/{time}/plot.glb and .json.
template <PlotFile File>
Plan plan_plot(RouteCall& call);

/// Returns the schema of the query of a plot.
[[nodiscard]] Value plot_query_schema(const Atlas& atlas);

/// Returns the schema of the JSON of a plot.
[[nodiscard]] Value plot_schema();

}  // namespace sporeprint::api
