#include "core/plant/leaf.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <string>

#include "core/math/elementary.h"
#include "core/math/principal_axes.h"
#include "core/mesh/measure.h"
#include "core/params/corners.h"
#include "core/plant/leaf_image.h"
#include "tests/support/atlas.h"
#include "tests/support/draws.h"
#include "tests/support/effort.h"
#include "tests/support/meshes.h"
#include "tests/support/refusals.h"

namespace sporeprint::plant_leaf_test {
namespace {

// Returns the same leaf without fold, curl and waves.
LeafShape pressed(LeafShape shape) {
    shape.curl_deg = shape.fold_deg = shape.wave = shape.relief = 0.0;
    return shape;
}

// Returns the area seen from above: half of that of both faces, projected along y.
double seen_area(const Mesh& mesh) {
    double twice = 0.0;
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
        const glm::dvec3 a = mesh.positions[mesh.indices[i]];
        const glm::dvec3 b = mesh.positions[mesh.indices[i + 1]];
        const glm::dvec3 c = mesh.positions[mesh.indices[i + 2]];
        twice += std::max(0.0, glm::cross(b - a, c - a).y);
    }
    return 0.5 * twice;
}

TEST(Leaf, PresetsAreClosedShellsAtEveryLevelOfDetail) {
    ASSERT_FALSE(leaf_presets().empty());
    for (const LeafPreset& preset : leaf_presets()) {
        SCOPED_TRACE(preset.id.string());
        EXPECT_EQ(leaf_preset(preset.id.string()), &preset);
        const auto leaflets = static_cast<std::size_t>(preset.shape.leaflets.count);
        // Up to 5,000 triangles at LOD 0, and some hundreds for what is eaten; leaflets have their own
        // limit, and the axis 200.
        std::size_t before = leaflets > 0 ? most_leaflet_triangles + 200 : 6'000;
        for (int lod = 0; lod < leaf_lods; ++lod) {
            const Mesh mesh = leaf_mesh(preset.shape, lod);
            expect_valid(mesh);
            EXPECT_EQ(pieces(mesh).size(), 1 + std::max<std::size_t>(leaflets, 1));
            EXPECT_LT(mesh.triangles(),
                      before + (lod == 3 ? 1 : 0));  // a needle is a polygon already
            before = mesh.triangles();
        }
        expect_valid(foliage_leaf(preset.shape));
        EXPECT_LE(foliage_leaf(preset.shape).triangles(), most_foliage_triangles);
    }
    EXPECT_EQ(leaf_preset("elm"), nullptr);
}

TEST(Leaf, AnyLeafIsClosed) {
    Random random(5, 1);
    const std::size_t draws = effort(300, 40);
    for (std::size_t i = 0; i < draws; ++i) {
        const auto shape = drawn<LeafShape>(random);
        const auto lod = static_cast<int>(i % 5);
        const Mesh mesh = lod < leaf_lods ? leaf_mesh(shape, lod) : foliage_leaf(shape);
        const std::vector<std::string> found = defects(mesh);
        ASSERT_TRUE(found.empty()) << i << ": " << found.front();
        ASSERT_GT(volume(mesh), 0.0) << i;
    }
}

TEST(Leaf, LeavesAtTheEndsOfTheirRangesAreClosed) {
    for (const LeafPreset& preset : leaf_presets()) {
        LeafShape shape = preset.shape;
        walk_corners(shape, Info{.name = ""}, "", [&](const std::string& path) {
            std::vector<Problem> problems;
            check(shape, Info{.name = ""}, "", problems);
            if (!problems.empty()) return;
            for (const int lod : {0, 2})
                EXPECT_TRUE(defects(leaf_mesh(shape, lod)).empty())
                    << preset.id.string() << path << lod;
        });
    }
}

TEST(Leaf, FoliageKeepsTheAreaOfTheLamina) {
    for (const LeafPreset& preset : leaf_presets()) {
        const LeafShape flat = pressed(preset.shape);
        // A shoot is a card, of which its image shows as much as there is of needles.
        const double all = shows_shoots(flat) ? seen_area(foliage_leaf(flat)) : lamina_area(flat);
        for (const std::size_t triangles : {2U, 4U, 8U, 12U, 16U}) {
            const Mesh mesh = foliage_leaf(flat, triangles);
            EXPECT_LE(mesh.triangles(), triangles) << preset.id.string();
            // The star of a compound leaf is thicker in its middle.
            EXPECT_NEAR(seen_area(mesh) / all, 1.0, flat.leaflets.count > 0 ? 1e-3 : 1e-4)
                << preset.id.string();
        }
    }
}

// From far away a leaf is a spot: the flat ones are as large, at the same place and as slender.
TEST(Leaf, FlatFoliageHasTheMomentsOfTheFinest) {
    for (const LeafPreset& preset : leaf_presets()) {
        LeafShape shape = preset.shape;
        shape.thickness = 0.002;  // needles are as thick as broad
        const SurfaceMoments finest = surface_moments(foliage_leaf(shape));
        const PrincipalAxes axes = principal_axes(finest.covariance);
        for (const std::size_t triangles : {2U, 4U})
            for (const double share : {1.0, 1.2}) {
                SCOPED_TRACE(preset.id.string() + std::to_string(triangles));
                const Mesh mesh = foliage_leaf(shape, triangles, share);
                EXPECT_TRUE(defects(mesh).empty());
                const SurfaceMoments flat = surface_moments(mesh);
                const PrincipalAxes own = principal_axes(flat.covariance);
                EXPECT_NEAR(flat.area / finest.area, share, 0.01);
                EXPECT_LT(glm::distance(flat.middle, finest.middle), 1e-3 * shape.length);
                EXPECT_GT(std::abs(glm::dot(own.directions[0], axes.directions[0])), 0.999);
                EXPECT_LT(own.variances[2], 1e-6 * own.variances[0]);
                EXPECT_NEAR(std::sqrt(own.variances[0] / own.variances[1]),
                            std::sqrt(axes.variances[0] / axes.variances[1]),
                            2e-2 * std::sqrt(axes.variances[0] / axes.variances[1]));
                // The front is the upper face.
                EXPECT_GT(mesh.normals.front().y, 0.5F);
            }
    }
}

// Levels of detail remove teeth and curves, but not lobes.
TEST(Leaf, LevelsOfDetailHaveNearlyOneArea) {
    for (const LeafPreset& preset : leaf_presets()) {
        if (preset.id.view() == "needle") continue;  // its petiole is as wide as its lamina
        const LeafShape flat = pressed(preset.shape);
        const double finest = seen_area(leaf_mesh(flat, 0));
        for (int lod = 1; lod < leaf_lods; ++lod)
            EXPECT_NEAR(seen_area(leaf_mesh(flat, lod)) / finest, 1.0, 0.15)
                << preset.id.string() << lod;
    }
}

// A leaf that is shorter at a coarse level would visibly jump. Both ends of its bounding box along
// each axis are compared.
TEST(Leaf, NeighbouringLevelsOfDetailReachEquallyFar) {
    for (const LeafPreset& preset : leaf_presets())
        for (const double variation : {0.0, 0.5, 1.0})
            for (std::uint32_t seed = 1; seed <= effort(12, 2); ++seed) {
                const LeafShape shape = individual_leaf(preset.shape, seed, variation);
                Bounds before = bounds(leaf_mesh(shape, 0));
                for (int lod = 1; lod < leaf_lods; ++lod) {
                    const Bounds box = bounds(leaf_mesh(shape, lod));
                    const glm::vec3 size = before.max - before.min;
                    const float bar = 0.03F * std::max({size.x, size.y, size.z});
                    for (int axis = 0; axis < 3; ++axis) {
                        EXPECT_NEAR(box.min[axis], before.min[axis], bar)
                            << preset.id.string() << ' ' << variation << ' ' << seed << ' ' << lod
                            << axis;
                        EXPECT_NEAR(box.max[axis], before.max[axis], bar)
                            << preset.id.string() << ' ' << variation << ' ' << seed << ' ' << lod
                            << axis;
                    }
                    before = box;
                }
            }
}

// However thick a needle is, it thins out towards both ends: its petiole, which begins at its root,
// does not stand beside it.
TEST(Leaf, LaminaeAreThinWhereTheyAreNarrow) {
    LeafShape needle = pressed(leaf_preset("needle")->shape);
    ASSERT_GT(needle.thickness, 0.03);
    const Mesh mesh = leaf_mesh(needle, 0);
    const double root = needle.petiole * needle.length;
    double middle = 0.0;
    for (const glm::vec3& place : mesh.positions) {
        const double along = (static_cast<double>(place.z) - root) / needle.length;
        const double up = static_cast<double>(place.y) / needle.length;
        if (along > 0.3 && along < 0.7) middle = std::max(middle, up);
        if (along > 0.97) {
            EXPECT_LT(up, 0.35 * needle.thickness);
        }
    }
    EXPECT_NEAR(middle, 0.5 * needle.thickness, 0.2 * needle.thickness);
}

TEST(Leaf, TheMiddleVeinKeepsItsLengthHoweverItCurls) {
    LeafShape shape = pressed(leaf_preset("birch")->shape);
    for (const double curl : {0.0, 90.0, -90.0, 180.0}) {
        shape.curl_deg = curl;
        const Mesh mesh = leaf_mesh(shape, 0);
        // The tip is the middle of an arc that turns by the curl over the lamina's length.
        const double turn = radians(curl);
        const glm::dvec3 wanted =
            shape.length * (curl == 0.0 ? glm::dvec3(0.0, 0.0, 1.0)
                                        : glm::dvec3(0.0, (std::cos(turn) - 1.0) / turn,
                                                     std::sin(turn) / turn)) +
            glm::dvec3(0.0, 0.0, shape.length * shape.petiole);
        double nearest = 1e9;
        for (const glm::vec3& place : mesh.positions)
            nearest = std::min(nearest, glm::distance(glm::dvec3(place), wanted));
        EXPECT_LT(nearest, 1e-6) << curl;
    }
}

TEST(Leaf, FacesLieOnTheirHalvesOfTheImage) {
    const LeafShape shape = pressed(leaf_preset("maple")->shape);
    const LeafChart chart = chart_of(lamina_of(shape.venation, leaf_steps(shape.venation, 0)));
    Random random(2, 1);
    for (int i = 0; i < 200; ++i) {
        const double x = random.uniform(0.02, 0.98), y = random.uniform(0.02, 0.9);
        bool upper = false;
        const glm::dvec2 place = chart.place({x, y}, upper);
        EXPECT_EQ(upper, x < 0.5);
        EXPECT_LT(glm::distance(chart.texture_point(place, upper), glm::dvec2(x, y)), 1e-12);
    }
    const Mesh mesh = leaf_mesh(shape, 0);
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        const glm::vec2 at = mesh.texture_coordinates[i];
        if (at.y > petiole_strip) continue;
        EXPECT_EQ(at.x<0.5F, mesh.normals[i].y> 0.0F);
    }
}

TEST(Leaf, InvalidRequestsAreRefused) {
    LeafShape shape;
    EXPECT_TRUE(names(refusal([&] { (void)leaf_mesh(shape, 4); }), "/lod", "outside 0..3"));
    EXPECT_TRUE(names(refusal([&] { (void)foliage_leaf(shape, 18); }), "/triangles", "18"));
    EXPECT_TRUE(names(refusal([&] { (void)foliage_leaf(shape, 10); }), "/triangles", "10"));
    shape.length = 0.0;
    EXPECT_TRUE(names(refusal([&] { (void)leaf_mesh(shape, 0); }), "/length", "outside"));
}

}  // namespace
}  // namespace sporeprint::plant_leaf_test
