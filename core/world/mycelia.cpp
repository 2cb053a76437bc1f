#include "core/world/mycelia.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/math/elementary.h"
#include "core/math/purposes.h"
#include "core/world/cell_random.h"
#include "core/world/influence.h"
#include "core/world/tree_growth.h"

namespace sporeprint {

namespace {

constexpr int rounds = 3;

/// Cells of 8 m in which mycelia begin.
constexpr std::int32_t cell_metres = 8, cell_bits = 19;

/// Lives last from half of the mean to one and a half of it.
constexpr double shortest_life = 0.5, longest_life = 1.5;

/// Roots of trees reach this many crown radii; at most 10 m, as crowns are at most 5 m wide.
constexpr double roots_per_crown = 2.0, longest_roots = 10.0;

/// Litter lies within this distance of a trunk and is gone so many years after the death of the tree [MuellerUsing2009].
constexpr double litter_distance = 10.0, litter_years = 4.0;

/// On wood mycelia are a hundred times as frequent as on the ground, and a square metre is one of bark.
constexpr double wood_factor = 100.0;

/// The spores that lie in the soil reach so many square metres and years of a seedling: pioneers are nearly always
/// among its first fungi. Their mycelia begin within so many years of it.
constexpr double pioneer_chances = 10000.0, pioneer_delay = 0.25;

constexpr std::uint32_t all_of_24_bits = 1U << 24;

/// Returns years as ticks.
WorldTime ticks(double years) {
    return static_cast<WorldTime>(std::floor(years * ticks_of_year + 0.5));
}

/// Returns the square of a distance in units.
std::int64_t distance_squared(WorldPoint a, WorldPoint b) {
    const std::int64_t dx = std::int64_t{a.x} - b.x, dy = std::int64_t{a.y} - b.y;
    return dx * dx + dy * dy;
}

/// Returns whether two places are at most so many metres apart.
bool within(WorldPoint a, WorldPoint b, double most) {
    const auto units = static_cast<std::int64_t>(std::floor(most * units_of_metre));
    return distance_squared(a, b) <= units * units;
}

/// Returns a chance as 24 bits, which draws are compared with.
std::uint32_t chance(double probability) {
    return static_cast<std::uint32_t>(
        std::floor(std::clamp(probability, 0.0, 1.0) * all_of_24_bits + 0.5));
}

WorldTime life_of(const Ecology& ecology, double draw) {
    return std::max(
        ticks(ecology.genet.life * (shortest_life + (longest_life - shortest_life) * draw)),
        WorldTime{1});
}

/// Returns how far the roots of a tree reach at a moment, metres.
double root_reach(const StandTree& tree, WorldTime time) {
    return roots_per_crown * crown_radius(height_at(tree, time));
}

/// Trees in cells of 10 m, so that those near a place are in nine of them.
class TreeGrid {
  public:
    /// region  that of all centres of mycelia
    TreeGrid(std::span<const StandTree> trees, const Region& region, std::uint32_t kinds)
        : west_(std::int64_t{region.west} - margin),
          south_(std::int64_t{region.south} - margin),
          columns_((std::int64_t{region.east} + margin - west_) / size + 1),
          rows_((std::int64_t{region.north} + margin - south_) / size + 1),
          begin_(static_cast<std::size_t>(columns_ * rows_) + 1) {
        std::vector<std::pair<std::size_t, const StandTree*>> found;
        found.reserve(trees.size());
        for (const StandTree& tree : trees) {
            if (tree.kind >= 32 || (kinds >> tree.kind & 1U) == 0) continue;
            // Most trees die young and are hosts of pioneers only.
            if (years_between(tree.born, tree.died) < age_of_host) continue;
            const std::int64_t column = cell(tree.at.x - west_), row = cell(tree.at.y - south_);
            if (column < 0 || row < 0 || column >= columns_ || row >= rows_) continue;
            found.emplace_back(static_cast<std::size_t>(row * columns_ + column), &tree);
        }
        for (const auto& [place, tree] : found) ++begin_[place + 1];
        for (std::size_t i = 1; i < begin_.size(); ++i) begin_[i] += begin_[i - 1];
        trees_.resize(found.size());
        std::vector<std::uint32_t> next = begin_;
        for (const auto& [place, tree] : found) trees_[next[place]++] = tree;
    }

