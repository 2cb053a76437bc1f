#include "core/world/season.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "core/math/elementary.h"
#include "core/math/purposes.h"
#include "core/problems.h"
#include "core/world/cell_random.h"
#include "core/world/flushes.h"
#include "core/world/fruiting_weather.h"
#include "core/world/influence.h"
#include "core/world/tree_growth.h"

namespace sporeprint {

namespace {

/// Bodies that may grow in one rectangle and near it in a year, and those that are drawn for them. Woods of the atlas
/// have a hundredth of that, a meadow at the greatest abundance a tenth.
constexpr std::size_t most_sprouts = 600'000, most_drawn = 12'000'000;

/// Ring round a grown host, in radii of its crown, and its variation among hosts (of the logarithm).
constexpr double ring_per_crown = 0.7, ring_variation = 0.25;

/// A second ring, of bodies nearer to the host.
constexpr double inner_ring = 0.27;

std::int32_t units(double value) {
    return static_cast<std::int32_t>(std::floor(value * units_of_metre + 0.5));
}

double distance(WorldPoint a, WorldPoint b) {
    const double dx = metres(a.x) - metres(b.x), dy = metres(a.y) - metres(b.y);
    return std::sqrt(dx * dx + dy * dy);
}

/// The arcs that a ring of fruit bodies is broken into: of equal length, at uneven distances.
class Arcs {
  public:
    Arcs(const RingHabit& habit, CellRandom random)
        : count_(static_cast<std::size_t>(std::clamp(habit.arcs, 1, 16))),
          length_(2.0 * pi * habit.covered / static_cast<double>(count_)) {
        double sum = 0.0;
        const double phase = random.uniform();
        std::array<double, 16> gaps{};
        for (std::size_t i = 0; i < count_; ++i) {
            const double draw = random.uniform();
            gaps[i] = 0.05 + draw * draw;
            sum += gaps[i];
        }
        double angle = 2.0 * pi * phase;
        for (std::size_t i = 0; i < count_; ++i) {
            begin_[i] = angle;
            angle += length_ + gaps[i] / sum * 2.0 * pi * (1.0 - habit.covered);
        }
    }
    /// Returns the angle of a share of all arcs, 0 <= share < 1.
    [[nodiscard]] double angle(double share) const {
        const double place = share * static_cast<double>(count_);
        const auto arc = std::min(static_cast<std::size_t>(place), count_ - 1);
        return begin_[arc] + (place - static_cast<double>(arc)) * length_;
    }

  private:
    std::size_t count_;
    double length_;
    std::array<double, 16> begin_{};
};

/// A body that may grow, and from which abundance on it does.
struct Sprout {
    FruitBody body;
    double appears = 0.0;
};

/// Where a cluster is, and how bodies about it are placed.
struct Cluster {
    double appears = 0.0;
    WorldTime flush = 0;
    WorldPoint at;
};

/// The fruit bodies of one rectangle.
class Season {
  public:
    Season(const Fungi& fungi, const RegionYear& input, const SeasonConditions& conditions,
           double abundance)
        : fungi_(fungi),
          input_(input),
          conditions_(conditions),
          abundance_(abundance),
          begin_(time_of(input.year)),
          end_(time_of(input.year + 1)),
          spacing_(spacing_of(fungi.species)) {
        for (std::size_t i = 0; i <= gate_steps; ++i)
            gates_.push_back(moisture_gate(static_cast<double>(i) / gate_steps));
        for (const StandTree& tree : input.around.trees)
            if (tree.lives_at(begin_) && years_between(tree.born, end_) >= age_of_host &&
                is_near(tree.at, farthest_host))
                trees_.push_back({&tree, crown_radius(height_at(tree, begin_))});
        // By x, so that those near a mycelium are found quickly.
        std::ranges::sort(
            trees_, {}, [](const Host& host) { return std::pair(host.tree->at.x, host.tree->id); });
        of_species_.resize(fungi.species.size());
        for (const Genet& genet : input.genets)
            if (genet.species < of_species_.size() && genet.born < end_ && genet.died > begin_)
                of_species_[genet.species].push_back(&genet);
        wood_.reserve(input.around.wood.size());
        for (const DeadWood& wood : input.around.wood) wood_.push_back(&wood);
        std::ranges::sort(wood_, {}, [](const DeadWood* wood) { return wood->id; });
    }

