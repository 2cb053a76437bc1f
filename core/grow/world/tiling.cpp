#include "core/grow/world/tiling.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstring>
#include <string>

#include "core/params/value.h"
#include "core/world/dead_wood.h"

namespace sporeprint {

namespace {

/// How far crowns reach beyond the square of the feet of their trees, and fruit bodies beyond theirs, metres.
constexpr double reach_of_crowns = 14.0, reach_of_bodies = 0.6;

/// Trees are scaled to at most so much more than the height of the tallest one.
constexpr double spare_height = 1.1;

/// How far below the ground content reaches: slabs of tiles, and roots of what stands on it, metres.
constexpr double depth_of_roots = 1.0;

struct Heights {
    double low = 0.0, high = 0.0;
};

/// Returns bounds of the heights of the ground in a rectangle. Splines between nodes exceed them by an eighth of the
/// differences of neighbours at most.
Heights heights_in(const TileReach& reach, const WorldBox& box) {
    const Grid& grid = reach.ground->grid;
    const auto nodes = [&](double from, double to) {
        constexpr int beside = 2;
        const auto number = [&](double metres) {
            return static_cast<int>((metres - grid.origin) / grid.cell);
        };
        return std::array{std::clamp(number(from) - beside, 0, grid.side - 1),
                          std::clamp(number(to) + beside + 1, 0, grid.side - 1)};
    };
    const auto [west, east] = nodes(box.west, box.east);
    const auto [south, north] = nodes(box.south, box.north);
    std::int32_t low = INT32_MAX, high = INT32_MIN;
    for (int row = south; row <= north; ++row)
        for (int column = west; column <= east; ++column) {
            const std::int32_t height = reach.ground->heights[grid.index(column, row)];
            low = std::min(low, height);
            high = std::max(high, height);
        }
    const double least = static_cast<double>(low) / height_units,
                 most = static_cast<double>(high) / height_units;
    // Waves of the floor and the ground that is raised round trunks.
    const double beyond = 0.25 * (most - least) + 4.0 * reach.micro + 0.3;
    return {least - beyond, most + beyond};
}

/// Returns the place of a tile among those of its level in the order of Morton.
std::size_t morton(int x, int y, int bits) {
    std::size_t code = 0;
    for (int bit = 0; bit < bits; ++bit)
        code |= static_cast<std::size_t>(x >> bit & 1) << (2 * bit) |
                static_cast<std::size_t>(y >> bit & 1) << (2 * bit + 1);
    return code;
}

/// Returns the number of tiles of all levels above one.
constexpr std::size_t tiles_above(int level) { return ((std::size_t{1} << (2 * level)) - 1) / 3; }

void put(std::vector<std::uint8_t>& to, const void* from, std::size_t size) {
    const std::size_t at = to.size();
    to.resize(at + size);
    std::memcpy(to.data() + at, from, size);
}

constexpr std::size_t padded_to_8(std::size_t size) { return (size + 7) & ~std::size_t{7}; }

}  // namespace

std::array<double, 12> TileBox::numbers() const {
    return {0.5 * (west + east),
            0.5 * (south + north),
            0.5 * (low + high),
            0.5 * (east - west),
            0.0,
            0.0,
            0.0,
            0.5 * (north - south),
            0.0,
            0.0,
            0.0,
            0.5 * (high - low)};
}

int Tiling::levels() const {
    int levels = 1;
    while (side(levels - 1) > finest_tile) ++levels;
    return levels;
}

bool Tiling::has(const TileIndex& tile) const {
    return tile.level >= 0 && tile.level < levels() && tile.x >= 0 && tile.y >= 0 &&
           tile.x < 1 << tile.level && tile.y < 1 << tile.level;
}

WorldBox Tiling::box(const TileIndex& tile) const {
    const double length = side(tile.level), rim = 0.5 * extent;
    return {tile.x * length - rim, tile.y * length - rim, (tile.x + 1) * length - rim,
            (tile.y + 1) * length - rim};
}

bool has_content(PlotLayer layer, double side) {
    switch (layer) {
        case PlotLayer::ground:
            return true;
        case PlotLayer::trees:
            return side <= coarsest_of_trees;
        case PlotLayer::floor:
        case PlotLayer::fungi:
            return side <= 4.0 * finest_tile;
    }
    return false;
}

TileReach reach_of(const Ground& ground, const WorldParams& params, const Stand& stand) {
    return {&ground, params.terrain.micro, greatest_height(stand), longest_trunk(stand)};
}

TileBox box_of(const Tiling& tiling, const TileIndex& tile, PlotLayer layer,
               const TileReach& reach) {
    const WorldBox square = tiling.box(tile);
    const double side = tiling.side(tile.level);
    double beside = 0.0, above = 0.0, below = depth_of_roots;
    switch (layer) {
        case PlotLayer::ground:
            // Slabs of large tiles are as deep as a sixteenth of their sides, and crowns are part of their relief.
            below = std::max(depth_of_roots, 0.125 * side);
            above = side > coarsest_of_trees ? spare_height * reach.tallest : 0.5;
            break;
        case PlotLayer::trees:
            beside = reach_of_crowns;
            above = spare_height * reach.tallest;
            break;
        case PlotLayer::floor:
            beside = 0.5 * reach.longest + 1.0;
            above = reach.longest + 1.0;
            break;
        case PlotLayer::fungi:
            beside = reach_of_bodies;
            above = reach.longest + 1.0;
            break;
    }
    const WorldBox wide = grown(square, beside);
    const Heights heights = heights_in(reach, wide);
    return {wide.west, wide.south, heights.low - below,
            wide.east, wide.north, heights.high + above};
}

std::vector<std::uint8_t> subtree_of(const Tiling& tiling, const TileIndex& root, PlotLayer layer,
                                     const TileReach& reach) {
    const int levels = tiling.levels_of_subtree();
    const std::size_t tiles = tiles_above(levels);
    std::vector<std::uint8_t> contents((tiles + 7) / 8, 0);
    std::vector<std::array<double, 12>> boxes(tiles);
    std::size_t with_content = 0;
    for (int level = 0; level < levels; ++level)
        for (int y = 0; y < 1 << level; ++y)
            for (int x = 0; x < 1 << level; ++x) {
                const TileIndex tile{root.level + level, (root.x << level) + x,
                                     (root.y << level) + y};
                const std::size_t i = tiles_above(level) + morton(x, y, level);
                boxes[i] = box_of(tiling, tile, layer, reach).numbers();
                if (!has_content(layer, tiling.side(tile.level))) continue;
                contents[i / 8] = static_cast<std::uint8_t>(contents[i / 8] | 1U << (i % 8));
                ++with_content;
            }
    std::vector<std::uint8_t> binary;
    put(binary, boxes.data(), boxes.size() * sizeof(boxes[0]));
    const std::size_t of_boxes = binary.size();
    Value views = Value::array();
    views.push(Value::object().set("buffer", 0).set("byteOffset", 0).set("byteLength", of_boxes));
    const auto constant = [](int value) { return Value::object().set("constant", value); };
    Value content = constant(with_content > 0 ? 1 : 0);
    if (with_content > 0 && with_content < tiles) {
        put(binary, contents.data(), contents.size());
        views.push(Value::object()
                       .set("buffer", 0)
                       .set("byteOffset", of_boxes)
                       .set("byteLength", contents.size()));
        content = Value::object().set("bitstream", 1).set("availableCount", with_content);
    }
    binary.resize(padded_to_8(binary.size()));
    const bool is_last = root.level + levels >= tiling.levels();
    const Value table =
        Value::object()
            .set("class", "tile")
            .set("count", tiles)
            .set("properties",
                 Value::object().set("boundingBox", Value::object().set("values", 0)));
    std::string json = dump(
        Value::object()
            .set("buffers", Value(Value::Array{Value::object().set("byteLength", binary.size())}))
            .set("bufferViews", std::move(views))
            .set("propertyTables", Value(Value::Array{table}))
            .set("tileMetadata", 0)
            .set("tileAvailability", constant(1))
            .set("contentAvailability", Value(Value::Array{std::move(content)}))
            .set("childSubtreeAvailability", constant(is_last ? 0 : 1)));
    json.append(padded_to_8(json.size()) - json.size(), ' ');
    std::vector<std::uint8_t> file;
    const std::uint32_t magic = 0x74627573, version = 1;  // "subt"
    const std::uint64_t of_json = json.size(), of_binary = binary.size();
    put(file, &magic, sizeof magic);
    put(file, &version, sizeof version);
    put(file, &of_json, sizeof of_json);
    put(file, &of_binary, sizeof of_binary);
    put(file, json.data(), json.size());
    put(file, binary.data(), binary.size());
    return file;
}

}  // namespace sporeprint
