#include "core/plant/foliage.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <glm/vector_relational.hpp>
#include <numeric>
#include <utility>

#include "core/math/direction.h"
#include "core/math/elementary.h"
#include "core/math/principal_axes.h"
#include "core/mesh/measure.h"
#include "core/plant/leaf_image.h"
#include "core/plant/leaf_shell.h"
#include "core/plant/leaf_spray.h"

namespace sporeprint {

namespace {

// By level of detail: the share of leaves that remains, and the number below which all remain.
// Measured: in pictures of 40 pixels the outlines of all presets change by a tenth at most; those of
// conifers, which are open, need the most leaves.
constexpr std::array<double, tree_lods> shares = {1.0, 0.45, 0.3, 0.1};
constexpr std::array<double, tree_lods> least = {0.0, 16'000.0, 5'600.0, 3'900.0};

// By level of detail: triangles of a leaf where few leaves stand, those below which none goes, and
// the number of triangles of all leaves above which each has fewer.
constexpr std::array<std::size_t, tree_lods> most_triangles = {most_foliage_triangles, 12, 4, 4};
constexpr std::array<std::size_t, tree_lods> fewest_triangles = {4, 4, 2, 2};
constexpr std::array<std::size_t, tree_lods> most_in_all = {200'000, 64'000, 11'200, 7'800};

// Length of a group's leaf in its breadths at most, of ellipses with their variances; more would be a
// stripe.
constexpr double most_slender = 6.0;

// Leaves that are compared with each other when neighbours are joined to groups.
constexpr std::size_t leaves_of_block = 64;

// By level of detail: area of a flat leaf by that which it covers. Measured: a flat leaf is a line
// from its side, where a bent one is not, and at the coarsest level leaves stand for twigs too.
constexpr std::array<double, tree_lods> area_shares = {1.0, 1.04, 1.05, 1.09};
constexpr double area_share_of_group = 1.05;

// The same for cards of sprays of shoots: their needles are before each other, as those of the shoots are.
constexpr double area_share_of_shoots = 1.4;

double square(double x) { return x * x; }

std::size_t index_of(int lod) {
    return static_cast<std::size_t>(std::clamp(lod, 0, tree_lods - 1));
}

struct Box {
    glm::dvec3 low{1e9}, high{-1e9};
};

/// Returns the largest distance of a vertex from the origin.
double reach_of(const Mesh& mesh) {
    double reach = 0.0;
    for (const glm::vec3& place : mesh.positions)
        reach = std::max(reach, static_cast<double>(glm::length(place)));
    return reach;
}

/// Returns the distance from a leaf's root within which all of it lies.
double reach_of(const PlacedLeaf& leaf, double reach) {
    return reach * leaf.size * std::max(1.0, leaf.breadth);
}

/// Returns the bounding box of one placed leaf.
Box box_of(const PlacedLeaf& leaf, const Mesh& mesh) {
    Box box;
    for (const glm::vec3& place : mesh.positions) {
        const glm::dvec3 at = leaf.at(glm::dvec3(place));
        box.low = glm::min(box.low, at);
        box.high = glm::max(box.high, at);
    }
    return box;
}

/// The leaves that reach farthest, two along each axis, stand before all others.
struct Farthest {
    Box box;                ///< of all leaves
    std::size_t count = 0;  ///< of the leaves that reach farthest
};

/// Moves the leaves that reach farthest before all others.
Farthest farthest_first(std::vector<PlacedLeaf>& leaves, const Mesh& mesh) {
    const double reach = reach_of(mesh);
    Box box;
    std::array<std::size_t, 6> farthest{};
    for (std::size_t i = 0; i < leaves.size(); ++i) {
        const glm::dvec3 margin(reach_of(leaves[i], reach));
        if (glm::all(glm::greaterThanEqual(leaves[i].place - margin, box.low)) &&
            glm::all(glm::lessThanEqual(leaves[i].place + margin, box.high)))
            continue;
        const Box own = box_of(leaves[i], mesh);
        for (int axis = 0; axis < 3; ++axis) {
            const auto at = static_cast<std::size_t>(axis);
            if (own.low[axis] < box.low[axis]) farthest[at] = i;
            if (own.high[axis] > box.high[axis]) farthest[at + 3] = i;
        }
        box = {glm::min(box.low, own.low), glm::max(box.high, own.high)};
    }
    std::sort(farthest.begin(), farthest.end());
    const auto end = std::unique(farthest.begin(), farthest.end());
    std::size_t front = 0;
    for (auto one = farthest.begin(); one != end; ++one, ++front) {
        const auto first = leaves.begin() + static_cast<std::ptrdiff_t>(front),
                   found = leaves.begin() + static_cast<std::ptrdiff_t>(*one);
        std::rotate(first, found, found + 1);
    }
    return {box, front};
}

/// Moves leaves that reach beyond a box back into it.
void keep_within(const Box& box, const Mesh& mesh, std::vector<PlacedLeaf>& leaves) {
    const double reach = reach_of(mesh);
    for (PlacedLeaf& leaf : leaves) {
        const glm::dvec3 margin(reach_of(leaf, reach));
        if (glm::all(glm::greaterThanEqual(leaf.place - margin, box.low)) &&
            glm::all(glm::lessThanEqual(leaf.place + margin, box.high)))
            continue;
        const Box own = box_of(leaf, mesh);
        // A leaf wider than the box is centred in it.
        const glm::dvec3 in = glm::max(box.low - own.low, 0.0),
                         out = glm::max(own.high - box.high, 0.0);
        for (int axis = 0; axis < 3; ++axis)
            leaf.place[axis] += in[axis] > 0.0 && out[axis] > 0.0 ? 0.5 * (in[axis] - out[axis])
                                                                  : in[axis] - out[axis];
    }
}

/// Returns the rank of each node in depth-first order, lesser branches before those that go on.
std::vector<std::uint32_t> depth_first_ranks(const Ramification& tree) {
    std::vector<std::uint32_t> ranks(tree.nodes.size()), stack{0};
    for (std::uint32_t rank = 0; !stack.empty(); ++rank) {
        const std::uint32_t i = stack.back();
        stack.pop_back();
        ranks[i] = rank;
        if (!tree.leaf(i))
            stack.insert(stack.end(), {tree.nodes[i].children[0], tree.nodes[i].children[1]});
    }
    return ranks;
}

/// Part of a tree's foliage: its covered area, its middle and the covariance of its points, and the
/// sums of the axes of its leaves.
struct Clump {
    double area = 0.0;
    glm::dvec3 middle{0.0};
    glm::dmat3 covariance{0.0};
    glm::dvec3 along{0.0}, up{0.0};
};

/// Returns one leaf as a clump.
///
/// own  moments of the leaf mesh of size 1, with both faces
Clump clump_of(const PlacedLeaf& leaf, const SurfaceMoments& own) {
    const glm::dmat3 axes(leaf.breadth * glm::cross(leaf.up, leaf.along), leaf.up, leaf.along);
    const double area = 0.5 * own.area * square(leaf.size) * leaf.breadth;
    return {area, leaf.at(own.middle),
            square(leaf.size) * (axes * own.covariance * glm::transpose(axes)), area * leaf.along,
            area * leaf.up};
}

/// Returns clumps as one.
Clump united(std::span<const Clump> clumps) {
    Clump all;
    for (const Clump& one : clumps) {
        all.area += one.area;
        all.middle += one.area * one.middle;
        all.along += one.along;
        all.up += one.up;
    }
    all.middle /= all.area;
    for (const Clump& one : clumps) {
        const glm::dvec3 way = one.middle - all.middle;
        all.covariance += one.area / all.area * (one.covariance + glm::outerProduct(way, way));
    }
    return all;
}

/// Returns the principal axes of one leaf, without looking for them.
///
/// own  those of the leaf mesh of size 1
PrincipalAxes axes_of(const PlacedLeaf& leaf, const PrincipalAxes& own) {
    const glm::dmat3 turn(glm::cross(leaf.up, leaf.along), leaf.up, leaf.along);
    PrincipalAxes axes = own;
    for (glm::dvec3& direction : axes.directions) direction = turn * direction;
    for (double& variance : axes.variances) variance *= square(leaf.size);
    return axes;
}

/// Returns the one leaf that covers what a group covers.
///
/// all      the group, with its principal axes
/// is_group whether it is more than one leaf
/// first    a leaf of the group, whose identity the result has
/// own      moments of the mesh of the result at size 1, which is flat, its axis along z
/// share    of the area that the group covers
PlacedLeaf cover_of(const Clump& all, const PrincipalAxes& axes, bool is_group,
                    const PlacedLeaf& first, const SurfaceMoments& own, double share) {
    const double a = std::sqrt(axes.variances[0]), b = std::sqrt(axes.variances[1]),
                 c = std::sqrt(axes.variances[2]);
    const double section = 4.0 * pi * (a * b + a * c + b * c) / 3.0;
    double area = all.area;
    if (is_group && section > 0.0)
        area = 2.0 * section * (1.0 - exponential(-0.5 * all.area / section));
    area *= share;
    const double slender = b > 0.0 ? std::min(a / b, most_slender) : most_slender,
                 own_slender = std::sqrt(own.covariance[2][2] / own.covariance[0][0]);
    PlacedLeaf cover = first;
    cover.along =
        glm::dot(axes.directions[0], all.along) < 0.0 ? -axes.directions[0] : axes.directions[0];
    cover.up =
        square_to(cover.along, glm::dot(axes.directions[2], all.up) < 0.0 ? -axes.directions[2]
                                                                          : axes.directions[2]);
    cover.breadth = own_slender / slender;
    cover.size = std::sqrt(area / (0.5 * own.area * cover.breadth));
    cover.place = all.middle - cover.size * own.middle.z * cover.along;
    return cover;
}

/// Two groups that may become one.
struct Union {
    double cost = 0.0;
    std::uint32_t into = 0, from = 0;  ///< a leaf of each
};

/// A group of leaves, and the one with which its union is cheapest.
struct Group {
    glm::dvec3 middle{0.0};
    double area = 0.0;
    double cost = 0.0;
    std::uint32_t nearest = 0, leaf = 0;  ///< place of the other group; a leaf of this one
};

/// Finds the cheapest union of a group: areas a and b at a distance d cost a b d^2 / (a + b).
///
/// i  its place
void find_nearest(std::vector<Group>& groups, std::uint32_t i) {
    Group& one = groups[i];
    double cheapest = 1.0, by = 0.0;  // cost, divided by the area of `one`, as a fraction
    for (std::uint32_t k = 0; k < groups.size(); ++k) {
        const glm::dvec3 way = groups[k].middle - one.middle;
        const double cost = groups[k].area * glm::dot(way, way), sum = one.area + groups[k].area;
        if (k == i || cost * by >= cheapest * sum) continue;
        cheapest = cost;
        by = sum;
        one.nearest = k;
    }
    one.cost = one.area * cheapest / by;
}

/// Appends the unions that join all clumps of a block, by rising cost: in each step the two groups
/// whose union adds least to the sum of squared distances from the middles of groups.
///
/// shift   index of the first clump
/// source  Ward's criterion, with the nearest neighbour of each group stored
void append_unions(std::span<const Clump> block, std::uint32_t shift, std::vector<Union>& unions) {
    std::vector<Group> groups;
    groups.reserve(block.size());
    for (const Clump& one : block)
        groups.push_back(
            {one.middle, one.area, 0.0, 0, shift + static_cast<std::uint32_t>(groups.size())});
    if (groups.size() < 2) return;
    for (std::uint32_t i = 0; i < groups.size(); ++i) find_nearest(groups, i);
    double highest = 0.0;
    while (true) {
        std::uint32_t into = 0;
        for (std::uint32_t k = 1; k < groups.size(); ++k)
            if (groups[k].cost < groups[into].cost) into = k;
        std::uint32_t from = groups[into].nearest;
        // Costs rise but for rounding.
        highest = std::max(highest, groups[into].cost);
        unions.push_back({highest, groups[into].leaf, groups[from].leaf});
        if (groups.size() == 2) return;
        // The last group takes the place of the one that goes.
        if (into > from) std::swap(into, from);
        Group& joined = groups[into];
        const double area = joined.area + groups[from].area;
        joined.middle =
            (joined.area * joined.middle + groups[from].area * groups[from].middle) / area;
        joined.area = area;
        const auto last = static_cast<std::uint32_t>(groups.size() - 1);
        groups[from] = groups[last];
        groups.pop_back();
        // No other group is closer to a union than to the closer of its parts.
        for (std::uint32_t k = 0; k < last; ++k) {
            if (k == into || groups[k].nearest == into || groups[k].nearest == from)
                find_nearest(groups, k);
            else if (groups[k].nearest == last)
                groups[k].nearest = from;
        }
    }
}

/// Returns the groups to which clumps are joined, as the first clump of the group of each.
///
/// count  of the groups
std::vector<std::uint32_t> groups_of(std::span<const Clump> clumps, std::size_t count) {
    const std::size_t size = std::max(leaves_of_block, 4 * clumps.size() / count),
                      blocks = std::max<std::size_t>(1, clumps.size() / size);
    std::vector<Union> unions;
    unions.reserve(clumps.size());
    for (std::size_t i = 0; i < blocks; ++i) {
        const std::size_t begin = i * clumps.size() / blocks,
                          end = (i + 1) * clumps.size() / blocks;
        append_unions(clumps.subspan(begin, end - begin), static_cast<std::uint32_t>(begin),
                      unions);
    }
    std::stable_sort(unions.begin(), unions.end(),
                     [](const Union& a, const Union& b) { return a.cost < b.cost; });
    std::vector<std::uint32_t> group(clumps.size());
    std::iota(group.begin(), group.end(), 0U);
    const auto first_of = [&](std::uint32_t i) {
        while (group[i] != i) i = group[i];
        return i;
    };
    for (std::size_t i = 0; i < clumps.size() - count; ++i) {
        const std::uint32_t a = first_of(unions[i].into), b = first_of(unions[i].from);
        group[std::max(a, b)] = std::min(a, b);
    }
    for (std::uint32_t i = 0; i < group.size(); ++i) group[i] = first_of(i);
    return group;
}

}  // namespace

std::size_t foliage_count(int lod, std::size_t leaves) {
    const auto all = static_cast<double>(leaves);
    return static_cast<std::size_t>(
        std::ceil(std::max(shares[index_of(lod)] * all, std::min(all, least[index_of(lod)]))));
}

std::size_t leaf_triangles(int lod, std::size_t leaves) {
    const std::size_t fewest = fewest_triangles[index_of(lod)];
    if (foliage_count(lod, leaves) < leaves) return fewest;
    std::size_t triangles = most_triangles[index_of(lod)];
    while (triangles > fewest && triangles * leaves > most_in_all[index_of(lod)])
        triangles -= triangles > 4 ? 4 : 2;
    return triangles;
}

std::size_t leaf_vertices(std::size_t triangles) {
    // Both faces have their own corners, and a centre if they are more than two triangles each.
    return triangles <= 4 ? triangles + 4 : triangles + 2;
}

namespace {

/// Joins leaves to groups and returns what stands for each.
///
/// cover  called with the group, its principal axes, whether it is more than one leaf, and its first
///        leaf
template <class Cover>
std::vector<PlacedLeaf> covers_of(const Tree& tree, std::vector<PlacedLeaf> sorted,
                                  const Mesh& leaf, std::size_t count, const Cover& cover) {
    const std::vector<std::uint32_t> ranks = depth_first_ranks(tree.ramification);
    std::sort(sorted.begin(), sorted.end(), [&](const PlacedLeaf& a, const PlacedLeaf& b) {
        return std::pair(ranks[a.twig], a.id) < std::pair(ranks[b.twig], b.id);
    });
    const SurfaceMoments of_leaf = surface_moments(leaf);
    const PrincipalAxes axes_of_leaf = principal_axes(of_leaf.covariance);
    std::vector<Clump> clumps;
    clumps.reserve(sorted.size());
    for (const PlacedLeaf& one : sorted) clumps.push_back(clump_of(one, of_leaf));
    const std::vector<std::uint32_t> group = groups_of(clumps, count);
    // Clumps by group, since the first of a group is the one that names it.
    std::vector<std::uint32_t> order(clumps.size());
    std::iota(order.begin(), order.end(), 0U);
    std::stable_sort(order.begin(), order.end(),
                     [&](std::uint32_t a, std::uint32_t b) { return group[a] < group[b]; });
    std::vector<PlacedLeaf> covers;
    covers.reserve(count);
    std::vector<Clump> members;
    for (std::size_t begin = 0; begin < order.size();) {
        const std::uint32_t first = group[order[begin]];
        members.clear();
        for (; begin < order.size() && group[order[begin]] == first; ++begin)
            members.push_back(clumps[order[begin]]);
        const PlacedLeaf& leaf_of_group = sorted[first];
        const bool is_group = members.size() > 1;
        const Clump all = is_group ? united(members) : members.front();
        const PrincipalAxes axes = is_group || leaf_of_group.breadth != 1.0
                                       ? principal_axes(all.covariance)
                                       : axes_of(leaf_of_group, axes_of_leaf);
        covers.push_back(cover(all, axes, is_group, leaf_of_group));
    }
    return covers;
}

}  // namespace

std::vector<PlacedLeaf> grouped(const Tree& tree, std::span<const PlacedLeaf> leaves,
                                const Mesh& leaf, const Mesh& cover, std::size_t count,
                                double share) {
    std::vector<PlacedLeaf> sorted(leaves.begin(), leaves.end());
    if (count >= sorted.size()) return sorted;
    const SurfaceMoments of_cover = surface_moments(cover);
    return covers_of(
        tree, std::move(sorted), leaf, count,
        [&](const Clump& all, const PrincipalAxes& axes, bool is_group, const PlacedLeaf& first) {
            return cover_of(all, axes, is_group, first, of_cover, share);
        });
}

std::vector<PlacedLeaf> clumped(const Tree& tree, std::span<const PlacedLeaf> leaves,
                                const Mesh& leaf, std::size_t count, double thickness) {
    return covers_of(
        tree, {leaves.begin(), leaves.end()}, leaf, std::min(count, leaves.size()),
        [&](const Clump& all, const PrincipalAxes& axes, bool, const PlacedLeaf& first) {
            PlacedLeaf clump = first;
            clump.along = axes.directions[0];
            clump.up = square_to(
                clump.along, axes.directions[2].y < 0.0 ? -axes.directions[2] : axes.directions[2]);
            clump.place = all.middle;
            clump.size = 2.0 * std::sqrt(axes.variances[0]);
            const auto share = [&](std::size_t axis) {
                return std::max(thickness, std::sqrt(axes.variances[axis] / axes.variances[0]));
            };
            clump.breadth = share(1);
            clump.thickness = share(2);
            return clump;
        });
}

void set_group_leaf(Foliage& foliage, const LeafShape& shape, LeafGroup of_leaf,
                    std::size_t triangles, double share) {
    LeafShape flat = shape;
    flat.curl_deg = flat.fold_deg = flat.wave = 0.0;
    foliage.group = std::max(group_of(foliage.each), of_leaf);
    GroupLeaf leaf = leaf_of_group(flat, triangles, foliage.group, share);
    foliage.leaf = std::move(leaf.mesh);
    foliage.covered = leaf.covered;
}

namespace {

/// Returns the area of what stands for groups by that which these cover.
double share_of_groups(const Foliage& foliage, const LeafShape& shape) {
    const bool are_shoots = foliage.group != LeafGroup::leaf && shows_shoots(shape);
    return are_shoots ? area_share_of_shoots : area_share_of_group / foliage.covered;
}

}  // namespace

Foliage foliage_of(const Tree& tree, const LeafStyle& style, const LeafShape& shape,
                   std::uint32_t seed, int lod) {
    std::vector<PlacedLeaf> all = placed_leaves(tree, style, seed);
    if (all.empty()) return {};
    const std::size_t count = foliage_count(lod, all.size()),
                      triangles = leaf_triangles(lod, all.size());
    // The same leaves at the same places, so that files with several levels share them.
    const double share = area_shares[index_of(lod)];
    const LeafGroup of_leaf = style.leaf_group;
    if (lod == 0) return {std::move(all), finest_foliage_leaf(shape, triangles, of_leaf)};
    if (count == all.size()) {
        GroupLeaf leaf = leaf_of_group(shape, triangles, of_leaf, share);
        return {std::move(all), std::move(leaf.mesh), leaf.covered, 1.0, of_leaf};
    }
    const std::size_t finest_triangles = leaf_triangles(0, all.size());
    const Farthest farthest =
        farthest_first(all, finest_foliage_leaf(shape, finest_triangles, of_leaf));
    Foliage foliage;
    foliage.each = static_cast<double>(all.size()) / static_cast<double>(count);
    set_group_leaf(foliage, shape, of_leaf, triangles, share);
    // The leaves that reach farthest stay alone, so that the crown keeps its extent.
    const std::span<const PlacedLeaf> alone(all.data(), farthest.count),
        others(all.data() + farthest.count, all.size() - farthest.count);
    foliage.leaves = grouped(tree, others, finest_foliage_leaf(shape, finest_triangles),
                             foliage.leaf, count - farthest.count, share_of_groups(foliage, shape));
    foliage.leaves.insert(foliage.leaves.end(), alone.begin(), alone.end());
    keep_within(farthest.box, foliage.leaf, foliage.leaves);
    return foliage;
}

}  // namespace sporeprint
