#include "core/trace/face_view.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <optional>

#include "core/math/elementary.h"
#include "core/trace/contour.h"
#include "core/trace/lab.h"
#include "core/trace/trace.h"
#include "tests/support/drawn_mushroom.h"

namespace sporeprint::trace_face_view_test {
namespace {

using trace::Face;
using trace::FaceShown;
using trace::FaceView;

const Outline& outline() {
    static const Outline made = [] {
        const DrawnMushroom drawn;
        const trace::Traced traced =
            trace::traced(drawn.mask(), drawn.gesture(), {.height_m = 0.1});
        return Outline::unproven(traced.shape.silhouette);
    }();
    return made;
}

constexpr int side = 400;
const glm::dvec2 middle(210.0, 190.0), half(150.0, 120.0);
const glm::dvec3 skin(180.0, 110.0, 70.0), background(40.0, 90.0, 160.0);

/// Returns a photograph of a cap whose margin is an ellipse.
///
/// colour  of a place, whose coordinates are -1..1 between the ends of the ellipse
template <class At>
FaceView seen(At colour) {
    FaceView view{{side, side, {}}, trace::Mask(side, side), {}, {}};
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x) {
            const glm::dvec2 at = (glm::dvec2(x + 0.5, y + 0.5) - middle) / half;
            const std::optional<glm::dvec3> found = colour(at);
            view.mask.inside[view.mask.index(x, y)] = found ? 1 : 0;
            const glm::dvec3 rgb = found.value_or(background);
            for (int c = 0; c < 3; ++c)
                view.picture.rgb.push_back(static_cast<std::uint8_t>(rgb[c]));
        }
    return view;
}

std::optional<glm::dvec3> plain(const glm::dvec2& at) {
    return glm::length(at) < 1.0 ? std::optional(skin) : std::nullopt;
}

/// Returns a cap with a dark spot of the same hue.
FaceView spotted(const glm::dvec2& spot) {
    return seen([&](const glm::dvec2& at) -> std::optional<glm::dvec3> {
        if (glm::length(at - spot) < 0.12) return 0.3 * skin;
        return plain(at);
    });
}

/// Returns the brightness of the image at a direction and a share of the radius, 0..255.
double tone(const Picture& image, double angle, double radius) {
    const auto x = static_cast<std::size_t>((0.5 + 0.499 * radius * std::cos(angle)) * image.width),
               y = static_cast<std::size_t>((0.5 + 0.499 * radius * std::sin(angle)) *
                                            image.height);
    return image.rgb[3 * (y * static_cast<std::size_t>(image.width) + x)];
}

/// Returns the middle of the dark texels as coordinates -1..1.
glm::dvec2 dark_middle(const Picture& image) {
    glm::dvec2 sum(0.0);
    double count = 0.0;
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x) {
            const glm::dvec2 at(2.0 * (x + 0.5) / image.width - 1.0,
                                2.0 * (y + 0.5) / image.height - 1.0);
            if (glm::length(at) > 0.95 ||
                image.rgb[3 * static_cast<std::size_t>(y * image.width + x)] > 120)
                continue;
            sum += at;
            count += 1.0;
        }
    return sum / count;
}

TEST(FaceShown, HasASpotWhereThePhotographFromAboveHasIt) {
    for (const double degrees : {40.0, 130.0, 250.0}) {
        const double angle = radians(degrees);
        const FaceShown shown = trace::face_shown(
            spotted(0.6 * glm::dvec2(std::cos(angle), std::sin(angle))), outline(), Face::upper);
        ASSERT_TRUE(shown.image.has_value());
        const glm::dvec2 found = dark_middle(*shown.image);
        const double apart = std::remainder(std::atan2(found.y, found.x) - angle, 2.0 * pi);
        EXPECT_LT(std::abs(apart), radians(4.0)) << degrees;
        // Along the meridian it is as far from the apex as on the cap.
        const double widest = outline().cap.at(0.0).r;
        EXPECT_NEAR(outline().cap.at(1.0 - glm::length(found)).r / widest, 0.6, 0.06) << degrees;
    }
}

TEST(FaceShown, FromBelowIsMirrored) {
    const double angle = radians(40.0);
    const FaceShown shown = trace::face_shown(
        spotted(0.6 * glm::dvec2(std::cos(angle), std::sin(angle))), outline(), Face::lower);
    ASSERT_TRUE(shown.image.has_value());
    const glm::dvec2 found = dark_middle(*shown.image);
    EXPECT_NEAR(std::atan2(found.y, found.x), -angle, radians(5.0));
}

