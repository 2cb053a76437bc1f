#include "core/skeleton/skeleton.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <glm/geometric.hpp>
#include <numeric>
#include <string>
#include <utility>

#include "core/math/elementary.h"
#include "core/params/messages.h"
#include "core/skeleton/fork.h"

namespace sporeprint {

namespace {

constexpr double largest_place = 1e4, smallest_radius = 1e-6, largest_radius = 1e3;

// Merges coincident nodes at their mean position.
class Merger {
  public:
    Merger(const Skeleton& skeleton, double share) : nodes_(skeleton.nodes) {
        parent_.resize(nodes_.size());
        std::iota(parent_.begin(), parent_.end(), 0U);
        weight_.assign(nodes_.size(), 1.0);
        // A merged node is not where its parts were, so other segments may have become too short.
        for (bool merged = true; merged;) {
            merged = false;
            for (const Skeleton::Segment& segment : skeleton.segments) {
                const std::uint32_t a = root(segment.from), b = root(segment.to);
                if (a == b) continue;
                const double length = glm::distance(nodes_[a].place, nodes_[b].place);
                if (length >= share * (nodes_[a].radius + nodes_[b].radius)) continue;
                join(std::min(a, b), std::max(a, b));
                merged = true;
            }
        }
    }

    std::uint32_t root(std::uint32_t node) {
        while (parent_[node] != node) node = parent_[node] = parent_[parent_[node]];
        return node;
    }
    [[nodiscard]] const Skeleton::Node& node(std::uint32_t root) const { return nodes_[root]; }

  private:
    void join(std::uint32_t a, std::uint32_t b) {
        const double share = weight_[b] / (weight_[a] + weight_[b]);
        nodes_[a].place += share * (nodes_[b].place - nodes_[a].place);
        nodes_[a].radius += share * (nodes_[b].radius - nodes_[a].radius);
        weight_[a] += weight_[b];
        parent_[b] = a;
    }

    std::vector<Skeleton::Node> nodes_;
    std::vector<std::uint32_t> parent_;
    std::vector<double> weight_;
};

// One end of a segment at its node.
struct End {
    std::uint32_t segment = 0;
    bool at_to = false;
};

// Finds the ends of segments that have to be detached from their nodes.
class Detacher {
  public:
    Detacher(const Skeleton& skeleton, const SkinLimits& limits)
        : skeleton_(skeleton), limits_(limits), at_(skeleton.nodes.size()) {
        for (std::uint32_t i = 0; i < skeleton.segments.size(); ++i) {
            at_[skeleton.segments[i].from].push_back({i, false});
            at_[skeleton.segments[i].to].push_back({i, true});
        }
        cosine_of_fork_ = cosine(radians(limits.fork_deg));
        cosine_of_bend_ = -cosine(radians(limits.bend_deg));
        reach_.assign(skeleton.segments.size(), {0.0, 0.0});
    }

    // Calls on_detach(node, end, why) for every end that breaks a limit, then detaches it.
    void run(const auto& on_detach) {
        std::deque<std::uint32_t> segments;
        for (std::uint32_t node = 0; node < at_.size(); ++node) resolve_node(node, on_detach);
        for (std::uint32_t i = 0; i < skeleton_.segments.size(); ++i) segments.push_back(i);
        while (!segments.empty()) {
            const std::uint32_t i = segments.front();
            segments.pop_front();
            const Skeleton::Segment& segment = skeleton_.segments[i];
            const double from = radius(segment.from), to = radius(segment.to);
            const double before = reach_[i][0] * from, after = reach_[i][1] * to;
            if (length(i) >= before + after + limits_.clear * (from + to)) continue;
            if (before == 0.0 && after == 0.0) continue;
            const End end{i, after > before};
            const std::uint32_t node = node_of(end);
            on_detach(node, end, "is too short to leave its forks");
            detach(node, end);
            resolve_node(node, on_detach);
            segments.push_back(i);
            for (const End& other : at_[node]) segments.push_back(other.segment);
        }
    }

    [[nodiscard]] const std::vector<std::vector<End>>& attached() const { return at_; }

