#include "core/grow/species_from_photo.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <variant>

#include "core/params/reader.h"
#include "core/params/value.h"
#include "tests/support/atlas.h"
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
    return species_from_photo(photo.picture, mushroom_on(photo.picture, cut_out, spec), spec,
                              *small_atlas(), nearest());
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
    EXPECT_NEAR(height_of(found.whole.species.stages[found.whole.stage]), 0.25, 0.01);
    // In pixels of the photograph: from the foot to the apex.
    EXPECT_NEAR(found.traced.left.front().y, bolete().gesture.axis.front().y, 40.0);
    EXPECT_LT(found.traced.left.back().y, found.traced.left.front().y);
}

TEST(SpeciesFromPhoto, IsOneThatAnAtlasCanHave) {
    for (const char* lender : {"boletus_edulis", "lactarius_deliciosus", "hydnum_repandum"}) {
        trace::TraceSpec spec = spec_of(bolete().gesture);
        spec.template_id = Text<48>(std::string_view(lender));
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

TEST(SpeciesFromPhoto, WithoutAHeightHasThatOfItsTemplate) {
    trace::TraceSpec spec = spec_of(bolete().gesture);
    spec.template_id = Text<48>("russula_emetica");
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

TEST(SpeciesFromPhoto, NamesWhatCanNotBeTracedInTheWordsOfTheRequest) {
    const auto refused = [&](const trace::TraceSpec& spec, std::optional<trace::Mask> cut_out) {
        return refusal([&] { static_cast<void>(found_in(bolete(), spec, cut_out)); });
    };
    EXPECT_TRUE(names(refused({}, std::nullopt), "/views/side/gesture/axis", "two points"));
    trace::TraceSpec spec = spec_of(bolete().gesture);
    spec.template_id = Text<48>("artomyces_pyxidatus");
    EXPECT_TRUE(names(refused(spec, std::nullopt), "/template", "artomyces_pyxidatus"));
    trace::Mask speck(bolete().picture.width, bolete().picture.height);
    speck.inside[speck.index(100, 100)] = 1;
    EXPECT_TRUE(names(refused({}, speck), "/views/side/photo", "at least 120"));
    EXPECT_THROW(static_cast<void>(found_in(bolete(), {}, speck)), Impossible);
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
