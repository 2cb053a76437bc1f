// The skin of a colony: roots and stems as one closed mesh, textured as the stem of the species.
#pragma once

#include <cstdint>
#include <vector>

#include "core/colony/separation.h"
#include "core/mesh/mesh.h"

namespace sporeprint {

/// Depth in the ground at which a stem without root starts, in radii.
inline constexpr double stem_below_ground = 1.6;

/// Returns the skeleton of a colony: its roots, if they are visible, and the stems of all members
/// that have one. It is the input of colony_skin(), which cleans it.
///
/// site      the places of the members
/// params    its level of detail determines how many nodes of the roots remain
/// segments  greatest number of segments of a stem; short stems have fewer
/// returns   metres at size 1. Roots are thinner than the stems on them, lie more or less deep in the
///           ground, and their ends are in it. A stem has the radius of its place up to its last
///           node, which lies inside the neck of its cap and is no thicker than the neck. The label
///           of a segment is 0 on a root and 1 + the index of its member on a stem
[[nodiscard]] Skeleton colony_skeleton(const ColonySite& site,
                                       const std::vector<ColonyMember>& members,
                                       const ColonyParams& params, const ColonyTraits& traits,
                                       int segments);

/// Returns the approximate share, 0..1, of root nodes that colony_skeleton() retains at a level of
/// detail: at coarse levels, paths without forks and stems have fewer nodes.
[[nodiscard]] double root_share(int lod);

/// Returns the number of Catmull-Clark subdivisions, 0..2, for a skeleton of a colony with `nodes`
/// nodes. At LOD 0 it is two (tubes of sixteen sides), or one if two would make more than about
/// 60,000 triangles; each coarser level has one less, at least 0.
[[nodiscard]] int skin_levels(std::size_t nodes, int lod);

struct SkinOptions {
    int lod = 0;
    double painted_length = 0.1;  ///< length of root that one image covers, metres at size 1
    bool textured = true;         ///< makes texture coordinates and tangents
    double painted_from = 0.0;    ///< share of the image, from its base, that shows what is buried
    bool soiled = false;          ///< roots show the image of soil, not that of the stem
};

/// The surface of the skeleton of a colony.
struct ColonySkin {
    Mesh mesh;
    /// By vertex: 0 on a root, 1 + the index of its member on a stem.
    std::vector<std::uint32_t> stems;
};

/// Cleans a skeleton and returns its surface. The texture coordinates of a stem cover
/// the image of one stem, with the ground of the image at the ground. Along a root the image is repeated once per
/// painted_length with mirrored repeat; it is mirrored at the ring of vertices nearest to the end
/// of each image.
///
/// segments  result of colony_skeleton()
/// returns   a closed mesh; empty for an empty skeleton
/// throws    InvalidInput with validation_errors()
[[nodiscard]] ColonySkin colony_skin(const Skeleton& segments, const SkinOptions& options);

}  // namespace sporeprint
