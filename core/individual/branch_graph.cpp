#include "core/individual/branch_graph.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "core/individual/damage.h"
#include "core/math/direction.h"
#include "core/math/elementary.h"
#include "core/math/purposes.h"
#include "core/math/random.h"
#include "core/params/messages.h"

namespace sporeprint {

namespace {

constexpr std::uint32_t none = BranchGraph::none;
constexpr glm::dvec3 upwards(0.0, 1.0, 0.0);
// Factor on the length of the segment between the two forks of a whorl.
constexpr double whorl_rest = 0.06;

// Random draws of a node. They depend on its path from the root only and are equal for all species,
// but for what slugs eat.
struct NodeDraws {
    double length, angle, azimuth, x, y, z, side, onset, depth;
    BranchGraph::Gnarl gnarl;
};

NodeDraws draws_of(std::uint32_t seed, const SeedShares& damage, std::uint32_t path) {
    Random random(seed, purposes::branch_segments, path);
    NodeDraws d{};
    d.length = random.symmetric();
    d.angle = random.symmetric();
    d.azimuth = random.symmetric();
    d.x = random.symmetric();
    d.y = random.symmetric();
    d.z = random.symmetric();
    d.side = random.symmetric() < 0.0 ? -1.0 : 1.0;
    d.gnarl.bend = random.uniform(0.0, 2.0 * pi);
    d.gnarl.swing = random.uniform(0.0, 2.0 * pi);
    d.gnarl.lump = random.symmetric();
    d.gnarl.knee = random.symmetric();
    d.gnarl.colour = random.symmetric();
    MixedRandom eaten(damage, purposes::eaten_tips, path);
    d.onset = eaten.uniform();
    d.depth = eaten.uniform(0.35, 0.95);
    return d;
}

// Returns the identifier of the path to a child node: draws for it are equal for every species that
// has it.
std::uint32_t child_path(std::uint32_t path, std::uint32_t turn) {
    std::uint32_t word = (path ^ (turn + 1U)) * 0x9e3779b1U;
    word ^= word >> 15U;
    word *= 0x85ebca77U;
    return word ^ (word >> 13U);
}

std::uint32_t trunk_seed(std::uint32_t seed, std::uint32_t trunk) {
    return trunk == 0 ? seed : Random(seed, purposes::branch_trunks, trunk).bits();
}

// The values of one species for a node: lengths relative to its longest path from fork to tip,
// radii relative to its height.
struct Target {
    double length = 0.0, radius = 0.0, presence = 0.0;
    double main_turn = 0.0, other_turn = 0.0;  // radians
    double azimuth = 0.0;                      // radians
};

// One trunk of one species, by the nodes of its ramification.
class SpeciesTree {
  public:
    SpeciesTree(const Branched& shape, Ramification tree, std::vector<NodeDraws> draws)
        : style_(shape.segments), tree_(std::move(tree)), draws_(std::move(draws)) {
        const std::size_t count = tree_.nodes.size();
        targets_.resize(count);
        natural_lengths_.resize(count);
        rest_lengths_.resize(count);
        tips_.assign(count, 0.0);
        for (std::size_t i = count; i > 0; --i) {
            const auto node = static_cast<std::uint32_t>(i - 1);
            natural_lengths_[node] = natural_length(node);
            rest_lengths_[node] = natural_lengths_[node];
            if (tree_.leaf(node))
                tips_[node] = 1.0;
            else
                rest_lengths_[node] += rest_lengths_[tree_.nodes[node].children[0]];
            if (node > 0) tips_[tree_.nodes[node].parent] += tips_[node];
        }
        targets_[0].presence = 1.0;
        set_targets(0, rest_lengths_[0]);
    }

    [[nodiscard]] const Ramification& tree() const { return tree_; }
    [[nodiscard]] const Target& target(std::uint32_t node) const { return targets_[node]; }

  private:
    [[nodiscard]] double natural_length(std::uint32_t node) const {
        if (node == 0) return 0.0;  // the trunk has a length of its own
        const int order = tree_.nodes[node].order;
        double length = power(style_.length_rise, order - 1.0);
        if (order == 1) length *= style_.tip_length;
        if (order % 2 == 0) length *= 1.0 - (1.0 - whorl_rest) * style_.whorls;
        return length * (1.0 + 0.6 * style_.unevenness * draws_[node].length);
    }

