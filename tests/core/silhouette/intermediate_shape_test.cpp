#include "core/silhouette/intermediate_shape.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/silhouette/outline.h"

namespace sporeprint {
namespace {

/// A stem and a cap from one height to another, straight.
OutlineNodes straight(double from, double to) {
    const double turn = 0.6 * from + 0.4 * to;
    OutlineNodes nodes;
    nodes.stem = {{{0.0, from}, {}}, {{0.1, 0.5 * (from + turn)}, {}}, {{0.2, turn}, {}}};
    nodes.cap = {{{0.2, turn}, {}}, {{0.1, 0.5 * (turn + to)}, {}}, {{0.0, to}, {}}};
    return nodes;
}

TEST(Bud, LiesOnOneSideOfTheAxisWhicheverWayItsShapesGo) {
    for (const double to : {1.0, 0.2, 1e-9, 0.0, -0.2, -1.0}) {
        const OutlineNodes bud = bud_of({straight(0.0, to)});
        for (const CurveName curve : {CurveName::stem, CurveName::cap})
            for (const OutlineNode& node : bud.of(curve)) {
                const bool pole = &node == &bud.stem.front() || &node == &bud.cap.back();
                EXPECT_EQ(node.position.x > 0.0, !pole) << to;
            }
        const double rise = bud.cap.back().position.y - bud.stem.front().position.y;
        EXPECT_GE(std::abs(rise), 0.01 - 1e-12);
        if (to != 0.0) {
            EXPECT_GT(rise * to, 0.0) << "a bud stands or hangs as its shapes do";
        }
    }
}

}  // namespace
}  // namespace sporeprint
