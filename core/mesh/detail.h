// Numbers of rings, columns and corners for each level of detail.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace sporeprint {

/// The size of a mesh or of a part of it.
struct MeshCount {
    std::uint64_t vertices = 0, triangles = 0;
};

/// The counts of one level of detail.
struct Detail {
    int stem_rings, hymenium_rings, cap_rings, columns;
    int patch_sides;  ///< corners of a wart or scale; 0: warts and scales are only painted
    int patch_rings;  ///< rings between its base and its tip
    int veil_rings;   ///< rings from a ring's attachment to its edge; 0: none
    int sac_rings;    ///< rings from the base of a sac to its edge; 0: none
    double patches =
        /// share of a layer's warts or scales that is built, largest first; the others are only
        /// painted
        1.0;
};

/// The levels of detail by index. The individual is the same in each: counts change, random draws
/// do not. One table serves every species, so that a mix of weight 1 reproduces the single-species
/// mesh.
inline constexpr std::array<Detail, 4> details = {{
    {26, 18, 38, 96, 7, 1, 6, 11},
    {11, 9, 20, 40, 4, 0, 3, 7},
    {7, 5, 7, 16, 0, 0, 1, 4},
    {4, 3, 4, 8, 0, 0, 0, 1},
}};

/// Returns the counts of a level of detail, 0..3.
[[nodiscard]] constexpr const Detail& detail_of(int lod) {
    return details[static_cast<std::size_t>(lod)];
}

}  // namespace sporeprint
