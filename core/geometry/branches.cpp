#include "core/geometry/branches.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <numeric>
#include <utility>

#include "core/geometry/branch_deformation.h"
#include "core/geometry/branch_plan.h"
#include "core/geometry/ground.h"
#include "core/geometry/joints.h"
#include "core/geometry/ruffle.h"
#include "core/geometry/segment_relief.h"
#include "core/geometry/spines.h"
#include "core/geometry/tube.h"
#include "core/math/direction.h"
#include "core/math/elementary.h"
#include "core/math/purposes.h"
#include "core/math/random.h"
#include "core/math/spline.h"
#include "core/mesh/tangents.h"
#include "core/surface/charts.h"

namespace sporeprint {

namespace {

constexpr std::uint32_t none = BranchGraph::none;

/// Exponent by which a tube that represents dropped ones is widened: width is a power of the number
/// of tips.
constexpr double width_exponent = 0.7;

// No source or measurement is recorded for the values down to `foot_depth`, except `round_end`.

/// Share of a segment after which it no longer has the shape of the fork at its beginning, and from
/// which on it has that of the fork at its end.
constexpr double fork_ends = 0.6, fork_begins = 0.5;

/// How far a segment's radius has begun to change before its beginning and ends to do so after its
/// end, in lengths of the segment: tubes are not conical at forks.
constexpr double radius_overlap = 0.15;

/// Longest round end of a branch in its lengths; position at which a single ring begins at the
/// latest; area that an end loses by being round, seen from the side, in squares of its radius:
/// 2 - pi / 2; how much denser rings are towards the end.
constexpr double longest_round = 0.8, latest_ring = 0.6, round_end = 0.43, ring_density = 0.25;

/// Length over which a tube takes on another radius and direction, in that radius: forks that are
/// close to each other make no step.
constexpr double turn_length = 1.6;

/// Radius of a tube at its beginning, in that of its parent, so that it stays inside; how deep it
/// begins in its parent, in radii of that and at most in distances from the ground.
constexpr double inside_parent = 0.97, root_depth = 1.5, most_root_depth = 0.7;

/// Radius of the first ring of a tube, in that of its beginning, and how far it lies behind that, in
/// the same: a tube comes out of its parent at a small angle, and the corners of its first polygon
/// stay inside those of its parent, which may stand elsewhere.
constexpr double first_ring = 0.8, first_depth = 0.4;

/// Share of its own direction in that in which a tube begins; the rest is that of its parent, which it
/// leaves in a bow.
constexpr double fork_turn = 0.45;

/// Gnarled segments, for `gnarl` 1: how far their middle is beside the straight way, in their radius
/// where they are much longer than `bend_length` radii; how much farther their second half is on the
/// one side and their first on the other; how far their thickness deviates between forks, and how
/// much thicker they are at forks.
constexpr double gnarl_bend = 1.1, bend_length = 5.0, gnarl_swing = 0.5, gnarl_lumps = 0.35,
                 gnarl_knees = 0.14;

/// How far the colours of branches deviate from those of their place; the distance along a tube over
/// which they are spread to either side, in its radii.
constexpr double colour_drift = 0.55, colour_spread = 2.5;

/// Depth of the foot of a trunk under the ground, in its radii.
constexpr double foot_depth = 0.2;

/// Size of a spine on a branch that has not begun to grow, in that of others; how far spines stand
/// beside the middle of their branch, in its radii.
constexpr double least_spine = 0.05, spine_spread = 0.6;

/// Turn of the texture from the beginning of a tube to its tip, in that of its segment from the mean.
constexpr double texture_twist = 0.35;

/// Piece of a ring of the chart that goes half round a tube of few sides, whose long edges would cut
/// a longer one short, radians; least number of sides of the others.
constexpr double short_piece = 0.7;
constexpr std::uint32_t round_sides = 6;

/// Returns 0 at both ends of a segment, 1 in its middle; it is flat at all three, so that one segment
/// goes over into the next without a knee.
double bulge_at(double t) {
    const double middle = 4.0 * t * (1.0 - t);
    return middle * middle;
}

glm::dmat3 square_of(const glm::dvec3& v) { return glm::outerProduct(v, v); }

/// Returns the factor on the radius of a polygon that gives it the mean width of the circle round
/// it, over all directions.
double polygon_scale(int sides) { return pi / (sides * sine(pi / sides)); }

class TubeBuilder {
  public:
    TubeBuilder(const Individual& individual, DetailLevel level, const SweepOptions& options)
        : graph_(deformed_branch_graph(individual)),
          spine_detail_(spine_detail(individual.spines, level)),
          plan_(branch_plan(individual, graph_, level)),
          seed_(individual.shape_seed),
          relief_seed_(Random(seed_, purposes::segment_turns, none).bits()),
          options_(options),
          represented_(graph_.nodes.size(), 1.0),
          built_(graph_.nodes.size()),
          tube_of_(graph_.nodes.size(), Tube::none) {
        count_dropped_tips();
        lean_to_dropped_tips();
    }

