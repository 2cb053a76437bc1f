#include "core/plant/trunk_piece.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/problems.h"
#include "tests/support/meshes.h"

namespace sporeprint::plant_trunk_piece_test {
namespace {

TrunkSection straight(double s) { return {{s, 0.3, 0.0}, 0.25}; }

TEST(TrunkPiece, OfACylinderHasItsVolume) {
    TrunkPieceParams params;
    params.length = 4.0;
    params.foot = params.top = TrunkEnd::cut;
    params.sides = 64;
    const Mesh mesh = trunk_piece(params, straight);
    expect_valid(mesh);
    EXPECT_NEAR(volume(mesh) / (3.141592653589793 * 0.25 * 0.25 * 4.0), 1.0, 0.04)
        << "bark is uneven by 5 % of the radius";
}

TEST(TrunkPiece, IsValidWhereverItLies) {
    for (const double length : {0.1, 0.77, 3.0, 28.0})
        for (const double radius : {0.01, 0.08, 0.4})
            for (const TrunkEnd end : {TrunkEnd::cut, TrunkEnd::broken})
                for (const bool stands : {false, true}) {
                    TrunkPieceParams params;
                    params.length = length;
                    params.start = 0.33 * length;
                    params.seed = static_cast<std::uint32_t>(1000.0 * (length + radius));
                    params.foot = end;
                    params.sides = 8;
                    params.lost = 0.5;
                    params.moss = 0.5;
                    const Mesh mesh = trunk_piece(params, [&](double s) {
                        const double r = radius * (1.0 - 0.8 * s / length);
                        return stands ? TrunkSection{{1.0, s, 2.0}, r}
                                      : TrunkSection{{s, 0.05 * s * s / length, 0.5 * s}, r};
                    });
                    expect_valid(mesh);
                    EXPECT_EQ(mesh.tints.size(), mesh.positions.size());
                    for (const glm::vec3& tint : mesh.tints)
                        for (int k = 0; k < 3; ++k) {
                            EXPECT_GE(tint[k], 0.0F);
                            EXPECT_LE(tint[k], 1.0F);
                        }
                }
}

TEST(TrunkPiece, IsGreenAbove) {
    TrunkPieceParams params;
    params.length = 2.0;
    params.moss = 1.0;
    const Mesh mesh = trunk_piece(params, straight);
    double above = 0.0, below = 0.0;
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        const auto greener = static_cast<double>(mesh.tints[i].g - mesh.tints[i].r);
        (mesh.positions[i].y > 0.3F ? above : below) += greener;
    }
    EXPECT_GT(above, 2.0 * below);
}

TEST(TrunkPiece, RefusesWhatIsNoTrunk) {
    TrunkPieceParams params;
    params.length = 0.0;
    EXPECT_THROW(static_cast<void>(trunk_piece(params, straight)), InvalidInput);
    params.length = 1.0;
    params.sides = 7;
    EXPECT_THROW(static_cast<void>(trunk_piece(params, straight)), InvalidInput);
}

}  // namespace
}  // namespace sporeprint::plant_trunk_piece_test