    /// Returns the nearest tree that satisfies a condition, of equally near ones that with the lowest id; null if there
    /// is none within 10 m.
    template <typename Condition>
    const StandTree* nearest(WorldPoint place, const Condition& condition) const {
        const std::int64_t column = cell(place.x - west_), row = cell(place.y - south_);
        const StandTree* best = nullptr;
        constexpr std::int64_t most = 10 * std::int64_t{units_of_metre};
        std::int64_t least = most * most + 1;
        for (std::int64_t y = std::max<std::int64_t>(row - 1, 0);
             y <= std::min<std::int64_t>(row + 1, rows_ - 1); ++y)
            for (std::int64_t x = std::max<std::int64_t>(column - 1, 0);
                 x <= std::min<std::int64_t>(column + 1, columns_ - 1); ++x) {
                const auto at = static_cast<std::size_t>(y * columns_ + x);
                for (std::size_t i = begin_[at]; i < begin_[at + 1]; ++i) {
                    const StandTree& tree = *trees_[i];
                    const std::int64_t distance = distance_squared(tree.at, place);
                    const bool is_nearer =
                        distance < least ||
                        (distance == least && best != nullptr && tree.id < best->id);
                    if (!is_nearer || !condition(tree)) continue;
                    best = &tree;
                    least = distance;
                }
            }
        return best;
    }

  private:
    static constexpr std::int64_t size = 10 * units_of_metre;
    static constexpr std::int64_t cell(std::int64_t units) {
        return units >= 0 ? units / size : -1;
    }
    static constexpr std::int64_t margin = 38 * units_of_metre;  // 24 m of mycelia, 10 m of roots

    std::int64_t west_, south_, columns_, rows_;
    std::vector<std::uint32_t> begin_;
    std::vector<const StandTree*> trees_;
};

bool hosts_at(const StandTree& tree, const FungusSpecies& species, WorldPoint place,
              WorldTime time) {
    return tree.lives_at(time) && species.lives_with(tree.kind) &&
           years_between(tree.born, time) >= age_of_host && within(tree.at, place, longest_roots) &&
           within(tree.at, place, root_reach(tree, time));
}

bool drops_litter_at(const StandTree& tree, const FungusSpecies& species, WorldPoint place,
                     WorldTime time) {
    return tree.lives_at(time) && species.lives_with(tree.kind) &&
           years_between(tree.born, time) >= age_of_host && within(tree.at, place, litter_distance);
}

/// What may become a mycelium.
struct Candidate {
    Genet genet;
    std::uint32_t draw = 0;   ///< 24 bits, compared with how suitable the place is
    std::int32_t cell = 0;    ///< in which its centre lies, an index of the grid
    WorldTime longest = 0;    ///< when it dies if what it lives on lasts
    std::int8_t spores = -1;  ///< whether spores have arrived: -1 unknown, 0, 1
    std::int8_t found = -1;   ///< whether it finds what it lives on: -1 unknown, 0, 1
    std::array<std::int8_t, rounds + 1> lives{-1, -1, -1, -1};  ///< after each round: -1 unknown
};

/// The mycelia of one species on the ground of a rectangle.
class GroundMycelia {
  public:
    GroundMycelia(const Fungi& fungi, std::uint8_t species, const Region& region, int epoch,
                  const Surroundings& around)
        : fungi_(fungi),
          index_(species),
          species_(fungi.species[species]),
          region_(region),
          around_(around),
          begin_(time_of(epoch * epoch_years)),
          end_(time_of((epoch + 1) * epoch_years)),
          longest_(ticks(species_.ecology.genet.life * longest_life)) {
        const Region wide =
            region.grown(rounds * std::max(species_.ecology.genet.reach, founding()));
        west_ = wide.west >> cell_bits;
        south_ = wide.south >> cell_bits;
        columns_ = ((wide.east - 1) >> cell_bits) - west_ + 1;
        rows_ = ((wide.north - 1) >> cell_bits) - south_ + 1;
    }