    std::vector<FruitBody> bodies() {
        for (std::size_t i = 0; i < fungi_.species.size(); ++i) {
            index_ = i;
            species_ = &fungi_.species[i];
            tufts_ = AtLeastOne(species_->ecology.fruit.clusters);
            bodies_of_tuft_ = AtLeastOne(species_->ecology.fruit.tufts);
            for (Host& host : trees_) host.ring = -1.0;
            gather_genets();
            for (const Genet* genet : genets_)
                if (species_->ecology.guild != Guild::wood)
                    fruit_on_ground(*genet);
                else if (species_->ecology.body.perennial)
                    add_brackets(*genet);
                else
                    fruit_on_wood(*genet);
        }
        std::vector<FruitBody> out = spaced(sprouts_);
        std::erase_if(out, [&](const FruitBody& body) { return !input_.region.contains(body.at); });
        out.insert(out.end(), brackets_.begin(), brackets_.end());
        std::erase_if(out, [&](const FruitBody& body) { return !has_share(body); });
        std::ranges::sort(out, {}, &FruitBody::id);
        return out;
    }

  private:
    struct Host {
        const StandTree* tree;
        double crown;
        double ring = -1.0;  ///< of the species; negative if not yet computed
    };
    static constexpr std::size_t gate_steps = 1024;

    /// Returns whether a place is in the rectangle or at most so many metres from it in each direction.
    [[nodiscard]] bool is_near(WorldPoint place, double most) const {
        return input_.region.grown(most).contains(place);
    }

    /// Returns whether a body is among the share of its species that its place may have: the highest 24 bits of its id are
    /// the draw. Others have taken its space as if it was there, so that bodies of a share are among those of all.
    [[nodiscard]] bool has_share(const FruitBody& body) const {
        constexpr double all = 1U << 24;
        const double share = fungi_.habitat.share(body.species, body.at);
        return static_cast<double>(body.id >> 40) < share * all;
    }

    /// Counts bodies that are drawn.
    void count_drawn(int number, std::size_t placed) {
        drawn_ += static_cast<std::size_t>(number);
        if (drawn_ > most_drawn || placed > most_sprouts)
            throw Impossible("/world",
                             "more than " + std::to_string(most_sprouts) +
                                 " fruit bodies of a year would grow within a block of 64 m; lower "
                                 "fungi.abundance, or fruit.density of the ecology of a species");
    }

    /// Collects the mycelia of the species that may have bodies in the rectangle or own places there, and the days on
    /// which the weather allows them to fruit.
    void gather_genets() {
        genets_.clear();
        const Ecology& ecology = species_->ecology;
        scatter_ = scatter_of(ecology);
        const Region wide = input_.region.grown(mycelia_within(ecology, spacing_));
        for (const Genet* genet : of_species_[index_])
            if (ecology.guild == Guild::wood || wide.contains(genet->centre))
                genets_.push_back(genet);
        good_days_ = good_days_of(conditions_, index_);
    }

    /// Returns the days, 0 to 364, on which a mycelium begins to fruit.
    std::vector<int> flushes_of(const Genet& genet, const Site& site) const {
        return flush_days(fungi_.seed, input_.year, genet, good_days_, [&](const GoodDay& good) {
            const double wetness = fungi_.habitat.wetness_on(site, good.soil_water);
            return gates_[static_cast<std::size_t>(std::clamp(wetness, 0.0, 1.0) *
                                                   static_cast<double>(gate_steps))];
        });
    }

    /// Calls a function for each cluster that appears at the abundance: with its number and from which abundance on it
    /// is there.
    template <typename Place>
    void for_clusters(double bodies, std::uint64_t key, std::uint32_t flush, const Place& place) {
        sporeprint::for_clusters(fungi_.seed, species_->ecology.fruit, bodies, abundance_, key,
                                 flush, place);
    }

    [[nodiscard]] std::uint32_t flush_number(std::size_t flush) const {
        return sporeprint::flush_number(input_.year, flush);
    }

