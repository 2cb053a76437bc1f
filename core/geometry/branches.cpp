#include "core/geometry/branches.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <numeric>
#include <utility>

#include "core/geometry/budget.h"
#include "core/math/direction.h"
#include "core/math/elementary.h"
#include "core/math/purposes.h"
#include "core/math/random.h"
#include "core/math/spline.h"
#include "core/mesh/tangents.h"
#include "core/params/messages.h"
#include "core/surface/charts.h"

namespace sporeprint {

namespace {

constexpr std::uint32_t none = Bush::none;

/// How finely tubes are drawn.
struct LimbDetail {
    int trunk_sides;  ///< of a trunk and what goes on from it
    int thick_sides;  ///< of other tubes that bear many tips
    int sides;        ///< of the others
    int twig_sides;   ///< of last branches
    int steps;        ///< rings from fork to fork
    int tip_rings;    ///< rings of a last branch before its end
    int trunk_rings;  ///< of a trunk below its lowest fork, at least 2
    // What is left of a bush shows what is not:
    double
        tips_shown;  ///< how much further down the colour of tips reaches when all others are gone
    double lean;     ///< 0..1: how far a limb turns to the middle of what it stands for
    // Of limbs of a mix that belong to a species of few, each of them long: so many times the sides, and rings; 0: as of all others.
    int few_sides = 1, few_steps = 0, few_tip_rings = 0, few_trunk_rings = 0;
};
constexpr std::array<LimbDetail, 9> ladder = {{{28, 28, 20, 18, 6, 12, 11, 0.3, 0.0},
                                               {20, 20, 12, 10, 4, 6, 6, 0.3, 0.0},
                                               {24, 8, 8, 8, 2, 3, 6, 0.3, 0.0, 2, 6, 12, 11},
                                               {12, 12, 7, 5, 2, 3, 5, 0.3, 0.0},
                                               {12, 10, 6, 4, 1, 2, 4, 0.3, 0.0},
                                               {12, 7, 5, 4, 1, 1, 3, 0.3, 0.0},
                                               {12, 6, 3, 3, 1, 1, 3, 0.3, 0.0},
                                               {6, 3, 3, 3, 1, 1, 2, 0.4, 0.0},
                                               {4, 4, 3, 3, 1, 1, 2, 1.0, 0.6}}};
/// The finest step of the ladder by level of detail, and the coarsest: what is too much for that loses its smallest limbs.
constexpr std::array<std::size_t, 4> first_step = {0, 3, 7, 8};
constexpr std::array<std::size_t, 4> last_step = {6, 6, 7, 8};
/// Rather than a coarser step, this share of limbs is enough. A round limb of four sides is seen sooner than a twig that is not there.
constexpr std::array<double, 4> enough = {0.9, 0.5, 0.0, 0.0};
/// Tips that a tube bears at its beginning to count as thick.
constexpr int many_tips = 12;

/// A limb and all that goes on from it: first children, up to a tip.
struct Chain {
    std::vector<std::uint32_t> nodes;
    std::vector<std::size_t>
        forks;  ///< places in `nodes` where others begin that are drawn: each has its rings
    int tips = 1;
    int around = 1;  ///< tips of the fork where it begins
    bool root = false;

