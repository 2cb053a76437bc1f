#include "core/skeleton/scaffold.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <utility>

#include "core/math/elementary.h"
#include "core/skeleton/fork.h"

namespace sporeprint {

namespace {

constexpr std::uint32_t none = 0xffffffffU;

// Distances from where a fork or a bend ends to the rings beyond, in radii: the second ring of a fork, so that what
// the skin makes of its crotches has faded there.
constexpr double first_ring = 0.7, second_ring = 1.45;
// Rings nearer to each other than this are one, in radii.
constexpr double ring_gap = 0.7;
// Bends and kinks of the radius below these need no rings of their own.
constexpr double gentle_bend_cosine = 0.8192;  // 35 degrees
constexpr double gentle_kink = 0.1;
// An end is closed by a smaller ring beyond it: height and size in radii.
constexpr double cap_height = 0.7, cap_size = 0.62;

// Half the side of the cube whose subdivided surface holds as much as a ball of radius 1.
constexpr double ball_half(int levels) {
    constexpr std::array<double, 4> halves = {0.806, 1.0702, 1.1437, 1.1625};
    return halves[static_cast<std::size_t>(levels)];
}

// Corners of a fork as points of the scaffold.
struct ForkPoints {
    Fork fork;
    std::uint32_t up = 0, down = 0;
    std::array<std::uint32_t, 3> crotch{};
};

struct Step {
    std::uint32_t limb = 0, from = 0, to = 0;
};

// A ring to be built: where, across which direction, how wide.
struct Station {
    glm::dvec3 place{0.0}, along{0.0};
    double radius = 0.0, at = 0.0;  // of the skin; metres along the strip
};

class Builder {
  public:
    Builder(const Skeleton& skeleton, int levels)
        : skeleton_(skeleton),
          factor_(tube_factor(levels)),
          ball_half_(ball_half(levels)),
          at_(skeleton.nodes.size()),
          forks_(skeleton.nodes.size(), none),
          walked_(skeleton.limbs.size(), false) {
        for (std::uint32_t i = 0; i < skeleton.limbs.size(); ++i) {
            at_[skeleton.limbs[i].from].push_back(i);
            at_[skeleton.limbs[i].to].push_back(i);
        }
    }

    Scaffold build() {
        for (std::uint32_t node = 0; node < at_.size(); ++node)
            if (at_[node].size() == 3) add_fork(node);
        for (std::uint32_t node = 0; node < at_.size(); ++node) {
            if (at_[node].empty()) add_ball(node);
            if (at_[node].size() == 2) continue;
            for (const std::uint32_t limb : at_[node])
                if (!walked_[limb]) add_strip(walk(node, limb));
        }
        // What is left are rings of limbs without fork or end.
        for (std::uint32_t limb = 0; limb < walked_.size(); ++limb)
            if (!walked_[limb]) add_strip(walk(skeleton_.limbs[limb].from, limb));
        return std::move(made_);
    }

  private:
    [[nodiscard]] const Skeleton::Node& node(std::uint32_t i) const { return skeleton_.nodes[i]; }
    [[nodiscard]] std::uint32_t other(std::uint32_t limb, std::uint32_t from) const {
        const Skeleton::Limb& one = skeleton_.limbs[limb];
        return one.from == from ? one.to : one.from;
    }
    [[nodiscard]] glm::dvec3 direction(std::uint32_t from, std::uint32_t to) const {
        return glm::normalize(node(to).place - node(from).place);
    }

    std::uint32_t add(const glm::dvec3& point) {
        made_.points.push_back(point);
        return static_cast<std::uint32_t>(made_.points.size() - 1);
    }

    void add_fork(std::uint32_t at) {
        std::array<glm::dvec3, 3> directions;
        for (std::size_t i = 0; i < 3; ++i) directions[i] = direction(at, other(at_[at][i], at));
        ForkPoints points{fork_of(directions, factor_), 0, 0, {}};
        const auto [place, radius] = node(at);
        points.up = add(place + radius * factor_ * points.fork.pole);
        points.down = add(place - radius * factor_ * points.fork.pole);
        for (std::size_t k = 0; k < 3; ++k)
            points.crotch[k] = add(place + radius * points.fork.crotch[k]);
        forks_[at] = static_cast<std::uint32_t>(fork_points_.size());
        fork_points_.push_back(points);
    }

