#include "core/silhouette/intermediate_shape.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/silhouette/outline.h"

namespace sporeprint::silhouette_intermediate_shape_test {
namespace {

/// Returns a straight stem and cap from one height to another.
OutlineNodes straight(double from, double to) {
    const double turn = 0.6 * from + 0.4 * to;
    OutlineNodes nodes;
    nodes.stem = {{{0.0, from}, {}}, {{0.1, 0.5 * (from + turn)}, {}}, {{0.2, turn}, {}}};
    nodes.cap = {{{0.2, turn}, {}}, {{0.1, 0.5 * (turn + to)}, {}}, {{0.0, to}, {}}};
    return nodes;
}

TEST(IntermediateShape, LiesOnOneSideOfTheAxisForShapesOfEitherDirection) {
    for (const double to : {1.0, 0.2, 1e-9, 0.0, -0.2, -1.0}) {
        const OutlineNodes intermediate = intermediate_shape({straight(0.0, to)});
        for (const CurveName curve : {CurveName::stem, CurveName::cap})
            for (const OutlineNode& node : intermediate.of(curve)) {
                const bool pole =
                    &node == &intermediate.stem.front() || &node == &intermediate.cap.back();
                EXPECT_EQ(node.position.x > 0.0, !pole) << to;
            }
        const double rise =
            intermediate.cap.back().position.y - intermediate.stem.front().position.y;
        EXPECT_GE(std::abs(rise), 0.01 - 1e-12);
        if (to != 0.0) {
            EXPECT_GT(rise * to, 0.0) << "the intermediate shape keeps the direction of its shapes";
        }
    }
}

}  // namespace
}  // namespace sporeprint::silhouette_intermediate_shape_test
