#include "core/world/terrain_map.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>

#include "core/params/messages.h"
#include "core/params/types.h"
#include "core/problems.h"
#include "core/world/height_field.h"

namespace sporeprint {

namespace {

constexpr std::string_view format = "sporeprint terrain 1\n";
constexpr std::size_t bytes_of_head = format.size() + 3 * sizeof(double) + sizeof(std::uint32_t);

/// Appends the bytes of an unsigned number, the low one first.
template <class T>
void append(Bytes& to, T number) {
    for (std::size_t i = 0; i < sizeof(T); ++i)
        to.push_back(static_cast<std::uint8_t>(number >> (8 * i)));
}

template <class T>
T number_at(std::span<const std::uint8_t> file, std::size_t at) {
    T number = 0;
    for (std::size_t i = 0; i < sizeof(T); ++i)
        number = static_cast<T>(number | static_cast<T>(T{file[at + i]} << (8 * i)));
    return number;
}

/// Returns the index of a sample of an endless row of mirror images.
int mirrored(int index, int side) {
    const int period = 2 * (side - 1);
    int at = index % period;
    if (at < 0) at += period;
    return std::min(at, period - at);
}

/// Returns the weight of a Catmull-Rom spline at a distance in samples.
double spline_weight(double distance) {
    const double t = std::abs(distance);
    if (t < 1.0) return 1.0 + t * t * (1.5 * t - 2.5);
    if (t < 2.0) return 2.0 + t * (-4.0 + t * (2.5 - 0.5 * t));
    return 0.0;
}

/// What one node has of the samples along an axis.
struct Taps {
    std::vector<int> samples;
    std::vector<double> weights;  ///< their sum is 1
};

/// Returns the taps of all nodes of a grid along one axis, as if the first sample were in the south or west.
std::vector<Taps> taps_of(const Grid& grid, const TerrainMap& map) {
    const double cell = map.scale.metres / (map.side - 1), width = std::max(1.0, grid.cell / cell);
    std::vector<Taps> all(static_cast<std::size_t>(grid.side));
    for (int node = 0; node < grid.side; ++node) {
        Taps& taps = all[static_cast<std::size_t>(node)];
        const double centre = grid.place(node) / cell + 0.5 * (map.side - 1);
        const int first = static_cast<int>(std::ceil(centre - 2.0 * width)),
                  last = static_cast<int>(std::floor(centre + 2.0 * width));
        double sum = 0.0;
        for (int i = first; i <= last; ++i) {
            const double weight = spline_weight((i - centre) / width);
            taps.samples.push_back(mirrored(i, map.side));
            taps.weights.push_back(weight);
            sum += weight;
        }
        for (double& weight : taps.weights) weight /= sum;
    }
    return all;
}

}  // namespace

void check(const TerrainMap& map) {
    if (map.scale.max <= map.scale.min)
        throw InvalidInput("max", number_text(map.scale.max) + " is not above min, which is " +
                                      number_text(map.scale.min));
    const double cell = map.scale.metres / (map.side - 1);
    const double step = (map.scale.max - map.scale.min) / 65535.0 / cell;
    constexpr double steep = 5.671281819617709;  // the tangent of 80 degrees
    const auto side = static_cast<std::size_t>(map.side);
    std::size_t too_steep = 0;
    for (std::size_t row = 0; row + 1 < side; ++row)
        for (std::size_t column = 0; column + 1 < side; ++column) {
            const std::uint16_t* const here = &map.samples[row * side + column];
            const double east = (here[1] - here[0]) * step, south = (here[side] - here[0]) * step;
            if (east * east + south * south > steep * steep) ++too_steep;
        }
    if (const std::size_t cells = (side - 1) * (side - 1); 20 * too_steep >= cells)
        throw InvalidInput(
            "metres",
            number_text(map.scale.metres) + " makes " +
                std::to_string((100 * too_steep + cells / 2) / cells) +
                " % of the ground steeper than 80 degrees; less than 5 % are allowed, so is "
                "it wider, or max - min less?");
}

Bytes file_of(const TerrainMap& map) {
    Bytes file(format.begin(), format.end());
    file.reserve(bytes_of_head + 2 * map.samples.size());
    for (const double number : {map.scale.metres, map.scale.min, map.scale.max})
        append(file, std::bit_cast<std::uint64_t>(number + 0.0));  // -0 is 0
    append(file, static_cast<std::uint32_t>(map.side));
    for (const std::uint16_t sample : map.samples) append(file, sample);
    return file;
}

std::optional<TerrainMap> terrain_in(std::span<const std::uint8_t> file) {
    if (file.size() < bytes_of_head || !std::equal(format.begin(), format.end(), file.begin()))
        return std::nullopt;
    TerrainMap map;
    std::size_t at = format.size();
    for (double* const number : {&map.scale.metres, &map.scale.min, &map.scale.max}) {
        *number = std::bit_cast<double>(number_at<std::uint64_t>(file, at));
        at += sizeof(double);
    }
    const auto side = number_at<std::uint32_t>(file, at);
    at += sizeof(side);
    if (side < least_terrain_side || side > most_terrain_side ||
        file.size() != at + std::size_t{2} * side * side)
        return std::nullopt;
    map.side = static_cast<int>(side);
    map.samples.reserve(std::size_t{side} * side);
    for (; at < file.size(); at += 2) map.samples.push_back(number_at<std::uint16_t>(file, at));
    return map;
}

std::string id_of(const TerrainMap& map) {
    const Bytes file = file_of(map);
    return "t-" + sha256_hex(file.data(), file.size()).substr(0, 32);
}

std::vector<std::int32_t> heights_of(const TerrainMap& map, int extent) {
    const Grid grid = world_grid(extent);
    const std::vector<Taps> taps = taps_of(grid, map);
    const auto side = static_cast<std::size_t>(map.side),
               nodes = static_cast<std::size_t>(grid.side);
    // Rows of samples first, then columns of what has come of them.
    std::vector<double> rows(side * nodes);
    for (std::size_t row = 0; row < side; ++row) {
        const std::uint16_t* const samples = &map.samples[row * side];
        for (std::size_t node = 0; node < nodes; ++node) {
            const Taps& along = taps[node];
            double sum = 0.0;
            for (std::size_t i = 0; i < along.samples.size(); ++i)
                sum += along.weights[i] * samples[along.samples[i]];
            rows[row * nodes + node] = sum;
        }
    }
    std::vector<std::int32_t> heights(grid.nodes());
    std::vector<double> sums(nodes);
    const double step = (map.scale.max - map.scale.min) / 65535.0;
    for (std::size_t node = 0; node < nodes; ++node) {
        const Taps& along = taps[node];
        std::fill(sums.begin(), sums.end(), 0.0);
        for (std::size_t i = 0; i < along.samples.size(); ++i) {
            const auto from_north = side - 1 - static_cast<std::size_t>(along.samples[i]);
            const double* const row = &rows[from_north * nodes];
            for (std::size_t column = 0; column < nodes; ++column)
                sums[column] += along.weights[i] * row[column];
        }
        for (std::size_t column = 0; column < nodes; ++column)
            heights[node * nodes + column] = quantised_height(map.scale.min + step * sums[column]);
    }
    return heights;
}

}  // namespace sporeprint