    void add_ball(std::uint32_t at) {
        const double half = node(at).radius * ball_half_;
        Scaffold::Strip strip;
        strip.first = static_cast<std::uint32_t>(made_.quads.size());
        strip.radius = node(at).radius;
        std::array<std::uint32_t, 8> corner{};
        for (std::uint32_t i = 0; i < 8; ++i)
            corner[i] =
                add(node(at).place + half * glm::dvec3((i & 1) != 0 ? 1 : -1, (i & 2) != 0 ? 1 : -1,
                                                       (i & 4) != 0 ? 1 : -1));
        constexpr std::array<std::array<std::size_t, 4>, 6> faces = {
            {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}}};
        for (const auto& face : faces)
            cap({corner[face[0]], corner[face[1]], corner[face[2]], corner[face[3]]}, 0.0);
        finish(strip, 0);
    }

    std::vector<Step> walk(std::uint32_t start, std::uint32_t limb) {
        std::vector<Step> steps;
        std::uint32_t here = start;
        for (;;) {
            walked_[limb] = true;
            const std::uint32_t next = other(limb, here);
            steps.push_back({limb, here, next});
            here = next;
            if (at_[here].size() != 2 || here == start) break;
            limb = at_[here][0] == limb ? at_[here][1] : at_[here][0];
            if (walked_[limb]) break;
        }
        return steps;
    }

    // How far the limb from `at` towards `to` is taken up by the fork or bend at `at`, in metres; 0 at an end and where nothing
    // disturbs the skin.
    double taken(std::uint32_t at, std::uint32_t limb) {
        const std::vector<std::uint32_t>& limbs = at_[at];
        const glm::dvec3 here = direction(at, other(limb, at));
        if (limbs.size() == 3) {
            const Fork& fork = fork_points_[forks_[at]].fork;
            for (std::size_t k = 0; k < 3; ++k)
                if (limbs[fork.order[k]] == limb)
                    return node(at).radius * reach_of(fork, here, k, factor_);
        }
        if (limbs.size() == 2) {
            const std::uint32_t second = limbs[0] == limb ? limbs[1] : limbs[0];
            return node(at).radius * bend_reach(here, direction(at, other(second, at)), factor_);
        }
        return 0.0;
    }

    // Whether the skin needs rings beside the node's own to keep the radii on both sides.
    bool gentle(std::uint32_t at) const {
        if (at_[at].size() != 2) return false;
        const std::uint32_t a = other(at_[at][0], at), b = other(at_[at][1], at);
        const double length_a = glm::distance(node(a).place, node(at).place);
        const double length_b = glm::distance(node(b).place, node(at).place);
        const double straight =
            (node(a).radius * length_b + node(b).radius * length_a) / (length_a + length_b);
        return -glm::dot(direction(at, a), direction(at, b)) > gentle_bend_cosine &&
               std::abs(straight - node(at).radius) < gentle_kink * node(at).radius;
    }

    // Rings of one limb between those of its nodes, in order.
    void add_between(std::vector<Station>& stations, const Step& step, double start) {
        const Skeleton::Node &a = node(step.from), &b = node(step.to);
        const double length = glm::distance(a.place, b.place);
        const glm::dvec3 along = direction(step.from, step.to);
        const double low = taken(step.from, step.limb);
        const double high = length - taken(step.to, step.limb);
        std::vector<double> places;
        if (!gentle(step.from)) {
            places.push_back(low + first_ring * a.radius);
            if (forks_[step.from] != none) places.push_back(low + second_ring * a.radius);
        }
        if (!gentle(step.to)) {
            if (forks_[step.to] != none) places.push_back(high - second_ring * b.radius);
            places.push_back(high - first_ring * b.radius);
        }
        const double least = low + 0.5 * ring_gap * a.radius;
        const double most = high - 0.5 * ring_gap * b.radius;
        std::erase_if(places, [&](double s) { return s < least || s > most; });
        std::sort(places.begin(), places.end());
        if (places.empty() && (forks_[step.from] != none || forks_[step.to] != none))
            places.push_back(0.5 * (low + high));
        double last = -1.0;
        for (const double s : places) {
            const double radius = a.radius + (b.radius - a.radius) * (s / length);
            if (last >= 0.0 && s - last < ring_gap * radius) continue;
            last = s;
            stations.push_back({a.place + s * along, along, radius, start + s});
        }
    }

