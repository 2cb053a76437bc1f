#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <string>
#include <vector>

#include "core/math/elementary.h"
#include "core/mesh/tangents.h"
#include "core/params/messages.h"
#include "core/plant/tree.h"
#include "core/skeleton/skin.h"

namespace sporeprint {

namespace {

void append(Mesh& mesh, const Mesh& part) {
    const auto shift = static_cast<std::uint32_t>(mesh.positions.size());
    mesh.positions.insert(mesh.positions.end(), part.positions.begin(), part.positions.end());
    mesh.normals.insert(mesh.normals.end(), part.normals.begin(), part.normals.end());
    for (const std::uint32_t index : part.indices) mesh.indices.push_back(index + shift);
}

// A group of orders that is skinned together: trunk and great branches, branches, twigs.
struct Group {
    int low = 1, high = 1;  // orders
    int levels = 0;         // of subdivision
    double gap = 0.0;       // longest distance without a node, in radii
};

std::vector<Group> groups_of(int highest, int lod) {
    // A low tree keeps the branches that carry its leaves while its trunk is wider than a line.
    const int lowest =
        std::clamp(1 + lod, 1, std::max(1, highest - (lod + 1 == tree_lods ? 1 : 2)));
    std::vector<Group> groups;
    int high = highest;
    for (int i = 0; i < 3 && high >= lowest; ++i) {
        // Twigs of order 1, half of all segments, are never subdivided.
        const int low = i == 2 ? lowest : std::max({lowest, high - 1, std::min(high, 2)});
        groups.push_back(
            {low, high, std::max(0, 2 - i - lod), i == 2 ? 1e9 : 3.0 * (1 + i) * (1 + lod)});
        high = low - 1;
    }
    return groups;
}

void throw_too_thin(double nodes) {
    throw Impossible("/twig_radius",
                     "bark would need about " + number_text(std::floor(nodes)) +
                         " rings, its branches are so thin for their length; at most " +
                         std::to_string(most_skeleton_nodes) + " are made");
}

// Returns true if a node can be removed between two others: it is nearly on their line, has nearly
// their radius, and they are less than `gap` radii apart.
bool is_dispensable(const Skeleton::Node& here, const Skeleton::Node& before,
                    const Skeleton::Node& after, double tolerance, double gap) {
    const glm::dvec3 way = after.place - before.place;
    const double whole = glm::dot(way, way);
    if (!(whole > 0.0)) return false;
    const double t = glm::dot(here.place - before.place, way) / whole;
    const double aside = glm::length(here.place - before.place - t * way);
    const double wanted = before.radius + t * (after.radius - before.radius);
    return whole < gap * gap * here.radius * here.radius && aside < tolerance * here.radius &&
           std::abs(wanted - here.radius) < 0.5 * tolerance * here.radius;
}

// Copies segments of a tree to a skeleton of their own.
class PartBuilder {
  public:
    explicit PartBuilder(double gap) : gap_(gap) {}

    std::uint32_t add(const Skeleton::Node& node) {
        part_.nodes.push_back(node);
        return static_cast<std::uint32_t>(part_.nodes.size() - 1);
    }

    // Adds a segment to a new node, with nodes in between where it is longer than `gap` radii;
    // returns the index of the new node. The label is the edge of the tree.
    std::uint32_t add_segment(std::uint32_t from, const Skeleton::Node& to, std::uint32_t label) {
        const Skeleton::Node start = part_.nodes[from];
        const double length = glm::distance(start.place, to.place);
        const double steps = std::floor(length / (gap_ * std::max(start.radius, to.radius)));
        if (static_cast<double>(part_.nodes.size()) + steps >
            static_cast<double>(most_skeleton_nodes))
            throw_too_thin(static_cast<double>(part_.nodes.size()) + steps);
        for (double step = 1.0; step <= steps; step += 1.0) {
            const double t = step / (steps + 1.0);
            const std::uint32_t between = add({start.place + t * (to.place - start.place),
                                               start.radius + t * (to.radius - start.radius)});
            part_.segments.push_back({from, between, label});
            from = between;
        }
        const std::uint32_t end = add(to);
        part_.segments.push_back({from, end, label});
        return end;
    }

    [[nodiscard]] const Skeleton::Node& node(std::uint32_t i) const { return part_.nodes[i]; }
    Skeleton take() && { return std::move(part_); }

