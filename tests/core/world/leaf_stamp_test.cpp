#include "core/world/leaf_stamp.h"

#include <gtest/gtest.h>

#include "core/problems.h"
#include "tests/support/atlas.h"

namespace sporeprint::world_leaf_stamp_test {
namespace {

LeafLitter litter(const char* id) {
    const LeafPreset* const preset = atlas().find_leaf(id);
    return {preset->shape, preset->palette};
}

TEST(LeafStamp, HasTheAreaOfItsLeaf) {
    for (const char* id : {"oak", "birch", "maple"}) {
        const LeafLitter kind = litter(id);
        const LeafStamp stamp = leaf_stamp(kind, 96);
        double texels = 0.0;
        for (const LeafStamp::Texel& texel : stamp.texels)
            texels += static_cast<double>(texel.cover);
        const double texel = stamp.length / stamp.columns;
        EXPECT_NEAR(texels * texel * texel / lamina_area(kind.shape), 1.0, 0.03) << id;
    }
}

TEST(LeafStamp, HasColoursWhereItIsALeaf) {
    const LeafStamp stamp = leaf_stamp(litter("oak"), 32);
    for (const LeafStamp::Texel& texel : stamp.texels) {
        EXPECT_GE(texel.cover, 0.0F);
        EXPECT_LE(texel.cover, 1.0F);
        if (texel.cover == 0.0F) continue;
        EXPECT_GT(texel.upper.r, texel.upper.b) << "fallen leaves are brown";
        EXPECT_GT(texel.lower.g, 0.0F);
    }
    EXPECT_EQ(stamp.texels.size(), static_cast<std::size_t>(stamp.columns * stamp.rows));
}

TEST(LeafStamp, IsFoundAtItsCorners) {
    const LeafStamp stamp = leaf_stamp(litter("birch"), 16);
    EXPECT_EQ(&stamp.at(-0.5F, -stamp.half), &stamp.texels.front());
    EXPECT_EQ(&stamp.at(0.5F, stamp.half), &stamp.texels.back());
}

TEST(LeafStamp, TellsNeedlesFromLeaves) {
    for (const char* id : {"oak", "birch", "maple", "ivy"})
        EXPECT_FALSE(has_needles(litter(id))) << id;
    for (const char* id : {"needle", "shoot"}) EXPECT_TRUE(has_needles(litter(id))) << id;
}

TEST(LeafStamp, RefusesOtherSizes) {
    EXPECT_THROW(static_cast<void>(leaf_stamp(litter("oak"), 7)), InvalidInput);
    EXPECT_THROW(static_cast<void>(leaf_stamp(litter("oak"), 129)), InvalidInput);
}

}  // namespace
}  // namespace sporeprint::world_leaf_stamp_test