  private:
    [[nodiscard]] double radius(std::uint32_t node) const { return skeleton_.nodes[node].radius; }
    [[nodiscard]] std::uint32_t node_of(const End& end) const {
        const Skeleton::Segment& segment = skeleton_.segments[end.segment];
        return end.at_to ? segment.to : segment.from;
    }
    [[nodiscard]] std::uint32_t other_node(const End& end) const {
        return node_of({end.segment, !end.at_to});
    }
    [[nodiscard]] double length(std::uint32_t segment) const {
        return glm::distance(skeleton_.nodes[skeleton_.segments[segment].from].place,
                             skeleton_.nodes[skeleton_.segments[segment].to].place);
    }
    [[nodiscard]] glm::dvec3 direction(const End& end) const {
        return glm::normalize(skeleton_.nodes[other_node(end)].place -
                              skeleton_.nodes[node_of(end)].place);
    }

    void detach(std::uint32_t node, const End& end) {
        std::erase_if(at_[node], [&](const End& other) {
            return other.segment == end.segment && other.at_to == end.at_to;
        });
        reach_[end.segment][end.at_to ? 1 : 0] = 0.0;
    }

    // Detaches ends at a node until the others make a smooth one, and records their reach.
    void resolve_node(std::uint32_t node, const auto& on_detach) {
        std::vector<End>& ends = at_[node];
        // Thicker ends come first and equal ones keep their order, so that older segments stay
        // attached.
        std::stable_sort(ends.begin(), ends.end(), [&](const End& a, const End& b) {
            return radius(other_node(a)) > radius(other_node(b));
        });
        const auto detach_end = [&](std::size_t i, const char* why) {
            const End end = ends[i];
            on_detach(node, end, why);
            detach(node, end);
        };
        while (ends.size() > 3) detach_end(3, "is the fourth of its node");
        if (ends.size() == 3 &&
            radius(other_node(ends[2])) <
                limits_.slender * std::min(radius(node), radius(other_node(ends[1]))))
            detach_end(2, "is much thinner than the others of its node");
        // A neck that widens at once would intersect its neighbours.
        for (std::size_t i = ends.size(); i > 0 && ends.size() == 3; --i)
            if (limits_.slender * radius(other_node(ends[i - 1])) > radius(node))
                detach_end(i - 1, "is much thicker than its fork");
        for (bool again = true; again;) {
            again = false;
            const double sharpest = ends.size() == 3 ? cosine_of_fork_ : cosine_of_bend_;
            for (std::size_t j = ends.size(); j > 1 && !again; --j)
                for (std::size_t i = 0; i + 1 < j && !again; ++i)
                    if (glm::dot(direction(ends[i]), direction(ends[j - 1])) > sharpest) {
                        detach_end(j - 1, "stands at too sharp an angle to another");
                        again = true;
                    }
        }
        std::vector<glm::dvec3> directions;
        directions.reserve(ends.size());
        for (const End& end : ends) directions.push_back(direction(end));
        constexpr double factor = tube_factor(judged_levels);
        if (ends.size() == 3) {
            const Fork fork = fork_of({directions[0], directions[1], directions[2]}, factor);
            if (fork.cone > limits_.cone) {
                detach_end(2, "leans too far to the side of the others");
                resolve_node(node, on_detach);
                return;
            }
            for (std::size_t k = 0; k < 3; ++k) {
                const End& end = ends[fork.order[k]];
                set_reach(end, reach_of(fork, directions[fork.order[k]], k, factor));
            }
        } else if (ends.size() == 2) {
            const double reach = bend_reach(directions[0], directions[1], factor);
            for (const End& end : ends) set_reach(end, reach);
        } else {
            for (const End& end : ends) set_reach(end, 0.0);
        }
    }
    void set_reach(const End& end, double reach) { reach_[end.segment][end.at_to ? 1 : 0] = reach; }