    /// Sets the times of a body that belongs to a flush.
    void set_times(FruitBody& body, WorldTime flush, CellRandom& random) const {
        sporeprint::set_times(body, species_->ecology.body, flush, end_, random);
    }

    /// Collects the mycelia of the species that a mycelium may meet within so many metres of its margin.
    void gather_rivals(const Genet& genet, double margin) {
        rivals_.clear();
        const double radius = radius_at(genet, end_) + margin;
        for (const Genet* other : genets_)
            if (other != &genet &&
                distance(other->centre, genet.centre) <= radius + radius_at(*other, end_))
                rivals_.push_back(other);
    }

    /// Returns whether no other mycelium has a place that one reaches at a moment or later.
    [[nodiscard]] bool is_free(const Genet& genet, WorldPoint place, WorldTime time) const {
        if (rivals_.empty()) return true;
        const double now = static_cast<double>(time) / ticks_of_year;
        const double mine = arrival(genet, distance(genet.centre, place));
        return std::ranges::none_of(rivals_, [&](const Genet* other) {
            if (!other->lives_at(time)) return false;
            const double theirs = arrival(*other, distance(other->centre, place));
            return theirs <= now && (theirs < mine || (theirs == mine && other->id < genet.id));
        });
    }

    void fruit_on_ground(const Genet& genet) {
        const Ecology& ecology = species_->ecology;
        if (!is_near(genet.centre,
                     genet.reach + scatter_ + spacing_ + widest_bell * ecology.ring.spread))
            return;
        const Site site = fungi_.habitat.site_at(genet.centre, begin_);
        const double suits = suitability(ecology, site);
        if (!(suits > 0.0)) return;
        const std::vector<int> days = flushes_of(genet, site);
        if (days.empty()) return;
        gather_rivals(genet, scatter_ + widest_bell * ecology.ring.spread);
        for (std::size_t i = 0; i < days.size(); ++i) {
            const WorldTime flush = time_of(input_.year, days[i] + 1);
            if (ecology.guild == Guild::ectomycorrhizal && !ecology.ring.pioneer)
                fruit_round_hosts(genet, flush, flush_number(i), suits);
            else
                fruit_on_own_ring(genet, flush, flush_number(i), suits);
        }
    }

    /// Places bodies on the ring of a mycelium: of pioneers about its margin, otherwise in the band behind that.
    void fruit_on_own_ring(const Genet& genet, WorldTime flush, std::uint32_t number,
                           double suits) {
        const Ecology& ecology = species_->ecology;
        const RingHabit& ring = ecology.ring;
        const double radius = radius_at(genet, flush);
        if (!(radius > 0.0)) return;
        const bool is_pioneer = ecology.guild == Guild::ectomycorrhizal;
        const double breadth = std::min(ring.spread, radius);
        const double length = 2.0 * pi * radius;
        const double size =
            ecology.guild == Guild::litter ? (length - pi * breadth) * breadth : length;
        const Arcs arcs(
            ring, CellRandom(fungi_.seed, purposes::mycelium_arcs, species_->stream, genet.id));
        for_clusters(
            ecology.fruit.density * size * suits, genet.id, number,
            [&](double appears, CellRandom random) {
                const double share = random.uniform(), across = random.uniform(),
                             which = random.uniform(), spread = random.bell();
                const double angle = arcs.angle(share);
                double away = radius - breadth * across;
                if (is_pioneer)
                    away = (which < ring.inner ? inner_ring : 1.0) * radius +
                           ring.spread * spread * (which < ring.inner ? inner_ring : 1.0);
                add_cluster(genet, {appears, flush, at(genet.centre, away, angle)}, random);
            });
    }