    /// Whether it passes forks without a ring.
    [[nodiscard]] bool is_straight() const { return forks.size() + (root ? 2 : 1) < nodes.size(); }
};

std::vector<Chain> chains_of(const Bush& bush) {
    std::vector<Chain> chains;
    for (std::uint32_t i = 0; i < bush.nodes.size(); ++i) {
        const Bush::Node& node = bush.nodes[i];
        if (node.parent != none && bush.nodes[node.parent].children[0] == i) continue;
        Chain chain;
        chain.tips = node.tips;
        chain.root = node.parent == none;
        chain.around = chain.root ? node.tips : bush.nodes[node.parent].tips;
        for (std::uint32_t at = i; at != none; at = bush.nodes[at].children[0])
            chain.nodes.push_back(at);
        chains.push_back(std::move(chain));
    }
    // Those that bear most come first, then those that stand alone: they are kept. Of equals some on every side: their numbers
    // scattered.
    const auto scattered = [](const Chain& chain) { return chain.nodes.front() * 0x9e3779b1U; };
    std::stable_sort(chains.begin(), chains.end(), [&](const Chain& a, const Chain& b) {
        if (a.root != b.root) return a.root;
        if (a.tips != b.tips) return a.tips > b.tips;
        return a.around != b.around ? a.around > b.around : scattered(a) < scattered(b);
    });
    return chains;
}

/// Of a tube as species of many limbs draw it.
int sides_of(const Chain& chain, const LimbDetail& detail) {
    if (chain.root) return detail.trunk_sides;
    if (chain.tips >= many_tips) return detail.thick_sides;
    return chain.tips > 1 ? detail.sides : detail.twig_sides;
}

/// Of a tube as it is drawn.
int columns_of(const Bush& bush, const Chain& chain, const LimbDetail& detail) {
    const bool few = !chain.root && bush.nodes[chain.nodes.front()].few > 0.0;
    return sides_of(chain, detail) * (few ? detail.few_sides : 1);
}

/// Rings of a limb, whatever its end: where only some species of a mix have a tip it has as many as for one, for a mix ends where its
/// species begin.
int rings_of(const Bush::Node& end, const LimbDetail& detail) {
    if (end.children[0] == none) return detail.tip_rings;
    const bool few = end.few > 0.0;
    const int steps = few ? std::max(detail.steps, detail.few_steps) : detail.steps;
    if (!end.may_end) return steps;
    return std::max({steps, detail.tip_rings, few ? detail.few_tip_rings : 0});
}

int trunk_rings_of(const Bush::Node& top, const LimbDetail& detail) {
    return top.few > 0.0 ? std::max(detail.trunk_rings, detail.few_trunk_rings)
                         : detail.trunk_rings;
}

/// Of a tube, without the trunk below it.
std::uint64_t tube_triangles(const Bush& bush, const Chain& chain, const LimbDetail& detail) {
    // One ring at the fork where it begins, or at the top of the trunk.
    int rings = 1 + rings_of(bush.nodes[chain.nodes.back()], detail);
    for (const std::size_t fork : chain.forks)
        rings += rings_of(bush.nodes[chain.nodes[fork]], detail);
    return 2 * static_cast<std::uint64_t>(rings) *
           static_cast<std::uint64_t>(columns_of(bush, chain, detail));
}

/// Of a trunk from the ground to its lowest fork; it is closed below.
std::uint64_t trunk_triangles(const Bush& bush, const Chain& chain, const LimbDetail& detail) {
    return 2 *
           static_cast<std::uint64_t>(trunk_rings_of(bush.nodes[chain.nodes.front()], detail) - 1) *
           static_cast<std::uint64_t>(detail.trunk_sides);
}

/// Of a tube on which no other begins.
MeshCount count_of(const Bush& bush, const Chain& chain, const LimbDetail& detail) {
    const auto sides = static_cast<std::uint64_t>(columns_of(bush, chain, detail));
    const auto rings = static_cast<std::uint64_t>(1 + detail.tip_rings);
    // A row at the beginning, a point at the tip.
    MeshCount count{(chain.root ? rings : rings + 1) * sides + 1,
                    tube_triangles(bush, chain, detail)};
    if (chain.root) {
        const auto trunk =
            static_cast<std::uint64_t>(trunk_rings_of(bush.nodes[chain.nodes.front()], detail));
        count.vertices += (trunk + 1) * (sides + 1);
        count.triangles += trunk_triangles(bush, chain, detail);
    }
    return count;
}

/// Limbs of which there is less have no triangles.
constexpr double least_presence = 0.004;

/// Whether a tube has triangles: its first limb has begun to be there.
bool is_there(const Bush& bush, const Chain& chain) {
    return bush.nodes[chain.nodes.front()].presence >= least_presence;
}

/// Of the rings that a tube has more for another that begins on it.
MeshCount fork_count(const Bush& bush, const Chain& bearer, std::size_t at,
                     const LimbDetail& detail) {
    const auto rings = static_cast<std::uint64_t>(rings_of(bush.nodes[bearer.nodes[at]], detail)) *
                       static_cast<std::uint64_t>(columns_of(bush, bearer, detail));
    return {rings, 2 * rings};
}

/// What of a bush is drawn at a level of detail.
struct Plan {
    LimbDetail detail{};
    std::vector<Chain> chains;
    MeshCount count;
};

Plan plan_of(const Bush& bush, int lod) {
    const auto level = static_cast<std::size_t>(lod);
    Plan plan;
    plan.chains = chains_of(bush);
    // Of each node the chain that it is on, and where there.
    struct Place {
        std::size_t chain = 0, at = 0;
    };
    std::vector<Place> places(bush.nodes.size());
    for (std::size_t c = 0; c < plan.chains.size(); ++c)
        for (std::size_t k = 0; k < plan.chains[c].nodes.size(); ++k)
            places[plan.chains[c].nodes[k]] = {c, k};
    // Where the fork is that a chain begins at; the lowest one is the top of a trunk, which has its ring.
    const auto fork_of = [&](const Chain& chain) -> const Place* {
        if (chain.root) return nullptr;
        const std::uint32_t fork = bush.nodes[chain.nodes.front()].parent;
        return bush.nodes[fork].parent == none ? nullptr : &places[fork];
    };
    std::size_t kept = 0;
    for (std::size_t step = first_step[level]; step <= last_step[level]; ++step) {
        plan.detail = ladder[step];
        plan.count = {};
        for (kept = 0; kept < plan.chains.size(); ++kept) {
            MeshCount one = count_of(bush, plan.chains[kept], plan.detail);
            // A bearer bears more than what it bears, so that it came before.
            if (const Place* fork = fork_of(plan.chains[kept])) {
                const MeshCount rings =
                    fork_count(bush, plan.chains[fork->chain], fork->at, plan.detail);
                one.vertices += rings.vertices;
                one.triangles += rings.triangles;
            }
            if (plan.count.triangles + one.triangles > most_triangles[level]) break;
            plan.count.vertices += one.vertices;
            plan.count.triangles += one.triangles;
        }
        if (static_cast<double>(kept) >= enough[level] * static_cast<double>(plan.chains.size()))
            break;
    }
    plan.chains.resize(kept);
    for (const Chain& chain : plan.chains)
        if (const Place* fork = fork_of(chain)) plan.chains[fork->chain].forks.push_back(fork->at);
    for (Chain& chain : plan.chains) std::sort(chain.forks.begin(), chain.forks.end());
    return plan;
}

/// Curvature of a bent bush times how far its limbs reach: at 1 those on the inner side would meet.
constexpr double most_fold = 0.75;

/// What limbs that are left out leave to those that stay: width as a power of the number of tips.
constexpr double width_left = 0.7;
/// Tubes of fewer sides would cut the rings of the chart's disc short.
constexpr int round_sides = 6;

/// A place on the middle of a tube.
struct Station {
    glm::dvec3 at{0.0}, along{0.0, 1.0, 0.0};
    glm::dmat3 flat{0.0};  ///< which way it is flattened: sum of squares of unit vectors
    double radius = 0.0, wide = 1.0, thin = 1.0;  ///< in that way, and square to it
    double at_fork = 0.0;                         ///< 0..1: how near a fork it is
    double colour = 0.0;  ///< see Bush::Node::from_tip; of a trunk the share of its length
    double few = 0.0;     ///< see Bush::Node::few
};

glm::dmat3 square_of(const glm::dvec3& v) { return glm::outerProduct(v, v); }

/// Polygons are narrower than the circles round them: by how much, seen from all sides.
double widened(int sides) { return pi / (sides * sine(pi / sides)); }

/// A bush where its deformation has put it.
Bush deformed(const Individual& individual) {
    Bush bush = individual.bush;
    const DeformationOf<Plain>& deformation = individual.model.deformation;
    Random random(individual.effective.seed, purposes::axis_angles);
    const double bend = random.uniform(0.0, 2.0 * pi);
    const double lean = random.uniform(0.0, 2.0 * pi);
    const Axis axis(AxisCurve(), deformation, {bend, lean}, 0.0, bush.height);
    const double fold = axis.greatest_curvature() * bush.reach;
    if (fold >= most_fold)
        throw Impossible(
            "/deformation/bend_deg",
            number_text(deformation.bend_deg) + " bends this bush through itself; about " +
                number_text(std::floor(0.97 * most_fold * deformation.bend_deg / fold * 10.0) /
                            10.0) +
                " is the most over this zone");
    std::vector<FreeForm> dents;
    if (deformation.imperfection > 0.0)
        for (std::uint32_t i = 0; i < 9; ++i) {
            Random place(individual.effective.seed, purposes::dents, i);
            const double angle = place.uniform(0.0, 2.0 * pi), high = place.uniform(0.35, 1.0);
            const double strength = place.symmetric(), width = place.uniform(0.7, 1.2);
            const double down = place.symmetric();
            const auto [s, c] = sine_cosine(angle);
            const double size = width * std::max(bush.reach, 0.3 * bush.height);
            const glm::dvec3 out(c, 0.7 * down, s);
            dents.push_back(dent(
                glm::dvec3(0.7 * bush.reach * c, high * bush.height, 0.7 * bush.reach * s),
                glm::dvec3(1.6 * size), 0.08 * deformation.imperfection * strength * size * out));
        }
    const auto moved = [&](SurfacePoint& point) {
        for (const FreeForm& one : dents) one.apply(point.position, point.meridian, point.azimuth);
        const AxisStation station = axis.at(point.position.y);
        point.meridian = station.direction(point.position, point.meridian);
        point.azimuth = station.direction(point.position, point.azimuth);
        point.position = station.point(point.position);
    };
    for (Bush::Node& node : bush.nodes) {
        // Where its limb begins, and where it ends.
        SurfacePoint start{node.beside, node.heading, node.across};
        if (node.parent != none) start.position += individual.bush.nodes[node.parent].place;
        SurfacePoint end{node.place, node.heading, node.across};
        moved(start);
        moved(end);
        node.heading = unit_or(end.position - start.position, unit_or(end.meridian, node.heading));
        node.across = square_to(node.heading, end.azimuth);
        node.beside =
            node.parent == none ? glm::dvec3(0.0) : start.position - bush.nodes[node.parent].place;
        node.place = end.position;
    }
    return bush;
}

class Tubes {
  public:
    Tubes(const Individual& individual, int lod, const SweepOptions& options)
        : bush_(deformed(individual)),
          plan_(plan_of(bush_, lod)),
          seed_(individual.effective.seed),
          goes_round_(lod < 2),
          options_(options),
          stands_for_(bush_.nodes.size(), 1.0),
          drawn_(bush_.nodes.size()) {
        weigh_what_is_left_out();
        lean_to_what_is_left_out();
    }

