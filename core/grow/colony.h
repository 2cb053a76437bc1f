// The recipe of a colony: an order in, a GLB out.
#pragma once

#include <cstdint>
#include <vector>

#include "core/atlas/atlas.h"
#include "core/colony/colony_spec.h"
#include "core/colony/separation.h"
#include "core/grow/painting.h"
#include "core/grow/product.h"

namespace sporeprint {

/// Number of vertices and triangles in the file (about, seldom less than there will be), texels and bytes. One individual is decided,
/// nothing is built.
///
/// throws  as colony_nature(); Impossible ("/branch_distance") for roots of too many nodes
[[nodiscard]] Estimate estimate(const ColonyOrder& order, const Atlas& atlas,
                                const Memo& memo = {});

/// The parts of a colony; each mesh is stored once.
struct Colony {
    Mesh skin;                 ///< roots and stems; empty where there are none
    std::vector<Mesh> models;  ///< caps, or whole individuals; those that nobody shows are empty
    std::vector<ColonyMember> members;  ///< their postures are those of the file
    ColonyParams effective;  ///< every control at its value; asked for again, it is the same
    double junction = 0.0;   ///< radius of the stem at size 1 where caps are cut off
};

/// Grows the parts: `distinct` individuals of the mix, from the oldest to those of half its age, set on stems or stood whole.
///
/// throws  InvalidInput, Impossible, Cancelled
[[nodiscard]] Colony colony_parts(const ColonyOrder& order, const Atlas& atlas,
                                  const Workshop& workshop = {});

/// The estimate of an order whose parts are there: vertices and triangles are exact.
[[nodiscard]] Estimate measured(const ColonyOrder& order, const Colony& colony);

/// Box of all that a colony shows.
[[nodiscard]] Bounds bounds(const Colony& colony);

/// Triangles that are drawn, those of likes each time.
[[nodiscard]] std::uint64_t drawn_triangles(const Colony& colony);

/// The mushroom whose images all of a colony wears.
[[nodiscard]] MushroomOrder paint_order(const ColonyOrder& order);

/// What painting them depends on.
[[nodiscard]] PaintRecipe paint_recipe(const ColonyOrder& order, const Atlas& atlas,
                                       const Memo& memo = {});

/// Grows a colony: one skin, a few caps, and a node for each individual; or an instanced node for each cap.
///
/// returns  the GLB as shared slices: header with JSON, geometry, images
/// throws   InvalidInput, Impossible, GenerationError, Cancelled
[[nodiscard]] Grown grow_colony(const ColonyOrder& order, const Atlas& atlas,
                                const Extras& extras = {}, const Workshop& workshop = {});

}  // namespace sporeprint