    const Skeleton& skeleton_;
    SkinLimits limits_;
    double cosine_of_fork_, cosine_of_bend_;
    std::vector<std::vector<End>> at_;
    // of each segment at from and to, in radii of the node
    std::vector<std::array<double, 2>> reach_;
};

}  // namespace

std::vector<Problem> validation_errors(const Skeleton& skeleton) {
    std::vector<Problem> problems;
    if (skeleton.nodes.size() > most_skeleton_nodes)
        report(problems, "/nodes",
               std::to_string(skeleton.nodes.size()) + " nodes; at most " +
                   std::to_string(most_skeleton_nodes) + " are skinned");
    for (std::size_t i = 0; i < skeleton.nodes.size(); ++i) {
        const Skeleton::Node& node = skeleton.nodes[i];
        const std::string path = "/nodes/" + std::to_string(i);
        for (const double x : {node.place.x, node.place.y, node.place.z})
            if (!(std::abs(x) <= largest_place)) {
                report(problems, path + "/place",
                       number_text(x) + " is outside -" + number_text(largest_place) + ".." +
                           number_text(largest_place) + " m");
                break;
            }
        if (!(node.radius >= smallest_radius && node.radius <= largest_radius))
            report(problems, path + "/radius",
                   number_text(node.radius) + " is outside " + number_text(smallest_radius) + ".." +
                       number_text(largest_radius) + " m");
    }
    for (std::size_t i = 0; i < skeleton.segments.size(); ++i)
        for (const std::uint32_t node : {skeleton.segments[i].from, skeleton.segments[i].to})
            if (node >= skeleton.nodes.size()) {
                report(problems, "/limbs/" + std::to_string(i),
                       "goes to node " + std::to_string(node) + "; there are " +
                           std::to_string(skeleton.nodes.size()));
                break;
            }
    return problems;
}

CleanSkeleton cleaned(const Skeleton& skeleton, const SkinLimits& limits) {
    std::vector<Problem> problems = validation_errors(skeleton);
    if (!problems.empty()) throw InvalidInput(std::move(problems));
    Merger merger(skeleton, limits.merge);
    CleanSkeleton result;
    Skeleton& clean = result.skeleton;
    std::vector<std::uint32_t> number(skeleton.nodes.size());
    for (std::uint32_t i = 0; i < skeleton.nodes.size(); ++i) {
        if (merger.root(i) != i) continue;
        number[i] = static_cast<std::uint32_t>(clean.nodes.size());
        clean.nodes.push_back(merger.node(i));
    }
    for (std::uint32_t i = 0; i < skeleton.nodes.size(); ++i)
        result.node_of.push_back(number[merger.root(i)]);
    std::vector<std::pair<Skeleton::Segment, std::uint32_t>> segments;
    for (std::uint32_t i = 0; i < skeleton.segments.size(); ++i) {
        const std::uint32_t a = result.node_of[skeleton.segments[i].from];
        const std::uint32_t b = result.node_of[skeleton.segments[i].to];
        if (a != b) segments.push_back({{std::min(a, b), std::max(a, b)}, i});
    }
    // Only the first of several segments between the same nodes remains.
    std::sort(segments.begin(), segments.end(), [](const auto& a, const auto& b) {
        return std::pair(a.first.from, a.first.to) < std::pair(b.first.from, b.first.to) ||
               (a.first == b.first && a.second < b.second);
    });
    segments.erase(std::unique(segments.begin(), segments.end(),
                               [](const auto& a, const auto& b) { return a.first == b.first; }),
                   segments.end());
    std::sort(segments.begin(), segments.end(),
              [](const auto& a, const auto& b) { return a.second < b.second; });
    for (const auto& [segment, original] : segments) {
        const std::uint32_t from = result.node_of[skeleton.segments[original].from];
        clean.segments.push_back({from, segment.from == from ? segment.to : segment.from,
                                  skeleton.segments[original].label});
    }

    std::vector<End> detached;
    Detacher detacher(clean, limits);
    detacher.run([&](std::uint32_t, const End& end, const char*) { detached.push_back(end); });
    for (const End& end : detached) {
        Skeleton::Segment& segment = clean.segments[end.segment];
        std::uint32_t& here = end.at_to ? segment.to : segment.from;
        const std::uint32_t there = end.at_to ? segment.from : segment.to;
        // A detached twig starts with its own thickness, not the trunk's.
        Skeleton::Node root = clean.nodes[here];
        root.radius = std::min(root.radius, clean.nodes[there].radius);
        here = static_cast<std::uint32_t>(clean.nodes.size());
        clean.nodes.push_back(root);
    }
    return result;
}

std::vector<Problem> broken_limits(const Skeleton& skeleton, const SkinLimits& limits) {
    std::vector<Problem> problems = validation_errors(skeleton);
    if (!problems.empty()) return problems;
    for (std::size_t i = 0; i < skeleton.segments.size(); ++i) {
        const Skeleton::Node& from = skeleton.nodes[skeleton.segments[i].from];
        const Skeleton::Node& to = skeleton.nodes[skeleton.segments[i].to];
        if (glm::distance(from.place, to.place) < limits.merge * (from.radius + to.radius))
            report(problems, "/limbs/" + std::to_string(i), "joins nodes that lie on each other");
    }
    if (!problems.empty()) return problems;
    Detacher detacher(skeleton, limits);
    detacher.run([&](std::uint32_t node, const End& end, const char* why) {
        report(problems, "/limbs/" + std::to_string(end.segment),
               std::string(why) + ", at node " + std::to_string(node));
    });
    return problems;
}

}  // namespace sporeprint