    /// Places bodies round the hosts that a mycelium has reached.
    void fruit_round_hosts(const Genet& genet, WorldTime flush, std::uint32_t number,
                           double suits) {
        const Ecology& ecology = species_->ecology;
        const RingHabit& ring = ecology.ring;
        const double radius = radius_at(genet, flush);
        constexpr double widest_ring = 7.5;  // 1.5 crowns of 5 m
        const std::int32_t window = units(radius + widest_ring + widest_bell * ring.spread);
        for (auto host =
                 std::ranges::lower_bound(trees_, genet.centre.x - window, {},
                                          [](const Host& other) { return other.tree->at.x; });
             host != trees_.end() && host->tree->at.x <= genet.centre.x + window; ++host) {
            const StandTree& tree = *host->tree;
            if (!species_->lives_with(tree.kind) ||
                distance(tree.at, genet.centre) >
                    radius + 1.5 * host->crown + widest_bell * ring.spread ||
                !tree.lives_at(flush) || years_between(tree.born, flush) < age_of_host)
                continue;
            CellRandom of_tree(fungi_.seed, purposes::mycelium_arcs, species_->stream, tree.id);
            const double wide = of_tree.bell();
            if (host->ring < 0.0)
                host->ring = ring_per_crown * host->crown * exponential(ring_variation * wide);
            const double middle = host->ring;
            const double most = middle + widest_bell * ring.spread;
            if (distance(tree.at, genet.centre) > radius + most ||
                !is_near(tree.at, most + scatter_ + spacing_))
                continue;
            const Arcs arcs(ring, of_tree);
            for_clusters(
                ecology.fruit.density * 2.0 * pi * middle * suits, mixed(genet.id, tree.id, 0),
                number, [&](double appears, CellRandom random) {
                    const double share = random.uniform(), which = random.uniform(),
                                 spread = random.bell();
                    const double away =
                        (middle + ring.spread * spread) * (which < ring.inner ? inner_ring : 1.0);
                    const WorldPoint place = at(tree.at, away, arcs.angle(share));
                    if (distance(place, genet.centre) <= radius &&
                        is_near(place, scatter_ + spacing_) && is_free(genet, place, flush))
                        add_cluster(genet, {appears, flush, place}, random);
                });
        }
    }

    /// Returns the place in a direction and distance.
    static WorldPoint at(WorldPoint centre, double away, double angle) {
        const auto [sine, cosine] = sine_cosine(angle);
        return {centre.x + units(away * cosine), centre.y + units(away * sine)};
    }

    /// Adds the bodies of a cluster on the ground.
    void add_cluster(const Genet& genet, const Cluster& cluster, CellRandom& random) {
        if (!is_near(cluster.at, scatter_ + spacing_)) return;
        const FruitHabit& fruit = species_->ecology.fruit;
        const double draw = random.uniform();
        const int tufts = tufts_(draw);
        for (int tuft = 0; tuft < tufts; ++tuft) {
            const double east = random.bell(), north = random.bell(), many = random.uniform();
            const WorldPoint middle{cluster.at.x + units(fruit.cluster_spread * east),
                                    cluster.at.y + units(fruit.cluster_spread * north)};
            const int number = bodies_of_tuft_(many);
            count_drawn(number, sprouts_.size());
            for (int i = 0; i < number; ++i) {
                const double x = random.bell(), y = random.bell();
                Sprout sprout;
                sprout.appears = cluster.appears;
                FruitBody& body = sprout.body;
                body.id = random.identifier();
                body.at = {middle.x + units(fruit.tuft_spread * x),
                           middle.y + units(fruit.tuft_spread * y)};
                body.species = static_cast<std::uint8_t>(index_);
                body.genet = genet.id;
                body.host = genet.host;
                set_times(body, cluster.flush, random);
                if (!is_near(body.at, spacing_)) continue;
                // Bodies of a cluster near the margin may stand before it, but not on another mycelium.
                if (is_free(genet, body.at, cluster.flush)) sprouts_.push_back(sprout);
            }
        }
    }

    [[nodiscard]] const DeadWood* trunk_of(const Genet& genet) const {
        const auto found = std::ranges::lower_bound(wood_, genet.host, {},
                                                    [](const DeadWood* wood) { return wood->id; });
        return found != wood_.end() && (*found)->id == genet.host ? *found : nullptr;
    }

    /// Returns how far from the foot of a trunk the centre of a mycelium on it is, metres.
    static double along(const DeadWood& wood, const Genet& genet) {
        return std::min(wood.length, distance(wood.at, genet.centre));
    }

