#include "core/geometry/cells.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>

#include "core/math/direction.h"
#include "core/math/elementary.h"

namespace sporeprint {

namespace {

constexpr int spine_sides = 5;
constexpr int spine_triangles = 2 * spine_sides - 2;

/// Rings of corners of a pore: outer base, rim, inner base.
constexpr int pore_rings = 3;

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

void add_spines(const Attachment& attachment) {
    const double length = attachment.face.length();
    constexpr int sides = spine_sides;
    const AxisStation station =
        attachment.context.deformer.frozen_station(attachment.context.deformer.top());
    for (const SpeciesShare& part : attachment.individual.parts) {
        if (part.cells.rows == 0 || part.model.surface.hymenium.pattern != HymeniumPattern::teeth)
            continue;
        const HymeniumOf<Plain>& hymenium = part.model.hymenium;
        const double cell = length / part.cells.rows;
        for (const CellPlace& cell_at :
             cell_places(part.cells, attachment.individual.effective.seed)) {
            const LowerFace::Place at = attachment.face.at(cell_at.share);
            const double size = 1.0 + 0.25 * cell_at.lot;
            const double own = part.weight * length * hymenium.depth *
                               depth_envelope(hymenium, cell_at.share) *
                               cell_depth(hymenium, cell_at.share) * at.scale * std::min(size, 1.0);
            const double embedding = std::min(1.0, own / (0.01 * length + 1e-12));
            const double height = own > 0.0 ? own + embedding * at.sink : 0.0;
            const double radius = std::min(0.5 * hymenium.thickness * cell * (0.9 + 0.1 * size),
                                           0.45 * height + 1e-9);
            const SurfacePoint root = cell_root(attachment, cell_at, embedding, station);
            const glm::dvec3 down = unit_or(root.meridian, {0.0, -1.0, 0.0}),
                             round = unit_or(root.azimuth, {1.0, 0.0, 0.0}),
                             out = glm::cross(down, round);
            const glm::dvec3 lean = 0.12 * height * (cell_at.lot * round - 0.6 * cell_at.lot * out);
            const auto first = static_cast<std::uint32_t>(attachment.mesh.positions.size());
            for (const double up : {0.0, 1.0}) {
                const double wide = 1.0 - up;
                for (int j = 0; j <= sides; ++j) {
                    const auto turn = sine_cosine(2.0 * pi * (j % sides) / sides);
                    const glm::dvec3 aside = turn.cosine * round + turn.sine * out;
                    const glm::dvec3 normal = unit_or(aside + (0.25 + 0.9 * up * up) * down, down);
                    attachment.add_vertex(
                        root.position + up * (height * root.meridian + lean) +
                            wide * radius * aside,
                        normal, turn.cosine * out - turn.sine * round,
                        cell_at.share + 0.06 * (static_cast<double>(j) / sides - 0.5), up, -1.0F);
                }
            }
            if (height <= 0.0 && !attachment.context.keep_absent) continue;
            const auto add = [&](int a, int b, int c2) {
                attachment.mesh.indices.insert(
                    attachment.mesh.indices.end(),
                    {first + static_cast<std::uint32_t>(a), first + static_cast<std::uint32_t>(b),
                     first + static_cast<std::uint32_t>(c2)});
            };
            for (int j = 0; j < sides; ++j) add(j, j + 1, j + sides + 1);
            for (int j = 1; j + 1 < sides; ++j) add(0, j + 1, j);
        }
    }
}

// A pore is the mouth of a tube: a ring of flesh from the flesh between tubes to the rim and back
// inside. The rim has two rows of vertices, one for each side of the wall.
void add_pores(const Attachment& attachment, const CellBudget& shares) {
    const double length = attachment.face.length();
    const int corners = shares.corners;
    const AxisStation station =
        attachment.context.deformer.frozen_station(attachment.context.deformer.top());
    for (const SpeciesShare& part : attachment.individual.parts) {
        if (part.cells.rows == 0 || part.model.surface.hymenium.pattern != HymeniumPattern::pores)
            continue;
        const HymeniumOf<Plain>& hymenium = part.model.hymenium;
        const double cell = length / part.cells.rows;
        for (const CellPlace& cell_at :
             cell_places(part.cells, attachment.individual.effective.seed)) {
            const LowerFace::Place at = attachment.face.at(cell_at.share);
            const double own = part.weight * length * hymenium.depth *
                               depth_envelope(hymenium, cell_at.share) *
                               cell_depth(hymenium, cell_at.share) * at.scale;
            const double embedding = std::min(1.0, own / (0.01 * length + 1e-12));
            const double height = own > 0.0 ? own + embedding * at.sink : 0.0;
            const double along = height > 0.0 ? 0.53 * cell : 0.0,
                         round = along / hymenium.elongation;
            const SurfacePoint root = cell_root(attachment, cell_at, embedding, station);
            const glm::dvec3 down = unit_or(root.meridian, {0.0, -1.0, 0.0}),
                             aside = unit_or(root.azimuth, {1.0, 0.0, 0.0}),
                             out = glm::cross(down, aside);
            const auto first = static_cast<std::uint32_t>(attachment.mesh.positions.size());
            const double spin = 0.5 + 0.25 * cell_at.lot;
            // Rows: outer base, rim twice, inner base.
            const double inner = shares.walls ? 0.72 : 0.96;
            const std::array<double, 4> wide = {0.96, 0.5 * (0.96 + inner), 0.5 * (0.96 + inner),
                                                inner};
            for (std::size_t i = 0; i < 4; ++i) {
                const bool rim = i == 1 || i == 2, outside = i < 2;
                for (int j = 0; j <= corners; ++j) {
                    const auto turn = sine_cosine(2.0 * pi * ((j % corners) + spin) / corners);
                    const glm::dvec3 to = turn.cosine * aside + turn.sine * out;
                    const glm::dvec3 reach = turn.cosine * round * aside + turn.sine * along * out;
                    const glm::dvec3 normal =
                        unit_or((outside ? 1.0 : -1.0) * to + (rim ? 0.8 : 0.0) * down, down);
                    attachment.add_vertex(
                        root.position + wide[i] * reach + (rim ? height : 0.0) * root.meridian,
                        normal, turn.cosine * out - turn.sine * aside,
                        cell_at.share + 0.06 * (static_cast<double>(j) / corners - 0.5),
                        rim ? 1.0 : 0.0, outside ? -1.0F : 1.0F);
                }
            }
            if (height <= 0.0 && !attachment.context.keep_absent) continue;
            const int row = corners + 1;
            const auto add = [&](int a, int b, int c) {
                attachment.mesh.indices.insert(
                    attachment.mesh.indices.end(),
                    {first + static_cast<std::uint32_t>(a), first + static_cast<std::uint32_t>(b),
                     first + static_cast<std::uint32_t>(c)});
            };
            const auto band = [&](int from, int to) {
                for (int j = 0; j < corners; ++j) {
                    const int a = from * row + j, b = a + 1, c = to * row + j, d = c + 1;
                    add(a, b, c);
                    add(b, d, c);
                }
            };
            band(0, 1);
            band(2, 3);
            if (shares.walls) band(3, 0);
        }
    }
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
    if (budget.spines > 0) add_spines(attachment);
    if (budget.pores > 0) add_pores(attachment, budget);
}

}  // namespace sporeprint
