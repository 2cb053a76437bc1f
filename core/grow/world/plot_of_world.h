// What a world has on a plot: its trees, its dead wood and its fruit bodies, ready to be shown.
#pragma once

#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "core/grow/world/parts.h"
#include "core/grow/world/plot.h"
#include "core/world/canopy_light.h"
#include "core/world/cover.h"

namespace sporeprint {

/// The place of a plot: its middle, from the centre of the world, and the length of its sides, metres.
struct PlotPlace {
    double x = 0.0, y = 0.0, size = 10.0;
};

/// Returns the crowns of the trees that stand in a rectangle at a moment, in the order of the trees.
[[nodiscard]] std::vector<Crown> crowns_in(const World& world, std::span<const StandTree> trees,
                                           const WorldBox& box, WorldTime time);

/// Returns from where litter falls of the trees that stand in a rectangle at a moment, in the order of the trees.
[[nodiscard]] std::vector<LitterSource> litter_in(std::span<const StandTree> trees,
                                                  const WorldBox& box, WorldTime time);

/// Returns which kinds of the trees of a world have needles. Those that the atlas does not have have none.
[[nodiscard]] std::array<bool, most_kinds> needles_of(const World& world, const Atlas& atlas);

/// Returns the share of the light of the open sky at places of a world in summer (PlotContent::light).
///
/// canopy  crowns above the places; it and the world must outlive the result
[[nodiscard]] std::function<double(double, double)> light_below(const World& world,
                                                                const CanopyLight& canopy);

/// Returns what a plot shows of a world but for trees, dead wood, fruit bodies and light.
///
/// world  must outlive the result
[[nodiscard]] PlotContent content_of(const World& world, const PlotPlace& place, WorldTime time);

/// A plot of a world. Its content refers to the other members, so that it cannot be copied.
struct WorldPlot {
    std::shared_ptr<const World> world;
    Block around;                   ///< what may shade it or lie on it, of all times
    std::vector<FruitBody> bodies;  ///< that stand on it
    std::optional<CanopyLight> canopy;
    PlotContent content;

    WorldPlot() = default;
    WorldPlot(const WorldPlot&) = delete;
    WorldPlot& operator=(const WorldPlot&) = delete;
    ~WorldPlot() = default;
};

/// Returns what a world has on a plot at a moment.
///
/// time  from year 0 to last_year
/// cost  0.1 s where nothing is known of the surroundings, 10 ms where everything is
[[nodiscard]] std::unique_ptr<const WorldPlot> plot_of_world(std::shared_ptr<const World> world,
                                                             const PlotPlace& place, WorldTime time,
                                                             const ExecutionContext& execution);

}  // namespace sporeprint
