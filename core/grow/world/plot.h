// Pipeline of a plot: from what stands and lies on a piece of a world to a GLB file.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "core/atlas/atlas.h"
#include "core/grow/execution_context.h"
#include "core/grow/product.h"
#include "core/plant/tree_spec.h"
#include "core/world/cover.h"
#include "core/world/ground.h"
#include "core/world/leaf_stamp.h"
#include "core/world/plot_ground.h"
#include "core/world/records.h"

namespace sporeprint {

/// What a plot shows, and the place and time of it.
struct PlotContent {
    const Ground* ground = nullptr;
    std::uint32_t seed = 1;  ///< of the world
    WorldPoint centre;
    double size = 10.0;  ///< of the square, metres, 2..32
    WorldTime time = 0;
    std::vector<std::string>
        kinds;  ///< ids of the presets of the trees of the stand, at most most_kinds
    std::vector<std::string> species;  ///< ids of the fungi
    /// All that live within plot_margin of the plot; those are shown whose foot is on it.
    std::span<const StandTree> trees;
    std::span<const DeadWood> dead_wood;  ///< all that may reach the plot
    std::span<const FruitBody> bodies;
    double soil_water = 80.0;  ///< of the day, mm (WeatherDay)
    /// Mean of the autumns, mm: on which the moss depends, and other cover that does not change with one rain.
    double lasting_water = 80.0;
    double snow = 0.0;        ///< share of the ground that snow covers, 0..1
    double snow_depth = 0.0;  ///< where it lies, metres
    double acidity = 0.5;     ///< of the soil, 0..1
    double micro = 0.06;      ///< amplitude of the finest relief, metres
    double wind_to = 0.0;     ///< direction to which the wind blows, radians from east to north
    bool is_southern =
        false;  ///< it lies south of the equator, where seasons are those of half a year later
    /// The share of the light of the open sky at a place in summer, metres; 1 if there is none.
    std::function<double(double, double)> light = {};
    /// The litter that falls at a place, as litterfall() returns it; that of the trees if there is none.
    std::function<std::array<double, most_kinds>(double, double)> fall = {};

    /// Returns the day of the year on which leaves, grass and flowers of the north are as those of the plot on its day.
    [[nodiscard]] int northern_day() const;
};

/// How far trees beyond a plot affect it, metres.
inline constexpr double plot_margin = 21.0;

/// The parts of a plot. `floor` is what lies and grows on the ground: dead wood, leaves, flowers, ferns and grass.
enum class PlotLayer { ground, trees, floor, fungi };
inline constexpr std::size_t plot_layer_count = 4;

constexpr const char* name(PlotLayer layer) {
    switch (layer) {
        case PlotLayer::ground:
            return "ground";
        case PlotLayer::trees:
            return "trees";
        case PlotLayer::floor:
            return "floor";
        case PlotLayer::fungi:
            return "fungi";
    }
    return nullptr;
}

/// How a plot is shown.
struct PlotOptions {
    int lod = 1;              ///< of fruit bodies, 0..2; of trees one more
    int texture_size = 1024;  ///< of the images of the floor, texels
    double litter = 20.0;     ///< leaves as meshes where leaves cover the ground, per m², 0..100
    LeafInstancing instancing = LeafInstancing::none;  ///< of leaves and of fruit bodies
    Textures textures = Textures::embedded;            ///< embedded or none
    FileOptions file;
    std::array<bool, plot_layer_count> layers{true, true, true, true};
    bool for_picture = false;  ///< trees are one level finer than in files, and have more triangles
    [[nodiscard]] bool has(PlotLayer layer) const {
        return layers[static_cast<std::size_t>(layer)];
    }
};

/// The budget of a plot: what exceeds it is shown with less detail.
inline constexpr std::uint64_t most_plot_triangles = 500'000,
                               most_picture_triangles = 1'800'000;  ///< of a plot in a picture
inline constexpr std::size_t most_plot_nodes = 400, most_plot_mushrooms = 16;

/// Returns the day of the year of a moment, 1..365.
[[nodiscard]] int day_of_year(WorldTime time);

/// Returns the rectangle of a plot.
[[nodiscard]] WorldBox box_of(const PlotContent& content);

/// Returns the feet of all trees near a plot, in the order in which they are given.
[[nodiscard]] std::vector<TreeFoot> feet_of(const PlotContent& content);

/// Returns the leaves that fall in a wood, by kind of tree.
///
/// throws  InvalidInput (path "/kinds") for an unknown tree, and for too many of them
[[nodiscard]] std::vector<LeafLitter> litter_of(const PlotContent& content, const Atlas& atlas);

/// Returns the cover of a plot and of the ground near it.
///
/// atlas   has the kinds of the stand
/// step    of the field, metres
/// throws  as litter_of()
[[nodiscard]] CoverField cover_of(const PlotContent& content, const Atlas& atlas,
                                  double step = CoverField::finest_step);

/// Paints the floor of a plot.
///
/// cover   cover_of() the content
/// side    of the images, texels
/// pieces  whether each leaf, needle and blade is painted (FloorPaint)
/// throws  as litter_of() and floor_images()
[[nodiscard]] RawImages floor_of(const PlotContent& content, const CoverField& cover, int side,
                                 bool pieces, const Atlas& atlas,
                                 const Parallel& parallel = in_turn);

/// Returns how young the leaves of broad-leaved trees are, 0..1 in eighths, how far they have turned, 0..1 in sixteenths, and
/// whether there are none.
struct LeafState {
    double spring = 0.0;
    double autumn = 0.0;
    bool bare = false;
    bool operator==(const LeafState&) const = default;
};
[[nodiscard]] LeafState leaves_on(int day);

/// Builds a plot: the middle of its square on the ground is the origin, x to the east, z to the south.
///
/// Each layer is the same whichever others there are, but for the detail of grass.
///
/// returns  the GLB: one mesh for the slab, one for each individual of a tree, each log and snag, leaves, flowers, ferns, grass, and
///          each individual of a mushroom; nodes for all trees and bodies. asset.extras lists these with their ids
/// throws   InvalidInput (paths "/kinds", "/species", "/size", "/layers", "/texture_size"), Impossible for linked images (path "/textures"), Cancelled
[[nodiscard]] Grown grow_plot(const PlotContent& content, const PlotOptions& options,
                              const Atlas& atlas, const Extras& extras = {},
                              const ExecutionContext& execution = {});

}  // namespace sporeprint