    // Sets the length of each node from the ground up; `goal` is the remaining length from the
    // start of its segment to its tip.
    void set_targets(std::uint32_t root, double whole) {
        std::vector<double> goal(tree_.nodes.size(), 0.0);
        goal[root] = whole;
        const int highest_order = tree_.nodes[root].order;
        const double orders = std::max(1.0, highest_order - 2.0);
        const double rise = logarithm(std::max(tips_[root], 2.0));
        const double narrow = logarithm(style_.trunk_radius / style_.tip_radius);
        for (std::uint32_t i = 0; i < tree_.nodes.size(); ++i) {
            const Ramification::Node& node = tree_.nodes[i];
            Target& own = targets_[i];
            const double stretch = rest_lengths_[i] > 0.0 ? goal[i] / rest_lengths_[i] : 1.0;
            const double length = natural_lengths_[i] * stretch;
            own.length = own.presence * length / whole;
            own.radius = own.presence * style_.tip_radius *
                         exponential(narrow * logarithm(tips_[i]) / rise) / style_.height;
            if (tree_.leaf(i)) continue;
            const std::uint32_t main = node.children[0], other = node.children[1];
            const double rest = goal[i] - length;
            goal[main] = rest;
            const double alone = rest_lengths_[other] * stretch;
            goal[other] = alone > 0.0 ? alone * power(rest / alone, style_.level) : 0.0;
            const double unfolded = smooth_step(
                0.0, 1.0, style_.unfolding * (highest_order - 1) - (highest_order - node.order));
            targets_[main].presence = own.presence;
            targets_[other].presence = own.presence * unfolded;

            const double low = std::clamp((node.order - 2.0) / orders, 0.0, 1.0);
            const double fork = style_.tip_fork_deg + low * (style_.fork_deg - style_.tip_fork_deg);
            const int other_order = tree_.nodes[other].order;
            const double variation = 1.0 + 0.45 * style_.unevenness * draws_[i].angle;
            own.main_turn = own.other_turn = radians(fork * variation);
            if (tree_.nodes[main].order == node.order) {
                const double share = other_order / (node.order - 1.0);
                own.main_turn *= 0.5 * share;
                const double side =
                    static_cast<double>(node.order - other_order) / (node.order - 1.0);
                own.other_turn =
                    radians((fork + side * std::max(0.0, style_.side_deg - fork)) * variation);
            }
            own.azimuth =
                radians(style_.azimuth_deg + 40.0 * style_.unevenness * draws_[i].azimuth);
        }
    }

    const SegmentStyle& style_;
    Ramification tree_;
    std::vector<NodeDraws> draws_;
    std::vector<double> natural_lengths_, rest_lengths_, tips_;
    std::vector<Target> targets_;
};

// Weighted means over all species.
struct BlendedStyle {
    double height = 0.0, trunk = 0.0, trunk_radius = 0.0, splay = 0.0, upright = 0.0, wander = 0.0;
};

class GraphBuilder {
  public:
    GraphBuilder(const std::vector<BranchGraphShare>& shares, const BranchGraphProportions& own,
                 std::uint32_t seed, std::uint32_t weather_seed)
        : shares_(shares), own_(own), seed_(seed) {
        for (const BranchGraphShare& share : shares)
            damage_.push_back({damage_seed(weather_seed, share.stream), share.weight});
    }

    BranchGraph build(double bites) {
        blend_styles();
        overlay();
        blend_nodes();
        for (std::uint32_t i = 0; i < graph_.nodes.size(); ++i) place(i);
        scale_to_height();
        set_colour_coordinates();
        apply_bites(bites);
        return std::move(graph_);
    }

  private:
    void blend_styles() {
        double log_height = 0.0;
        for (const BranchGraphShare& share : shares_) {
            const SegmentStyle& style = share.shape->segments;
            log_height += share.weight * logarithm(style.height);
            style_means_.trunk += share.weight * style.trunk;
            style_means_.trunk_radius += share.weight * style.trunk_radius / style.height;
            style_means_.splay += style.trunks > 1 ? share.weight * radians(style.splay_deg) : 0.0;
            style_means_.upright += share.weight * style.upright;
            style_means_.wander += share.weight * style.wander;
            graph_.foot += share.weight * (style.foot - 1.0);
            graph_.flatness += share.weight * style.flatness;
            graph_.ruffle += share.weight * style.ruffle;
            graph_.web += share.weight * style.web;
            graph_.bluntness += share.weight * style.bluntness;
            graph_.gnarl += share.weight * style.gnarl;
        }
        style_means_.height = exponential(log_height) * own_.size;
        graph_.height = style_means_.height;
        graph_.trunk = std::min(0.96, style_means_.trunk * own_.trunk) * style_means_.height;
        graph_.trunk_radius = style_means_.trunk_radius * style_means_.height * own_.width;
    }

