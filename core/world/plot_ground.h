// The ground of a plot: its heights with the relief that is too fine for the grid of a world, and a closed slab.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <span>
#include <utility>
#include <vector>

#include "core/mesh/mesh.h"
#include "core/world/ground.h"

namespace sporeprint {

/// The foot of a trunk, about which the ground is raised.
struct TreeFoot {
    double x = 0.0, y = 0.0;  ///< metres
    double diameter = 0.3;    ///< at breast height, metres
};

/// How far the ground is raised round the thickest trunk of 0.66 m, metres.
inline constexpr double most_flare_reach = 5.0;

/// Heights of the floor of a world: the ground with waves of up to 4 m and with raised ground round trunks.
class FloorHeights {
  public:
    /// ground  lives as long as the heights
    /// seed    of the world
    /// micro   amplitude of the waves, metres
    /// feet    of all trees within most_flare_reach of the places that are evaluated, in the order of
    ///         their ids
    FloorHeights(const Ground& ground, std::uint32_t seed, double micro,
                 std::span<const TreeFoot> feet);

    /// Computes the heights of a grid of places, metres.
    ///
    /// x, y     columns and rows, metres
    /// returns  y.size() rows of x.size() heights. A place has one height, whatever grid it is part of
    [[nodiscard]] std::vector<double> at(std::span<const double> x,
                                         std::span<const double> y) const;
    /// Returns the height of one place.
    [[nodiscard]] double at(double x, double y) const;

  private:
    /// A row of places while their heights are computed: coordinates and the noise of a wave.
    struct Row {
        std::span<const double> x;
        std::span<const Coordinate> columns;
        std::span<float> u, v, noise;
    };
    void heights_of(const Row& row, double north, std::span<const TreeFoot> feet,
                    std::span<double> out) const;

    const Ground* ground_;
    double micro_;
    std::vector<std::uint32_t> seeds_;  ///< of the waves
    std::vector<TreeFoot> feet_;
    /// The feet that raise the ground in squares of 20 m, by columns and rows, in their order.
    std::map<std::pair<int, int>, std::vector<TreeFoot>> near_;
};

/// Heights of the vertices of a slab are multiples of this, so that they are exact as floats.
inline constexpr double slab_step = 1.0 / 4096.0;

/// Returns a height as a multiple of a step.
[[nodiscard]] double slab_height(double height, double step = slab_step);

/// A slab of ground.
struct SlabParams {
    WorldBox box;
    int nodes = 129;          ///< of the top along each side, at least 2
    int texture_side = 1024;  ///< of its images: the outermost texels are on the borders
    double height = 0.0;      ///< in the world of what is at y = 0, a multiple of the step
    double depth = 0.4;       ///< below its lowest place, metres
    double step = slab_step;  ///< that heights are multiples of: slab_step times a power of two
    /// Walls have no more vertices than close the slab, and the bottom shares theirs.
    bool is_seen_from_above = false;
};

/// Returns a closed slab: the floor, walls and a level bottom. The middle of the box is at the origin, x
/// to the east, z to the south.
///
/// returns  positions, normals, tangents, texture coordinates and tints; the vertices of the top come
///          first, by rows from north to south. Walls show the image beside their border, darkened
/// cost     O(nodes²)
[[nodiscard]] Mesh slab_mesh(const SlabParams& params, const FloorHeights& heights);

/// Heights of a grid of places, as FloorHeights::at() returns them.
using GridHeights =
    std::function<std::vector<double>(std::span<const double> x, std::span<const double> y)>;

/// Returns a slab whose top has other heights.
[[nodiscard]] Mesh slab_mesh(const SlabParams& params, const GridHeights& heights);

/// Returns a thin body of soil before the walls of a slab: litter, humus, topsoil and subsoil as its tints. It needs no
/// image.
///
/// slab  slab_mesh() of the parameters
[[nodiscard]] Mesh soil_round(const Mesh& slab, const SlabParams& params);

}  // namespace sporeprint
