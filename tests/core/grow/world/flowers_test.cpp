#include "core/grow/world/flowers.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "tests/support/meshes.h"
#include "tests/support/plots.h"

namespace sporeprint::grow_flowers_test {
namespace {

CoverField covered(const WorldBox& box, double grass, double leaves) {
    return cover_field(box, 1.0, [grass, leaves](double, double) {
        Cover cover;
        cover.grass = grass;
        cover.leaves[0] = leaves;
        cover.soil = 1.0 - grass - leaves;
        return cover;
    });
}

std::vector<GlbTransform> places_on(const FlowerKind& kind, int day, double grass, double leaves,
                                    double size = 12.0) {
    const SmallWood& wood = small_wood();
    PlotContent content = wood.content(0.0, 0.0, size);
    content.time = time_of(SmallWood::year, day);
    const FloorHeights floor(wood.ground, content.seed, content.micro, {});
    return places_of(kind, content, PlotFrame(content, floor),
                     covered(box_of(content), grass, leaves));
}

int middle_of(const FlowerKind& kind) { return (kind.first + kind.last) / 2; }

TEST(Flowers, AreClosedAndAsHighAndWideAsTheirKind) {
    for (const FlowerKind& kind : flower_kinds()) {
        const Mesh mesh = flower_mesh(kind);
        expect_valid(mesh);
        const Bounds box = bounds(mesh);
        EXPECT_NEAR(box.max.y, kind.height, 0.3 * kind.width) << kind.name;
        EXPECT_NEAR(box.max.x - box.min.x, kind.width, 0.2 * kind.width) << kind.name;
        EXPECT_EQ(mesh.tints.size(), mesh.positions.size());
    }
}

TEST(Flowers, BloomInTheirTimeAlone) {
    for (const FlowerKind& kind : flower_kinds()) {
        EXPECT_EQ(open_on(kind, kind.first), 0.0) << kind.name;
        EXPECT_EQ(open_on(kind, kind.last), 0.0) << kind.name;
        EXPECT_EQ(open_on(kind, middle_of(kind)), 1.0) << kind.name;
        EXPECT_TRUE(places_on(kind, 340, 1.0, 0.0).empty()) << kind.name;
        EXPECT_TRUE(places_on(kind, 340, 0.0, 1.0).empty()) << kind.name;
    }
}

TEST(Flowers, OfWoodsStandBetweenLeavesAndOfMeadowsInGrass) {
    for (const FlowerKind& kind : flower_kinds()) {
        const int day = middle_of(kind);
        const std::size_t in_grass = places_on(kind, day, 1.0, 0.0).size(),
                          in_leaves = places_on(kind, day, 0.0, 1.0).size();
        EXPECT_EQ(in_grass > 0, !kind.in_woods) << kind.name;
        EXPECT_EQ(in_leaves > 0, kind.in_woods) << kind.name;
        EXPECT_TRUE(places_on(kind, day, 0.0, 0.0).empty()) << kind.name;
    }
}

TEST(Flowers, OfAPartOfAPlotAreThoseOfThePlot) {
    const FlowerKind& kind = flower_kinds().front();
    const std::vector<GlbTransform> all = places_on(kind, middle_of(kind), 0.0, 1.0),
                                    part = places_on(kind, middle_of(kind), 0.0, 1.0, 4.0);
    std::size_t within = 0;
    for (const GlbTransform& place : all)
        if (std::max(std::abs(place.translation.x), std::abs(place.translation.z)) < 1.999)
            ++within;
    EXPECT_GT(part.size(), 20U);
    EXPECT_NEAR(static_cast<double>(part.size()), static_cast<double>(within), 1.0);
}

}  // namespace
}  // namespace sporeprint::grow_flowers_test
