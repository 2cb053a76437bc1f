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

// Nodes that lie on each other become one, in the middle by their number.
class Merger {
  public:
    Merger(const Skeleton& skeleton, double share) : nodes_(skeleton.nodes) {
        parent_.resize(nodes_.size());
        std::iota(parent_.begin(), parent_.end(), 0U);
        weight_.assign(nodes_.size(), 1.0);
        // A merged node lies elsewhere than its parts, so limbs that were long may have become short.
        for (bool merged = true; merged;) {
            merged = false;
            for (const Skeleton::Limb& limb : skeleton.limbs) {
                const std::uint32_t a = root(limb.from), b = root(limb.to);
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

// One end of a limb at its node.
struct End {
    std::uint32_t limb = 0;
    bool at_to = false;
};

// Decides which ends of limbs are cut off from their nodes.
class Cutter {
  public:
    Cutter(const Skeleton& skeleton, const SkinLimits& limits)
        : skeleton_(skeleton), limits_(limits), at_(skeleton.nodes.size()) {
        for (std::uint32_t i = 0; i < skeleton.limbs.size(); ++i) {
            at_[skeleton.limbs[i].from].push_back({i, false});
            at_[skeleton.limbs[i].to].push_back({i, true});
        }
        cosine_of_fork_ = cosine(radians(limits.fork_deg));
        cosine_of_bend_ = -cosine(radians(limits.bend_deg));
        reach_.assign(skeleton.limbs.size(), {0.0, 0.0});
    }

    // Calls give_way(node, end, why) for every end that breaks a limit, after which it is cut.
    void run(const auto& give_way) {
        std::deque<std::uint32_t> limbs;
        for (std::uint32_t node = 0; node < at_.size(); ++node) settle(node, give_way);
        for (std::uint32_t i = 0; i < skeleton_.limbs.size(); ++i) limbs.push_back(i);
        while (!limbs.empty()) {
            const std::uint32_t i = limbs.front();
            limbs.pop_front();
            const Skeleton::Limb& limb = skeleton_.limbs[i];
            const double from = radius(limb.from), to = radius(limb.to);
            const double before = reach_[i][0] * from, after = reach_[i][1] * to;
            if (length(i) >= before + after + limits_.clear * (from + to)) continue;
            if (before == 0.0 && after == 0.0) continue;
            const End end{i, after > before};
            const std::uint32_t node = node_of(end);
            give_way(node, end, "is too short to leave its forks");
            drop(node, end);
            settle(node, give_way);
            limbs.push_back(i);
            for (const End& other : at_[node]) limbs.push_back(other.limb);
        }
    }

    [[nodiscard]] const std::vector<std::vector<End>>& attached() const { return at_; }

  private:
    [[nodiscard]] double radius(std::uint32_t node) const { return skeleton_.nodes[node].radius; }
    [[nodiscard]] std::uint32_t node_of(const End& end) const {
        const Skeleton::Limb& limb = skeleton_.limbs[end.limb];
        return end.at_to ? limb.to : limb.from;
    }
    [[nodiscard]] std::uint32_t far_of(const End& end) const {
        return node_of({end.limb, !end.at_to});
    }
    [[nodiscard]] double length(std::uint32_t limb) const {
        return glm::distance(skeleton_.nodes[skeleton_.limbs[limb].from].place,
                             skeleton_.nodes[skeleton_.limbs[limb].to].place);
    }
    [[nodiscard]] glm::dvec3 direction(const End& end) const {
        return glm::normalize(skeleton_.nodes[far_of(end)].place -
                              skeleton_.nodes[node_of(end)].place);
    }

    void drop(std::uint32_t node, const End& end) {
        std::erase_if(at_[node], [&](const End& other) {
            return other.limb == end.limb && other.at_to == end.at_to;
        });
        reach_[end.limb][end.at_to ? 1 : 0] = 0.0;
    }

    // Cuts ends at a node until those that are left make a smooth one, and notes how far they reach.
    void settle(std::uint32_t node, const auto& give_way) {
        std::vector<End>& ends = at_[node];
        // The thickest first; of equals the first, so that what grew first goes on.
        std::stable_sort(ends.begin(), ends.end(), [&](const End& a, const End& b) {
            return radius(far_of(a)) > radius(far_of(b));
        });
        const auto cut = [&](std::size_t i, const char* why) {
            const End end = ends[i];
            give_way(node, end, why);
            drop(node, end);
        };
        while (ends.size() > 3) cut(3, "is the fourth of its node");
        if (ends.size() == 3 &&
            radius(far_of(ends[2])) <
                limits_.slender * std::min(radius(node), radius(far_of(ends[1]))))
            cut(2, "is much thinner than the others of its node");
        // A neck that widens at once would run into its neighbours.
        for (std::size_t i = ends.size(); i > 0 && ends.size() == 3; --i)
            if (limits_.slender * radius(far_of(ends[i - 1])) > radius(node))
                cut(i - 1, "is much thicker than its fork");
        for (bool again = true; again;) {
            again = false;
            const double sharpest = ends.size() == 3 ? cosine_of_fork_ : cosine_of_bend_;
            for (std::size_t j = ends.size(); j > 1 && !again; --j)
                for (std::size_t i = 0; i + 1 < j && !again; ++i)
                    if (glm::dot(direction(ends[i]), direction(ends[j - 1])) > sharpest) {
                        cut(j - 1, "stands at too sharp an angle to another");
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
                cut(2, "leans too far to the side of the others");
                settle(node, give_way);
                return;
            }
            for (std::size_t k = 0; k < 3; ++k) {
                const End& end = ends[fork.order[k]];
                note(end, reach_of(fork, directions[fork.order[k]], k, factor));
            }
        } else if (ends.size() == 2) {
            const double reach = bend_reach(directions[0], directions[1], factor);
            for (const End& end : ends) note(end, reach);
        } else {
            for (const End& end : ends) note(end, 0.0);
        }
    }
    void note(const End& end, double reach) { reach_[end.limb][end.at_to ? 1 : 0] = reach; }

    const Skeleton& skeleton_;
    SkinLimits limits_;
    double cosine_of_fork_, cosine_of_bend_;
    std::vector<std::vector<End>> at_;
    std::vector<std::array<double, 2>> reach_;  // of each limb at from and to, in radii of the node
};

}  // namespace

std::vector<Problem> faults_of(const Skeleton& skeleton) {
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
    for (std::size_t i = 0; i < skeleton.limbs.size(); ++i)
        for (const std::uint32_t node : {skeleton.limbs[i].from, skeleton.limbs[i].to})
            if (node >= skeleton.nodes.size()) {
                report(problems, "/limbs/" + std::to_string(i),
                       "goes to node " + std::to_string(node) + "; there are " +
                           std::to_string(skeleton.nodes.size()));
                break;
            }
    return problems;
}

CleanSkeleton cleaned(const Skeleton& skeleton, const SkinLimits& limits) {
    std::vector<Problem> problems = faults_of(skeleton);
    if (!problems.empty()) throw InvalidInput(std::move(problems));
    Merger merger(skeleton, limits.merge);
    CleanSkeleton result;
    Skeleton& made = result.skeleton;
    std::vector<std::uint32_t> number(skeleton.nodes.size());
    for (std::uint32_t i = 0; i < skeleton.nodes.size(); ++i) {
        if (merger.root(i) != i) continue;
        number[i] = static_cast<std::uint32_t>(made.nodes.size());
        made.nodes.push_back(merger.node(i));
    }
    for (std::uint32_t i = 0; i < skeleton.nodes.size(); ++i)
        result.node_of.push_back(number[merger.root(i)]);
    std::vector<std::pair<Skeleton::Limb, std::uint32_t>> limbs;
    for (std::uint32_t i = 0; i < skeleton.limbs.size(); ++i) {
        const std::uint32_t a = result.node_of[skeleton.limbs[i].from];
        const std::uint32_t b = result.node_of[skeleton.limbs[i].to];
        if (a != b) limbs.push_back({{std::min(a, b), std::max(a, b)}, i});
    }
    // Of limbs between the same nodes the first stays.
    std::sort(limbs.begin(), limbs.end(), [](const auto& a, const auto& b) {
        return std::pair(a.first.from, a.first.to) < std::pair(b.first.from, b.first.to) ||
               (a.first == b.first && a.second < b.second);
    });
    limbs.erase(std::unique(limbs.begin(), limbs.end(),
                            [](const auto& a, const auto& b) { return a.first == b.first; }),
                limbs.end());
    std::sort(limbs.begin(), limbs.end(),
              [](const auto& a, const auto& b) { return a.second < b.second; });
    for (const auto& [limb, original] : limbs) {
        const std::uint32_t from = result.node_of[skeleton.limbs[original].from];
        made.limbs.push_back({from, limb.from == from ? limb.to : limb.from});
    }

    std::vector<End> cuts;
    Cutter cutter(made, limits);
    cutter.run([&](std::uint32_t, const End& end, const char*) { cuts.push_back(end); });
    for (const End& end : cuts) {
        Skeleton::Limb& limb = made.limbs[end.limb];
        std::uint32_t& here = end.at_to ? limb.to : limb.from;
        const std::uint32_t there = end.at_to ? limb.from : limb.to;
        // A twig leaves a trunk as thick as it goes on.
        Skeleton::Node root = made.nodes[here];
        root.radius = std::min(root.radius, made.nodes[there].radius);
        here = static_cast<std::uint32_t>(made.nodes.size());
        made.nodes.push_back(root);
    }
    return result;
}

std::vector<Problem> broken_limits(const Skeleton& skeleton, const SkinLimits& limits) {
    std::vector<Problem> problems = faults_of(skeleton);
    if (!problems.empty()) return problems;
    for (std::size_t i = 0; i < skeleton.limbs.size(); ++i) {
        const Skeleton::Node& from = skeleton.nodes[skeleton.limbs[i].from];
        const Skeleton::Node& to = skeleton.nodes[skeleton.limbs[i].to];
        if (glm::distance(from.place, to.place) < limits.merge * (from.radius + to.radius))
            report(problems, "/limbs/" + std::to_string(i), "joins nodes that lie on each other");
    }
    if (!problems.empty()) return problems;
    Cutter cutter(skeleton, limits);
    cutter.run([&](std::uint32_t node, const End& end, const char* why) {
        report(problems, "/limbs/" + std::to_string(end.limb),
               std::string(why) + ", at node " + std::to_string(node));
    });
    return problems;
}

}  // namespace sporeprint
