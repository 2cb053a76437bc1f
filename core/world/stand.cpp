#include "core/world/stand.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "core/math/elementary.h"
#include "core/math/purposes.h"
#include "core/world/cell_random.h"
#include "core/world/patches.h"
#include "core/world/tree_growth.h"

namespace sporeprint {

namespace {

/// Sides of the squares that seedlings are drawn in.
constexpr std::int32_t nursery_units = patch_units / 4;
constexpr int nurseries_of_patch = 4;

/// How far a chain of four rounds of competition reaches, and how far one of them, metres.
constexpr double apron = 20.0, greatest_zone = 5.0;

/// Within so many years after a storm, trees are born; the strongest is as strong as if it was born so many earlier.
constexpr double birth_years = 12.0, vigour_years = 10.0;

/// The Weibull distribution of the age of death.
constexpr double age_shape = 3.0, age_mean = 0.892979511569249;  // gamma(1 + 1/3)

/// How far heights of a kind differ from their mean, as a share of it.
constexpr double height_variation = 0.18;

double mean_height(const Stand& stand, const StandKind& kind) {
    return stand.params.height * kind.ecology.height / standard_height;
}

/// A rectangle of squares.
struct CellBox {
    CellIndex first, last;  ///< both within

    [[nodiscard]] int columns() const { return last.x - first.x + 1; }
    [[nodiscard]] std::size_t size() const {
        return static_cast<std::size_t>(columns()) * static_cast<std::size_t>(last.y - first.y + 1);
    }
    [[nodiscard]] std::size_t index(CellIndex cell) const {
        return static_cast<std::size_t>(cell.y - first.y) * static_cast<std::size_t>(columns()) +
               static_cast<std::size_t>(cell.x - first.x);
    }
    [[nodiscard]] CellIndex cell(std::size_t index) const {
        const auto across = static_cast<std::size_t>(columns());
        return {first.x + static_cast<std::int32_t>(index % across),
                first.y + static_cast<std::int32_t>(index / across)};
    }
    [[nodiscard]] CellBox grown(int by) const {
        return {{first.x - by, first.y - by}, {last.x + by, last.y + by}};
    }
    [[nodiscard]] bool contains(CellIndex cell) const {
        return cell.x >= first.x && cell.x <= last.x && cell.y >= first.y && cell.y <= last.y;
    }
};

/// Returns the squares that cover a block and a rim round it.
CellBox cells_round(CellIndex block, double rim, std::int32_t side) {
    const auto beyond = static_cast<std::int32_t>(rim * units_of_metre);
    const std::int32_t block_units = block_side * units_of_metre;
    const auto first = [&](std::int32_t number) {
        return floor_div(number * block_units - beyond, side);
    };
    const auto last = [&](std::int32_t number) {
        return floor_div((number + 1) * block_units + beyond, side);
    };
    return {{first(block.x), first(block.y)}, {last(block.x), last(block.y)}};
}

/// A seedling, which may become a tree.
struct Seedling {
    StandTree tree;
    std::uint32_t cohort = 0;  ///< equal for trees of one patch and one storm
    double strength = 0.0;     ///< the lower, the stronger: moment of birth less its vigour
    double crown = 1.0;        ///< factor of the circle that it claims
};

/// Returns when the circle that a tree claims reaches a distance; never is the greatest number.
WorldTime reaches_at(const Seedling& one, double distance) {
    constexpr WorldTime never = INT32_MAX;
    if (distance > greatest_zone) return never;
    const double height = height_of_crown(distance / one.crown);
    const double years = age_of_height(one.tree, height);
    if (years > 2000.0) return never;
    return time_after(one.tree.born, years);
}

/// The seedlings of a block and of the rim that they depend on.
class Nursery {
  public:
    Nursery(const Stand& stand, const SiteAt& site, const SiteAt& dim, CellIndex block)
        : stand_(stand),
          site_(site),
          dim_(dim),
          core_(cells_round(block, 0.0, nursery_units)),
          cells_(cells_round(block, apron, nursery_units)),
          patch_cells_(cells_round(block, apron, patch_units).grown(2)) {
        patches_.reserve(patch_cells_.size());
        for (std::size_t i = 0; i < patch_cells_.size(); ++i)
            patches_.push_back(patch_of(stand, patch_cells_.cell(i)));
        find_owners();
        find_cohorts();
    }

