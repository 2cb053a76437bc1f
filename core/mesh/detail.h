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
    {4, 3, 4, 8, 0, 0, 1, 1},
}};

/// One level beyond those of a request: the individuals of a colony at LOD 3. It has the columns of
/// LOD 3, which preserve the outline seen from above, and fewer rings. Outlines are not proven
/// simple at it.
inline constexpr int farthest_lod = 4;
inline constexpr Detail farthest_detail = {3, 2, 3, 8, 0, 0, 0, 1};

/// Returns the counts of a level of detail, 0..farthest_lod.
[[nodiscard]] constexpr const Detail& detail_of(int lod) {
    return lod < farthest_lod ? details[static_cast<std::size_t>(lod)] : farthest_detail;
}

/// Returns the row of a table by LOD; at farthest_lod, that of LOD 3.
template <class Table>
[[nodiscard]] constexpr const auto& at_level(const Table& table, int lod) {
    return table[lod < farthest_lod ? static_cast<std::size_t>(lod) : table.size() - 1];
}

}  // namespace sporeprint
