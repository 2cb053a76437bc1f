// A skeleton's smooth skin.
#pragma once

#include "core/mesh/mesh.h"
#include "core/skeleton/scaffold.h"

namespace sporeprint {

/// A skin, its vertices welded but for the seam along each strip and the borders between strips.
struct SkinnedSkeleton {
    /// Positions, unit normals (by area, the same on both sides of a seam) and indices.
    Mesh mesh;
    std::vector<Scaffold::Place> places;  ///< of each vertex; empty if they were not asked for
    std::vector<Scaffold::Strip> strips;
    /// Vertices of strip s are begins[s]..begins[s + 1].
    std::vector<std::uint32_t> begins;
};

/// Whether a skin tells the places of its vertices, as texture coordinates need them.
enum class SkinPlaces { told, left_out };

/// Subdivides the scaffold of a clean skeleton after Catmull and Clark.
///
/// levels   0..3: tubes of 4, 8, 16 or 32 sides
/// returns  closed once equal positions are welded
/// throws   Impossible with broken_limits()
/// cost     O(nodes 4^levels)
[[nodiscard]] SkinnedSkeleton skinned(const Skeleton& clean, int levels,
                                      SkinPlaces places = SkinPlaces::told);

}  // namespace sporeprint
