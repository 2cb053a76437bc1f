#include "core/scene/scene_season.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <optional>
#include <string>
#include <utility>

#include "core/math/direction.h"
#include "core/math/elementary.h"
#include "core/math/purposes.h"
#include "core/problems.h"
#include "core/scene/point_grid.h"
#include "core/scene/surfel_search.h"
#include "core/world/cell_random.h"
#include "core/world/flushes.h"
#include "core/world/fruiting_weather.h"
#include "core/world/influence.h"
#include "core/world/tree_growth.h"

namespace sporeprint {

namespace {

/// Bodies that may grow on a scene in a year, and those that are drawn for them.
constexpr std::size_t most_sprouts = 60'000, most_drawn = 1'000'000;

/// Ring round a host, in radii of its crown, and its variation among hosts (of the logarithm), as in worlds.
constexpr double ring_per_crown = 0.7, ring_variation = 0.25;

/// Rings round hosts that stand outside the scene: so many metres of them lie on each square metre, as in a wood of 325
/// trees on a hectare.
constexpr double ring_per_area = 0.36;

/// Bodies of the ground stand where its normal is at least so high; those on wood hang no farther over.
constexpr double least_rise = 0.35, lowest_overhang = -0.32;

/// A body needs so much space above it, in radii of its cap.
constexpr double space_above = 2.0;

/// A body that may grow, and from which abundance on it does.
struct Sprout {
    SceneBody body;
    double appears = 0.0;
};

/// A surfel and how much of a flush falls to it.
struct Share {
    std::uint32_t surfel = 0;
    double sum = 0.0;  ///< of its weight and of all before it
};

struct Foot {
    glm::dvec3 at{0.0}, out{0.0, 1.0, 0.0};
    std::uint32_t surfel = 0;
};

/// The fruit bodies of one scene in a year.
class SceneSeason {
  public:
    SceneSeason(const SceneFungi& fungi, int year)
        : fungi_(fungi),
          habitat_(*fungi.habitat),
          surfels_(habitat_.surfels()),
          year_(year),
          begin_(time_of(year)),
          end_(time_of(year + 1)),
          spacing_(spacing_of(fungi.species)),
          water_(water_of(habitat_.conditions, year)),
          conditions_(conditions_of(
              fungi.species,
              weather_of(habitat_.conditions.climate, habitat_.conditions.seed,
                         std::max(year - 1, 0)),
              weather_of(habitat_.conditions.climate, habitat_.conditions.seed, year))),
          search_(habitat_.shape->graph, surfels_.size()) {}

    std::vector<SceneBody> bodies() {
        for (std::size_t i = 0; i < fungi_.species.size(); ++i) {
            index_ = i;
            species_ = &fungi_.species[i];
            const FruitHabit& fruit = species_->ecology.fruit;
            tufts_ = AtLeastOne(fruit.clusters);
            bodies_of_tuft_ = AtLeastOne(fruit.tufts);
            if (species_->ecology.guild == Guild::wood && species_->ecology.body.perennial)
                add_brackets();
            else
                add_flushes();
        }
        std::vector<SceneBody> out = spaced(sprouts_);
        out.insert(out.end(), brackets_.begin(), brackets_.end());
        std::ranges::sort(out, {}, [](const SceneBody& body) { return body.record.id; });
        return out;
    }

  private:
    /// Returns how far the wetness of a surfel allows fungi to fruit on a day, 0..1.
    [[nodiscard]] double moisture(std::uint32_t surfel, int day) const {
        return moisture_gate(water_.on(habitat_.supply(surfel), static_cast<std::size_t>(day)) /
                             most_soil_water);
    }

    void add_flushes() {
        const std::vector<GoodDay> good = good_days_of(conditions_, index_);
        if (good.empty()) return;
        const std::vector<SceneGenet>& genets = fungi_.genets[index_];
        territory_ = territory_of(habitat_, *species_, genets, begin_);
        std::vector<std::vector<std::uint32_t>> owned(genets.size());
        for (std::uint32_t i = 0; i < surfels_.size(); ++i)
            if (const std::uint32_t owner = territory_.owner[i]; owner != Territory::nobody)
                owned[owner].push_back(i);
        for (std::uint32_t number = 0; number < genets.size(); ++number) {
            if (owned[number].empty()) continue;
            const SceneGenet& genet = genets[number];
            const std::vector<int> days =
                flush_days(habitat_.conditions.seed, year_, genet.genet, good,
                           [&](const GoodDay& day) { return moisture(genet.surfel, day.day); });
            for (std::size_t i = 0; i < days.size(); ++i)
                fruit(number, owned[number], days[i], flush_number(year_, i));
        }
    }

