#include "core/scene/scene_mycelia.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <string>

#include "core/math/elementary.h"
#include "core/math/purposes.h"
#include "core/problems.h"
#include "core/scene/surfel_search.h"
#include "core/world/cell_random.h"

namespace sporeprint {

namespace {

/// Lives last from half of the mean to one and a half of it.
constexpr double shortest_life = 0.5, longest_life = 1.5;

/// On wood mycelia are a hundred times as frequent as on the ground.
constexpr double wood_factor = 100.0;

/// Mycelia that may begin on a scene, before any condition of their places is regarded.
constexpr std::size_t most_births = 100'000;

constexpr std::uint32_t all_of_24_bits = 1U << 24;

WorldTime ticks(double years) {
    return static_cast<WorldTime>(std::floor(years * ticks_of_year + 0.5));
}

double years_of(WorldTime time) { return static_cast<double>(time) / ticks_of_year; }

std::uint32_t chance(double probability) {
    return static_cast<std::uint32_t>(
        std::floor(std::clamp(probability, 0.0, 1.0) * all_of_24_bits + 0.5));
}

bool is_of_ground(const FungusSpecies& species) { return species.ecology.guild != Guild::wood; }

double distance_between(WorldPoint a, WorldPoint b) {
    const double x = metres(a.x) - metres(b.x), y = metres(a.y) - metres(b.y);
    return std::sqrt(x * x + y * y);
}

/// The rim of the ground of a species in the plan of a scene, over which mycelia come in.
struct Rim {
    struct Place {
        std::uint32_t surfel = 0;
        WorldPoint at;
    };
    static constexpr std::size_t sectors = 256;

    std::vector<Place> places;  ///< in each direction from the middle the farthest surfels
    double west = 0.0, south = 0.0, east = 0.0,
           north = 0.0;  ///< of all ground of the species, metres
    double area = 0.0;   ///< of it in the plan, m²

    Rim(const SceneHabitat& habitat, const FungusSpecies& species) {
        const Surfels& surfels = habitat.surfels();
        std::vector<std::uint32_t> ground;
        west = south = std::numeric_limits<double>::max();
        east = north = -west;
        for (std::uint32_t i = 0; i < surfels.size(); ++i) {
            if (!habitat.substrates.suits(species, i, habitat.conditions.decay)) continue;
            ground.push_back(i);
            const auto x = static_cast<double>(surfels[i].at.x),
                       y = -static_cast<double>(surfels[i].at.z);
            west = std::min(west, x);
            east = std::max(east, x);
            south = std::min(south, y);
            north = std::max(north, y);
            area += static_cast<double>(surfels[i].area) *
                    std::abs(static_cast<double>(surfels[i].normal.y));
        }
        std::array<double, sectors> farthest{};
        struct Polar {
            std::size_t sector;
            double away;
        };
        std::vector<Polar> polar;
        polar.reserve(ground.size());
        for (const std::uint32_t i : ground) {
            const double x = static_cast<double>(surfels[i].at.x) - 0.5 * (west + east),
                         y = -static_cast<double>(surfels[i].at.z) - 0.5 * (south + north);
            const double turn = arc_tangent(y, x) / (2.0 * pi) + 0.5;
            const auto sector = std::min(static_cast<std::size_t>(turn * sectors), sectors - 1);
            polar.push_back({sector, std::sqrt(x * x + y * y)});
            farthest[sector] = std::max(farthest[sector], polar.back().away);
        }
        for (std::size_t k = 0; k < ground.size(); ++k)
            if (polar[k].away >= farthest[polar[k].sector] - 2.0 * surfels.spacing())
                places.push_back(
                    {ground[k], point_at(static_cast<double>(surfels[ground[k]].at.x),
                                         -static_cast<double>(surfels[ground[k]].at.z))});
    }
    /// Returns whether a place of the rim is on the side of a centre that lies outside.
    [[nodiscard]] bool faces(const Place& place, WorldPoint centre) const {
        const double x = metres(place.at.x), y = metres(place.at.y);
        return (x - 0.5 * (west + east)) * (metres(centre.x) - x) +
                   (y - 0.5 * (south + north)) * (metres(centre.y) - y) >
               0.0;
    }
    /// Returns the place that is nearest to a centre outside, or null.
    [[nodiscard]] const Place* entry(WorldPoint centre) const {
        const Place* best = nullptr;
        double least = 0.0;
        for (const Place& place : places) {
            const double away = distance_between(place.at, centre);
            if (best != nullptr && away >= least) continue;
            best = &place;
            least = away;
        }
        return best;
    }
};

/// A mycelium that may begin.
struct Birth {
    SceneGenet one;
    double years = 0.0;
    std::uint32_t draw = 0;
};

}  // namespace

std::uint64_t piece_id(std::uint32_t piece) {
    return mixed(std::uint64_t{piece} + 1, stream_of("wood"), 0);
}

/// The mycelia by the surfels of their centres.
struct MyceliumRivals::State {
    const SceneHabitat& habitat;
    const FungusSpecies& species;
    SurfelSearch search;
    std::vector<Genet> genets;
    static constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();
    std::vector<std::uint32_t> last_at;  ///< of each surfel: the last one that begins there
    std::vector<std::uint32_t> previous;
};

MyceliumRivals::MyceliumRivals(const SceneHabitat& habitat, const FungusSpecies& species)
    : state_(new State{habitat,
                       species,
                       SurfelSearch(habitat.shape->graph, habitat.surfels().size()),
                       {},
                       std::vector<std::uint32_t>(habitat.surfels().size(), State::none),
                       {}}) {}

MyceliumRivals::~MyceliumRivals() = default;

void MyceliumRivals::add(const SceneGenet& genet) {
    state_->previous.push_back(state_->last_at[genet.surfel]);
    state_->last_at[genet.surfel] = static_cast<std::uint32_t>(state_->genets.size());
    state_->genets.push_back(genet.genet);
}

bool MyceliumRivals::has_owner(std::uint32_t surfel, std::uint64_t own, WorldTime time,
                               double before, double founding) const {
    if (state_->genets.empty()) return false;
    const Ecology& ecology = state_->species.ecology;
    const double reach = std::max(
        founding,
        std::min(ecology.genet.reach, ecology.genet.speed * ecology.genet.life * longest_life));
    const SearchStart start{surfel, 0.0, reach};
    bool is_owned = false;
    state_->search.run(
        std::span(&start, 1), reach,
        [&](std::uint32_t i) {
            return state_->habitat.substrates.suits(state_->species, i,
                                                    state_->habitat.conditions.decay);
        },
        [&](const SearchFind& find) {
            for (std::uint32_t i = state_->last_at[find.surfel]; i != State::none;
                 i = state_->previous[i]) {
                const Genet& genet = state_->genets[i];
                if (genet.id == own || !genet.lives_at(time)) continue;
                if (find.cost < founding || arrival(genet, find.cost) < before) is_owned = true;
            }
            return !is_owned;
        });
    return is_owned;
}

namespace {

/// Draws what births have in common.
class Births {
  public:
    Births(const SceneHabitat& habitat, const FungusSpecies& species, std::uint8_t index, int year)
        : habitat_(habitat), species_(species), index_(index), end_(years_of(time_of(year + 1))) {}

