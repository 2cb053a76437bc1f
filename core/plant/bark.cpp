#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <span>
#include <string>
#include <vector>

#include "core/math/elementary.h"
#include "core/mesh/tangents.h"
#include "core/params/messages.h"
#include "core/plant/tree.h"
#include "core/skeleton/skin.h"

namespace sporeprint {

namespace {

// Consecutive orders that are skinned together.
struct Group {
    int low = 1, high = 1;  // orders
    int levels = 0;         // of subdivision
    double gap = 0.0;       // longest distance without a node, in radii
};

// Radius of a branch where it leaves a thicker one, in its radius at the end of its first edge; no
// source or measurement is recorded.
constexpr double collar = 1.4;

// Distance of two nodes at least, in radii: cleaned() takes nearer ones apart, and the skin and its
// image would begin anew.
constexpr double apart = 2.1;

// Returns how thin an order is: 0 for the trunk, 1 for branches, 2 for twigs, which are never
// subdivided.
int thinness(int order, int highest) {
    if (order == highest) return 0;
    return highest - order < 4 && order > 2 ? 1 : 2;
}

// By level of detail: the most segments of a tree whose finest orders are left out only beyond it.
// Few twigs cost little, and they are half of the outline of a shrub.
constexpr std::array<double, tree_lods> most_segments = {1e9, 500.0, 300.0, 150.0};

// Returns the lowest order that is shown at a level of detail.
//
// segments  of each order, from 1
int lowest_order(std::span<const double> segments, int lod) {
    const auto highest = static_cast<int>(segments.size());
    // A low tree keeps the branches that carry its leaves while its trunk is wider than a line.
    int lowest = std::clamp(1 + lod, 1, std::max(1, highest - (lod + 1 == tree_lods ? 1 : 2)));
    double sum = 0.0;
    for (int order = highest; order >= 1; --order) {
        sum += segments[static_cast<std::size_t>(order - 1)];
        if (sum > most_segments[static_cast<std::size_t>(lod)]) break;
        lowest = std::min(lowest, order);
    }
    return lowest;
}

// Returns how far a node may lie beside the line between its neighbours, in its radii, to be left out.
// Twigs are so thin that at coarse levels many times their radius is less than a pixel.
double tolerance_of(const Group& group, int highest, int lod) {
    const double coarse = 1.0 + lod;
    return thinness(group.high, highest) == 2 ? 0.25 * coarse * coarse : 0.25 * coarse;
}

// Returns the groups of the orders lowest..highest, thickest first.
std::vector<Group> groups_of(int highest, int lowest, int lod) {
    std::vector<Group> groups;
    for (int order = highest; order >= lowest; --order) {
        const int thin = thinness(order, highest);
        if (!groups.empty() && thinness(groups.back().high, highest) == thin)
            groups.back().low = order;
        else
            groups.push_back({order, order, std::max(0, 2 - thin - lod),
                              thin == 2 ? 1e9 : 3.0 * (1 + thin) * (1 + lod)});
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
        const double thick = std::max(start.radius, to.radius);
        const double steps = std::max(0.0, std::min(std::floor(length / (gap_ * thick)),
                                                    std::floor(length / (apart * thick)) - 1.0));
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
            // A part that starts on a thicker one starts inside it, with a collar about its foot.
            Skeleton::Node root = tree.skeleton.nodes[tree.skeleton.segments[i].from];
            if (parent != Ramification::none)
                root.radius = std::min(root.radius, collar * here.radius);
            from = part.add(root);
        }
        if (children[i] == 1) {
            const std::uint32_t next = within(grown.nodes[i].children[0])
                                           ? grown.nodes[i].children[0]
                                           : grown.nodes[i].children[1];
            // The end of the axis stays, so that the node before it has to go.
            const Skeleton::Node &start = part.node(from), &end = tree.skeleton.nodes[next + 1];
            const bool is_near =
                glm::distance(start.place, here.place) <
                    apart * std::max(start.radius, here.radius) ||
                (children[next] == 0 &&
                 glm::distance(here.place, end.place) < apart * std::max(here.radius, end.radius));
            if (is_near && group.levels > 0 && group.low == grown.nodes[0].order) {
                place[i] = from;
                continue;
            }
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

// Turns of a trunk's skin about its middle line, to a girth along it. An image is mirrored at each of
// its ends, so it returns after two images; a golden angle between its returns brings each to another
// side than all before. Ridges lean by five degrees, as grain that winds up a tree does.
constexpr double turns_of_girth = 0.381966 / (2.0 * bark_girths);

// The middle line of an unbranched part: points, and directions that change evenly between them.
class MiddleLine {
  public:
    // part  each segment goes on from the end of the one before
    explicit MiddleLine(const Skeleton& part) {
        for (const Skeleton::Segment& segment : part.segments) {
            const glm::dvec3 from = part.nodes[segment.from].place,
                             to = part.nodes[segment.to].place;
            if (at_.empty()) {
                at_.push_back(0.0);
                places_.push_back(from);
            }
            at_.push_back(at_.back() + glm::distance(from, to));
            places_.push_back(to);
        }
        const std::size_t last = places_.size() - 1;
        for (std::size_t i = 0; i <= last; ++i)
            directions_.push_back(
                glm::normalize(places_[std::min(i + 1, last)] - places_[i == 0 ? 0 : i - 1]));
    }

    // Turns a point and its normal about the line.
    //
    // at  of the point, metres along the line
    void turn(double at, double angle, glm::vec3& point, glm::vec3& normal) const {
        const auto after = static_cast<std::size_t>(
            std::upper_bound(at_.begin() + 1, at_.end() - 1, at) - at_.begin());
        const double t =
            std::clamp((at - at_[after - 1]) / (at_[after] - at_[after - 1]), 0.0, 1.0);
        const glm::dvec3 centre = places_[after - 1] + t * (places_[after] - places_[after - 1]);
        const glm::dvec3 axis = glm::normalize(directions_[after - 1] +
                                               t * (directions_[after] - directions_[after - 1]));
        const SineCosine by = sine_cosine(angle);
        const auto turned = [&](const glm::dvec3& v) {
            return by.cosine * v + by.sine * glm::cross(axis, v) +
                   (1.0 - by.cosine) * glm::dot(axis, v) * axis;
        };
        point = glm::vec3(centre + turned(glm::dvec3(point) - centre));
        normal = glm::vec3(glm::normalize(turned(glm::dvec3(normal))));
    }

  private:
    std::vector<double> at_;
    std::vector<glm::dvec3> places_, directions_;
};

// Winds the skin of an unbranched part about its middle line, so that the image on it does not return
// at the same side.
void wind(const Skeleton& part, SkinnedSkeleton& skin) {
    const MiddleLine middle(part);
    const double girth = 2.0 * pi * skin.strips.front().radius;
    for (std::size_t i = 0; i < skin.places.size(); ++i) {
        const double at = skin.places[i].y;
        middle.turn(at, 2.0 * pi * turns_of_girth * at / girth, skin.mesh.positions[i],
                    skin.mesh.normals[i]);
    }
}

}  // namespace

Bark bark_of(const Tree& tree, int lod) {
    if (lod < 0 || lod >= tree_lods)
        throw InvalidInput("/lod",
                           std::to_string(lod) + " is outside 0.." + std::to_string(tree_lods - 1));
    Bark made;
    Mesh& bark = made.mesh;
    const int highest = tree.ramification.nodes[0].order;
    std::vector<double> segments(static_cast<std::size_t>(highest), 0.0);
    for (const Ramification::Node& node : tree.ramification.nodes)
        segments[static_cast<std::size_t>(node.order - 1)] += 1.0;
    for (const Group& group : groups_of(highest, lowest_order(segments, lod), lod)) {
        const Skeleton part = part_of(tree, group, tolerance_of(group, highest, lod));
        if (part.segments.empty()) continue;
        const Skeleton clean = cleaned(part).skeleton;
        SkinnedSkeleton skin = skinned(clean, group.levels);
        // Tubes of four sides would be twisted; their images are too small to be recognised again.
        if (group.low == highest && group.levels > 0 && skin.strips.size() == 1) wind(clean, skin);
        append(bark, skin.mesh);
        made.edges.insert(made.edges.end(), skin.labels.begin(), skin.labels.end());
        for (std::size_t s = 0; s < skin.strips.size(); ++s) {
            const double girth = 2.0 * pi * skin.strips[s].radius;
            for (std::uint32_t i = skin.begins[s]; i < skin.begins[s + 1]; ++i) {
                bark.texture_coordinates.emplace_back(
                    std::clamp(skin.places[i].x, 0.0, 1.0),
                    mirrored_place(std::abs(skin.places[i].y) / (bark_girths * girth)));
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
    // A sampled tree may have fewer segments than expected, and therefore show a lower order.
    std::vector<double> fewest;
    fewest.reserve(orders.size());
    for (const ExpectedOrder& order : orders) fewest.push_back(0.75 * order.edges);
    const auto highest = static_cast<int>(orders.size());
    for (const Group& group : groups_of(highest, lowest_order(fewest, lod), lod)) {
        // Quads round a segment times rings along it, plus those of the seam, forks and ends, which
        // are fewer where nothing is subdivided.
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
        const bool is_flat = group.levels == 0;
        count.vertices += ((is_flat ? 2.4 : 4.3) * segments + 1.35 * between) * (faces + 2.0);
        count.triangles += 2.0 * ((is_flat ? 2.0 : 4.0) * segments + 1.35 * between) * faces;
    }
    if (rings > static_cast<double>(most_skeleton_nodes)) throw_too_thin(rings);
    return count;
}

}  // namespace sporeprint
