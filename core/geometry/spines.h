// Hanging spines (Hericium) and upright folds (jellies) as solids.
#pragma once

#include <functional>
#include <glm/vec3.hpp>
#include <vector>

#include "core/geometry/ornament_context.h"

namespace sporeprint {

/// Where a spine grows.
struct SpineRoot {
    glm::dvec3 place;     ///< metres, a little inside the body
    glm::dvec3 outwards;  ///< unit normal of the surface
    double along = 0.0;   ///< 0 where spines begin, 1 where they end: see SpineStyle::from
    double grown = 1.0;   ///< factor on the size, above 0, as of a branch that has begun to grow
    /// Tangent of the surface, towards the middle of the spine's tuft; of length 0 to 1.5.
    glm::dvec3 lean = glm::dvec3(0.0);
    double curvature = 0.0;  ///< of the surface, 1/m: mean of its directions, positive if convex
};

/// A place in the unit square for each spine of a sequence, evenly spread however many are used.
struct SpinePlace {
    double along, round;
};
[[nodiscard]] SpinePlace spine_place(int number);

/// Returns the exact counts of all spines of an individual.
///
/// keep_absent  counts the triangles of spines of length 0 too
[[nodiscard]] MeshCount spine_count(const std::vector<SpineLayer>& layers,
                                    const OrnamentDetail& detail, bool keep_absent = true);

/// Returns the detail of a level at which the spines of a coral use at most half of its triangles,
/// and none from LOD 2 on.
[[nodiscard]] OrnamentDetail spine_detail(const std::vector<SpineLayer>& layers, DetailLevel level);

/// Appends the spines of one layer. A spine of length 0 is a point at its root.
///
/// root_of  returns the root of a spine by its number
void add_spines(Mesh& mesh, const SpineLayer& layer, const OrnamentDetail& detail,
                std::uint32_t seed, bool textured, bool keep_absent,
                const std::function<SpineRoot(int)>& root_of);

/// Appends the spines of a swept individual, which stand on its lower face and its cap.
void add_spines(Mesh& mesh, const Individual& individual, const OrnamentContext& context);

}  // namespace sporeprint