    /// Appends births of a stream.
    ///
    /// rate   per year
    /// place  called with a birth and its draws; sets its centre
    template <class Place>
    void append(std::uint64_t stream, double rate, const Place& place) {
        if (!(rate > 0.0)) return;
        const GenetHabit& habit = species_.ecology.genet;
        CellRandom random(habitat_.conditions.seed, purposes::scene_mycelia, species_.stream,
                          stream);
        double years = -longest_life * habit.life;
        for (std::size_t number = 0;; ++number) {
            const double wait = random.uniform(), where = random.uniform(), side = random.uniform(),
                         life = random.uniform();
            Birth birth;
            birth.draw = random.bits24();
            Genet& genet = birth.one.genet;
            genet.id = random.identifier();
            years += -logarithm(1.0 - wait) / rate;
            if (years >= end_) break;
            if (number == most_births)
                throw Impossible("/scene", "more than " + std::to_string(most_births) +
                                               " mycelia of one species would begin on it; take "
                                               "a smaller scene");
            birth.years = years;
            genet.born = ticks(years);
            const double share = shortest_life + (longest_life - shortest_life) * life;
            genet.died = genet.born + std::max(WorldTime{1}, ticks(habit.life * share));
            genet.species = index_;
            genet.speed = habit.speed;
            genet.reach = habit.reach;
            if (place(birth.one, where, side)) all.push_back(birth);
        }
    }

    std::vector<Birth> all;