    /// Returns whether bodies on the part of a trunk that a mycelium reaches may stand in the rectangle or near it.
    [[nodiscard]] bool is_trunk_near(const DeadWood& wood, const Genet& genet) const {
        const double margin = scatter_ + spacing_ + 2.0 * wood.radius;
        return (wood.fell > begin_ || species_->ecology.body.perennial) && is_near(wood.at, margin)
                   ? true
                   : is_near(genet.centre, std::min(genet.reach, wood.length) + margin);
    }

    /// The part of a trunk that a mycelium has reached, and where it fruits.
    struct Reached {
        double from = 0.0, to = 0.0, area = 0.0;
    };

    /// length  of what is left of the trunk, metres
    static Reached reached(const DeadWood& wood, const Genet& genet, WorldTime time,
                           double length) {
        const double middle = along(wood, genet), radius = radius_at(genet, time);
        Reached out{std::max(0.0, middle - radius), std::min(length, middle + radius)};
        if (out.from >= out.to) return {};
        const double girth =
            2.0 * pi * radius_at(wood, time) * taper_at(wood, 0.5 * (out.from + out.to));
        out.area = girth * (out.to - out.from);
        return out;
    }

    /// Returns whether a mycelium has a part of a trunk that it has reached.
    [[nodiscard]] bool owns(const Genet& genet, const DeadWood& wood, double place,
                            WorldTime time) const {
        const double mine = arrival(genet, std::abs(place - along(wood, genet)));
        for (const Genet* other : genets_) {
            if (other == &genet || other->host != wood.id || !other->lives_at(time)) continue;
            const double theirs = arrival(*other, std::abs(place - along(wood, *other)));
            if (theirs < mine || (theirs == mine && other->id < genet.id)) return false;
        }
        return true;
    }

    void fruit_on_wood(const Genet& genet) {
        const Ecology& ecology = species_->ecology;
        const DeadWood* wood = trunk_of(genet);
        if (wood == nullptr || !(wood->length > 0.0) || !is_trunk_near(*wood, genet)) return;
        const Site site = fungi_.habitat.site_at(genet.centre, begin_);
        const double suits = suitability(ecology, site);
        if (!(suits > 0.0)) return;
        const std::vector<int> days = flushes_of(genet, site);
        for (std::size_t i = 0; i < days.size(); ++i) {
            const WorldTime flush = time_of(input_.year, days[i] + 1);
            const Reached part = reached(*wood, genet, flush, length_at(*wood, flush));
            for_clusters(
                ecology.fruit.density * part.area * suits, genet.id, flush_number(i),
                [&](double appears, CellRandom random) {
                    const double share = random.uniform();
                    const double place = part.from + share * (part.to - part.from);
                    if (owns(genet, *wood, place, flush))
                        add_on_bark(genet, *wood, {appears, flush, {}}, place, random, sprouts_);
                });
        }
    }

    /// Adds the bodies of a cluster on a trunk.
    void add_on_bark(const Genet& genet, const DeadWood& wood, const Cluster& cluster, double place,
                     CellRandom& random, std::vector<Sprout>& out) {
        const FruitHabit& fruit = species_->ecology.fruit;
        const bool stands = wood.stands_at(cluster.flush);
        const double foot = radius_at(wood, cluster.flush), length = length_at(wood, cluster.flush);
        if (!is_near(stands ? wood.at : at(wood.at, place, wood.direction),
                     scatter_ + spacing_ + 2.0 * foot))
            return;
        const double draw = random.uniform(), turn = random.uniform(), side = random.bell();
        // Round the trunk: of a standing one all sides, of a lying one the angle from the top.
        const double middle = stands ? 2.0 * pi * turn : 0.65 * side;
        const int tufts = tufts_(draw);
        for (int tuft = 0; tuft < tufts; ++tuft) {
            const double away = random.bell(), round = random.bell(), many = random.uniform();
            const int number = bodies_of_tuft_(many);
            count_drawn(number, out.size() + brackets_.size());
            for (int i = 0; i < number; ++i) {
                const double x = random.bell(), y = random.bell();
                Sprout sprout;
                sprout.appears = cluster.appears;
                FruitBody& body = sprout.body;
                body.id = random.identifier();
                body.species = static_cast<std::uint8_t>(index_);
                body.genet = genet.id;
                body.host = genet.host;
                body.trunk = wood.id;
                set_times(body, cluster.flush, random);
                const double position = place + fruit.cluster_spread * away + fruit.tuft_spread * x;
                if (position < 0.0 || position > length) continue;
                body.gone = std::min(body.gone, stands ? wood.fell : wood.gone);
                if (position > length_at(wood, body.gone - 1))
                    body.gone = std::min(body.gone, when_shorter(wood, position));
                body.matured = std::min(body.matured, body.gone - 1);
                if (body.gone <= body.emerged + 1) continue;
                const double radius = foot * taper_at(wood, position);
                const double bend =
                    (fruit.cluster_spread * round + fruit.tuft_spread * y) / std::max(radius, 0.01);
                put_on_bark(body, wood, stands, position, radius,
                            stands ? middle + bend : std::clamp(middle + bend, -1.9, 1.9));
                if (is_near(body.at, spacing_)) out.push_back(sprout);
            }
        }
    }

