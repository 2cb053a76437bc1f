#include "core/trace/trace.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <string>
#include <variant>
#include <vector>

#include "core/grow/mushroom.h"
#include "core/individual/axis_curve.h"
#include "core/math/elementary.h"
#include "core/mesh/measure.h"
#include "core/silhouette/outline.h"
#include "tests/support/atlas.h"
#include "tests/support/contours.h"
#include "tests/support/drawn_mushroom.h"
#include "tests/support/effort.h"
#include "tests/support/meshes.h"
#include "tests/support/photographs.h"
#include "tests/support/refusals.h"

namespace sporeprint::trace_trace_test {
namespace {

TEST(Traced, HasTheLeanAndTheBendOfThePhotograph) {
    for (const double bend : {-40.0, -25.0, 0.0, 15.0, 30.0, 40.0})
        for (const double lean : {-12.0, 0.0, 6.0})
            for (const double radius : {0.04, 0.06, 0.1}) {
                DrawnMushroom drawn;
                drawn.bend_deg = bend;
                drawn.lean_deg = lean - 0.5 * bend;
                drawn.stem_radius = radius;
                drawn.pixels = 650.0;
                const trace::Traced found =
                    trace::traced(drawn.mask(), drawn.gesture(), {0.1, trace::Form::capped});
                EXPECT_TRUE(found.method == trace::TraceMethod::fitted ||
                            found.method == trace::TraceMethod::refined);
                EXPECT_NEAR(found.lean_deg, lean, 2.0) << bend << ' ' << radius;
                EXPECT_NEAR(found.bend_deg, std::abs(bend), 3.0) << lean << ' ' << radius;
            }
}

TEST(Traced, HasACapThatTurnsAgainstItsStem) {
    for (const double turn : {-9.0, -3.0, 4.5, 12.0}) {
        DrawnMushroom drawn;
        drawn.cap_turn_deg = turn;
        const trace::Traced found =
            trace::traced(drawn.mask(), drawn.gesture(), {0.1, trace::Form::capped});
        EXPECT_NEAR(*found.cap_turn_deg, turn, 2.0);
        // The mushroom that grows from it has a cap in that direction.
        const glm::dvec3 top = AxisCurve(found.shape.axis).tangents().back();
        EXPECT_NEAR(arc_tangent(top.x, top.y) * 180.0 / pi, turn, 1.0 + 0.25 * std::abs(turn));
    }
}

TEST(Traced, MarksThePhotographInItsOwnPixels) {
    const DrawnMushroom drawn;
    const trace::Traced found = trace::traced(drawn.mask(), drawn.gesture(), {0.1});
    EXPECT_LT(found.margins[0].x, found.junctions[0].x);
    EXPECT_LT(found.junctions[0].x, found.junctions[1].x);
    EXPECT_LT(found.junctions[1].x, found.margins[1].x);
    EXPECT_NEAR(found.margins[1].x - found.margins[0].x, 0.7 * drawn.pixels, 0.02 * drawn.pixels);
    // Both sides go from the foot to the apex.
    for (const std::vector<glm::dvec2>* side : {&found.left, &found.right}) {
        EXPECT_NEAR(side->front().y, drawn.foot().y, 6.0);
        EXPECT_LT(glm::length(side->back() - drawn.axis(1.0)), 0.02 * drawn.pixels);
    }
}

/// Returns the forms that are not capped.
std::vector<trace::Form> other_forms() {
    return {trace::Form::funnel, trace::Form::morel, trace::Form::club, trace::Form::puffball,
            trace::Form::cup};
}

TEST(Traced, OfItsOwnOutlineIsTheSame) {
    std::vector<trace::FoundOutline> found;
    DrawnMushroom capped;
    capped.bend_deg = 9.0;
    found.push_back(trace::outline_on(capped.mask(), capped.gesture(), trace::Form::automatic));
    for (const trace::Form form : other_forms()) {
        DrawnForm drawn = drawn_form(form);
        if (form == trace::Form::cup) drawn.pixels = 450.0;
        found.push_back(trace::outline_on(drawn.mask(), drawn.gesture(), form));
    }
    for (const trace::FoundOutline& one : found) {
        const trace::Traced first = trace::traced(one, {0.1, one.form, 0.5});
        const trace::Traced again =
            trace::traced(static_cast<const trace::MarkedOutline&>(first), {0.1, one.form, 0.5});
        EXPECT_EQ(again.shape.silhouette, first.shape.silhouette) << trace::name(one.form);
        EXPECT_EQ(again.shape.axis, first.shape.axis) << trace::name(one.form);
        EXPECT_EQ(again.method, first.method);
        EXPECT_EQ(again.error, first.error);
    }
}

TEST(Traced, FollowsAMarkThatIsMoved) {
    const DrawnMushroom drawn;
    trace::MarkedOutline outline =
        trace::outline_on(drawn.mask(), drawn.gesture(), trace::Form::capped).outline;
    const double before =
        trace::traced(outline, {0.1, trace::Form::capped}).shape.silhouette.stem.back().y;
    // Both junctions a twentieth of the height down the stem.
    for (glm::dvec2& junction : outline.junctions) junction.y += 0.05 * drawn.pixels;
    const Silhouette moved = trace::traced(outline, {0.1, trace::Form::capped}).shape.silhouette;
    EXPECT_NEAR(moved.stem.back().y, before - 0.005, 0.0005);
    EXPECT_EQ(moved.junction, Join::smooth);
    outline.junctions[0].x -= 0.2 * drawn.pixels;
    EXPECT_TRUE(names(refusal([&] {
                          static_cast<void>(trace::traced(outline, {0.1, trace::Form::capped}));
                      }),
                      "/marks/junctions/0", "pixels away"));
}

TEST(Traced, BendsAStemLessThatWouldFold) {
    DrawnMushroom drawn;
    drawn.pixels = 500.0;
    drawn.stem_radius = 0.24;
    drawn.bend_deg = 70.0;
    drawn.lean_deg = -35.0;
    drawn.cap_radius = 0.42;
    EXPECT_EQ(trace::traced(drawn.mask(), drawn.gesture(), {0.1, trace::Form::capped}).method,
              trace::TraceMethod::straightened);
}

TEST(Traced, RefusesWhatIsTooSmallOrCutOff) {
    DrawnMushroom drawn;
    drawn.pixels = 80.0;
    const auto problems_of = [&] {
        return refusal(
            [&] { static_cast<void>(trace::traced(drawn.mask(), drawn.gesture(), {0.1})); });
    };
    EXPECT_TRUE(names(problems_of(), "/photo", "at least 120"));
    drawn.pixels = 700.0;
    drawn.lean_deg = 60.0;
    EXPECT_TRUE(names(problems_of(), "/photo", "cut off by the right border"));
}

/// Returns how high a drawn mushroom is on its picture, in its own units.
double height_of(const DrawnForm& drawn) {
    double highest = 0.0, lowest = drawn.side;
    for (const glm::dvec2& point : drawn.half)
        for (const double side : {-1.0, 1.0}) {
            const double y = drawn.at({side * point.x, point.y}).y;
            highest = std::max(highest, y);
            lowest = std::min(lowest, y);
        }
    return (highest - lowest) / drawn.pixels;
}

TEST(Traced, HasTheOutlineOfADrawnForm) {
    for (const trace::Form form : other_forms())
        for (const double lean : {0.0, 7.0}) {
            DrawnForm drawn = drawn_form(form);
            drawn.lean_deg = lean;
            if (form == trace::Form::cup) drawn.pixels = 450.0;
            // The stated height is that of the picture, from the lowest to the highest place.
            const double height_m = height_of(drawn);
            const trace::Traced found =
                trace::traced(drawn.mask(), drawn.gesture(), {height_m, form, 0.5});
            EXPECT_EQ(found.form, form);
            EXPECT_NEAR(found.lean_deg, lean, 3.0) << trace::name(form);
            const Silhouette& made = found.shape.silhouette;
            EXPECT_EQ(made.hymenium.empty(), !trace::has_face(form));
            const Outline outline(made);
            for (const CurveName curve : curve_names) {
                if (outline.of(curve).empty()) continue;
                // From the side the inside of a hollow is not seen.
                if (curve == CurveName::cap && trace::is_hollow(form)) continue;
                for (int k = 0; k <= 40; ++k) {
                    const OutlineSample at = outline.of(curve).at(k / 40.0);
                    if (at.y < 0.05) continue;  // the root
                    double away = 1.0;
                    for (std::size_t i = 0; i + 1 < drawn.half.size(); ++i)
                        away = std::min(away, trace::distance_from_segment(
                                                  {at.r, at.y}, drawn.half[i], drawn.half[i + 1]));
                    EXPECT_LT(away, 0.02) << trace::name(form) << lean << ' ' << name(curve) << k;
                }
            }
        }
}

TEST(Traced, IsOfTheFormThatFitsUnlessOneIsStated) {
    for (const trace::Form form : other_forms()) {
        DrawnForm drawn = drawn_form(form);
        if (form == trace::Form::cup) drawn.pixels = 450.0;
        // A head on a stem may be a closed cap as well.
        EXPECT_EQ(trace::traced(drawn.mask(), drawn.gesture(), {}).form,
                  form == trace::Form::morel ? trace::Form::capped : form);
    }
    const DrawnMushroom capped;
    EXPECT_EQ(trace::traced(capped.mask(), capped.gesture(), {}).form, trace::Form::capped);
}

TEST(Traced, HasMorePointsWhereASplineThroughFewWouldCrossItself) {
    // A hammer on a thread, with a splinter.
    trace::Mask mask(200, 200);
    const auto add = [&](const trace::Stroke& line, double width) {
        const trace::Mask one = trace::drawn({line}, 200, 200, width);
        for (std::size_t i = 0; i < mask.inside.size(); ++i) mask.inside[i] |= one.inside[i];
    };
    add({{100, 50}, {100, 159}}, 4.0);
    add({{67, 43}, {140, 54}}, 33.0);
    add({{85, 43}, {134, 101}}, 6.0);
    trace::Gesture gesture;
    gesture.axis = {{101, 170}, {91, 138}, {108, 105}, {98, 73}, {95, 40}};
    const trace::Traced found =
        trace::traced(trace::without_holes(mask), gesture, {0.1, trace::Form::club});
    EXPECT_NE(found.method, trace::TraceMethod::simplified);
    EXPECT_NO_THROW(static_cast<void>(Outline(found.shape.silhouette)));
}

TEST(Traced, HasAPlainStemWhereTheOutlineWouldCrossItself) {
    // A cup without a stem, traced as a funnel.
    const Photograph photo =
        photograph({"sarcoscypha_austriaca", 0.75, 2, View::front, 384}, Scenery::plain);
    const trace::Gesture gesture{trace::upright_line(photo.truth), {}, {}, {}, {}};
    const trace::Traced found = trace::traced(photo.truth, gesture, {0.03, trace::Form::funnel});
    EXPECT_EQ(found.method, trace::TraceMethod::simplified);
    EXPECT_NO_THROW(static_cast<void>(Outline(found.shape.silhouette)));
}

TEST(Traced, NamesWhatItDoesNotFind) {
    DrawnMushroom drawn;
    drawn.cap_radius = drawn.stem_radius;
    const auto problems_of = [&](const trace::TraceParams& params) {
        return refusal(
            [&] { static_cast<void>(trace::traced(drawn.mask(), drawn.gesture(), params)); });
    };
    EXPECT_TRUE(names(problems_of({0.1, trace::Form::capped}), "/form", "no cap found: choose"));
    EXPECT_TRUE(names(problems_of({0.0}), "/height_m", "0.001"));
    EXPECT_TRUE(names(problems_of({0.1, trace::Form::cup, 1.5}), "/hollow", "0.95"));
}

TEST(Traced, RefusesABorderThatIsTooLong) {
    // Thin teeth on a bar.
    trace::Mask mask(600, 600);
    for (int y = 10; y < 590; ++y)
        for (int x = 10; x < 590; ++x)
            mask.inside[mask.index(x, y)] = x % 2 == 0 || y > 560 ? 1 : 0;
    trace::Gesture gesture;
    gesture.axis = {{300, 580}, {300, 20}};
    EXPECT_TRUE(names(refusal([&] { static_cast<void>(trace::traced(mask, gesture, {})); }),
                      "/photo", "times its height"));
}

TEST(Traced, RefusesALineThatLeadsNowhere) {
    // Two parts: the border is that of the upper one, which the line is not on.
    trace::Mask mask(400, 400);
    for (int y = 200; y < 380; ++y)
        for (int x = 100; x < 200; ++x) mask.inside[mask.index(x, y)] = 1;
    for (int y = 20; y < 26; ++y)
        for (int x = 300; x < 306; ++x) mask.inside[mask.index(x, y)] = 1;
    trace::Gesture gesture;
    gesture.axis = {{150, 370}, {150, 210}};
    for (const trace::Form form : {trace::Form::club, trace::Form::morel, trace::Form::puffball})
        EXPECT_TRUE(names(refusal([&] {
                              static_cast<void>(trace::traced(mask, gesture, {0.1, form}));
                          }),
                          "/gesture/axis", "does not lead"))
            << trace::name(form);
}

RC_GTEST_PROP(Stretched, AnyOutlineThatIsFoundCanBeGrown, ()) {
    trace::Mask mask(200, 200);
    const int parts = *rc::gen::inRange(1, 6);
    for (int part = 0; part < parts; ++part) {
        const glm::dvec2 from(*rc::gen::inRange(0, 200), *rc::gen::inRange(0, 200)),
            to(*rc::gen::inRange(0, 200), *rc::gen::inRange(0, 200));
        const trace::Mask one = trace::drawn({{from, to}}, 200, 200, *rc::gen::inRange(3, 60));
        for (std::size_t i = 0; i < mask.inside.size(); ++i) mask.inside[i] |= one.inside[i];
    }
    const trace::Mask part = trace::without_holes(trace::largest_part(mask));
    const auto form = static_cast<trace::Form>(*rc::gen::inRange(1, 7));
    trace::Gesture gesture;
    gesture.axis = trace::upright_line(part);
    trace::FoundOutline found;
    try {
        found = trace::outline_on(part, gesture, form);
    } catch (const InvalidInput&) {
        return;  // refused by name
    }
    const std::vector<std::string> lenders = {"boletus_edulis",      "cantharellus_cibarius",
                                              "morchella_esculenta", "clavariadelphus_pistillaris",
                                              "lycoperdon_perlatum", "cyathus_striatus"};
    const Species& lender = atlas().find(lenders[static_cast<std::size_t>(form) - 1])->species;
    const Stage& stage = lender.stages[*rc::gen::inRange<std::size_t>(0, lender.stages.size())];
    const trace::Traced made =
        trace::stretched(found, {0.1, form}, std::get<Swept>(stage.model.shape).silhouette);
    RC_ASSERT(made.method == trace::TraceMethod::stretched);
    static_cast<void>(Outline(made.shape.silhouette));
    for (const AxisPoint& point : made.shape.axis)
        RC_ASSERT(std::isfinite(point.x) && std::isfinite(point.y));
}

RC_GTEST_PROP(Traced, AnyMaskAndLineIsTracedOrRefusedByName, ()) {
    // Discs and bars at random places, and a line anywhere.
    trace::Mask mask(200, 200);
    const int parts = *rc::gen::inRange(1, 7);
    for (int part = 0; part < parts; ++part) {
        const glm::dvec2 from(*rc::gen::inRange(0, 200), *rc::gen::inRange(0, 200)),
            to(*rc::gen::inRange(0, 200), *rc::gen::inRange(0, 200));
        const trace::Mask one = trace::drawn({{from, to}}, 200, 200, *rc::gen::inRange(3, 60));
        for (std::size_t i = 0; i < mask.inside.size(); ++i) mask.inside[i] |= one.inside[i];
    }
    trace::Gesture gesture;
    const int points = *rc::gen::inRange(2, 6);
    for (int i = 0; i < points; ++i)
        gesture.axis.emplace_back(*rc::gen::inRange(0, 201), *rc::gen::inRange(0, 201));
    const trace::Mask part = trace::without_holes(
        trace::connected_with(mask, trace::drawn({gesture.axis}, 200, 200, 3.0)));
    RC_PRE(part.area() > 0);
    const auto form = static_cast<trace::Form>(*rc::gen::inRange(0, 7));
    try {
        const trace::Traced found = trace::traced(part, gesture, {0.1, form});
        RC_ASSERT(found.form != trace::Form::automatic);
        RC_ASSERT(form == trace::Form::automatic || found.form == form);
        for (const OutlinePoint& point : found.shape.silhouette.cap)
            RC_ASSERT(std::isfinite(point.r) && std::isfinite(point.y) && point.r >= 0.0);
        for (const AxisPoint& point : found.shape.axis)
            RC_ASSERT(std::isfinite(point.x) && std::isfinite(point.y));
        RC_ASSERT(std::isfinite(found.lean_deg) && std::isfinite(found.asymmetry));
    } catch (const InvalidInput& refused) {
        RC_ASSERT(!refused.problems().empty());
        RC_ASSERT(refused.problems().front().path.starts_with("/"));
    }
}

/// Returns a model of a species with a traced shape.
Model model_of(const std::string& species, const trace::Traced& found) {
    Model model = atlas().find(species)->species.stages[3].model;
    model.shape = found.shape;
    model.deformation = {};
    model.ornaments = {};
    model.weathering = {};
    return model;
}

/// Returns the mean distance between the border of a mask and that of the model traced from it, of the
/// height.
double round_trip_error(const std::string& species, const Photograph& photo,
                        const trace::Traced& found) {
    return contour_error(
        trace::contour_of(photo.truth, 0.0),
        trace::contour_of(silhouette_of(model_of(species, found), View::front, 1024), 0.0));
}

TEST(Traced, GrowsIntoTheSilhouetteOfThePhotograph) {
    const std::vector<std::string> species = {
        "mycena_galericulata",  "amanita_muscaria",        "hygrocybe_coccinea",
        "coprinus_comatus",     "boletus_edulis",          "marasmius_oreades",
        "armillaria_mellea",    "hypholoma_fasciculare",   "amanita_phalloides",
        "laccaria_amethystina", "coprinopsis_atramentaria"};
    const std::size_t count = effort(22, 2);
    double mean = 0.0;
    for (std::size_t i = 0; i < count; ++i) {
        const std::string& id = species[i % species.size()];
        const Photograph photo = photograph(
            {id, 0.7, static_cast<std::uint32_t>(7 + i), View::front, 1024}, Scenery::plain);
        const double error =
            round_trip_error(id, photo, trace::traced(photo.truth, photo.gesture, {0.1}));
        EXPECT_LT(error, 0.016) << id << " of seed " << 7 + i;
        mean += error / static_cast<double>(count);
    }
    EXPECT_LT(mean, 0.008);
}

TEST(Traced, OfOtherFormsGrowsIntoTheSilhouetteOfThePhotograph) {
    struct Case {
        const char* species;
        trace::Form form;
        double most;  ///< of the error
    };
    const std::vector<Case> cases = {
        {"clavariadelphus_pistillaris", trace::Form::club, 0.008},
        {"cantharellus_cibarius", trace::Form::funnel, 0.024},
        {"lycoperdon_perlatum", trace::Form::puffball, 0.01},
        {"cyathus_striatus", trace::Form::cup, 0.022},
        {"morchella_esculenta", trace::Form::morel, 0.014},
        {"infundibulicybe_gibba", trace::Form::funnel, 0.018},
        {"sarcoscypha_austriaca", trace::Form::cup, 0.05},
        {"craterellus_cornucopioides", trace::Form::funnel, 0.022},
    };
    const std::size_t count = effort(16, 3);
    for (std::size_t i = 0; i < count; ++i) {
        const Case& one = cases[i % cases.size()];
        const Photograph photo =
            photograph({one.species, 0.7, static_cast<std::uint32_t>(7 + i), View::front, 640},
                       Scenery::plain);
        const trace::Traced found = trace::traced(photo.truth, photo.gesture, {0.1, one.form});
        EXPECT_LT(round_trip_error(one.species, photo, found), one.most)
            << one.species << " of seed " << 7 + i;
        for (int lod = 0; lod < 4; ++lod) {
            MushroomSpec spec;
            spec.model = model_of(one.species, found);
            spec.params.variation = 0.0;
            spec.params.lod = lod;
            spec.params.textures = Textures::none;
            EXPECT_TRUE(defects(mushroom_mesh(spec, resolve(spec, atlas()))).empty())
                << one.species << " at level " << lod;
        }
    }
}

TEST(Traced, IsAModelThatGrowsAtEveryLevel) {
    const std::vector<std::string> species = {
        "amanita_muscaria",      "boletus_edulis",   "mycena_galericulata", "hygrocybe_coccinea",
        "lactarius_deliciosus",  "coprinus_comatus", "marasmius_oreades",   "lepista_nuda",
        "hypholoma_fasciculare", "russula_emetica"};
    const std::size_t count = effort(20, 2);
    for (std::size_t i = 0; i < count; ++i) {
        const std::string& id = species[i % species.size()];
        const Photograph photo = photograph(
            {id, 0.7, static_cast<std::uint32_t>(i + 3), View::front, 1024}, Scenery::plain);
        const trace::Traced found = trace::traced(photo.picture, photo.gesture, {0.1});
        EXPECT_LE(found.error, 0.023) << id;
        for (int lod = 0; lod < 4; ++lod) {
            MushroomSpec spec;
            spec.model = model_of(id, found);
            spec.params.variation = 0.0;
            spec.params.lod = lod;
            spec.params.textures = Textures::none;
            spec.params.base = Base::clean;
            const Mesh mesh = mushroom_mesh(spec, resolve(spec, atlas()));
            EXPECT_TRUE(defects(mesh).empty()) << id << " at level " << lod;
            if (lod > 1) continue;
            const Bounds box = bounds(mesh);
            EXPECT_NEAR(box.max.y - box.min.y, 0.1F, 0.012F) << id;
        }
    }
}

}  // namespace
}  // namespace sporeprint::trace_trace_test