    Mesh build() {
        const auto vertices = static_cast<std::size_t>(plan_.count.vertices);
        mesh_.positions.reserve(vertices);
        mesh_.normals.reserve(vertices);
        colours_.reserve(vertices);
        mesh_.indices.reserve(3 * static_cast<std::size_t>(plan_.count.triangles));
        for (const TubeChain& chain : plan_.chains) add_chain(chain);
        blend_joints(mesh_, colours_, tubes_);
        add_segment_relief(mesh_, tubes_, graph_.gnarl, graph_.trunk_radius, relief_seed_);
        if (options_.textured) {
            add_texture_coordinates();
            add_tangents(mesh_);
        }
        return std::move(mesh_);
    }

    // Returns the surface of all trunks below the ground, where they are one: the upper half of its
    // depth is their side, the lower half their end.
    [[nodiscard]] Foot foot() const {
        double radius = 0.0;
        for (const std::uint32_t root : graph_.roots)
            radius = std::max(radius, graph_.foot * node(root).radius);
        return [radius](double depth, double angle) {
            const auto turn = sine_cosine(angle);
            const glm::dvec3 out(turn.cosine, 0.0, turn.sine);
            const double down = std::min(2.0 * depth, 1.0),
                         inwards = std::max(2.0 * depth - 1.0, 0.0);
            return FootPoint{
                radius * ((1.0 - inwards) * out - foot_depth * down * glm::dvec3(0.0, 1.0, 0.0)),
                unit_or((1.0 - inwards) * out - inwards * glm::dvec3(0.0, 1.0, 0.0), out)};
        };
    }

    // Appends the spines of all species, which hang from the tubes that are drawn.
    void add_hanging_spines(Mesh& mesh, const std::vector<SpineLayer>& layers) const {
        for (const SpineLayer& layer : layers) {
            std::vector<const Reach*> bearing;
            for (const Reach& reach : reaches_)
                if (reach.along >= layer.style.from && reach.along <= layer.style.to)
                    bearing.push_back(&reach);
            if (bearing.empty()) bearing.push_back(&reaches_.back());
            // Every stretch of a tube bears as many, so that no spine moves to another as they grow.
            add_spines(mesh, layer, spine_detail_, seed_, options_.textured, options_.keep_absent,
                       [&](int number) {
                           const SpinePlace at = spine_place(number);
                           const glm::dvec3 down(0.0, -1.0, 0.0);
                           const double place = at.along * static_cast<double>(bearing.size());
                           const Reach& one = *bearing[static_cast<std::size_t>(place)];
                           const double t = place - std::floor(place);
                           // They begin inside the tube, at its lower side.
                           const glm::dvec3 aside =
                               (2.0 * at.round - 1.0) * one.radius * square_to(down, one.across);
                           return SpineRoot{
                               one.from + t * (one.to - one.from) + spine_spread * aside, down,
                               one.along, least_spine + (1.0 - least_spine) * one.presence};
                       });
        }
    }

  private:
    using Node = BranchGraph::Node;

    /// A stretch of a drawn tube between two rings.
    struct Reach {
        glm::dvec3 from, to, across;
        double radius, presence;
        double along;  ///< 0 at the top of a trunk, 1 at a tip
    };

    [[nodiscard]] const Node& node(std::uint32_t i) const { return graph_.nodes[i]; }

    // Returns where on the way from tip to trunk the end of a segment has its colour.
    [[nodiscard]] double colour_at(std::uint32_t i) const {
        const double at = node(i).from_tip;
        return at + colour_drift * at * (1.0 - at) * node(i).gnarl.colour;
    }

    // Makes a station of a segment as crooked and uneven as the segment is at a share of its way.
    void add_gnarl(Station& station, std::uint32_t i, double t, double length) const {
        if (!(graph_.gnarl > 0.0)) return;
        const SineCosine bend = sine_cosine(node(i).gnarl.bend),
                         swing = sine_cosine(node(i).gnarl.swing);
        const double radius = node(i).radius;
        const double size =
            graph_.gnarl * gnarl_bend * radius * length / (length + bend_length * radius + 1e-12);
        const glm::dvec3 across = square_to(station.along, node(i).across);
        const glm::dvec3 third = glm::cross(across, station.along);
        const double middle = bulge_at(t), halves = gnarl_swing * middle * (1.0 - 2.0 * t);
        station.at += size * ((middle * bend.cosine + halves * swing.cosine) * across +
                              (middle * bend.sine + halves * swing.sine) * third);
    }