TEST(FaceShown, MovesTheApexToAGivenCentre) {
    const glm::dvec2 spot(0.25, -0.2);
    FaceView view = spotted(spot);
    const FaceShown before = trace::face_shown(view, outline(), Face::upper);
    EXPECT_GT(glm::length(dark_middle(before.image.value())), 0.15);
    view.centre = middle + half * spot;
    const FaceShown shown = trace::face_shown(view, outline(), Face::upper);
    EXPECT_LT(glm::length(dark_middle(shown.image.value())), 0.06);
    // The margin stays where it is.
    for (int i = 0; i < 12; ++i)
        EXPECT_NEAR(tone(*shown.image, radians(30.0 * i), 0.9), skin.x, 12.0) << i;
}

TEST(FaceShown, HasNoShadeOfALightFromOneSide) {
    const FaceView view = seen([](const glm::dvec2& at) -> std::optional<glm::dvec3> {
        if (!plain(at)) return std::nullopt;
        // As bright as the outward normal of half an ellipsoid looks to the right.
        return (0.85 + 0.3 * at.x) * skin;
    });
    const FaceShown shown = trace::face_shown(view, outline(), Face::upper);
    ASSERT_TRUE(shown.image.has_value());
    for (const double radius : {0.3, 0.6}) {
        const double right = tone(*shown.image, 0.0, radius), left = tone(*shown.image, pi, radius);
        EXPECT_LT(std::abs(right - left), 0.35 * std::abs(2.0 * 0.3 * radius * skin.x)) << radius;
    }
}

TEST(FaceShown, HidesWhatHasAnotherHue) {
    const FaceView view = seen([](const glm::dvec2& at) -> std::optional<glm::dvec3> {
        const glm::dvec2 cell(at.x * 5.0 - std::floor(at.x * 5.0),
                              at.y * 5.0 - std::floor(at.y * 5.0));
        if (plain(at) && glm::length(cell - 0.5) < 0.25) return glm::dvec3(245.0, 240.0, 225.0);
        return plain(at);
    });
    const FaceShown shown = trace::face_shown(view, outline(), Face::upper);
    ASSERT_TRUE(shown.image.has_value());
    for (int i = 0; i < 40; ++i)
        for (const double radius : {0.2, 0.5, 0.8})
            EXPECT_NEAR(tone(*shown.image, radians(9.0 * i), radius), skin.x, 15.0) << i << radius;
}

TEST(FaceShown, HasTheColoursOfTheQuartersOfTheMeridian) {
    const FaceView view = seen([](const glm::dvec2& at) -> std::optional<glm::dvec3> {
        if (!plain(at)) return std::nullopt;
        return glm::length(at) > 0.8 ? glm::dvec3(200.0, 130.0, 85.0) : skin;
    });
    const FaceShown shown = trace::face_shown(view, outline(), Face::upper);
    EXPECT_LT(glm::length(shown.quarters.front().value() - trace::lab_of(skin)), 2.0);
    EXPECT_LT(
        glm::length(shown.quarters.back().value() - trace::lab_of(glm::dvec3(200.0, 130.0, 85.0))),
        2.0);
}

/// Returns a lower face with a stem of another brightness before it, which ends in a lump.
FaceView with_stem() {
    return seen([](const glm::dvec2& at) -> std::optional<glm::dvec3> {
        const glm::dvec2 pixel = at * half;
        const double down = 190.0 - 40.0;  // of the end of the stem
        if (trace::distance_from_segment(pixel, {0.0, 0.0}, {0.0, down}) < 22.0) return 0.5 * skin;
        if (glm::length(pixel - glm::dvec2(0.0, down + 45.0)) < 50.0) return 0.4 * skin;
        return plain(at);
    });
}

TEST(FaceShown, WithoutTheEndOfAStemThatIsSeenIsNotRound) {
    const FaceShown shown = trace::face_shown(with_stem(), outline(), Face::lower);
    EXPECT_FALSE(shown.is_round);
    EXPECT_FALSE(shown.image.has_value());
    EXPECT_FALSE(shown.quarters[2].has_value());
}

TEST(FaceShown, HidesTheStemUpToItsEnd) {
    FaceView view = with_stem();
    view.centre = middle;
    view.stem_end = middle + glm::dvec2(0.0, 150.0);
    const FaceShown shown = trace::face_shown(view, outline(), Face::lower);
    EXPECT_TRUE(shown.is_round);
    ASSERT_TRUE(shown.image.has_value());
    for (int i = 0; i < 40; ++i)
        for (const double radius : {0.5, 0.8})
            EXPECT_NEAR(tone(*shown.image, radians(9.0 * i), radius), skin.x, 20.0) << i << radius;
}

TEST(FaceShown, OfAnEmptyMaskShowsNothing) {
    const FaceView view{{8, 8, std::vector<std::uint8_t>(192, 9)}, trace::Mask(8, 8), {}, {}};
    for (const Face face : {Face::upper, Face::lower})
        EXPECT_FALSE(trace::face_shown(view, outline(), face).image.has_value());
}

}  // namespace
}  // namespace sporeprint::trace_face_view_test