    Mesh build() {
        const auto vertices = static_cast<std::size_t>(plan_.count.vertices);
        mesh_.positions.reserve(vertices);
        mesh_.normals.reserve(vertices);
        mesh_.texture_coordinates.reserve(vertices);
        mesh_.indices.reserve(3 * static_cast<std::size_t>(plan_.count.triangles));
        for (const Chain& chain : plan_.chains) add(chain);
        if (options_.textured)
            add_tangents(mesh_);
        else
            mesh_.texture_coordinates.clear();
        return std::move(mesh_);
    }

  private:
    using Node = Bush::Node;

    [[nodiscard]] const Node& node(std::uint32_t i) const { return bush_.nodes[i]; }

    // Of each node, how many times more tips its limb stands for than it bears.
    void weigh_what_is_left_out() {
        std::vector<bool> kept(bush_.nodes.size(), false);
        double left = 0.0, all_left = 0.0;
        for (const Chain& chain : plan_.chains) {
            for (const std::uint32_t i : chain.nodes) kept[i] = true;
            left += node(chain.nodes.back()).presence;
        }
        for (const std::uint32_t root : bush_.roots) all_left += node(root).left;
        thinned_ = 1.0 + plan_.detail.tips_shown * std::max(0.0, 1.0 - left / all_left);
        for (std::uint32_t i = 0; i < bush_.nodes.size(); ++i) {
            const Node& one = node(i);
            if (one.children[0] == none) continue;
            const double mine = std::max(node(one.children[0]).left, 1e-9);
            for (const std::uint32_t child : one.children) stands_for_[child] = stands_for_[i];
            if (!kept[one.children[1]])
                stands_for_[one.children[0]] *= std::max(1.0, one.left / mine);
        }
    }

