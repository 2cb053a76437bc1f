// Spines and the mouths of tubes as solids.
#pragma once

#include "core/geometry/attachment.h"

namespace sporeprint {

/// How many there are, and how finely they are built.
struct CellBudget {
    int spines = 0;
    int pores = 0;
    int corners = 6;  ///< of a pore
    bool walls =
        true;  ///< whether the walls of pores are thick; else both their sides are one sheet
};
[[nodiscard]] CellBudget cell_budget(const Individual& individual);

/// What the spines and pores of an individual come to.
[[nodiscard]] MeshCount solid_count(const CellBudget& budget);

/// Appends them, each a closed solid.
void add_cells(const Roots& roots, const CellBudget& budget);

}  // namespace sporeprint
