#include "core/plant/tree.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <utility>

#include "core/math/elementary.h"
#include "core/math/random.h"
#include "core/mesh/tangents.h"
#include "core/model/purposes.h"
#include "core/params/messages.h"
#include "core/skeleton/skin.h"

namespace sporeprint {

namespace {

constexpr glm::dvec3 upwards(0.0, 1.0, 0.0);

RamificationMatrix named_matrix(MatrixKind kind, const TreeTopology& topology, int order) {
    switch (kind) {
        case MatrixKind::perfect:
            return perfect_matrix(order);
        case MatrixKind::random_binary:
            return random_binary_matrix(order);
        case MatrixKind::random_increasing:
            return random_increasing_matrix(order);
        case MatrixKind::fishbone:
            return fishbone_matrix(order, topology.forks);
        case MatrixKind::tokunaga:
            return tokunaga_matrix(order, topology.tokunaga_a, topology.tokunaga_c);
    }
    return perfect_matrix(order);
}

RamificationMatrix tip_matrix(const TreeTopology& topology) {
    return named_matrix(topology.tips, topology, std::max(2, topology.tip_order));
}

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

// Carries a direction along as the heading turns from one unit vector to another, without twist.
glm::dvec3 carried(const glm::dvec3& v, const glm::dvec3& from, const glm::dvec3& to) {
    const glm::dvec3 axis = glm::cross(from, to);
    const double d = glm::dot(from, to);
    if (d < -0.999999) return v;
    return v + glm::cross(axis, v) + glm::cross(axis, glm::cross(axis, v)) / (1.0 + d);
}

glm::dvec3 turned(const glm::dvec3& v, const glm::dvec3& axis, double angle) {
    const SineCosine at = sine_cosine(angle);
    return at.cosine * v + at.sine * glm::cross(axis, v);
}

glm::dvec3 square_to(const glm::dvec3& v, const glm::dvec3& axis) {
    const glm::dvec3 flat = v - glm::dot(v, axis) * axis;
    const double size = glm::length(flat);
    if (size > 1e-6) return flat / size;
    const glm::dvec3 other = std::abs(axis.x) < 0.7 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 0, 1);
    return glm::normalize(other - glm::dot(other, axis) * axis);
}

// Nodes of one order that follow each other: an axis as far as it keeps its order.
struct Axes {
    std::vector<std::uint32_t> first;     ///< of each node's axis
    std::vector<std::uint32_t> position;  ///< of each node on it, from 0
    std::vector<std::uint32_t> length;    ///< in nodes, by the first
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

// Leaves that each node bears.
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
    if (topology.rows.empty()) return;
    const std::vector<Problem> faults = faults_of(matrix_of(topology), path + "/rows");
    problems.insert(problems.end(), faults.begin(), faults.end());
    if (topology.order > static_cast<int>(topology.rows.size()) + 1)
        report(problems, path + "/order",
               std::to_string(topology.order) + " needs " + std::to_string(topology.order - 1) +
                   " rows; there are " + std::to_string(topology.rows.size()));
}

RamificationMatrix matrix_of(const TreeTopology& topology) {
    if (!topology.rows.empty()) {
        RamificationMatrix own;
        for (const MatrixRow& row : topology.rows) own.rows.push_back(row.shares);
        return own;
    }
    const int order = std::max(2, topology.order);
    return blended(named_matrix(topology.matrix, topology, order),
                   named_matrix(topology.toward, topology, order), topology.blend);
}

double expected_tips(const TreeTopology& topology) {
    const RamificationMatrix matrix = matrix_of(topology);
    const double leaves = topology.growth == TreeGrowth::dealt
                              ? dealt_leaves(matrix, topology.order)
                              : expected_leaves(matrix, topology.order);
    double mean = 0.0;
    for (int k = 1; k <= topology.tip_order; ++k)
        mean += expected_leaves(tip_matrix(topology), k) / topology.tip_order;
    return leaves * mean;
}

Tree grown_tree(const TreeShape& shape, std::uint32_t seed) {
    std::vector<Problem> problems;
    check(shape, Info{.name = ""}, "", problems);
    if (!problems.empty()) throw InvalidInput(std::move(problems));
    const TreeTopology& topology = shape.topology;
    Tree tree;
    Ramification& grown = tree.ramification;
    const RamificationMatrix matrix = matrix_of(topology);
    grown = topology.growth == TreeGrowth::dealt
                ? dealt_ramification(matrix, topology.order, seed, most_tips)
                : grown_ramification(matrix, topology.order, seed, most_tips);
    if (topology.tip_order > 1)
        grown = with_tips(grown, tip_matrix(topology), topology.tip_order, seed, most_tips);

    const std::size_t count = grown.nodes.size();
    const Axes axes = axes_of(grown);
    const std::vector<double> leaves = leaves_of(grown);
    const int highest = grown.nodes[0].order;
    const auto radius_of = [&](int order, double borne) {
        return shape.twig_radius * by_order(shape.width_law, shape.width_rise, order, borne);
    };
    const SineCosine height = sine_cosine(radians(shape.light_deg));
    const SineCosine side = sine_cosine(radians(shape.light_azimuth_deg));
    const glm::dvec3 light(height.cosine * side.sine, height.sine, height.cosine * side.cosine);

    tree.skeleton.nodes.resize(count + 1);
    tree.skeleton.limbs.resize(count);
    tree.headings.assign(count, upwards);
    tree.across.assign(count, glm::dvec3(0.0, 0.0, 1.0));
    std::vector<double> scale(count, 1.0);
    tree.skeleton.nodes[0] = {glm::dvec3(0.0), radius_of(highest, leaves[0])};
    // Every node knows how its edge leaves its parent before it is reached.
    for (std::uint32_t i = 0; i < count; ++i) {
        const Ramification::Node& node = grown.nodes[i];
        const std::uint32_t first = axes.first[i];
        const std::uint32_t from = node.parent == Ramification::none ? 0 : node.parent + 1;
        const auto along = static_cast<double>(axes.length[first]);
        const double passed = (axes.position[i] + 1.0) / along;

        // Lengths vary from axis to axis, not from edge to edge.
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
        glm::dvec3 across = square_to(carried(tree.across[i], before, heading), heading);

        double length = scale[i] * (1.0 + 0.6 * shape.variation * drawn_length) *
                        shape.twig_length *
                        by_order(shape.length_law, shape.length_rise, node.order, leaves[i]);
        if (i == 0) length += shape.trunk;
        const double thick = radius_of(node.order, leaves[i]);
        // From one order to the next the radius goes evenly along the axis. Pipes do so by themselves.
        const double thin = node.order == 1 ? 0.7 * thick
                            : shape.width_law == OrderLaw::pipe
                                ? thick
                                : radius_of(node.order - 1, leaves[i]);
        tree.skeleton.nodes[i + 1] = {tree.skeleton.nodes[from].place + length * heading,
                                      thick + passed * (thin - thick)};
        tree.skeleton.limbs[i] = {from, i + 1};

        if (grown.leaf(i)) {
            tree.across[i] = across;
            continue;
        }
        double azimuth = radians(shape.azimuth_deg + 25.0 * shape.variation * drawn_azimuth);
        if (axes.position[i] == 0) azimuth = 2.0 * pi * drawn_start * shape.variation;
        across = turned(across, heading, azimuth);
        // The branches lie in a plane; that of low orders turns level.
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

namespace {

void append(Mesh& mesh, const Mesh& part) {
    const auto shift = static_cast<std::uint32_t>(mesh.positions.size());
    mesh.positions.insert(mesh.positions.end(), part.positions.begin(), part.positions.end());
    mesh.normals.insert(mesh.normals.end(), part.normals.begin(), part.normals.end());
    for (const std::uint32_t index : part.indices) mesh.indices.push_back(index + shift);
}

// The limbs of orders low..high as a skeleton of their own. Nodes that lie nearly on the way between their neighbours go, and longer
// ways than `gap` radii get nodes: an image that turns back between two rings would be seen stretched.
Skeleton part_of(const Tree& tree, int low, int high, double tolerance, double gap) {
    const Ramification& grown = tree.ramification;
    const std::size_t count = grown.nodes.size();
    const auto within = [&](std::uint32_t i) {
        return grown.nodes[i].order >= low && grown.nodes[i].order <= high;
    };
    std::vector<std::uint32_t> children(count, 0);
    for (std::uint32_t i = 1; i < count; ++i)
        if (within(i)) ++children[grown.nodes[i].parent];
    Skeleton part;
    // Where each node lies in the part, and, of one that was left out, the last before it that was not.
    std::vector<std::uint32_t> place(count, Ramification::none);
    const auto add = [&](const Skeleton::Node& node) {
        part.nodes.push_back(node);
        return static_cast<std::uint32_t>(part.nodes.size() - 1);
    };
    for (std::uint32_t i = 0; i < count; ++i) {
        if (!within(i)) continue;
        const Skeleton::Node& here = tree.skeleton.nodes[i + 1];
        const std::uint32_t parent = grown.nodes[i].parent;
        std::uint32_t from = Ramification::none;
        if (parent != Ramification::none && within(parent)) {
            from = place[parent];
        } else {
            // A part that begins on a thicker one begins inside of it, as thick as it goes on.
            Skeleton::Node root = tree.skeleton.nodes[tree.skeleton.limbs[i].from];
            if (parent != Ramification::none) root.radius = std::min(root.radius, here.radius);
            from = add(root);
        }
        const Skeleton::Node& before = part.nodes[from];
        if (children[i] == 1) {
            const std::uint32_t next = within(grown.nodes[i].children[0])
                                           ? grown.nodes[i].children[0]
                                           : grown.nodes[i].children[1];
            const Skeleton::Node& after = tree.skeleton.nodes[next + 1];
            const glm::dvec3 way = after.place - before.place;
            const double whole = glm::dot(way, way);
            if (whole > 0.0) {
                const double t = glm::dot(here.place - before.place, way) / whole;
                const double aside = glm::length(here.place - before.place - t * way);
                const double wanted = before.radius + t * (after.radius - before.radius);
                if (whole < gap * gap * here.radius * here.radius &&
                    aside < tolerance * here.radius &&
                    std::abs(wanted - here.radius) < 0.5 * tolerance * here.radius) {
                    place[i] = from;
                    continue;
                }
            }
        }
        const Skeleton::Node start = part.nodes[from];
        const double length = glm::distance(start.place, here.place);
        const double steps = std::floor(length / (gap * std::max(start.radius, here.radius)));
        for (double step = 1.0; step <= steps; step += 1.0) {
            const double t = step / (steps + 1.0);
            const std::uint32_t between = add({start.place + t * (here.place - start.place),
                                               start.radius + t * (here.radius - start.radius)});
            part.limbs.push_back({from, between});
            from = between;
        }
        place[i] = add(here);
        part.limbs.push_back({from, place[i]});
    }
    return part;
}

}  // namespace

Mesh bark_of(const Tree& tree, int lod) {
    if (lod < 0 || lod >= tree_lods)
        throw InvalidInput("/lod",
                           std::to_string(lod) + " is outside 0.." + std::to_string(tree_lods - 1));
    const int highest = tree.ramification.nodes[0].order;
    const int lowest = std::min(1 + lod, highest);
    Mesh bark;
    // Trunk and great branches, branches, twigs: each a skin of its own, subdivided as its place in the picture is worth.
    int high = highest;
    for (int group = 0; group < 3 && high >= lowest; ++group) {
        // Twigs of order 1, half of all limbs, are never subdivided.
        const int low = group == 2 ? lowest : std::max({lowest, high - 1, std::min(high, 2)});
        const double gap = group == 2 ? 1e9 : 3.0 * (1 + group) * (1 + lod);
        const Skeleton part = part_of(tree, low, high, 0.25 * (1 + lod), gap);
        high = low - 1;
        if (part.limbs.empty()) continue;
        const SkinnedSkeleton skin = skinned(cleaned(part).skeleton, std::max(0, 2 - group - lod));
        append(bark, skin.mesh);
        for (std::size_t i = 0; i < skin.places.size(); ++i) {
            // There and back: so the image meets itself wherever it ends.
            const double girth = 2.0 * pi * skin.strips[skin.strip_of[i]].radius;
            const double images = std::abs(skin.places[i].y) / (bark_girths * girth);
            const double whole = 2.0 * std::floor(0.5 * images);
            bark.texture_coordinates.emplace_back(std::clamp(skin.places[i].x, 0.0, 1.0),
                                                  1.0 - std::abs(1.0 - (images - whole)));
        }
    }
    add_tangents(bark);
    return bark;
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
        const Skeleton::Node& from = tree.skeleton.nodes[tree.skeleton.limbs[i].from];
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
            const glm::dvec3 out = turned(tree.across[i], heading, azimuth);
            // The last leaf goes on where the twig ends.
            const double open = k == 0 ? 0.4 : 1.0;
            glm::dvec3 along = off.cosine * heading + open * off.sine * out;
            along -= 0.9 * style.droop * upwards;
            if (glm::length(along) < 1e-3) along = out;
            leaf.along = glm::normalize(along);
            leaf.up = square_to(upwards + 0.35 * glm::dvec3(tilt_x, 0.0, tilt_z), leaf.along);
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
    std::vector<PlacedLeaf> kept(leaves.begin(), leaves.begin() + static_cast<long>(count));
    double all = 0.0, left = 0.0;
    for (std::size_t i = 0; i < leaves.size(); ++i) {
        const double area = leaves[i].size * leaves[i].size;
        all += area;
        if (i < count) left += area;
    }
    if (left > 0.0)
        for (PlacedLeaf& leaf : kept) leaf.size *= std::sqrt(all / left);
    return kept;
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

namespace {

std::vector<TreePreset> make_presets() {
    std::vector<TreePreset> presets;
    {
        TreeShape oak;
        oak.topology.matrix = MatrixKind::random_increasing;
        oak.topology.toward = MatrixKind::random_binary;
        oak.topology.blend = 0.6;
        oak.topology.order = 7;
        oak.fork_deg = 34;
        oak.main_deg = 20;
        oak.side_deg = 65;
        oak.length_law = OrderLaw::geometric;
        oak.length_rise = 1.3;
        oak.twig_length = 0.085;
        oak.width_rise = 2.0;
        oak.twig_radius = 0.0028;
        oak.trunk = 0.8;
        oak.plagiotropy = 0.3;
        oak.gravitropism = 0.015;
        oak.phototropism = 0.02;
        presets.push_back({"broadleaf",
                           "Broadleaf",
                           "oak",
                           oak,
                           {.per_tip = 9, .leaf_size = 1.7, .leaf_deg = 60, .droop = 0.3},
                           {.ridge = {112, 98, 82},
                            .furrow = {44, 37, 31},
                            .furrows = 0.9,
                            .ridges = 14,
                            .stretch = 5}});
    }
    {
        TreeShape birch;
        birch.topology.rows = {{{0.7, 0.3}},
                               {{0.35, 0.4, 0.25}},
                               {{0.1, 0.3, 0.45, 0.15}},
                               {{0.02, 0.08, 0.45, 0.4, 0.05}}};
        birch.topology.order = 5;
        birch.fork_deg = 24;
        birch.main_deg = 6;
        birch.side_deg = 62;
        birch.length_law = OrderLaw::geometric;
        birch.length_rise = 1.12;
        birch.twig_length = 0.13;
        birch.width_rise = 2.0;
        birch.twig_radius = 0.002;
        birch.trunk = 1.2;
        birch.shortening = 0.5;
        birch.gravitropism = -0.015;
        presets.push_back({"birch",
                           "Birch-like",
                           "birch",
                           birch,
                           {.per_tip = 8, .leaf_size = 1.9, .leaf_deg = 50, .droop = 0.8},
                           {.ridge = {222, 218, 208},
                            .furrow = {90, 84, 80},
                            .furrows = 0.15,
                            .ridges = 6,
                            .stretch = 1.5,
                            .lenticels = 0.5}});
    }
    {
        TreeShape spruce;
        spruce.topology.rows = {{{0.92, 0.08}}, {{0.5, 0.42, 0.08}}, {{0.02, 0.966, 0.0, 0.014}}};
        spruce.topology.order = 4;
        spruce.fork_deg = 20;
        spruce.main_deg = 0;
        spruce.side_deg = 100;
        spruce.length_law = OrderLaw::geometric;
        spruce.length_rise = 0.85;
        spruce.twig_length = 0.12;
        spruce.width_rise = 2.0;
        spruce.twig_radius = 0.0022;
        spruce.trunk = 0.3;
        spruce.shortening = 0.9;
        spruce.plagiotropy = 0.9;
        spruce.gravitropism = -0.02;
        presets.push_back(
            {"spruce",
             "Spruce-like",
             "shoot",
             spruce,
             {.per_tip = 4, .leaf_size = 1.9, .leaf_deg = 45, .droop = 0.15, .size_spread = 0.3},
             {.ridge = {112, 84, 66},
              .furrow = {62, 44, 36},
              .furrows = 0.6,
              .ridges = 18,
              .stretch = 1.4}});
    }
    {
        TreeShape poplar;
        poplar.topology.rows = {{{0.75, 0.25}}, {{0.4, 0.45, 0.15}}, {{0.05, 0.3, 0.62, 0.03}}};
        poplar.topology.order = 4;
        poplar.fork_deg = 16;
        poplar.main_deg = 4;
        poplar.side_deg = 80;
        poplar.length_law = OrderLaw::geometric;
        poplar.length_rise = 1.15;
        poplar.twig_length = 0.11;
        poplar.width_rise = 2.0;
        poplar.twig_radius = 0.003;
        poplar.trunk = 0.6;
        poplar.shortening = 0.5;
        poplar.gravitropism = 0.06;
        presets.push_back({"poplar",
                           "Poplar-like",
                           "birch",
                           poplar,
                           {.per_tip = 9, .leaf_size = 1.8, .leaf_deg = 55, .droop = 0.35},
                           {.ridge = {122, 116, 100},
                            .furrow = {58, 52, 44},
                            .furrows = 0.7,
                            .ridges = 10,
                            .stretch = 6}});
    }
    {
        TreeShape shrub;
        shrub.topology.matrix = MatrixKind::perfect;
        shrub.topology.toward = MatrixKind::random_increasing;
        shrub.topology.blend = 0.5;
        shrub.topology.order = 8;
        shrub.fork_deg = 26;
        shrub.main_deg = 14;
        shrub.side_deg = 50;
        shrub.length_law = OrderLaw::linear;
        shrub.length_rise = 0.12;
        shrub.twig_length = 0.08;
        shrub.width_rise = 2.4;
        shrub.twig_radius = 0.0022;
        shrub.trunk = 0.05;
        shrub.gravitropism = 0.04;
        presets.push_back({"shrub",
                           "Shrub",
                           "maple",
                           shrub,
                           {.per_tip = 4, .leaf_size = 0.5, .leaf_deg = 55, .droop = 0.2},
                           {.ridge = {104, 84, 62},
                            .furrow = {70, 56, 42},
                            .furrows = 0.2,
                            .ridges = 10,
                            .stretch = 4,
                            .lenticels = 0.2,
                            .lenticel = {150, 128, 100}}});
    }
    {
        TreeShape herb;
        herb.topology.rows = {{{0.6, 0.4}}, {{0.25, 0.6, 0.15}}};
        herb.topology.order = 3;
        herb.topology.tips = MatrixKind::fishbone;
        herb.topology.forks = 0.35;
        herb.topology.tip_order = 3;
        herb.fork_deg = 22;
        herb.main_deg = 8;
        herb.side_deg = 48;
        herb.length_law = OrderLaw::linear;
        herb.length_rise = 0.5;
        herb.twig_length = 0.014;
        herb.width_rise = 2.6;
        herb.twig_radius = 0.0005;
        herb.trunk = 0.03;
        herb.gravitropism = 0.08;
        presets.push_back({"herb",
                           "Herb",
                           "birch",
                           herb,
                           {.per_tip = 3, .leaf_size = 0.5, .leaf_deg = 60, .droop = 0.1},
                           {.ridge = {96, 120, 62},
                            .furrow = {70, 96, 46},
                            .furrows = 0.25,
                            .ridges = 8,
                            .stretch = 12}});
    }
    return presets;
}

}  // namespace

std::span<const TreePreset> tree_presets() {
    static const std::vector<TreePreset> presets = make_presets();
    return presets;
}

const TreePreset* tree_preset(std::string_view id) {
    for (const TreePreset& preset : tree_presets())
        if (id == preset.id) return &preset;
    return nullptr;
}

}  // namespace sporeprint