    // Turns limbs towards the middle of the tips that they stand for, and lets them reach as far as the farthest of those: where a few
    // stand for all, the crown keeps its outline.
    void lean_to_what_is_left_out() {
        if (plan_.detail.lean <= 0.0) return;
        struct Stand {
            glm::dvec3 base{0.0}, sum{0.0};
            double weight = 0.0, reach = 0.0;
        };
        std::vector<Stand> stands(plan_.chains.size());
        std::vector<std::size_t> standing(bush_.nodes.size(), plan_.chains.size());
        for (std::size_t c = 0; c < plan_.chains.size(); ++c) {
            const Chain& chain = plan_.chains[c];
            for (const std::uint32_t i : chain.nodes) standing[i] = c;
            const std::uint32_t first = chain.nodes.front();
            stands[c].base = node(chain.root ? first : node(first).parent).place;
        }
        for (std::uint32_t i = 0; i < bush_.nodes.size(); ++i) {
            const Node& one = node(i);
            if (standing[i] == stands.size() && one.parent != none)
                standing[i] = standing[one.parent];
            if (!bush_.is_tip(i) || standing[i] == stands.size()) continue;
            Stand& stand = stands[standing[i]];
            stand.sum += one.presence * one.place;
            stand.weight += one.presence;
            stand.reach = std::max(stand.reach, glm::distance(one.place, stand.base));
        }
        for (std::size_t c = 0; c < plan_.chains.size(); ++c) {
            const Chain& chain = plan_.chains[c];
            const Stand& stand = stands[c];
            if (stand.weight < 1e-9) continue;
            Node& tip = bush_.nodes[chain.nodes.back()];
            const glm::dvec3 middle = stand.sum / stand.weight - stand.base;
            const glm::dvec3 from = tip.place - stand.base;
            const glm::dvec3 wanted = stand.reach * unit_or(middle, unit_or(from, tip.heading));
            const glm::dvec3 move = plan_.detail.lean * (wanted - from);
            tip.heading =
                unit_or(tip.heading + move / std::max(glm::length(from), 1e-12), tip.heading);
            // A trunk stays where it is.
            const std::size_t still = chain.root ? 1 : 0;
            const auto steps = static_cast<double>(chain.nodes.size() - still);
            for (std::size_t k = still; k < chain.nodes.size(); ++k)
                bush_.nodes[chain.nodes[k]].place +=
                    static_cast<double>(k + 1 - still) / steps * move;
        }
    }

    // Of the ring at the end of a limb: where it forks it has begun to be as thin as what goes on.
    [[nodiscard]] double radius_at(std::uint32_t i) const {
        const double own = wide_as(i);
        return bush_.is_tip(i) ? own : std::sqrt(own * wide_as(node(i).children[0]));
    }
    [[nodiscard]] double wide_as(std::uint32_t i) const {
        return node(i).radius * power(stands_for_[i], width_left);
    }

