// A piece of a trunk or branch with sawn ends, on which brackets grow: its kinds and its shape.
#pragma once

#include <array>
#include <cstdint>

#include "core/mesh/detail.h"
#include "core/mesh/mesh.h"

namespace sporeprint {

/// What fungi that grow from a wall stand on: nothing, or wood with the bark of a tree.
enum class Substrate { none, beech, birch, oak, poplar, spruce };
/// All that are wood.
inline constexpr std::array all_woods = {Substrate::beech, Substrate::birch, Substrate::oak,
                                         Substrate::poplar, Substrate::spruce};

constexpr const char* name(Substrate substrate) {
    switch (substrate) {
        case Substrate::none:
            return "none";
        case Substrate::beech:
            return "beech";
        case Substrate::birch:
            return "birch";
        case Substrate::oak:
            return "oak";
        case Substrate::poplar:
            return "poplar";
        case Substrate::spruce:
            return "spruce";
    }
    return nullptr;
}

/// A vertical piece whose bark touches the origin from behind (z < 0).
struct WoodPiece {
    double radius = 0.1;              ///< least distance of the bark from the axis, metres
    double bottom = -0.2, top = 0.2;  ///< heights of its ends, metres
    std::uint32_t seed = 1;           ///< of what makes it uneven
};

/// The greatest distance of the bark from the axis, in radii.
inline constexpr double uneven_radius = 1.1;

/// Returns the number of vertices and triangles of wood_mesh().
[[nodiscard]] MeshCount wood_count(const WoodPiece& piece, int lod);

/// Returns the surface: bark, whose radius varies between 1 and uneven_radius of the radius
/// of the piece, and two flat ends.
///
/// lod       0..3: 48, 28, 16 or 12 sides
/// textured  makes texture coordinates for wood_images(), and tangents
/// returns   a mesh that is closed once equal positions are welded
/// throws    InvalidInput for a radius that is not positive, or a top that is not above the bottom
[[nodiscard]] Mesh wood_mesh(const WoodPiece& piece, int lod, bool textured);

}  // namespace sporeprint
