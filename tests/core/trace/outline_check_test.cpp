#include "core/trace/outline_check.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <utility>
#include <variant>

#include "core/grow/mushroom.h"
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
    // One that comes back the way it went has no curvature but at its end.
    spec.axis = {{0.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 0.0}};
    ASSERT_TRUE(trace::outline_problem(spec));
    EXPECT_EQ(trace::outline_problem(spec)->curve, "axis");
    spec.axis = {{0.0, 0.0, 0.0}, {0.02, 0.5, 0.0}, {0.05, 1.0, 0.0}};
    EXPECT_FALSE(trace::outline_problem(spec));
}

RC_GTEST_PROP(OutlineProblem, IsThatOfTheGeneratorWhereTheAxisFolds, ()) {
    trace::OutlineSpec spec = outline();
    spec.axis = {{0.0, 0.0, 0.0}};
    const int points = *rc::gen::inRange(1, 6);
    const auto coordinate = [] { return 0.1 * *rc::gen::inRange(-20, 21); };
    for (int i = 0; i < points; ++i) spec.axis.push_back({coordinate(), coordinate(), 0.0});
    const bool is_simple = !trace::outline_problem(spec);
    MushroomSpec mushroom;
    mushroom.model = atlas().find("boletus_edulis")->species.stages[2].model;
    auto& shape = std::get<Swept>(mushroom.model->shape);
    shape.axis = spec.axis;
    mushroom.model->deformation = {};
    mushroom.params.variation = 0.0;
    mushroom.params.lod = 3;
    mushroom.params.textures = Textures::none;
    // What is called simple grows. The generator allows a little more.
    if (is_simple) static_cast<void>(mushroom_mesh(mushroom, resolve(mushroom, atlas())));
}

}  // namespace
}  // namespace sporeprint::trace_outline_check_test
