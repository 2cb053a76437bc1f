// A terrain that somebody has measured or made elsewhere, in place of hills that are grown.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/bytes.h"
#include "core/params/describe.h"

namespace sporeprint {

/// Least and greatest number of samples along each side of a terrain.
inline constexpr int least_terrain_side = 17, most_terrain_side = 2049;

/// Where the samples of a terrain are and what they mean.
struct TerrainScale {
    double metres = 1024.0;
    double min = 0.0;
    double max = 100.0;

    static constexpr void fields(auto visit) {
        using T = TerrainScale;
        visit(&T::metres, Info{.name = "metres",
                               .unit = "m",
                               .min = 16,
                               .max = 20'000,
                               .doc = "Distance of the first and the last sample of a row. The "
                                      "middle of the terrain is the centre of a world; a world "
                                      "that is larger has its mirror images around it."});
        visit(
            &T::min,
            Info{.name = "min", .unit = "m", .min = -500, .max = 9'000, .doc = "Height of black."});
        visit(&T::max, Info{.name = "max",
                            .unit = "m",
                            .min = -500,
                            .max = 9'000,
                            .doc = "Height of white, above that of black."});
    }
    bool operator==(const TerrainScale&) const = default;
};
static_assert(well_described<TerrainScale>());

/// A square of heights, north up.
struct TerrainMap {
    TerrainScale scale;
    int side = 0;                        ///< samples along each side
    std::vector<std::uint16_t> samples;  ///< rows from north to south, each from west to east

    /// Returns the height of a sample, metres.
    [[nodiscard]] double height(std::uint16_t sample) const {
        return scale.min + (scale.max - scale.min) * (sample / 65535.0);
    }
    /// Returns the memory that it takes.
    [[nodiscard]] std::size_t bytes() const {
        return sizeof(*this) + samples.size() * sizeof(samples[0]);
    }
    bool operator==(const TerrainMap&) const = default;
};

/// Checks what a terrain could not be grown on with.
///
/// throws  InvalidInput (path "max") if white is not above black, (path "metres") if a twentieth of the ground or more
///         is steeper than 80 degrees, which a wrong number of metres leads to
void check(const TerrainMap& map);

/// Returns the id of a terrain: "t-" and 32 hexadecimal digits of the SHA-256 of its file. Equal terrains have one id.
[[nodiscard]] std::string id_of(const TerrainMap& map);

/// Returns a terrain as a file for terrain_in(): its scale, its side, and samples with the low byte first.
[[nodiscard]] Bytes file_of(const TerrainMap& map);

/// Returns the terrain of a file, or nothing if it is not such a file.
[[nodiscard]] std::optional<TerrainMap> terrain_in(std::span<const std::uint8_t> file);

/// Returns heights of a terrain on the grid of a world. Where the grid is finer than the samples, heights between them
/// are those of Catmull-Rom splines; where it is coarser, the kernel is as much wider, so that details which the grid
/// cannot show do not become bumps of another size [MitchellNetravali1988].
///
/// extent   length of a side of the world, metres
/// returns  world_grid_side^2 heights in 1/height_units m
/// cost     25 ms for 2049^2 samples
[[nodiscard]] std::vector<std::int32_t> heights_of(const TerrainMap& map, int extent);

}  // namespace sporeprint
