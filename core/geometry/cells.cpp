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

constexpr int spine_sides = 5;
constexpr int spine_triangles = 2 * spine_sides - 2;

/// Rings of corners of a pore: outer base, rim, inner base.
constexpr int pore_rings = 3;

// No source or measurement is recorded for the values down to `cell_texture_width`.

/// Depth below which a cell counts as vanishing, in lengths of the meridian: it moves to the
/// nearest vertex.
constexpr double vanishing_depth = 0.01;

/// Largest deviation of the size of spines; radius at the base of the steepest one and the sideways
/// displacement of its tip, in heights; how much of the latter is along the meridian.
constexpr double spine_deviation = 0.25, steepest_spine = 0.45, spine_lean = 0.12,
                 spine_lean_out = 0.6;

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
    return attachment.place(Part::hymenium, attachment.at(share, embedding), angle, station, false);
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

double spine_size(const CellPlace& place) { return 1.0 + spine_deviation * place.lot; }

// Appends a spine: a cone, whose base is closed by a polygon.
void add_spine(const Attachment& attachment, const PlacedCell& cell) {
    constexpr int sides = spine_sides;
    const auto& [place, hymenium, root, down, round, out, width, height] = cell;
    const double radius =
        std::min(0.5 * hymenium.thickness * width * (0.9 + 0.1 * spine_size(place)),
                 steepest_spine * height + 1e-9);
    const glm::dvec3 lean =
        spine_lean * height * (place.lot * round - spine_lean_out * place.lot * out);
    const std::size_t first = attachment.mesh.positions.size();
    for (const double up : {0.0, 1.0}) {
        const double wide = 1.0 - up;
        for (int j = 0; j <= sides; ++j) {
            const auto turn = sine_cosine(2.0 * pi * (j % sides) / sides);
            const glm::dvec3 aside = turn.cosine * round + turn.sine * out;
            const glm::dvec3 normal = unit_or(aside + (0.25 + 0.9 * up * up) * down, down);
            attachment.add_vertex(
                root.position + up * (height * root.meridian + lean) + wide * radius * aside,
                normal, turn.cosine * out - turn.sine * round,
                place.share + cell_texture_width * (static_cast<double>(j) / sides - 0.5), up,
                -1.0F);
        }
    }
    const auto add = [&](int a, int b, int c) {
        append_triangle(attachment.mesh, first + static_cast<std::size_t>(a),
                        first + static_cast<std::size_t>(b), first + static_cast<std::size_t>(c));
    };
    for (int j = 0; j < sides; ++j) add(j, j + 1, j + sides + 1);
    for (int j = 1; j + 1 < sides; ++j) add(0, j + 1, j);
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
    return shares;
}

MeshCount solid_count(const CellBudget& budget) {
    return {static_cast<std::uint64_t>(budget.spines * 2 * (spine_sides + 1)) +
                static_cast<std::uint64_t>(budget.pores * (pore_rings + 1) * (budget.corners + 1)),
            static_cast<std::uint64_t>(budget.spines * spine_triangles) +
                static_cast<std::uint64_t>(budget.pores * pore_triangles(budget))};
}

void add_cells(const Attachment& attachment, const CellBudget& budget) {
    if (budget.spines > 0)
        add_cells_of(
            attachment, HymeniumPattern::teeth,
            [](const CellPlace& place) { return std::min(spine_size(place), 1.0); },
            [&](const PlacedCell& cell) { add_spine(attachment, cell); });
    if (budget.pores > 0)
        add_cells_of(
            attachment, HymeniumPattern::pores, [](const CellPlace&) { return 1.0; },
            [&](const PlacedCell& cell) { add_pore(attachment, budget, cell); });
}

}  // namespace sporeprint