    /// Places the bodies of a flush on the surfels that a mycelium has.
    void fruit(std::uint32_t number, const std::vector<std::uint32_t>& owned, int day,
               std::uint32_t flush) {
        const SceneGenet& genet = fungi_.genets[index_][number];
        std::vector<Share> shares;
        double sum = 0.0;
        const Ring ring = ring_of(genet.genet);
        for (const std::uint32_t i : owned) {
            const double weight = weight_at(i, ring) * habitat_.suitability(*species_, i) *
                                  moisture(i, day) * static_cast<double>(surfels_[i].area);
            if (!(weight > 0.0)) continue;
            sum += weight;
            shares.push_back({i, sum});
        }
        const WorldTime time = time_of(year_, day + 1);
        for_clusters(habitat_.conditions.seed, species_->ecology.fruit,
                     species_->ecology.fruit.density * sum, habitat_.conditions.abundance,
                     genet.genet.id, flush, [&](double appears, CellRandom random) {
                         const double draw = random.uniform();
                         const std::uint32_t middle = drawn(shares, draw * sum);
                         add_cluster(
                             genet, {appears, time, middle}, random,
                             [&](std::uint32_t i) { return territory_.owner[i] == number; },
                             sprouts_);
                     });
    }

    static std::uint32_t drawn(const std::vector<Share>& shares, double at) {
        const auto found = std::ranges::upper_bound(shares, at, {}, &Share::sum);
        return found == shares.end() ? shares.back().surfel : found->surfel;
    }

    /// How densely bodies stand at a distance from the centre: metres of ring, or square metres, on each square metre.
    struct Ring {
        bool is_band = false;         ///< otherwise everywhere, or round hosts
        double from = 0.0, to = 0.0;  ///< distances from the centre, metres
        double density = 1.0;
    };

    [[nodiscard]] Ring ring_of(const Genet& genet) const {
        const Ecology& ecology = species_->ecology;
        Ring ring;
        const bool is_mycorrhizal = ecology.guild == Guild::ectomycorrhizal;
        if (ecology.guild == Guild::wood || (is_mycorrhizal && !ecology.ring.pioneer)) return ring;
        ring.is_band = true;
        ring.to = radius_at(genet, begin_);
        // No narrower than the surfels are apart.
        const double breadth = std::min(std::max(ecology.ring.spread, surfels_.spacing()), ring.to);
        ring.from = ring.to - breadth;
        // In litter bodies are counted by area, on other rings by length.
        ring.density = ecology.guild == Guild::litter || !(breadth > 0.0) ? 1.0 : 1.0 / breadth;
        return ring;
    }

    [[nodiscard]] double weight_at(std::uint32_t surfel, const Ring& ring) const {
        if (habitat_.shape->buried[surfel] != 0) return 0.0;
        if (ring.is_band) {
            const auto away = static_cast<double>(territory_.distance[surfel]);
            return away >= ring.from && away <= ring.to ? ring.density : 0.0;
        }
        if (species_->ecology.guild == Guild::wood) return 1.0;
        const std::uint32_t piece = habitat_.substrates.pieces[surfel];
        if (piece == SurfelSubstrates::no_piece) return ring_per_area;
        const SceneWood& tree = habitat_.substrates.wood[piece];
        CellRandom of_tree(habitat_.conditions.seed, purposes::mycelium_arcs, species_->stream,
                           piece_id(piece));
        const double wide = of_tree.bell();
        const double middle =
            ring_per_crown * crown_radius(tree.height()) * exponential(ring_variation * wide);
        const double x = static_cast<double>(surfels_[surfel].at.x) -
                         0.5 * (tree.low.x + tree.high.x),
                     z = static_cast<double>(surfels_[surfel].at.z) -
                         0.5 * (tree.low.z + tree.high.z);
        const double spread = std::max(species_->ecology.ring.spread, surfels_.spacing());
        const double off = (std::sqrt(x * x + z * z) - middle) / spread;
        // Integrated over the plane, the length of the ring.
        return exponential(-0.5 * off * off) / (spread * std::sqrt(2.0 * pi));
    }