    // The way in which a tube passes the end of a limb: half-way between that limb and the next.
    [[nodiscard]] glm::dvec3 passing(std::uint32_t i) const {
        return unit_or(node(i).heading + node(node(i).children[0]).heading, node(i).heading);
    }

    static SplineSegment<glm::dvec3> way(const glm::dvec3& from, const glm::dvec3& leaving,
                                         const glm::dvec3& to, const glm::dvec3& arriving) {
        const double length = glm::distance(from, to);
        return {from, to, length * leaving, length * arriving};
    }

    // How wide a limb is at its fork, and how flat.
    void shape(Station& station, double at_fork, double flat) const {
        const double flatness = bush_.flatness * flat;
        station.at_fork = at_fork;
        station.wide = (1.0 + bush_.web * at_fork) / std::sqrt(1.0 - flatness);
        station.thin = std::sqrt(1.0 - flatness);
    }

    // Stations of a tube from `from` on to the end of a limb. What the species of a mix draw each in its own way is between those ways as
    // far as they weigh: where one has a tip and another goes on, and where one of few limbs has more rings.
    void add_limb(std::vector<Station>& stations, const Station& from, std::uint32_t i,
                  bool is_straight) const {
        const LimbDetail& detail = plan_.detail;
        const auto rings = static_cast<std::size_t>(rings_of(node(i), detail));
        const auto drawn = [&](const auto& as, int own, int of_few) {
            std::vector<Station> limb = divided(from, as(own), rings);
            if (of_few > own && node(i).few > 0.0)
                mix(limb, divided(from, as(of_few), rings), node(i).few);
            return limb;
        };
        const auto as_fork = [&](int count) { return fork_of(from, i, count); };
        const auto as_tip = [&](int count) { return tip_of(from, i, is_straight, count); };
        std::vector<Station> limb;
        if (bush_.is_tip(i)) {
            limb = as_tip(detail.tip_rings);
        } else {
            limb = drawn(as_fork, detail.steps, detail.few_steps);
            if (node(i).may_end)
                mix(limb, drawn(as_tip, detail.tip_rings, detail.few_tip_rings), bush_.ends(i));
        }
        stations.insert(stations.end(), limb.begin(), limb.end());
    }

    // As many rings, on the straight pieces between those of a limb, which keep their places.
    static std::vector<Station> divided(const Station& from, std::vector<Station> limb,
                                        std::size_t rings) {
        if (limb.size() == rings) return limb;
        const std::size_t pieces = rings / limb.size(), rest = rings % limb.size();
        std::vector<Station> all;
        for (std::size_t k = 0; k < limb.size(); ++k) {
            const Station& before = k == 0 ? from : limb[k - 1];
            const std::size_t count = pieces + (k < rest ? 1 : 0);
            for (std::size_t n = 1; n < count; ++n)
                all.push_back(
                    between(before, limb[k], static_cast<double>(n) / static_cast<double>(count)));
            all.push_back(limb[k]);
        }
        return all;
    }

    static void mix(std::vector<Station>& limb, const std::vector<Station>& other, double share) {
        for (std::size_t k = 0; k < limb.size(); ++k) limb[k] = between(limb[k], other[k], share);
    }

    static Station between(const Station& a, const Station& b, double t) {
        const auto mixed = [t](const auto& x, const auto& y) { return (1.0 - t) * x + t * y; };
        Station s;
        s.at = mixed(a.at, b.at);
        s.along = unit_or(mixed(a.along, b.along), a.along);
        s.flat = mixed(a.flat, b.flat);
        s.radius = mixed(a.radius, b.radius);
        s.wide = mixed(a.wide, b.wide);
        s.thin = mixed(a.thin, b.thin);
        s.at_fork = mixed(a.at_fork, b.at_fork);
        s.colour = mixed(a.colour, b.colour);
        s.few = mixed(a.few, b.few);
        return s;
    }

    // One station on the way from `from` to the end of a limb; its radius is left open.
    Station on_the_way(const Station& from, std::uint32_t i, const glm::dvec3& arriving,
                       const glm::dmat3& flat, double t, double near_end) const {
        const Node& end = node(i);
        const auto sample = way(from.at, from.along, end.place, arriving).at(t);
        Station s;
        s.at = sample.position;
        // Rings turn as headings do: where limbs leave side by side the tube is sheared, not bent.
        s.along = unit_or((1.0 - t) * from.along + t * arriving, end.heading);
        s.flat = (1.0 - t) * from.flat + t * flat;
        shape(s, near_end + from.at_fork * (1.0 - smooth_step(0.0, 0.6, t)), 1.0);
        s.colour = from.colour + t * (end.from_tip - from.colour);
        s.few = end.few;
        return s;
    }

