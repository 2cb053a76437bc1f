// How the parts of a mushroom share the triangles of a level of detail.
#pragma once

#include <array>
#include <cstdint>

#include "core/geometry/blades.h"
#include "core/geometry/cells.h"
#include "core/individual/individual.h"
#include "core/mesh/detail.h"

namespace sporeprint {

/// What a mushroom may come to, by LOD.
inline constexpr std::array<std::uint64_t, 4> most_triangles = {60000, 6000, 1200, 200};

/// The shares of one individual. They follow from its set of species alone: no age and no weight changes them.
struct Budget {
    Detail ornaments;  ///< of patches and shells; coarser in a crowded set
    CellBudget cells;  ///< of the hymenium; none where it is painted only
    BladeBudget blades;
    MeshCount count;  ///< what everything comes to when all of it is there
};

/// The shares of an individual at a level of detail. A set that comes to more than `most_triangles` gives up what is seen least, as
/// far as it must: corners and rings of patches, rows of shells, blades in the grooves between others, cross veins, rows of blades; at the next
/// level the smaller patches themselves, which are painted then.
///
/// cost  a few us, a tenth of a millisecond at LOD 0, where blades are counted one by one
[[nodiscard]] Budget budget_of(const Individual& individual, int lod);

}  // namespace sporeprint
