#include "core/world/maps.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <span>
#include <utility>

#include "core/math/elementary.h"
#include "core/world/drainage.h"
#include "core/world/horizon.h"
#include "core/world/mycelia.h"
#include "core/world/spread.h"
#include "core/world/wind.h"

namespace sporeprint {

namespace {

/// Rows that one task computes.
constexpr int stripe_rows = 32;

/// The top of the range of the map of crowns, metres.
constexpr double highest_crown = 64.0;

/// Calls use(index, x, y, east, north) for each place of a frame, by its coordinates on the grid and in metres; stripes
/// of rows by tasks.
template <class Use>
void each_place(const Grid& grid, const MapFrame& frame, const Parallel& parallel, const Use& use) {
    std::vector<Coordinate> columns;
    columns.reserve(static_cast<std::size_t>(frame.width));
    for (int column = 0; column < frame.width; ++column)
        columns.push_back(coordinate_at(grid, frame.x(column)));
    const auto stripe = [&](int first) {
        auto index = static_cast<std::size_t>(first) * columns.size();
        for (int row = first; row < std::min(first + stripe_rows, frame.height); ++row) {
            const double north = frame.y(row);
            const Coordinate y = coordinate_at(grid, north);
            for (int column = 0; column < frame.width; ++column)
                use(index++, columns[static_cast<std::size_t>(column)], y, frame.x(column), north);
        }
    };
    std::vector<std::function<void()>> tasks;
    for (int first = 0; first < frame.height; first += stripe_rows)
        tasks.emplace_back([&stripe, first] { stripe(first); });
    parallel(tasks);
}

double slope_at(const Ground& ground, const Coordinate& x, const Coordinate& y) {
    const Place place = place_at(ground, x, y);
    const double rise = std::sqrt(place.east * place.east + place.north * place.north);
    return arc_tangent(rise, 1.0) * (180.0 / pi);
}

/// Returns the direction downhill, degrees clockwise from north; 0 on level ground.
double aspect_at(const Ground& ground, const Coordinate& x, const Coordinate& y) {
    const Place place = place_at(ground, x, y);
    const double angle = arc_tangent(-place.east, -place.north) * (180.0 / pi);
    return angle < 0.0 ? angle + 360.0 : angle;
}

/// Returns the height of the crowns over a place, metres; 0 between them.
double canopy_at(std::span<const Crown> crowns, double x, double y, double ground) {
    double top = ground;
    for (const Crown& crown : crowns) {
        const double east = x - crown.x, north = y - crown.y;
        const double share = (east * east + north * north) / (crown.radius * crown.radius);
        if (share >= 1.0) continue;
        const double half = 0.5 * (crown.top - crown.base);
        top = std::max(top, crown.base + half * (1.0 + std::sqrt(1.0 - share)));
    }
    return top - ground;
}

/// The value of a map that shows no crowns, at a place and its coordinates on the ground.
double value_at(WorldMap map, const MapInputs& inputs, const Coordinate& x, const Coordinate& y,
                double east, double north) {
    const Ground& ground = inputs.ground;
    switch (map) {
        case WorldMap::height:
            return place_at(ground, x, y).height;
        case WorldMap::slope:
            return slope_at(ground, x, y);
        case WorldMap::aspect:
            return aspect_at(ground, x, y);
        case WorldMap::twi:
            return wetness_index_at(ground, x, y);
        case WorldMap::wetness:
            return wetness_on(ground, wetness_index_at(ground, x, y), inputs.soil_water);
        case WorldMap::streams:
            return stream_at(ground, x, y);
        case WorldMap::sky:
            return horizon_at(inputs.world->horizon, east, north).sky;
        case WorldMap::spores:
            return establishment_at(inputs.world->establishment[inputs.species], east, north,
                                    inputs.year);
        case WorldMap::wind:
        case WorldMap::light:
        case WorldMap::canopy:
        case WorldMap::litter:
        case WorldMap::moss:
        case WorldMap::grass:
        case WorldMap::probability:
        case WorldMap::species:
            break;  // by other functions
    }
    return 0.0;
}

/// Returns the mean speed of the wind at a place, m/s.
double wind_speed_at(const WindRelief& relief, const WindRose& rose, double x, double y) {
    double speed = 0.0;
    for (const WindSector& sector : rose)
        speed += sector.share * sector.speed * wind_at(relief, x, y, sector).factor;
    return speed;
}

/// Returns one more than the number of the species that is most likely at a place, of equal ones the first; 0 if none
/// is likely at all.
double likeliest_at(const World& world, WorldPoint place, double light, int year) {
    double most = 0.0;
    std::size_t number = 0;
    for (std::size_t i = 0; i < world.species.size(); ++i) {
        const double likely = probability_at(world, i, place, light, year);
        if (likely <= most) continue;
        most = likely;
        number = i + 1;
    }
    return static_cast<double>(number);
}

double share_of(WorldMap map, const Cover& cover) {
    if (map == WorldMap::moss) return cover.moss;
    return map == WorldMap::grass ? cover.grass : cover.all_leaves() + cover.needles;
}

/// The cover of the places of a block, row by row.
class BlockCover {
  public:
    BlockCover(const MapInputs& inputs, CellIndex block)
        : inputs_(inputs),
          sources_(inputs.litter(block)),
          wind_(sine_cosine(inputs.world->downwind())) {
        conditions_.acidity = inputs.world->params.soil.acidity;
        conditions_.day = inputs.day;
        conditions_.has_needles = inputs.has_needles;
    }
    void begin_row(double y) {
        near_.clear();
        for (const LitterSource& source : sources_)
            if (std::abs(source.y - y) <= most_litter_reach) near_.push_back(source);
    }
    /// light  share of the light of an open sky, below crowns
    [[nodiscard]] Cover at(double x, double y, double light) {
        conditions_.light = light;
        set_ground(conditions_, inputs_.ground, x, y, inputs_.world->autumn_water);
        conditions_.fall = litterfall(near_, x, y, wind_.cosine, wind_.sine);
        return cover_of(conditions_);
    }

