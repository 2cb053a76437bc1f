// The texels of a floor while it is painted, as the vector kernels of floor_kernels.inl see them.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>

namespace sporeprint {

/// What is known of a texel: its colour as sRGB, 0..1, the height of what lies there in metres, its roughness, and how
/// much of moss and of water hides what lies there.
enum FloorPlane : std::size_t {
    floor_red,
    floor_green,
    floor_blue,
    floor_height,
    floor_roughness,
    floor_moss,
    floor_water,
    floor_planes
};

/// Coordinates of texels and pieces are integers, this many to the metre: their differences are exact, and the same in
/// all images.
inline constexpr double floor_units = 524288.0;

/// Kernels read and write so many texels beyond the last one of a row.
inline constexpr std::size_t floor_padding = 8;

/// A part of the images with the texels round it that it depends on.
struct FloorCanvas {
    int columns = 0, rows = 0;
    std::size_t stride = 0;           ///< columns and floor_padding
    const std::int32_t* x = nullptr;  ///< of columns and padding, in floor_units
    const std::int32_t* y = nullptr;  ///< of rows
    std::unique_ptr<float[]> values;  ///< by rows, in these by planes

    [[nodiscard]] float* at(int row, std::size_t plane) {
        return values.get() + (static_cast<std::size_t>(row) * floor_planes + plane) * stride;
    }
    [[nodiscard]] const float* at(int row, std::size_t plane) const {
        return values.get() + (static_cast<std::size_t>(row) * floor_planes + plane) * stride;
    }
};

/// Noises of the soil, from the broadest to the finest.
enum FloorNoise : std::size_t { noise_broad, noise_middle, noise_clods, noise_crumbs, noise_tufts };
inline constexpr std::size_t floor_noises = 5;

/// Coordinates of noises are integers too, of so many bits below the cell of a lattice.
inline constexpr int noise_bits = 13;

/// Shares of the ground that the soil is painted from. Half of the herbs count as grass.
enum FloorShare : std::size_t {
    share_leaves,
    share_needles,
    share_moss,
    share_grass,
    share_rock,
    share_water
};
inline constexpr std::size_t floor_shares = 6;

/// A row of soil. The coordinates of a noise at column i are (u[i] + u0, v0 - v[i]).
struct SoilRow {
    std::array<const std::int32_t*, floor_noises> u{}, v{};
    std::array<std::int32_t, floor_noises> u0{}, v0{};
    std::array<std::uint32_t, floor_noises> seeds{};
    std::size_t nodes = 0;         ///< of the field of cover along the row
    const int* columns = nullptr;  ///< the first column beyond each node but the last one
    const float* part = nullptr;   ///< how far each column is from its node to the next one
    std::array<const float*, floor_shares> shares{};  ///< at the nodes
    std::array<float*, floor_shares> between{};       ///< space for a row of each
};

/// Texels from which a piece may be seen: rows and columns, both ends within.
struct FloorRange {
    int west = 0, east = 0, north = 0, south = 0;
};

/// A straight line.
struct FloorStroke {
    FloorRange range;
    std::int32_t x = 0, y = 0;             ///< of its begin, in floor_units
    float way_x = 0.0F, way_y = 0.0F;      ///< to its end, metres
    float along_x = 0.0F, along_y = 0.0F;  ///< the way divided by its square
    float half = 0.0F;                     ///< of its width, metres
    float per_texel = 1.0F;                ///< texels per metre
    float strength = 1.0F, roughness = 0.9F;
    float height = 0.0F;  ///< metres
    std::array<float, 3> colour{};
};

/// A leaf.
struct FloorLeaf {
    FloorRange range;
    std::int32_t x = 0, y = 0;         ///< of its middle, in floor_units
    float cosine = 0.0F, sine = 0.0F;  ///< of its direction, divided by its length in metres
    float half = 0.0F;                 ///< of its breadth, in lengths
    int columns = 0, rows = 0;         ///< of its stamp
    const std::uint32_t* colours =
        nullptr;  ///< of texels: red, green, blue, cover, from the lowest byte on
    const float* rises = nullptr;
    std::array<float, 3> tint{};
    float hidden = 0.0F;                 ///< how much of it moss hides
    float height = 0.0F, length = 0.0F;  ///< metres
    float slope_x = 0.0F, slope_y = 0.0F, curl = 0.0F;
};

/// How texels become bytes.
struct FloorFinish {
    int side = 0, margin = 0;  ///< texels; of the images, and of the canvas round them
    int radius = 0;            ///< of the square whose mean height decides on occlusion
    float per_slope = 1.0F;    ///< half of the texels per metre
    float bright = 1.0F, smoothness = 0.0F;
    float* sums = nullptr;             ///< space for a row
    std::uint8_t* channels = nullptr;  ///< 9 rows of side and channel_padding bytes, the last one 0
};
inline constexpr std::size_t channel_padding = 64;

}  // namespace sporeprint
