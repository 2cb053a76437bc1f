#include "core/plant/crown_shade.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "core/plant/tree_spec.h"
#include "tests/support/atlas.h"

namespace sporeprint::plant_crown_shade_test {
namespace {

Tree grown(const char* preset, std::uint32_t seed = 1) {
    return grown_tree(atlas().find_tree(preset)->shape, seed);
}

TEST(CrownShadeOfATree, IsAFactorThatIsLessInside) {
    for (const TreePreset& preset : atlas().trees()) {
        SCOPED_TRACE(preset.id.string());
        const Tree tree = grown(preset.id.string().c_str());
        const CrownShade crown(tree);
        double twigs = 0.0, least = 1.0, top = 0.0;
        glm::dvec3 middle(0.0), highest(0.0);
        for (std::uint32_t i = 0; i < tree.ramification.nodes.size(); ++i) {
            if (!tree.ramification.leaf(i)) continue;
            const glm::dvec3 place = tree.skeleton.nodes[i + 1].place;
            const double factor = crown.at(place);
            EXPECT_GT(factor, 0.2);
            EXPECT_LE(factor, 1.0);
            least = std::min(least, factor);
            middle += place;
            twigs += 1.0;
            if (place.y > top) {
                top = place.y;
                highest = place;
            }
        }
        if (twigs < 100.0) continue;
        EXPECT_LT(least, 0.9);
        EXPECT_LT(crown.at(middle / twigs), crown.at(highest));
    }
}

TEST(CrownShadeOfATree, ChangesEvenlyAndNotBeyondTheCrown) {
    const CrownShade crown(grown("broadleaf"));
    double before = crown.at({0.0, 0.0, 0.0});
    for (int i = 1; i <= 2000; ++i) {
        const double y = 0.005 * i, now = crown.at({0.1, y, 0.05});
        EXPECT_NEAR(now, before, i == 1 ? 0.1 : 0.02) << y;
        before = now;
    }
    EXPECT_EQ(crown.at({100.0, 100.0, 100.0}), crown.at({200.0, 200.0, 200.0}));
}

}  // namespace
}  // namespace sporeprint::plant_crown_shade_test
