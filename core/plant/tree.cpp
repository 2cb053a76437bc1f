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
// long; between 1/3 and 3, so that no branch is stretched to a bare stick.
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
        factors.push_back(power(std::clamp(mean / own, 1.0 / 3.0, 3.0), evenness));
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

Tree grown_tree(const TreeShape& shape, std::uint32_t seed) {
    std::vector<Problem> problems;
    check(shape, Info{.name = ""}, "", problems);
    if (!problems.empty()) throw InvalidInput(std::move(problems));
    Tree tree;
    tree.ramification = ramified(shape.topology, seed, most_tips);
    const Ramification& grown = tree.ramification;

    const std::size_t count = grown.nodes.size();
    const Axes axes = axes_of(grown);
    const std::vector<double> leaves = leaves_of(grown);
    const std::vector<double> even = evenness_factors(grown, axes, shape.evenness);
    const int highest = grown.nodes[0].order;
    const auto radius_of = [&](int order, double borne) {
        return shape.twig_radius * by_order(shape.width_law, shape.width_rise, order, borne);
    };
    const SineCosine height = sine_cosine(radians(shape.light_deg));
    const SineCosine side = sine_cosine(radians(shape.light_azimuth_deg));
    const glm::dvec3 light(height.cosine * side.sine, height.sine, height.cosine * side.cosine);

    tree.skeleton.nodes.resize(count + 1);
    tree.skeleton.segments.resize(count);
    tree.headings.assign(count, upwards);
    tree.across.assign(count, glm::dvec3(0.0, 0.0, 1.0));
    std::vector<double> scale(count, 1.0);
    tree.skeleton.nodes[0] = {glm::dvec3(0.0), radius_of(highest, leaves[0])};
    // Parents precede their children: the direction of each edge is known when its node is reached.
    for (std::uint32_t i = 0; i < count; ++i) {
        const Ramification::Node& node = grown.nodes[i];
        const std::uint32_t first = axes.first[i];
        const std::uint32_t from = node.parent == Ramification::none ? 0 : node.parent + 1;
        const auto along = static_cast<double>(axes.length[first]);
        const double passed = (axes.position[i] + 1.0) / along;

        // Lengths vary between axes, not between edges of one axis.
        Random by_axis(seed, purposes::tree_axes, first);
        const double drawn_length = by_axis.symmetric(), drawn_angle = by_axis.symmetric();
        const double drawn_start = by_axis.uniform();
        Random by_node(seed, purposes::tree_axes, i + 0x80000000U);
        const double drawn_azimuth = by_node.symmetric();

        glm::dvec3 heading = tree.headings[i];
        const glm::dvec3 before = heading;
        heading += shape.gravitropism * (upwards - glm::dot(upwards, heading) * heading);
        heading += shape.phototropism * (light - glm::dot(light, heading) * heading);
        heading = glm::normalize(heading);
        tree.headings[i] = heading;
        glm::dvec3 across = square_to(heading, carried(tree.across[i], before, heading));

        double length = scale[i] * even[i] * (1.0 + 0.6 * shape.variation * drawn_length) *
                        shape.twig_length *
                        by_order(shape.length_law, shape.length_rise, node.order, leaves[i]);
        if (i == 0) length += shape.trunk;
        const double thick = radius_of(node.order, leaves[i]);
        // Between two orders the radius changes linearly along the axis; with pipes it does so by
        // itself.
        const double thin = node.order == 1 ? 0.7 * thick
                            : shape.width_law == OrderLaw::pipe
                                ? thick
                                : radius_of(node.order - 1, leaves[i]);
        tree.skeleton.nodes[i + 1] = {tree.skeleton.nodes[from].place + length * heading,
                                      thick + passed * (thin - thick)};
        tree.skeleton.segments[i] = {from, i + 1};

        if (grown.leaf(i)) {
            tree.across[i] = across;
            continue;
        }
        double azimuth = radians(shape.azimuth_deg + 25.0 * shape.variation * drawn_azimuth);
        if (axes.position[i] == 0) azimuth = 2.0 * pi * drawn_start * shape.variation;
        across = turned_square(across, heading, azimuth);
        // The branches of a fork lie in a plane; for low orders it is turned towards the
        // horizontal.
        const double level =
            highest > 1
                ? shape.plagiotropy * (1.0 - (node.order - 1.0) / static_cast<double>(highest))
                : 0.0;
        if (level > 0.0) {
            const glm::dvec3 normal = glm::cross(heading, across);
            const glm::dvec3 vertical = upwards - glm::dot(upwards, heading) * heading;
            const double sign = glm::dot(normal, vertical) < 0.0 ? -1.0 : 1.0;
            const glm::dvec3 mended = (1.0 - level) * normal + sign * level * vertical;
            if (glm::length(mended) > 1e-6) across = glm::cross(glm::normalize(mended), heading);
        }
        tree.across[i] = across;
        const std::uint32_t main = node.children[0], other = node.children[1];
        const int lesser = grown.nodes[other].order;
        double main_turn = 0.0, other_turn = 0.0;
        if (grown.nodes[main].order < node.order) {
            main_turn = other_turn = shape.fork_deg;
        } else {
            const double share = static_cast<double>(lesser) / (node.order - 1.0);
            main_turn = shape.main_deg * share;
            other_turn = shape.side_deg * (node.order - lesser) / (node.order - 1.0);
        }
        const double varied = 1.0 + 0.35 * shape.variation * drawn_angle;
        const SineCosine of_main = sine_cosine(radians(main_turn * varied));
        const SineCosine of_other = sine_cosine(radians(other_turn * varied));
        tree.headings[main] = of_main.cosine * heading - of_main.sine * across;
        tree.headings[other] = of_other.cosine * heading + of_other.sine * across;
        tree.across[main] = carried(across, heading, tree.headings[main]);
        tree.across[other] = carried(glm::cross(heading, across), heading, tree.headings[other]);
        const double shorter = scale[i] * (1.0 - shape.shortening * passed);
        scale[main] = grown.nodes[main].order == node.order ? scale[i] : shorter;
        scale[other] = shorter;
    }
    return tree;
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
        for (int k = 0; k < style.per_tip; ++k) {
            const double turn_drawn = random.symmetric(), size_drawn = random.symmetric();
            const double tilt_x = random.symmetric(), tilt_z = random.symmetric();
            PlacedLeaf leaf;
            const double t = 1.0 - static_cast<double>(k) / style.per_tip;
            leaf.place = from.place + t * (to.place - from.place);
            const double azimuth = 2.0 * pi * start + radians(137.5) * k + 0.3 * turn_drawn;
            const glm::dvec3 out = turned_square(tree.across[i], heading, azimuth);
            // The last leaf continues the direction of the twig.
            const double open = k == 0 ? 0.4 : 1.0;
            glm::dvec3 along = off.cosine * heading + open * off.sine * out;
            along -= 0.9 * style.droop * upwards;
            if (glm::length(along) < 1e-3) along = out;
            leaf.along = glm::normalize(along);
            leaf.up = square_to(leaf.along, upwards + 0.35 * glm::dvec3(tilt_x, 0.0, tilt_z));
            leaf.size = style.leaf_size * (1.0 + style.size_spread * size_drawn);
            leaf.id = i * 64U + static_cast<std::uint32_t>(k);
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
            const glm::dvec3 at = one.size * glm::dvec3(leaf.positions[i]);
            const glm::dvec3 normal(leaf.normals[i]);
            mesh.positions.emplace_back(one.place + at.x * side + at.y * one.up + at.z * one.along);
            mesh.normals.emplace_back(
                glm::normalize(normal.x * side + normal.y * one.up + normal.z * one.along));
        }
        for (const glm::vec4& tangent : leaf.tangents) {
            const glm::dvec3 t(tangent);
            mesh.tangents.emplace_back(
                glm::vec3(glm::normalize(t.x * side + t.y * one.up + t.z * one.along)), tangent.w);
        }
        mesh.texture_coordinates.insert(mesh.texture_coordinates.end(),
                                        leaf.texture_coordinates.begin(),
                                        leaf.texture_coordinates.end());
        for (const std::uint32_t index : leaf.indices) mesh.indices.push_back(index + shift);
    }
    return mesh;
}

}  // namespace sporeprint