    // Returns the factor on the radius of a segment at a share of its way. A short one has no lump of
    // its own, which would be a step.
    [[nodiscard]] double lumps_at(std::uint32_t i, double t, double at_fork, double length) const {
        const BranchGraph::Gnarl& own = node(i).gnarl;
        const double lump =
            gnarl_lumps * own.lump * length / (length + bend_length * node(i).radius + 1e-12);
        return 1.0 + graph_.gnarl * (lump * bulge_at(t) + gnarl_knees * (1.0 + own.knee) * at_fork);
    }

    // For each node, computes how many times more tips its segment represents than it has.
    void count_dropped_tips() {
        std::vector<bool> built(graph_.nodes.size(), false);
        double left = 0.0, all_left = 0.0;
        for (const TubeChain& chain : plan_.chains) {
            for (const std::uint32_t i : chain.nodes) built[i] = true;
            left += node(chain.nodes.back()).presence;
        }
        for (const std::uint32_t root : graph_.roots) all_left += node(root).left;
        colour_exponent_ = 1.0 + plan_.detail.tips_shown * std::max(0.0, 1.0 - left / all_left);
        for (std::uint32_t i = 0; i < graph_.nodes.size(); ++i) {
            const Node& one = node(i);
            if (one.children[0] == none) continue;
            const double mine = std::max(node(one.children[0]).left, 1e-9);
            for (const std::uint32_t child : one.children) represented_[child] = represented_[i];
            if (!built[one.children[1]])
                represented_[one.children[0]] *= std::max(1.0, one.left / mine);
        }
    }

    // Turns tubes towards the centre of the tips that they represent and extends them to the
    // farthest of those, so that the crown keeps its outline where few tubes represent all.
    void lean_to_dropped_tips() {
        if (plan_.detail.lean <= 0.0) return;
        struct Represented {
            glm::dvec3 base{0.0}, sum{0.0};
            double weight = 0.0, reach = 0.0;
        };
        std::vector<Represented> represented(plan_.chains.size());
        std::vector<std::size_t> representative(graph_.nodes.size(), plan_.chains.size());
        for (std::size_t c = 0; c < plan_.chains.size(); ++c) {
            const TubeChain& chain = plan_.chains[c];
            for (const std::uint32_t i : chain.nodes) representative[i] = c;
            const std::uint32_t first = chain.nodes.front();
            represented[c].base = node(chain.root ? first : node(first).parent).place;
        }
        for (std::uint32_t i = 0; i < graph_.nodes.size(); ++i) {
            const Node& one = node(i);
            if (representative[i] == represented.size() && one.parent != none)
                representative[i] = representative[one.parent];
            if (!graph_.is_tip(i) || representative[i] == represented.size()) continue;
            Represented& one_tube = represented[representative[i]];
            one_tube.sum += one.presence * one.place;
            one_tube.weight += one.presence;
            one_tube.reach = std::max(one_tube.reach, glm::distance(one.place, one_tube.base));
        }
        for (std::size_t c = 0; c < plan_.chains.size(); ++c) {
            const TubeChain& chain = plan_.chains[c];
            const Represented& one_tube = represented[c];
            if (one_tube.weight < 1e-9) continue;
            Node& tip = graph_.nodes[chain.nodes.back()];
            const glm::dvec3 middle = one_tube.sum / one_tube.weight - one_tube.base;
            const glm::dvec3 from = tip.place - one_tube.base;
            const glm::dvec3 wanted = one_tube.reach * unit_or(middle, unit_or(from, tip.heading));
            const glm::dvec3 move = plan_.detail.lean * (wanted - from);
            tip.heading =
                unit_or(tip.heading + move / std::max(glm::length(from), 1e-12), tip.heading);
            // A trunk is not moved.
            const std::size_t still = chain.root ? 1 : 0;
            const auto steps = static_cast<double>(chain.nodes.size() - still);
            for (std::size_t k = still; k < chain.nodes.size(); ++k)
                graph_.nodes[chain.nodes[k]].place +=
                    static_cast<double>(k + 1 - still) / steps * move;
        }
    }

    // Returns the radius of the ring at the end of a segment: at a fork it is the geometric mean of
    // the segment's and its continuation's.
    [[nodiscard]] double radius_at(std::uint32_t i) const {
        const double own = widened_radius(i);
        return graph_.is_tip(i) ? own : std::sqrt(own * widened_radius(node(i).children[0]));
    }
    [[nodiscard]] double widened_radius(std::uint32_t i) const {
        return node(i).radius * power(represented_[i], width_exponent);
    }

    // Returns the tangent of a tube at the end of a segment: half-way between that segment and the
    // next.
    [[nodiscard]] glm::dvec3 fork_tangent(std::uint32_t i) const {
        return unit_or(node(i).heading + node(node(i).children[0]).heading, node(i).heading);
    }

    static SplineSegment<glm::dvec3> hermite_path(const glm::dvec3& from, const glm::dvec3& leaving,
                                                  const glm::dvec3& to,
                                                  const glm::dvec3& arriving) {
        const double length = glm::distance(from, to);
        return {from, to, length * leaving, length * arriving};
    }

