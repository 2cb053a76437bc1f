#include "core/trace/profile.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "tests/support/drawn_mushroom.h"

namespace sporeprint::trace_profile_test {
namespace {

trace::Profile profile_of(const DrawnMushroom& drawn, const trace::Mask& mask) {
    const trace::Contour contour = trace::contour_of(mask, 0.0028 * drawn.pixels);
    const trace::TracedAxis axis =
        trace::axis_of(contour, drawn.gesture().axis, drawn.axis(drawn.stem_top));
    const trace::Marks marks = trace::marks_of(contour, axis, drawn.pixels, trace::Form::capped);
    return trace::profile_of(contour, axis, marks, drawn.pixels, 0.7);
}

/// Returns the mask of a drawn mushroom with a disc at a place.
///
/// radius  of the disc, of the height
trace::Mask with_disc(const DrawnMushroom& drawn, const glm::dvec2& middle, double radius) {
    trace::Mask mask = drawn.mask();
    for (int y = 0; y < mask.height; ++y)
        for (int x = 0; x < mask.width; ++x)
            if (glm::length(glm::dvec2(x + 0.5, y + 0.5) - middle) < radius * drawn.pixels)
                mask.inside[mask.index(x, y)] = 1;
    return mask;
}

TEST(Profile, IsTheOutlineThatWasDrawnHoweverTheStemBends) {
    for (const double bend : {0.0, 20.0}) {
        DrawnMushroom drawn;
        drawn.bend_deg = bend;
        drawn.lean_deg = -0.5 * bend;
        const trace::Profile profile = profile_of(drawn, drawn.mask());
        // A foot that is cut askew may count as round.
        for (const glm::dvec2& at : profile.stem)
            if (at.y > 0.05 * drawn.pixels) {
                EXPECT_NEAR(at.x / drawn.pixels, drawn.stem_radius, 0.012) << at.y / drawn.pixels;
            }
        for (const glm::dvec2& at : profile.cap) {
            const glm::dvec2 unit(at.x / drawn.pixels / drawn.cap_radius,
                                  (at.y / drawn.pixels - drawn.stem_top) / drawn.apex());
            EXPECT_NEAR(glm::length(unit), 1.0, 0.06) << at.x << ' ' << at.y;
        }
        if (bend == 0.0) {
            EXPECT_FALSE(profile.has_foot);
        }
        EXPECT_FALSE(profile.ring.has_value());
        EXPECT_LT(profile.asymmetry, 0.012);
        EXPECT_EQ(profile.face.front(), profile.stem.back());
        EXPECT_EQ(profile.cap.front(), profile.face.back());
        EXPECT_EQ(profile.cap.back().x, 0.0);
    }
}

TEST(Profile, EndsOnTheAxisWhereTheFootIsRound) {
    DrawnMushroom drawn;
    // A bulb.
    const trace::Profile profile = profile_of(drawn, with_disc(drawn, drawn.axis(0.09), 0.1));
    EXPECT_TRUE(profile.has_foot);
    EXPECT_EQ(profile.stem.front(), glm::dvec2(0.0));
    for (const glm::dvec2& at : profile.stem) {
        const double height = at.y / drawn.pixels - 0.1;  // above the middle of the bulb
        if (height > 0.06) continue;
        EXPECT_NEAR(at.x / drawn.pixels, std::sqrt(std::max(0.01 - height * height, 0.0)), 0.015)
            << height;
    }
}

TEST(Profile, ReportsARingAndLeavesItOut) {
    DrawnMushroom drawn;
    drawn.ring_width = 0.06;
    const trace::Profile profile = profile_of(drawn, drawn.mask());
    ASSERT_TRUE(profile.ring.has_value());
    EXPECT_NEAR(profile.ring->height / drawn.pixels, 0.45, 0.02);
    EXPECT_NEAR(profile.ring->width / drawn.pixels, 0.06, 0.012);
    for (const glm::dvec2& at : profile.stem)
        EXPECT_NEAR(at.x / drawn.pixels, drawn.stem_radius, 0.012) << at.y / drawn.pixels;
}

TEST(Profile, KnowsHowUnlikeBothSidesAre) {
    DrawnMushroom drawn;
    const double even = profile_of(drawn, drawn.mask()).asymmetry;
    // A bulge on the right of the cap.
    const glm::dvec2 bulge = drawn.axis(0.8) + glm::dvec2(0.3 * drawn.pixels, 0.0);
    const trace::Profile profile = profile_of(drawn, with_disc(drawn, bulge, 0.1));
    EXPECT_GT(profile.asymmetry, even + 0.002);
}

TEST(Profile, OfAFunnelHasAHollowOfTheStatedDepth) {
    const DrawnForm drawn = drawn_form(trace::Form::funnel);
    const trace::Contour contour = trace::contour_of(drawn.mask(), 0.0028 * drawn.pixels);
    const trace::TracedAxis axis = trace::straight_axis(contour, drawn.gesture().axis);
    const trace::Marks marks = trace::marks_of(contour, axis, drawn.pixels, trace::Form::funnel);
    for (const double hollow : {0.2, 0.5, 0.9}) {
        const trace::Profile profile =
            trace::profile_of(contour, axis, marks, drawn.pixels, hollow);
        ASSERT_LT(profile.seen, profile.cap.size());
        const double edge = profile.cap[profile.seen - 1].y, stem = profile.face.front().y;
        EXPECT_NEAR((edge - profile.cap.back().y) / (edge - stem), hollow, 1e-9);
        EXPECT_EQ(profile.cap.back().x, 0.0);
        // The wall is inside the outer face at every height.
        for (std::size_t i = profile.seen; i < profile.cap.size(); ++i)
            for (std::size_t k = 0; k + 1 < profile.face.size(); ++k)
                if (profile.face[k].y <= profile.cap[i].y &&
                    profile.cap[i].y < profile.face[k + 1].y) {
                    EXPECT_LT(profile.cap[i].x, profile.face[k + 1].x) << hollow;
                }
    }
}

TEST(Profile, OfAHeadHasNoFace) {
    for (const trace::Form form : {trace::Form::club, trace::Form::puffball}) {
        const DrawnForm drawn = drawn_form(form);
        const trace::Contour contour = trace::contour_of(drawn.mask(), 0.0028 * drawn.pixels);
        const trace::TracedAxis axis = trace::straight_axis(contour, drawn.gesture().axis);
        const trace::Profile profile = trace::profile_of(
            contour, axis, trace::marks_of(contour, axis, drawn.pixels, form), drawn.pixels, 0.7);
        EXPECT_TRUE(profile.face.empty());
        EXPECT_EQ(profile.cap.front(), profile.stem.back());
        EXPECT_EQ(profile.seen, profile.cap.size());
    }
}

}  // namespace
}  // namespace sporeprint::trace_profile_test