    void append_to(std::vector<Genet>& genets, const TreeGrid* grid) {
        grid_ = grid;
        if (is_pioneer())
            draw_with_hosts();
        else
            draw_in_cells();
        find_cells();
        for (Candidate& candidate : candidates_) {
            const Genet& genet = candidate.genet;
            if (!region_.contains(genet.centre) || genet.born >= end_ || genet.died <= begin_ ||
                !finds(candidate) || genet.died <= begin_)
                continue;
            if (lives(candidate, rounds)) genets.push_back(genet);
        }
    }

  private:
    [[nodiscard]] bool is_pioneer() const {
        return species_.ecology.guild == Guild::ectomycorrhizal && species_.ecology.ring.pioneer;
    }
    [[nodiscard]] double founding() const { return is_pioneer() ? 0.0 : founding_distance; }

    [[nodiscard]] Genet genet_at(WorldPoint centre, WorldTime born) const {
        Genet genet;
        genet.centre = centre;
        genet.born = born;
        genet.species = index_;
        genet.speed = species_.ecology.genet.speed;
        genet.reach = species_.ecology.genet.reach;
        return genet;
    }

    /// Draws births in the cells of the rectangle and of its surroundings, for whole epochs at once.
    void draw_in_cells() {
        const std::int64_t earliest = std::int64_t{begin_} - std::int64_t{rounds + 1} * longest_;
        constexpr std::int64_t epoch_ticks = std::int64_t{epoch_years} * ticks_of_year;
        const auto last = static_cast<std::int32_t>(begin_ / epoch_ticks);
        auto first = static_cast<std::int32_t>(earliest / epoch_ticks);
        if (std::int64_t{first} * epoch_ticks > earliest) --first;
        const double mean = species_.ecology.genet.rate * cell_metres * cell_metres * epoch_years;
        if (!(mean > 0.0)) return;
        none_ = exponential(-mean);
        candidates_.reserve(
            static_cast<std::size_t>(mean * columns_ * rows_ * (last - first + 1) * 1.3 + 16.0));
        for (std::int32_t row = 0; row < rows_; ++row)
            for (std::int32_t column = 0; column < columns_; ++column)
                for (std::int32_t epoch = first; epoch <= last; ++epoch)
                    draw_in_cell({west_ + column, south_ + row}, epoch, mean,
                                 row * columns_ + column);
    }

    void draw_in_cell(WorldPoint cell, std::int32_t epoch, double mean, std::int32_t place) {
        const std::uint32_t object =
            species_.stream + 0x9E3779B9U * static_cast<std::uint32_t>(epoch);
        CellRandom random(fungi_.seed, purposes::mycelium_births, object,
                          static_cast<std::uint32_t>(cell.x), static_cast<std::uint32_t>(cell.y));
        const double draw = random.uniform();
        const int number = poisson(mean, none_, draw, 200);
        for (int i = 0; i < number; ++i) {
            const std::uint32_t x = random.bits() >> (32 - cell_bits),
                                y = random.bits() >> (32 - cell_bits);
            const double when = random.uniform(), life = random.uniform();
            Candidate candidate;
            candidate.draw = random.bits24();
            candidate.genet = genet_at({cell.x * (1 << cell_bits) + static_cast<std::int32_t>(x),
                                        cell.y * (1 << cell_bits) + static_cast<std::int32_t>(y)},
                                       time_of(epoch * epoch_years) + ticks(when * epoch_years));
            candidate.genet.id = random.identifier();
            candidate.genet.died = candidate.genet.born + life_of(species_.ecology, life);
            candidate.cell = place;
            candidate.longest = candidate.genet.died;
            candidates_.push_back(candidate);
        }
    }

    /// Draws the mycelia of pioneers, which begin with their hosts.
    void draw_with_hosts() {
        const std::uint32_t likely =
            chance(1.0 - exponential(-species_.ecology.genet.rate * pioneer_chances));
        for (const StandTree& tree : around_.trees) {
            if (!species_.lives_with(tree.kind)) continue;
            const std::int32_t column = (tree.at.x >> cell_bits) - west_,
                               row = (tree.at.y >> cell_bits) - south_;
            if (column < 0 || row < 0 || column >= columns_ || row >= rows_) continue;
            if (tree.born >= end_) continue;
            CellRandom random(fungi_.seed, purposes::mycelium_births, species_.stream, tree.id);
            const bool begins = random.bits24() < likely;
            const double when = random.uniform(), life = random.uniform();
            Candidate candidate;
            candidate.draw = random.bits24();
            candidate.genet = genet_at(tree.at, tree.born + ticks(when * pioneer_delay));
            candidate.genet.id = random.identifier();
            candidate.genet.host = tree.id;
            candidate.genet.died =
                std::min(tree.died, candidate.genet.born + life_of(species_.ecology, life));
            candidate.longest = candidate.genet.died;
            candidate.cell = row * columns_ + column;
            if (begins && candidate.genet.born < candidate.genet.died)
                candidates_.push_back(candidate);
        }
    }

