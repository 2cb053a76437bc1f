#include "core/world/world.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <span>
#include <utility>

#include "core/math/elementary.h"
#include "core/params/canonical.h"
#include "core/params/messages.h"
#include "core/problems.h"
#include "core/world/tree_growth.h"
#include "core/world/world_species.h"

namespace sporeprint {

namespace {

/// Years whose autumns are looked at, and their days: September and October.
constexpr int years_of_mean = 4, first_day = 244, last_day = 304;

/// The longest day of the north; in the south it is half a year later.
constexpr int midsummer = 172, half_a_year = 182;

bool is_southern(const WorldParams& params) { return params.climate.latitude_deg < 0.0; }

double autumn_water_of(const WorldParams& params) {
    const int later = is_southern(params) ? half_a_year : 0;
    double sum = 0.0;
    for (int year = 0; year < years_of_mean; ++year) {
        const WeatherYear weather = weather_of(params.climate, params.seed, year);
        for (int day = first_day; day <= last_day; ++day)
            sum += weather[static_cast<std::size_t>((day - 1 + later) % days_of_year)].soil_water;
    }
    return sum / (years_of_mean * (last_day - first_day + 1));
}

const TreeEcology& ecology_of(std::string_view id, const char* path, const WorldLookup& lookup) {
    if (const TreeEcology* ecology = lookup.tree(id)) return *ecology;
    throw InvalidInput(path, "there is no kind of tree " + in_quotes(id));
}

/// Returns the coordinates of a place on the grid of a ground. Places beyond the world have the ground of its rim.
Coordinate coordinate_of(const World& world, std::int32_t units) {
    const double half = 0.5 * world.params.extent;
    return coordinate_at(world.ground->grid, std::clamp(metres(units), -half, half));
}

/// Sets the species of a world, without their spread.
void add_species(World& world, const WorldLookup& lookup) {
    std::vector<Problem> problems;
    world.species_ids = species_in(world.params.fungi.species, "fungi.species", problems);
    std::vector<std::string> kinds;
    kinds.reserve(world.stand.kinds.size());
    for (const StandKind& kind : world.stand.kinds) kinds.push_back(kind.id);
    world.species =
        fungi_of(world.species_ids, world.params.climate, kinds, lookup, world.edits, problems);
    if (!problems.empty()) throw InvalidInput(std::move(problems));
}

/// Sets which masks each species has.
void add_masks(World& world) {
    const std::shared_ptr<const WorldMask> of_all = world.edits->mask(mask_of_fungi);
    world.masks.resize(world.species_ids.size());
    bool has_any = false;
    for (std::size_t i = 0; i < world.masks.size(); ++i)
        for (const std::shared_ptr<const WorldMask>& mask :
             {of_all, world.edits->mask(world.species_ids[i])}) {
            if (!mask) continue;
            world.masks[i].push_back(mask);
            has_any = true;
        }
    if (!has_any) world.masks.clear();
}

/// Multiplies the suitability of the cells of a grid for a species by the means of its masks over them.
void apply_masks(const World& world, std::size_t species, const Grid& grid,
                 std::vector<double>& suitability) {
    if (world.masks.empty()) return;
    const double half = 0.5 * grid.cell;
    for (const std::shared_ptr<const WorldMask>& mask : world.masks[species])
        for (int row = 0; row < grid.side; ++row)
            for (int column = 0; column < grid.side; ++column) {
                const double x = grid.place(column), y = grid.place(row);
                double& value = suitability[grid.index(column, row)];
                if (value > 0.0) value *= mask->over({x - half, y - half, x + half, y + half});
            }
}

/// Returns the founders of a species: its own, or those that are drawn.
std::vector<Founder> founders_in(const World& world, std::size_t species, const Grid& grid,
                                 std::span<const double> suitability) {
    if (world.edits)
        if (const auto own = world.edits->founders.find(world.species_ids[species]);
            own != world.edits->founders.end())
            return own->second;
    return founders_of(grid, world.params.seed, world.species[species].stream, suitability);
}

/// What crowns do to the whole of a world: the share of the ground below them, and the light that they leave there.
struct Canopy {
    double closure = 0.0, light = 1.0;
};

Canopy canopy_of(const StandParams& stand) {
    // Seedlings at half of all places close a wood within decades. Crowns of such a wood have five square metres of
    // leaves above each one of the ground.
    const double closure = std::min(1.0, stand.density / 0.5);
    return {closure, exponential(-0.5 * 5.0 * closure)};
}

/// Returns what each cell of the grid on which species spread has to give, as far as is known before any tree is.
std::vector<Site> sites_of(const World& world, const Grid& grid, const Parallel& parallel) {
    std::vector<Site> sites(grid.nodes());
    constexpr int stripe = 16;
    std::vector<std::function<void()>> tasks;
    for (int first = 0; first < grid.side; first += stripe)
        tasks.emplace_back([&, first] {
            for (int row = first; row < std::min(first + stripe, grid.side); ++row)
                for (int column = 0; column < grid.side; ++column)
                    sites[grid.index(column, row)] = world.site_at(
                        {static_cast<std::int32_t>(grid.place(column) * units_of_metre),
                         static_cast<std::int32_t>(grid.place(row) * units_of_metre)});
        });
    parallel(tasks);
    return sites;
}

/// Returns how well a species could live at some sites, 0..1.
std::vector<double> suitability_of(const World& world, const FungusSpecies& species,
                                   std::span<const Site> sites) {
    const Canopy canopy = canopy_of(world.params.stand);
    double hosts = 0.0;
    for (std::size_t k = 0; k < world.stand.kinds.size(); ++k)
        if ((species.kinds >> k & 1U) != 0U) hosts += 1.0;
    const bool needs_trees = species.ecology.guild != Guild::grass;
    std::vector<double> out;
    out.reserve(sites.size());
    for (Site site : sites) {
        // There is more light at the rims of woods and in their gaps than in their mean.
        const double open = site.light;
        site.light = open * canopy.light;
        const double below = suitability(species.ecology, site);
        site.light = open * std::max(canopy.light, 0.5);
        const double above = suitability(species.ecology, site);
        out.push_back(needs_trees && hosts == 0.0 ? 0.0 : std::max(below, above));
    }
    return out;
}

void spread_species(World& world, const Parallel& parallel) {
    const double closure = canopy_of(world.params.stand).closure;
    const WindCover cover{.closure = closure, .crown_top = world.params.stand.height};
    const SpreadGround ground = spread_ground(*world.ground, world.params.climate, cover);
    const std::vector<Site> sites = sites_of(world, ground.grid, parallel);
    // Two groups at least, which two threads may take.
    const std::size_t number = world.species.size();
    const std::size_t group = std::clamp<std::size_t>((number + 1) / 2, 1, spore_lanes);
    world.establishment.resize(number);
    std::vector<std::function<void()>> tasks;
    for (std::size_t first = 0; first < number; first += group)
        tasks.emplace_back([&, first] {
            const std::size_t last = std::min(first + group, number);
            std::vector<std::vector<double>> suits;
            std::vector<std::vector<Founder>> founders;
            std::vector<Spreading> species;
            for (std::size_t i = first; i < last; ++i) {
                suits.push_back(suitability_of(world, world.species[i], sites));
                apply_masks(world, i, ground.grid, suits.back());
                founders.push_back(founders_in(world, i, ground.grid, suits.back()));
            }
            for (std::size_t i = first; i < last; ++i)
                species.push_back(
                    {world.species[i].ecology.spores, suits[i - first], founders[i - first]});
            std::vector<Establishment> spread = spread_together(ground, species);
            std::move(spread.begin(), spread.end(),
                      world.establishment.begin() + static_cast<std::ptrdiff_t>(first));
        });
    parallel(tasks);
}

}  // namespace

Stand stand_of(const WorldParams& params, const WorldLookup& lookup) {
    Stand stand;
    stand.params = params.stand;
    stand.seed = params.seed;
    std::vector<Problem> problems;
    Weights kinds = kinds_in(params.stand.kinds, "stand.kinds", problems);
    if (!problems.empty()) throw InvalidInput(std::move(problems));
    double sum = 0.0;
    for (const auto& [id, weight] : kinds) sum += weight;
    stand.kinds.reserve(kinds.size() + 1);
    for (const auto& [id, weight] : kinds)
        stand.kinds.push_back({id, weight / sum, ecology_of(id, "stand.kinds", lookup)});
    if (params.stand.lone.empty()) return stand;
    const auto same = [&](const StandKind& kind) { return kind.id == params.stand.lone.view(); };
    const auto found = std::find_if(stand.kinds.begin(), stand.kinds.end(), same);
    stand.lone = static_cast<std::uint8_t>(found - stand.kinds.begin());
    if (found == stand.kinds.end())
        stand.kinds.push_back(
            {params.stand.lone.string(), 0.0, ecology_of(params.stand.lone, "stand.lone", lookup)});
    return stand;
}

Site World::site_at(WorldPoint at) const {
    const Coordinate x = coordinate_of(*this, at.x), y = coordinate_of(*this, at.y);
    const double index = wetness_index_at(*ground, x, y);
    return {.light = light_at(horizon_at(horizon, metres(at.x), metres(at.y)),
                              sporeprint::place_at(*ground, x, y), sun),
            .wetness = wetness_on(*ground, index, autumn_water),
            .acidity = params.soil.acidity,
            .index = index};
}

Site World::dim_site_at(WorldPoint at) const {
    const double index =
        wetness_index_at(*ground, coordinate_of(*this, at.x), coordinate_of(*this, at.y));
    return {.light = diffuse_share * sky_at(horizon, metres(at.x), metres(at.y)),
            .wetness = wetness_on(*ground, index, autumn_water),
            .acidity = params.soil.acidity,
            .index = index};
}

Place World::place_at(WorldPoint at) const {
    return sporeprint::place_at(*ground, coordinate_of(*this, at.x), coordinate_of(*this, at.y));
}

double World::share_at(std::size_t of_species, WorldPoint at) const {
    double share = 1.0;
    if (!masks.empty())
        for (const std::shared_ptr<const WorldMask>& mask : masks[of_species])
            share *= mask->at(at);
    return share;
}

double World::downwind() const {
    // Winds come from a bearing, which turns from north to east; they blow to the opposite one.
    return radians(270.0 - params.climate.wind_from_deg);
}

std::size_t World::bytes() const {
    std::size_t sum = sizeof(World) + horizon.bytes() + key.size();
    for (const Establishment& one : establishment) sum += one.bytes();
    return edits ? sum + edits->bytes() : sum;
}

std::string world_key(const WorldParams& params, const SharedEdits& edits) {
    std::string key = "world ";
    canonical(params, key);
    if (edits && !edits->empty()) (key += '\n') += edits->text;
    return key;
}

World world_of(const WorldParams& params, const WorldLookup& lookup,
               std::shared_ptr<const Ground> ground, const Parallel& parallel, SharedEdits edits) {
    World world;
    world.params = params;
    world.stand = stand_of(params, lookup);
    world.ground = std::move(ground);
    world.horizon = horizon_of(world.ground->grid, world.ground->heights, parallel);
    world.sun = sun_of(radians(params.climate.latitude_deg),
                       is_southern(params) ? midsummer + half_a_year : midsummer);
    world.autumn_water = autumn_water_of(params);
    world.key = world_key(params, edits);
    world.edits = std::move(edits);
    if (world.edits) world.stand.mask = world.edits->mask(mask_of_trees);
    add_species(world, lookup);
    if (world.edits) add_masks(world);
    spread_species(world, parallel);
    return world;
}

std::size_t Block::bytes() const {
    return sizeof(Block) + trees.size() * sizeof(StandTree) + dead.size() * sizeof(DeadWood) +
           falls.standing.size() * sizeof(StandingTrunk) +
           falls.fallen.size() * sizeof(FallenTrunk);
}

namespace {

FallSiteAt slopes_of(const World& world) {
    return [&world](WorldPoint at) {
        const Place place = world.place_at(at);
        return FallSite{place.east, place.north};
    };
}

}  // namespace

std::vector<StandTree> trees_of_block(const World& world, CellIndex block) {
    return trees_of(
        world.stand, [&](WorldPoint at) { return world.site_at(at); }, block,
        [&](WorldPoint at) { return world.dim_site_at(at); });
}

Falls falls_of_block(const World& world, std::span<const StandTree> trees) {
    return falls_of(world.stand, trees, slopes_of(world), world.downwind());
}

std::vector<DeadWood> wood_of_block(const World& world, std::span<const StandTree> trees,
                                    std::span<const Falls* const> near) {
    return dead_wood_of(world.stand, trees, near, slopes_of(world), world.downwind());
}

std::array<CellIndex, 9> blocks_about(CellIndex block) {
    std::array<CellIndex, 9> out;
    for (int i = 0; i < 9; ++i)
        out[static_cast<std::size_t>(i)] = {block.x + i % 3 - 1, block.y + i / 3 - 1};
    return out;
}

Block block_of(const World& world, CellIndex block) {
    Block out;
    std::array<Falls, 9> falls;
    std::array<const Falls*, 9> near{};
    const std::array<CellIndex, 9> about = blocks_about(block);
    for (std::size_t i = 0; i < about.size(); ++i) {
        std::vector<StandTree> trees = trees_of_block(world, about[i]);
        falls[i] = falls_of_block(world, trees);
        near[i] = &falls[i];
        if (about[i] == block) out.trees = std::move(trees);
    }
    out.dead = wood_of_block(world, out.trees, near);
    return out;
}

std::vector<CellIndex> blocks_of(const WorldBox& box) {
    const auto first = [](double metres) {
        return static_cast<std::int32_t>(std::floor(metres / block_side));
    };
    // A side that lies between two blocks belongs to the one that ends there.
    const auto last = [](double metres) {
        return static_cast<std::int32_t>(std::ceil(metres / block_side)) - 1;
    };
    std::vector<CellIndex> blocks;
    for (std::int32_t y = first(box.south); y <= last(box.north); ++y)
        for (std::int32_t x = first(box.west); x <= last(box.east); ++x) blocks.push_back({x, y});
    return blocks;
}

bool contains(const WorldBox& box, WorldPoint at) {
    const double x = metres(at.x), y = metres(at.y);
    return x >= box.west && x < box.east && y >= box.south && y < box.north;
}

}  // namespace sporeprint
