#include "core/geometry/grid_solid.h"

#include <algorithm>
#include <cassert>
#include <glm/geometric.hpp>

#include "core/math/direction.h"
#include "core/surface/charts.h"
#include "core/surface/veil_bands.h"

namespace sporeprint {

namespace {

/// Returns the texture coordinate at shares of the way round a solid and up from its base.
TexturePoint point_of(const GridSolid& solid, double round, double up) {
    const auto& [from_u, to_u, from_v, to_v] = solid.window;
    // A loop shows both sides of the veil, anything else the outer one alone.
    const double shown = solid.part == Part::veil && !solid.loops ? veil_outer_to : 1.0;
    return strip_point(swept_charts[index_of(solid.part)], from_u + round * (to_u - from_u),
                       shown * (from_v + up * (to_v - from_v)));
}

/// Returns true if the window is shown backwards at a column.
bool is_back(const GridSolid& solid, int column) {
    return solid.folds > 1 && (column * solid.folds / solid.columns) % 2 != 0;
}

/// Returns where a column is in the window of a solid, 0..1.
double column_share(const GridSolid& solid, int column) {
    if (solid.folds == 1) return static_cast<double>(column) / solid.columns;
    const int within = column * solid.folds % solid.columns;
    const double share = static_cast<double>(within) / solid.columns;
    return is_back(solid, column) ? 1.0 - share : share;
}

/// Returns where a row is in the window of a solid, 0..1.
double row_share(const GridSolid& solid, int row) {
    const int last = solid.rows - 1;
    if (solid.loops) {
        const double edge = 0.5 * solid.rows - 1.0 + 1e-9;
        return row < solid.rows / 2
                   ? veil_outer_to * std::min(row / edge, 1.0)
                   : 1.0 - (1.0 - veil_inner_from) * std::min((last - row) / edge, 1.0);
    }
    if (solid.crest > 0 && row > solid.crest)
        return static_cast<double>(last - row) / (last - solid.crest);
    return static_cast<double>(row) / (solid.crest > 0 ? solid.crest : last);
}

/// Appends the triangles of a solid's grid, whose vertices begin at `first`, and computes its
/// normals: area-weighted over vertices that share a position.
void append_grid_triangles(Mesh& mesh, GridSolid& solid, std::uint32_t first) {
    const int row = solid.columns + 1;
    const auto at = [&](int i, int j) { return static_cast<std::size_t>(i * row + j); };
    const auto& p = solid.corners;
    const bool pointed = !solid.loops;  // its last row is one point
    std::vector<glm::dvec3>& normals = solid.normals;
    normals.assign(p.size(), glm::dvec3(0.0));
    glm::dvec3 tip(0.0);
    const auto add = [&](std::size_t a, std::size_t b, std::size_t c) {
        const glm::dvec3 n = glm::cross(p[b] - p[a], p[c] - p[a]);
        normals[a] += n;
        normals[b] += n;
        normals[c] += n;
        mesh.indices.insert(mesh.indices.end(), {first + static_cast<std::uint32_t>(a),
                                                 first + static_cast<std::uint32_t>(b),
                                                 first + static_cast<std::uint32_t>(c)});
    };
    const int bands = solid.loops ? solid.rows : solid.rows - 1;
    for (int i = 0; i < bands; ++i)
        for (int j = 0; j < solid.columns; ++j) {
            const int above = (i + 1) % solid.rows;
            // The diagonals of both sides of a thin loop lie opposite each other, so that a bent one
            // stays thick.
            if (solid.loops && i >= solid.rows / 2) {
                add(at(i, j), at(i, j + 1), at(above, j + 1));
                add(at(i, j), at(above, j + 1), at(above, j));
                continue;
            }
            add(at(i, j), at(i, j + 1), at(above, j));
            if (!(pointed && above == solid.rows - 1))
                add(at(i, j + 1), at(above, j + 1), at(above, j));
        }
    for (int i = 0; i < solid.rows; ++i) {
        normals[at(i, 0)] += normals[at(i, solid.columns)];
        normals[at(i, solid.columns)] = normals[at(i, 0)];
    }
    if (pointed) {
        for (int j = 0; j < solid.columns; ++j) tip += normals[at(solid.rows - 1, j)];
        for (int j = 0; j <= solid.columns; ++j) normals[at(solid.rows - 1, j)] = tip;
    }
    const double share = glm::length(solid.skirt);
    if (share <= 0.0) return;
    for (int j = 0; j <= solid.columns; ++j)
        normals[at(0, j)] =
            (1.0 - share) * unit_or(normals[at(0, j)], solid.skirt / share) + solid.skirt;
}

/// Appends the vertices of a solid's grid; texture coordinates are those of its strip.
void append_grid_vertices(Mesh& mesh, const GridSolid& solid, const glm::dvec3& fallback,
                          bool textured) {
    const int row = solid.columns + 1;
    const auto at = [&](int i, int j) { return static_cast<std::size_t>(i * row + j); };
    const auto& p = solid.corners;
    const bool pointed = !solid.loops;
    for (int i = 0; i < solid.rows; ++i)
        for (int j = 0; j <= solid.columns; ++j) {
            const glm::dvec3 normal = unit_or(solid.normals[at(i, j)], fallback);
            mesh.positions.emplace_back(p[at(i, j)]);
            mesh.normals.emplace_back(normal);
            if (!textured) continue;
            const double round = column_share(solid, j), up = row_share(solid, i);
            const TexturePoint uv =
                solid.turned ? point_of(solid, up, round) : point_of(solid, round, up);
            mesh.texture_coordinates.emplace_back(uv.u, uv.v);
            const int ahead = j < solid.columns ? j + 1 : 1,
                      behind = j > 0 ? j - 1 : solid.columns - 1;
            const int side = pointed && i == solid.rows - 1 ? i - 1 : i;
            const bool back = is_back(solid, j);
            if (solid.turned) {
                const glm::dvec3 along =
                    p[at(std::min(i + 1, solid.rows - 1), j)] - p[at(std::max(i - 1, 0), j)];
                mesh.tangents.emplace_back(glm::vec3(square_to(normal, along)),
                                           back ? 1.0F : -1.0F);
                continue;
            }
            const glm::dvec3 tangent =
                (back ? -1.0 : 1.0) * (p[at(side, ahead)] - p[at(side, behind)]);
            // Columns run counter-clockwise with the tip above, so image-up points to the base; the
            // other side of a crest is mirrored.
            const bool mirrored = solid.crest > 0 && i > solid.crest;
            mesh.tangents.emplace_back(glm::vec3(square_to(normal, tangent)),
                                       mirrored != back ? 1.0F : -1.0F);
        }
}

/// Appends the base of a solid, a polygon seen from below.
void append_base(Mesh& mesh, const GridSolid& solid, const glm::dvec3& fallback, bool textured,
                 bool drawn) {
    const auto& p = solid.corners;
    const auto at = [](int j) { return static_cast<std::size_t>(j); };
    const auto base = static_cast<std::uint32_t>(mesh.positions.size());
    glm::dvec3 below(0.0);
    for (int j = 1; j + 1 < solid.columns; ++j)
        below += glm::cross(p[at(j + 1)] - p[at(0)], p[at(j)] - p[at(0)]);
    below = unit_or(below, -fallback);
    for (int j = 0; j < solid.columns; ++j) {
        mesh.positions.emplace_back(p[at(j)]);
        mesh.normals.emplace_back(below);
        if (!textured) continue;
        const double round = column_share(solid, j);
        const TexturePoint uv =
            solid.turned ? point_of(solid, 0.0, round) : point_of(solid, round, 0.0);
        mesh.texture_coordinates.emplace_back(uv.u, uv.v);
        mesh.tangents.emplace_back(glm::vec3(square_to(below, p[at(1)] - p[at(0)])), 1.0F);
    }
    for (int j = 1; drawn && j + 1 < solid.columns; ++j)
        mesh.indices.insert(mesh.indices.end(), {base, base + static_cast<std::uint32_t>(j + 1),
                                                 base + static_cast<std::uint32_t>(j)});
}

}  // namespace

void append(Mesh& mesh, GridSolid& solid, const glm::dvec3& fallback, bool textured, bool drawn) {
    const std::size_t indices = mesh.indices.size();
    [[maybe_unused]] const std::size_t vertices = mesh.positions.size();
    append_grid_triangles(mesh, solid, static_cast<std::uint32_t>(mesh.positions.size()));
    append_grid_vertices(mesh, solid, fallback, textured);
    if (!drawn) mesh.indices.resize(indices);
    if (!solid.loops) append_base(mesh, solid, fallback, textured, drawn);
    assert(mesh.positions.size() - vertices == solid.count().vertices);
    assert(!drawn || mesh.indices.size() - indices == 3 * solid.count().triangles);
}

}  // namespace sporeprint