  private:
    const SceneHabitat& habitat_;
    const FungusSpecies& species_;
    std::uint8_t index_;
    double end_;
};

/// Draws the mycelia that begin on what a species lives on.
void append_births_on_scene(const SceneHabitat& habitat, const FungusSpecies& species,
                            Births& births) {
    const Surfels& surfels = habitat.surfels();
    std::vector<double> sums;
    std::vector<std::uint32_t> places;
    double area = 0.0;
    for (std::uint32_t i = 0; i < surfels.size(); ++i) {
        if (!habitat.substrates.suits(species, i, habitat.conditions.decay)) continue;
        area += static_cast<double>(surfels[i].area);
        sums.push_back(area);
        places.push_back(i);
    }
    const double rate =
        species.ecology.genet.rate * (is_of_ground(species) ? 1.0 : wood_factor) * area;
    births.append(0, rate, [&](SceneGenet& one, double where, double) {
        const auto found = std::ranges::upper_bound(sums, where * area) - sums.begin();
        one.surfel = places[std::min(static_cast<std::size_t>(found), places.size() - 1)];
        one.genet.centre = point_at(static_cast<double>(surfels[one.surfel].at.x),
                                    -static_cast<double>(surfels[one.surfel].at.z));
        return true;
    });
}

/// Draws those that begin on the ground beside the scene, as densely as on its own.
void append_births_outside(const Rim& rim, const FungusSpecies& species, Births& births) {
    const GenetHabit& habit = species.ecology.genet;
    const double wide = rim.east - rim.west, deep = rim.north - rim.south;
    if (!(wide > 0.0) || !(deep > 0.0)) return;
    const double reach = std::min(habit.reach, habit.speed * habit.life * longest_life);
    const double whole = (wide + 2.0 * reach) * (deep + 2.0 * reach);
    const double like_it = std::min(1.0, rim.area / (wide * deep));
    births.append(1, habit.rate * whole * like_it, [&](SceneGenet& one, double where, double side) {
        const double x = rim.west - reach + where * (wide + 2.0 * reach),
                     y = rim.south - reach + side * (deep + 2.0 * reach);
        if (x >= rim.west && x <= rim.east && y >= rim.south && y <= rim.north) return false;
        one.genet.centre = point_at(x, y);
        const Rim::Place* const entry = rim.entry(one.genet.centre);
        if (entry == nullptr || distance_between(entry->at, one.genet.centre) > reach) return false;
        one.surfel = entry->surfel;
        one.is_from_outside = true;
        return true;
    });
}

}  // namespace

std::vector<SceneGenet> scene_genets(const SceneHabitat& habitat, const FungusSpecies& species,
                                     std::uint8_t index, const SceneEstablishment& establishment,
                                     int year) {
    std::vector<SceneGenet> out;
    const bool is_ground = is_of_ground(species);
    Births births(habitat, species, index, year);
    append_births_on_scene(habitat, species, births);
    if (is_ground) append_births_outside(Rim(habitat, species), species, births);
    // By their births, so that those before are known.
    std::ranges::sort(births.all, [](const Birth& a, const Birth& b) {
        return a.years != b.years ? a.years < b.years : a.one.genet.id < b.one.genet.id;
    });
    MyceliumRivals rivals(habitat, species);
    std::vector<Genet> outside;
    const double founding = is_ground ? founding_distance : 0.0;
    for (Birth& birth : births.all) {
        SceneGenet& one = birth.one;
        Genet& genet = one.genet;
        const double established = establishment.at(one.surfel, birth.years);
        if (birth.draw >= chance(established * habitat.suitability(species, one.surfel))) continue;
        const std::uint32_t piece = habitat.substrates.pieces[one.surfel];
        genet.host = piece == SurfelSubstrates::no_piece ? 0 : piece_id(piece);
        const auto covers = [&](const Genet& old) {
            const double away = distance_between(old.centre, genet.centre);
            return old.lives_at(genet.born) &&
                   (away < founding || arrival(old, away) < birth.years);
        };
        // Beside the scene all is level, so that straight ways are the shortest ones.
        const bool is_covered =
            std::ranges::any_of(outside, covers) ||
            (one.is_from_outside
                 ? std::ranges::any_of(out,
                                       [&](const SceneGenet& old) { return covers(old.genet); })
                 : rivals.has_owner(one.surfel, 0, genet.born, birth.years, founding));
        if (is_covered) continue;
        if (one.is_from_outside)
            outside.push_back(genet);
        else
            rivals.add(one);
        out.push_back(one);
    }
    return out;
}

Territory territory_of(const SceneHabitat& habitat, const FungusSpecies& species,
                       std::span<const SceneGenet> genets, WorldTime time) {
    const std::size_t count = habitat.surfels().size();
    Territory out;
    out.owner.assign(count, Territory::nobody);
    out.distance.assign(count, 0.0F);
    const double speed = species.ecology.genet.speed;
    std::vector<SearchStart> starts;
    struct Origin {
        std::uint32_t number = 0;
        double away = 0.0;  ///< of a start from the centre, metres
    };
    std::vector<Origin> origins;
    std::optional<Rim> rim;
    for (std::uint32_t i = 0; i < genets.size(); ++i) {
        const Genet& genet = genets[i].genet;
        if (!genet.lives_at(time)) continue;
        // Costs are metres that an older one is ahead.
        const double cost = speed * years_between(time, genet.born);
        if (!genets[i].is_from_outside) {
            starts.push_back({genets[i].surfel, cost, genet.reach});
            origins.push_back({i, 0.0});
            continue;
        }
        if (!rim) rim.emplace(habitat, species);
        for (const Rim::Place& place : rim->places) {
            const double away = distance_between(place.at, genet.centre);
            if (away > genet.reach || cost + away > 0.0 || !rim->faces(place, genet.centre))
                continue;
            starts.push_back({place.surfel, cost + away, genet.reach - away});
            origins.push_back({i, away});
        }
    }
    if (starts.empty()) return out;
    SurfelSearch search(habitat.shape->graph, count);
    search.run(
        starts, 0.0,
        [&](std::uint32_t i) {
            return habitat.substrates.suits(species, i, habitat.conditions.decay);
        },
        [&](const SearchFind& find) {
            const Origin& origin = origins[find.start];
            out.owner[find.surfel] = origin.number;
            out.distance[find.surfel] =
                static_cast<float>(origin.away + find.cost - starts[find.start].cost);
            return true;
        });
    return out;
}

}  // namespace sporeprint
