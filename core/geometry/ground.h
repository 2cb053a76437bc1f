// What a mushroom brings along of its ground, as solids: lumps of soil, litter, strands of mycelium.
#pragma once

#include <functional>
#include <glm/vec3.hpp>
#include <vector>

#include "core/geometry/ornament_context.h"

namespace sporeprint {

/// A point of the surface of a foot.
struct FootPoint {
    glm::dvec3 place{0.0};                ///< metres
    glm::dvec3 outwards{0.0, -1.0, 0.0};  ///< unit normal
};

/// The buried surface of a foot: `depth` is 0 at the ground and 1 at its lowest point, `angle` is in
/// radians round the axis.
using Foot = std::function<FootPoint(double depth, double angle)>;

/// Returns the exact counts of what add_ground() appends.
///
/// keep_absent  counts the triangles of species of weight 0 too
[[nodiscard]] MeshCount ground_count(const std::vector<GroundLayer>& layers, const Detail& detail,
                                     bool keep_absent = true);

/// Appends soil, litter and strands of all layers, each piece a closed solid that begins a little
/// inside the foot or the ground, which is the plane y = 0. Of a species of weight 0 all pieces are
/// points on the foot.
///
/// seed  of the individual; each species has its own streams
void add_ground(Mesh& mesh, const std::vector<GroundLayer>& layers, const Foot& foot,
                const Detail& detail, std::uint32_t seed, bool textured, bool keep_absent);

/// Resolutions of the ground of a colony, from the finest.
inline constexpr int ground_rows = 6;

/// How finely the ground of a colony is built.
struct ColonyGroundDetail {
    int row = 0;         ///< 0..ground_rows - 1
    double share = 1.0;  ///< of the lumps, crumbs and litter of that row; 0: no ground at all
    bool fused = false;  ///< one clod round all stems of a tuft, with soil between them
};

/// Returns the exact counts of what the function below appends.
[[nodiscard]] MeshCount ground_count(const std::vector<GroundLayer>& layers,
                                     const ColonyGroundDetail& detail);

/// Appends the ground round one foot of a colony, or round that of a whole tuft. Species of weight
/// 0 have no triangles.
void add_ground(Mesh& mesh, const std::vector<GroundLayer>& layers, const Foot& foot,
                const ColonyGroundDetail& detail, std::uint32_t seed, bool textured);

/// Appends the ground of a swept individual, round its stem or the sac that surrounds it.
void add_ground(Mesh& mesh, const Individual& individual, const OrnamentContext& context);

}  // namespace sporeprint
