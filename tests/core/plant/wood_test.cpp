#include "core/plant/wood.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "core/math/elementary.h"
#include "core/mesh/measure.h"
#include "core/plant/wood_image.h"
#include "tests/support/refusals.h"

namespace sporeprint::plant_wood_test {
namespace {

TEST(Wood, IsAClosedPieceOfItsRadiusAndLength) {
    for (const double radius : {0.01, 0.2, 3.0})
        for (const double length : {0.05, 1.0, 9.0})
            for (int lod = 0; lod < 4; ++lod)
                for (const bool textured : {true, false}) {
                    const WoodPiece piece{radius, -0.25 * length, 0.75 * length, 7};
                    const Mesh mesh = wood_mesh(piece, lod, textured);
                    EXPECT_EQ(defects(mesh), std::vector<std::string>{});
                    const MeshCount count = wood_count(piece, lod);
                    EXPECT_EQ(mesh.positions.size(), count.vertices);
                    EXPECT_EQ(mesh.triangles(), count.triangles);
                    EXPECT_EQ(mesh.texture_coordinates.empty(), !textured);
                    const double cylinder = pi * radius * radius * length;
                    // A polygon of twelve sides fills 0.95 of its circle.
                    // Ends are cut by so much at most.
                    const double cut = deepest_end * std::min(radius, length);
                    EXPECT_GT(volume(mesh), 0.93 * cylinder * (1.0 - 2.0 * cut / length));
                    EXPECT_LT(volume(mesh), uneven_radius * uneven_radius * cylinder);
                    const Bounds box = bounds(mesh);
                    EXPECT_GE(box.min.y, -0.25 * length - 1e-6 * length);
                    EXPECT_LE(box.min.y, -0.25 * length + cut);
                    EXPECT_LE(box.max.y, 0.75 * length + 1e-6 * length);
                    EXPECT_GE(box.max.y, 0.75 * length - cut);
                }
}

TEST(Wood, SplitIsTheClosedSegmentInFrontOfItsFace) {
    for (const double radius : {0.01, 0.2, 3.0})
        for (const double share : {0.1, 0.5, 0.75, 0.99})
            for (int lod = 0; lod < 4; ++lod) {
                const double length = 2.5 * radius;
                const WoodPiece piece{radius, -0.5 * length, 0.5 * length, 7, share * radius};
                const Mesh mesh = wood_mesh(piece, lod, true);
                EXPECT_EQ(defects(mesh), std::vector<std::string>{}) << share << " at " << lod;
                const MeshCount count = wood_count(piece, lod);
                EXPECT_EQ(mesh.positions.size(), count.vertices);
                EXPECT_EQ(mesh.triangles(), count.triangles);
                // The area of a segment of a circle, without and with bumps.
                const auto segment = [&](double circle) {
                    const double cosine = (1.0 - share) * radius / circle;
                    const double angle = std::acos(cosine);
                    return circle * circle * (angle - cosine * std::sin(angle));
                };
                EXPECT_GT(volume(mesh),
                          0.9 * segment(radius) * (length - 2 * deepest_end * radius));
                // The edges of the split wander backwards by so much at most.
                EXPECT_LT(volume(mesh), 1.12 * segment(uneven_radius * radius) * length +
                                            0.11 * radius * radius * length);
            }
}

TEST(Wood, SplitFaceLooksBackAndShowsGrowthRings) {
    const Mesh mesh = wood_mesh({0.1, -0.2, 0.2, 3, 0.07}, 0, true);
    int faces = 0;
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        if (mesh.normals[i] != glm::vec3(0.0F, 0.0F, -1.0F)) continue;
        ++faces;
        const double x = static_cast<double>(mesh.positions[i].x),
                     v = static_cast<double>(mesh.texture_coordinates[i].y);
        // The image of end grain, at the distance from the pith.
        const double z = static_cast<double>(mesh.positions[i].z) + 0.1;
        const double from_pith = std::min(std::sqrt(x * x + z * z) / 0.1, 1.0);
        EXPECT_NEAR(v, wood_end_middle + from_pith * (wood_end_rim - wood_end_middle), 1e-4);
    }
    EXPECT_GT(faces, 50);
}

TEST(Wood, ReachesTheOriginFromBehind) {
    for (std::uint32_t seed = 0; seed < 40; ++seed) {
        const WoodPiece piece{0.1, -0.3, 0.4, seed};
        const Mesh mesh = wood_mesh(piece, 0, true);
        for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
            const glm::vec3 at = mesh.positions[i];
            const double x = static_cast<double>(at.x), z = static_cast<double>(at.z) + 0.1;
            const double from_axis = std::sqrt(x * x + z * z);
            EXPECT_LE(from_axis, 0.1 * uneven_radius + 1e-6);
            if (static_cast<double>(mesh.texture_coordinates[i].y) <= wood_bark_end) {
                EXPECT_GE(from_axis, 0.1 - 1e-6) << "bark";
            }
        }
        EXPECT_GE(bounds(mesh).max.z, 0.0F);
    }
}