  private:
    double gap_;
    Skeleton part_;
};

// Returns the segments of orders low..high as a skeleton of their own. Nodes nearly on the line
// between their neighbours are removed, and distances longer than `gap` radii get nodes, because an
// image that is mirrored between two rings would appear stretched.
Skeleton part_of(const Tree& tree, const Group& group, double tolerance) {
    const Ramification& grown = tree.ramification;
    const std::size_t count = grown.nodes.size();
    const auto within = [&](std::uint32_t i) {
        return grown.nodes[i].order >= group.low && grown.nodes[i].order <= group.high;
    };
    std::vector<std::uint32_t> children(count, 0);
    for (std::uint32_t i = 1; i < count; ++i)
        if (within(i)) ++children[grown.nodes[i].parent];
    PartBuilder part(group.gap);
    // The index of each node in the part; of a removed node that of the last one before it that
    // remains.
    std::vector<std::uint32_t> place(count, Ramification::none);
    for (std::uint32_t i = 0; i < count; ++i) {
        if (!within(i)) continue;
        const Skeleton::Node& here = tree.skeleton.nodes[i + 1];
        const std::uint32_t parent = grown.nodes[i].parent;
        std::uint32_t from = Ramification::none;
        if (parent != Ramification::none && within(parent)) {
            from = place[parent];
        } else {
            // A part that starts on a thicker one starts inside it, with its own radius.
            Skeleton::Node root = tree.skeleton.nodes[tree.skeleton.segments[i].from];
            if (parent != Ramification::none) root.radius = std::min(root.radius, here.radius);
            from = part.add(root);
        }
        if (children[i] == 1) {
            const std::uint32_t next = within(grown.nodes[i].children[0])
                                           ? grown.nodes[i].children[0]
                                           : grown.nodes[i].children[1];
            if (is_dispensable(here, part.node(from), tree.skeleton.nodes[next + 1], tolerance,
                               group.gap)) {
                place[i] = from;
                continue;
            }
        }
        place[i] = part.add_segment(from, here, i);
    }
    return std::move(part).take();
}

}  // namespace

Bark bark_of(const Tree& tree, int lod) {
    if (lod < 0 || lod >= tree_lods)
        throw InvalidInput("/lod",
                           std::to_string(lod) + " is outside 0.." + std::to_string(tree_lods - 1));
    Bark made;
    Mesh& bark = made.mesh;
    for (const Group& group : groups_of(tree.ramification.nodes[0].order, lod)) {
        const Skeleton part = part_of(tree, group, 0.25 * (1 + lod));
        if (part.segments.empty()) continue;
        const SkinnedSkeleton skin = skinned(cleaned(part).skeleton, group.levels);
        append(bark, skin.mesh);
        made.edges.insert(made.edges.end(), skin.labels.begin(), skin.labels.end());
        for (std::size_t s = 0; s < skin.strips.size(); ++s) {
            const double girth = 2.0 * pi * skin.strips[s].radius;
            for (std::uint32_t i = skin.begins[s]; i < skin.begins[s + 1]; ++i) {
                // Mirrored repeat, so that the image is continuous at both of its ends.
                const double images = std::abs(skin.places[i].y) / (bark_girths * girth);
                const double whole = 2.0 * std::floor(0.5 * images);
                bark.texture_coordinates.emplace_back(std::clamp(skin.places[i].x, 0.0, 1.0),
                                                      1.0 - std::abs(1.0 - (images - whole)));
            }
        }
    }
    add_tangents(bark);
    return made;
}

TreeCount count_of_bark(const TreeShape& shape, int lod) {
    const std::vector<ExpectedOrder> orders = expected_orders(shape);
    TreeCount count;
    double rings = 0.0;
    for (const Group& group : groups_of(static_cast<int>(orders.size()), lod)) {
        // Quads round a segment times rings along it, plus those of the seam, forks and ends.
        double segments = 0.0, between = 0.0;
        for (int k = group.low; k <= group.high; ++k) {
            const ExpectedOrder& order = orders[static_cast<std::size_t>(k - 1)];
            segments += order.edges;
            between += order.edges * std::floor(order.length / (group.gap * order.radius));
        }
        const ExpectedOrder& top = orders[static_cast<std::size_t>(group.high - 1)];
        if (group.high == static_cast<int>(orders.size()))
            between += shape.trunk / (group.gap * top.radius);
        rings += segments + between;
        const double faces = static_cast<double>(std::size_t{4} << (2 * group.levels));
        count.vertices += (4.3 * segments + 1.35 * between) * (faces + 2.0);
        count.triangles += 2.0 * (4.0 * segments + 1.35 * between) * faces;
    }
    if (rings > static_cast<double>(most_skeleton_nodes)) throw_too_thin(rings);
    return count;
}

}  // namespace sporeprint
