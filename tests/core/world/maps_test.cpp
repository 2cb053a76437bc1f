#include "core/world/maps.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <thread>
#include <vector>

#include "core/grow/world/plot_of_world.h"
#include "core/world/drainage.h"
#include "core/world/tree_growth.h"
#include "core/world/world_habitat.h"
#include "tests/support/worlds.h"

namespace sporeprint::world_maps_test {
namespace {

Place place_at(const Ground& ground, double x, double y) {
    return sporeprint::place_at(ground, coordinate_at(ground.grid, x),
                                coordinate_at(ground.grid, y));
}

const WorldParams& params() {
    static const WorldParams made = [] {
        WorldParams p;
        p.seed = 3;
        p.extent.value = 256;
        return p;
    }();
    return made;
}

const Ground& ground() {
    static const Ground made = ground_of(params());
    return made;
}

constexpr WorldMap ground_maps[] = {WorldMap::height, WorldMap::slope,   WorldMap::aspect,
                                    WorldMap::twi,    WorldMap::wetness, WorldMap::streams};

TEST(MapFrame, HasItsOutermostNodesOnTheEdges) {
    const MapFrame frame = frame_of({-100.0, -30.0, 60.0, 10.0}, 161);
    EXPECT_EQ(frame.width, 161);
    EXPECT_EQ(frame.height, 41);
    EXPECT_EQ(frame.x(0), -100.0);
    EXPECT_EQ(frame.x(160), 60.0);
    EXPECT_EQ(frame.y(0), 10.0) << "rows begin in the north";
    EXPECT_EQ(frame.y(40), -30.0);
    EXPECT_DOUBLE_EQ(frame.x(1) - frame.x(0), 1.0);
    EXPECT_DOUBLE_EQ(frame.y(0) - frame.y(1), 1.0);
    const MapFrame strip = frame_of({0.0, 0.0, 1.0, 200.0}, 64);
    EXPECT_EQ(strip.width, 2);
    EXPECT_EQ(strip.height, 64);
}

TEST(WorldMap, OfHeightsIsThatOfThePlaces) {
    const MapFrame frame = frame_of(extent_of(params()), 65);
    const auto map = map_of(WorldMap::height, {.ground = ground(), .soil_water = 0.0}, frame);
    const auto [from, to, unit] = range_of(WorldMap::height, ground());
    EXPECT_STREQ(unit, "m");
    for (int row = 0; row < frame.height; row += 7)
        for (int column = 0; column < frame.width; column += 5) {
            const double stored =
                from +
                (to - from) / 65535.0 * map[static_cast<std::size_t>(row * frame.width + column)];
            EXPECT_NEAR(stored, place_at(ground(), frame.x(column), frame.y(row)).height,
                        (to - from) / 131000.0);
        }
}

TEST(WorldMap, SideBySideSharesItsEdge) {
    for (const WorldMap map : ground_maps) {
        const auto west = map_of(map, {.ground = ground(), .soil_water = 70.0},
                                 frame_of({-64.0, -32.0, 0.0, 32.0}, 65));
        const auto east = map_of(map, {.ground = ground(), .soil_water = 70.0},
                                 frame_of({0.0, -32.0, 64.0, 32.0}, 65));
        const auto finer = map_of(map, {.ground = ground(), .soil_water = 70.0},
                                  frame_of({0.0, -32.0, 64.0, 32.0}, 129));
        for (std::size_t row = 0; row < 65; ++row) {
            EXPECT_EQ(west[row * 65 + 64], east[row * 65]) << name(map);
            for (std::size_t column = 0; column < 65; ++column)
                ASSERT_EQ(east[row * 65 + column], finer[2 * row * 129 + 2 * column])
                    << name(map) << ": a place has one value at every resolution";
        }
    }
}

TEST(WorldMap, IsTheSameOnSeveralThreads) {
    const Parallel threads = [](std::span<const std::function<void()>> tasks) {
        std::vector<std::jthread> running;
        running.reserve(tasks.size());
        for (const auto& task : tasks) running.emplace_back(task);
    };
    const MapFrame frame = frame_of(extent_of(params()), 200);
    for (const WorldMap map : ground_maps)
        EXPECT_EQ(map_of(map, {.ground = ground(), .soil_water = 50.0}, frame),
                  map_of(map, {.ground = ground(), .soil_water = 50.0}, frame, threads));
    EXPECT_EQ(terrarium_of(ground(), frame), terrarium_of(ground(), frame, threads));
}

TEST(WorldMap, OfAspectsPointsDownhill) {
    const MapFrame frame = frame_of({-100.0, -100.0, 100.0, 100.0}, 101);
    const auto map = map_of(WorldMap::aspect, {.ground = ground(), .soil_water = 0.0}, frame);
    int downhill = 0, places = 0;
    for (int row = 1; row < frame.height - 1; ++row)
        for (int column = 1; column < frame.width - 1; ++column) {
            const double angle = map[static_cast<std::size_t>(row * frame.width + column)] /
                                 65535.0 * 6.283185307179586;
            const double x = frame.x(column), y = frame.y(row);
            const double here = place_at(ground(), x, y).height;
            const double there =
                place_at(ground(), x + 0.05 * std::sin(angle), y + 0.05 * std::cos(angle)).height;
            downhill += there < here ? 1 : 0;
            ++places;
        }
    EXPECT_GT(downhill, places * 99 / 100);
}

TEST(WorldMap, OfWetnessGrowsWithTheWaterInTheSoil) {
    const MapFrame frame = frame_of(extent_of(params()), 100);
    const auto dry = map_of(WorldMap::wetness, {.ground = ground(), .soil_water = 20.0}, frame),
               wet = map_of(WorldMap::wetness, {.ground = ground(), .soil_water = 90.0}, frame),
               index = map_of(WorldMap::twi, {.ground = ground(), .soil_water = 0.0}, frame);
    std::size_t wetter = 0;
    for (std::size_t i = 0; i < dry.size(); ++i) {
        ASSERT_LE(dry[i], wet[i]);
        wetter += dry[i] < wet[i] ? 1 : 0;
        if (i > 0 && index[i] > index[i - 1]) {
            ASSERT_GE(wet[i], wet[i - 1]) << "no place is drier for a higher index";
        }
    }
    EXPECT_GT(wetter, dry.size() / 2);
}

/// A beech wood, and the crowns of its trees in year 80.
const World& wood() {
    static const World made = world_over_its_ground(small_world("beech"));
    return made;
}

constexpr WorldTime summer = time_of(80, 180);

const CachedParts& parts() {
    static const CachedParts cached;
    return cached;
}

Block trees_round(CellIndex block) {
    const double west = block.x * block_side, south = block.y * block_side;
    return blocks_round(wood(), {west, south, west + block_side, south + block_side},
                        parts().services);
}

std::vector<Crown> crowns_round(CellIndex block) {
    std::vector<Crown> crowns;
    for (const StandTree& tree : trees_round(block).trees)
        if (tree.lives_at(summer)) crowns.push_back(crown_of(wood(), tree, summer));
    return crowns;
}

std::vector<double> values_of(WorldMap map, const MapFrame& frame, std::size_t species = 0) {
    const MapInputs inputs{
        .ground = *wood().ground,
        .world = &wood(),
        .year = 80,
        .day = day_of_year(summer),
        .species = species,
        .climate = wood().params.climate,
        .has_needles = needles_of(wood(), atlas()),
        .crowns = crowns_round,
        .litter = [](CellIndex block) {
            return litter_in(trees_round(block).trees, {-1000.0, -1000.0, 1000.0, 1000.0}, summer);
        }};
    const MapRange range = range_of(map, *wood().ground);
    std::vector<double> values;
    for (const std::uint16_t number : map_of(map, inputs, frame))
        values.push_back(range.from + (range.to - range.from) * number / 65535.0);
    return values;
}

TEST(WorldMap, OfTheCanopyHasTheHeightsOfTrees) {
    const MapFrame frame = frame_of({-20.0, -20.0, 20.0, 20.0}, 41);
    const std::vector<double> canopy = values_of(WorldMap::canopy, frame);
    double highest = 0.0;
    for (const StandTree& tree : trees_round({0, 0}).trees) {
        const double x = metres(tree.at.x), y = metres(tree.at.y);
        if (!tree.lives_at(summer) || x < 0.0 || x > 20.0 || y < 0.0 || y > 20.0) continue;
        const double height = height_at(tree, summer);
        highest = std::max(highest, height);
        if (height < 5.0) continue;
        const auto column = static_cast<std::size_t>(std::lround(x) + 20),
                   row = static_cast<std::size_t>(20 - std::lround(y));
        EXPECT_GT(canopy[row * 41 + column], 0.4 * height) << "the crown of the tree is over it";
    }
    EXPECT_GT(highest, 10.0);
    EXPECT_LT(*std::ranges::max_element(canopy), 1.2 * 28.0 + 3.0);
}

TEST(WorldMap, OfLightIsDarkestBelowCrowns) {
    const MapFrame frame = frame_of({-32.0, -32.0, 32.0, 32.0}, 65);
    const std::vector<double> light = values_of(WorldMap::light, frame),
                              canopy = values_of(WorldMap::canopy, frame),
                              sky = values_of(WorldMap::sky, frame);
    double below = 0.0, beside = 0.0;
    int crowns = 0, gaps = 0;
    for (std::size_t i = 0; i < light.size(); ++i) {
        EXPECT_GT(sky[i], 0.5);
        (canopy[i] > 10.0 ? below : beside) += light[i];
        ++(canopy[i] > 10.0 ? crowns : gaps);
    }
    ASSERT_GT(crowns, 100);
    ASSERT_GT(gaps, 100);
    EXPECT_LT(below / crowns, 0.85 * beside / gaps);
}

TEST(WorldMap, OfCrownsIsTheSameInEveryRectangle) {
    for (const WorldMap map :
         {WorldMap::light, WorldMap::canopy, WorldMap::litter, WorldMap::moss, WorldMap::grass,
          WorldMap::wind, WorldMap::probability, WorldMap::species}) {
        const std::vector<double> west = values_of(map, frame_of({-16.0, -8.0, 0.0, 8.0}, 17)),
                                  east = values_of(map, frame_of({0.0, -8.0, 16.0, 8.0}, 17)),
                                  both = values_of(map, frame_of({-16.0, -16.0, 16.0, 16.0}, 33));
        for (std::size_t row = 0; row < 17; ++row) {
            EXPECT_EQ(west[row * 17 + 16], east[row * 17]) << name(map);
            for (std::size_t column = 0; column < 17; ++column) {
                ASSERT_EQ(west[row * 17 + column], both[(row + 8) * 33 + column]) << name(map);
                ASSERT_EQ(east[row * 17 + column], both[(row + 8) * 33 + column + 16]) << name(map);
            }
        }
    }
}

TEST(WorldMap, OfSporesIsTheEstablishmentOfASpecies) {
    const MapFrame frame = frame_of({-100.0, -100.0, 100.0, 100.0}, 21);
    for (const std::size_t species : {std::size_t{0}, std::size_t{5}}) {
        const std::vector<double> spores = values_of(WorldMap::spores, frame, species);
        for (int row = 0; row < 21; row += 4)
            for (int column = 0; column < 21; column += 4)
                EXPECT_NEAR(spores[static_cast<std::size_t>(row * 21 + column)],
                            establishment_at(wood().establishment[species], frame.x(column),
                                             frame.y(row), 80),
                            1e-5);
    }
}

TEST(WorldMap, OfTheCoverHasWhatPlotsHave) {
    const MapFrame frame = frame_of({-8.0, -8.0, 8.0, 8.0}, 17);
    const std::vector<double> litter = values_of(WorldMap::litter, frame),
                              moss = values_of(WorldMap::moss, frame),
                              grass = values_of(WorldMap::grass, frame);
    const auto world = std::shared_ptr<const World>(std::shared_ptr<void>(), &wood());
    const auto plot = plot_of_world(world, {0.0, 0.0, 16.0}, summer, parts().services);
    const CoverField field = cover_of(plot->content, atlas());
    double sum = 0.0;
    for (int row = 0; row < 17; ++row)
        for (int column = 0; column < 17; ++column) {
            const Cover cover = field.at(frame.x(column), frame.y(row));
            const auto i = static_cast<std::size_t>(row * 17 + column);
            ASSERT_NEAR(litter[i], cover.all_leaves() + cover.needles, 1e-4);
            ASSERT_NEAR(moss[i], cover.moss, 1e-4);
            ASSERT_NEAR(grass[i], cover.grass, 1e-4);
            ASSERT_LE(litter[i] + moss[i] + grass[i], 1.0 + 1e-4);
            sum += litter[i];
        }
    EXPECT_GT(sum / (17 * 17), 0.3) << "leaves lie in a beech wood";
}

TEST(WorldMap, OfTheWindIsFasterOnRidges) {
    const MapFrame frame = frame_of({-120.0, -120.0, 120.0, 120.0}, 61);
    const std::vector<double> wind = values_of(WorldMap::wind, frame);
    const double speed = wood().params.climate.wind_speed;
    double sum = 0.0, highest = 0.0, lowest = 100.0;
    const auto height = [&](std::size_t i) {
        return place_at(*wood().ground, frame.x(static_cast<int>(i % 61)),
                        frame.y(static_cast<int>(i / 61)))
            .height;
    };
    std::size_t top = 0, bottom = 0;
    for (std::size_t i = 0; i < wind.size(); ++i) {
        sum += wind[i];
        highest = std::max(highest, wind[i]);
        lowest = std::min(lowest, wind[i]);
        if (height(i) > height(top)) top = i;
        if (height(i) < height(bottom)) bottom = i;
    }
    EXPECT_NEAR(sum / static_cast<double>(wind.size()), speed, 0.1 * speed);
    EXPECT_GE(lowest, 0.5 * speed);
    EXPECT_LE(highest, 1.5 * speed);
    EXPECT_GT(wind[top], wind[bottom]);
}

TEST(WorldMap, OfProbabilityIsEstablishmentWhereAllSuits) {
    const MapFrame frame = frame_of({-64.0, -64.0, 64.0, 64.0}, 33);
    const std::vector<double> light = values_of(WorldMap::light, frame),
                              likeliest = values_of(WorldMap::species, frame);
    std::vector<double> best(light.size(), 0.0), number(light.size(), 0.0);
    std::size_t suited = 0;
    for (std::size_t species = 0; species < wood().species.size(); ++species) {
        const std::vector<double> likely = values_of(WorldMap::probability, frame, species),
                                  spores = values_of(WorldMap::spores, frame, species);
        const Ecology& ecology = wood().species[species].ecology;
        for (std::size_t i = 0; i < likely.size(); ++i) {
            ASSERT_LE(likely[i], spores[i] + 1e-4);
            const WorldPoint at{
                static_cast<std::int32_t>(frame.x(static_cast<int>(i % 33)) * units_of_metre),
                static_cast<std::int32_t>(frame.y(static_cast<int>(i / 33)) * units_of_metre)};
            Site site = wood().site_at(at);
            site.light = light[i];
            const double suits = suitability(ecology, site);
            ASSERT_NEAR(likely[i], spores[i] * suits, 1e-3);
            suited += suits == 1.0 && spores[i] > 0.5 ? 1 : 0;
            if (likely[i] > best[i]) {
                best[i] = likely[i];
                number[i] = static_cast<double>(species + 1);
            }
        }
    }
    EXPECT_GT(suited, 0U);
    std::size_t same = 0;
    for (std::size_t i = 0; i < best.size(); ++i) same += likeliest[i] == number[i] ? 1 : 0;
    // Two that differ by less than a number of 16 bits may be either.
    EXPECT_GT(same, best.size() * 98 / 100);
}

TEST(Terrarium, HasHeightsToAQuarterOfACentimetre) {
    const MapFrame frame = frame_of(extent_of(params()), 64);
    const auto rgb = terrarium_of(ground(), frame);
    for (int row = 0; row < frame.height; ++row)
        for (int column = 0; column < frame.width; ++column) {
            const std::uint8_t* const colour =
                &rgb[3 * static_cast<std::size_t>(row * frame.width + column)];
            const double height = 256.0 * colour[0] + colour[1] + colour[2] / 256.0 - 32768.0;
            ASSERT_NEAR(height, place_at(ground(), frame.x(column), frame.y(row)).height,
                        0.5 / 256.0 + 1e-9);
        }
}

TEST(WorldMap, HasADescriptionAndARangeForEachName) {
    int count = 0;
    for (int i = 0; name(static_cast<WorldMap>(i)) != nullptr; ++i, ++count) {
        const auto map = static_cast<WorldMap>(i);
        EXPECT_GT(std::string_view(doc_of(map)).size(), 20U);
        const MapRange range = range_of(map, ground());
        EXPECT_LT(range.from, range.to);
    }
    EXPECT_EQ(count, 16);
}

}  // namespace
}  // namespace sporeprint::world_maps_test
