#include "core/plant/tree.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <utility>

#include "core/math/direction.h"
#include "core/math/elementary.h"
#include "core/math/purposes.h"
#include "core/math/random.h"
#include "core/params/messages.h"

namespace sporeprint {

namespace {

constexpr glm::dvec3 upwards(0.0, 1.0, 0.0);

// No source or measurement is recorded for the values down to `leaf_tilt`, except the golden angle.

// Limits of the factor on the length of an axis for `evenness` 1: no branch is stretched to a bare
// stick.
constexpr double most_stretch = 3.0;

// Largest deviations for `variation` 1: of lengths and of angles of forks, as shares of them, and
// of the phyllotaxis, degrees.
constexpr double length_variation = 0.6, angle_variation = 0.35, azimuth_variation_deg = 25.0;

// Radius at the end of a twig, as a share of that at its beginning.
constexpr double tip_radius = 0.7;

// Length of a sum of normals below which its direction is undetermined.
constexpr double least_normal = 1e-6;

// Random streams of nodes follow those of axes.
constexpr std::uint32_t first_node_stream = 0x80000000U;

// Turn about the twig from one leaf to the next: the golden angle, 360 (1 - 1 / golden ratio).
constexpr double golden_deg = 137.5;

// Largest deviation of that turn, radians; share of `leaf_deg` of the last leaf of a twig, which
// continues its direction; weight of the downward direction for `droop` 1; largest tilt of a blade.
constexpr double leaf_turn = 0.3, last_leaf_share = 0.4, droop_weight = 0.9, leaf_tilt = 0.35;

// Length of a sum of directions below which a leaf stands square to its twig.
constexpr double least_direction = 1e-3;

// Ids of leaves from one twig to the next, more than `per_tip` can be.
constexpr std::uint32_t ids_per_tip = 64;

double by_order(OrderLaw law, double rise, int order, double leaves) {
    switch (law) {
        case OrderLaw::constant:
            return 1.0;
        case OrderLaw::linear:
            return 1.0 + rise * (order - 1);
        case OrderLaw::logarithmic:
            return 1.0 + rise * logarithm(order);
        case OrderLaw::geometric:
            return power(rise, order - 1.0);
        case OrderLaw::pipe:
            return power(leaves, 1.0 / std::max(rise, 1.0));
    }
    return 1.0;
}

// The axes of a tree: maximal runs of consecutive nodes of one order.
struct Axes {
    std::vector<std::uint32_t> first;     ///< first node of each node's axis
    std::vector<std::uint32_t> position;  ///< of each node on its axis, from 0
    std::vector<std::uint32_t> length;    ///< in nodes, indexed by the first node
};

Axes axes_of(const Ramification& tree) {
    const std::size_t count = tree.nodes.size();
    Axes axes{std::vector<std::uint32_t>(count), std::vector<std::uint32_t>(count, 0),
              std::vector<std::uint32_t>(count, 0)};
    for (std::uint32_t i = 0; i < count; ++i) {
        const Ramification::Node& node = tree.nodes[i];
        const bool goes_on =
            node.parent != Ramification::none && tree.nodes[node.parent].order == node.order;
        axes.first[i] = goes_on ? axes.first[node.parent] : i;
        axes.position[i] = goes_on ? axes.position[node.parent] + 1 : 0;
        ++axes.length[axes.first[i]];
    }
    return axes;
}

// Returns the factors on the lengths of each node's edges that make all axes of its order equally
// long; between 1 / most_stretch and most_stretch.
std::vector<double> evenness_factors(const Ramification& tree, const Axes& axes, double evenness) {
    std::vector<double> edges(most_order + 5, 0.0), begun = edges, factors;
    for (std::uint32_t i = 0; i < tree.nodes.size(); ++i) {
        const auto order = static_cast<std::size_t>(tree.nodes[i].order);
        edges[order] += 1.0;
        if (axes.first[i] == i) begun[order] += 1.0;
    }
    factors.reserve(tree.nodes.size());
    for (std::uint32_t i = 0; i < tree.nodes.size(); ++i) {
        const auto order = static_cast<std::size_t>(tree.nodes[i].order);
        const double mean = edges[order] / begun[order];
        const auto own = static_cast<double>(axes.length[axes.first[i]]);
        factors.push_back(
            power(std::clamp(mean / own, 1.0 / most_stretch, most_stretch), evenness));
    }
    return factors;
}

// Returns the number of leaves in the subtree of each node.
std::vector<double> leaves_of(const Ramification& tree) {
    std::vector<double> leaves(tree.nodes.size(), 0.0);
    for (std::size_t i = tree.nodes.size(); i > 0; --i) {
        const auto node = static_cast<std::uint32_t>(i - 1);
        if (tree.leaf(node)) leaves[node] = 1.0;
        if (tree.nodes[node].parent != Ramification::none)
            leaves[tree.nodes[node].parent] += leaves[node];
    }
    return leaves;
}

}  // namespace

void TreeShape::check(const std::string& path, std::vector<Problem>& problems) const {
    if (width_law == OrderLaw::pipe && width_rise < 1.0)
        report(problems, path + "/width_rise",
               number_text(width_rise) +
                   " is less than 1: pipes would be thinner together than "
                   "each alone");
}

std::vector<ExpectedOrder> expected_orders(const TreeShape& shape) {
    const TreeTopology& topology = shape.topology;
    // Returns the expected number of edges of each order of a tree of the matrix, computed from the
    // highest order down.
    const auto orders_of = [](const RamificationMatrix& matrix, int order) {
        std::vector<double> axes(static_cast<std::size_t>(order) + 1, 0.0), edges = axes;
        axes.back() = 1.0;
        for (int k = order; k >= 2; --k) {
            const auto at = static_cast<std::size_t>(k);
            edges[at] = axes[at] / matrix.fork(k);
            axes[at - 1] += 2.0 * axes[at];
            for (int i = 1; i < k; ++i)
                axes[static_cast<std::size_t>(i)] += matrix.at(k, i) * edges[at];
        }
        edges[1] = axes[1];
        return edges;
    };
    const RamificationMatrix matrix = matrix_of(topology);
    const std::vector<double> tree = orders_of(matrix, topology.order);
    // Small trees in place of twigs raise the orders above them.
    const int raised = topology.tip_order - 1;
    std::vector<double> edges(tree.size() + static_cast<std::size_t>(raised), 0.0);
    for (std::size_t k = 2; k < tree.size(); ++k)
        edges[k + static_cast<std::size_t>(raised)] = tree[k];
    double mean_tips = 0.0;
    for (int t = 1; t <= topology.tip_order; ++t) {
        const std::vector<double> tips = orders_of(tip_matrix(topology), t);
        for (std::size_t k = 1; k < tips.size(); ++k)
            edges[k] += tree[1] * tips[k] / topology.tip_order;
        mean_tips += tips[1] / topology.tip_order;
    }
    std::vector<ExpectedOrder> orders;
    for (std::size_t k = 1; k < edges.size(); ++k) {
        const int order = static_cast<int>(k);
        const int own = std::clamp(order - raised, 1, topology.order);
        // An axis carries all its leaves at its first edge and those of its fork at its last.
        const double most = expected_leaves(matrix, own) * mean_tips;
        const double least = own > 1 ? 2.0 * expected_leaves(matrix, own - 1) * mean_tips : 1.0;
        // Branches shorten linearly along their parent axis.
        const double scale = k + 1 < edges.size() ? 1.0 - 0.5 * shape.shortening : 1.0;
        orders.push_back(
            {edges[k],
             scale * shape.twig_length * by_order(shape.length_law, shape.length_rise, order, most),
             shape.twig_radius *
                 by_order(shape.width_law, shape.width_rise, order, std::min(least, most))});
    }
    return orders;
}

namespace {

// Grows a tree edge by edge. Parents precede their children in the ramification, so the direction
// of each edge is known when its node is reached.
class TreeBuilder {
  public:
    TreeBuilder(const TreeShape& shape, std::uint32_t seed)
        : shape_(shape), seed_(seed), grown_(tree_.ramification) {
        tree_.ramification = ramified(shape.topology, seed, most_tips);
        const std::size_t count = grown_.nodes.size();
        axes_ = axes_of(grown_);
        leaves_ = leaves_of(grown_);
        evenness_ = evenness_factors(grown_, axes_, shape.evenness);
        highest_ = grown_.nodes[0].order;
        const SineCosine height = sine_cosine(radians(shape.light_deg));
        const SineCosine side = sine_cosine(radians(shape.light_azimuth_deg));
        light_ = {height.cosine * side.sine, height.sine, height.cosine * side.cosine};
        tree_.skeleton.nodes.resize(count + 1);
        tree_.skeleton.segments.resize(count);
        tree_.headings.assign(count, upwards);
        tree_.across.assign(count, glm::dvec3(0.0, 0.0, 1.0));
        tree_.scales.assign(count, 1.0);
        tree_.skeleton.nodes[0] = {glm::dvec3(0.0), radius_of(highest_, leaves_[0])};
    }