    std::uint32_t append(std::uint32_t parent, std::uint32_t path) {
        BranchGraph::Node node;
        node.parent = parent;
        graph_.nodes.push_back(node);
        paths_.push_back(path);
        draws_.push_back(draws_of(seed_, damage_, path));
        graph_.nodes.back().gnarl = draws_.back().gnarl;
        return static_cast<std::uint32_t>(graph_.nodes.size() - 1);
    }

    // Merges the trees of all species; forks are matched by their path from the root.
    void overlay() {
        for (const BranchGraphShare& share : shares_)
            while (static_cast<int>(graph_.roots.size()) < share.shape->segments.trunks) {
                const auto trunk = static_cast<std::uint32_t>(graph_.roots.size());
                graph_.roots.push_back(append(none, child_path(0, trunk)));
            }
        for (const BranchGraphShare& share : shares_) {
            const std::size_t first = trees_.size();
            std::size_t tips = 0;
            for (int t = 0; t < share.shape->segments.trunks; ++t) {
                const auto trunk = static_cast<std::uint32_t>(t);
                Ramification tree = ramified(share.shape->ramification, trunk_seed(seed_, trunk),
                                             most_branch_graph_tips);
                std::vector<std::uint32_t> at(tree.nodes.size(), graph_.roots[trunk]);
                for (std::uint32_t i = 0; i < tree.nodes.size(); ++i) {
                    if (tree.leaf(i)) {
                        graph_.nodes[at[i]].may_end = true;
                        ++tips;
                        continue;
                    }
                    for (std::uint32_t k = 0; k < 2; ++k) {
                        if (graph_.nodes[at[i]].children[k] == none) {
                            const std::uint32_t made = append(at[i], child_path(paths_[at[i]], k));
                            graph_.nodes[at[i]].children[k] = made;
                        }
                        at[tree.nodes[i].children[k]] = graph_.nodes[at[i]].children[k];
                    }
                }
                std::vector<NodeDraws> draws;
                draws.reserve(at.size());
                for (const std::uint32_t node : at) draws.push_back(draws_[node]);
                trees_.push_back({SpeciesTree(*share.shape, std::move(tree), std::move(draws)),
                                  std::move(at), share.weight});
            }
            for (std::size_t i = first; i < trees_.size(); ++i)
                trees_[i].few = tips <= most_sparse_tips;
        }
        for (std::size_t i = graph_.nodes.size(); i > 0; --i) {
            BranchGraph::Node& node = graph_.nodes[i - 1];
            if (node.children[0] != none)
                node.tips =
                    graph_.nodes[node.children[0]].tips + graph_.nodes[node.children[1]].tips;
        }
    }

    void blend_nodes() {
        targets_.resize(graph_.nodes.size());
        std::vector<double> angles(graph_.nodes.size(), 0.0), have(graph_.nodes.size(), 0.0);
        for (const auto& [tree, at, weight, few] : trees_)
            for (std::uint32_t i = 0; i < at.size(); ++i) {
                have[at[i]] += weight;
                if (few) graph_.nodes[at[i]].few += weight;
                const Target& one = tree.target(i);
                Target& all = targets_[at[i]];
                all.length += weight * one.length;
                all.radius += weight * one.radius;
                all.presence += weight * one.presence;
                if (tree.tree().leaf(i)) continue;
                // The influence of a species on the angle of a fork is proportional to the presence
                // of its fork.
                const double influence = weight * std::max(one.presence, 1e-6);
                all.main_turn += influence * one.main_turn;
                all.other_turn += influence * one.other_turn;
                all.azimuth += influence * one.azimuth;
                angles[at[i]] += influence;
            }
        for (std::size_t i = 0; i < targets_.size(); ++i) {
            Target& all = targets_[i];
            if (angles[i] > 0.0) {
                all.main_turn *= own_.spread / angles[i];
                all.other_turn *= own_.spread / angles[i];
                all.azimuth /= angles[i];
            }
            graph_.nodes[i].presence = all.presence;
            graph_.nodes[i].few /= have[i];
            graph_.nodes[i].radius = all.radius * style_means_.height * own_.width;
        }
        for (std::size_t i = graph_.nodes.size(); i > 0; --i) {
            BranchGraph::Node& node = graph_.nodes[i - 1];
            if (node.children[0] == none)
                node.left = node.presence;
            else
                node.left = std::max(
                    graph_.nodes[node.children[0]].left + graph_.nodes[node.children[1]].left,
                    node.presence);
        }
    }

