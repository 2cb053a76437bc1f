// A piece of a trunk or branch with broken ends, on which brackets grow.
#pragma once

#include <cstdint>

#include "core/mesh/detail.h"
#include "core/mesh/mesh.h"
#include "core/model/substrate.h"

namespace sporeprint {

/// A vertical piece, whole or split, whose bark touches the origin from behind (z < 0).
struct WoodPiece {
    double radius = 0.1;              ///< least distance of the bark from the axis, metres
    double bottom = -0.2, top = 0.2;  ///< heights of its ends, metres
    std::uint32_t seed = 1;           ///< of what makes it uneven
    /// How far behind the origin it is split along the grain, metres, less than the radius; 0: it is
    /// whole.
    double split = 0.0;
    Substrate kind = Substrate::beech;  ///< whose bark it has
    /// Heights between which something grows out in front, so far to each side, metres: bark is
    /// nearly even there, so that it hides nothing of that. None without a width.
    double contact_bottom = 0.0, contact_top = 0.0, contact_half = 0.0;
};

/// The greatest distance of the bark from the axis, in radii.
inline constexpr double uneven_radius = 1.12;

/// The most by which an end lies below its highest point, in radii or, of a short piece, lengths.
inline constexpr double deepest_end = 0.25;

/// Returns the number of vertices and triangles of wood_mesh().
[[nodiscard]] MeshCount wood_count(const WoodPiece& piece, int lod);

/// Returns the surface: bark with its ridges and furrows, whose radius varies between 1 and
/// uneven_radius of the radius of the piece, two broken ends with bark that has come off and, of a
/// split piece, a face with the lines of its growth rings.
///
/// lod       0..3; bark has its relief in the first two
/// textured  makes texture coordinates for wood_images(), and tangents
/// returns   a mesh that is closed once equal positions are welded
/// throws    InvalidInput for a radius that is not positive, a top that is not above the bottom,
///           a split that is not between 0 and the radius, or no kind of wood
[[nodiscard]] Mesh wood_mesh(const WoodPiece& piece, int lod, bool textured);

}  // namespace sporeprint
