#include "core/grow/world/ferns.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/math/elementary.h"
#include "core/world/tree_growth.h"
#include "tests/support/atlas.h"
#include "tests/support/meshes.h"
#include "tests/support/plots.h"

namespace sporeprint::grow_ferns_test {
namespace {

/// A plot of one cover in the middle of the small wood.
struct Glade {
    PlotContent content;
    FloorHeights floor;
    PlotFrame frame;
    CoverField cover;

    explicit Glade(double moss, double grass = 0.0, int day = 200, double size = 12.0)
        : content(small_wood().content(0.0, 0.0, size)),
          floor(small_wood().ground, content.seed, content.micro, {}),
          frame(content, floor),
          cover(cover_field(box_of(content), 1.0, [moss, grass](double, double) {
              Cover here;
              here.moss = moss;
              here.grass = grass;
              here.soil = 1.0 - moss - grass;
              return here;
          })) {
        content.time = time_of(SmallWood::year, day);
    }

    [[nodiscard]] std::vector<GlbTransform> places(double rim = 0.0) const {
        std::vector<GlbTransform> all;
        for (const auto& of_one : fern_places(content, frame, cover, rim))
            all.insert(all.end(), of_one.begin(), of_one.end());
        return all;
    }
};

LeafShape frond() { return shape_of(params_of(*atlas().find_leaf("fern"))); }

TEST(Ferns, AreOutFromMayToOctoberAndTurnInAutumn) {
    for (const int day : {1, 100, 112, 322, 365}) EXPECT_EQ(ferns_on(day).unrolled, 0.0) << day;
    EXPECT_EQ(ferns_on(200).unrolled, 1.0);
    EXPECT_EQ(ferns_on(200).autumn, 0.0);
    double last = 0.0;
    for (int day = 112; day <= 160; ++day) {
        EXPECT_GE(ferns_on(day).unrolled, last);
        last = ferns_on(day).unrolled;
    }
    EXPECT_GE(ferns_on(295).autumn, 0.5);
    for (int day = 1; day <= 365; ++day) {
        const double eighths = 8.0 * ferns_on(day).autumn;
        EXPECT_EQ(eighths, std::floor(eighths)) << day;
    }
}

TEST(Ferns, AreRosettesOfClosedFrondsThatRiseFromTheGround) {
    for (std::uint32_t individual = 0; individual < fern_shapes; ++individual)
        for (const int lod : {least_fern_lod, 3}) {
            const Mesh mesh = fern_mesh(frond(), individual, lod);
            expect_valid(mesh);
            EXPECT_EQ(mesh.tints.size(), mesh.positions.size());
            EXPECT_EQ(mesh.texture_coordinates.size(), mesh.positions.size());
            const Bounds box = bounds(mesh);
            const auto length = static_cast<float>(frond().length);
            EXPECT_GT(box.min.y, -0.1F * length);
            EXPECT_GT(box.max.y, 0.4F * length);
            EXPECT_LT(box.max.y, 1.5F * length);
            // Fronds lean to all sides.
            EXPECT_GT(box.max.x, 0.3F * length);
            EXPECT_LT(box.min.x, -0.3F * length);
            EXPECT_GT(box.max.z, 0.3F * length);
            EXPECT_LT(box.min.z, -0.3F * length);
        }
    EXPECT_NE(fern_mesh(frond(), 0, 3).positions, fern_mesh(frond(), 1, 3).positions);
}

TEST(Ferns, StandWhereItIsDampAndNotInGrassSnowOrWinter) {
    EXPECT_GT(Glade(1.0, 0.0, 200, 32.0).places().size(), 20U);
    EXPECT_TRUE(Glade(0.0, 0.0, 200, 32.0).places().empty());
    EXPECT_TRUE(Glade(0.0, 1.0, 200, 32.0).places().empty());
    EXPECT_TRUE(Glade(1.0, 0.0, 60, 32.0).places().empty());
    Glade snowy(1.0, 0.0, 200, 32.0);
    snowy.content.snow = 1.0;
    EXPECT_TRUE(snowy.places().empty());
    EXPECT_TRUE(ferns_of(snowy.content, snowy.frame, snowy.cover, 3, atlas()).empty());
}

TEST(Ferns, LeaveFeetOfTreesAndLogsFree) {
    const Glade glade(1.0, 0.0, 200, 32.0);
    const DeadWood& log = glade.content.dead_wood.front();
    const SineCosine turn = sine_cosine(log.direction);
    for (const GlbTransform& place : glade.places()) {
        const double x = place.translation.x + metres(glade.content.centre.x),
                     y = metres(glade.content.centre.y) - place.translation.z;
        for (const StandTree& tree : glade.content.trees)
            EXPECT_GT(std::hypot(x - metres(tree.at.x), y - metres(tree.at.y)),
                      0.5 * trunk_diameter(height_at(tree, glade.content.time)));
        const double east = x - metres(log.at.x), north = y - metres(log.at.y);
        const double along = std::clamp(east * turn.cosine + north * turn.sine, 0.0,
                                        length_at(log, glade.content.time));
        EXPECT_GT(std::hypot(east - along * turn.cosine, north - along * turn.sine),
                  radius_at(log, glade.content.time));
    }
}

TEST(Ferns, OfAPartOfAPlotAreThoseOfThePlot) {
    const std::vector<GlbTransform> all = Glade(1.0, 0.0, 200, 24.0).places(),
                                    part = Glade(1.0, 0.0, 200, 8.0).places();
    const auto within = std::count_if(all.begin(), all.end(), [](const GlbTransform& place) {
        return std::abs(place.translation.x) < 4.0 && std::abs(place.translation.z) < 4.0;
    });
    EXPECT_GT(all.size(), part.size());
    EXPECT_EQ(static_cast<std::ptrdiff_t>(part.size()), within);
    const std::vector<GlbTransform> inside = Glade(1.0, 0.0, 200, 24.0).places(rim_of_ferns);
    EXPECT_LE(inside.size(), all.size());
    for (const GlbTransform& place : inside)
        EXPECT_LE(std::max(std::abs(place.translation.x), std::abs(place.translation.z)),
                  12.0 - rim_of_ferns);
}

TEST(Ferns, OfADayHaveTheImagesOfThatDay) {
    const Glade summer(1.0, 0.0, 200, 32.0), october(1.0, 0.0, 295, 32.0);
    const std::vector<PlotLeaves> green = ferns_of(summer.content, summer.frame, summer.cover, 3,
                                                   atlas()),
                                  turned = ferns_of(october.content, october.frame, october.cover,
                                                    3, atlas());
    ASSERT_FALSE(green.empty());
    ASSERT_FALSE(turned.empty());
    EXPECT_EQ(green.front().preset, "fern");
    EXPECT_EQ(green.front().leaf.autumn, 0.0);
    EXPECT_EQ(turned.front().leaf.autumn, ferns_on(295).autumn);
    // All of them are still there.
    EXPECT_EQ(summer.places().size(), october.places().size());
}

}  // namespace
}  // namespace sporeprint::grow_ferns_test