    // Sets the heading of a node's segment and the position of its end, and initialises the
    // segments of its children.
    void place(std::uint32_t i) {
        BranchGraph::Node& node = graph_.nodes[i];
        const NodeDraws& draws = draws_[i];
        if (node.parent == none) {
            const auto trunk = static_cast<double>(
                std::find(graph_.roots.begin(), graph_.roots.end(), i) - graph_.roots.begin());
            // Trunks lean outwards in steps of the golden angle, so that their directions do not
            // depend on the number of trunks.
            const SineCosine out = sine_cosine(radians(137.5) * trunk + draws.azimuth);
            const SineCosine lean = sine_cosine(style_means_.splay);
            node.heading = glm::normalize(
                glm::dvec3(lean.sine * out.cosine, lean.cosine, lean.sine * out.sine));
            node.across = square_to(node.heading, glm::dvec3(1.0, 0.0, 0.5 * draws.z));
        } else {
            const glm::dvec3 before = node.heading;
            glm::dvec3 heading = before;
            heading += style_means_.upright * (upwards - glm::dot(upwards, heading) * heading);
            heading += 0.7 * style_means_.wander * glm::dvec3(draws.x, 0.5 * draws.y, draws.z);
            node.heading = glm::normalize(heading);
            node.across = square_to(node.heading, carried(node.across, before, node.heading));
        }
        // A segment that turns upwards again must not start beyond its own direction.
        node.beside -= std::min(0.0, glm::dot(node.beside, node.heading)) * node.heading;
        const glm::dvec3 from =
            node.parent == none ? glm::dvec3(0.0) : graph_.nodes[node.parent].place;
        const double length = node.parent == none ? node.presence * graph_.trunk
                                                  : targets_[i].length * style_means_.height;
        node.place = from + node.beside + length * node.heading;
        if (node.children[0] == none) return;
        BranchGraph::Node &main = graph_.nodes[node.children[0]],
                          &other = graph_.nodes[node.children[1]];
        if (node.parent != none)
            node.across =
                turned_square(node.across, node.heading, draws.side * targets_[i].azimuth);
        // Where the second branch is not present yet, the first continues straight.
        const double both =
            node.presence > 0.0 ? std::min(1.0, other.presence / node.presence) : 0.0;
        // Segments that are wider than long diverge by an offset rather than at an angle.
        const auto angle_share = [&](std::uint32_t child) {
            const double child_length = targets_[child].length * style_means_.height;
            return child_length / (child_length + 0.7 * graph_.nodes[child].radius + 1e-12);
        };
        const SineCosine of_main =
            sine_cosine(both * angle_share(node.children[0]) * targets_[i].main_turn);
        const SineCosine of_other =
            sine_cosine(angle_share(node.children[1]) * targets_[i].other_turn);
        const glm::dvec3 side = draws.side * node.across;
        main.beside = -both * std::max(0.0, node.radius - main.radius) * side;
        // Where one species of a mix has a tip, the children start at its end.
        const double continuing = 1.0 - graph_.ends(i);
        other.beside = continuing * std::max(0.0, node.radius - other.radius) * side;
        main.heading = of_main.cosine * node.heading - of_main.sine * side;
        other.heading = of_other.cosine * node.heading + of_other.sine * side;
        main.across = carried(node.across, node.heading, main.heading);
        other.across = carried(node.across, node.heading, other.heading);
    }

