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

// Distances in radii from the end of a fork or bend to the next rings. At the second ring of a fork
// the influence of its crotches on the surface has faded.
constexpr double first_ring = 0.7, second_ring = 1.45;
// Rings nearer to each other than this are merged, in radii.
constexpr double ring_gap = 0.7;
// Bends and changes of slope of the radius below these need no rings of their own.
constexpr double gentle_bend_cosine = 0.8192;  // 35 degrees
constexpr double gentle_kink = 0.1;
// An end is closed by a smaller ring beyond it: height and size in radii.
constexpr double cap_height = 0.7, cap_size = 0.62;

// Returns half the side of the cube whose subdivided surface has the volume of a ball of radius 1.
constexpr double ball_half(int levels) {
    constexpr std::array<double, 4> halves = {0.806, 1.0702, 1.1437, 1.1625};
    return halves[static_cast<std::size_t>(levels)];
}

// The control points of a fork as indices of points of the scaffold.
struct ForkPoints {
    Fork fork;
    std::uint32_t up = 0, down = 0;
    std::array<std::uint32_t, 3> crotch{};
};

struct Step {
    std::uint32_t segment = 0, from = 0, to = 0;
};

// A ring to be built: its centre, its axis and its radius.
struct Station {
    glm::dvec3 place{0.0}, along{0.0};
    double radius = 0.0, at = 0.0;  // of the skin; metres along the strip
    std::uint32_t label = 0;        // of the segment before it; of the first one, after it
};

class Builder {
  public:
    Builder(const Skeleton& skeleton, int levels)
        : skeleton_(skeleton),
          flat_(levels == 0),
          factor_(tube_factor(levels)),
          ball_half_(ball_half(levels)),
          segments_at_(skeleton.nodes.size()),
          forks_(skeleton.nodes.size(), none),
          visited_(skeleton.segments.size(), false) {
        for (std::uint32_t i = 0; i < skeleton.segments.size(); ++i) {
            segments_at_[skeleton.segments[i].from].push_back(i);
            segments_at_[skeleton.segments[i].to].push_back(i);
        }
    }

    Scaffold build() {
        for (std::uint32_t node = 0; node < segments_at_.size(); ++node)
            if (segments_at_[node].size() == 3) add_fork(node);
        for (std::uint32_t node = 0; node < segments_at_.size(); ++node) {
            if (segments_at_[node].empty()) add_ball(node);
            if (segments_at_[node].size() == 2) continue;
            for (const std::uint32_t segment : segments_at_[node])
                if (!visited_[segment]) add_strip(trace_strip(node, segment));
        }
        // The remaining segments form closed loops without fork or end.
        for (std::uint32_t segment = 0; segment < visited_.size(); ++segment)
            if (!visited_[segment])
                add_strip(trace_strip(skeleton_.segments[segment].from, segment));
        return std::move(result_);
    }

  private:
    [[nodiscard]] const Skeleton::Node& node(std::uint32_t i) const { return skeleton_.nodes[i]; }
    [[nodiscard]] std::uint32_t other(std::uint32_t segment, std::uint32_t from) const {
        const Skeleton::Segment& one = skeleton_.segments[segment];
        return one.from == from ? one.to : one.from;
    }
    [[nodiscard]] glm::dvec3 direction(std::uint32_t from, std::uint32_t to) const {
        return glm::normalize(node(to).place - node(from).place);
    }

    std::uint32_t add(const glm::dvec3& point) {
        result_.points.push_back(point);
        return static_cast<std::uint32_t>(result_.points.size() - 1);
    }

