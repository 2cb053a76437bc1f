// The skin of a colony: roots and stems as one closed mesh, textured as the stem of the species.
#pragma once

#include "core/colony/separation.h"
#include "core/mesh/mesh.h"

namespace sporeprint {

/// Returns roots, if shown, and the stems of all members as a skeleton that still has to be
/// cleaned.
///
/// site     the places of the members
/// lod      of the colony: coarse levels have fewer segments
/// returns  metres at size 1. A stem has the radius of its place up to its last node, which lies
///          inside the neck of its cap and is no thicker than the neck
[[nodiscard]] Skeleton colony_skeleton(const ColonySite& site,
                                       const std::vector<ColonyMember>& members,
                                       const ColonyParams& params, const ColonyTraits& traits,
                                       int segments);

/// Returns the approximate share of root nodes that remain at a level of detail: at coarse levels
/// runs without forks and stems have fewer nodes.
[[nodiscard]] double root_share(int lod);

/// Returns the number of subdivisions of a skeleton with so many nodes: two at LOD 0 (tubes of
/// sixteen sides), one if two would exceed the largest triangle count of a mushroom.
[[nodiscard]] int skin_levels(std::size_t nodes, int lod);

struct SkinOptions {
    int lod = 0;
    double painted_length = 0.1;  ///< length of stem shown by the image, metres at size 1
    bool textured = true;
};

/// Returns the mesh of a skeleton. A stem shows the whole image of one stem, from ground to top;
/// along a root the image is repeated at its own scale, mirrored at rings of the mesh.
///
/// returns  closed; empty for an empty skeleton
/// throws   InvalidInput with validation_errors()
[[nodiscard]] Mesh colony_skin(const Skeleton& segments, const SkinOptions& dress);

}  // namespace sporeprint
