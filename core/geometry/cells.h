// Spines and the mouths of tubes (pores) as solids.
#pragma once

#include "core/geometry/attachment.h"

namespace sporeprint {

/// Numbers and resolution of spines and pores.
struct CellBudget {
    int spines = 0;
    int pores = 0;
    int sides = 4;      ///< per spine
    int rings = 0;      ///< per spine, between its base and its tip
    int corners = 6;    ///< per pore
    bool walls = true;  ///< whether walls of pores are thick; otherwise both sides are one sheet
};
[[nodiscard]] CellBudget cell_budget(const Individual& individual);

/// Leaves out a ring of each spine that only makes it smoother; returns false when none is left.
bool drop_row(CellBudget& budget);

/// Gives spines the fewest corners that they can have.
void coarsen(CellBudget& budget);

/// Returns the exact vertex and triangle counts of spines and pores.
[[nodiscard]] MeshCount solid_count(const CellBudget& budget);

/// Appends spines and pores, each a closed solid.
void add_cells(const Attachment& attachment, const CellBudget& budget);

}  // namespace sporeprint
