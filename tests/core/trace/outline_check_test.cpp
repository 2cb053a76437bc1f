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

TEST(OutlineProblem, IsNoneForSpeciesOfTheAtlas) {
    for (const AtlasEntry& entry : atlas().entries())
        for (const Stage& stage : entry.species.stages) {
            const auto* shape = std::get_if<Swept>(&stage.model.shape);
            if (!shape) continue;
            EXPECT_FALSE(trace::outline_problem({shape->silhouette, {}}))
                << entry.species.id.view() << stage.age;
        }
}

TEST(OutlineProblem, NamesTheControlPointOfACrossing) {
    trace::OutlineSpec spec = outline();
    std::swap(spec.silhouette.cap[1], spec.silhouette.cap[spec.silhouette.cap.size() - 2]);
    const auto problem = trace::outline_problem(spec);
    ASSERT_TRUE(problem);
    EXPECT_EQ(problem->curve, "cap");
    EXPECT_LT(problem->index, spec.silhouette.cap.size());
    EXPECT_NE(problem->detail.find("crosses itself"), std::string::npos);
}

TEST(OutlineProblem, NamesAStemThatReachesTheAxis) {
    trace::OutlineSpec spec = outline();
    spec.silhouette.stem[2].r = 0.0;
    const auto problem = trace::outline_problem(spec);
    ASSERT_TRUE(problem);
    EXPECT_EQ(problem->curve, "stem");
    EXPECT_NE(problem->detail.find("axis"), std::string::npos);
}

TEST(OutlineProblem, NamesAnAxisOnWhichAStemFolds) {
    trace::OutlineSpec spec = outline();
    spec.axis = {{0.0, 0.0, 0.0}, {0.1, 0.3, 0.0}, {0.0, 0.32, 0.0}, {-0.2, 0.2, 0.0}};
    const auto problem = trace::outline_problem(spec);
    ASSERT_TRUE(problem);
    EXPECT_EQ(problem->curve, "axis");
    spec.axis = {{0.0, 0.0, 0.0}, {0.02, 0.5, 0.0}, {0.05, 1.0, 0.0}};
    EXPECT_FALSE(trace::outline_problem(spec));
}

}  // namespace
}  // namespace sporeprint::trace_outline_check_test