  private:
    const MapInputs& inputs_;
    std::vector<LitterSource> sources_, near_;
    SineCosine wind_;
    CoverConditions conditions_;
};

/// The columns or rows of a frame that belong to a row or column of blocks, from `first` to before `last`.
struct Nodes {
    int first = 0, last = 0;
};

/// Computes the values of a map of crowns in one block.
///
/// use  called with the index of each place and its value
template <class Use>
void map_crowns(WorldMap map, const MapInputs& inputs, const MapFrame& frame, CellIndex block,
                const Nodes& columns, const Nodes& rows, const Use& use) {
    std::vector<Crown> crowns = inputs.crowns(block);
    // Crowns are at most a few metres wide.
    constexpr double reach = shade_reach;
    std::erase_if(crowns, [&](const Crown& crown) {
        return crown.x < frame.x(columns.first) - reach ||
               crown.x > frame.x(columns.last - 1) + reach ||
               crown.y < frame.y(rows.last - 1) - reach || crown.y > frame.y(rows.first) + reach;
    });
    const CanopyLight canopy(crowns);
    std::optional<BlockCover> cover;
    if (is_of_cover(map)) cover.emplace(inputs, block);
    const auto value_of = [&](double x, double y) {
        const Place place = place_at(inputs.ground, coordinate_at(inputs.ground.grid, x),
                                     coordinate_at(inputs.ground.grid, y));
        if (map == WorldMap::canopy) return canopy_at(crowns, x, y, place.height);
        const double light =
            light_at(horizon_at(inputs.world->horizon, x, y), place, inputs.world->sun) *
            canopy.at(x, y, place.height, 1.0);
        if (cover) return share_of(map, cover->at(x, y, light));
        if (map == WorldMap::probability)
            return probability_at(*inputs.world, inputs.species, point_at(x, y), light,
                                  inputs.year);
        if (map == WorldMap::species)
            return likeliest_at(*inputs.world, point_at(x, y), light, inputs.year);
        return light;
    };
    for (int row = rows.first; row < rows.last; ++row) {
        if (cover) cover->begin_row(frame.y(row));
        for (int column = columns.first; column < columns.last; ++column)
            use(static_cast<std::size_t>(row) * static_cast<std::size_t>(frame.width) +
                    static_cast<std::size_t>(column),
                value_of(frame.x(column), frame.y(row)));
    }
}

/// Returns the nodes of a frame along one axis by blocks, in ascending numbers of nodes.
template <class Coordinates>
std::vector<std::pair<int, Nodes>> by_blocks(int count, const Coordinates& at) {
    std::vector<std::pair<int, Nodes>> out;
    for (int i = 0; i < count; ++i) {
        const int block = static_cast<int>(std::floor(at(i) / block_side));
        if (out.empty() || out.back().first != block) out.push_back({block, {i, i}});
        out.back().second.last = i + 1;
    }
    return out;
}

/// Computes a map of crowns, one task for each block.
template <class Use>
void each_block(WorldMap map, const MapInputs& inputs, const MapFrame& frame,
                const Parallel& parallel, const Use& use) {
    const auto columns = by_blocks(frame.width, [&](int i) { return frame.x(i); }),
               rows = by_blocks(frame.height, [&](int i) { return frame.y(i); });
    std::vector<std::function<void()>> tasks;
    for (const auto& [y, of_row] : rows)
        for (const auto& [x, of_column] : columns)
            tasks.emplace_back([&, block = CellIndex{x, y}, across = of_column, down = of_row] {
                map_crowns(map, inputs, frame, block, across, down, use);
            });
    parallel(tasks);
}

}  // namespace

const char* doc_of(WorldMap map) {
    switch (map) {
        case WorldMap::height:
            return "Height of the ground above the mean of endless worlds of these parameters.";
        case WorldMap::slope:
            return "Angle of the ground from level.";
        case WorldMap::aspect:
            return "Direction downhill, clockwise from north.";
        case WorldMap::twi:
            return "Topographic wetness index: how much ground drains through a place, and how "
                   "slowly.";
        case WorldMap::wetness:
            return "How wet the ground is on a day: 1 where water stands at its surface.";
        case WorldMap::streams:
            return "1 where more than two hectares drain through a node of the ground, 0 "
                   "elsewhere; between "
                   "nodes it is linear, so a stream is where it is above 0.5.";
        case WorldMap::sky:
            return "Share of the sky that hills leave open.";
        case WorldMap::light:
            return "Light at the ground in summer, below crowns and between hills, as a share of "
                   "that of an open sky.";
        case WorldMap::canopy:
            return "Height of the crowns of trees above the ground; 0 between them.";
        case WorldMap::spores:
            return "How far a species (species=) has spread: 1 where it is as common as it can be.";
        case WorldMap::litter:
            return "Share of the ground that fallen leaves and needles cover on a day.";
        case WorldMap::moss:
            return "Share of the ground that moss covers on a day, where no litter lies on it.";
        case WorldMap::grass:
            return "Share of the ground that grass covers on a day.";
        case WorldMap::wind:
            return "Mean speed of the wind 10 m above the ground: more on ridges, less in hollows.";
        case WorldMap::probability:
            return "How well a place suits a species (species=) by its light, water and soil, "
                   "multiplied by how far the species has spread. What it lives on is not "
                   "considered.";
        case WorldMap::species:
            return "Which species is most probable at a place, of those of the world: numbers of "
                   "a palette, 0 where none is.";
    }
    return "";
}

double probability_at(const World& world, std::size_t species, WorldPoint place, double light,
                      int year) {
    const double established =
        establishment_at(world.establishment[species], metres(place.x), metres(place.y), year);
    if (!(established > 0.0)) return 0.0;
    Site site = world.dim_site_at(place);
    site.light = light;
    return established * world.share_at(species, place) *
           suitability(world.species[species].ecology, site);
}

MapRange range_of(WorldMap map, const Ground& ground) {
    switch (map) {
        case WorldMap::height:
            return {ground.lowest, ground.highest, "m"};
        case WorldMap::slope:
            return {0.0, 90.0, "deg"};
        case WorldMap::aspect:
            return {0.0, 360.0, "deg"};
        case WorldMap::twi:
            return {-wetness_offset, 65535.0 / wetness_units - wetness_offset, ""};
        case WorldMap::wetness:
        case WorldMap::streams:
        case WorldMap::sky:
        case WorldMap::light:
        case WorldMap::spores:
        case WorldMap::litter:
        case WorldMap::moss:
        case WorldMap::grass:
        case WorldMap::probability:
            return {0.0, 1.0, ""};
        case WorldMap::wind:
            return {0.0, 15.0, "m/s"};
        case WorldMap::species:
            return {0.0, 65535.0, ""};
        case WorldMap::canopy:
            return {0.0, highest_crown, "m"};
    }
    return {};
}

MapFrame frame_of(const WorldBox& box, int side) {
    const double width = box.east - box.west, height = box.north - box.south;
    const auto nodes = [&](double length) {
        const double share = length / std::max(width, height);
        return std::max(2, static_cast<int>(std::floor((side - 1) * share + 0.5)) + 1);
    };
    return {box, nodes(width), nodes(height)};
}

std::vector<std::uint16_t> map_of(WorldMap map, const MapInputs& inputs, const MapFrame& frame,
                                  const Parallel& parallel) {
    const MapRange range = range_of(map, inputs.ground);
    const double scale = 65535.0 / (range.to - range.from);
    std::vector<std::uint16_t> out(static_cast<std::size_t>(frame.width) *
                                   static_cast<std::size_t>(frame.height));
    const auto write = [&](std::size_t i, double value) {
        out[i] = static_cast<std::uint16_t>(
            std::clamp(std::floor((value - range.from) * scale + 0.5), 0.0, 65535.0));
    };
    if (has_crowns(map)) {
        each_block(map, inputs, frame, parallel, write);
        return out;
    }
    if (map == WorldMap::wind) {
        const WindRelief relief = wind_relief(inputs.ground.grid, inputs.ground.heights);
        const WindRose rose = wind_rose(inputs.climate);
        each_place(inputs.ground.grid, frame, parallel,
                   [&](std::size_t i, const Coordinate&, const Coordinate&, double east,
                       double north) { write(i, wind_speed_at(relief, rose, east, north)); });
        return out;
    }
    each_place(inputs.ground.grid, frame, parallel,
               [&](std::size_t i, const Coordinate& x, const Coordinate& y, double east,
                   double north) { write(i, value_at(map, inputs, x, y, east, north)); });
    return out;
}

std::vector<std::uint8_t> terrarium_of(const Ground& ground, const MapFrame& frame,
                                       const Parallel& parallel) {
    std::vector<std::uint8_t> out(3 * static_cast<std::size_t>(frame.width) *
                                  static_cast<std::size_t>(frame.height));
    each_place(ground.grid, frame, parallel,
               [&](std::size_t i, const Coordinate& x, const Coordinate& y, double, double) {
                   const double height = place_at(ground, x, y).height;
                   const auto units =
                       static_cast<std::uint32_t>(std::floor((height + 32768.0) * 256.0 + 0.5));
                   out[3 * i] = static_cast<std::uint8_t>(units >> 16U);
                   out[3 * i + 1] = static_cast<std::uint8_t>(units >> 8U & 255U);
                   out[3 * i + 2] = static_cast<std::uint8_t>(units & 255U);
               });
    return out;
}

}  // namespace sporeprint
