// The smooth surface of a skeleton.
#pragma once

#include <cstdint>
#include <vector>

#include "core/mesh/mesh.h"
#include "core/skeleton/scaffold.h"

namespace sporeprint {

/// A skin whose vertices are welded except at the seam along each strip and the borders between
/// strips.
struct SkinnedSkeleton {
    /// Positions, unit normals (weighted by area, equal on both sides of a seam) and indices.
    Mesh mesh;
    std::vector<Scaffold::Place> places;  ///< one per vertex; empty if not requested
    std::vector<std::uint32_t> labels;    ///< one per vertex: of the segment that it lies on
    std::vector<Scaffold::Strip> strips;
    /// The vertices of strip s are begins[s]..begins[s + 1].
    std::vector<std::uint32_t> begins;
};

/// States whether a skin includes the places of its vertices, which texture coordinates need.
enum class SkinPlaces { included, omitted };

/// Returns the Catmull-Clark subdivision of the scaffold of a clean skeleton.
///
/// clean    the skeleton of a result of cleaned()
/// levels   number of subdivisions, 0..3: tubes of 4, 8, 16 or 32 sides
/// returns  a mesh that is closed once equal positions are welded
/// throws   Impossible with broken_limits()
/// cost     O(nodes 4^levels)
[[nodiscard]] SkinnedSkeleton skinned(const Skeleton& clean, int levels,
                                      SkinPlaces places = SkinPlaces::included);

}  // namespace sporeprint