    Tree grown() && {
        for (std::uint32_t i = 0; i < grown_.nodes.size(); ++i) {
            const Draws draws = draws_of(i);
            apply_tropisms(i);
            place_edge(i, draws);
            if (grown_.leaf(i)) continue;
            turn_fork(i, draws);
            direct_children(i, draws);
        }
        return std::move(tree_);
    }

  private:
    // Random numbers of one edge, -1..1, `start` 0..1.
    struct Draws {
        double length, angle, start, azimuth;
    };

    // Lengths and angles vary between axes, not between edges of one axis.
    [[nodiscard]] Draws draws_of(std::uint32_t i) const {
        Draws draws{};
        Random by_axis(seed_, purposes::tree_axes, axes_.first[i]);
        draws.length = by_axis.symmetric();
        draws.angle = by_axis.symmetric();
        draws.start = by_axis.uniform();
        Random by_node(seed_, purposes::tree_axes, i + first_node_stream);
        draws.azimuth = by_node.symmetric();
        return draws;
    }

    [[nodiscard]] double radius_of(int order, double borne) const {
        return shape_.twig_radius * by_order(shape_.width_law, shape_.width_rise, order, borne);
    }

    // Returns the share of its axis that an edge and those before it cover.
    [[nodiscard]] double passed(std::uint32_t i) const {
        const auto along = static_cast<double>(axes_.length[axes_.first[i]]);
        return (axes_.position[i] + 1.0) / along;
    }

