#include "core/plant/leaf_damage.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <glm/geometric.hpp>
#include <string>
#include <vector>

#include "core/mesh/measure.h"
#include "core/plant/leaf.h"
#include "core/plant/leaf_image.h"
#include "tests/support/orders.h"

namespace sporeprint::plant_leaf_damage_test {
namespace {

std::vector<LeafPreset> simple_leaves() {
    std::vector<LeafPreset> found;
    for (const LeafPreset& preset : leaf_presets())
        if (preset.shape.leaflets.count == 0) found.push_back(preset);
    return found;
}

/// Returns the shape without what moves it out of its plane.
LeafShape flat(LeafShape shape, double eaten) {
    shape.curl_deg = shape.fold_deg = shape.wave = shape.bow = 0.0;
    shape.eaten = eaten;
    return shape;
}

/// Returns the area of a leaf seen from above.
double area_of(const LeafShape& shape, int lod, std::uint32_t seed) {
    const Mesh mesh = leaf_mesh(shape, lod, 1.0, seed);
    double twice = 0.0;
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
        const glm::vec3 a = mesh.positions[mesh.indices[i]],
                        b = mesh.positions[mesh.indices[i + 1]],
                        c = mesh.positions[mesh.indices[i + 2]];
        twice += std::max(0.0, static_cast<double>(glm::cross(b - a, c - a).y));
    }
    return 0.5 * twice;
}

TEST(EatenLeaf, IsClosedHoweverMuchIsEaten) {
    for (const LeafPreset& preset : simple_leaves())
        for (const double eaten : {0.01, 0.03, 0.1, 0.3})
            for (std::uint32_t seed = 1; seed <= 4; ++seed)
                for (int lod = 0; lod < 2; ++lod) {
                    SCOPED_TRACE(preset.id.string() + ' ' + std::to_string(eaten) + ' ' +
                                 std::to_string(seed) + ' ' + std::to_string(lod));
                    LeafShape shape = preset.shape;
                    shape.eaten = eaten;
                    const Mesh mesh = leaf_mesh(shape, lod, 1.0, seed);
                    EXPECT_EQ(defects(mesh), std::vector<std::string>());
                    const LeafCount most = most_of_leaf(shape, lod);
                    EXPECT_LE(mesh.positions.size(), most.vertices);
                    EXPECT_LE(mesh.triangles(), most.triangles);
                }
}

TEST(EatenLeaf, LacksAboutTheStatedShare) {
    for (const LeafPreset& preset : simple_leaves()) {
        // A needle has no room for a hole beside its vein.
        if (preset.id.string() == "needle") continue;
        SCOPED_TRACE(preset.id.string());
        for (const double eaten : {0.03, 0.06}) {
            double lacking = 0.0;
            constexpr std::uint32_t individuals = 8;
            for (std::uint32_t seed = 1; seed <= individuals; ++seed) {
                const double lost = 1.0 - area_of(flat(preset.shape, eaten), 0, seed) /
                                              area_of(flat(preset.shape, 0.0), 0, seed);
                EXPECT_GE(lost, 0.0);
                EXPECT_LE(lost, 2.0 * eaten);
                lacking += lost / individuals;
            }
            EXPECT_GT(lacking, 0.4 * eaten);
            EXPECT_LT(lacking, 1.3 * eaten);
        }
    }
}

TEST(EatenLeaf, HasHolesAndBites) {
    const LeafShape& oak = leaf_preset("oak")->shape;
    EXPECT_GT(oak.eaten, 0.0) << "the default";
    int holes = 0, bites = 0;
    for (std::uint32_t seed = 1; seed <= 10; ++seed) {
        const Lamina lamina = lamina_of(oak.venation, leaf_steps(oak.venation, 0));
        const LaminaSampler sampler(lamina);
        const std::vector<EatenSpot> spots = eaten_spots(lamina, oak.eaten, seed);
        EXPECT_LE(static_cast<int>(spots.size()), most_eaten_spots(oak.eaten));
        for (const EatenSpot& spot : spots) {
            EXPECT_LT(spot.outside(spot.middle), 0.0);
            // Along a circle of its greatest radius nothing is eaten.
            int inside = 0;
            for (const glm::dvec2 way : {glm::dvec2(1, 0), glm::dvec2(0, 1), glm::dvec2(-1, 0),
                                         glm::dvec2(0, -1), glm::dvec2(0.6, 0.8)}) {
                const glm::dvec2 place = spot.middle + EatenSpot::farthest * spot.radius * way;
                EXPECT_GE(spot.outside(place), 0.0);
                inside += sampler.at(place).inside ? 1 : 0;
            }
            ++(inside == 5 ? holes : bites);
        }
    }
    EXPECT_GE(holes, 8);
    EXPECT_GE(bites, 8);
    EXPECT_TRUE(eaten_spots(lamina_of(oak.venation, 2), 0.0, 1).empty());
}

TEST(EatenLeaf, IsAnotherOneForAnotherSeedAndTheSameForTheSame) {
    const LeafShape& oak = leaf_preset("oak")->shape;
    EXPECT_EQ(leaf_mesh(oak, 0, 1.0, 3).positions, leaf_mesh(oak, 0, 1.0, 3).positions);
    EXPECT_NE(leaf_mesh(oak, 0, 1.0, 3).positions, leaf_mesh(oak, 0, 1.0, 4).positions);
}

// The images show a brown rim where the mesh ends, greener farther off.
TEST(EatenLeaf, HasBrownRims) {
    const LeafPreset& oak = *leaf_preset("oak");
    LeafPalette palette = oak.palette;
    palette.marks = 0.0;
    constexpr int side = 512;
    const Lamina lamina = lamina_of(oak.shape.venation, leaf_steps(oak.shape.venation, 0));
    const LeafChart chart = chart_of(lamina);
    const LaminaSampler sampler(lamina);
    const RawImages images = leaf_images(oak.shape, palette, 0.0, 2, side);
    const std::vector<EatenSpot> spots = eaten_spots(lamina, oak.shape.eaten, 2);
    ASSERT_FALSE(spots.empty());
    for (const EatenSpot& spot : spots)
        for (const bool upper : {true, false}) {
            double red_at_rim = 0.0, green_at_rim = 0.0, red_beyond = 0.0, green_beyond = 0.0;
            for (int y = 0; y < side; ++y)
                for (int x = 0; x < side; ++x) {
                    bool is_upper = false;
                    const glm::dvec2 place =
                        chart.place({(x + 0.5) / side, (y + 0.5) / side}, is_upper);
                    if (is_upper != upper || !sampler.at(place).inside) continue;
                    const double out = spot.outside(place);
                    const std::uint8_t* texel =
                        &images.rgb[0][3 * static_cast<std::size_t>(y * side + x)];
                    if (out > 0.0 && out < 0.003) {
                        red_at_rim += texel[0];
                        green_at_rim += texel[1];
                    } else if (out > 0.03 && out < 0.06) {
                        red_beyond += texel[0];
                        green_beyond += texel[1];
                    }
                }
            EXPECT_GT(red_at_rim, green_at_rim);
            EXPECT_LT(red_beyond, green_beyond);
        }
}

}  // namespace
}  // namespace sporeprint::plant_leaf_damage_test
