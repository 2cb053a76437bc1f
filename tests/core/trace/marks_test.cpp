#include "core/trace/marks.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "tests/support/drawn_mushroom.h"
#include "tests/support/refusals.h"

namespace sporeprint::trace_marks_test {
namespace {

trace::Marks marks_of(const DrawnMushroom& drawn) {
    const trace::Contour contour = trace::contour_of(drawn.mask(), 0.0028 * drawn.pixels);
    const trace::TracedAxis axis =
        trace::axis_of(contour, drawn.gesture().axis, drawn.axis(drawn.stem_top));
    return trace::marks_of(contour, axis, drawn.pixels, trace::Form::capped);
}

TEST(Marks, AreWhereStemFaceAndCapMeet) {
    for (const double bend : {0.0, 25.0})
        for (const double turn : {0.0, 9.0}) {
            DrawnMushroom drawn;
            drawn.bend_deg = bend;
            drawn.lean_deg = -0.5 * bend;
            drawn.cap_turn_deg = turn;
            const trace::Marks marks = marks_of(drawn);
            EXPECT_TRUE(marks.has_corner);
            EXPECT_NEAR(marks.stem_top / drawn.pixels, drawn.stem_top, 0.02);
            const double angle = radians(drawn.lean_deg + bend + turn);
            const glm::dvec2 right(std::cos(angle), std::sin(angle)),
                top = drawn.axis(drawn.stem_top);
            for (std::size_t k = 0; k < 2; ++k) {
                const trace::ContourSide& side = marks.sides[k];
                const double sign = k == 0 ? -1.0 : 1.0;
                const glm::dvec2 margin = top + sign * drawn.pixels * drawn.cap_radius * right,
                                 junction = top + sign * drawn.pixels * drawn.stem_radius * right;
                EXPECT_LT(glm::length(side.points[side.margin] - margin) / drawn.pixels, 0.02);
                EXPECT_LT(glm::length(side.points[side.junction] - junction) / drawn.pixels, 0.03);
            }
            EXPECT_NEAR(marks.cap_turn_deg, turn, 3.0) << bend;
        }
}

TEST(Marks, AreNotThoseOfARing) {
    DrawnMushroom drawn;
    drawn.ring_width = 0.09;
    EXPECT_NEAR(marks_of(drawn).stem_top / drawn.pixels, drawn.stem_top, 0.02);
}

TEST(Marks, OfOtherFormsAreWhereTheirStemsEnd) {
    for (const trace::Form form :
         {trace::Form::funnel, trace::Form::morel, trace::Form::puffball, trace::Form::cup})
        for (const double lean : {0.0, 8.0}) {
            DrawnForm drawn = drawn_form(form);
            drawn.lean_deg = lean;
            if (form == trace::Form::cup) drawn.pixels = 450.0;
            const trace::Contour contour = trace::contour_of(drawn.mask(), 0.0028 * drawn.pixels);
            const trace::TracedAxis axis = trace::straight_axis(contour, drawn.gesture().axis);
            const trace::Marks marks = trace::marks_of(contour, axis, drawn.pixels, form);
            EXPECT_EQ(marks.form, form);
            EXPECT_NEAR(marks.stem_top / drawn.pixels, drawn.stem_top, 0.06)
                << trace::name(form) << lean;
            EXPECT_EQ(marks.has_corner, form == trace::Form::morel);
            if (!trace::is_hollow(form)) continue;
            for (std::size_t k = 0; k < 2; ++k) {
                const trace::ContourSide& side = marks.sides[k];
                const glm::dvec2 rim = drawn.half.back() * glm::dvec2(k == 0 ? -1.0 : 1.0, 1.0);
                EXPECT_LT(glm::length(side.points[side.margin] - drawn.at(rim)),
                          0.03 * drawn.pixels)
                    << trace::name(form) << lean;
            }
        }
}

TEST(LikelyForm, OfADrawnFormIsItself) {
    for (const trace::Form form :
         {trace::Form::funnel, trace::Form::club, trace::Form::puffball, trace::Form::cup})
        for (const double lean : {-6.0, 0.0}) {
            DrawnForm drawn = drawn_form(form);
            drawn.lean_deg = lean;
            if (form == trace::Form::cup) drawn.pixels = 450.0;
            const trace::Contour contour = trace::contour_of(drawn.mask(), 0.0028 * drawn.pixels);
            EXPECT_EQ(
                trace::likely_form(contour, trace::straight_axis(contour, drawn.gesture().axis),
                                   drawn.pixels),
                form)
                << trace::name(form) << lean;
        }
    const DrawnMushroom capped;
    const trace::Contour contour = trace::contour_of(capped.mask(), 0.0028 * capped.pixels);
    EXPECT_EQ(trace::likely_form(contour, trace::straight_axis(contour, capped.gesture().axis),
                                 capped.pixels),
              trace::Form::capped);
}

TEST(Marks, OfAFormWithoutACapAreRefused) {
    DrawnMushroom drawn;
    drawn.cap_radius = drawn.stem_radius;
    EXPECT_TRUE(
        names(refusal([&] { static_cast<void>(marks_of(drawn)); }), "/form", "no cap found"));
    drawn = {};
    drawn.stem_top = 0.001;
    EXPECT_TRUE(
        names(refusal([&] { static_cast<void>(marks_of(drawn)); }), "/form", "no stem found"));
}

}  // namespace
}  // namespace sporeprint::trace_marks_test