    // Of a limb that forks at its end, and spreads there into both of the limbs that leave it.
    std::vector<Station> fork_of(const Station& from, std::uint32_t i, int steps) const {
        const glm::dvec3 arriving = passing(i);
        const glm::dmat3 flat = square_of(node(i).across);
        std::vector<Station> stations;
        for (int k = 1; k <= steps; ++k) {
            const double t = static_cast<double>(k) / steps;
            Station s = on_the_way(from, i, arriving, flat, t, smooth_step(0.5, 1.0, t));
            s.radius = from.radius + smooth_step(-0.15, 1.15, t) * (radius_at(i) - from.radius);
            stations.push_back(s);
        }
        return stations;
    }

    // Of a last branch: cut off where slugs have eaten, or round; one that stands for many ends as their crown does.
    std::vector<Station> tip_of(const Station& from, std::uint32_t i, bool is_straight,
                                int rings) const {
        const Node& end = node(i);
        // What passes forks without a ring goes straight to its end.
        const glm::dvec3 arriving =
            is_straight ? unit_or(end.place - from.at, end.heading) : end.heading;
        const double tip_radius = wide_as(i);
        const double bluntness = 1.0 - (1.0 - bush_.bluntness) / stands_for_[i];
        const double blunt = bluntness + end.eaten * (1.0 - bluntness);
        const double length = std::max(glm::distance(from.at, end.place), 1e-12);
        const double round = std::min(0.8, blunt * tip_radius / length);
        std::vector<Station> stations;
        for (int k = 1; k <= rings; ++k) {
            // Rings crowd towards the end.
            const double share = static_cast<double>(k) / (rings + 1);
            double t = 1.0 - (1.0 - share) * (1.0 - share) * (1.0 - 0.25 * share);
            // One ring alone stands where cylinder and cone are as large as cylinder and round end seen from the side: 2 - pi / 2.
            if (rings == 1) t = std::max(0.6, 1.0 - 0.43 * round);
            Station s = on_the_way(from, i, arriving, from.flat, t, 0.0);
            s.radius = from.radius + t * (tip_radius - from.radius);
            const double taper = (1.0 - t) * (1.0 - bluntness) + bluntness;
            s.radius *= end.eaten + (1.0 - end.eaten) * taper;
            if (rings > 1 && t > 1.0 - round) {
                const double x = (t - 1.0 + round) / round;
                s.radius *= std::sqrt(std::max(0.0, 1.0 - x * x * (1.0 - end.eaten)));
            }
            stations.push_back(s);
        }
        return stations;
    }

    void add(const Chain& chain) {
        const int sides = columns_of(bush_, chain, plan_.detail);
        Station begin;
        std::vector<Station> stations;
        const std::uint32_t first = chain.nodes.front();
        const std::uint32_t parent = node(first).parent;
        if (chain.root) {
            begin = trunk(first, sides);
        } else {
            // It begins inside of its bearer: a twig on its side, one of two equals as wide as it is.
            const Node& bearer = node(parent);
            const Station& there = drawn_[parent];
            const double sibling = std::max(wide_as(bearer.children[0]), 1e-12);
            const double equal = std::min(1.0, wide_as(first) / sibling);
            begin.at = there.at + (1.0 - equal) * node(first).beside;
            // Half-way between the ways of both, so that it never begins backwards.
            const std::uint32_t next =
                chain.forks.empty() ? chain.nodes.back() : chain.nodes[chain.forks.front()];
            const glm::dvec3 onwards =
                chain.is_straight() ? unit_or(node(next).place - begin.at, node(first).heading)
                                    : node(first).heading;
            begin.along = unit_or(there.along + onwards, there.along);
            begin.flat = square_of(bearer.across);
            // What goes on where one species of a mix ends is as thin as there is little of it.
            const double wide =
                there.radius +
                bush_.ends(parent) * (std::min(there.radius, radius_at(parent)) - there.radius);
            begin.radius = 0.97 * equal * wide;
            shape(begin, 0.0, 1.0);
            begin.colour = there.colour;
            begin.few = node(first).few;
            Station inside = begin;
            const double deep = std::min(1.1 * there.radius, 0.7 * glm::length(there.at));
            inside.at = there.at - deep * there.along;
            inside.along = there.along;
            inside.radius = 0.0;
            stations.push_back(inside);
        }
        stations.push_back(begin);
        if (chain.root) drawn_[first] = begin;
        const auto go_on_to = [&](std::uint32_t end) {
            const Station from = stations.back();
            add_limb(stations, from, end, chain.is_straight());
            drawn_[end] = stations.back();
        };
        for (const std::size_t fork : chain.forks) go_on_to(chain.nodes[fork]);
        go_on_to(chain.nodes.back());
        limb(chain, stations, sides);
    }