    /// Sets the place of a body on a trunk.
    ///
    /// angle  of a standing trunk the direction of the body, of a lying one its angle from the top to the left
    static void put_on_bark(FruitBody& body, const DeadWood& wood, bool stands, double position,
                            double radius, double angle) {
        if (stands) {
            body.at = at(wood.at, radius, angle);
            body.height = position;
            body.facing = angle - 2.0 * pi * std::floor(angle / (2.0 * pi));
            body.pitch = 0.0;
            return;
        }
        const auto [sine, cosine] = sine_cosine(angle);
        const auto [north, east] = sine_cosine(wood.direction);
        body.at = {wood.at.x + units(position * east - radius * sine * north),
                   wood.at.y + units(position * north + radius * sine * east)};
        body.height = radius * (1.0 + cosine);
        const double left = wood.direction + (sine < 0.0 ? -0.5 : 0.5) * pi;
        body.facing = left - 2.0 * pi * std::floor(left / (2.0 * pi));
        body.pitch = 0.5 * pi - std::abs(angle);
    }

    /// Adds the perennial brackets of a mycelium: those of its whole life first, so that the year does not matter.
    void add_brackets(const Genet& genet) {
        const Ecology& ecology = species_->ecology;
        const DeadWood* wood = trunk_of(genet);
        if (wood == nullptr || !(wood->length > 0.0) || !is_trunk_near(*wood, genet)) return;
        const double suits = suitability(ecology, fungi_.habitat.site_at(genet.centre, genet.born));
        const Reached whole = reached(*wood, genet, genet.died - 1, length_at(*wood, genet.born));
        std::vector<Sprout> sprouts;
        for_clusters(
            ecology.fruit.density * whole.area * suits, genet.id, 0,
            [&](double appears, CellRandom random) {
                const double share = random.uniform(), when = random.uniform();
                const double place = whole.from + share * (whole.to - whole.from);
                const WorldTime time =
                    genet.born +
                    static_cast<WorldTime>(std::floor(when * (genet.died - genet.born)));
                if (std::abs(place - along(*wood, genet)) <= radius_at(genet, time))
                    add_bracket_cluster(genet, *wood, {appears, time, {}}, place, random, sprouts);
            });
        for (const FruitBody& body : spaced(sprouts))
            if (body.emerged < end_ && body.gone > begin_ && input_.region.contains(body.at))
                brackets_.push_back(body);
    }

    void add_bracket_cluster(const Genet& genet, const DeadWood& wood, const Cluster& cluster,
                             double place, CellRandom& random, std::vector<Sprout>& out) {
        std::vector<Sprout> sprouts;
        add_on_bark(genet, wood, cluster, place, random, sprouts);
        for (Sprout& sprout : sprouts) {
            FruitBody& body = sprout.body;
            body.gone = std::min(body.gone, genet.died);
            body.matured = std::min(body.matured, body.gone - 1);
            if (body.gone > body.emerged + 1) out.push_back(sprout);
        }
    }

