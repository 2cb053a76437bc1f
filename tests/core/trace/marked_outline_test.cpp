#include "core/trace/marked_outline.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <utility>
#include <vector>

#include "core/trace/trace.h"
#include "tests/support/drawn_mushroom.h"
#include "tests/support/refusals.h"

namespace sporeprint::trace_marked_outline_test {
namespace {

DrawnMushroom leaning() {
    DrawnMushroom drawn;
    drawn.bend_deg = 14.0;
    drawn.cap_turn_deg = 6.0;
    return drawn;
}

trace::MarkedOutline outline() {
    static const trace::MarkedOutline made =
        trace::outline_on(leaning().mask(), leaning().gesture(), trace::Form::capped).outline;
    return made;
}

std::vector<Problem> problems_of(const trace::MarkedOutline& given,
                                 trace::Form form = trace::Form::capped) {
    return refusal([&] { trace::require_measurable(given, form); });
}

TEST(MarkedOutline, HasFewPointsWithItsMarksAmongThem) {
    const trace::MarkedOutline found = outline();
    const std::vector<glm::dvec2>* sides[] = {&found.left, &found.right};
    for (std::size_t k = 0; k < 2; ++k) {
        EXPECT_LE(sides[k]->size(), trace::MarkedOutline::most_points);
        EXPECT_GT(sides[k]->size(), 200U);
        for (const glm::dvec2& mark : {found.junctions[k], found.margins[k]})
            EXPECT_NE(std::find(sides[k]->begin(), sides[k]->end(), mark), sides[k]->end());
    }
    EXPECT_EQ(found.left.front(), found.right.front());
    EXPECT_EQ(found.left.back(), found.right.back());
    EXPECT_NEAR(*found.cap_turn_deg, 6.0, 3.0);
    EXPECT_TRUE(problems_of(found).empty());
}

TEST(MarkedOutline, IsTheSameAfterTheWayToAnotherCopyAndBack) {
    const trace::MarkedOutline found = outline();
    for (const double factor : {0.5, 0.731, 0.9997, 1.0}) {
        // In a response the places of the photograph are rounded to hundredths of its own pixels.
        const trace::MarkedOutline reported = trace::rounded(trace::scaled(found, 1.0 / factor));
        EXPECT_EQ(trace::rounded(trace::scaled(reported, factor)), found) << factor;
    }
}

TEST(MarkedOutline, IsMeasuredFromItsMarks) {
    const trace::MeasuredOutline found = trace::measured(outline(), trace::Form::capped);
    EXPECT_TRUE(found.marks.has_corner);
    EXPECT_NEAR(found.height, 1.0 * leaning().pixels, 0.03 * leaning().pixels);
    EXPECT_NEAR(found.marks.stem_top, 0.7 * leaning().pixels, 0.03 * leaning().pixels);
    EXPECT_NEAR(trace::area_of(found.contour), static_cast<double>(leaning().mask().area()),
                0.01 * found.height * found.height);
    for (std::size_t k = 0; k < 2; ++k) {
        const trace::ContourSide& side = found.marks.sides[k];
        EXPECT_EQ(side.points[side.junction], outline().junctions[k]);
        EXPECT_EQ(side.points[side.margin], outline().margins[k]);
        EXPECT_LT(side.junction, side.margin);
        EXPECT_EQ(side.local.size(), side.points.size());
    }
}

TEST(MarkedOutline, TakesMarksBetweenItsPoints) {
    trace::MarkedOutline moved = outline();
    const glm::dvec2 at = moved.left[40], next = moved.left[41];
    moved.junctions[0] = at + 0.37 * (next - at);
    const trace::MeasuredOutline found = trace::measured(moved, trace::Form::capped);
    const trace::ContourSide& side = found.marks.sides[0];
    EXPECT_LT(glm::length(side.points[side.junction] - moved.junctions[0]), 1e-9);
    EXPECT_EQ(side.points.size(), moved.left.size() + 1);
    EXPECT_EQ(side.points[side.margin], moved.margins[0]);
    // A margin below the junction, as only a mistake can be, counts at the junction.
    std::swap(moved.junctions[0], moved.margins[0]);
    const trace::MeasuredOutline turned = trace::measured(moved, trace::Form::capped);
    EXPECT_EQ(turned.marks.sides[0].margin, turned.marks.sides[0].junction);
}

TEST(MarkedOutline, WithoutATurnOfTheCapHasTheOneThatMakesItsHalvesAlike) {
    trace::MarkedOutline given = outline();
    const double reported = *given.cap_turn_deg;
    given.cap_turn_deg.reset();
    EXPECT_NEAR(trace::measured(given, trace::Form::capped).marks.cap_turn_deg, reported, 3.1);
    given.cap_turn_deg = -11.0;
    EXPECT_EQ(trace::measured(given, trace::Form::capped).marks.cap_turn_deg, -11.0);
}

TEST(MarkedOutline, NamesWhatIsWrongWithItsLines) {
    const auto wrong = [](auto change) {
        trace::MarkedOutline given = outline();
        change(given);
        return problems_of(given);
    };
    using Given = trace::MarkedOutline;
    EXPECT_TRUE(
        names(wrong([](Given& one) { one.left.resize(3); }), "/outline/left", "at least 8"));
    EXPECT_TRUE(
        names(wrong([](Given& one) { one.axis.resize(1); }), "/outline/axis", "at least 2"));
    EXPECT_TRUE(names(wrong([](Given& one) { one.right.front().x += 40.0; }), "/outline/right",
                      "both begin at the foot"));
    EXPECT_TRUE(names(wrong([](Given& one) { one.right.back().y += 40.0; }), "/outline/right",
                      "both end at the apex"));
    EXPECT_TRUE(names(wrong([](Given& one) { std::reverse(one.axis.begin(), one.axis.end()); }),
                      "/outline/axis", "does not lead from the foot to the apex"));
    EXPECT_TRUE(names(wrong([](Given& one) { one.axis.assign(5, one.axis.front()); }),
                      "/outline/axis", "does not lead"));
    EXPECT_TRUE(names(wrong([](Given& one) { std::swap(one.left, one.right); }), "/outline/left",
                      "exchange them"));
    EXPECT_TRUE(names(wrong([](Given& one) { one = trace::scaled(one, 0.1); }), "/outline",
                      "at least 120"));
    EXPECT_TRUE(names(wrong([](Given& one) {
                          one.left.assign(20, one.left.front());
                          one.left[10] += glm::dvec2(0.0, 300.0);
                          one.right = one.left;
                      }),
                      "/outline/left", "ends where it begins"));
}

TEST(MarkedOutline, NamesWhatIsWrongWithItsMarks) {
    const auto wrong = [](auto change, trace::Form form = trace::Form::capped) {
        trace::MarkedOutline given = outline();
        change(given);
        return problems_of(given, form);
    };
    using Given = trace::MarkedOutline;
    EXPECT_TRUE(
        names(wrong([](Given& one) { one.margins[1] = one.right.back() - glm::dvec2(0, 60); }),
              "/marks/margins/1", "above the apex"));
    EXPECT_TRUE(names(wrong([](Given& one) { one.margins[0] = one.left.back(); }),
                      "/marks/margins/0", "at the apex"));
    EXPECT_TRUE(names(wrong([](Given& one) { one.junctions[0].x -= 90.0; }), "/marks/junctions/0",
                      "pixels away from the left side"));
    EXPECT_TRUE(names(wrong([](Given& one) { one.junctions[1] = one.right[1]; }),
                      "/marks/junctions/1", "there is no stem"));
    const auto exchange = [](Given& one) { std::swap(one.margins[0], one.junctions[0]); };
    EXPECT_TRUE(names(wrong(exchange), "/marks/margins/0", "is not beyond the junction"));
    // A morel has no margin.
    EXPECT_TRUE(wrong(exchange, trace::Form::morel).empty());
}

}  // namespace
}  // namespace sporeprint::trace_marked_outline_test
