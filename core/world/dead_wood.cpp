#include "core/world/dead_wood.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <map>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "core/math/elementary.h"
#include "core/math/purposes.h"
#include "core/math/random.h"
#include "core/world/patches.h"
#include "core/world/tree_growth.h"

namespace sporeprint {

namespace {

/// Share of the mass at which nobody can tell a log from the ground.
constexpr double last_mass = 0.15;

/// How long a snag stands at most.
constexpr double snag_years = 15.0;

/// Slopes less than this do not decide where a trunk falls.
constexpr double least_slope = 0.15;

/// Length of a trunk without its top, as a share of the tree's height, and the radius of its foot compared with that at
/// breast height.
constexpr double trunk_share = 0.9, foot = 1.15;

/// How often a trunk is drawn anew that would fall on something, and how far from a living tree it stays at least,
/// metres: roots are wider than trunks.
constexpr int most_falls = 16;
constexpr double clearance = 0.1, roots = 1.3;

/// Share of the time that a trunk lies after which others may lie across it: it is flat.
constexpr double flat = 0.85;

/// Deviation of the directions in which trunks fall from their mean, radians.
constexpr double deviation_of_falls = 0.75;

/// A trunk that cannot fall beside everything breaks so far before what it falls on, and leaves at least so much, metres.
constexpr double gap = 0.15, shortest = 1.0;

/// A trunk that is dead or will be, and what decides on its direction before its surroundings do.
struct Fall {
    DeadWood wood;
    bool stays = false;  ///< nobody takes it away
    double mean = 0.0;   ///< direction in which most trunks fall there
    Random draws;        ///< those that are left

    /// Draws another direction.
    void turn() { wood.direction = mean + deviation_of_falls * draws.normal(); }
};

/// Returns what the death of a tree leaves as it would fall on empty ground; nothing if that is thin. Its draws belong
/// to the tree.
std::optional<Fall> fall_of(const Stand& stand, const StandTree& tree, const FallSiteAt& site,
                            double downwind) {
    const TreeEcology& ecology = stand.kinds[tree.kind].ecology;
    const double height = height_at(tree, tree.died), diameter = trunk_diameter(height);
    if (diameter < thinnest_log) return std::nullopt;
    const double lasts = lasting(foot * diameter);
    Fall out{{},
             false,
             0.0,
             Random(stand.seed, purposes::dead_wood, static_cast<std::uint32_t>(tree.id),
                    {static_cast<std::int32_t>(tree.id >> 32), 0})};
    const double taken = out.draws.uniform(), wait = out.draws.uniform(),
                 deviation = out.draws.normal();
    const FallSite slope = site(tree.at);
    const bool downhill =
        out.draws.uniform() < 0.5 &&
        slope.east * slope.east + slope.north * slope.north > least_slope * least_slope;
    const std::uint32_t high = out.draws.bits(), low = out.draws.bits();
    out.stays = taken < stand.params.dead_wood;
    out.mean = downhill ? arc_tangent(-slope.north, -slope.east) : downwind;
    DeadWood& wood = out.wood;
    wood.id = std::uint64_t{high} << 32 | low;
    wood.tree = tree.id;
    wood.at = tree.at;
    wood.kind = tree.kind;
    wood.died = tree.died;
    wood.gone = tree.died + static_cast<WorldTime>(lasts * years_of_decay(stand.params, ecology) *
                                                   ticks_of_year);
    wood.fell = tree.by_storm
                    ? tree.died
                    : tree.died + static_cast<WorldTime>(wait * snag_years * ticks_of_year);
    wood.fell = std::min(wood.fell, wood.gone);
    wood.direction = out.mean + deviation_of_falls * deviation;
    wood.length = trunk_share * height;
    wood.radius = 0.5 * foot * diameter;
    wood.decay = decay_rate(stand.params, ecology) / lasts;
    return out;
}

/// A place as metres to the east and north of another.
glm::dvec2 between(WorldPoint from, WorldPoint to) {
    return {metres(to.x) - metres(from.x), metres(to.y) - metres(from.y)};
}

glm::dvec2 way_of(const DeadWood& wood) {
    const SineCosine turn = sine_cosine(wood.direction);
    return {turn.cosine, turn.sine};
}

double square(double x) { return x * x; }
double cross(const glm::dvec2& a, const glm::dvec2& b) { return a.x * b.y - a.y * b.x; }

/// Returns the square of the distance of a trunk from the origin.
double square_distance_of(const glm::dvec2& at, const glm::dvec2& along) {
    const double whole = glm::dot(along, along);
    const double t = whole > 0.0 ? std::clamp(-glm::dot(at, along) / whole, 0.0, 1.0) : 0.0;
    const glm::dvec2 nearest = at + t * along;
    return glm::dot(nearest, nearest);
}

/// Returns how a trunk lies.
FallenTrunk fallen(const DeadWood& wood) {
    const glm::dvec2 along = wood.length * way_of(wood);
    return {wood.at,
            wood.fell,
            wood.gone,
            wood.id,
            static_cast<float>(along.x),
            static_cast<float>(along.y)};
}

/// What stands and lies round a block, by cells of the ground.
class Obstacles {
  public:
    /// own  ids of the trunks of the block, which are added when they have fallen
    Obstacles(std::span<const Falls* const> near, const std::set<std::uint64_t>& own,
              double longest)
        : longest_(longest) {
        for (const Falls* const one : near) {
            for (const StandingTrunk& trunk : one->standing)
                standing_[cell_of(trunk.at)].push_back(trunk);
            for (const FallenTrunk& trunk : one->fallen)
                if (!own.contains(trunk.id)) fallen_[cell_of(trunk.at)].push_back(trunk);
        }
    }

