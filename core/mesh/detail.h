// Numbers of rings, columns and corners for each level of detail.
#pragma once

#include <array>
#include <compare>
#include <cstddef>
#include <cstdint>

namespace sporeprint {

/// The size of a mesh or of a part of it.
struct MeshCount {
    std::uint64_t vertices = 0, triangles = 0;

    constexpr MeshCount& operator+=(const MeshCount& more) {
        vertices += more.vertices;
        triangles += more.triangles;
        return *this;
    }
    /// Returns the size of `times` such meshes.
    [[nodiscard]] constexpr MeshCount times(int times) const {
        const auto n = static_cast<std::uint64_t>(times);
        return {n * vertices, n * triangles};
    }
};

/// A level of detail: a whole one, or a place between it and the next one in eighths of the way. A
/// whole LOD converts to it, and of two levels the finer one is less.
struct DetailLevel {
    static constexpr int steps = 8;  ///< from a whole level to the next

    int lod = 0;      ///< the whole level, or the finer one of the two
    int eighths = 0;  ///< 0..7

    constexpr DetailLevel() = default;
    // NOLINTNEXTLINE(google-explicit-constructor): a whole LOD is a level of detail
    constexpr DetailLevel(int whole, int eighths_further = 0)
        : lod(whole), eighths(eighths_further) {}

    [[nodiscard]] constexpr bool is_whole() const { return eighths == 0; }
    /// Returns the level as a number: 0.5 is half-way from LOD 0 to LOD 1.
    [[nodiscard]] constexpr double number() const {
        return lod + static_cast<double>(eighths) / steps;
    }
    /// Returns the nearest whole level; half-way the coarser one.
    [[nodiscard]] constexpr int nearest() const { return lod + (2 * eighths >= steps ? 1 : 0); }

    auto operator<=>(const DetailLevel&) const = default;  // NOLINT(modernize-use-nullptr)
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
    double ground =
        /// share of the soil and litter at a foot that a level builds, the largest pieces first
        1.0;
    double free_solids =
        /// share of the hanging spines, and of the meshes of a receptacle, that a level builds
        1.0;
};

/// The whole levels of detail by index. The individual is the same in each: counts change, random draws
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

/// Returns the counts of a level of detail, 0..farthest_lod. Between two whole levels counts are in
/// geometric progression, columns even; what the coarser one lacks ends half-way, and warts and
/// scales become fewer before.
[[nodiscard]] Detail detail_of(DetailLevel level);

/// Returns the value of a table of whole levels at a level, in geometric progression between two of
/// them.
///
/// from, to  its values at level.lod and at the next level, positive
[[nodiscard]] double between(double from, double to, DetailLevel level);

/// Returns the row of a table by LOD: between two levels that of the nearest, at farthest_lod that of
/// LOD 3.
template <class Table>
[[nodiscard]] constexpr const auto& at_level(const Table& table, DetailLevel level) {
    const auto row = static_cast<std::size_t>(level.nearest());
    return table[row < table.size() ? row : table.size() - 1];
}

}  // namespace sporeprint