    struct Cluster {
        double appears = 0.0;
        WorldTime flush = 0;
        std::uint32_t middle = 0;
    };

    /// Adds the bodies of a cluster whose places a mycelium has.
    template <class Owns>
    void add_cluster(const SceneGenet& genet, const Cluster& cluster, CellRandom& random,
                     const Owns& owns, std::vector<Sprout>& out) {
        const FruitHabit& fruit = species_->ecology.fruit;
        const double draw = random.uniform();
        const int tufts = tufts_(draw);
        for (int tuft = 0; tuft < tufts; ++tuft) {
            const double right = random.bell(), forward = random.bell(), many = random.uniform();
            const int number = bodies_of_tuft_(many);
            drawn_ += static_cast<std::size_t>(number);
            if (drawn_ > most_drawn || out.size() > most_sprouts)
                throw Impossible("/scene", "more than " + std::to_string(most_sprouts) +
                                               " fruit bodies of a year would grow on it; lower "
                                               "fungi.abundance");
            for (int i = 0; i < number; ++i) {
                const double x = random.bell(), y = random.bell();
                Sprout sprout;
                sprout.appears = cluster.appears;
                FruitBody& body = sprout.body.record;
                body.id = random.identifier();
                body.species = static_cast<std::uint8_t>(index_);
                body.genet = genet.genet.id;
                body.host = genet.genet.host;
                set_times(body, species_->ecology.body, cluster.flush, end_, random);
                const std::optional<Foot> foot =
                    foot_at(cluster.middle, fruit.cluster_spread * right + fruit.tuft_spread * x,
                            fruit.cluster_spread * forward + fruit.tuft_spread * y);
                if (!foot || !owns(foot->surfel) || !has_space(*foot)) continue;
                put(sprout.body, *foot);
                out.push_back(sprout);
            }
        }
    }

    /// Returns the place on the surface that is so many metres from a surfel in two directions along it.
    [[nodiscard]] std::optional<Foot> foot_at(std::uint32_t surfel, double right,
                                              double forward) const {
        const Surfel& from = surfels_[surfel];
        const glm::dvec3 normal(from.normal);
        const glm::dvec3 across = square_to(normal, {1.0, 0.0, 0.0});
        const glm::dvec3 aside = right * across + forward * glm::cross(normal, across);
        const double high = std::max(0.5 * glm::length(aside), surfels_.spacing());
        const glm::dvec3 start = glm::dvec3(from.at) + aside + high * normal;
        const auto hit = habitat_.shape->tree.first_hit(start, -normal, 0.0, 2.0 * high);
        if (!hit) return std::nullopt;
        Foot foot;
        foot.at = start - hit->distance * normal;
        foot.out = normal_of(*habitat_.shape->scene, hit->triangle);
        const auto nearest =
            surfels_.nearest(foot.at, foot.out, neighbour_spacings * surfels_.spacing());
        if (!nearest || glm::dot(foot.out, normal) <= 0.0 || habitat_.shape->buried[*nearest] != 0)
            return std::nullopt;
        foot.surfel = *nearest;
        const bool is_on_wood = species_->ecology.guild == Guild::wood;
        if (foot.out.y < (is_on_wood ? lowest_overhang : least_rise)) return std::nullopt;
        return foot;
    }

    /// Returns whether nothing is where the cap of a body would be.
    [[nodiscard]] bool has_space(const Foot& foot) const {
        constexpr double above = 2e-3;
        const bool is_on_wood = species_->ecology.guild == Guild::wood;
        const glm::dvec3 way = is_on_wood ? foot.out : glm::dvec3(0.0, 1.0, 0.0);
        return !habitat_.shape->tree.is_blocked(foot.at + above * foot.out, way, 0.0,
                                                space_above * species_->cap_radius);
    }

