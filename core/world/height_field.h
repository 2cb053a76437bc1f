// Heights of the ground of a world: a square grid of nodes, and the sum of octaves of noise that gives
// the height of every place before erosion.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/world/terrain_params.h"

namespace sporeprint {

/// A square grid of nodes in the plane of a world: x to the east, y to the north, metres from the
/// centre of the world. Values on a grid are stored by rows from south to north, each from west to
/// east.
struct Grid {
    int side = 0;         ///< number of nodes along each side
    double cell = 1.0;    ///< distance of neighbouring nodes, metres
    double origin = 0.0;  ///< x and also y of the first node, metres

    [[nodiscard]] std::size_t nodes() const {
        return static_cast<std::size_t>(side) * static_cast<std::size_t>(side);
    }
    [[nodiscard]] std::size_t index(int column, int row) const {
        return static_cast<std::size_t>(row) * static_cast<std::size_t>(side) +
               static_cast<std::size_t>(column);
    }
    /// Returns x of a column, or y of a row, metres.
    [[nodiscard]] double place(int number) const { return origin + number * cell; }
    bool operator==(const Grid&) const = default;
};

/// Heights are stored as integers, this many to the metre.
inline constexpr int height_units = 1024;

/// Number of nodes along each side of the grid of a world.
inline constexpr int world_grid_side = 513;

/// Returns the grid of a world. It reaches beyond the extent by an eighth on each side, so that the
/// rims of the world have catchments. Its places are multiples of 5/8 m, exact in float, and the
/// grids of two extents share places.
///
/// extent  length of a side of the world, metres
/// throws  InvalidInput (path "extent") if it is not 256, 1024 or 4096
[[nodiscard]] Grid world_grid(int extent);

/// The height of every place of a world before erosion: the sum t of eight octaves of gradient noise,
/// each with twice the frequency of the one before, `roughness` of its amplitude, and a shift and a
/// rotation of its own, so that no two lattices coincide. The places of the largest three are
/// displaced by two further noises (domain warping). t has mean 0 and standard deviation 1 over the
/// whole plane. The height is
///
///     relief / 4 * (t + 0.6 * (sqrt(t * t + 1) - 1)),
///
/// which makes valleys wider and flatter than ridges. So `relief` is the difference between the
/// heights of t = 2 and t = -2, 19 of 20 places lie between these, and half of all places are below
/// 0. A world that is smaller than its largest hills shows less. Heights depend on parameters and
/// seed only, not on the extent.
///
/// source  [Ebert2003] ch. 16 for the sum of octaves; [Perlin2002] for the noise
class HeightFunction {
  public:
    static constexpr int octaves = 8;

    /// throws  InvalidInput if a parameter is out of range
    HeightFunction(const TerrainParams& params, std::uint32_t seed);

    /// Computes heights, metres, not rounded.
    ///
    /// x, y    places, metres from the centre of the world, N of each, at most 10,000 m from it
    /// out     N heights
    /// throws  InvalidInput if the lengths differ
    void heights(std::span<const float> x, std::span<const float> y, std::span<double> out) const;

  private:
    /// An affine map from metres to the coordinates of a noise, the seed of that noise, and the
    /// factor of its result.
    struct Octave {
        float xx = 0.0F, xy = 0.0F, x0 = 0.0F;
        float yx = 0.0F, yy = 0.0F, y0 = 0.0F;
        std::uint32_t seed = 0;
        double amplitude = 0.0;

        void sample(std::span<const float> x, std::span<const float> y, std::span<float> out) const;
    };

    [[nodiscard]] static Octave octave_of(std::uint32_t seed, std::uint32_t object, double size);
    void add_block(std::span<const float> x, std::span<const float> y, std::span<double> out) const;

    std::array<Octave, octaves> octaves_;
    std::array<Octave, 2> warps_;
    double deviation_ = 0.0;  ///< metres per standard deviation of the octaves
};

/// Returns heights of the ground before erosion on the grid of a world.
///
/// seed     of the world
/// returns  world_grid_side^2 heights in 1/height_units m, rounded to the nearest; those of two
///          extents agree where their grids share a place
/// throws   InvalidInput if a parameter is out of range, or as world_grid()
/// cost     10 noises of each node
[[nodiscard]] std::vector<std::int32_t> heights_of(const TerrainParams& params, std::uint32_t seed,
                                                   int extent);

/// Returns a height in metres as the nearest integer of 1/height_units m; |height| < 1e6.
[[nodiscard]] std::int32_t quantised_height(double height);

}  // namespace sporeprint