    // Returns how flat the segments of a segment are. A tube that stands for several is rounder, since
    // they lie in several planes.
    [[nodiscard]] double flatness_of(std::uint32_t i) const {
        return graph_.flatness / represented_[i];
    }

    // Sets the width and flatness of a cross-section near a fork.
    void shape(Station& station, double at_fork, double flatness) const {
        station.at_fork = at_fork;
        station.wide = (1.0 + graph_.web * at_fork) / std::sqrt(1.0 - flatness);
        station.thin = std::sqrt(1.0 - flatness);
    }

    // Appends the stations of a tube from `from` to the end of a segment. Where species of a mix
    // draw it differently (one has a tip and another a fork, or one of few segments has more
    // rings), stations are interpolated by the weights of the species.
    void add_segment(std::vector<Station>& stations, const Station& from, std::uint32_t i,
                     bool skips_forks) const {
        const TubeDetail& detail = plan_.detail;
        const auto rings = static_cast<std::size_t>(segment_rings(node(i), detail));
        const auto drawn = [&](const auto& as, int own, int of_few) {
            std::vector<Station> segment = subdivided(from, as(own), rings);
            if (of_few > own && node(i).few > 0.0)
                mix(segment, subdivided(from, as(of_few), rings), node(i).few);
            return segment;
        };
        const auto as_fork = [&](int count) { return fork_stations(from, i, count); };
        const auto as_tip = [&](int count) { return tip_stations(from, i, skips_forks, count); };
        std::vector<Station> segment;
        if (graph_.is_tip(i)) {
            segment = as_tip(detail.tip_rings);
        } else {
            segment = drawn(as_fork, own_steps(node(i), detail), detail.few_steps);
            if (node(i).may_end)
                mix(segment, drawn(as_tip, detail.tip_rings, detail.few_tip_rings), graph_.ends(i));
        }
        stations.insert(stations.end(), segment.begin(), segment.end());
    }

    // Returns the stations of a segment with more rings, inserted on the straight pieces between
    // the given ones, which keep their places.
    static std::vector<Station> subdivided(const Station& from, std::vector<Station> segment,
                                           std::size_t rings) {
        if (segment.size() == rings) return segment;
        const std::size_t pieces = rings / segment.size(), rest = rings % segment.size();
        std::vector<Station> all;
        for (std::size_t k = 0; k < segment.size(); ++k) {
            const Station& before = k == 0 ? from : segment[k - 1];
            const std::size_t count = pieces + (k < rest ? 1 : 0);
            for (std::size_t n = 1; n < count; ++n)
                all.push_back(between(before, segment[k],
                                      static_cast<double>(n) / static_cast<double>(count)));
            all.push_back(segment[k]);
        }
        return all;
    }

