#include "core/world/season.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <set>
#include <string>
#include <vector>

#include "core/math/elementary.h"
#include "core/problems.h"
#include "core/world/tree_growth.h"
#include "tests/support/forest.h"

namespace sporeprint::season_test {
namespace {

using namespace fungi;

const Forest& forest() {
    static const Forest one;
    return one;
}

/// Returns the bodies of a year, computed once.
const std::vector<FruitBody>& bodies_in(int year) {
    static std::map<int, std::vector<FruitBody>> years;
    const auto found = years.find(year);
    return found != years.end() ? found->second : years[year] = forest().bodies(year);
}

bool is_perennial(const FruitBody& body) {
    return forest().species[body.species].ecology.body.perennial;
}

/// The estimators of the pattern of points about a tree, without correction of edges.
struct Pattern {
    double clark_evans = 0, nearest = 0, within_10 = 0, within_20 = 0, from_tree = 0, sectors = 0;
};

constexpr double window = 1.45;

double median(std::vector<double> values) {
    std::ranges::sort(values);
    return values[values.size() / 2];
}

Pattern pattern_of(const std::vector<WorldPoint>& points, WorldPoint tree) {
    Pattern out;
    std::vector<double> nearest, from_tree;
    std::array<double, 12> sectors{};
    const auto number = static_cast<double>(points.size());
    for (std::size_t i = 0; i < points.size(); ++i) {
        double least = 2.0 * window;
        for (std::size_t j = 0; j < points.size(); ++j) {
            if (i == j) continue;
            const double away = distance(points[i], points[j]);
            least = std::min(least, away);
            out.within_10 += away <= 0.1 ? 1.0 / number : 0.0;
            out.within_20 += away <= 0.2 ? 1.0 / number : 0.0;
        }
        nearest.push_back(least);
        from_tree.push_back(distance(points[i], tree));
        const double angle =
            arc_tangent(metres(points[i].y - tree.y), metres(points[i].x - tree.x)) + pi;
        ++sectors[std::min<std::size_t>(static_cast<std::size_t>(angle / (2.0 * pi) * 12.0), 11)];
    }
    const double mean = std::accumulate(nearest.begin(), nearest.end(), 0.0) / number;
    out.clark_evans = mean / (0.5 / std::sqrt(number / (pi * window * window)));
    out.nearest = median(nearest);
    out.from_tree = median(from_tree);
    double variance = 0.0;
    for (const double count : sectors)
        variance += (count - number / 12.0) * (count - number / 12.0);
    out.sectors = variance / 11.0 / (number / 12.0);
    return out;
}

/// Returns the patterns of three pioneers about a birch of five years in 40 worlds: [species][world], without those
/// where there are fewer than five bodies.
std::array<std::vector<Pattern>, 3> patterns_about_a_birch() {
    const EvenHabitat habitat;
    const std::vector<FungusSpecies> species{laccaria(), hebeloma(), lactarius()};
    const std::vector<StandTree> trees{young_birch(time_of(0, 200))};
    constexpr ClimateParams wet{
        .latitude_deg = 54, .temperature = 8.5, .swing = 8, .rain = 1000, .rain_days = 0.5};
    std::array<std::vector<Pattern>, 3> out;
    for (std::uint32_t seed = 1; seed <= 40; ++seed) {
        const Fungi fungi{seed, species, habitat};
        const Surroundings around{trees, {}};
        const std::vector<Genet> genets = genets_of(fungi, {0, 0}, 0, around);
        const std::vector<FruitBody> bodies = season_of(fungi, {CellIndex{0, 0}, 5, genets, around},
                                                        conditions_in(species, wet, seed, 5), 1.0);
        std::array<std::vector<WorldPoint>, 3> points;
        for (const FruitBody& body : bodies)
            if (distance(body.at, trees[0].at) <= window) points[body.species].push_back(body.at);
        for (std::size_t i = 0; i < 3; ++i)
            if (points[i].size() >= 5) out[i].push_back(pattern_of(points[i], trees[0].at));
    }
    return out;
}

double mean(const std::vector<Pattern>& patterns, double Pattern::*member) {
    double sum = 0.0;
    for (const Pattern& pattern : patterns) sum += pattern.*member;
    return sum / static_cast<double>(patterns.size());
}

/// Returns whether the value of the real bodies is between the 5th and the 95th percentile.
bool is_inside(const std::vector<Pattern>& patterns, double Pattern::*member, double real) {
    std::vector<double> values;
    for (const Pattern& pattern : patterns) values.push_back(pattern.*member);
    std::ranges::sort(values);
    const std::size_t out = values.size() / 20;
    return values[out] <= real && real <= values[values.size() - 1 - out];
}

struct Band {
    const char* name;
    double Pattern::*member;
    double real, least, most;
};

void expect_bands(const std::vector<Pattern>& patterns, const std::vector<Band>& bands) {
    ASSERT_GE(patterns.size(), 36U);
    for (const Band& band : bands) {
        EXPECT_GE(mean(patterns, band.member), band.least) << band.name;
        EXPECT_LE(mean(patterns, band.member), band.most) << band.name;
        EXPECT_TRUE(is_inside(patterns, band.member, band.real)) << band.name;
    }
}

TEST(Season, HasThePatternOfRealBodiesAboutABirch) {
    // The 330 bodies of [Ford1980], window and estimators as in its data; bands as in the design of worlds.
    const auto patterns = patterns_about_a_birch();
    expect_bands(patterns[0], {{"Clark-Evans", &Pattern::clark_evans, 0.26, 0.25, 0.36},
                               {"nearest", &Pattern::nearest, 0.019, 0.016, 0.024},
                               {"within 10 cm", &Pattern::within_10, 7.6, 5.0, 9.5},
                               {"within 20 cm", &Pattern::within_20, 17.4, 12.0, 24.0},
                               {"from the tree", &Pattern::from_tree, 0.99, 0.87, 1.07},
                               {"sectors", &Pattern::sectors, 10.1, 7.0, 30.0}});
    expect_bands(patterns[1], {{"Clark-Evans", &Pattern::clark_evans, 0.47, 0.39, 0.51},
                               {"nearest", &Pattern::nearest, 0.038, 0.033, 0.050},
                               {"within 10 cm", &Pattern::within_10, 4.0, 3.0, 6.5},
                               {"within 20 cm", &Pattern::within_20, 12.5, 10.0, 23.0},
                               {"from the tree", &Pattern::from_tree, 0.67, 0.62, 0.73},
                               {"sectors", &Pattern::sectors, 6.6, 4.0, 20.0}});
    EXPECT_GE(mean(patterns[2], &Pattern::from_tree), 0.27);
    EXPECT_LE(mean(patterns[2], &Pattern::from_tree), 0.37);
}

TEST(Season, HasAsManyBodiesAsForestsHave) {
    double bodies = 0.0;
    for (int year = 80; year < 110; ++year) {
        const std::vector<FruitBody>& all = bodies_in(year);
        std::map<int, int> of_day;
        int annual = 0;
        for (const FruitBody& body : all) {
            // Turf is no part of a forest.
            const Guild guild = forest().species[body.species].ecology.guild;
            if (is_perennial(body) || guild == Guild::grass) continue;
            ++annual;
            ++of_day[(body.emerged - time_of(year)) / ticks_of_day];
        }
        bodies += annual;
        for (const auto& [day, number] : of_day) EXPECT_LE(number, 0.4 * annual) << day;
    }
    const double per_100_square_metres = bodies / 30.0 / 40.96;
    EXPECT_GE(per_100_square_metres, 28.0);
    EXPECT_LE(per_100_square_metres, 84.0);
}

/// Returns the ranks of values.
std::vector<double> ranks(const std::vector<double>& values) {
    std::vector<double> out;
    for (const double value : values)
        out.push_back(static_cast<double>(
            std::ranges::count_if(values, [&](double other) { return other < value; })));
    return out;
}

double correlation(const std::vector<double>& a, const std::vector<double>& b) {
    const auto number = static_cast<double>(a.size());
    const double mean_a = std::accumulate(a.begin(), a.end(), 0.0) / number,
                 mean_b = std::accumulate(b.begin(), b.end(), 0.0) / number;
    double ab = 0.0, aa = 0.0, bb = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        ab += (a[i] - mean_a) * (b[i] - mean_b);
        aa += (a[i] - mean_a) * (a[i] - mean_a);
        bb += (b[i] - mean_b) * (b[i] - mean_b);
    }
    return ab / std::sqrt(aa * bb);
}

TEST(Season, OfMycorrhizalSpeciesFollowsRainAndPeaksInLateSummer) {
    std::vector<double> counts, rains;
    std::array<double, days_of_year> emerged{};
    double all = 0.0, inside = 0.0;
    for (int year = 80; year < 110; ++year) {
        double rain = 0.0, count = 0.0;
        const WeatherYear weather = weather_of(beech, 7, year);
        for (std::size_t day = 151; day < 304; ++day) rain += weather[day].rain;
        for (const FruitBody& body : bodies_in(year)) {
            if (forest().species[body.species].ecology.guild != Guild::ectomycorrhizal) continue;
            const int day = (body.emerged - time_of(year)) / ticks_of_day;
            ++emerged[static_cast<std::size_t>(day)];
            ++count;
            // July to November and ten days more.
            if (day >= 181 - 10 && day < 334 + 10) ++inside;
        }
        counts.push_back(count);
        rains.push_back(rain);
        all += count;
    }
    EXPECT_GE(inside / all, 0.95);
    EXPECT_GE(correlation(ranks(counts), ranks(rains)), 0.5);
    std::vector<double> sorted = counts;
    std::ranges::sort(sorted);
    EXPECT_GE(sorted.back() / sorted[15], 2.0);
    EXPECT_LE(sorted.back() / sorted[15], 4.0);
    // The peak of four weeks.
    std::size_t peak = 0;
    double most = 0.0;
    for (std::size_t day = 0; day + 28 < emerged.size(); ++day) {
        const double sum =
            std::accumulate(emerged.begin() + static_cast<std::ptrdiff_t>(day),
                            emerged.begin() + static_cast<std::ptrdiff_t>(day) + 28, 0.0);
        if (sum > most) peak = day + 14;
        most = std::max(most, sum);
    }
    EXPECT_GE(peak, 195U);
    EXPECT_LE(peak, 288U);
}

TEST(Season, WithoutRainHasNoBodiesButPerennialBrackets) {
    ClimateParams desert = beech;
    desert.rain = 0.0;
    const std::vector<FruitBody> bodies = forest().bodies(100, 10.0, desert);
    EXPECT_GT(bodies.size(), 0U);
    EXPECT_TRUE(std::ranges::all_of(bodies, is_perennial));
}

TEST(Season, WithoutHostsHasNoneOfTheirBodies) {
    const Forest& all = forest();
    const std::vector<Genet> genets = genets_of(all.fungi(), {0, 0}, 2, {});
    const std::vector<FruitBody> bodies =
        season_of(all.fungi(), {CellIndex{0, 0}, 100, genets, {}},
                  conditions_in(all.species, beech, 7, 100), 10.0);
    for (const FruitBody& body : bodies)
        EXPECT_EQ(all.species[body.species].ecology.guild, Guild::grass);
}

TEST(Season, OfAHigherAbundanceHasAllBodiesOfALowerOne) {
    std::vector<FruitBody> fewer = forest().bodies(102, 0.0);
    EXPECT_TRUE(fewer.empty());
    for (const double abundance : {0.3, 1.0, 1.1, 4.0}) {
        const std::vector<FruitBody> more = forest().bodies(102, abundance);
        EXPECT_GT(more.size(), fewer.size());
        EXPECT_TRUE(std::ranges::includes(more, fewer, {}, &FruitBody::id, &FruitBody::id))
            << abundance;
        std::map<std::uint64_t, FruitBody> by_id;
        for (const FruitBody& body : more) by_id[body.id] = body;
        for (const FruitBody& body : fewer) EXPECT_EQ(by_id[body.id], body);
        fewer = more;
    }
}

TEST(Season, DependsOnNoOrderAndOnNothingBeyondNeighbours) {
    Forest only;
    const auto is_beyond = [](WorldPoint place) {
        const CellIndex block = block_at(place);
        return std::abs(block.x) > 1 || std::abs(block.y) > 1;
    };
    std::erase_if(only.stand.trees, [&](const StandTree& tree) { return is_beyond(tree.at); });
    std::erase_if(only.stand.wood, [&](const DeadWood& wood) { return is_beyond(wood.at); });
    std::ranges::reverse(only.stand.trees);
    std::ranges::reverse(only.stand.wood);
    std::ranges::reverse(only.genets);
    for (const int year : {80, 101, 119}) EXPECT_EQ(only.bodies(year), bodies_in(year));
}

TEST(Season, HasEachBodyInOneBlock) {
    const Forest& all = forest();
    const SeasonConditions conditions = conditions_in(all.species, beech, 7, 100);
    std::set<std::uint64_t> ids;
    std::size_t number = 0;
    for (const CellIndex block : {CellIndex{0, 0}, CellIndex{1, 0}, CellIndex{0, 1}})
        for (const FruitBody& body : season_of(all.fungi(), all.in(100, block), conditions, 2.0)) {
            EXPECT_EQ(block_at(body.at), block);
            ids.insert(body.id);
            ++number;
        }
    EXPECT_EQ(ids.size(), number);
}

TEST(Season, HasBodiesOnTheirMycelia) {
    const Forest& all = forest();
    std::map<std::uint64_t, Genet> genets;
    for (const Genet& genet : all.genets) genets[genet.id] = genet;
    std::array<int, 4> of_guild{};
    for (const FruitBody& body : bodies_in(102)) {
        ASSERT_TRUE(genets.contains(body.genet));
        const Genet& genet = genets[body.genet];
        const Ecology& ecology = all.species[body.species].ecology;
        ++of_guild[static_cast<std::size_t>(ecology.guild)];
        EXPECT_EQ(genet.species, body.species);
        EXPECT_LT(body.emerged, body.matured);
        EXPECT_LT(body.matured, body.gone);
        if (ecology.guild == Guild::wood) continue;
        EXPECT_EQ(body.trunk, 0U);
        EXPECT_EQ(body.height, 0.0);
        // In the band or on its host's ring, and as far from there as its cluster.
        const double scatter =
            1.5 * 3.0 * (ecology.fruit.cluster_spread + ecology.fruit.tuft_spread);
        const double radius = radius_at(genet, body.emerged);
        EXPECT_LE(distance(genet.centre, body.at), radius + scatter);
        if (ecology.guild != Guild::ectomycorrhizal) {
            EXPECT_GE(distance(genet.centre, body.at),
                      radius - 0.02 - ecology.ring.spread - scatter);
        }
        const Genet* owner = owner_of(all.genets, body.species, body.at, body.emerged);
        if (owner != nullptr && genet.lives_at(body.emerged)) {
            EXPECT_EQ(owner->id, genet.id);
        }
    }
    for (const int number : of_guild) EXPECT_GT(number, 20);
}

TEST(Season, HasBodiesOfWoodOnTheBark) {
    const Forest& all = forest();
    std::map<std::uint64_t, DeadWood> trunks;
    for (const DeadWood& wood : all.stand.wood) trunks[wood.id] = wood;
    int lying = 0, standing = 0;
    for (int year = 100; year < 106; ++year)
        for (const FruitBody& body : bodies_in(year)) {
            if (all.species[body.species].ecology.guild != Guild::wood) continue;
            ASSERT_TRUE(trunks.contains(body.trunk));
            const DeadWood& wood = trunks[body.trunk];
            const double east = metres(body.at.x - wood.at.x),
                         north = metres(body.at.y - wood.at.y);
            const double along = east * cosine(wood.direction) + north * sine(wood.direction),
                         left = north * cosine(wood.direction) - east * sine(wood.direction);
            // Bark is no farther out than when the tree died, and nearer to the axis towards the top.
            if (body.emerged >= wood.fell) {
                ++lying;
                EXPECT_GE(along, -0.01);
                EXPECT_LE(along, wood.length + 0.01);
                EXPECT_LE(body.gone, wood.gone);
                const double radius = body.height / (1.0 + sine(body.pitch));
                EXPECT_LE(radius, wood.radius * (1.0 - 0.8 * along / wood.length) + 1e-3);
                EXPECT_NEAR(std::abs(left), radius * std::abs(cosine(body.pitch)), 1e-3);
                const double across = cosine(body.facing - wood.direction - 0.5 * pi);
                EXPECT_NEAR(across, left < 0.0 ? -1.0 : 1.0, 1e-6);
                EXPECT_GT(body.height, 0.0);
            } else if (body.gone <= wood.fell) {
                ++standing;
                EXPECT_LE(body.height, wood.length);
                const double radius = std::sqrt(east * east + north * north);
                EXPECT_LE(radius, wood.radius * (1.0 - 0.8 * body.height / wood.length) + 1e-3);
                EXPECT_NEAR(east, radius * cosine(body.facing), 1e-3);
                EXPECT_NEAR(north, radius * sine(body.facing), 1e-3);
                EXPECT_EQ(body.pitch, 0.0);
            }
        }
    EXPECT_GT(lying, 500);
    EXPECT_GT(standing, 20);
}

TEST(Season, OfPerennialBracketsIsTheSameInAllYearsInWhichTheyStand) {
    std::map<std::uint64_t, FruitBody> earlier;
    int both = 0;
    for (int year = 84; year < 116; ++year) {
        std::map<std::uint64_t, FruitBody> now;
        for (const FruitBody& body : bodies_in(year))
            if (is_perennial(body)) now[body.id] = body;
        for (const auto& [id, body] : earlier)
            if (body.gone > time_of(year)) {
                EXPECT_EQ(now[id], body) << "year " << year;
                ++both;
            }
        earlier = now;
    }
    EXPECT_GT(both, 50);
}

TEST(Season, HasNoTwoBodiesInOnePlaceAtOneTime) {
    // Also not on both sides of the border of two blocks.
    const Forest& all = forest();
    const SeasonConditions conditions = conditions_in(all.species, beech, 7, 102);
    std::vector<FruitBody> bodies = season_of(all.fungi(), all.in(102, {0, 0}), conditions, 6.0);
    const std::vector<FruitBody> east =
        season_of(all.fungi(), all.in(102, {1, 0}), conditions, 6.0);
    bodies.insert(bodies.end(), east.begin(), east.end());
    std::erase_if(bodies, is_perennial);
    std::ranges::sort(bodies, {}, [](const FruitBody& body) { return body.at.x; });
    double least = 1.0;
    for (std::size_t i = 0; i < bodies.size(); ++i)
        for (std::size_t j = i + 1;
             j < bodies.size() && metres(bodies[j].at.x - bodies[i].at.x) < 0.1; ++j) {
            const FruitBody &a = bodies[i], &b = bodies[j];
            if (a.emerged >= b.gone || b.emerged >= a.gone) continue;
            const double away = distance(a.at, b.at), height = a.height - b.height;
            least = std::min(least, std::sqrt(away * away + height * height));
        }
    // Caps of 2 cm radius in tufts come as near as 0.2 of two radii.
    EXPECT_GE(least, 0.0079);
}

TEST(Season, HasAsManyBodiesAtBordersAsInside) {
    // The strip of 4 m along the border is 1 - (56 / 64)^2 of a block.
    double border = 0.0, all = 0.0;
    for (int year = 80; year < 120; ++year)
        for (const FruitBody& body : bodies_in(year)) {
            const double x = metres(body.at.x), y = metres(body.at.y);
            ++all;
            if (std::min({x, y, 64.0 - x, 64.0 - y}) < 4.0) ++border;
        }
    EXPECT_NEAR(border / all, 1.0 - 56.0 * 56.0 / (64.0 * 64.0), 0.05);
}

/// Returns the bodies in a year of rings in turf.
std::vector<FruitBody> bodies_of_rings(const std::vector<Genet>& genets, int year) {
    static const EvenHabitat habitat;
    FungusSpecies species = marasmius();
    species.ecology.fruit.cluster_spread = 0.0;
    species.ecology.fruit.tuft_spread = 0.0;
    species.ecology.fruit.clusters = 1.0;
    const std::vector<FungusSpecies> all{species};
    return season_of({3, all, habitat}, {CellIndex{0, 0}, year, genets, {}},
                     conditions_in(all, beech, 3, year), 3.0);
}

Genet ring_at(double x, double y, int born, std::uint64_t id) {
    Genet genet;
    genet.id = id;
    genet.centre = point(x, y);
    genet.born = time_of(born);
    genet.died = time_of(born + 80);
    genet.speed = 0.2;
    genet.reach = 20.0;
    return genet;
}

TEST(Rings, AdvanceAtTheirSpeed) {
    const std::vector<Genet> genets{ring_at(32.0, 32.0, 0, 1)};
    std::vector<double> years, radii;
    for (int year = 10; year < 80; ++year) {
        double farthest = 0.0, when = 0.0;
        for (const FruitBody& body : bodies_of_rings(genets, year)) {
            const double away = distance(genets[0].centre, body.at);
            const double radius = radius_at(genets[0], body.emerged);
            EXPECT_LE(away, radius + 1e-3);
            EXPECT_GE(away, radius - 0.3 - 0.02);
            if (away > farthest) when = years_between(0, body.emerged);
            farthest = std::max(farthest, away);
        }
        if (farthest == 0.0) continue;
        years.push_back(when);
        radii.push_back(farthest);
    }
    ASSERT_GT(years.size(), 40U);
    const auto number = static_cast<double>(years.size());
    const double mean_year = std::accumulate(years.begin(), years.end(), 0.0) / number,
                 mean_radius = std::accumulate(radii.begin(), radii.end(), 0.0) / number;
    double product = 0.0, square = 0.0;
    for (std::size_t i = 0; i < years.size(); ++i) {
        product += (years[i] - mean_year) * (radii[i] - mean_radius);
        square += (years[i] - mean_year) * (years[i] - mean_year);
    }
    EXPECT_NEAR(product / square, 0.2, 0.02 * 0.2);
    EXPECT_GT(correlation(years, radii), 0.999);
}

TEST(Rings, StopWhereTheyMeet) {
    // 10 m apart and of equal age, they meet at x = 32 when they are 25 years old.
    const std::vector<Genet> genets{ring_at(27.0, 32.0, 0, 1), ring_at(37.0, 32.0, 0, 2)};
    int beside = 0;
    for (int year = 30; year < 60; ++year)
        for (const FruitBody& body : bodies_of_rings(genets, year)) {
            EXPECT_EQ(body.genet, metres(body.at.x) < 32.0 ? 1U : 2U);
            if (std::abs(metres(body.at.x) - 32.0) < 1.0) ++beside;
        }
    EXPECT_GT(beside, 0);
}

TEST(Age, GrowsFromNothingToOne) {
    FruitBody body;
    body.emerged = 1000;
    body.matured = 1000 + 8 * ticks_of_day;
    body.gone = body.matured + 12 * ticks_of_day;
    double before = 0.0;
    for (WorldTime time = 990; time <= body.gone + 10; ++time) {
        const double age = age_at(body, time);
        EXPECT_GE(age, before);
        EXPECT_LE(age, 1.0);
        before = age;
    }
    EXPECT_EQ(age_at(body, 999), 0.0);
    EXPECT_DOUBLE_EQ(age_at(body, body.matured), 0.6);
    EXPECT_NEAR(age_at(body, body.matured - 1), 0.6, 0.01);
    EXPECT_DOUBLE_EQ(age_at(body, body.matured + 6 * ticks_of_day), 0.8);
    EXPECT_EQ(age_at(body, body.gone), 1.0);
    // The middle of its growth is the middle of the logistic curve.
    EXPECT_NEAR(age_at(body, 1000 + 4 * ticks_of_day), 0.3 * (1.0 + exponential(-2.945)), 1e-12);
}

TEST(Age, OfBodiesThatStandIsNotLessOnTheNextDay) {
    for (const FruitBody& body : bodies_in(102))
        for (int day = 180; day < 300; ++day) {
            const WorldTime today = time_of(102, day);
            if (!body.stands_at(today) || !body.stands_at(today + ticks_of_day)) continue;
            EXPECT_LE(age_at(body, today), age_at(body, today + ticks_of_day));
        }
}

TEST(Counts, AreThoseOfTheBodiesThatStandAtNoon) {
    const std::vector<FruitBody> bodies = bodies_in(102);
    const auto counts = daily_counts(bodies, forest().species.size(), 102);
    ASSERT_EQ(counts.size(), forest().species.size());
    for (const int day : {1, 180, 250, 290, 365})
        for (std::size_t i = 0; i < counts.size(); ++i) {
            const WorldTime noon = time_of(102, day) + 8;
            const auto number = std::ranges::count_if(bodies, [&](const FruitBody& body) {
                return body.species == i && body.stands_at(noon);
            });
            EXPECT_EQ(counts[i][static_cast<std::size_t>(day - 1)], number) << day;
        }
}

/// A habitat in which a place may have less of each species, the farther west the less.
class SharedHabitat : public EvenHabitat {
  public:
    [[nodiscard]] double share(std::size_t, WorldPoint place) const override {
        return std::clamp(metres(place.x) / 64.0 - 0.25, 0.0, 0.5);
    }
};

TEST(Season, HasTheShareOfBodiesThatPlacesMayHave) {
    SharedHabitat habitat;
    habitat.site = forest().habitat.site;
    const Fungi fungi{7, forest().species, habitat};
    const std::vector<FruitBody> some =
        season_of(fungi, forest().in(95), conditions_in(forest().species, beech, 7, 95), 1.0);
    const std::vector<FruitBody>& all = bodies_in(95);
    double expected = 0.0;
    for (const FruitBody& body : all) expected += habitat.share(body.species, body.at);
    for (const FruitBody& body : some) {
        EXPECT_GT(habitat.share(body.species, body.at), 0.0);
        EXPECT_TRUE(std::ranges::binary_search(all, body.id, {}, &FruitBody::id));
    }
    // Whether a body is among them is a draw of its own.
    EXPECT_NEAR(static_cast<double>(some.size()), expected, 4.0 * std::sqrt(expected));
}

TEST(Season, OfTooManyBodiesIsImpossible) {
    std::vector<FungusSpecies> species{marasmius()};
    species[0].ecology.fruit.density = 200.0;
    species[0].ecology.fruit.clusters = species[0].ecology.fruit.tufts = 10.0;
    const EvenHabitat habitat;
    const Fungi fungi{7, species, habitat};
    const std::vector<Genet> genets = genets_of(fungi, {0, 0}, 2, {});
    const SeasonConditions conditions = conditions_in(species, beech, 7, 95);
    EXPECT_THROW(
        static_cast<void>(season_of(fungi, {CellIndex{0, 0}, 95, genets, {}}, conditions, 1000.0)),
        Impossible);
}

}  // namespace
}  // namespace sporeprint::season_test