    void add_fork(std::uint32_t at) {
        std::array<glm::dvec3, 3> directions;
        for (std::size_t i = 0; i < 3; ++i)
            directions[i] = direction(at, other(segments_at_[at][i], at));
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
        strip.first = static_cast<std::uint32_t>(result_.quads.size());
        strip.radius = node(at).radius;
        std::array<std::uint32_t, 8> corner{};
        for (std::uint32_t i = 0; i < 8; ++i)
            corner[i] =
                add(node(at).place + half * glm::dvec3((i & 1) != 0 ? 1 : -1, (i & 2) != 0 ? 1 : -1,
                                                       (i & 4) != 0 ? 1 : -1));
        constexpr std::array<std::array<std::size_t, 4>, 6> faces = {
            {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}}};
        for (const auto& face : faces)
            cap({corner[face[0]], corner[face[1]], corner[face[2]], corner[face[3]]}, 0.0, 0);
        finish(strip, 0);
    }

    std::vector<Step> trace_strip(std::uint32_t start, std::uint32_t segment) {
        std::vector<Step> steps;
        std::uint32_t here = start;
        for (;;) {
            visited_[segment] = true;
            const std::uint32_t next = other(segment, here);
            steps.push_back({segment, here, next});
            here = next;
            if (segments_at_[here].size() != 2 || here == start) break;
            segment =
                segments_at_[here][0] == segment ? segments_at_[here][1] : segments_at_[here][0];
            if (visited_[segment]) break;
        }
        return steps;
    }

    // Returns how much of a segment from `at` the fork or bend at `at` occupies, in metres; 0 at an
    // end and where the skin is undisturbed.
    double occupied_length(std::uint32_t at, std::uint32_t segment) {
        const std::vector<std::uint32_t>& segments = segments_at_[at];
        const glm::dvec3 here = direction(at, other(segment, at));
        if (segments.size() == 3) {
            const Fork& fork = fork_points_[forks_[at]].fork;
            for (std::size_t k = 0; k < 3; ++k)
                if (segments[fork.order[k]] == segment)
                    return node(at).radius * reach_of(fork, here, k, factor_);
        }
        if (segments.size() == 2) {
            const std::uint32_t second = segments[0] == segment ? segments[1] : segments[0];
            return node(at).radius * bend_reach(here, direction(at, other(second, at)), factor_);
        }
        return 0.0;
    }

    // Returns true if the node's own ring suffices to keep the radii on both sides.
    bool is_smooth_node(std::uint32_t at) const {
        if (segments_at_[at].size() != 2) return false;
        const std::uint32_t a = other(segments_at_[at][0], at), b = other(segments_at_[at][1], at);
        const double length_a = glm::distance(node(a).place, node(at).place);
        const double length_b = glm::distance(node(b).place, node(at).place);
        const double straight =
            (node(a).radius * length_b + node(b).radius * length_a) / (length_a + length_b);
        return -glm::dot(direction(at, a), direction(at, b)) > gentle_bend_cosine &&
               std::abs(straight - node(at).radius) < gentle_kink * node(at).radius;
    }

    // Adds the rings of one segment between those of its nodes, in order.
    void add_between(std::vector<Station>& stations, const Step& step, double start) {
        const Skeleton::Node &a = node(step.from), &b = node(step.to);
        const double length = glm::distance(a.place, b.place);
        const glm::dvec3 along = direction(step.from, step.to);
        const double low = occupied_length(step.from, step.segment);
        const double high = length - occupied_length(step.to, step.segment);
        std::vector<double> places;
        // A surface that is not subdivided goes through its rings: only a fork needs one more, where
        // its faces become a tube.
        const auto needs = [&](std::uint32_t at, bool second) {
            return forks_[at] != none ? !(flat_ && second)
                                      : !flat_ && !second && !is_smooth_node(at);
        };
        if (needs(step.from, false)) places.push_back(low + first_ring * a.radius);
        if (needs(step.from, true)) places.push_back(low + second_ring * a.radius);
        if (needs(step.to, true)) places.push_back(high - second_ring * b.radius);
        if (needs(step.to, false)) places.push_back(high - first_ring * b.radius);
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
            stations.push_back({a.place + s * along, along, radius, start + s, label(step)});
        }
    }

    [[nodiscard]] std::uint32_t label(const Step& step) const {
        return skeleton_.segments[step.segment].label;
    }

    void add_strip(const std::vector<Step>& steps) {
        Scaffold::Strip strip;
        strip.first = static_cast<std::uint32_t>(result_.quads.size());
        const std::uint32_t start = steps.front().from, end = steps.back().to;
        const bool closed = start == end && segments_at_[start].size() == 2;
        std::vector<Station> stations;
        double at = 0.0, weighted_radius = 0.0;
        for (std::size_t i = 0; i < steps.size(); ++i) {
            const Step& step = steps[i];
            const double length = glm::distance(node(step.from).place, node(step.to).place);
            if (forks_[step.from] == none) {
                glm::dvec3 along = direction(step.from, step.to);
                if (i > 0)
                    along = glm::normalize(along + direction(steps[i - 1].from, step.from));
                else if (closed)
                    along = glm::normalize(along + direction(steps.back().from, start));
                stations.push_back({node(step.from).place, along, node(step.from).radius, at,
                                    label(steps[i > 0 ? i - 1 : i])});
            }
            add_between(stations, step, at);
            at += length;
            weighted_radius += length * 0.5 * (node(step.from).radius + node(step.to).radius);
        }
        strip.length = at;
        strip.radius = weighted_radius / at;
        if (forks_[end] == none && !closed)
            stations.push_back({node(end).place, direction(steps.back().from, end),
                                node(end).radius, at, label(steps.back())});
        add_rings(strip, steps, stations, closed);
    }

    // The angle by which a frame that is transported along a strip misses its last ring: quarter
    // turns, by which corners are shifted, and the rest, radians, which is spread over the strip.
    struct Twist {
        double rest = 0.0;
        std::size_t quarters = 0;
    };

    // Returns the twist of the frame `side` about `along` at the begin of a strip against the frame
    // `target` about `arriving` at its end.
    static Twist twist_between(const std::vector<Station>& stations, glm::dvec3 along,
                               glm::dvec3 side, const glm::dvec3& arriving,
                               const glm::dvec3& target) {
        for (const Station& station : stations) {
            side = transport(side, along, station.along);
            along = station.along;
        }
        side = transport(side, along, arriving);
        const glm::dvec3 third = glm::cross(arriving, side);
        const double angle = arc_tangent(glm::dot(target, third), glm::dot(target, side));
        const double turns = std::floor(angle / (0.5 * pi) + 0.5);
        return {angle - turns * 0.5 * pi,
                static_cast<std::size_t>(static_cast<int>(turns) + 4) % 4};
    }

    void add_rings(Scaffold::Strip& strip, const std::vector<Step>& steps,
                   const std::vector<Station>& stations, bool closed) {
        const std::uint32_t start = steps.front().from, end = steps.back().to;
        const bool from_fork = forks_[start] != none, to_fork = forks_[end] != none;
        glm::dvec3 along = direction(start, steps.front().to), side;
        std::array<std::uint32_t, 4> ring{}, first{}, last{};
        if (from_fork) {
            ring = fork_ring(start, steps.front().segment, false, side);
        } else {
            along = stations.front().along;
            side = any_side(along);
        }
        Twist twist;
        if (to_fork) {
            glm::dvec3 target;
            last = fork_ring(end, steps.back().segment, true, target);
            twist = twist_between(stations, along, side, direction(steps.back().from, end), target);
        } else if (closed) {
            twist = twist_between(stations, along, side, stations.front().along, side);
        }
        double at = 0.0;
        for (std::size_t i = 0; i < stations.size(); ++i) {
            const Station& station = stations[i];
            side = transport(side, along, station.along);
            along = station.along;
            const std::array<std::uint32_t, 4> next =
                ring_at(station, side, twist.rest * station.at / strip.length);
            if (i > 0 || from_fork)
                join(ring, next, at, station.at, station.label);
            else
                first = next;
            ring = next;
            at = station.at;
        }
        if (to_fork || closed) {
            const std::array<std::uint32_t, 4>& target = to_fork ? last : first;
            std::array<std::uint32_t, 4> turned{};
            for (std::size_t k = 0; k < 4; ++k) turned[k] = target[(k + 4 - twist.quarters) % 4];
            join(ring, turned, at, strip.length, label(steps.back()));
        }
        const auto tube = static_cast<std::uint32_t>(result_.quads.size()) - strip.first;
        if (!from_fork && !closed) close(stations.front(), first, -1.0);
        if (!to_fork && !closed) close(stations.back(), ring, 1.0);
        finish(strip, tube);
    }

    // Returns the corners of a fork that belong to one of its segments, counter-clockwise about the
    // direction of the strip; `side` is set to the direction of the first of them, perpendicular to
    // the segment.
    std::array<std::uint32_t, 4> fork_ring(std::uint32_t at, std::uint32_t segment, bool arriving,
                                           glm::dvec3& side) {
        const ForkPoints& points = fork_points_[forks_[at]];
        std::size_t k = 0;
        while (segments_at_[at][points.fork.order[k]] != segment) ++k;
        const glm::dvec3 outwards = direction(at, other(segment, at));
        side = glm::normalize(glm::cross(points.fork.pole, outwards));
        const std::uint32_t left = points.crotch[k], right = points.crotch[(k + 2) % 3];
        if (arriving) return {left, points.down, right, points.up};
        return {left, points.up, right, points.down};
    }

    static glm::dvec3 any_side(const glm::dvec3& along) {
        const glm::dvec3 axis = std::abs(along.x) < 0.7 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 0, 1);
        return glm::normalize(axis - along * glm::dot(axis, along));
    }

    // Applies the smallest rotation that takes `from` to `to` to a unit vector perpendicular to
    // `from`.
    static glm::dvec3 transport(const glm::dvec3& side, const glm::dvec3& from,
                                const glm::dvec3& to) {
        const glm::dvec3 sum = from + to;
        const double size = 1.0 + glm::dot(from, to);
        glm::dvec3 transported = side;
        if (size > 1e-9) transported -= sum * (glm::dot(side, to) / size);
        transported -= to * glm::dot(to, transported);
        return glm::normalize(transported);
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
              double from, double to, std::uint32_t label) {
        result_.labels.insert(result_.labels.end(), 4, label);
        for (std::size_t k = 0; k < 4; ++k) {
            const std::size_t n = (k + 1) % 4;
            const double u = 0.25 * static_cast<double>(k);
            result_.quads.push_back({a[k], a[n], b[n], b[k]});
            result_.places.push_back({{{u, from}, {u + 0.25, from}, {u + 0.25, to}, {u, to}}});
        }
    }

    // Closes an end with a smaller ring beyond it and a quad over that; without subdivision, with
    // the quad alone.
    void close(const Station& station, const std::array<std::uint32_t, 4>& ring, double sign) {
        if (flat_) {
            const bool is_end = sign > 0.0;
            cap(is_end ? ring : std::array{ring[0], ring[3], ring[2], ring[1]}, station.at,
                station.label);
            return;
        }
        std::array<std::uint32_t, 4> tip{};
        for (std::size_t k = 0; k < 4; ++k)
            tip[k] = add(station.place + cap_size * (result_.points[ring[k]] - station.place) +
                         sign * cap_height * station.radius * station.along);
        const double beyond = station.at + sign * station.radius;
        if (sign > 0.0) {
            join(ring, tip, station.at, beyond, station.label);
            cap(tip, beyond, station.label);
        } else {
            join(tip, ring, beyond, station.at, station.label);
            cap({tip[0], tip[3], tip[2], tip[1]}, beyond, station.label);
        }
    }

    void cap(const std::array<std::uint32_t, 4>& ring, double at, std::uint32_t label) {
        result_.labels.push_back(label);
        result_.quads.push_back(ring);
        result_.places.push_back({{{0.0, at}, {0.25, at}, {0.25, at}, {0.0, at}}});
    }

    void finish(Scaffold::Strip& strip, std::uint32_t tube) {
        strip.quads = static_cast<std::uint32_t>(result_.quads.size()) - strip.first;
        strip.tube_quads = tube;
        result_.strips.push_back(strip);
    }

    const Skeleton& skeleton_;
    bool flat_;  // whether the surface is not subdivided
    double factor_, ball_half_;
    std::vector<std::vector<std::uint32_t>> segments_at_;
    std::vector<std::uint32_t> forks_;
    std::vector<ForkPoints> fork_points_;
    std::vector<bool> visited_;
    Scaffold result_;
};

}  // namespace

Scaffold scaffold(const Skeleton& clean, int levels) {
    std::vector<Problem> problems = broken_limits(clean);
    if (!problems.empty()) throw Impossible(std::move(problems));
    return Builder(clean, levels).build();
}

}  // namespace sporeprint