TEST(Wood, BarkAndEndsHaveTheirPartsOfTheImage) {
    const Mesh mesh = wood_mesh({0.1, -2.0, 2.0, 3}, 1, true);
    int bark = 0, ends = 0;
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        const double v = static_cast<double>(mesh.texture_coordinates[i].y);
        const bool is_end = v > 0.5 * (wood_bark_end + wood_end_rim);
        ++(is_end ? ends : bark);
        if (is_end) {
            EXPECT_GE(v, wood_end_rim - 1e-6);
            EXPECT_LE(v, wood_end_middle + 1e-6);
        } else {
            EXPECT_LE(v, wood_bark_end + 1e-6);
        }
    }
    EXPECT_GT(bark, 100);
    EXPECT_GT(ends, 100);
}

TEST(Wood, HasTheReliefOfItsKindWhereItsMeshIsFine) {
    // How far triangles lean against the normals of the bark without relief.
    const auto roughness = [](Substrate kind, int lod) {
        const Mesh mesh = wood_mesh({0.1, -0.2, 0.2, 5, 0.075, kind}, lod, true);
        double sum = 0.0;
        int bark = 0;
        for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
            const auto corner = [&](std::size_t k) {
                return glm::dvec3(mesh.positions[mesh.indices[i + k]]);
            };
            if (static_cast<double>(mesh.texture_coordinates[mesh.indices[i]].y) > wood_bark_end)
                continue;
            const glm::dvec3 across =
                glm::normalize(glm::cross(corner(1) - corner(0), corner(2) - corner(0)));
            sum += 1.0 - glm::dot(across, glm::dvec3(mesh.normals[mesh.indices[i]]));
            ++bark;
        }
        return sum / bark;
    };
    EXPECT_GT(roughness(Substrate::oak, 0), 3.0 * roughness(Substrate::beech, 0));
    EXPECT_LT(roughness(Substrate::oak, 2), 1.2 * roughness(Substrate::beech, 2));
}

TEST(Wood, OfAnyLengthHasABoundedNumberOfRows) {
    for (int lod = 0; lod < 4; ++lod)
        EXPECT_LT(wood_count({0.1, -50.0, 50.0, 1}, lod).triangles, 60000U);
}

TEST(Wood, OfEverySeedIsUnevenInItsOwnWay) {
    const Mesh one = wood_mesh({0.1, -0.2, 0.2, 1}, 0, false);
    EXPECT_EQ(one.positions, wood_mesh({0.1, -0.2, 0.2, 1}, 0, false).positions);
    EXPECT_NE(one.positions, wood_mesh({0.1, -0.2, 0.2, 2}, 0, false).positions);
}

TEST(Wood, RefusesPiecesWithoutSize) {
    const double nothing = std::numeric_limits<double>::quiet_NaN();
    for (const double radius : {0.0, -1.0, nothing})
        EXPECT_TRUE(names(refusal([&] {
                              (void)wood_mesh({radius, 0.0, 1.0, 1}, 0, true);
                          }),
                          "/radius", "positive"));
    EXPECT_TRUE(names(refusal([] { (void)wood_count({0.1, 1.0, 1.0, 1}, 0); }), "/top", "above"));
    for (const double split : {-0.01, 0.1, 0.2, nothing})
        EXPECT_TRUE(names(refusal([&] {
                              (void)wood_mesh({0.1, 0.0, 1.0, 1, split}, 0, true);
                          }),
                          "/split", "between 0 and the radius"));
}

}  // namespace
}  // namespace sporeprint::plant_wood_test
