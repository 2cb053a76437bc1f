// How many rings, columns and corners each level of detail has.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace sporeprint {

/// What a part of a mesh comes to.
struct MeshCount {
    std::uint64_t vertices = 0, triangles = 0;
};

struct Detail {
    int stem_rings, hymenium_rings, cap_rings, columns;
    int patch_sides;  ///< corners of a wart or scale; 0: warts and scales are painted only
    int patch_rings;  ///< rings between its base and its tip
    int veil_rings;   ///< rings from a ring's attachment to its edge; 0: none
    int sac_rings;    ///< rings from a sac's foot to its edge; 0: none
    double patches =
        1.0;  ///< share of a layer's warts or scales that is built, those drawn largest; the others are painted only
};

/// By LOD. The same individual in each: counts change, draws do not. One table for every species: a mix has the rings and columns of
/// each species alone, so that it ends where these begin.
inline constexpr std::array<Detail, 4> details = {{
    {26, 18, 38, 96, 7, 1, 6, 11},
    {11, 9, 20, 40, 4, 0, 3, 7},
    {7, 5, 7, 16, 0, 0, 1, 4},
    {4, 3, 4, 8, 0, 0, 0, 1},
}};

[[nodiscard]] constexpr const Detail& detail_of(int lod) {
    return details[static_cast<std::size_t>(lod)];
}

}  // namespace sporeprint