    // Turns the heading of an edge upwards and to the light, and its fork's direction with it.
    void apply_tropisms(std::uint32_t i) {
        glm::dvec3 heading = tree_.headings[i];
        const glm::dvec3 before = heading;
        // The share of orders above its own, squared: boughs stand while twigs hang.
        const double low =
            highest_ > 1 ? static_cast<double>(highest_ - grown_.nodes[i].order) / (highest_ - 1.0)
                         : 0.0;
        heading += (shape_.gravitropism - shape_.weeping * low * low) *
                   (upwards - glm::dot(upwards, heading) * heading);
        heading += shape_.phototropism * (light_ - glm::dot(light_, heading) * heading);
        heading = glm::normalize(heading);
        tree_.headings[i] = heading;
        tree_.across[i] = square_to(heading, carried(tree_.across[i], before, heading));
    }

    // Sets the end of an edge, its radius there and its segment.
    void place_edge(std::uint32_t i, const Draws& draws) {
        const Ramification::Node& node = grown_.nodes[i];
        const std::uint32_t from = node.parent == Ramification::none ? 0 : node.parent + 1;
        double length = tree_.scales[i] * evenness_[i] *
                        (1.0 + length_variation * shape_.variation * draws.length) *
                        shape_.twig_length *
                        by_order(shape_.length_law, shape_.length_rise, node.order, leaves_[i]);
        if (i == 0) length += shape_.trunk;
        const double thick = radius_of(node.order, leaves_[i]);
        // Between two orders the radius changes linearly along the axis; with pipes it does so by
        // itself.
        const double thin = node.order == 1 ? tip_radius * thick
                            : shape_.width_law == OrderLaw::pipe
                                ? thick
                                : radius_of(node.order - 1, leaves_[i]);
        tree_.skeleton.nodes[i + 1] = {
            tree_.skeleton.nodes[from].place + length * tree_.headings[i],
            thick + passed(i) * (thin - thick)};
        tree_.skeleton.segments[i] = {from, i + 1};
    }

