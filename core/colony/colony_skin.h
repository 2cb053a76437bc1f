// The skin of a colony: its roots and stems as one closed mesh that wears the stem of its species.
#pragma once

#include "core/colony/separation.h"
#include "core/mesh/mesh.h"

namespace sporeprint {

/// Roots, where they are shown, and the stems of all members, as a skeleton that may still be cleaned.
///
/// site     of the members
/// lod      of the colony: far ones have fewer segments
/// returns  metres at size 1. A stem is as thick as its place says up to its last node, which lies inside the neck of its cap and is
///          no thicker than that
[[nodiscard]] Skeleton colony_skeleton(const ColonySite& site,
                                       const std::vector<ColonyMember>& members,
                                       const ColonyParams& params, const ColonyNature& nature,
                                       int segments);

/// Share of the nodes of roots that is left at a level of detail, about: runs without forks and stems have fewer from afar.
[[nodiscard]] double root_share(int lod);

/// How often the skin of a skeleton of so many nodes is subdivided: twice near by (tubes of sixteen sides), once where that would come
/// to more triangles than a mushroom has at most.
[[nodiscard]] int skin_levels(std::size_t nodes, int lod);

struct SkinDress {
    int lod = 0;
    double painted_length = 0.1;  ///< metres along a stem that its image shows, at size 1
    bool textured = true;
};

/// The mesh of a skeleton. A stem wears the whole image of one, ground to top; along a root it is laid to and fro at its own scale,
/// turning only where the mesh has a ring.
///
/// returns  closed; empty for an empty skeleton
/// throws   InvalidInput with validation_errors()
[[nodiscard]] Mesh colony_skin(const Skeleton& segments, const SkinDress& dress);

}  // namespace sporeprint
