#include "core/geometry/litter_piece.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "core/math/elementary.h"
#include "core/mesh/measure.h"
#include "core/surface/charts.h"
#include "tests/support/meshes.h"

namespace sporeprint::geometry_litter_piece_test {
namespace {

constexpr LitterKind all_kinds[] = {LitterKind::leaves, LitterKind::needles, LitterKind::grass,
                                    LitterKind::moss, LitterKind::chips};

/// Returns a rod of this form along x, 1 long, its faces up.
Rod rod_of(const LitterForm& form) {
    Rod rod;
    rod.along = {1.0, 0.0, 0.0};
    rod.side = {0.0, 0.0, -1.0};
    rod.length = 1.0;
    rod.width = form.width;
    rod.thickness = form.thickness;
    rod.widths = form.widths;
    rod.ragged = form.ragged;
    rod.whorl = form.whorl;
    return rod;
}

TEST(LitterPiece, ItsFacesLookUp) {
    EXPECT_NEAR(glm::distance(rod_of(form_of(LitterKind::leaves)).up(), glm::dvec3(0.0, 1.0, 0.0)),
                0.0, 1e-12);
}

TEST(LitterPiece, EveryKindIsAClosedSolidTurnedOutwards) {
    for (const LitterKind kind : all_kinds)
        for (const double curl : {-1.0, 0.0, 1.0}) {
            const LitterForm form = form_of(kind);
            Rod rod = rod_of(form);
            rod.curl = curl * form.curl;
            rod.bend = {0.0, form.bend, 0.0};
            Random random(3, 0);
            GridSolid solid{form.grid, Part::ground, {}, {}};
            solid.corners = corners_of(rod, form.grid, random);
            Mesh mesh;
            append(mesh, solid, rod.up(), true, true);
            expect_valid(mesh);
            EXPECT_GT(volume(mesh), 0.0) << name(kind) << ' ' << curl;
        }
}

TEST(LitterPiece, ItIsAsLongAndAsWideAsItsForm) {
    for (const LitterKind kind : all_kinds) {
        const LitterForm form = form_of(kind);
        Random random(5, 0);
        double from = 1e9, to = -1e9, widest = 0.0, highest = 0.0;
        for (const glm::dvec3& corner : corners_of(rod_of(form), form.grid, random)) {
            from = std::min(from, corner.x);
            to = std::max(to, corner.x);
            widest = std::max(widest, std::abs(corner.z));
            highest = std::max(highest, std::abs(corner.y));
        }
        EXPECT_NEAR(from, 0.0, 1e-12);
        EXPECT_NEAR(to, 1.0, 1e-12);
        EXPECT_LE(widest, form.width * (1.0 + form.ragged) + 1e-12) << name(kind);
        EXPECT_GT(widest, 0.6 * form.width) << name(kind);
        EXPECT_LE(highest, form.thickness + 1e-12) << name(kind);
    }
}

TEST(LitterPiece, CurledSidesAreAboveItsMiddle) {
    const LitterForm form = form_of(LitterKind::leaves);
    Rod rod = rod_of(form);
    rod.curl = 0.5;
    Random random(5, 0);
    for (const glm::dvec3& corner : corners_of(rod, form.grid, random)) {
        if (std::abs(corner.z) > 0.5 * form.width) {
            EXPECT_GT(corner.y, 0.1 * form.width);
        }
    }
}

TEST(LitterPiece, ItsWindowIsInItsBand) {
    for (std::size_t band = 0; band < ground_bands.size(); ++band)
        for (int i = 0; i <= 40; ++i)
            for (const double share : {0.1, 0.3, 1.0})
                for (const double across : {0.35, 1.0}) {
                    const auto& [from_u, to_u, from_v, to_v] =
                        StripPiece{band, i / 40.0, share, across}.window();
                    EXPECT_GE(from_u, 0.0);
                    EXPECT_LE(to_u, 1.0 + 1e-12);
                    EXPECT_NEAR(to_u - from_u, share, 1e-12);
                    EXPECT_GE(from_v, ground_bands[band].from - 1e-12);
                    EXPECT_LE(to_v, ground_bands[band].to + 1e-12);
                }
}

}  // namespace
}  // namespace sporeprint::geometry_litter_piece_test