    std::vector<Seedling> seedlings() {
        std::vector<Seedling> out;
        for (std::size_t i = 0; i < cells_.size(); ++i)
            for (const std::size_t owner : owners_[i]) add(cells_.cell(i), owner, out);
        if (stand_.lone && cells_.contains({}) && share_at({}) > 0.0) out.push_back(lone());
        return out;
    }

  private:
    /// Finds the patches that each square may belong to.
    void find_owners() {
        owners_.resize(cells_.size());
        // Half the diagonal of a square, rounded up.
        constexpr double radius = 0.7072 * nursery_units;
        for (std::size_t i = 0; i < cells_.size(); ++i) {
            const CellIndex cell = cells_.cell(i);
            const WorldPoint middle{cell.x * nursery_units + nursery_units / 2,
                                    cell.y * nursery_units + nursery_units / 2};
            std::array<double, 25> distances{};
            std::array<std::size_t, 25> near{};
            double nearest = 1e30;
            for (std::size_t k = 0; k < near.size(); ++k) {
                near[k] = patch_cells_.index(neighbour(cell, k));
                distances[k] =
                    std::sqrt(static_cast<double>(square_distance(middle, patches_[near[k]].seed)));
                nearest = std::min(nearest, distances[k]);
            }
            for (std::size_t k = 0; k < near.size(); ++k)
                if (distances[k] <= nearest + 2.0 * radius) owners_[i].push_back(near[k]);
        }
    }

    /// Returns one of the 25 squares of patches round a square of seedlings.
    static CellIndex neighbour(CellIndex cell, std::size_t number) {
        const auto k = static_cast<std::int32_t>(number);
        return {floor_div(cell.x, nurseries_of_patch) + k % 5 - 2,
                floor_div(cell.y, nurseries_of_patch) + k / 5 - 2};
    }

    /// Finds from when on each patch's cohorts matter. All that live in the years of trees do, and so do those of patches beside
    /// them that lived when they were young.
    void find_cohorts() {
        since_.assign(patches_.size(), end_of_trees);
        const CellBox middle = core_.grown(1);
        for (std::size_t i = 0; i < middle.size(); ++i) {
            const CellIndex cell = middle.cell(i);
            WorldTime oldest = end_of_trees;
            for (const std::size_t owner : owners_[cells_.index(cell)])
                oldest = std::min(oldest, storm_before(patches_[owner], begin_of_trees));
            for (std::int32_t dy = -1; dy <= 1; ++dy)
                for (std::int32_t dx = -1; dx <= 1; ++dx)
                    for (const std::size_t owner :
                         owners_[cells_.index({cell.x + dx, cell.y + dy})])
                        since_[owner] = std::min(since_[owner], oldest);
        }
    }

    /// Returns the last storm of a patch before or at a moment.
    static WorldTime storm_before(const StandPatch& patch, WorldTime time) {
        return *std::prev(std::upper_bound(patch.storms.begin(), patch.storms.end(), time));
    }

    /// Returns the patch of a place in a square.
    [[nodiscard]] std::size_t owner_of(CellIndex cell, WorldPoint place) const {
        std::size_t owner = 0;
        std::int64_t nearest = INT64_MAX;
        for (const std::size_t patch : owners_[cells_.index(cell)]) {
            const std::int64_t distance = square_distance(place, patches_[patch].seed);
            if (distance < nearest) {
                nearest = distance;
                owner = patch;
            }
        }
        return owner;
    }

    /// Adds the seedlings of a patch in a square.
    void add(CellIndex cell, std::size_t owner, std::vector<Seedling>& out) {
        const StandPatch& patch = patches_[owner];
        for (std::size_t i = 0; i + 1 < patch.storms.size(); ++i)
            if (patch.storms[i + 1] > since_[owner] && patch.storms[i] < end_of_trees)
                add(cell, owner, static_cast<std::uint32_t>(i), out);
    }