    void add_strip(const std::vector<Step>& steps) {
        Scaffold::Strip strip;
        strip.first = static_cast<std::uint32_t>(made_.quads.size());
        const std::uint32_t start = steps.front().from, end = steps.back().to;
        const bool closed = start == end && at_[start].size() == 2;
        std::vector<Station> stations;
        double at = 0.0, weighed = 0.0;
        for (std::size_t i = 0; i < steps.size(); ++i) {
            const Step& step = steps[i];
            const double length = glm::distance(node(step.from).place, node(step.to).place);
            if (forks_[step.from] == none) {
                glm::dvec3 along = direction(step.from, step.to);
                if (i > 0)
                    along = glm::normalize(along + direction(steps[i - 1].from, step.from));
                else if (closed)
                    along = glm::normalize(along + direction(steps.back().from, start));
                stations.push_back({node(step.from).place, along, node(step.from).radius, at});
            }
            add_between(stations, step, at);
            at += length;
            weighed += length * 0.5 * (node(step.from).radius + node(step.to).radius);
        }
        strip.length = at;
        strip.radius = weighed / at;
        if (forks_[end] == none && !closed)
            stations.push_back(
                {node(end).place, direction(steps.back().from, end), node(end).radius, at});
        add_rings(strip, steps, stations, closed);
    }

    void add_rings(Scaffold::Strip& strip, const std::vector<Step>& steps,
                   const std::vector<Station>& stations, bool closed) {
        const std::uint32_t start = steps.front().from, end = steps.back().to;
        glm::dvec3 along = direction(start, steps.front().to);
        std::array<std::uint32_t, 4> ring{};
        glm::dvec3 side;
        double at = 0.0;
        const bool from_fork = forks_[start] != none;
        if (from_fork) {
            ring = fork_ring(start, steps.front().limb, false, side);
        } else {
            along = stations.front().along;
            side = any_side(along);
        }
        // Carried along once to see by how much the frame misses the last ring.
        glm::dvec3 carried = side, before = along;
        for (const Station& station : stations) {
            carried = carry(carried, before, station.along);
            before = station.along;
        }
        glm::dvec3 wanted;
        std::array<std::uint32_t, 4> last{};
        const bool to_fork = forks_[end] != none;
        double miss = 0.0;
        std::size_t quarter = 0;
        if (to_fork) {
            last = fork_ring(end, steps.back().limb, true, wanted);
            const glm::dvec3 arriving = direction(steps.back().from, end);
            carried = carry(carried, before, arriving);
            before = arriving;
        } else if (closed) {
            carried = carry(carried, before, stations.front().along);
            before = stations.front().along;
            wanted = side;
        }
        if (to_fork || closed) {
            const glm::dvec3 third = glm::cross(before, carried);
            const double angle = arc_tangent(glm::dot(wanted, third), glm::dot(wanted, carried));
            const double turns = std::floor(angle / (0.5 * pi) + 0.5);
            miss = angle - turns * 0.5 * pi;
            quarter = static_cast<std::size_t>(static_cast<int>(turns) + 4) % 4;
        }

        std::array<std::uint32_t, 4> first_of_all{};
        before = along;
        carried = side;
        for (std::size_t i = 0; i < stations.size(); ++i) {
            const Station& station = stations[i];
            carried = carry(carried, before, station.along);
            before = station.along;
            const std::array<std::uint32_t, 4> next =
                ring_at(station, carried, miss * station.at / strip.length);
            if (i > 0 || from_fork)
                join(ring, next, at, station.at);
            else
                first_of_all = next;
            ring = next;
            at = station.at;
        }
        if (to_fork || closed) {
            const std::array<std::uint32_t, 4>& target = to_fork ? last : first_of_all;
            std::array<std::uint32_t, 4> turned{};
            for (std::size_t k = 0; k < 4; ++k) turned[k] = target[(k + 4 - quarter) % 4];
            join(ring, turned, at, strip.length);
        }
        const auto tube = static_cast<std::uint32_t>(made_.quads.size()) - strip.first;
        if (!from_fork && !closed) close(stations.front(), first_of_all, -1.0);
        if (!to_fork && !closed) close(stations.back(), ring, 1.0);
        finish(strip, tube);
    }

