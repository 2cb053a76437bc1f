// Closed solids made of a grid of corners: rows from a base to a tip or round a loop.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "core/mesh/detail.h"
#include "core/mesh/mesh.h"
#include "core/surface/charts.h"

namespace sporeprint {

/// Returns the row of a table of resolutions for a level of detail: the first one, in descending
/// order, whose `least_columns` the level has. The last one has 0.
template <class Table>
[[nodiscard]] const auto& by_columns(const Table& table, const Detail& detail) {
    return *std::find_if(table.begin(), table.end(),
                         [&](const auto& one) { return detail.columns >= one.least_columns; });
}

/// The grid of a closed solid: rows from its base to its tip, columns round it, without the first
/// one repeated.
struct SolidGrid {
    int rows = 0, columns = 0;
    /// True if the last row meets the first (a ring); otherwise it is one point, and a polygon
    /// closes the base.
    bool loops = false;

    /// Returns the exact counts of what append() appends.
    [[nodiscard]] MeshCount count() const {
        const auto high = static_cast<std::uint64_t>(rows),
                   wide = static_cast<std::uint64_t>(columns);
        if (high == 0 || wide == 0) return {};
        if (loops) return {high * (wide + 1), 2 * high * wide};
        return {high * (wide + 1) + wide, 2 * (high - 1) * wide - 2};
    }
};

/// A closed solid made of a grid of corners, the first column repeated.
struct GridSolid : SolidGrid {
    Part part = Part::veil;           ///< whose strip paints it
    std::vector<glm::dvec3> corners;  ///< [row][column]
    std::vector<glm::dvec3> normals;  ///< computed by append()
    /// Normal of the surface that a pointed solid rises from, times the share of it in the normals
    /// of its first row: with length 1 the skin passes into it without an edge in the shading.
    glm::dvec3 skirt = glm::dvec3(0.0);
    /// The piece of the strip that paints it: from and to along u and v, 0..1.
    std::array<double, 4> window = {0.0, 1.0, 0.0, 1.0};
    /// The row that shows the far side of the window, beyond which it is mirrored back to its near
    /// side at the tip; 0: the last row shows the far side. Not of a ring, which has an image for
    /// either side.
    int crest = 0;
    /// How often the window is shown round the solid, forth and back in turn, so that texels of a wide
    /// solid are not drawn out: 1, or an even divisor of the columns.
    int folds = 1;
    /// True if the window lies on its side: along the rows it runs from base to tip along u, and round
    /// the solid along v.
    bool turned = false;
};

/// Appends a solid, painted by the strip of its part: round it along the columns, from its base to
/// its tip (or to its crest) along the rows; a loop shows the outer side of the veil up to its middle
/// row, and the inner side back from there. Normals are area-weighted.
///
/// fallback  normal where none can be computed, as of a solid that is a point
/// drawn     false appends the vertices alone
void append(Mesh& mesh, GridSolid& solid, const glm::dvec3& fallback, bool textured, bool drawn);

}  // namespace sporeprint
