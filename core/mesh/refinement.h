// Refinement of a part of a mesh by splitting edges.
#pragma once

#include <cstdint>
#include <functional>
#include <utility>
#include <vector>

#include "core/mesh/mesh.h"

namespace sporeprint {

/// Splits edges of a mesh in their middle, and the triangles beside them into two or four. The new
/// vertices lie on the curved triangles that the normals span, so that a coarse tube becomes rounder.
/// Edges of other triangles with the same ends are split alike: a closed mesh stays closed where
/// vertices of a seam have equal positions and normals.
///
/// mesh     with normals and texture coordinates, without tangents, sway and tints
/// splits   returns true for vertices between which edges are split; it must say the same of vertices
///          at the same place
/// returns  of each new vertex, in their order, the two between which it is
/// source   middle of an edge of curved point-normal triangles: Vlachos et al. 2001, section 3
std::vector<std::pair<std::uint32_t, std::uint32_t>> refine(
    Mesh& mesh, const std::function<bool(std::uint32_t)>& splits);

}  // namespace sporeprint