    // A trunk of so many rings of its own, with others between them.
    std::vector<Station> trunk_of(std::uint32_t root, int own, std::size_t rings) const {
        const Node& top = node(root);
        const double radius = radius_at(root);
        const glm::dvec3 foot(0.0, -0.2 * bush_.foot * radius, 0.0);
        const glm::dvec3 rise = unit_or(top.heading + glm::dvec3(0.0, 1.0, 0.0), top.heading);
        const auto curve = way(foot, rise, top.place, passing(root));
        const double low = bush_.foot * wide_as(root);
        const auto at = [&](double t) {
            const auto sample = curve.at(t);
            Station station;
            station.flat = square_of(top.across);
            station.at = sample.position;
            station.along = unit_or(sample.derivative, top.heading);
            station.radius = low + smooth_step(0.0, 1.0, t) * (radius - low);
            station.colour = t;
            shape(station, smooth_step(0.5, 1.0, t), 0.5 + 0.5 * t);
            return station;
        };
        const Station ground = at(0.0);
        std::vector<Station> above;
        for (int k = 1; k < own; ++k) above.push_back(at(static_cast<double>(k) / (own - 1)));
        std::vector<Station> all = divided(ground, std::move(above), rings - 1);
        all.insert(all.begin(), ground);
        return all;
    }

    // Rows of a trunk from the ground to its lowest fork; what goes on begins where they end.
    Station trunk(std::uint32_t root, int sides) {
        const Node& top = node(root);
        const LimbDetail& detail = plan_.detail;
        const auto rings = static_cast<std::size_t>(trunk_rings_of(top, detail));
        std::vector<Station> stations = trunk_of(root, detail.trunk_rings, rings);
        if (rings > static_cast<std::size_t>(detail.trunk_rings))
            mix(stations, trunk_of(root, detail.few_trunk_rings, rings), top.few);
        Station end = stations.front();
        end.radius = 0.0;
        stations.insert(stations.begin(), end);
        const auto row = static_cast<std::uint32_t>(sides + 1);
        side_ = square_to(stations.front().along, top.across);
        const std::uint32_t base = rows(stations, sides, 1, true, 0.0);
        const bool shown = options_.keep_absent || node(root).presence >= least_presence;
        for (std::uint32_t i = 0; shown && i + 1 < stations.size(); ++i)
            for (std::uint32_t j = 0; j + 1 < row; ++j) {
                const std::uint32_t a = base + i * row + j, b = a + 1, c = a + row, d = c + 1;
                if (i > 0) mesh_.indices.insert(mesh_.indices.end(), {a, c, b});
                mesh_.indices.insert(mesh_.indices.end(), {b, c, d});
            }
        Station begin = stations.back();
        begin.colour = 1.0;
        return begin;
    }

    // One tube: its rows, and the point in which it ends.
    void limb(const Chain& chain, const std::vector<Station>& stations, int sides) {
        const auto row = static_cast<std::uint32_t>(sides);
        const Node& tip = node(chain.nodes.back());
        const std::uint32_t start = node(chain.nodes.front()).parent;
        const double turn =
            chain.root
                ? 0.0
                : 2.0 * pi * Random(seed_, purposes::limb_turns, chain.nodes.front()).uniform();
        // What goes on from a trunk begins with the very ring in which that ends.
        if (!chain.root) side_ = square_to(stations.front().along, node(start).across);
        const std::uint32_t base =
            rows(stations, sides, sides / sides_of(chain, plan_.detail), false, turn);
        const auto end = static_cast<std::uint32_t>(mesh_.positions.size());
        const double colour = colour_of(tip.from_tip);
        const auto [s, c] = sine_cosine(turn);
        const auto at = disc_point(swept_charts[0], colour, c, s);
        mesh_.positions.emplace_back(tip.place);
        mesh_.normals.emplace_back(tip.heading);
        mesh_.texture_coordinates.emplace_back(at.u, at.v);
        if (!options_.keep_absent && !is_there(bush_, chain)) return;
        const auto count = static_cast<std::uint32_t>(stations.size());
        for (std::uint32_t i = 0; i + 1 < count; ++i)
            for (std::uint32_t j = 0; j < row; ++j) {
                const std::uint32_t k = (j + 1) % row;
                const std::uint32_t a = base + i * row + j, b = base + i * row + k;
                const std::uint32_t d = a + row, e = b + row;
                if (chain.root || i > 0) mesh_.indices.insert(mesh_.indices.end(), {a, d, b});
                mesh_.indices.insert(mesh_.indices.end(), {b, d, e});
            }
        for (std::uint32_t j = 0; j < row; ++j) {
            const std::uint32_t a = base + (count - 1) * row + j;
            const std::uint32_t b = base + (count - 1) * row + (j + 1) % row;
            mesh_.indices.insert(mesh_.indices.end(), {a, end, b});
        }
    }