    /// Notes which candidates lie in which cell. They are sorted by cell already, but those of trees.
    void find_cells() {
        if (is_pioneer()) std::ranges::sort(candidates_, {}, &Candidate::cell);
        first_.assign(static_cast<std::size_t>(columns_ * rows_) + 1, 0);
        for (const Candidate& candidate : candidates_)
            ++first_[static_cast<std::size_t>(candidate.cell) + 1];
        for (std::size_t i = 1; i < first_.size(); ++i) first_[i] += first_[i - 1];
    }

    /// Returns whether a candidate finds what it lives on, in a place where it can live. Sets its host and how long that
    /// lasts.
    bool finds(Candidate& candidate) const {
        if (candidate.found < 0) candidate.found = looks_for_substrate(candidate) ? 1 : 0;
        return candidate.found == 1;
    }

    bool looks_for_substrate(Candidate& candidate) const {
        Genet& genet = candidate.genet;
        if (!has_spores(candidate)) return false;
        if (!is_pioneer()) {
            const auto hosts = [&](const StandTree& tree) {
                return hosts_at(tree, species_, genet.centre, genet.born);
            };
            const auto drops = [&](const StandTree& tree) {
                return drops_litter_at(tree, species_, genet.centre, genet.born);
            };
            if (species_.ecology.guild == Guild::ectomycorrhizal) {
                const StandTree* host = grid_->nearest(genet.centre, hosts);
                if (host == nullptr) return false;
                genet.host = host->id;
                genet.died = std::min(genet.died, host->died);
            } else if (species_.ecology.guild == Guild::litter) {
                const StandTree* tree = grid_->nearest(genet.centre, drops);
                if (tree == nullptr) return false;
                genet.died = std::min(genet.died, tree->died + ticks(litter_years));
            }
        }
        const Site site = fungi_.habitat.site_at(genet.centre, genet.born);
        const double established = fungi_.habitat.establishment(index_, genet.centre, genet.born);
        const double share = fungi_.habitat.share(index_, genet.centre);
        return candidate.draw < chance(established * share * suitability(species_.ecology, site));
    }

    /// Returns whether a candidate lives after so many rounds: in each of them it dies if it began where an older one
    /// was that lives after the round before. Rounds bound the exact result from above and from below in turn.
    bool lives(Candidate& candidate, int round) {
        // Before the first round all live that spores allow, also those that find nothing to live on: so older trees
        // need not be known.
        if (round == 0) return has_spores(candidate);
        std::int8_t& result = candidate.lives[static_cast<std::size_t>(round)];
        if (result < 0) result = finds(candidate) && !is_covered(candidate, round - 1) ? 1 : 0;
        return result == 1;
    }

    [[nodiscard]] bool has_spores(Candidate& candidate) const {
        if (candidate.spores < 0) {
            const Genet& genet = candidate.genet;
            const double established =
                fungi_.habitat.establishment(index_, genet.centre, genet.born);
            candidate.spores = candidate.draw < chance(established) ? 1 : 0;
        }
        return candidate.spores == 1;
    }