    /// Sets the place of a body.
    void put(SceneBody& body, const Foot& foot) const {
        body.at = foot.at;
        body.out = foot.out;
        body.surfel = foot.surfel;
        FruitBody& record = body.record;
        record.at = point_at(foot.at.x, -foot.at.z);
        record.height = foot.at.y;
        if (species_->ecology.guild != Guild::wood) return;
        const double level = std::sqrt(foot.out.x * foot.out.x + foot.out.z * foot.out.z);
        const double angle = arc_tangent(-foot.out.z, foot.out.x);
        record.facing = angle < 0.0 ? angle + 2.0 * pi : angle;
        record.pitch = arc_tangent(foot.out.y, level);
        record.trunk = piece_id(habitat_.substrates.pieces[foot.surfel]);
    }

    /// Adds the perennial brackets of the species: those of the whole lives of its mycelia, so that the year does not
    /// matter.
    void add_brackets() {
        MyceliumRivals rivals(habitat_, *species_);
        const std::vector<SceneGenet>& genets = fungi_.genets[index_];
        for (const SceneGenet& genet : genets) rivals.add(genet);
        for (const SceneGenet& genet : genets)
            if (genet.genet.born < end_ && genet.genet.died > begin_)
                add_brackets_of(genet, rivals);
    }

    void add_brackets_of(const SceneGenet& own, const MyceliumRivals& rivals) {
        const Genet& genet = own.genet;
        const double radius = radius_at(genet, genet.died - 1);
        std::vector<Share> shares;
        std::vector<std::pair<std::uint32_t, double>> reached;
        double sum = 0.0;
        const SearchStart start{own.surfel, 0.0, radius};
        search_.run(
            std::span(&start, 1), radius,
            [&](std::uint32_t i) {
                return habitat_.substrates.suits(*species_, i, habitat_.conditions.decay);
            },
            [&](const SearchFind& find) {
                reached.emplace_back(find.surfel, find.cost);
                const double weight = habitat_.shape->buried[find.surfel] != 0
                                          ? 0.0
                                          : habitat_.suitability(*species_, find.surfel) *
                                                static_cast<double>(surfels_[find.surfel].area);
                if (weight > 0.0) shares.push_back({find.surfel, sum += weight});
                return true;
            });
        if (shares.empty()) return;
        std::ranges::sort(reached);
        const auto distance = [&](std::uint32_t surfel) {
            const auto found = std::ranges::lower_bound(reached, surfel, {},
                                                        [](const auto& one) { return one.first; });
            return found != reached.end() && found->first == surfel ? std::optional(found->second)
                                                                    : std::nullopt;
        };
        std::vector<Sprout> sprouts;
        for_clusters(habitat_.conditions.seed, species_->ecology.fruit,
                     species_->ecology.fruit.density * sum, habitat_.conditions.abundance, genet.id,
                     0, [&](double appears, CellRandom random) {
                         const double where = random.uniform(), when = random.uniform();
                         const std::uint32_t middle = drawn(shares, where * sum);
                         const WorldTime time =
                             genet.born +
                             static_cast<WorldTime>(std::floor(when * (genet.died - genet.born)));
                         const std::optional<double> away = distance(middle);
                         if (!away || *away > radius_at(genet, time) ||
                             rivals.has_owner(middle, genet.id, time, arrival(genet, *away), 0.0))
                             return;
                         add_cluster(
                             own, {appears, time, middle}, random,
                             [&](std::uint32_t i) { return distance(i).has_value(); }, sprouts);
                     });
        for (Sprout& sprout : sprouts) {
            FruitBody& body = sprout.body.record;
            body.gone = std::min(body.gone, genet.died);
            body.matured = std::min(body.matured, body.gone - 1);
        }
        std::erase_if(sprouts, [](const Sprout& sprout) {
            return sprout.body.record.gone <= sprout.body.record.emerged + 1;
        });
        for (const SceneBody& body : spaced(sprouts))
            if (body.record.emerged < end_ && body.record.gone > begin_) brackets_.push_back(body);
    }