    void add(CellIndex cell, std::size_t owner, std::uint32_t cohort, std::vector<Seedling>& out) {
        constexpr double side = static_cast<double>(nursery_units) / units_of_metre,
                         mean = seedling_density * side * side;
        static const double none = exponential(-mean);
        const StandPatch& patch = patches_[owner];
        // Which of the patches round the square it is, and which of its cohorts.
        const CellIndex first = neighbour(cell, 0);
        const auto which =
            static_cast<std::uint32_t>((patch.cell.y - first.y) * 5 + patch.cell.x - first.x);
        const std::uint32_t object = (cohort * 32 + which) * 64;
        Random number(stand_.seed, purposes::seedlings, object, cell);
        const int count = poisson(mean, none, number.uniform(), 63);
        for (int i = 1; i <= count; ++i) {
            Random random(stand_.seed, purposes::seedlings, object + static_cast<std::uint32_t>(i),
                          cell);
            Seedling one;
            one.tree.at.x = place_in(cell.x, nursery_units, random.bits());
            one.tree.at.y = place_in(cell.y, nursery_units, random.bits());
            const double taken = random.uniform(), kind = random.uniform();
            if (taken >= stand_.params.density * share_at(one.tree.at) ||
                is_in_glade(one.tree.at) || owner_of(cell, one.tree.at) != owner ||
                !choose_kind(one.tree, kind))
                continue;
            one.cohort = static_cast<std::uint32_t>(owner) * 1024 + cohort + 1;
            grow(one, random, patch.storms[cohort], patch.storms[cohort + 1]);
            if (one.tree.born < one.tree.died) out.push_back(one);
        }
    }

    /// Returns which share of the seedlings of a place is there. Those of a smaller share are among those of a greater.
    [[nodiscard]] double share_at(WorldPoint place) const {
        return stand_.mask ? stand_.mask->at(place) : 1.0;
    }

    [[nodiscard]] bool is_in_glade(WorldPoint place) const {
        const double radius = stand_.params.glade * units_of_metre;
        return static_cast<double>(square_distance(place, {})) < radius * radius;
    }

    /// Chooses the kind of a tree by what its place has to give. Returns false if no tree grows there.
    bool choose_kind(StandTree& tree, double draw) const {
        bool is_dim = static_cast<bool>(dim_);
        Site site = is_dim ? dim_(tree.at) : site_(tree.at);
        double sum = 0.0;
        for (std::size_t i = 0; i < stand_.kinds.size(); ++i) {
            if (is_dim && !has_enough(stand_.kinds[i].ecology.light, site.light)) {
                site = site_(tree.at);
                is_dim = false;
            }
            sum += stand_.kinds[i].share * suitability(stand_.kinds[i].ecology, site);
            if (draw < sum) {
                tree.kind = static_cast<std::uint8_t>(i);
                return true;
            }
        }
        return false;
    }

    /// Returns whether nothing changes for a kind where there is more light.
    static bool has_enough(const ShareResponse& response, double light) {
        return light >= response.prefers.from && response.prefers.to >= 1.0;
    }

    static double suitability(const TreeEcology& ecology, const Site& site) {
        return std::min({ecology.light.at(site.light), ecology.wetness.at(site.wetness),
                         ecology.acidity.at(site.acidity)});
    }

    /// Returns the tree at the centre of the world, which nothing but age can kill.
    [[nodiscard]] Seedling lone() const {
        Random random(stand_.seed, purposes::seedlings);
        Seedling one;
        one.tree.kind = *stand_.lone;
        grow(one, random, 0, INT32_MAX);
        one.tree.born = 0;
        one.strength = INT32_MIN;
        return one;
    }

    /// Draws the life of a seedling, without its neighbours.
    void grow(Seedling& one, Random& random, WorldTime storm, WorldTime next_storm) const {
        const StandKind& kind = stand_.kinds[one.tree.kind];
        const TreeEcology& ecology = kind.ecology;
        const double birth = random.uniform(), vigour = random.uniform(),
                     height = random.symmetric(), age = random.uniform();
        const std::uint32_t high = random.bits(), low = random.bits();
        one.tree.id = std::uint64_t{high} << 32 | low;
        one.tree.born = time_after(storm, birth * birth_years);
        one.tree.height = mean_height(stand_, kind) * (1.0 + height_variation * height);
        const WorldTime old =
            time_after(one.tree.born, weibull(age, ecology.life, age_shape, age_mean));
        one.tree.by_storm = next_storm <= old;
        one.tree.died = std::min(next_storm, old);
        one.strength = one.tree.born - vigour * vigour_years * ticks_of_year;
        one.crown = ecology.crown;
    }

