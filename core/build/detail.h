// How many rings, columns and corners each level of detail has.
#pragma once

#include <array>

namespace sporeprint {

struct Detail {
    int stem_rings, hymenium_rings, cap_rings, columns;
    int patch_sides;  ///< corners of a wart or scale; 0: warts and scales are painted only
    int patch_rings;  ///< rings between its base and its tip
    int veil_rings;   ///< rings from a ring's attachment to its edge; 0: none
};

/// By LOD. The same individual in each: counts change, draws do not.
inline constexpr std::array<Detail, 4> details = {{
    {30, 22, 32, 72, 7, 1, 6},
    {14, 10, 15, 36, 4, 0, 3},
    {8, 6, 9, 18, 0, 0, 1},
    {4, 3, 4, 8, 0, 0, 0},
}};

}  // namespace sporeprint
