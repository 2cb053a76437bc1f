#include "core/trace/photo_colours.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "core/trace/lab.h"
#include "tests/support/atlas.h"
#include "tests/support/drawn_mushroom.h"

namespace sporeprint::trace_photo_colours_test {
namespace {

/// A drawn mushroom whose cap is one colour above half its height and another one below; a grey stem that is
/// darker in its lower half; a green background.
struct Painted {
    DrawnMushroom drawn;
    Picture picture;
    trace::Mask mask;
    trace::Traced traced;

    explicit Painted(double lean_deg = 0.0) {
        drawn.lean_deg = lean_deg;
        mask = drawn.mask();
        traced = trace::traced(mask, drawn.gesture(), {.height_m = 0.1});
        picture = {drawn.side, drawn.side, {}};
        picture.rgb.reserve(3 * mask.inside.size());
        const glm::dvec2 up = drawn.up(0.0), foot = drawn.foot();
        for (int y = 0; y < drawn.side; ++y)
            for (int x = 0; x < drawn.side; ++x) {
                const double height = glm::dot(glm::dvec2(x, y) - foot, up) / drawn.pixels;
                const glm::ivec3 rgb = !mask.at(x, y)  ? glm::ivec3(20, 120, 20)
                                       : height > 0.85 ? glm::ivec3(200, 40, 30)
                                       : height > 0.7  ? glm::ivec3(240, 200, 60)
                                       : height > 0.35 ? glm::ivec3(200, 200, 200)
                                                       : glm::ivec3(120, 120, 120);
                for (int c = 0; c < 3; ++c)
                    picture.rgb.push_back(static_cast<std::uint8_t>(rgb[c]));
            }
    }
};

double apart(const glm::dvec3& lab, const glm::dvec3& rgb) {
    return glm::length(lab - trace::lab_of(rgb));
}

TEST(PartColours, AreThoseOfTheirPlaces) {
    for (const double lean : {0.0, 14.0}) {
        const Painted painted(lean);
        const trace::PartColours found =
            trace::part_colours(painted.picture, painted.mask, painted.traced);
        ASSERT_TRUE(found.cap && found.stem) << lean;
        // Half the height of half an ellipse of 0.35 by 0.3 is seen at 0.6 of its arc from the apex.
        EXPECT_LT(apart((*found.cap)[0], {200.0, 40.0, 30.0}), 1.0) << lean;
        EXPECT_LT(apart((*found.cap)[1], {200.0, 40.0, 30.0}), 1.0) << lean;
        EXPECT_LT(apart((*found.cap)[3], {240.0, 200.0, 60.0}), 1.0) << lean;
        EXPECT_LT(apart((*found.stem)[0], {200.0, 200.0, 200.0}), 1.0) << lean;
        EXPECT_LT(apart((*found.stem)[1], {120.0, 120.0, 120.0}), 1.0) << lean;
    }
}

TEST(PartColours, OfShadeDoNotCount) {
    Painted painted;
    // The left third of the picture is in the shade.
    for (int y = 0; y < painted.drawn.side; ++y)
        for (int x = 0; x < painted.drawn.side * 2 / 5; ++x)
            for (std::size_t c = 0; c < 3; ++c)
                painted.picture.rgb[3 * painted.mask.index(x, y) + c] /= 3;
    const trace::PartColours found =
        trace::part_colours(painted.picture, painted.mask, painted.traced);
    ASSERT_TRUE(found.cap);
    EXPECT_LT(apart((*found.cap)[0], {200.0, 40.0, 30.0}), 1.0);
    EXPECT_LT(apart((*found.cap)[3], {240.0, 200.0, 60.0}), 1.0);
}

TEST(PartColours, OfSpotsDoNotCount) {
    Painted painted;
    // White spots cover a quarter of the picture.
    for (int y = 0; y < painted.drawn.side; ++y)
        for (int x = 0; x < painted.drawn.side; ++x)
            if (x % 30 < 15 && y % 30 < 15)
                for (std::size_t c = 0; c < 3; ++c)
                    painted.picture.rgb[3 * painted.mask.index(x, y) + c] = 250;
    const trace::PartColours found =
        trace::part_colours(painted.picture, painted.mask, painted.traced);
    ASSERT_TRUE(found.cap);
    EXPECT_LT(apart((*found.cap)[0], {200.0, 40.0, 30.0}), 1.0);
    EXPECT_LT(apart((*found.cap)[3], {240.0, 200.0, 60.0}), 1.0);
}

TEST(GiveColours, PaintsThePhotographedStageAndMovesTheOthers) {
    const Painted painted;
    const trace::PartColours colours =
        trace::part_colours(painted.picture, painted.mask, painted.traced);
    const Species& own = atlas().find("boletus_edulis")->species;
    Species species = own;
    trace::give_colours(species, 2, colours);
    const std::vector<Colour>& ramp = species.stages[2].model.surface.cap.ramp;
    // Stages blend colour by colour, so each has as many as before.
    ASSERT_EQ(ramp.size(), own.stages[2].model.surface.cap.ramp.size());
    EXPECT_EQ(ramp.front(), (Colour{200, 40, 30}));
    EXPECT_EQ(ramp.back(), (Colour{240, 200, 60}));
    EXPECT_EQ(species.stages[2].model.surface.stem.top, (Colour{200, 200, 200}));
    for (std::size_t i = 0; i < species.stages.size(); ++i) {
        if (i == 2) continue;
        const Surface &made = species.stages[i].model.surface, &old = own.stages[i].model.surface;
        EXPECT_EQ(made.cap.ramp.size(), old.cap.ramp.size());
        EXPECT_NE(made.cap.ramp, old.cap.ramp);
        EXPECT_EQ(made.hymenium, old.hymenium);
    }
}

TEST(GiveColours, OfAFunnelAreThoseOfItsOuterFace) {
    const Species& own = atlas().find("craterellus_cornucopioides")->species;
    Species species = own;
    trace::PartColours colours;
    colours.face = trace::lab_of({220.0, 180.0, 60.0});
    trace::give_colours(species, 2, colours);
    const Surface &made = species.stages[2].model.surface, &old = own.stages[2].model.surface;
    EXPECT_EQ(made.hymenium.colour, (Colour{220, 180, 60}));
    EXPECT_NE(made.cap.ramp, old.cap.ramp);
    EXPECT_EQ(made.stem, old.stem);
}

TEST(PartColours, OfAnOuterFaceAreThereForHollowFormsAlone) {
    Painted painted;
    EXPECT_FALSE(trace::part_colours(painted.picture, painted.mask, painted.traced).face);
    painted.traced.form = trace::Form::funnel;
    const trace::PartColours found =
        trace::part_colours(painted.picture, painted.mask, painted.traced);
    EXPECT_FALSE(found.cap);
    ASSERT_TRUE(found.face);
    EXPECT_LT(apart(*found.face, {240.0, 200.0, 60.0}), 1.0);
}

TEST(GiveColours, OfItselfChangesNothing) {
    const Species& own = atlas().find("amanita_muscaria")->species;
    const Surface& surface = own.stages[3].model.surface;
    trace::PartColours colours;
    const auto lab = [](Colour colour) {
        return trace::lab_of(glm::dvec3(colour.r, colour.g, colour.b));
    };
    colours.stem = {lab(surface.stem.top), lab(surface.stem.base)};
    Species species = own;
    trace::give_colours(species, 3, colours);
    EXPECT_EQ(species, own);
}

}  // namespace
}  // namespace sporeprint::trace_photo_colours_test
