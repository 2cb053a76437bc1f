#include "core/grow/species_from_photo.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "core/grow/mushroom.h"
#include "core/mesh/measure.h"
#include "core/params/reader.h"
#include "core/params/value.h"
#include "tests/support/atlas.h"
#include "tests/support/drawn_mushroom.h"
#include "tests/support/meshes.h"
#include "tests/support/photographs.h"
#include "tests/support/refusals.h"
#include "tests/support/small_atlas.h"

namespace sporeprint::grow_species_from_photo_test {
namespace {

LazyNearestSpecies& lazy() {
    static LazyNearestSpecies made;
    return made;
}

const NearestSpecies& nearest() { return lazy().get(*small_atlas(), in_turn); }

const Photograph& bolete() {
    static const Photograph made =
        photograph({"boletus_edulis", 0.7, 3, View::front, 512}, Scenery::plain);
    return made;
}

trace::TraceSpec spec_of(const trace::Gesture& gesture) {
    trace::TraceSpec spec;
    trace::GestureSpec& written = spec.views.side.gesture.emplace();
    for (const glm::dvec2& point : gesture.axis) written.axis.push_back({point.x, point.y});
    for (const glm::dvec2& point : gesture.cap) written.cap.push_back({point.x, point.y});
    return spec;
}

SpeciesFromPhoto found_in(const Photograph& photo, const trace::TraceSpec& spec,
                          const std::optional<trace::Mask>& cut_out) {
    return species_from_photo(mushroom_on(photo.picture, cut_out, spec), {}, spec, *small_atlas(),
                              nearest());
}

double height_of(const Stage& stage) {
    double height = 0.0;
    for (const OutlinePoint& point : std::get<Swept>(stage.model.shape).silhouette.cap)
        height = std::max(height, point.y);
    return height;
}

TEST(SpeciesFromPhoto, HasTheShapeTheHeightAndTheRequestedId) {
    trace::TraceSpec spec = spec_of(bolete().gesture);
    spec.id = Text<48>("mine");
    spec.height_m = 0.25;
    const SpeciesFromPhoto found = found_in(bolete(), spec, std::nullopt);
    EXPECT_EQ(found.whole.species.id.view(), "mine");
    EXPECT_EQ(found.template_id, "boletus_edulis");
    EXPECT_EQ(found.nearest.size(), 5U);
    EXPECT_TRUE(found.whole.certificate.simple);
    const Stage& photographed = found.whole.species.stages[found.whole.stage];
    EXPECT_NEAR(height_of(photographed), 0.25, 0.01);
    // Without a stated age it grows as it was photographed.
    EXPECT_NEAR(photographed.age, MushroomParams{}.age, 1e-9);
    // It is not the template, whose ecology it has.
    const Facts &facts = found.whole.species.facts,
                &lent = small_atlas()->find("boletus_edulis")->species.facts;
    EXPECT_EQ(facts.scientific_name.view(), "");
    EXPECT_NE(facts.common_name.view(), lent.common_name.view());
    EXPECT_EQ(facts.sources.at(0).view(),
              "Traced from a photograph; what it does not show is that of boletus_edulis");
    EXPECT_EQ(facts.habitat.view(), lent.habitat.view());
    EXPECT_EQ(found.whole.species.ecology, small_atlas()->find("boletus_edulis")->species.ecology);
    // In pixels of the photograph: from the foot to the apex.
    EXPECT_NEAR(found.traced.left.front().y, bolete().gesture.axis.front().y, 40.0);
    EXPECT_LT(found.traced.left.back().y, found.traced.left.front().y);
}

TEST(SpeciesFromPhoto, IsOneThatAnAtlasCanHave) {
    for (const char* lender : {"boletus_edulis", "lactarius_deliciosus", "hydnum_repandum"}) {
        trace::TraceSpec spec = spec_of(bolete().gesture);
        spec.template_id = Text<64>(std::string_view(lender));
        const SpeciesFromPhoto found = found_in(bolete(), spec, std::nullopt);
        const Atlas loaded({.species = {dump(write(found.whole.species))}});
        EXPECT_EQ(loaded.find("my_mushroom")->species, found.whole.species) << lender;
    }
}

TEST(SpeciesFromPhoto, HasImagesOnRequest) {
    trace::TraceSpec spec = spec_of(bolete().gesture);
    const SpeciesFromPhoto without = found_in(bolete(), spec, std::nullopt);
    spec.images = true;
    const SpeciesFromPhoto found = found_in(bolete(), spec, std::nullopt);
    const auto surface = [](const SpeciesFromPhoto& of) {
        return of.whole.species.stages[of.whole.stage].model.surface;
    };
    EXPECT_TRUE(surface(without).cap.image.empty());
    EXPECT_FALSE(surface(found).stem.image.empty());
    EXPECT_EQ(decoded_picture(surface(found).stem.image.bytes, "").width, 512);
    const Atlas loaded({.species = {dump(write(found.whole.species))}});
    EXPECT_EQ(loaded.find("my_mushroom")->species, found.whole.species);
}

trace::FaceView face_of(const Photograph& photo) {
    return face_on(photo.picture, photo.truth, {}, "/views/above");
}

TEST(SpeciesFromPhoto, TakesColoursAndImagesFromOtherViews) {
    const Photograph above =
        photograph({"russula_emetica", 0.7, 3, View::top, 512}, Scenery::plain);
    trace::TraceSpec spec = spec_of(bolete().gesture);
    const MushroomOnPhoto side = mushroom_on(bolete().picture, std::nullopt, spec);
    const auto surface = [&](const FacesOnPhotos& faces) {
        const SpeciesFromPhoto found =
            species_from_photo(side, faces, spec, *small_atlas(), nearest());
        return found.whole.species.stages[found.whole.stage].model.surface;
    };
    const FacesOnPhotos both{face_of(above), face_of(above)};
    const Surface alone = surface({}), seen = surface(both);
    // A red cap instead of a brown one, and so its lower face, of which the same photograph is given.
    const auto is_red = [](const Colour& colour) { return colour.r > 2 * colour.g; };
    EXPECT_FALSE(is_red(alone.cap.ramp.front()));
    EXPECT_TRUE(is_red(seen.cap.ramp.front()));
    EXPECT_FALSE(is_red(alone.hymenium.colour));
    EXPECT_TRUE(is_red(seen.hymenium.colour));
    EXPECT_EQ(seen.stem.top, alone.stem.top);
    EXPECT_TRUE(seen.hymenium.image.empty());
    spec.images = true;
    const Surface painted = surface(both);
    EXPECT_FALSE(painted.hymenium.image.empty());
    EXPECT_NE(painted.cap.image, surface({}).cap.image);
}

TEST(SpeciesFromPhoto, SaysOfWhichViewNothingWasUsed) {
    trace::TraceSpec spec = spec_of(bolete().gesture);
    const MushroomOnPhoto side = mushroom_on(bolete().picture, std::nullopt, spec);
    // A whole mushroom from the side is not as round as a cap.
    const SpeciesFromPhoto found = species_from_photo(side, {std::nullopt, face_of(bolete())}, spec,
                                                      *small_atlas(), nearest());
    const auto said = std::find_if(
        found.warnings.begin(), found.warnings.end(),
        [](const TraceWarning& warning) { return std::string_view(warning.code) == "images"; });
    ASSERT_NE(said, found.warnings.end());
    EXPECT_NE(said->detail.find("from below is not as round as a cap"), std::string::npos);
}

TEST(SpeciesFromPhoto, NamesWhatIsWrongWithAView) {
    const Photograph& photo = bolete();
    const auto refused = [&](const trace::FaceViewSpec& spec,
                             const std::optional<trace::Mask>& cut_out) {
        return refusal(
            [&] { static_cast<void>(face_on(photo.picture, cut_out, spec, "/views/below")); });
    };
    EXPECT_TRUE(
        names(refused({}, std::nullopt), "/views/below/gesture/axis", "at least two points"));
    trace::FaceViewSpec beside;
    beside.stem_end = {600.0, 20.0};
    EXPECT_TRUE(names(refused(beside, photo.truth), "/views/below/stem_end",
                      "is not on the photograph of 512 x 512 pixels"));
    trace::TraceSpec spec;
    spec.form = trace::Form::club;
    const MushroomOnPhoto side = mushroom_on(photo.picture, photo.truth, spec);
    EXPECT_TRUE(names(refusal([&] {
                          static_cast<void>(species_from_photo(side, {std::nullopt, face_of(photo)},
                                                               spec, *small_atlas(), nearest()));
                      }),
                      "/views/below", "a club has no lower face; leave this photograph out"));
}

TEST(SpeciesFromPhoto, LeavesOutTheSoilThatWasCutOutWithIt) {
    // A plate of soil below the foot.
    Photograph photo = photograph({"boletus_edulis", 0.7, 3, View::front, 512}, Scenery::plain);
    const trace::Mask before = photo.truth;
    const glm::dvec2 foot = photo.gesture.axis.front();
    for (int y = 0; y < 512; ++y)
        for (int x = 0; x < 512; ++x) {
            const double across = (x - foot.x) / 150.0, down = (y - foot.y - 4.0) / 14.0;
            if (across * across + down * down > 1.0 || before.at(x, y)) continue;
            photo.truth.inside[photo.truth.index(x, y)] = 1;
            const std::array<std::uint8_t, 3> earth = {66, 48, 36};
            std::copy(earth.begin(), earth.end(),
                      photo.picture.rgb.begin() +
                          static_cast<std::ptrdiff_t>(3 * photo.truth.index(x, y)));
        }
    const SpeciesFromPhoto found = found_in(photo, {}, photo.truth),
                           clean = found_in(bolete(), {}, before);
    const auto foot_width = [](const SpeciesFromPhoto& of) {
        return std::abs(of.traced.left[4].x - of.traced.right[4].x);
    };
    EXPECT_NEAR(foot_width(found), foot_width(clean), 0.3 * foot_width(clean));
    EXPECT_TRUE(std::any_of(
        found.warnings.begin(), found.warnings.end(),
        [](const TraceWarning& warning) { return std::string_view(warning.code) == "soil"; }));
    EXPECT_TRUE(std::none_of(
        clean.warnings.begin(), clean.warnings.end(),
        [](const TraceWarning& warning) { return std::string_view(warning.code) == "soil"; }));
}

TEST(SpeciesFromPhoto, WithoutAHeightHasThatOfItsTemplate) {
    trace::TraceSpec spec = spec_of(bolete().gesture);
    spec.template_id = Text<64>("russula_emetica");
    const SpeciesFromPhoto found = found_in(bolete(), spec, std::nullopt);
    EXPECT_EQ(found.template_id, "russula_emetica");
    const Stage& made = found.whole.species.stages[found.whole.stage];
    const Stage& lent = atlas().find("russula_emetica")->species.stages[found.whole.stage];
    EXPECT_NEAR(height_of(made), height_of(lent), 0.03 * height_of(lent));
    // What no photograph shows is the template's, and the colour is not.
    EXPECT_EQ(made.model.hymenium, lent.model.hymenium);
    EXPECT_NE(made.model.surface.cap.ramp, lent.model.surface.cap.ramp);
}

TEST(SpeciesFromPhoto, IsLentByACappedSpeciesWhateverItIsNearest) {
    // A red disc on a thin stem is most like a cage fungus.
    trace::Mask mask(300, 400);
    for (int y = 0; y < 400; ++y)
        for (int x = 0; x < 300; ++x) {
            const double u = (x - 149.5) / 110.0, v = (y - 130.0) / 100.0;
            const bool is_cap = u * u + v * v <= 1.0 && y < 180;
            const bool is_stem = x >= 130 && x < 170 && y >= 130 && y < 380;
            mask.inside[mask.index(x, y)] = is_cap || is_stem ? 1 : 0;
        }
    Photograph photo{{300, 400, {}}, mask, {}};
    for (std::size_t i = 0; i < mask.inside.size(); ++i)
        photo.picture.rgb.insert(photo.picture.rgb.end(), {220, 40, 40});
    const SpeciesFromPhoto found = found_in(photo, {}, mask);
    const GrowthForm form = atlas().find(found.template_id)->species.facts.form;
    EXPECT_TRUE(form == GrowthForm::agaric || form == GrowthForm::bolete) << found.template_id;
}

TEST(SpeciesFromPhoto, OfAPictureThatIsCutOutNeedsNoGesture) {
    trace::Mask truth = bolete().truth;
    // A speck beside the mushroom is none of it.
    truth.inside[truth.index(3, 3)] = 1;
    const SpeciesFromPhoto without = found_in(bolete(), {}, truth);
    trace::GestureSpec axis_alone;
    for (const glm::dvec2& point : bolete().gesture.axis)
        axis_alone.axis.push_back({point.x, point.y});
    trace::TraceSpec spec;
    spec.views.side.gesture = axis_alone;
    const SpeciesFromPhoto with = found_in(bolete(), spec, truth);
    EXPECT_NEAR(without.traced.lean_deg, with.traced.lean_deg, 3.0);
    EXPECT_LT(without.traced.error, 0.02);
    spec = spec_of(bolete().gesture);
    EXPECT_TRUE(
        names(refusal([&] { static_cast<void>(mushroom_on(bolete().picture, truth, spec)); }),
              "/views/side/gesture/cap", "cut out already"));
}

/// Returns a specification with the outline and the marks of a trace, and without a gesture.
trace::TraceSpec spec_with_marks(const SpeciesFromPhoto& found) {
    const auto points = [](std::span<const glm::dvec2> line) {
        std::vector<trace::PhotoPoint> list;
        for (const glm::dvec2& at : line)
            list.push_back({std::round(at.x * 100.0) / 100.0, std::round(at.y * 100.0) / 100.0});
        return list;
    };
    const trace::Traced& traced = found.traced;
    trace::TraceSpec spec;
    spec.outline = {points(traced.left), points(traced.right), points(traced.axis)};
    spec.marks = {points(traced.junctions), points(traced.margins), traced.cap_turn_deg};
    spec.form = traced.form;
    spec.template_id = Text<64>(std::string_view(found.template_id));
    return spec;
}

/// Returns a square photograph in another size, by the nearest pixels.
Photograph enlarged(const Photograph& photo, int side) {
    Photograph large{{side, side, {}}, trace::resized(photo.truth, side, side), {}};
    large.picture.rgb.reserve(3 * large.truth.inside.size());
    const auto nearest_pixel = [&](int i) { return i * photo.picture.width / side; };
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x) {
            const std::uint8_t* pixel =
                &photo.picture.rgb[3 * photo.truth.index(nearest_pixel(x), nearest_pixel(y))];
            large.picture.rgb.insert(large.picture.rgb.end(), pixel, pixel + 3);
        }
    large.gesture = photo.gesture.scaled(static_cast<double>(side) / photo.picture.width);
    return large;
}

TEST(SpeciesFromPhoto, OfItsOwnOutlineAndMarksHasTheSameShape) {
    // A working copy smaller than the photograph, by a factor that is no fraction of two.
    const Photograph large = enlarged(bolete(), 1400);
    for (const Photograph* photo : {&bolete(), &large}) {
        const SpeciesFromPhoto first = found_in(*photo, spec_of(photo->gesture), std::nullopt);
        const SpeciesFromPhoto again = found_in(*photo, spec_with_marks(first), std::nullopt);
        EXPECT_EQ(again.traced.shape.silhouette, first.traced.shape.silhouette);
        EXPECT_EQ(again.traced.shape.axis, first.traced.shape.axis);
        EXPECT_EQ(again.whole.stage, first.whole.stage);
        EXPECT_EQ(again.template_id, first.template_id);
        for (std::size_t i = 0; i < first.whole.species.stages.size(); ++i)
            EXPECT_EQ(again.whole.species.stages[i].model.shape,
                      first.whole.species.stages[i].model.shape);
        EXPECT_LT(glm::length(again.traced.margins[0] - first.traced.margins[0]), 0.02);
    }
}

TEST(SpeciesFromPhoto, OfAHollowFormWithMarksHasTheSameShape) {
    const Photograph photo =
        photograph({"cantharellus_cibarius", 0.7, 7, View::front, 640}, Scenery::plain);
    trace::TraceSpec spec;
    spec.hollow = 0.4;
    const SpeciesFromPhoto first = found_in(photo, spec, photo.truth);
    ASSERT_TRUE(trace::is_hollow(first.traced.form)) << trace::name(first.traced.form);
    trace::TraceSpec marked = spec_with_marks(first);
    marked.hollow = 0.4;
    const SpeciesFromPhoto again = found_in(photo, marked, photo.truth);
    EXPECT_EQ(again.traced.shape.silhouette, first.traced.shape.silhouette);
}

TEST(SpeciesFromPhoto, NamesWhatIsWrongWithAnOutlineInTheWordsOfTheRequest) {
    static const SpeciesFromPhoto first =
        found_in(bolete(), spec_of(bolete().gesture), std::nullopt);
    const auto refused = [&](auto change) {
        trace::TraceSpec spec = spec_with_marks(first);
        change(spec);
        return refusal([&] { static_cast<void>(found_in(bolete(), spec, std::nullopt)); });
    };
    EXPECT_TRUE(refused([](trace::TraceSpec&) {}).empty());
    EXPECT_TRUE(names(refused([](trace::TraceSpec& spec) {
                          spec.outline->left[9] = {700, 30};
                      }),
                      "/outline/left/9", "512 x 512"));
    EXPECT_TRUE(names(refused([](trace::TraceSpec& spec) {
                          spec.marks->margins[1] = {3, 900};
                      }),
                      "/marks/margins/1", "512 x 512"));
    EXPECT_TRUE(names(refused([](trace::TraceSpec& spec) {
                          spec.marks->margins[0] = {spec.outline->left.back()[0], 1.0};
                      }),
                      "/marks/margins/0", "above the apex"));
    EXPECT_TRUE(names(
        refused([](trace::TraceSpec& spec) { std::swap(spec.outline->left, spec.outline->right); }),
        "/outline/left", "exchange them"));
}

TEST(SpeciesFromPhoto, NamesWhatCanNotBeTracedInTheWordsOfTheRequest) {
    const auto refused = [&](const trace::TraceSpec& spec, std::optional<trace::Mask> cut_out) {
        return refusal([&] { static_cast<void>(found_in(bolete(), spec, cut_out)); });
    };
    EXPECT_TRUE(names(refused({}, std::nullopt), "/views/side/gesture/axis", "two points"));
    trace::TraceSpec spec = spec_of(bolete().gesture);
    spec.template_id = Text<64>("artomyces_pyxidatus");
    EXPECT_TRUE(names(refused(spec, std::nullopt), "/template", "artomyces_pyxidatus"));
    trace::Mask speck(bolete().picture.width, bolete().picture.height);
    speck.inside[speck.index(100, 100)] = 1;
    EXPECT_TRUE(names(refused({}, speck), "/views/side/photo", "at least 120"));
    EXPECT_THROW(static_cast<void>(found_in(bolete(), {}, speck)), Impossible);
}

/// Returns a picture of three bars that cross each other, from which no form can be grown.
Photograph crossed_bars() {
    trace::Mask mask(200, 200);
    const auto add = [&](const trace::Stroke& line, double width) {
        const trace::Mask one = trace::drawn({line}, 200, 200, width);
        for (std::size_t i = 0; i < mask.inside.size(); ++i) mask.inside[i] |= one.inside[i];
    };
    add({{117, 40}, {16, 80}}, 17);
    add({{187, 190}, {40, 82}}, 16);
    add({{176, 105}, {69, 7}}, 13);
    const trace::Mask part = trace::without_holes(trace::largest_part(mask));
    return {{200, 200, Bytes(3 * part.inside.size(), 128)}, part, {}};
}

TEST(SpeciesFromPhoto, OfAnOutlineThatCannotBeGrownIsAStretchedTemplate) {
    const Photograph photo = crossed_bars();
    trace::Gesture gesture;
    gesture.axis = trace::upright_line(photo.truth);
    for (int form = 0; form <= static_cast<int>(trace::Form::cup); ++form)
        EXPECT_FALSE(refusal([&] {
                         static_cast<void>(trace::traced(photo.truth, gesture,
                                                         {0.1, static_cast<trace::Form>(form)}));
                     }).empty())
            << form;
    trace::TraceSpec spec;
    spec.height_m = 0.1;
    const SpeciesFromPhoto found = found_in(photo, spec, photo.truth);
    EXPECT_EQ(found.traced.method, trace::TraceMethod::stretched);
    EXPECT_STREQ(trace::name(found.traced.method), "template");
    EXPECT_TRUE(std::any_of(found.warnings.begin(), found.warnings.end(), [](const auto& warning) {
        return std::string_view(warning.code) == "method" &&
               warning.detail.find("that of its template") != std::string::npos;
    }));
    EXPECT_TRUE(found.whole.certificate.simple);
    const Stage& made = found.whole.species.stages[found.whole.stage];
    EXPECT_NEAR(height_of(made), 0.1, 0.02);
    const auto own =
        std::make_shared<const Atlas>(AtlasTexts{.species = {dump(write(found.whole.species))}});
    for (int lod = 0; lod < 4; ++lod)
        for (const double age : {0.0, 0.25, 0.5, 0.75, 1.0}) {
            MushroomSpec mushroom;
            mushroom.mix.push_back({"my_mushroom"});
            mushroom.params.age = age;
            mushroom.params.lod = lod;
            mushroom.params.textures = Textures::none;
            EXPECT_TRUE(defects(mushroom_mesh(mushroom, resolve(mushroom, *own))).empty())
                << lod << ' ' << age;
        }
    // A template that is stated lends the same form.
    spec.template_id = Text<64>(std::string_view(found.template_id));
    spec.form = found.traced.form;
    EXPECT_EQ(found_in(photo, spec, photo.truth).traced.method, trace::TraceMethod::stretched);
    // One that has not its parts is named.
    spec.template_id =
        Text<64>(trace::has_face(spec.form) ? "morchella_esculenta" : "boletus_edulis");
    EXPECT_TRUE(names(refusal([&] { static_cast<void>(found_in(photo, spec, photo.truth)); }),
                      "/template"));
}

TEST(SpeciesFromPhoto, OfALineAcrossTheCapAloneIsProvenAtAllAges) {
    // The outline that was found with this line is simple, but crossed itself on the way to other ages.
    DrawnMushroom drawn;
    drawn.side = 180;
    drawn.pixels = 150.0;
    drawn.bend_deg = 10.0;
    const Photograph photo{photograph_of(drawn), {}, {}};
    trace::Gesture gesture;
    gesture.axis = {{96, 39}, {100, 30}};
    gesture.cap = {{60, 55}, {130, 65}};
    const trace::TraceSpec spec = spec_of(gesture);
    const SpeciesFromPhoto found = found_in(photo, spec, std::nullopt);
    EXPECT_TRUE(found.whole.certificate.simple);
    EXPECT_EQ(found.traced.method, trace::TraceMethod::stretched);
}

TEST(SpeciesFromPhoto, TakesALineFromTheTopTheOtherWayRoundAndWarns) {
    trace::TraceSpec spec = spec_of(bolete().gesture);
    const SpeciesFromPhoto right = found_in(bolete(), spec, std::nullopt);
    auto& axis = spec.views.side.gesture->axis;
    std::reverse(axis.begin(), axis.end());
    const SpeciesFromPhoto turned = found_in(bolete(), spec, std::nullopt);
    EXPECT_EQ(turned.traced.shape.silhouette, right.traced.shape.silhouette);
    const auto is_reversed = [](const TraceWarning& one) {
        return std::string_view(one.code) == "reversed";
    };
    EXPECT_TRUE(std::any_of(turned.warnings.begin(), turned.warnings.end(), is_reversed));
    EXPECT_TRUE(std::none_of(right.warnings.begin(), right.warnings.end(), is_reversed));
}

TEST(SpeciesFromPhoto, WarnsOfSidesThatDiffer) {
    // A cap that is wide on one side alone.
    trace::Mask lopsided(400, 500);
    const auto fill = [&](int left, int top, int right, int bottom) {
        for (int y = top; y < bottom; ++y)
            for (int x = left; x < right; ++x) lopsided.inside[lopsided.index(x, y)] = 1;
    };
    fill(180, 150, 220, 450);
    fill(165, 60, 395, 200);
    Photograph photo{{400, 500, Bytes(3 * lopsided.inside.size(), 128)}, lopsided, {}};
    const SpeciesFromPhoto found = found_in(photo, {}, lopsided);
    ASSERT_FALSE(found.warnings.empty()) << found.traced.asymmetry;
    EXPECT_STREQ(found.warnings[0].code, "asymmetry");
}

}  // namespace
}  // namespace sporeprint::grow_species_from_photo_test