    // Sets the direction across an edge in which its fork spreads: turned by the phyllotaxis, then
    // levelled.
    void turn_fork(std::uint32_t i, const Draws& draws) {
        const glm::dvec3& heading = tree_.headings[i];
        double azimuth =
            radians(shape_.azimuth_deg + azimuth_variation_deg * shape_.variation * draws.azimuth);
        if (axes_.position[i] == 0) azimuth = 2.0 * pi * draws.start * shape_.variation;
        glm::dvec3 across = turned_square(tree_.across[i], heading, azimuth);
        // The branches of a fork lie in a plane; for low orders it is turned towards the
        // horizontal.
        const double level =
            highest_ > 1 ? shape_.plagiotropy *
                               (1.0 - (grown_.nodes[i].order - 1.0) / static_cast<double>(highest_))
                         : 0.0;
        if (level > 0.0) {
            const glm::dvec3 normal = glm::cross(heading, across);
            const glm::dvec3 vertical = upwards - glm::dot(upwards, heading) * heading;
            const double sign = glm::dot(normal, vertical) < 0.0 ? -1.0 : 1.0;
            const glm::dvec3 mended = (1.0 - level) * normal + sign * level * vertical;
            if (glm::length(mended) > least_normal)
                across = glm::cross(glm::normalize(mended), heading);
        }
        tree_.across[i] = across;
    }

    // Sets the headings and the scale of the two children of a node.
    void direct_children(std::uint32_t i, const Draws& draws) {
        const Ramification::Node& node = grown_.nodes[i];
        const glm::dvec3 heading = tree_.headings[i], across = tree_.across[i];
        const std::uint32_t main = node.children[0], other = node.children[1];
        const int lesser = grown_.nodes[other].order;
        double main_turn = 0.0, other_turn = 0.0;
        if (grown_.nodes[main].order < node.order) {
            main_turn = other_turn = shape_.fork_deg;
        } else {
            const double share = static_cast<double>(lesser) / (node.order - 1.0);
            main_turn = shape_.main_deg * share;
            const double unlike = (node.order - lesser) / (node.order - 1.0);
            other_turn = shape_.side_deg * (unlike + shape_.spread * (1.0 - unlike));
        }
        const double varied = 1.0 + angle_variation * shape_.variation * draws.angle;
        const SineCosine of_main = sine_cosine(radians(main_turn * varied));
        const SineCosine of_other = sine_cosine(radians(other_turn * varied));
        tree_.headings[main] = of_main.cosine * heading - of_main.sine * across;
        tree_.headings[other] = of_other.cosine * heading + of_other.sine * across;
        tree_.across[main] = carried(across, heading, tree_.headings[main]);
        tree_.across[other] = carried(glm::cross(heading, across), heading, tree_.headings[other]);
        std::vector<double>& scales = tree_.scales;
        const double left = 1.0 - passed(i);
        const double low = node.order == highest_ ? shape_.rounding * left * left * left : 0.0;
        const double shorter = scales[i] * (1.0 - shape_.shortening * passed(i)) * (1.0 - low);
        scales[main] = grown_.nodes[main].order == node.order ? scales[i] : shorter;
        scales[other] = shorter;
    }

