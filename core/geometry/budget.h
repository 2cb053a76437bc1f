// Distribution of the triangle limit of a level of detail over the parts of a mushroom.
#pragma once

#include <array>
#include <cstdint>

#include "core/geometry/blades.h"
#include "core/geometry/cells.h"
#include "core/geometry/ornament_detail.h"
#include "core/individual/individual.h"
#include "core/mesh/detail.h"

namespace sporeprint {

/// Largest number of triangles of a mushroom, by whole LOD.
inline constexpr std::array<std::uint64_t, 4> most_triangles = {60000, 6000, 1200, 256};

/// Triangle budget of one individual. It follows from the set of species alone: no age and no
/// weight changes it.
struct Budget {
    OrnamentDetail ornaments;  ///< resolution of patches and shells; coarser in a large set
    CellBudget cells;          ///< of the hymenium; zero where it is painted only
    BladeBudget blades;
    bool solids = false;  ///< whether the hymenium is built as solids
    MeshCount count;      ///< exact counts when everything is present
};

/// Returns the largest number of triangles at a level of detail.
[[nodiscard]] std::uint64_t triangle_limit(DetailLevel level);

/// Returns the budget of an individual at a level of detail. A set that exceeds `most_triangles` is
/// coarsened step by step, least visible detail first: the surplus of granules and hairs, which a
/// level beyond 0 never has; soil and litter at the foot; corners and rings of patches, rows of
/// shells, short blades between others, cross veins, rows of blades; at the next level the smaller
/// patches themselves, which are painted then; at last, at every level, hanging spines, and then
/// peridioles and meshes of nets. Between LOD 0 and 1 the hymenium is painted only if the
/// fewest of its solids exceed the limit.
///
/// cost  a few microseconds; 0.1 ms above LOD 1, where blades are counted one by one
[[nodiscard]] Budget budget_of(const Individual& individual, DetailLevel level);

}  // namespace sporeprint
