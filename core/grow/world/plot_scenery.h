// The world round a plot as a camera there sees it, for pictures: ground that is finer the nearer it is, trees, dead
// wood, grass, leaves and fruit bodies, in the light of the day.
#pragma once

#include <cstdint>

#include "core/atlas/atlas.h"
#include "core/grow/execution_context.h"
#include "core/grow/world/plot.h"
#include "core/grow/world/plot_of_world.h"
#include "core/render/render.h"

namespace sporeprint {

/// About the most triangles of a scenery, and the side of an image with as many texels as all of its ground has.
inline constexpr std::uint64_t most_scenery_triangles = 3'500'000;
inline constexpr int scenery_texels = 2048;

/// Returns the light of the early morning of a day, as its weather lets it through: the sky is overcast on days with
/// rain, and hazy after them.
[[nodiscard]] Daylight daylight_on(const World& world, WorldTime time);

/// Draws what a camera that stands on a plot sees. Trees stand as far as 125 m away, fruit bodies, leaves and tall grass
/// as far as the plot and 6 m round it.
///
/// options  the level of detail, the leaves and the layers count
/// params   the size of the picture counts
/// throws   as grow_plot() and rendered_from()
/// cost     2 to 4 s in a wood
[[nodiscard]] RgbaImage scenery_of(const WorldPlot& plot, const PlotOptions& options,
                                   const StandingCamera& camera, const PictureParams& params,
                                   const Atlas& atlas, const ExecutionContext& execution);

}  // namespace sporeprint