    const TreeShape& shape_;
    std::uint32_t seed_;
    Tree tree_;
    const Ramification& grown_;  ///< that of the tree
    Axes axes_;
    std::vector<double> leaves_;    ///< in the subtree of each node
    std::vector<double> evenness_;  ///< factors on lengths
    int highest_ = 0;               ///< order of the trunk
    glm::dvec3 light_{0.0};         ///< unit, to the light
};

}  // namespace

Tree grown_tree(const TreeShape& shape, std::uint32_t seed) {
    std::vector<Problem> problems;
    check(shape, Info{.name = ""}, "", problems);
    if (!problems.empty()) throw InvalidInput(std::move(problems));
    return TreeBuilder(shape, seed).grown();
}

std::vector<PlacedLeaf> placed_leaves(const Tree& tree, const LeafStyle& style,
                                      std::uint32_t seed) {
    std::vector<PlacedLeaf> leaves;
    const Ramification& grown = tree.ramification;
    const std::size_t count = grown.leaves() * static_cast<std::size_t>(style.per_tip);
    if (count > most_leaves)
        throw Impossible("/per_tip", std::to_string(style.per_tip) + " make " +
                                         std::to_string(count) + " leaves on " +
                                         std::to_string(grown.leaves()) + " twigs; at most " +
                                         std::to_string(most_leaves) + " are placed");
    leaves.reserve(count);
    const SineCosine off = sine_cosine(radians(style.leaf_deg));
    for (std::uint32_t i = 0; i < grown.nodes.size(); ++i) {
        if (!grown.leaf(i)) continue;
        const Skeleton::Node& from = tree.skeleton.nodes[tree.skeleton.segments[i].from];
        const Skeleton::Node& to = tree.skeleton.nodes[i + 1];
        const glm::dvec3 heading = tree.headings[i];
        Random random(seed, purposes::placed_leaves, i);
        const double start = random.uniform();
        // Leaves at full size would hide a short twig and blunt the top of a crown.
        const double smaller = tree.scales.empty() ? 1.0 : std::sqrt(std::sqrt(tree.scales[i]));
        for (int k = 0; k < style.per_tip; ++k) {
            const double turn_drawn = random.symmetric(), size_drawn = random.symmetric();
            const double tilt_x = random.symmetric(), tilt_z = random.symmetric();
            PlacedLeaf leaf;
            const double t = 1.0 - static_cast<double>(k) / style.per_tip;
            leaf.place = from.place + t * (to.place - from.place);
            const double azimuth =
                2.0 * pi * start + radians(golden_deg) * k + leaf_turn * turn_drawn;
            const glm::dvec3 out = turned_square(tree.across[i], heading, azimuth);
            const double open = k == 0 ? last_leaf_share : 1.0;
            glm::dvec3 along = off.cosine * heading + open * off.sine * out;
            along -= droop_weight * style.droop * upwards;
            if (glm::length(along) < least_direction) along = out;
            leaf.along = glm::normalize(along);
            leaf.up = square_to(leaf.along, upwards + leaf_tilt * glm::dvec3(tilt_x, 0.0, tilt_z));
            leaf.size = style.leaf_size * smaller * (1.0 + style.size_spread * size_drawn);
            leaf.id = i * ids_per_tip + static_cast<std::uint32_t>(k);
            leaf.twig = i;
            leaves.push_back(leaf);
        }
    }
    std::vector<std::pair<std::uint32_t, std::uint32_t>> order;
    for (std::uint32_t i = 0; i < leaves.size(); ++i) {
        Random random(seed, purposes::leaf_thinning, leaves[i].id);
        order.emplace_back(random.bits(), i);
    }
    std::sort(order.begin(), order.end());
    std::vector<PlacedLeaf> sorted;
    sorted.reserve(leaves.size());
    for (const auto& [priority, i] : order) sorted.push_back(leaves[i]);
    return sorted;
}

std::vector<PlacedLeaf> thinned(std::span<const PlacedLeaf> leaves, double share) {
    const auto count = static_cast<std::size_t>(
        std::ceil(std::clamp(share, 0.0, 1.0) * static_cast<double>(leaves.size())));
    std::vector<PlacedLeaf> retained(leaves.begin(), leaves.begin() + static_cast<long>(count));
    double all = 0.0, left = 0.0;
    for (std::size_t i = 0; i < leaves.size(); ++i) {
        const double area = leaves[i].size * leaves[i].size;
        all += area;
        if (i < count) left += area;
    }
    if (left > 0.0)
        for (PlacedLeaf& leaf : retained) leaf.size *= std::sqrt(all / left);
    return retained;
}

Mesh merged_leaves(std::span<const PlacedLeaf> leaves, const Mesh& leaf) {
    Mesh mesh;
    mesh.positions.reserve(leaves.size() * leaf.positions.size());
    mesh.normals.reserve(leaves.size() * leaf.positions.size());
    mesh.indices.reserve(leaves.size() * leaf.indices.size());
    for (const PlacedLeaf& one : leaves) {
        const glm::dvec3 side = glm::cross(one.up, one.along);
        const auto shift = static_cast<std::uint32_t>(mesh.positions.size());
        for (std::size_t i = 0; i < leaf.positions.size(); ++i) {
            const glm::dvec3 normal(leaf.normals[i]);
            mesh.positions.emplace_back(one.at(glm::dvec3(leaf.positions[i])));
            mesh.normals.emplace_back(glm::normalize(normal.x / one.breadth * side +
                                                     normal.y / one.thickness * one.up +
                                                     normal.z * one.along));
        }
        for (const glm::vec4& tangent : leaf.tangents) {
            const glm::dvec3 t(tangent);
            mesh.tangents.emplace_back(
                glm::vec3(glm::normalize(one.breadth * t.x * side + one.thickness * t.y * one.up +
                                         t.z * one.along)),
                tangent.w);
        }
        mesh.texture_coordinates.insert(mesh.texture_coordinates.end(),
                                        leaf.texture_coordinates.begin(),
                                        leaf.texture_coordinates.end());
        for (const std::uint32_t index : leaf.indices) mesh.indices.push_back(index + shift);
    }
    return mesh;
}

}  // namespace sporeprint
