#include "core/trace/outline_check.h"

#include <gtest/gtest.h>

#include <utility>

#include "tests/support/atlas.h"

namespace sporeprint::trace_outline_check_test {
namespace {

trace::OutlineSpec outline() {
    const auto& shape =
        std::get<Swept>(atlas().find("boletus_edulis")->species.stages[2].model.shape);
    return {shape.silhouette, shape.axis};
}

TEST(FaultOf, IsNoneForSpeciesOfTheAtlas) {
    for (const AtlasEntry& entry : atlas().entries())
        for (const Stage& stage : entry.species.stages) {
            const auto* shape = std::get_if<Swept>(&stage.model.shape);
            if (!shape) continue;
            EXPECT_FALSE(trace::fault_of({shape->silhouette, {}}))
                << entry.species.id.view() << stage.age;
        }
}

TEST(FaultOf, NamesTheControlPointOfACrossing) {
    trace::OutlineSpec spec = outline();
    std::swap(spec.silhouette.cap[1], spec.silhouette.cap[spec.silhouette.cap.size() - 2]);
    const auto fault = trace::fault_of(spec);
    ASSERT_TRUE(fault);
    EXPECT_EQ(fault->curve, "cap");
    EXPECT_LT(fault->index, spec.silhouette.cap.size());
    EXPECT_NE(fault->detail.find("crosses itself"), std::string::npos);
}

TEST(FaultOf, NamesAStemThatReachesTheAxis) {
    trace::OutlineSpec spec = outline();
    spec.silhouette.stem[2].r = 0.0;
    const auto fault = trace::fault_of(spec);
    ASSERT_TRUE(fault);
    EXPECT_EQ(fault->curve, "stem");
    EXPECT_NE(fault->detail.find("axis"), std::string::npos);
}

TEST(FaultOf, NamesAnAxisOnWhichAStemFolds) {
    trace::OutlineSpec spec = outline();
    spec.axis = {{0.0, 0.0, 0.0}, {0.1, 0.3, 0.0}, {0.0, 0.32, 0.0}, {-0.2, 0.2, 0.0}};
    const auto fault = trace::fault_of(spec);
    ASSERT_TRUE(fault);
    EXPECT_EQ(fault->curve, "axis");
    spec.axis = {{0.0, 0.0, 0.0}, {0.02, 0.5, 0.0}, {0.05, 1.0, 0.0}};
    EXPECT_FALSE(trace::fault_of(spec));
}

}  // namespace
}  // namespace sporeprint::trace_outline_check_test