    void add(const DeadWood& wood) { fallen_[cell_of(wood.at)].push_back(fallen(wood)); }

    /// Gathers what a trunk may fall on.
    void gather(const DeadWood& wood) {
        trunks_.clear();
        logs_.clear();
        for_each_near(standing_, wood.at, wood.length + widest, [&](const StandingTrunk& trunk) {
            if (trunk.tree == wood.tree || trunk.since >= wood.gone || trunk.to <= wood.fell)
                return;
            const glm::dvec2 at = between(wood.at, trunk.at);
            if (glm::dot(at, at) < square(wood.length + widest))
                trunks_.push_back({at, trunk.radius + clearance});
        });
        for_each_near(fallen_, wood.at, wood.length + longest_, [&](const FallenTrunk& trunk) {
            // Who falls later goes aside.
            if (std::pair(trunk.fell, trunk.id) >= std::pair(wood.fell, wood.id) ||
                trunk.fell + static_cast<WorldTime>(flat * (trunk.gone - trunk.fell)) <= wood.fell)
                return;
            const glm::dvec2 at = between(wood.at, trunk.at), along(trunk.east, trunk.north);
            if (square_distance_of(at, along) < square(wood.length)) logs_.push_back({at, along});
        });
    }

    /// Returns how much of the trunk can lie in its direction from its foot on, metres.
    [[nodiscard]] double free_length(const DeadWood& wood) const {
        const glm::dvec2 way = way_of(wood), end = wood.length * way;
        double free = wood.length;
        for (const Trunk& trunk : trunks_) {
            const double along = std::clamp(glm::dot(trunk.at, way), 0.0, wood.length);
            const glm::dvec2 aside = trunk.at - along * way;
            const double near =
                square(wood.radius * taper_at(wood, along) + trunk.radius) - glm::dot(aside, aside);
            if (near > 0.0) free = std::min(free, along - std::sqrt(near));
        }
        for (const Log& log : logs_) {
            const double turn = cross(end, log.along), sign = turn < 0.0 ? -1.0 : 1.0;
            const double here = sign * cross(log.at, log.along), there = sign * cross(log.at, end);
            const double most = sign * turn;
            if (here > 0.0 && here < most && there > 0.0 && there < most)
                free = std::min(free, wood.length * here / most - wood.radius - gap);
        }
        return free;
    }