    static void mix(std::vector<Station>& segment, const std::vector<Station>& other,
                    double share) {
        for (std::size_t k = 0; k < segment.size(); ++k)
            segment[k] = between(segment[k], other[k], share);
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

    // Returns one station on the path from `from` to the end of a segment, of whose shape there it
    // takes on `taken`; its radius is not set.
    Station station_on_path(const Station& from, std::uint32_t i, const glm::dvec3& arriving,
                            const glm::dmat3& flat, double t, double near_end, double taken) const {
        const Node& end = node(i);
        const auto sample = hermite_path(from.at, from.along, end.place, arriving).at(t);
        Station s;
        s.at = sample.position;
        // Rings turn with the headings: where segments leave side by side the tube is sheared, not
        // bent.
        s.along = unit_or((1.0 - t) * from.along + t * arriving, end.heading);
        s.flat = (1.0 - t) * from.flat + t * flat;
        shape(s, near_end + from.at_fork * (1.0 - taken * smooth_step(0.0, fork_ends, t)),
              flatness_of(i));
        s.colour = from.colour + t * (colour_at(i) - from.colour);
        s.few = end.few;
        add_gnarl(s, i, t, glm::distance(from.at, end.place));
        return s;
    }

    // Returns the stations of a segment that forks at its end, where it widens into both segments
    // that leave it.
    std::vector<Station> fork_stations(const Station& from, std::uint32_t i, int steps) const {
        // A short segment takes on only a part of the shape of the fork at its end; one that has
        // hardly begun to exist takes on all of it, so that it vanishes there.
        const double length = glm::distance(from.at, node(i).place);
        const double slow = turn_length * node(i).presence * radius_at(i);
        const double taken = (length + 1e-12) / (length + slow + 1e-12);
        const glm::dvec3 arriving =
            unit_or(from.along + taken * (fork_tangent(i) - from.along), fork_tangent(i));
        const glm::dmat3 flat = from.flat + taken * (square_of(node(i).across) - from.flat);
        std::vector<Station> stations;
        for (int k = 1; k <= steps; ++k) {
            const double t = static_cast<double>(k) / steps;
            const double at_end = taken * smooth_step(fork_begins, 1.0, t);
            Station s = station_on_path(from, i, arriving, flat, t, at_end, taken);
            s.radius = from.radius + smooth_step(-radius_overlap, 1.0 + radius_overlap, t) * taken *
                                         (radius_at(i) - from.radius);
            s.radius *= lumps_at(i, t, at_end, length);
            stations.push_back(s);
        }
        return stations;
    }

    // Returns the stations of a last branch. Its end is cut off where slugs have eaten it,
    // otherwise round; a branch that represents many is as pointed as their crown.
    std::vector<Station> tip_stations(const Station& from, std::uint32_t i, bool skips_forks,
                                      int rings) const {
        const Node& end = node(i);
        // A tube that skips forks goes straight to its end.
        const glm::dvec3 arriving =
            skips_forks ? unit_or(end.place - from.at, end.heading) : end.heading;
        const double tip_radius = widened_radius(i);
        const double bluntness = 1.0 - (1.0 - graph_.bluntness) / represented_[i];
        const double blunt = bluntness + end.eaten * (1.0 - bluntness);
        const double length = std::max(glm::distance(from.at, end.place), 1e-12);
        const double wide = 1.0 / std::sqrt(1.0 - flatness_of(i));
        const double round = std::min(longest_round, blunt * tip_radius * wide / length);
        std::vector<Station> stations;
        for (int k = 1; k <= rings; ++k) {
            // Rings are denser towards the end.
            const double share = static_cast<double>(k) / (rings + 1);
            double t = 1.0 - (1.0 - share) * (1.0 - share) * (1.0 - ring_density * share);
            // A single ring is placed so that cylinder and cone have the area of cylinder and round
            // end seen from the side.
            if (rings == 1) t = std::max(latest_ring, 1.0 - round_end * round);
            Station s = station_on_path(from, i, arriving, from.flat, t, 0.0, 1.0);
            s.radius = from.radius + t * (tip_radius - from.radius);
            const double taper = (1.0 - t) * (1.0 - bluntness) + bluntness;
            s.radius *= (end.eaten + (1.0 - end.eaten) * taper) * lumps_at(i, t, 0.0, length);
            if (rings > 1 && t > 1.0 - round) {
                const double x = (t - 1.0 + round) / round;
                s.radius *= std::sqrt(std::max(0.0, 1.0 - x * x * (1.0 - end.eaten)));
            }
            stations.push_back(s);
        }
        return stations;
    }

    void add_chain(const TubeChain& chain) {
        const int sides = tube_columns(graph_, chain, plan_.detail);
        Station begin;
        std::vector<Station> stations;
        std::vector<std::pair<std::uint32_t, std::size_t>> ends;  // nodes and their stations
        Tube tube;
        const std::uint32_t first = chain.nodes.front();
        const std::uint32_t parent = node(first).parent;
        if (chain.root) {
            begin = add_trunk(first, sides, tube);
        } else {
            tube.parent = tube_of_[parent];
            tube.shown = 1;
            // A tube begins inside its parent: a twig at its side, one of two equal branches as
            // wide as the parent.
            const Node& parent_end = node(parent);
            const Station& fork = built_[parent];
            const double sibling = std::max(widened_radius(parent_end.children[0]), 1e-12);
            const double equal = std::min(1.0, widened_radius(first) / sibling);
            begin.at = fork.at + (1.0 - equal) * node(first).beside;
            // The direction is between both paths, so that the tube never begins backwards.
            const std::uint32_t next =
                chain.forks.empty() ? chain.nodes.back() : chain.nodes[chain.forks.front()];
            const glm::dvec3 onwards =
                chain.skips_forks() ? unit_or(node(next).place - begin.at, node(first).heading)
                                    : node(first).heading;
            begin.along = unit_or(fork.along + fork_turn * onwards, fork.along);
            begin.flat = square_of(parent_end.across);
            // Where one species of a mix ends, the continuation is as thin as its presence is
            // small.
            const double wide =
                fork.radius +
                graph_.ends(parent) * (std::min(fork.radius, radius_at(parent)) - fork.radius);
            begin.radius = inside_parent * equal * wide;
            shape(begin, 0.0, flatness_of(first));
            begin.colour = fork.colour;
            begin.few = node(first).few;
            Station inside = begin;
            const double deep =
                std::min(root_depth * fork.radius, most_root_depth * glm::length(fork.at));
            inside.at = fork.at - deep * fork.along;
            inside.along = fork.along;
            inside.radius = 0.0;
            stations.push_back(inside);
        }
        if (chain.root) ends.emplace_back(first, 0);
        stations.push_back(begin);
        const auto extend_to = [&](std::uint32_t end) {
            const Station from = stations.back();
            add_segment(stations, from, end, chain.skips_forks());
            ends.emplace_back(end, stations.size() - 1);
        };
        for (const std::size_t fork : chain.forks) extend_to(chain.nodes[fork]);
        extend_to(chain.nodes.back());
        if (!chain.root) {
            const double deep = std::min(first_depth * begin.radius,
                                         0.8 * glm::distance(stations[0].at, stations[1].at));
            // A trunk may be thinner below.
            const bool on_trunk = node(parent).parent == none;
            stations[1].radius *= first_ring * (on_trunk ? std::min(graph_.foot, 1.0) : 1.0);
            stations[1].at -= deep * stations[0].along;
        }
        spread_colours(stations, chain.root ? 0 : 1);
        set_sides(stations, chain.root ? begin.side : node(parent).across);
        if (!chain.root) set_turns(stations, built_[parent], segment_turn(first));
        for (const auto& [end, station] : ends) built_[end] = stations[station];
        add_tube(chain, stations, sides, tube);
        for (const std::uint32_t i : chain.nodes) tube_of_[i] = tubes_.size();
        tubes_.push_back(std::move(tube));
        const double presence = node(chain.nodes.back()).presence;
        for (std::size_t i = chain.root ? 0 : 1; i + 1 < stations.size(); ++i) {
            const Station &from = stations[i], &to = stations[i + 1];
            reaches_.push_back({from.at, to.at, glm::cross(from.along, glm::dvec3(0.0, 1.0, 0.0)),
                                0.5 * (from.radius + to.radius), presence,
                                1.0 - 0.5 * (from.colour + to.colour)});
        }
    }

    // Returns the stations of a trunk: `own` rings of its own, and others inserted between them.
    std::vector<Station> trunk_stations(std::uint32_t root, int own, std::size_t rings) const {
        const Node& top = node(root);
        const double radius = radius_at(root);
        const glm::dvec3 foot(0.0, -foot_depth * graph_.foot * radius, 0.0);
        const glm::dvec3 rise = unit_or(top.heading + glm::dvec3(0.0, 1.0, 0.0), top.heading);
        const auto curve = hermite_path(foot, rise, top.place, fork_tangent(root));
        const double low = graph_.foot * widened_radius(root);
        const auto at = [&](double t) {
            const auto sample = curve.at(t);
            Station station;
            station.flat = square_of(top.across);
            station.at = sample.position;
            station.along = unit_or(sample.derivative, top.heading);
            station.radius = low + smooth_step(0.0, 1.0, t) * (radius - low);
            station.colour = t;
            shape(station, smooth_step(fork_begins, 1.0, t), graph_.flatness * (0.5 + 0.5 * t));
            return station;
        };
        const Station ground = at(0.0);
        std::vector<Station> above;
        for (int k = 1; k < own; ++k) above.push_back(at(static_cast<double>(k) / (own - 1)));
        std::vector<Station> all = subdivided(ground, std::move(above), rings - 1);
        all.insert(all.begin(), ground);
        return all;
    }

    // Appends the rows of a trunk from the ground to its lowest fork, and returns the last one,
    // where the tube above begins.
    Station add_trunk(std::uint32_t root, int sides, Tube& tube) {
        const Node& top = node(root);
        const TubeDetail& detail = plan_.detail;
        const auto rings = static_cast<std::size_t>(trunk_ring_count(top, detail));
        std::vector<Station> stations = trunk_stations(root, detail.trunk_rings, rings);
        if (rings > static_cast<std::size_t>(detail.trunk_rings))
            mix(stations, trunk_stations(root, detail.few_trunk_rings, rings), top.few);
        Station end = stations.front();
        end.radius = 0.0;
        stations.insert(stations.begin(), end);
        const auto row = static_cast<std::uint32_t>(sides + 1);
        set_sides(stations, top.across);
        const std::uint32_t base = add_rows(stations, sides, 1, true, 0.0);
        const bool shown = options_.keep_absent || node(root).presence >= least_presence;
        for (std::uint32_t i = 0; shown && i + 1 < stations.size(); ++i)
            for (std::uint32_t j = 0; j + 1 < row; ++j) {
                const std::uint32_t a = base + i * row + j, b = a + 1, c = a + row, d = c + 1;
                if (i > 0) mesh_.indices.insert(mesh_.indices.end(), {a, c, b});
                mesh_.indices.insert(mesh_.indices.end(), {b, c, d});
            }
        Station begin = stations.back();
        begin.colour = 1.0;
        tube.rows.push_back({base, static_cast<std::uint32_t>(sides), true, 0, stations.size()});
        tube.trunk = stations.size();
        tube.stations = std::move(stations);
        return begin;
    }

    // Appends one tube: its rows, and the point at its tip.
    void add_tube(const TubeChain& chain, const std::vector<Station>& stations, int sides,
                  Tube& tube) {
        const auto row = static_cast<std::uint32_t>(sides);
        const Node& tip = node(chain.nodes.back());
        const double phase = chain.root ? 0.0 : segment_turn(chain.nodes.front());
        const std::uint32_t base =
            add_rows(stations, sides, sides / tube_sides(chain, plan_.detail), false, phase);
        const auto end = static_cast<std::uint32_t>(mesh_.positions.size());
        mesh_.positions.emplace_back(tip.place);
        mesh_.normals.emplace_back(tip.heading);
        colours_.push_back(colour_at(chain.nodes.back()));
        // The first ring of the tube above a trunk is the last one of the trunk.
        const std::size_t begun = chain.root ? tube.stations.size() - 1 : 0;
        tube.rows.push_back({base, row, false, begun, stations.size()});
        tube.stations.insert(tube.stations.end(), stations.begin() + (chain.root ? 1 : 0),
                             stations.end());
        if (!options_.keep_absent && !is_present(graph_, chain)) return;
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

    // Appends the vertices of all rows and their colours. Columns of a trunk end with a repeated one
    // (strip chart); those of branches meet round the disc of the chart. Of columns that only
    // species of few segments need there are `times` as many; other species draw the same polygon
    // without them. `phase` is that of a ruffle.
    std::uint32_t add_rows(const std::vector<Station>& stations, int sides, int times, bool strip,
                           double phase) {
        const auto base = static_cast<std::uint32_t>(mesh_.positions.size());
        const auto columns = static_cast<std::size_t>(sides);
        std::vector<glm::dvec3> places, outs;
        const int corners = sides / times;
        const double wider = polygon_scale(sides), coarser = polygon_scale(corners);
        // Distance of the coarser polygon from the centre, per column.
        std::vector<double> reach(columns, coarser);
        for (std::size_t j = 0; j < columns; ++j) {
            const double corner = pi / corners;
            const double past =
                2.0 * pi * static_cast<double>(j % static_cast<std::size_t>(times)) / sides;
            if (past > 0.0) reach[j] *= cosine(corner) / cosine(past - corner);
        }
        Ruffle ruffle(strip ? 0.0 : graph_.ruffle, phase);
        for (std::size_t i = 0; i < stations.size(); ++i) {
            const Station& station = stations[i];
            ruffle.advance(station);
            const glm::dvec3 third = glm::cross(station.side, station.along);
            for (std::size_t j = 0; j < columns; ++j) {
                const auto [s, c] =
                    sine_cosine(2.0 * pi * static_cast<double>(j) / static_cast<double>(sides));
                const glm::dvec3 out = c * station.side + s * third;
                glm::dvec3 moved =
                    station.thin * out + (station.wide - station.thin) * (station.flat * out);
                moved -= glm::dot(moved, station.along) * station.along;
                outs.push_back(out);
                const double wide = reach[j] + station.few * (wider - reach[j]);
                places.push_back(station.at + wide * station.radius * moved +
                                 ruffle.displacement(out));
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
                // A trunk and the tube above it use the same normals on their common ring.
                const bool common = strip ? i + 1 == stations.size() : i == 0;
                mesh_.positions.emplace_back(places[here]);
                mesh_.normals.emplace_back(
                    normal(stations[i], outs[here], places[right] - places[left],
                           common ? stations[i].along : places[above] - places[below]));
                colours_.push_back(strip ? 1.0 : stations[i].colour);
            }
        return base;
    }

    // Sets the direction of column 0 of all rows: the first as given, the others without twist.
    static void set_sides(std::vector<Station>& stations, const glm::dvec3& first) {
        stations.front().side = square_to(stations.front().along, first);
        for (std::size_t i = 1; i < stations.size(); ++i) {
            const Station& before = stations[i - 1];
            stations[i].side =
                square_to(stations[i].along, carried(before.side, before.along, stations[i].along));
        }
    }

    // Spreads changes of colour along a tube, so that it does not change at once where two forks
    // follow each other; both ends keep theirs.
    static void spread_colours(std::vector<Station>& stations, std::size_t first) {
        std::vector<double> way(stations.size(), 0.0), sum(stations.size(), 0.0);
        for (std::size_t i = first + 1; i < stations.size(); ++i) {
            const double step = glm::distance(stations[i].at, stations[i - 1].at);
            way[i] = way[i - 1] + step;
            sum[i] = sum[i - 1] + 0.5 * step * (stations[i - 1].colour + stations[i].colour);
        }
        // Returns the integral of the colour from the first station to a place on the way.
        const auto sum_at = [&](double place) {
            std::size_t i = first + 1;
            while (i + 1 < stations.size() && way[i] < place) ++i;
            const double step = way[i] - way[i - 1], on = place - way[i - 1];
            const double rise = stations[i].colour - stations[i - 1].colour;
            return sum[i - 1] +
                   on * (stations[i - 1].colour + (step > 0.0 ? 0.5 * rise * on / step : 0.0));
        };
        std::vector<double> spread(stations.size());
        for (std::size_t i = first; i < stations.size(); ++i) {
            const double reach =
                std::min({colour_spread * stations[i].radius, way[i], way.back() - way[i]});
            spread[i] = reach > 0.0
                            ? (sum_at(way[i] + reach) - sum_at(way[i] - reach)) / (2.0 * reach)
                            : stations[i].colour;
        }
        for (std::size_t i = first; i < stations.size(); ++i) stations[i].colour = spread[i];
    }

    // Sets where the texture of a tube lies on the chart: where it leaves its parent, the texture goes
    // on from one to the other; further on it is turned, so that the two are not alike.
    static void set_turns(std::vector<Station>& stations, const Station& fork, double turn) {
        const glm::dvec3 side = stations.front().side;
        const double from_fork = arc_tangent(glm::dot(side, glm::cross(fork.side, fork.along)),
                                             glm::dot(side, fork.side));
        for (Station& station : stations) {
            const double way =
                1.0 - std::clamp(station.colour / std::max(fork.colour, 1e-9), 0.0, 1.0);
            station.turn = fork.turn + texture_twist * (turn - pi) * way;
            station.phase = fork.phase + from_fork / (2.0 * pi);
        }
    }

    // Returns an angle of a tube that begins with a segment, radians.
    [[nodiscard]] double segment_turn(std::uint32_t first) const {
        return 2.0 * pi * Random(seed_, purposes::segment_turns, first).uniform();
    }

    static glm::dvec3 normal(const Station& station, const glm::dvec3& out, const glm::dvec3& round,
                             const glm::dvec3& along) {
        if (station.radius < 1e-9) return out;
        const glm::dvec3 found = unit_or(glm::cross(along, round), out);
        // At the ends of vanishing tubes the cross product is rounding noise.
        return glm::dot(found, out) > 0.0 ? found : out;
    }

    // Where fewer tips are drawn, their colour reaches further down, so that its visible area stays
    // the same.
    [[nodiscard]] double colour_of(double from_tip) const {
        return power(from_tip, colour_exponent_);
    }

    // Sets the texture coordinates of all rows and tips.
    void add_texture_coordinates() {
        mesh_.texture_coordinates.resize(mesh_.positions.size());
        for (const Tube& tube : tubes_)
            for (const TubeRows& rows : tube.rows) {
                std::size_t vertex = rows.first_vertex;
                for (std::size_t row = 0; row < rows.count; ++row) {
                    const Station& station = tube.stations[rows.from + row];
                    for (std::uint32_t column = 0; column < rows.width(); ++column, ++vertex) {
                        const double round = static_cast<double>(column) / rows.sides;
                        const auto at =
                            rows.strip ? strip_point(swept_charts[index_of(Part::stem)],
                                                     station.colour, round)
                                       : branch_point(colours_[vertex], station, rows.sides, round);
                        mesh_.texture_coordinates[vertex] = glm::vec2(at.u, at.v);
                    }
                }
                if (rows.strip) continue;
                const auto tip =
                    branch_point(colours_[vertex], tube.stations.back(), rows.sides, 0.0);
                mesh_.texture_coordinates[vertex] = glm::vec2(tip.u, tip.v);
            }
    }

    // Returns the texture coordinate of a branch at a share of its way round. It uses a piece of a
    // ring of the disc, there and back, since a polygon cuts whole rings short.
    [[nodiscard]] TexturePoint branch_point(double colour, const Station& station,
                                            std::uint32_t sides, double round) const {
        const double place = station.phase + round;
        const double there = 2.0 * std::abs(place - std::floor(place + 0.5));
        const auto [s, c] =
            sine_cosine(station.turn + (sides < round_sides ? short_piece : branch_piece) * there);
        return disc_point(swept_charts[index_of(Part::cap)], colour_of(colour), c, s);
    }

    BranchGraph graph_;
    OrnamentDetail spine_detail_;
    BranchPlan plan_;
    std::uint32_t seed_;
    std::uint32_t relief_seed_;  ///< of the relief of segments
    SweepOptions options_;
    std::vector<double> represented_;
    double colour_exponent_ = 1.0;
    std::vector<Reach> reaches_;
    std::vector<Station> built_;  ///< per node of a tube that has been built
    std::vector<Tube> tubes_;
    std::vector<double> colours_;       ///< Station::colour per vertex, 1 on trunks
    std::vector<std::size_t> tube_of_;  ///< per node of a tube that has been built
    Mesh mesh_;
};

}  // namespace

Mesh branched_mesh(const Individual& individual, DetailLevel level, const SweepOptions& options) {
    TubeBuilder builder(individual, level, options);
    Mesh mesh = builder.build();
    builder.add_hanging_spines(mesh, individual.spines);
    add_ground(mesh, individual.grounds, builder.foot(), detail_of(level), individual.shape_seed,
               options.textured, options.keep_absent);
    return mesh;
}

}  // namespace sporeprint