    // Scales all segments above the trunks by one factor so that the highest tip reaches the height
    // of the graph.
    void scale_to_height() {
        std::vector<glm::dvec3> base(graph_.nodes.size());
        double scale = std::numeric_limits<double>::infinity();
        for (std::size_t i = 0; i < graph_.nodes.size(); ++i) {
            const BranchGraph::Node& node = graph_.nodes[i];
            base[i] = node.parent == none ? node.place : base[node.parent];
            const double rise = node.place.y - base[i].y;
            if (rise > 1e-9) scale = std::min(scale, (graph_.height - base[i].y) / rise);
        }
        if (!std::isfinite(scale)) scale = 1.0;
        for (std::size_t i = 0; i < graph_.nodes.size(); ++i) {
            BranchGraph::Node& node = graph_.nodes[i];
            node.place = base[i] + scale * (node.place - base[i]);
            node.beside *= scale;
            graph_.reach = std::max(
                graph_.reach,
                std::sqrt(node.place.x * node.place.x + node.place.z * node.place.z) + node.radius);
        }
    }

    void set_colour_coordinates() {
        std::vector<double> rest(graph_.nodes.size(), 0.0);
        for (std::size_t i = graph_.nodes.size(); i > 0; --i) {
            const BranchGraph::Node& node = graph_.nodes[i - 1];
            rest[i - 1] = targets_[i - 1].length;
            if (node.children[0] != none) rest[i - 1] += rest[node.children[0]];
        }
        for (std::size_t i = 0; i < graph_.nodes.size(); ++i) {
            BranchGraph::Node& node = graph_.nodes[i];
            if (node.parent == none) {
                node.from_tip = 1.0;
                continue;
            }
            const double before = graph_.nodes[node.parent].from_tip;
            const double passed = rest[i] > 0.0 ? targets_[i].length / rest[i] : 0.0;
            node.from_tip = node.children[0] == none ? 0.0 : before * (1.0 - passed);
        }
    }

    void apply_bites(double bites) {
        if (!(bites > 0.0)) return;
        // The subtree of an eaten end moves down with it.
        std::vector<glm::dvec3> down(graph_.nodes.size(), glm::dvec3(0.0));
        for (std::uint32_t i = 0; i < graph_.nodes.size(); ++i) {
            BranchGraph::Node& node = graph_.nodes[i];
            if (node.parent == none) continue;
            const BranchGraph::Node& parent_node = graph_.nodes[node.parent];
            node.place -= down[node.parent];
            down[i] = down[node.parent];
            const double ends = graph_.ends(i);
            if (!(ends > 0.0)) continue;
            node.eaten = ends * draws_[i].depth * grown(draws_[i].onset, bites);
            const glm::dvec3 bitten = node.eaten * (node.place - parent_node.place);
            node.place -= bitten;
            down[i] += bitten;
            if (node.children[0] == none)
                node.from_tip = node.eaten * parent_node.from_tip;
            else
                node.from_tip += node.eaten * (parent_node.from_tip - node.from_tip);
        }
    }

    struct OverlaidTree {
        SpeciesTree tree;
        std::vector<std::uint32_t> at;  // node of the graph, by node of the tree
        double weight;
        bool few = false;  // its species is sparse, see Node::few
    };

    const std::vector<BranchGraphShare>& shares_;
    BranchGraphProportions own_;
    std::uint32_t seed_;
    SeedShares damage_;
    BlendedStyle style_means_;
    BranchGraph graph_;
    std::vector<std::uint32_t> paths_;
    std::vector<NodeDraws> draws_;
    std::vector<OverlaidTree> trees_;
    std::vector<Target> targets_;
};

}  // namespace

void Branched::check(const std::string& path, std::vector<Problem>& problems) const {
    if (ramification.order < 2)
        return report(problems, path + "/ramification/order",
                      "1 has no fork; a branched form has at least 2");
    const double tips = expected_tips(ramification) * segments.trunks;
    if (tips > static_cast<double>(most_branch_graph_tips))
        report(problems, path + "/ramification/order",
               "the bush would have about " + number_text(std::floor(tips + 0.5)) +
                   " tips; at most " + std::to_string(most_branch_graph_tips) + " are grown");
}

BranchGraph branch_graph_of(const std::vector<BranchGraphShare>& shares,
                            const BranchGraphProportions& own, double bites, std::uint32_t seed,
                            std::optional<std::uint32_t> weather_seed) {
    return GraphBuilder(shares, own, seed, weather_seed.value_or(seed)).build(bites);
}

}  // namespace sporeprint