    bool is_covered(const Candidate& candidate, int round) {
        const Genet& young = candidate.genet;
        const double reach = std::max(species_.ecology.genet.reach, founding());
        const auto cells = static_cast<std::int32_t>(std::ceil(reach / cell_metres));
        const std::int32_t column = candidate.cell % columns_, row = candidate.cell / columns_;
        const std::int32_t west = std::max(column - cells, 0),
                           east = std::min(column + cells, columns_ - 1);
        for (std::int32_t y = std::max(row - cells, 0); y <= std::min(row + cells, rows_ - 1);
             ++y) {
            const auto from = first_[static_cast<std::size_t>(y * columns_ + west)],
                       to = first_[static_cast<std::size_t>(y * columns_ + east) + 1];
            for (std::size_t i = from; i < to; ++i) {
                Candidate& other = candidates_[i];
                const Genet& old = other.genet;
                if (old.born > young.born || (old.born == young.born && old.id >= young.id))
                    continue;
                if (other.longest <= young.born) continue;
                if (!within(old.centre, young.centre,
                            std::max(founding(), radius_at(old, young.born))))
                    continue;
                // What a mycelium lives on, which may shorten its life, counts after the first round.
                if (lives(other, round) && (round == 0 || old.died > young.born)) return true;
            }
        }
        return false;
    }

