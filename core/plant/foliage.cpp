#include "core/plant/foliage.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/vector_relational.hpp>
#include <utility>

#include "core/math/direction.h"
#include "core/math/elementary.h"
#include "core/math/principal_axes.h"

namespace sporeprint {

namespace {

// By level of detail: the share of leaves that remains, and the number below which all remain.
// Measured: in pictures of 40 pixels the outlines of broad-leaved trees change by a tenth at most.
constexpr std::array<double, tree_lods> shares = {1.0, 0.45, 0.15, 0.05};
constexpr std::array<double, tree_lods> least = {0.0, 16'000.0, 2'500.0, 1'700.0};

// By level of detail: triangles of a leaf where few leaves stand, and the number of triangles of all
// leaves above which each has fewer.
constexpr std::array<std::size_t, tree_lods> most_triangles = {most_foliage_triangles, 12, 4, 4};
constexpr std::array<std::size_t, tree_lods> most_in_all = {160'000, 64'000, 10'000, 6'800};

// Length of a group's leaf in its breadths at most; more would be a stripe.
constexpr double most_slender = 6.0;

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

/// The dimensions of a kite-shaped leaf of size 1, metres.
struct Kite {
    double length = 0.0, half_breadth = 0.0;
    double middle = 0.0;  ///< distance of its centroid from its root
    double area = 0.0;

    explicit Kite(const Mesh& leaf) {
        double widest = 0.0;
        for (const glm::vec3& place : leaf.positions) {
            length = std::max(length, static_cast<double>(place.z));
            if (std::abs(place.x) <= half_breadth) continue;
            half_breadth = std::abs(place.x);
            widest = place.z;
        }
        middle = (length + widest) / 3.0;
        area = length * half_breadth;
    }
};

glm::dmat3 product(const glm::dvec3& v) { return {v * v.x, v * v.y, v * v.z}; }

/// Returns the one leaf that covers what a group covers.
///
/// group  at least two leaves, neighbours in the order of the tree
PlacedLeaf cover_of(std::span<const PlacedLeaf> group, const Kite& kite) {
    double weight = 0.0;
    glm::dvec3 centre(0.0), along(0.0), up(0.0);
    const auto middle = [&](const PlacedLeaf& leaf) {
        return leaf.place + kite.middle * leaf.size * leaf.along;
    };
    for (const PlacedLeaf& leaf : group) {
        const double own = square(leaf.size);
        weight += own;
        centre += own * middle(leaf);
        along += own * leaf.along;
        up += own * leaf.up;
    }
    centre /= weight;
    // Each leaf counts as an ellipse: its variance is a quarter of the square of its semi-axis.
    glm::dmat3 covariance(0.0);
    for (const PlacedLeaf& leaf : group) {
        const double share = square(leaf.size) / weight;
        const glm::dvec3 side = glm::cross(leaf.up, leaf.along);
        covariance += share * (product(middle(leaf) - centre) +
                               0.25 * product(0.5 * kite.length * leaf.size * leaf.along) +
                               0.25 * product(kite.half_breadth * leaf.size * side));
    }
    const PrincipalAxes axes = principal_axes(covariance);
    const double a = std::sqrt(axes.variances[0]), b = std::sqrt(axes.variances[1]),
                 c = std::sqrt(axes.variances[2]);
    const double section = 4.0 * pi * (a * b + a * c + b * c) / 3.0;
    const double all = weight * kite.area;
    const double area =
        section > 0.0 ? 2.0 * section * (1.0 - exponential(-0.5 * all / section)) : all;
    const double slender = b > 0.0 ? std::min(a / b, most_slender) : most_slender;
    const double half_breadth = std::sqrt(0.5 * area / slender);
    PlacedLeaf cover = group[group.size() / 2];
    cover.along =
        glm::dot(axes.directions[0], along) < 0.0 ? -axes.directions[0] : axes.directions[0];
    cover.up = square_to(cover.along, glm::dot(axes.directions[2], up) < 0.0 ? -axes.directions[2]
                                                                             : axes.directions[2]);
    cover.size = 2.0 * slender * half_breadth / kite.length;
    cover.breadth = half_breadth / (kite.half_breadth * cover.size);
    cover.place = centre - kite.middle * cover.size * cover.along;
    return cover;
}

}  // namespace

std::size_t foliage_count(int lod, std::size_t leaves) {
    const auto all = static_cast<double>(leaves);
    return static_cast<std::size_t>(
        std::ceil(std::max(shares[index_of(lod)] * all, std::min(all, least[index_of(lod)]))));
}

std::size_t leaf_triangles(int lod, std::size_t leaves) {
    const std::size_t fewest = lod == 0 ? 8 : 4;
    if (foliage_count(lod, leaves) < leaves) return fewest;
    std::size_t triangles = most_triangles[index_of(lod)];
    while (triangles > fewest && triangles * leaves > most_in_all[index_of(lod)]) triangles -= 4;
    return triangles;
}

std::size_t leaf_vertices(std::size_t triangles) {
    // Both faces have their own corners, and a centre if they are more than two triangles each.
    return triangles == 4 ? 8 : triangles + 2;
}

std::vector<PlacedLeaf> grouped(const Tree& tree, std::span<const PlacedLeaf> leaves,
                                const Mesh& leaf, std::size_t count) {
    std::vector<PlacedLeaf> sorted(leaves.begin(), leaves.end());
    if (count >= sorted.size()) return sorted;
    const std::vector<std::uint32_t> ranks = depth_first_ranks(tree.ramification);
    std::sort(sorted.begin(), sorted.end(), [&](const PlacedLeaf& a, const PlacedLeaf& b) {
        return std::pair(ranks[a.twig], a.id) < std::pair(ranks[b.twig], b.id);
    });
    const Kite kite(leaf);
    std::vector<PlacedLeaf> covers;
    covers.reserve(count);
    for (std::size_t i = 0; i < count; ++i) {
        const std::size_t begin = i * sorted.size() / count, end = (i + 1) * sorted.size() / count;
        const std::span<const PlacedLeaf> group(&sorted[begin], end - begin);
        covers.push_back(group.size() == 1 ? group[0] : cover_of(group, kite));
    }
    return covers;
}

Foliage foliage_of(const Tree& tree, const LeafStyle& style, const LeafShape& shape,
                   std::uint32_t seed, int lod) {
    std::vector<PlacedLeaf> all = placed_leaves(tree, style, seed);
    if (all.empty()) return {};
    const std::size_t count = foliage_count(lod, all.size()),
                      triangles = leaf_triangles(lod, all.size());
    // The same leaves at the same places, so that files with several levels share them.
    if (count == all.size()) return {std::move(all), foliage_leaf(shape, triangles)};
    const Farthest farthest =
        farthest_first(all, foliage_leaf(shape, leaf_triangles(0, all.size())));
    LeafShape flat = shape;
    flat.curl_deg = flat.fold_deg = flat.wave = 0.0;
    Foliage foliage;
    foliage.leaf = foliage_leaf(flat, triangles);
    // The leaves that reach farthest stay alone, so that the crown keeps its extent.
    const std::span<const PlacedLeaf> alone(all.data(), farthest.count),
        others(all.data() + farthest.count, all.size() - farthest.count);
    foliage.leaves = grouped(tree, others, foliage.leaf, count - farthest.count);
    foliage.leaves.insert(foliage.leaves.end(), alone.begin(), alone.end());
    keep_within(farthest.box, foliage.leaf, foliage.leaves);
    return foliage;
}

}  // namespace sporeprint