    const Stand& stand_;
    const SiteAt &site_, &dim_;
    CellBox core_, cells_, patch_cells_;
    std::vector<StandPatch> patches_;
    std::vector<std::vector<std::size_t>> owners_;
    std::vector<WorldTime> since_;
};

/// Who may kill whom, and when.
struct Rivalry {
    std::size_t weaker, stronger;
    WorldTime reached;
};

/// Competition among seedlings.
class Competition {
  public:
    explicit Competition(std::vector<Seedling> seedlings) : seedlings_(std::move(seedlings)) {
        sort_into_groups();
        find_rivals();
    }

    /// Returns the trees that live at all.
    std::vector<StandTree> survivors() {
        const std::vector<WorldTime> drawn = deaths();
        for (int round = 0; round < 3; ++round) kill(within_, drawn);
        kill(among_, deaths());
        std::vector<StandTree> trees;
        trees.reserve(seedlings_.size());
        for (std::size_t i = 0; i < seedlings_.size(); ++i) {
            StandTree& tree = seedlings_[i].tree;
            tree.by_storm = tree.by_storm && tree.died == drawn[i];
            if (tree.born < tree.died) trees.push_back(tree);
        }
        return trees;
    }

  private:
    /// The seedlings of one cohort in a square of the greatest zone. Most groups never live at one time.
    struct Group {
        CellIndex cell;
        std::uint32_t cohort = 0;
        std::size_t begin = 0, end = 0;
        WorldTime born = INT32_MAX, died = INT32_MIN;  ///< of the first, and of the last
    };

    static CellIndex cell_of(WorldPoint place) {
        constexpr auto side = static_cast<std::int32_t>(greatest_zone * units_of_metre);
        return {floor_div(place.x, side), floor_div(place.y, side)};
    }

    /// Orders seedlings by squares of the greatest zone, so that neighbours are in nine of them, and by cohorts.
    void sort_into_groups() {
        struct Key {
            CellIndex cell;
            std::uint32_t cohort;
            std::uint32_t index;
        };
        std::vector<Key> keys;
        keys.reserve(seedlings_.size());
        for (const Seedling& one : seedlings_)
            keys.push_back(
                {cell_of(one.tree.at), one.cohort, static_cast<std::uint32_t>(keys.size())});
        std::sort(keys.begin(), keys.end(), [](const Key& a, const Key& b) {
            if (a.cell.y != b.cell.y) return a.cell.y < b.cell.y;
            if (a.cell.x != b.cell.x) return a.cell.x < b.cell.x;
            return a.cohort != b.cohort ? a.cohort < b.cohort : a.index < b.index;
        });
        std::vector<Seedling> sorted;
        sorted.reserve(seedlings_.size());
        for (const Key& key : keys) {
            const Seedling& one = seedlings_[key.index];
            if (groups_.empty() || groups_.back().cell != key.cell ||
                groups_.back().cohort != key.cohort)
                groups_.push_back({key.cell, key.cohort, sorted.size(), sorted.size()});
            Group& group = groups_.back();
            ++group.end;
            group.born = std::min(group.born, one.tree.born);
            group.died = std::max(group.died, one.tree.died);
            sorted.push_back(one);
        }
        seedlings_ = std::move(sorted);
    }

    /// Returns the first group in or behind a square.
    [[nodiscard]] std::size_t first_in(CellIndex cell) const {
        const auto found =
            std::partition_point(groups_.begin(), groups_.end(), [&](const Group& one) {
                return one.cell.y < cell.y || (one.cell.y == cell.y && one.cell.x < cell.x);
            });
        return static_cast<std::size_t>(found - groups_.begin());
    }

