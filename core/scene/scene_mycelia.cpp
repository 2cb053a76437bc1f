#include "core/scene/scene_mycelia.h"

#include <algorithm>
#include <cmath>
#include <memory>
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

std::vector<SceneGenet> scene_genets(const SceneHabitat& habitat, const FungusSpecies& species,
                                     std::uint8_t index, const SceneEstablishment& establishment,
                                     int year) {
    const Surfels& surfels = habitat.surfels();
    const Ecology& ecology = species.ecology;
    std::vector<SceneGenet> out;
    std::vector<double> sums;
    std::vector<std::uint32_t> places;
    double area = 0.0;
    for (std::uint32_t i = 0; i < surfels.size(); ++i) {
        if (!habitat.substrates.suits(species, i, habitat.conditions.decay)) continue;
        area += static_cast<double>(surfels[i].area);
        sums.push_back(area);
        places.push_back(i);
    }
    const bool is_ground = is_of_ground(species);
    const double rate = ecology.genet.rate * (is_ground ? 1.0 : wood_factor) * area;
    if (!(rate > 0.0)) return out;
    MyceliumRivals rivals(habitat, species);
    CellRandom random(habitat.conditions.seed, purposes::scene_mycelia, species.stream,
                      std::uint64_t{0});
    const WorldTime end = time_of(year + 1);
    double years = -longest_life * ecology.genet.life;
    for (std::size_t births = 0;; ++births) {
        const double wait = random.uniform(), where = random.uniform(), life = random.uniform();
        const std::uint32_t draw = random.bits24();
        const std::uint64_t id = random.identifier();
        years += -logarithm(1.0 - wait) / rate;
        if (years >= years_of(end)) break;
        if (births == most_births)
            throw Impossible("/scene", "more than " + std::to_string(most_births) +
                                           " mycelia of one species would begin on it; take a "
                                           "smaller scene");
        const auto found = std::ranges::upper_bound(sums, where * area) - sums.begin();
        const std::uint32_t surfel =
            places[std::min(static_cast<std::size_t>(found), places.size() - 1)];
        const double established = establishment.at(surfel, years);
        if (draw >= chance(established * habitat.suitability(species, surfel))) continue;
        SceneGenet one;
        one.surfel = surfel;
        Genet& genet = one.genet;
        genet.id = id;
        genet.centre = point_at(static_cast<double>(surfels[surfel].at.x),
                                -static_cast<double>(surfels[surfel].at.z));
        genet.born = ticks(years);
        genet.died =
            genet.born +
            std::max(WorldTime{1}, ticks(ecology.genet.life *
                                         (shortest_life + (longest_life - shortest_life) * life)));
        genet.species = index;
        genet.speed = ecology.genet.speed;
        genet.reach = ecology.genet.reach;
        const std::uint32_t piece = habitat.substrates.pieces[surfel];
        genet.host = piece == SurfelSubstrates::no_piece ? 0 : piece_id(piece);
        if (rivals.has_owner(surfel, 0, genet.born, years, is_ground ? founding_distance : 0.0))
            continue;
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
    std::vector<std::uint32_t> numbers;
    for (std::uint32_t i = 0; i < genets.size(); ++i) {
        const Genet& genet = genets[i].genet;
        if (!genet.lives_at(time)) continue;
        // Costs are metres that an older one is ahead.
        starts.push_back({genets[i].surfel, speed * years_between(time, genet.born), genet.reach});
        numbers.push_back(i);
    }
    if (starts.empty()) return out;
    SurfelSearch search(habitat.shape->graph, count);
    search.run(
        starts, 0.0,
        [&](std::uint32_t i) {
            return habitat.substrates.suits(species, i, habitat.conditions.decay);
        },
        [&](const SearchFind& find) {
            out.owner[find.surfel] = numbers[find.start];
            out.distance[find.surfel] = static_cast<float>(find.cost - starts[find.start].cost);
            return true;
        });
    return out;
}

}  // namespace sporeprint
