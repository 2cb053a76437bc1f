#include "core/geometry/cells.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>

#include "core/geometry/append.h"
#include "core/math/direction.h"
#include "core/math/elementary.h"

namespace sporeprint {

namespace {

constexpr int least_sides = 3;

/// Rings of corners of a spine between its base and its tip: with one it is an awl that hangs in a
/// curve, without one a cone.
constexpr int spine_rings = 1;
int spine_triangles(const CellBudget& budget) {
    return budget.sides * (2 * budget.rings + 1) + budget.sides - 2;
}

/// Rings of corners of a pore: outer base, rim, inner base.
constexpr int pore_rings = 3;

// No source or measurement is recorded for the values down to `cell_texture_width`.

/// Depth below which a cell counts as vanishing, in lengths of the meridian: it moves to the
/// nearest vertex.
constexpr double vanishing_depth = 0.01;

/// Length of the shortest spine relative to that of the longest; radius at the base of the steepest
/// one and the sideways displacement of its tip, in heights; how much of the latter is along the
/// meridian.
constexpr double shortest_spine = 0.4, steepest_spine = 0.28, spine_lean = 0.12,
                 spine_lean_out = 0.6;

/// Share of the vertical in the direction of the tip of a spine on a face that looks down, and the
/// height of the ring of an awl and its radius, in those of the spine.
constexpr double hanging = 0.6, ring_height = 0.5, ring_radius = 0.78;

/// Radius of a pore in widths of its cell, slightly more than half, so that neighbours meet; radii
/// of both sides of its wall as shares of that.
constexpr double pore_radius = 0.53, pore_outside = 0.96, pore_inside = 0.72;

/// Width of the stretch of the blades' image that wraps round a cell, in lengths of the meridian.
constexpr double cell_texture_width = 0.06;

int pore_triangles(const CellBudget& budget) { return budget.corners * (budget.walls ? 6 : 4); }

// Returns the base of a spine or a pore: at its own place or, when vanishing (embedding 0), at the
// vertex nearest to it.
SurfacePoint cell_root(const Attachment& attachment, const CellPlace& cell, double embedding,
                       const AxisStation& station) {
    const double own = 2.0 * pi * cell.turn;
    const Attachment::FacePoint rest = attachment.nearest_vertex(cell.share, own);
    const double angle = rest.angle + embedding * (own - rest.angle);
    const double share =
        attachment.context.cuts.lower(rest.share + embedding * (cell.share - rest.share), angle);
    return attachment.place(attachment.at(share, embedding), angle, station);
}

// A cell in space: the frame at its base, and its dimensions, metres.
struct PlacedCell {
    const CellPlace& place;
    const HymeniumOf<Plain>& hymenium;
    SurfacePoint root;
    glm::dvec3 down, round, out;  ///< unit: into the depth, round the axis, square to both
    double width;                 ///< along the meridian
    double height;                ///< 0 when absent
};

// Appends the cells of all species with a pattern. The vertices of absent ones are appended too.
//
// size_of  returns the factor on the depth of a cell
// add      appends vertices and triangles of a cell
template <class Size, class Add>
void add_cells_of(const Attachment& attachment, HymeniumPattern pattern, const Size& size_of,
                  const Add& add) {
    const double length = attachment.face.length();
    const AxisStation station =
        attachment.context.deformer.frozen_station(attachment.context.deformer.top());
    for (const SpeciesShare& part : attachment.individual.parts) {
        if (part.cells.rows == 0 || part.model.surface.hymenium.pattern != pattern) continue;
        const HymeniumOf<Plain>& hymenium = part.model.hymenium;
        for (const CellPlace& place : cell_places(part.cells, attachment.individual.painted_seed)) {
            const LowerFace::Place at = attachment.face.at(place.share);
            const double depth = part.weight * length * hymenium.depth *
                                 depth_envelope(hymenium, place.share) *
                                 cell_depth(hymenium, place.share) * at.scale * size_of(place);
            const double embedding = std::min(1.0, depth / (vanishing_depth * length + 1e-12));
            const SurfacePoint root = cell_root(attachment, place, embedding, station);
            const glm::dvec3 down = unit_or(root.meridian, {0.0, -1.0, 0.0}),
                             round = unit_or(root.azimuth, {1.0, 0.0, 0.0});
            const double height = depth > 0.0 ? depth + embedding * at.sink : 0.0;
            const std::size_t indices = attachment.mesh.indices.size();
            add(PlacedCell{place, hymenium, root, down, round, glm::cross(down, round),
                           length / part.cells.rows, height});
            if (height <= 0.0 && !attachment.context.keep_absent)
                attachment.mesh.indices.resize(indices);
        }
    }
}

// Returns the length of a spine relative to that of the longest: short ones are rarer.
double spine_size(const CellPlace& place) {
    const double u = 0.5 - 0.5 * place.lot;
    return 1.0 - (1.0 - shortest_spine) * u * u;
}

// Appends a spine, whose base is closed by a polygon. It begins square to the face, and its tip hangs.
void add_spine(const Attachment& attachment, const CellBudget& budget, const PlacedCell& cell) {
    const int sides = budget.sides;
    const auto& [place, hymenium, root, down, round, out, width, height] = cell;
    const double radius =
        std::min(0.5 * hymenium.thickness * width * (0.8 + 0.2 * spine_size(place)),
                 steepest_spine * height + 1e-9);
    const glm::dvec3 lean =
        spine_lean * height * (place.lot * round - spine_lean_out * place.lot * out);
    const glm::dvec3 vertical(0.0, -1.0, 0.0);
    const double facing = hanging * smooth_step(0.0, 1.0, glm::dot(down, vertical));
    const double size = std::sqrt(glm::dot(root.meridian, root.meridian));
    const glm::dvec3 hung =
        height * size * unit_or((1.0 - facing) * down + facing * vertical, down) + lean;
    const auto rows = static_cast<std::size_t>(budget.rings) + 2;
    const std::size_t first = attachment.mesh.positions.size();
    for (std::size_t i = 0; i < rows; ++i) {
        const double up = i == 0 ? 0.0 : i + 1 == rows ? 1.0 : ring_height;
        const double wide = i == 0 ? 1.0 : i + 1 == rows ? 0.0 : ring_radius;
        const glm::dvec3 middle =
            root.position + up * ((1.0 - up) * height * root.meridian + up * hung);
        for (int j = 0; j <= sides; ++j) {
            const auto turn = sine_cosine(2.0 * pi * (j % sides) / sides);
            const glm::dvec3 aside = turn.cosine * round + turn.sine * out;
            const glm::dvec3 normal = unit_or(aside + (0.25 + 0.9 * up * up) * down, down);
            attachment.add_vertex(
                middle + wide * radius * aside, normal, turn.cosine * out - turn.sine * round,
                place.share + cell_texture_width * (static_cast<double>(j) / sides - 0.5), up,
                -1.0F);
        }
    }
    const auto add = [&](std::size_t a, std::size_t b, std::size_t c) {
        append_triangle(attachment.mesh, first + a, first + b, first + c);
    };
    const auto row = static_cast<std::size_t>(sides) + 1;
    for (std::size_t i = 0; i + 1 < rows; ++i)
        for (std::size_t j = i * row; j + 1 < (i + 1) * row; ++j) {
            add(j, j + 1, j + row);
            if (i + 2 < rows) add(j + 1, j + row + 1, j + row);
        }
    for (std::size_t j = 1; j + 2 < row; ++j) add(0, j + 1, j);
}

// Appends a pore, the mouth of a tube: a ring of flesh from the flesh between tubes to the rim and
// back inside. The rim has two rows of vertices, one for each side of the wall.
void add_pore(const Attachment& attachment, const CellBudget& budget, const PlacedCell& cell) {
    const auto& [place, hymenium, root, down, round, out, width, height] = cell;
    const int corners = budget.corners;
    const double along = height > 0.0 ? pore_radius * width : 0.0,
                 across = along / hymenium.elongation;
    const double spin = 0.5 + 0.25 * place.lot;
    // Rows: outer base, rim twice, inner base.
    const double inner = budget.walls ? pore_inside : pore_outside;
    const double middle = 0.5 * (pore_outside + inner);
    const std::array<double, pore_rings + 1> wide = {pore_outside, middle, middle, inner};
    const std::size_t first = attachment.mesh.positions.size();
    for (std::size_t i = 0; i < wide.size(); ++i) {
        const bool rim = i == 1 || i == 2, outside = i < 2;
        for (int j = 0; j <= corners; ++j) {
            const auto turn = sine_cosine(2.0 * pi * ((j % corners) + spin) / corners);
            const glm::dvec3 to = turn.cosine * round + turn.sine * out;
            const glm::dvec3 reach = turn.cosine * across * round + turn.sine * along * out;
            const glm::dvec3 normal =
                unit_or((outside ? 1.0 : -1.0) * to + (rim ? 0.8 : 0.0) * down, down);
            attachment.add_vertex(
                root.position + wide[i] * reach + (rim ? height : 0.0) * root.meridian, normal,
                turn.cosine * out - turn.sine * round,
                place.share + cell_texture_width * (static_cast<double>(j) / corners - 0.5),
                rim ? 1.0 : 0.0, outside ? -1.0F : 1.0F);
        }
    }
    const auto band = [&](std::size_t from, std::size_t to) {
        const auto row = static_cast<std::size_t>(corners) + 1;
        for (std::size_t j = 0; j + 1 < row; ++j) {
            const std::size_t a = first + from * row + j, b = a + 1, c = first + to * row + j,
                              d = c + 1;
            append_triangle(attachment.mesh, a, b, c);
            append_triangle(attachment.mesh, b, d, c);
        }
    };
    band(0, 1);
    band(2, 3);
    if (budget.walls) band(3, 0);
}

}  // namespace

CellBudget cell_budget(const Individual& individual) {
    CellBudget shares;
    for (const SpeciesShare& part : individual.parts)
        (part.model.surface.hymenium.pattern == HymeniumPattern::pores ? shares.pores
                                                                       : shares.spines) +=
            cell_count(part.cells);
    shares.corners = shares.pores <= 1000 ? 6 : 4;
    shares.walls = shares.pores <= 1500;
    shares.rings = spine_rings;
    return shares;
}

MeshCount solid_count(const CellBudget& budget) {
    return {static_cast<std::uint64_t>(budget.spines * (budget.rings + 2) * (budget.sides + 1)) +
                static_cast<std::uint64_t>(budget.pores * (pore_rings + 1) * (budget.corners + 1)),
            static_cast<std::uint64_t>(budget.spines * spine_triangles(budget)) +
                static_cast<std::uint64_t>(budget.pores * pore_triangles(budget))};
}

bool drop_row(CellBudget& budget) {
    if (budget.spines == 0 || budget.rings == 0) return false;
    --budget.rings;
    return true;
}

void coarsen(CellBudget& budget) {
    budget.rings = 0;
    budget.sides = least_sides;
}

void add_cells(const Attachment& attachment, const CellBudget& budget) {
    if (budget.spines > 0)
        add_cells_of(attachment, HymeniumPattern::teeth, spine_size,
                     [&](const PlacedCell& cell) { add_spine(attachment, budget, cell); });
    if (budget.pores > 0)
        add_cells_of(
            attachment, HymeniumPattern::pores, [](const CellPlace&) { return 1.0; },
            [&](const PlacedCell& cell) { add_pore(attachment, budget, cell); });
}

}  // namespace sporeprint
