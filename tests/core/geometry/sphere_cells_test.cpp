#include "core/geometry/sphere_cells.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <vector>

namespace sporeprint::geometry_sphere_cells_test {
namespace {

TEST(SphereCells, CountsAreThoseOfEuler) {
    for (const int count : {4, 5, 7, 12, 24, 40})
        for (const std::uint32_t seed : {1u, 2u, 99u}) {
            const SphereCells net = sphere_cells(count, seed);
            ASSERT_EQ(net.cells.size(), static_cast<std::size_t>(count));
            EXPECT_EQ(net.corners.size(), static_cast<std::size_t>(2 * count - 4));
            std::vector<int> uses(net.corners.size(), 0);
            for (const SphereCells::Cell& cell : net.cells) {
                EXPECT_GE(cell.corners.size(), 3u);
                for (const std::size_t corner : cell.corners) ++uses[corner];
            }
            for (const int use : uses) EXPECT_EQ(use, 3) << count << ' ' << seed;
        }
}

TEST(SphereCells, EveryCornerIsEquallyFarFromItsThreeCellsAndFartherFromAllOthers) {
    const SphereCells net = sphere_cells(30, 5);
    for (std::size_t corner = 0; corner < net.corners.size(); ++corner) {
        std::vector<double> own, others;
        for (const SphereCells::Cell& cell : net.cells) {
            const bool is_own =
                std::find(cell.corners.begin(), cell.corners.end(), corner) != cell.corners.end();
            (is_own ? own : others).push_back(glm::distance(cell.centre, net.corners[corner]));
        }
        ASSERT_EQ(own.size(), 3u);
        EXPECT_NEAR(own[0], own[1], 1e-9);
        EXPECT_NEAR(own[0], own[2], 1e-9);
        for (const double other : others) EXPECT_GT(other, own[0]);
    }
}

TEST(SphereCells, CornersRunCounterClockwiseRoundTheirCell) {
    const SphereCells net = sphere_cells(18, 3);
    for (const SphereCells::Cell& cell : net.cells)
        for (std::size_t k = 0; k < cell.corners.size(); ++k) {
            const glm::dvec3 a = net.corners[cell.corners[k]],
                             b = net.corners[cell.corners[(k + 1) % cell.corners.size()]];
            EXPECT_GT(glm::dot(glm::cross(a, b), cell.centre), 0.0);
        }
}

TEST(SphereCells, OtherSeedsHaveOtherCells) {
    EXPECT_NE(sphere_cells(24, 1).corners.front(), sphere_cells(24, 2).corners.front());
    EXPECT_EQ(sphere_cells(24, 1).corners, sphere_cells(24, 1).corners);
}

}  // namespace
}  // namespace sporeprint::geometry_sphere_cells_test