    // Appends the vertices of all rows: columns of a trunk end where they began, those of limbs meet round the chart's disc.
    // Of columns that only species of few limbs have `times` as many, the others draw the same polygon without them.
    std::uint32_t rows(const std::vector<Station>& stations, int sides, int times, bool strip,
                       double turn) {
        const auto base = static_cast<std::uint32_t>(mesh_.positions.size());
        const auto columns = static_cast<std::size_t>(sides);
        std::vector<glm::dvec3> places, outs;
        const int corners = sides / times;
        const double wider = widened(sides), coarser = widened(corners);
        // How far out the coarser polygon is at a column.
        std::vector<double> reach(columns, coarser);
        for (std::size_t j = 0; j < columns; ++j) {
            const double corner = pi / corners;
            const double past =
                2.0 * pi * static_cast<double>(j % static_cast<std::size_t>(times)) / sides;
            if (past > 0.0) reach[j] *= cosine(corner) / cosine(past - corner);
        }
        for (std::size_t i = 0; i < stations.size(); ++i) {
            const Station& station = stations[i];
            if (i > 0) carry(stations[i - 1].along, station.along);
            const glm::dvec3 third = glm::cross(side_, station.along);
            for (std::size_t j = 0; j < columns; ++j) {
                const auto [s, c] =
                    sine_cosine(2.0 * pi * static_cast<double>(j) / static_cast<double>(sides));
                const glm::dvec3 out = c * side_ + s * third;
                glm::dvec3 moved =
                    station.thin * out + (station.wide - station.thin) * (station.flat * out);
                moved -= glm::dot(moved, station.along) * station.along;
                outs.push_back(out);
                const double wide = reach[j] + station.few * (wider - reach[j]);
                places.push_back(station.at + wide * station.radius * moved);
            }
        }
        for (std::size_t i = 0; i < stations.size(); ++i)
            for (std::size_t j = 0; j < columns + (strip ? 1 : 0); ++j) {
                const std::size_t column = j % columns;
                const std::size_t here = i * columns + column;
                const std::size_t left = i * columns + (column + columns - 1) % columns;
                const std::size_t right = i * columns + (column + 1) % columns;
                const std::size_t below = i == 0 ? here : here - columns;
                const std::size_t above = i + 1 == stations.size() ? here : here + columns;
                // A trunk and what goes on from it shade their common ring alike.
                const bool common = strip ? i + 1 == stations.size() : i == 0;
                mesh_.positions.emplace_back(places[here]);
                mesh_.normals.emplace_back(
                    normal(stations[i], outs[here], places[right] - places[left],
                           common ? stations[i].along : places[above] - places[below]));
                texture(stations[i], sides, strip, static_cast<double>(j) / sides, turn);
            }
        return base;
    }

    // Carries the direction of column 0 along without twist.
    void carry(const glm::dvec3& before, const glm::dvec3& along) {
        const double between = glm::dot(before, along);
        if (between > -0.999) {
            const glm::dvec3 about = glm::cross(before, along);
            side_ += glm::cross(about, side_) +
                     glm::cross(about, glm::cross(about, side_)) / (1.0 + between);
        }
        side_ = square_to(along, side_);
    }

    static glm::dvec3 normal(const Station& station, const glm::dvec3& out, const glm::dvec3& round,
                             const glm::dvec3& along) {
        if (station.radius < 1e-9) return out;
        const glm::dvec3 found = unit_or(glm::cross(along, round), out);
        // The ends of tubes that are all but gone are rounding noise.
        return glm::dot(found, out) > 0.0 ? found : out;
    }

    // Where fewer tips are, the colour of tips reaches further down: so much of it was seen.
    [[nodiscard]] double colour_of(double from_tip) const { return power(from_tip, thinned_); }

    void texture(const Station& station, int sides, bool strip, double round, double turn) {
        TexturePoint at{};
        if (strip) {
            at = strip_point(swept_charts[2], station.colour, round);
        } else {
            // A polygon cuts the disc's rings short: few sides go there and back on a piece of it.
            const double angle = turn + (goes_round_ && sides >= round_sides
                                             ? 2.0 * pi * round
                                             : 0.7 * (1.0 - std::abs(2.0 * round - 1.0)));
            const auto [s, c] = sine_cosine(angle);
            at = disc_point(swept_charts[0], colour_of(station.colour), c, s);
        }
        mesh_.texture_coordinates.emplace_back(at.u, at.v);
    }

    Bush bush_;
    Plan plan_;
    std::uint32_t seed_;
    bool goes_round_;
    SweepOptions options_;
    std::vector<double> stands_for_;
    double thinned_ = 1.0;
    std::vector<Station> drawn_;      ///< of each node of a tube that is made
    glm::dvec3 side_{1.0, 0.0, 0.0};  ///< of column 0 of the row that is made
    Mesh mesh_;
};

}  // namespace

MeshCount limb_count(const Bush& bush, int lod, bool keep_absent) {
    const Plan plan = plan_of(bush, lod);
    MeshCount count = plan.count;
    if (keep_absent) return count;
    for (const Chain& chain : plan.chains)
        if (!is_there(bush, chain)) {
            count.triangles -= tube_triangles(bush, chain, plan.detail);
            if (chain.root) count.triangles -= trunk_triangles(bush, chain, plan.detail);
        }
    return count;
}

Mesh branched_mesh(const Individual& individual, int lod, const SweepOptions& options) {
    return Tubes(individual, lod, options).build();
}

}  // namespace sporeprint