    // The corners that a fork lends to one of its limbs, counter-clockwise about the way that the strip goes; `side` points to the
    // first of them, across the limb.
    std::array<std::uint32_t, 4> fork_ring(std::uint32_t at, std::uint32_t limb, bool arriving,
                                           glm::dvec3& side) {
        const ForkPoints& points = fork_points_[forks_[at]];
        std::size_t k = 0;
        while (at_[at][points.fork.order[k]] != limb) ++k;
        const glm::dvec3 outwards = direction(at, other(limb, at));
        side = glm::normalize(glm::cross(points.fork.pole, outwards));
        const std::uint32_t left = points.crotch[k], right = points.crotch[(k + 2) % 3];
        if (arriving) return {left, points.down, right, points.up};
        return {left, points.up, right, points.down};
    }

    static glm::dvec3 any_side(const glm::dvec3& along) {
        const glm::dvec3 axis = std::abs(along.x) < 0.7 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 0, 1);
        return glm::normalize(axis - along * glm::dot(axis, along));
    }

    // The least turn that takes `from` to `to`, applied to a unit vector across `from`.
    static glm::dvec3 carry(const glm::dvec3& side, const glm::dvec3& from, const glm::dvec3& to) {
        const glm::dvec3 sum = from + to;
        const double size = 1.0 + glm::dot(from, to);
        glm::dvec3 carried = side;
        if (size > 1e-9) carried -= sum * (glm::dot(side, to) / size);
        carried -= to * glm::dot(to, carried);
        return glm::normalize(carried);
    }

    std::array<std::uint32_t, 4> ring_at(const Station& station, const glm::dvec3& side,
                                         double turn) {
        const SineCosine t = sine_cosine(turn);
        const glm::dvec3 third = glm::cross(station.along, side);
        const glm::dvec3 x = t.cosine * side + t.sine * third;
        const glm::dvec3 y = t.cosine * third - t.sine * side;
        const double r = factor_ * station.radius;
        std::array<std::uint32_t, 4> ring{};
        ring[0] = add(station.place + r * x);
        ring[1] = add(station.place + r * y);
        ring[2] = add(station.place - r * x);
        ring[3] = add(station.place - r * y);
        return ring;
    }

    void join(const std::array<std::uint32_t, 4>& a, const std::array<std::uint32_t, 4>& b,
              double from, double to) {
        for (std::size_t k = 0; k < 4; ++k) {
            const std::size_t n = (k + 1) % 4;
            const double u = 0.25 * static_cast<double>(k);
            made_.quads.push_back({a[k], a[n], b[n], b[k]});
            made_.places.push_back({{{u, from}, {u + 0.25, from}, {u + 0.25, to}, {u, to}}});
        }
    }

    // A smaller ring beyond the end, and a quad over it.
    void close(const Station& station, const std::array<std::uint32_t, 4>& ring, double way) {
        std::array<std::uint32_t, 4> tip{};
        for (std::size_t k = 0; k < 4; ++k)
            tip[k] = add(station.place + cap_size * (made_.points[ring[k]] - station.place) +
                         way * cap_height * station.radius * station.along);
        const double beyond = station.at + way * station.radius;
        if (way > 0.0) {
            join(ring, tip, station.at, beyond);
            cap(tip, beyond);
        } else {
            join(tip, ring, beyond, station.at);
            cap({tip[0], tip[3], tip[2], tip[1]}, beyond);
        }
    }

    void cap(const std::array<std::uint32_t, 4>& ring, double at) {
        made_.quads.push_back(ring);
        made_.places.push_back({{{0.0, at}, {0.25, at}, {0.25, at}, {0.0, at}}});
    }

    void finish(Scaffold::Strip& strip, std::uint32_t tube) {
        strip.quads = static_cast<std::uint32_t>(made_.quads.size()) - strip.first;
        strip.tube_quads = tube;
        made_.strips.push_back(strip);
    }

    const Skeleton& skeleton_;
    double factor_, ball_half_;
    std::vector<std::vector<std::uint32_t>> at_;
    std::vector<std::uint32_t> forks_;
    std::vector<ForkPoints> fork_points_;
    std::vector<bool> walked_;
    Scaffold made_;
};

}  // namespace

Scaffold scaffold(const Skeleton& clean, int levels) {
    std::vector<Problem> problems = broken_limits(clean);
    if (!problems.empty()) throw Impossible(std::move(problems));
    return Builder(clean, levels).build();
}

}  // namespace sporeprint