    /// Returns the bodies of sprouts that no sprout of higher priority stands too near to.
    std::vector<FruitBody> spaced(const std::vector<Sprout>& sprouts) const {
        struct Key {
            std::int32_t x;
            std::uint32_t index;
        };
        std::vector<Key> order;
        order.reserve(sprouts.size());
        for (std::size_t i = 0; i < sprouts.size(); ++i)
            order.push_back({sprouts[i].body.at.x, static_cast<std::uint32_t>(i)});
        // Each pair is compared, in whichever order those of equal x are.
        std::ranges::sort(order, {}, &Key::x);
        std::vector<bool> yields(sprouts.size(), false);
        const auto widest_units = static_cast<std::int64_t>(std::ceil(spacing_ * units_of_metre));
        for (std::size_t i = 0; i < order.size(); ++i)
            for (std::size_t j = i + 1; j < order.size(); ++j) {
                if (std::int64_t{order[j].x} - order[i].x > widest_units) break;
                const Sprout &a = sprouts[order[i].index], &b = sprouts[order[j].index];
                if (!are_crowded(a.body, b.body)) continue;
                // Those that appear at a lower abundance have priority: a higher one removes none of them.
                const bool first =
                    a.appears != b.appears ? a.appears < b.appears : a.body.id < b.body.id;
                yields[order[first ? j : i].index] = true;
            }
        std::vector<FruitBody> out;
        out.reserve(sprouts.size());
        for (std::size_t i = 0; i < sprouts.size(); ++i)
            if (!yields[i]) out.push_back(sprouts[i].body);
        return out;
    }

    [[nodiscard]] bool are_crowded(const FruitBody& a, const FruitBody& b) const {
        const std::int64_t x = std::int64_t{b.at.x} - a.at.x, y = std::int64_t{b.at.y} - a.at.y;
        if (std::abs(y) > units(spacing_) || a.emerged >= b.gone || b.emerged >= a.gone)
            return false;
        const std::int64_t least =
            units(core_of(fungi_.species[a.species]) + core_of(fungi_.species[b.species]));
        const std::int64_t height = std::int64_t{units(b.height)} - units(a.height);
        return x * x + y * y + height * height < least * least;
    }

    const Fungi& fungi_;
    const RegionYear& input_;
    const SeasonConditions& conditions_;
    double abundance_;
    WorldTime begin_, end_;
    double spacing_, scatter_ = 0.0;
    std::vector<double> gates_;
    std::vector<Host> trees_;
    std::vector<const DeadWood*> wood_;
    std::size_t index_ = 0;
    const FungusSpecies* species_ = nullptr;
    std::vector<std::vector<const Genet*>> of_species_;
    std::vector<const Genet*> genets_, rivals_;
    std::vector<GoodDay> good_days_;
    AtLeastOne tufts_, bodies_of_tuft_;
    std::vector<Sprout> sprouts_;
    std::vector<FruitBody> brackets_;
    std::size_t drawn_ = 0;
};

}  // namespace

std::vector<FruitBody> season_of(const Fungi& fungi, const RegionYear& input,
                                 const SeasonConditions& conditions, double abundance) {
    return Season(fungi, input, conditions, abundance).bodies();
}

double age_at(const FruitBody& body, WorldTime time) {
    if (time <= body.emerged) return 0.0;
    if (time >= body.gone) return 1.0;
    constexpr double mature = 0.6, steepness = 5.89;
    if (time >= body.matured)
        return mature + (1.0 - mature) * (time - body.matured) / (body.gone - body.matured);
    const double share = static_cast<double>(time - body.emerged) / (body.matured - body.emerged);
    const auto logistic = [](double x) { return 1.0 / (1.0 + exponential(-x)); };
    return mature * logistic(steepness * (share - 0.5)) / logistic(0.5 * steepness);
}

std::vector<std::array<std::uint32_t, days_of_year>> daily_counts(std::span<const FruitBody> bodies,
                                                                  std::size_t species, int year) {
    std::vector<std::array<std::uint32_t, days_of_year>> counts(species);
    const WorldTime begin = time_of(year) + ticks_of_day / 2;
    for (const FruitBody& body : bodies) {
        if (body.species >= species) continue;
        for (int day = std::max(0, (body.emerged - begin) / ticks_of_day); day < days_of_year;
             ++day) {
            const WorldTime noon = begin + day * ticks_of_day;
            if (noon >= body.gone) break;
            if (body.stands_at(noon)) ++counts[body.species][static_cast<std::size_t>(day)];
        }
    }
    return counts;
}

}  // namespace sporeprint