  private:
    /// Places from the foot of the trunk that falls, metres.
    struct Trunk {
        glm::dvec2 at;
        double radius;
    };
    struct Log {
        glm::dvec2 at, along;
    };
    template <class Record>
    using Cells = std::map<CellIndex, std::vector<Record>, CellOrder>;

    static constexpr std::int32_t cell_units = 8 * units_of_metre;
    /// No trunk with its roots is wider, metres.
    static constexpr double widest = 1.5;

    static CellIndex cell_of(WorldPoint at) {
        return {floor_div(at.x, cell_units), floor_div(at.y, cell_units)};
    }

    template <class Record, class Use>
    static void for_each_near(const Cells<Record>& cells, WorldPoint at, double within,
                              const Use& use) {
        const auto units = static_cast<std::int32_t>(std::ceil(within * units_of_metre));
        const CellIndex first = cell_of({at.x - units, at.y - units}),
                        last = cell_of({at.x + units, at.y + units});
        for (std::int32_t x = first.x; x <= last.x; ++x)
            for (auto cell = cells.lower_bound({x, first.y});
                 cell != cells.end() && cell->first.x == x && cell->first.y <= last.y; ++cell)
                for (const Record& record : cell->second) use(record);
    }

    double longest_;
    Cells<StandingTrunk> standing_;
    Cells<FallenTrunk> fallen_;
    std::vector<Trunk> trunks_;  ///< what gather() has found
    std::vector<Log> logs_;
};

}  // namespace

double longest_trunk(const Stand& stand) { return trunk_share * greatest_height(stand); }

double decay_rate(const StandParams& params, const TreeEcology& ecology) {
    return ecology.decay / std::max(1.0, params.dead_wood);
}

double years_of_decay(const StandParams& params, const TreeEcology& ecology) {
    return -logarithm(last_mass) / decay_rate(params, ecology);
}

Falls falls_of(const Stand& stand, std::span<const StandTree> trees, const FallSiteAt& site,
               double downwind) {
    Falls out;
    for (const StandTree& tree : trees) {
        const std::optional<Fall> fall = fall_of(stand, tree, site, downwind);
        if (!fall) continue;
        const DeadWood& wood = fall->wood;
        out.standing.push_back({tree.at, tree.id, tree.born, fall->stays ? wood.fell : tree.died,
                                static_cast<float>(roots * wood.radius)});
        if (fall->stays) out.fallen.push_back(fallen(wood));
    }
    return out;
}

std::vector<DeadWood> dead_wood_of(const Stand& stand, std::span<const StandTree> trees,
                                   std::span<const Falls* const> near, const FallSiteAt& site,
                                   double downwind) {
    std::vector<Fall> falls;
    std::set<std::uint64_t> own;
    for (const StandTree& tree : trees) {
        const std::optional<Fall> fall = fall_of(stand, tree, site, downwind);
        if (!fall || !fall->stays) continue;
        falls.push_back(*fall);
        own.insert(fall->wood.id);
    }
    std::sort(falls.begin(), falls.end(), [](const Fall& a, const Fall& b) {
        return std::pair(a.wood.fell, a.wood.id) < std::pair(b.wood.fell, b.wood.id);
    });
    Obstacles obstacles(near, own, longest_trunk(stand));
    std::vector<DeadWood> out;
    for (Fall& fall : falls) {
        DeadWood best = fall.wood;
        obstacles.gather(best);
        double longest = obstacles.free_length(best);
        for (int i = 0; i < most_falls && longest < best.length; ++i) {
            fall.turn();
            const double free = obstacles.free_length(fall.wood);
            if (free <= longest) continue;
            longest = free;
            best.direction = fall.wood.direction;
        }
        best.length = std::clamp(longest, std::min(shortest, best.length), best.length);
        obstacles.add(best);
        out.push_back(best);
    }
    std::sort(out.begin(), out.end(),
              [](const DeadWood& a, const DeadWood& b) { return a.id < b.id; });
    return out;
}

}  // namespace sporeprint