    static bool is_stronger(const Seedling& a, const Seedling& b) {
        return a.strength != b.strength ? a.strength < b.strength : a.tree.id < b.tree.id;
    }

    void find_rivals() {
        for (std::size_t i = 0; i < groups_.size();) {
            const CellIndex cell = groups_[i].cell;
            const std::size_t end = first_in({cell.x + 1, cell.y});
            // Each pair once: those behind in the order are to the east in this row, or in the next row.
            const std::size_t row_end = first_in({cell.x + 2, cell.y}),
                              next = first_in({cell.x - 1, cell.y + 1}),
                              next_end = first_in({cell.x + 2, cell.y + 1});
            for (std::size_t one = i; one < end; ++one) {
                add_within(groups_[one]);
                for (std::size_t other = one + 1; other < row_end; ++other)
                    add_between(groups_[one], groups_[other]);
                for (std::size_t other = next; other < next_end; ++other)
                    add_between(groups_[one], groups_[other]);
            }
            i = end;
        }
    }

    void add_within(const Group& group) {
        for (std::size_t one = group.begin; one < group.end; ++one)
            for (std::size_t other = one + 1; other < group.end; ++other) add(one, other);
    }

    void add_between(const Group& a, const Group& b) {
        if (a.born >= b.died || b.born >= a.died) return;
        for (std::size_t one = a.begin; one < a.end; ++one)
            for (std::size_t other = b.begin; other < b.end; ++other) add(one, other);
    }

    void add(std::size_t one, std::size_t other) {
        const std::int64_t square =
            square_distance(seedlings_[one].tree.at, seedlings_[other].tree.at);
        constexpr auto most = static_cast<std::int64_t>(greatest_zone * units_of_metre);
        if (square > most * most) return;
        if (is_stronger(seedlings_[one], seedlings_[other])) std::swap(one, other);
        const Seedling &weaker = seedlings_[one], &stronger = seedlings_[other];
        if (stronger.tree.born >= weaker.tree.died || stronger.tree.died <= weaker.tree.born)
            return;
        const double distance = std::sqrt(static_cast<double>(square)) / units_of_metre;
        const WorldTime reached = std::max(reaches_at(stronger, distance), weaker.tree.born);
        if (reached >= weaker.tree.died || reached >= stronger.tree.died) return;
        (weaker.cohort == stronger.cohort ? within_ : among_).push_back({one, other, reached});
    }

    [[nodiscard]] std::vector<WorldTime> deaths() const {
        std::vector<WorldTime> out;
        out.reserve(seedlings_.size());
        for (const Seedling& one : seedlings_) out.push_back(one.tree.died);
        return out;
    }

    /// One round: whom a stronger one reaches that still lives by the round before dies then.
    ///
    /// latest  when each dies otherwise
    void kill(const std::vector<Rivalry>& rivalries, std::vector<WorldTime> latest) {
        for (const Rivalry& one : rivalries)
            if (one.reached < seedlings_[one.stronger].tree.died)
                latest[one.weaker] = std::min(latest[one.weaker], one.reached);
        for (std::size_t i = 0; i < latest.size(); ++i) seedlings_[i].tree.died = latest[i];
    }

    std::vector<Seedling> seedlings_;
    std::vector<Group> groups_;
    std::vector<Rivalry> within_, among_;
};

}  // namespace

double greatest_height(const Stand& stand) {
    double greatest = 0.0;
    for (const StandKind& kind : stand.kinds)
        greatest = std::max(greatest, mean_height(stand, kind));
    return greatest * (1.0 + height_variation);
}

std::vector<StandTree> trees_of(const Stand& stand, const SiteAt& site, CellIndex block,
                                const SiteAt& dim) {
    Nursery nursery(stand, site, dim, block);
    std::vector<StandTree> trees = Competition(nursery.seedlings()).survivors();
    std::erase_if(trees, [&](const StandTree& tree) {
        return block_at(tree.at) != block || tree.died <= begin_of_trees ||
               tree.born >= end_of_trees;
    });
    std::sort(trees.begin(), trees.end(),
              [](const StandTree& a, const StandTree& b) { return a.id < b.id; });
    return trees;
}

}  // namespace sporeprint