    /// Returns the bodies of sprouts that no sprout of higher priority stands too near to.
    [[nodiscard]] std::vector<SceneBody> spaced(const std::vector<Sprout>& sprouts) const {
        PointGrid grid(std::max(spacing_, 1e-3), sprouts.size());
        for (std::uint32_t i = 0; i < sprouts.size(); ++i) grid.insert(sprouts[i].body.at, i);
        std::vector<SceneBody> out;
        for (const Sprout& own : sprouts) {
            bool yields = false;
            grid.each_near(own.body.at, spacing_, [&](std::uint32_t number) {
                const Sprout& other = sprouts[number];
                if (&other == &own || yields || !are_crowded(own.body, other.body)) return;
                // Those that appear at a lower abundance have priority: a higher one removes none of them.
                yields = own.appears != other.appears ? other.appears < own.appears
                                                      : other.body.record.id < own.body.record.id;
            });
            if (!yields) out.push_back(own.body);
        }
        return out;
    }

    [[nodiscard]] bool are_crowded(const SceneBody& a, const SceneBody& b) const {
        if (a.record.emerged >= b.record.gone || b.record.emerged >= a.record.gone) return false;
        const double least =
            core_of(fungi_.species[a.record.species]) + core_of(fungi_.species[b.record.species]);
        const glm::dvec3 way = a.at - b.at;
        return glm::dot(way, way) < least * least;
    }

    const SceneFungi& fungi_;
    const SceneHabitat& habitat_;
    const Surfels& surfels_;
    int year_;
    WorldTime begin_, end_;
    double spacing_;
    SurfaceWater water_;
    SeasonConditions conditions_;
    SurfelSearch search_;
    std::size_t index_ = 0, drawn_ = 0;
    const FungusSpecies* species_ = nullptr;
    Territory territory_;
    AtLeastOne tufts_, bodies_of_tuft_;
    std::vector<Sprout> sprouts_;
    std::vector<SceneBody> brackets_;
};

}  // namespace

std::size_t SceneFungi::bytes() const {
    std::size_t sum = sizeof(*this);
    for (const SceneEstablishment& one : establishment) sum += one.bytes();
    for (const std::vector<SceneGenet>& list : genets) sum += list.size() * sizeof(SceneGenet);
    return sum;
}

SceneFungi scene_fungi(std::shared_ptr<const SceneHabitat> habitat,
                       std::vector<FungusSpecies> species, const Parallel& parallel) {
    SceneFungi out;
    out.habitat = std::move(habitat);
    out.species = std::move(species);
    out.establishment.resize(out.species.size());
    out.genets.resize(out.species.size());
    std::vector<std::function<void()>> tasks;
    for (std::size_t i = 0; i < out.species.size(); ++i)
        tasks.emplace_back([&, i] {
            out.establishment[i] = scene_spread(*out.habitat, out.species[i]);
            out.genets[i] = scene_genets(*out.habitat, out.species[i], static_cast<std::uint8_t>(i),
                                         out.establishment[i], last_year);
        });
    parallel(tasks);
    return out;
}

std::vector<SceneBody> scene_season(const SceneFungi& fungi, int year) {
    return SceneSeason(fungi, year).bodies();
}

std::vector<SceneBody> scene_bodies(const SceneFungi& fungi, int year) {
    std::vector<SceneBody> now = scene_season(fungi, year);
    if (year == 0) return now;
    // Brackets are among the bodies of both years.
    for (const SceneBody& body : scene_season(fungi, year - 1))
        if (body.record.gone > time_of(year) &&
            !fungi.species[body.record.species].ecology.body.perennial)
            now.push_back(body);
    std::ranges::sort(now, {}, [](const SceneBody& body) { return body.record.id; });
    return now;
}

std::vector<float> scene_probability(const SceneFungi& fungi, std::size_t species, int year) {
    const SceneHabitat& habitat = *fungi.habitat;
    std::vector<float> out(habitat.surfels().size());
    for (std::size_t i = 0; i < out.size(); ++i)
        out[i] = static_cast<float>(
            std::min(habitat.suitability(fungi.species[species], i),
                     fungi.establishment[species].at(i, static_cast<double>(year))));
    return out;
}

}  // namespace sporeprint
