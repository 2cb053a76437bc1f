// Plots of worlds: a piece of a wood or meadow as one GLB file, what is on it as JSON, and a picture of it.
#pragma once

#include "api/products/context.h"
#include "api/products/product.h"
#include "core/params/value.h"

namespace sporeprint::api {

/// Handles GET /v1/worlds/{world}/{time}/plot.glb, .json and .png, and POST /v1/worlds/plot.glb, .json and .png.
template <Product File>
Plan plan_plot(RouteCall& call);

/// Returns the schema of the query of a plot, and of that of a picture.
[[nodiscard]] Value plot_query_schema(const Atlas& atlas);
[[nodiscard]] Value plot_picture_query_schema(const Atlas& atlas);

/// Returns the schema of the JSON of a plot.
[[nodiscard]] Value plot_schema();

}  // namespace sporeprint::api
