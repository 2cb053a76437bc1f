// The foliage of a tree at its levels of detail: which leaves stand where, and of what mesh they are
// copies.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/mesh/mesh.h"
#include "core/plant/leaf.h"
#include "core/plant/tree.h"

namespace sporeprint {

/// The placed leaves of a tree, and the mesh of which each is a copy.
struct Foliage {
    std::vector<PlacedLeaf> leaves;
    Mesh leaf;
    double covered = 1.0;               ///< share of the leaf's area that its image shows leaves on
    double each = 1.0;                  ///< leaves of the tree for which each stands
    LeafGroup group = LeafGroup::leaf;  ///< what each shows, if its leaf has sprays
};

/// Returns how many leaves a level of detail has, by the number of all leaves: all at levels 0 and 1
/// of common trees, fewer at coarser ones.
///
/// lod  0..tree_lods - 1
[[nodiscard]] std::size_t foliage_count(int lod, std::size_t leaves);

/// Returns the number of triangles of each leaf at a level of detail, by the number of all leaves:
/// 2, 4, 8, 12 or 16.
[[nodiscard]] std::size_t leaf_triangles(int lod, std::size_t leaves);

/// Returns the vertices of foliage_leaf() of so many triangles.
[[nodiscard]] std::size_t leaf_vertices(std::size_t triangles);

/// Returns flat leaves that cover what all leaves cover, each in place of a group of neighbours in
/// the tree, the closest of which are joined first. Such a leaf lies in the plane of its group's
/// first two principal axes, and its area is about what the group covers: with S the mean section of
/// the group's ellipsoid and A the total area of its leaves, 2 S (1 - exp(-A / 2 S)), since leaves in
/// a small volume hide each other.
///
/// leaf   the mesh of which the leaves are copies
/// cover  the mesh of which the result has copies; a flat foliage_leaf() of two or four triangles
/// count  at least 1; at least as many leaves as leaves are returned unchanged
/// share  area of a leaf by that which its group covers
/// cost   O(leaves) while `count` is a fixed share of them, a microsecond for each
/// source the Poisson model of foliage, after Monsi and Saeki; the clustering of Ward (1963)
[[nodiscard]] std::vector<PlacedLeaf> grouped(const Tree& tree, std::span<const PlacedLeaf> leaves,
                                              const Mesh& leaf, const Mesh& cover,
                                              std::size_t count, double share = 1.0);

/// Returns clumps that stand for all leaves, each for a group of neighbours as above: copies of a body
/// about the origin that reaches 1 along each axis. A clump lies in the principal axes of its group,
/// with twice its standard deviations as half axes.
///
/// leaf       the mesh of which the leaves are copies
/// count      at least 1
/// thickness  of a clump at least, in its length
[[nodiscard]] std::vector<PlacedLeaf> clumped(const Tree& tree, std::span<const PlacedLeaf> leaves,
                                              const Mesh& leaf, std::size_t count,
                                              double thickness);

/// Sets the mesh of flat leaves, each of which stands for `each` leaves of the tree, and what it shows.
///
/// of_leaf  what a tree has at the place of one leaf
/// share    as of foliage_leaf()
void set_group_leaf(Foliage& foliage, const LeafShape& shape, LeafGroup of_leaf,
                    std::size_t triangles, double share = 1.0);

/// Returns the foliage of a tree at a level of detail. The crown has the same extent at every level:
/// the leaves that reach farthest are always there, and no group reaches beyond them. Levels with
/// all leaves have them at the same places in the same order.
///
/// shape   of each leaf
/// throws  Impossible (path "/per_tip") for more than most_leaves
[[nodiscard]] Foliage foliage_of(const Tree& tree, const LeafStyle& style, const LeafShape& shape,
                                 std::uint32_t seed, int lod);

}  // namespace sporeprint