    const Fungi& fungi_;
    std::uint8_t index_;
    const FungusSpecies& species_;
    Region region_;
    const Surroundings& around_;
    WorldTime begin_, end_, longest_;
    std::int32_t west_, south_, columns_, rows_;
    double none_ = 1.0;
    const TreeGrid* grid_ = nullptr;
    std::vector<Candidate> candidates_;
    std::vector<std::size_t> first_;
};

/// Returns when a dead trunk has lost a share of its mass.
WorldTime when_lost(const DeadWood& wood, double share) {
    constexpr double longest = 1000.0;  // years
    if (share >= 1.0 || wood.decay <= 0.0) return wood.died + ticks(longest);
    return wood.died + ticks(std::min(longest, -logarithm(1.0 - share) / wood.decay));
}

/// Returns whether a trunk has decayed as far as a species needs it, and lies or stands as it does.
bool decays_for(const DeadWood& wood, const Ecology& ecology, WorldTime time) {
    return (wood.lies_at(time) || (ecology.on_standing_wood && wood.stands_at(time))) &&
           when_lost(wood, ecology.decay.from) <= time && time < when_lost(wood, ecology.decay.to);
}

/// Returns whether a place is on a trunk or within 0.3 m of it.
bool is_beside(const DeadWood& wood, WorldPoint place, WorldTime time) {
    constexpr double beside = 0.3;
    const double x = metres(place.x) - metres(wood.at.x), y = metres(place.y) - metres(wood.at.y);
    const auto [sine, cosine] = sine_cosine(wood.direction);
    const double along =
        wood.stands_at(time) ? 0.0 : std::clamp(x * cosine + y * sine, 0.0, length_at(wood, time));
    const double dx = x - along * cosine, dy = y - along * sine;
    const double most = radius_at(wood, time) + beside;
    return dx * dx + dy * dy <= most * most;
}

/// Appends the mycelia of a species on one dead trunk that begin before a moment. They are drawn in the order of their births, so that those
/// before are known.
void append_of_trunk(const Fungi& fungi, std::uint8_t index, const DeadWood& wood, WorldTime before,
                     std::vector<Genet>& genets) {
    const FungusSpecies& species = fungi.species[index];
    const Ecology& ecology = species.ecology;
    const double bark = pi * 1.2 * wood.radius * wood.length;
    const double rate = ecology.genet.rate * wood_factor * bark;
    const WorldTime begin = std::max(
        {when_lost(wood, ecology.decay.from), ecology.on_standing_wood ? wood.died : wood.fell});
    const WorldTime end = std::min(wood.gone, when_lost(wood, ecology.decay.to));
    if (!(rate > 0.0) || begin >= std::min(end, before)) return;
    const auto [sine, cosine] = sine_cosine(wood.direction);
    CellRandom random(fungi.seed, purposes::mycelium_births, species.stream, wood.id);
    struct Placed {
        Genet genet;
        double along = 0.0;
    };
    std::vector<Placed> living;
    constexpr int most = 400;
    double years = 0.0;
    for (int i = 0; i < most; ++i) {
        const double wait = random.uniform(), where = random.uniform(), life = random.uniform();
        const std::uint32_t draw = random.bits24();
        const std::uint64_t id = random.identifier();
        years += -logarithm(1.0 - wait) / rate;
        if (years >= years_between(begin, std::min(end, before))) break;
        Placed placed;
        // As much bark is nearer to the foot as is there: the girth sinks to a fifth at the top.
        placed.along = wood.length * (1.0 - std::sqrt(1.0 - where * 0.96)) / 0.8;
        Genet& genet = placed.genet;
        genet.id = id;
        genet.born = begin + ticks(years);
        genet.died = std::min(end, genet.born + life_of(ecology, life));
        genet.species = index;
        genet.speed = ecology.genet.speed;
        genet.reach = ecology.genet.reach;
        genet.host = wood.id;
        genet.centre = {wood.at.x + static_cast<std::int32_t>(
                                        std::floor(placed.along * cosine * units_of_metre + 0.5)),
                        wood.at.y + static_cast<std::int32_t>(
                                        std::floor(placed.along * sine * units_of_metre + 0.5))};
        const double established = fungi.habitat.establishment(index, genet.centre, genet.born);
        if (draw >= chance(established)) continue;
        if (std::ranges::any_of(living, [&](const Placed& old) {
                return old.genet.died > genet.born &&
                       std::abs(old.along - placed.along) <= radius_at(old.genet, genet.born);
            }))
            continue;
        const Site site = fungi.habitat.site_at(genet.centre, genet.born);
        const double share = fungi.habitat.share(index, genet.centre);
        if (draw >= chance(established * share * suitability(ecology, site))) continue;
        if (genet.died > genet.born) living.push_back(placed);
    }
    for (const Placed& placed : living) genets.push_back(placed.genet);
}

/// Returns whether the line on which a trunk lies, or will lie, comes near a rectangle.
bool may_lie_in(const DeadWood& wood, const Region& region) {
    const auto [sine, cosine] = sine_cosine(wood.direction);
    constexpr double rounding = 0.01;
    const double x = metres(wood.at.x), y = metres(wood.at.y);
    const double far_x = x + wood.length * cosine, far_y = y + wood.length * sine;
    return std::max(x, far_x) >= metres(region.west) - rounding &&
           std::max(y, far_y) >= metres(region.south) - rounding &&
           std::min(x, far_x) <= metres(region.east) + rounding &&
           std::min(y, far_y) <= metres(region.north) + rounding;
}

/// Appends the mycelia of a species on trunks that live at some time of an epoch.
///
/// region  that the trunks come near
void append_of_wood(const Fungi& fungi, std::uint8_t index, const Region& region, int epoch,
                    std::span<const DeadWood> trunks, std::vector<Genet>& genets) {
    const WorldTime begin = time_of(epoch * epoch_years), end = time_of((epoch + 1) * epoch_years);
    std::vector<Genet> of_trunk;
    for (const DeadWood& wood : trunks) {
        if (!fungi.species[index].lives_with(wood.kind) || wood.gone <= begin || wood.died >= end ||
            !may_lie_in(wood, region))
            continue;
        of_trunk.clear();
        append_of_trunk(fungi, index, wood, end, of_trunk);
        for (const Genet& genet : of_trunk)
            if (genet.born < end && genet.died > begin) genets.push_back(genet);
    }
}

/// Returns the kinds of trees that fungi of the ground live with.
std::uint32_t kinds_of_ground(const Fungi& fungi) {
    std::uint32_t kinds = 0;
    for (const FungusSpecies& species : fungi.species)
        if (species.ecology.guild != Guild::wood) kinds |= species.kinds;
    return kinds;
}

}  // namespace

std::uint32_t kinds_of(const Ecology& ecology, std::span<const std::string> kinds) {
    if (ecology.trees.empty()) return 0xFFFFFFFFU;
    std::uint32_t bits = 0;
    for (std::size_t i = 0; i < kinds.size() && i < 32; ++i)
        if (std::ranges::any_of(ecology.trees,
                                [&](const auto& name) { return name.view() == kinds[i]; }))
            bits |= 1U << i;
    return bits;
}

double suitability(const Ecology& ecology, const Site& site) {
    return std::min({ecology.light.at(site.light), ecology.wetness.at(site.wetness),
                     ecology.acidity.at(site.acidity)});
}

double radius_at(const Genet& genet, WorldTime time) {
    if (time <= genet.born) return 0.0;
    return std::min(genet.reach, genet.speed * years_between(genet.born, time));
}

double arrival(const Genet& genet, double distance) {
    const double born = static_cast<double>(genet.born) / ticks_of_year;
    if (distance <= 0.0) return born;
    if (distance > genet.reach || genet.speed <= 0.0)
        return std::numeric_limits<double>::infinity();
    return born + distance / genet.speed;
}

const Genet* owner_of(std::span<const Genet> genets, std::uint8_t species, WorldPoint place,
                      WorldTime time) {
    const Genet* owner = nullptr;
    double first = static_cast<double>(time) / ticks_of_year;
    for (const Genet& genet : genets) {
        if (genet.species != species || !genet.lives_at(time)) continue;
        const double distance =
            std::sqrt(static_cast<double>(distance_squared(genet.centre, place))) / units_of_metre;
        const double at = arrival(genet, distance);
        if (at > first || (at == first && owner != nullptr && owner->id < genet.id)) continue;
        owner = &genet;
        first = at;
    }
    return owner;
}

FungusSubstrate substrate_at(const Surroundings& around, const FungusSpecies& species,
                             WorldPoint place, WorldTime time) {
    const Ecology& ecology = species.ecology;
    if (ecology.guild == Guild::grass) return {.is_there = true};
    if (ecology.guild == Guild::wood) {
        FungusSubstrate found;
        for (const DeadWood& wood : around.wood)
            if ((!found.is_there || wood.id < found.record) && species.lives_with(wood.kind) &&
                decays_for(wood, ecology, time) && is_beside(wood, place, time))
                found = {.is_there = true, .record = wood.id};
        return found;
    }
    const auto is_host = [&](const StandTree& tree) {
        if (ecology.guild == Guild::litter) return drops_litter_at(tree, species, place, time);
        if (!ecology.ring.pioneer) return hosts_at(tree, species, place, time);
        const double years = years_between(tree.born, time);
        return tree.lives_at(time) && species.lives_with(tree.kind) &&
               within(tree.at, place, std::min(ecology.genet.reach, ecology.genet.speed * years));
    };
    const StandTree* best = nullptr;
    for (const StandTree& tree : around.trees) {
        if (!is_host(tree)) continue;
        if (best != nullptr) {
            const std::int64_t a = distance_squared(tree.at, place),
                               b = distance_squared(best->at, place);
            if (a > b || (a == b && tree.id > best->id)) continue;
        }
        best = &tree;
    }
    return best == nullptr ? FungusSubstrate{}
                           : FungusSubstrate{.is_there = true, .record = best->id};
}

std::vector<Genet> genets_of(const Fungi& fungi, CellIndex block, int epoch,
                             const Surroundings& around) {
    std::vector<Genet> genets;
    const Region region(block);
    const TreeGrid grid(around.trees, region, kinds_of_ground(fungi));
    for (std::size_t i = 0; i < fungi.species.size(); ++i) {
        const auto index = static_cast<std::uint8_t>(i);
        if (fungi.species[i].ecology.guild == Guild::wood)
            append_of_wood(fungi, index, region, epoch, around.wood, genets);
        else
            GroundMycelia(fungi, index, region, epoch, around).append_to(genets, &grid);
    }
    std::erase_if(genets, [&](const Genet& genet) { return !region.contains(genet.centre); });
    std::ranges::sort(genets, {}, &Genet::id);
    return genets;
}

std::vector<Genet> genets_round(const Fungi& fungi, const Region& region, int epoch,
                                const Surroundings& around) {
    std::vector<Genet> genets;
    const double spacing = spacing_of(fungi.species);
    double margin = 0.0;
    for (const FungusSpecies& species : fungi.species)
        if (species.ecology.guild != Guild::wood)
            margin = std::max(margin, mycelia_within(species.ecology, spacing));
    const TreeGrid grid(around.trees, region.grown(margin), kinds_of_ground(fungi));
    for (std::size_t i = 0; i < fungi.species.size(); ++i) {
        const auto index = static_cast<std::uint8_t>(i);
        const Ecology& ecology = fungi.species[i].ecology;
        if (ecology.guild == Guild::wood)
            append_of_wood(fungi, index, region.grown(trunks_within(ecology, spacing)), epoch,
                           around.wood, genets);
        else
            GroundMycelia(fungi, index, region.grown(mycelia_within(ecology, spacing)), epoch,
                          around)
                .append_to(genets, &grid);
    }
    std::ranges::sort(genets, {}, &Genet::id);
    return genets;
}

}  // namespace sporeprint
