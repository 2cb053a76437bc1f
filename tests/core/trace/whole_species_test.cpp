#include "core/trace/whole_species.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <variant>
#include <vector>

#include "core/grow/mushroom.h"
#include "core/mesh/measure.h"
#include "core/params/reader.h"
#include "core/params/value.h"
#include "core/trace/trace.h"
#include "tests/support/atlas.h"
#include "tests/support/drawn_mushroom.h"
#include "tests/support/effort.h"
#include "tests/support/meshes.h"
#include "tests/support/photographs.h"
#include "tests/support/refusals.h"

namespace sporeprint::trace_whole_species_test {
namespace {

const Species& species_of(const std::string& id) { return atlas().find(id)->species; }

const Swept& shape_of(const Stage& stage) { return std::get<Swept>(stage.model.shape); }

double height_of(const Silhouette& silhouette) {
    double height = 0.0;
    for (const OutlinePoint& point : silhouette.cap) height = std::max(height, point.y);
    return height;
}

TEST(WholeSpecies, OfItsOwnStageIsTheTemplate) {
    for (const char* id : {"amanita_muscaria", "boletus_edulis", "coprinus_comatus",
                           "clavariadelphus_pistillaris", "lycoperdon_perlatum"}) {
        const Species& own = species_of(id);
        for (std::size_t k = 0; k < own.stages.size(); ++k) {
            const trace::WholeSpecies found =
                trace::whole_species(own, shape_of(own.stages[k]), own.stages[k].age);
            EXPECT_EQ(found.stage, k);
            EXPECT_EQ(found.likeness, 1.0) << id;
            for (std::size_t i = 0; i < own.stages.size(); ++i) {
                const Silhouette &made = shape_of(found.species.stages[i]).silhouette,
                                 &old = shape_of(own.stages[i]).silhouette;
                // Stages have their control points at other shares of the length.
                EXPECT_NEAR(height_of(made), height_of(old), 0.025 * height_of(old))
                    << id << k << i;
                EXPECT_NEAR(made.stem.back().r, old.stem.back().r, 1e-9) << id << k << i;
                EXPECT_NEAR(made.cap.front().y, old.cap.front().y, 1e-9) << id << k << i;
            }
        }
    }
}

TEST(WholeSpecies, IsOfSpeciesWithItsParts) {
    EXPECT_TRUE(trace::can_be_template(species_of("boletus_edulis"), true));
    EXPECT_FALSE(trace::can_be_template(species_of("artomyces_pyxidatus"), true));
    EXPECT_FALSE(trace::can_be_template(species_of("boletus_edulis"), false));
    EXPECT_TRUE(trace::can_be_template(species_of("clavariadelphus_pistillaris"), false));
    const Species& own = species_of("amanita_muscaria");
    EXPECT_EQ(trace::height_at(own, own.stages[3].age + 0.01),
              height_of(shape_of(own.stages[3]).silhouette));
}

TEST(MoveAges, KeepsTheOrderAndTheSharesOfTime) {
    for (const std::size_t stage : {std::size_t{0}, std::size_t{2}, std::size_t{5}}) {
        const Species own = species_of("amanita_muscaria");
        ASSERT_EQ(own.stages.size(), 6U);
        Species moved = own;
        trace::move_ages(moved, stage, 0.6);
        EXPECT_EQ(moved.stages[stage].age, 0.6);
        const double before = own.stages[stage].age;
        for (std::size_t i = 0; i < own.stages.size(); ++i) {
            if (i > 0) {
                EXPECT_GT(moved.stages[i].age, moved.stages[i - 1].age);
            }
            const double from = own.stages[i].age, to = moved.stages[i].age;
            if (i < stage) {
                EXPECT_NEAR(to / 0.6, from / before, 2e-4);
            } else if (i > stage) {
                EXPECT_NEAR((1.0 - to) / 0.4, (1.0 - from) / (1.0 - before), 3e-4);
            }
        }
        for (std::size_t i = 0; i < own.stages.size(); ++i) moved.stages[i].age = own.stages[i].age;
        EXPECT_EQ(moved, own);
    }
}

TEST(GrowthCertificate, IsTrueOfSpeciesAndFalseOfACrossingStage) {
    Species species = species_of("boletus_edulis");
    EXPECT_TRUE(trace::growth_certificate(species).simple);
    Silhouette& outline = std::get<Swept>(species.stages[2].model.shape).silhouette;
    std::swap(outline.cap[1], outline.cap[outline.cap.size() - 2]);
    EXPECT_FALSE(trace::growth_certificate(species).simple);
}

TEST(WholeSpecies, TakesOverASizeInAllStages) {
    const Species& own = species_of("amanita_muscaria");
    Swept doubled = shape_of(own.stages[3]);
    for (auto* part :
         {&doubled.silhouette.stem, &doubled.silhouette.hymenium, &doubled.silhouette.cap})
        for (OutlinePoint& point : *part) point = {2.0 * point.r, 2.0 * point.y};
    const trace::WholeSpecies found = trace::whole_species(own, doubled, own.stages[3].age);
    for (std::size_t i = 0; i < own.stages.size(); ++i)
        EXPECT_NEAR(height_of(shape_of(found.species.stages[i]).silhouette),
                    2.0 * height_of(shape_of(own.stages[i]).silhouette), 0.002);
}

TEST(WholeSpecies, TakesOverAThickStemLessTheFartherInAge) {
    const Species& own = species_of("russula_emetica");
    std::size_t mature = 0;
    while (own.stages[mature].age < 0.6) ++mature;
    Swept thick = shape_of(own.stages[mature]);
    for (OutlinePoint& point : thick.silhouette.stem) point.r *= 1.5;
    thick.silhouette.hymenium.front() = thick.silhouette.stem.back();
    const trace::WholeSpecies found = trace::whole_species(own, thick, 0.6);
    EXPECT_EQ(found.stage, mature);
    double last = 10.0;
    for (std::size_t i = mature; i-- > 0;) {
        const double ratio = shape_of(found.species.stages[i]).silhouette.stem.back().r /
                             shape_of(own.stages[i]).silhouette.stem.back().r;
        EXPECT_LE(ratio, last + 1e-9);
        EXPECT_GE(ratio, std::pow(1.5, 0.55) - 0.01);
        EXPECT_LE(ratio, 1.5 + 1e-6);
        last = ratio;
    }
}

/// Expects that a traced shape becomes a species by a template, and that its mushrooms have no defects.
void expect_growth(const std::string& traced_of, const std::string& lender, const Swept& shape) {
    trace::WholeSpecies found = trace::whole_species(species_of(lender), shape, 0.65);
    found.species.id = Text<48>("traced");
    EXPECT_EQ(shape_of(found.species.stages[found.stage]).silhouette, shape.silhouette);
    const Atlas own({.species = {dump(write(found.species))}});
    for (const double age : {0.0, 0.3, 0.65, 1.0}) {
        MushroomSpec spec;
        spec.mix.push_back({"traced"});
        spec.params.age = age;
        spec.params.lod = 1;
        spec.params.textures = Textures::none;
        const Mesh mesh = mushroom_mesh(spec, resolve(spec, own));
        EXPECT_TRUE(defects(mesh).empty()) << traced_of << " as " << lender << " at " << age;
    }
}

TEST(WholeSpecies, OfATraceGrowsAtAllAges) {
    const std::vector<std::string> ids = {
        "amanita_muscaria",  "boletus_edulis",        "hygrocybe_coccinea", "coprinus_comatus",
        "marasmius_oreades", "hypholoma_fasciculare", "russula_emetica",    "lepista_nuda"};
    const std::size_t count = effort(16, 3);
    for (std::size_t i = 0; i < count; ++i) {
        const std::string& id = ids[i % ids.size()];
        const std::string& other = ids[(i + 3) % ids.size()];
        const Photograph photo = photograph(
            {id, 0.65, static_cast<std::uint32_t>(i + 21), View::front, 640}, Scenery::plain);
        const trace::Traced traced = trace::traced(photo.truth, photo.gesture, {0.09});
        // The template may be another species than the one on the photograph.
        for (const std::string& of : {id, other}) expect_growth(id, of, traced.shape);
    }
}

TEST(WholeSpecies, OfOtherFormsGrowsAtAllAges) {
    struct Case {
        const char* species;
        const char* other;  ///< a template of the same parts
    };
    const std::vector<Case> cases = {{"clavariadelphus_pistillaris", "lycoperdon_perlatum"},
                                     {"cantharellus_cibarius", "infundibulicybe_gibba"},
                                     {"sarcoscypha_austriaca", "disciotis_venosa"},
                                     {"lycoperdon_perlatum", "morchella_esculenta"},
                                     {"craterellus_cornucopioides", "cantharellus_cibarius"},
                                     {"cyathus_striatus", "sarcoscypha_austriaca"},
                                     {"morchella_esculenta", "morchella_esculenta"}};
    const std::size_t count = effort(14, 3);
    for (std::size_t i = 0; i < count; ++i) {
        const Case& one = cases[i % cases.size()];
        const Species& own = species_of(one.species);
        const Photograph photo =
            photograph({one.species, 0.65, static_cast<std::uint32_t>(i + 21), View::front, 640},
                       Scenery::plain);
        const trace::Traced traced = trace::traced(photo.truth, photo.gesture,
                                                   {0.09, trace::form_of(own.facts.form).value()});
        for (const char* of : {one.species, one.other})
            expect_growth(one.species, of, traced.shape);
    }
}

TEST(WholeSpecies, LendsItsFormAndItsHollowToATrace) {
    const trace::TraceParams cup =
        trace::params_like(species_of("sarcoscypha_austriaca"), 0.6, 0.03);
    EXPECT_EQ(cup.height_m, 0.03);
    EXPECT_EQ(cup.form, trace::Form::cup);
    // Its edge is 20 mm high, its stem 6 mm, and its inside goes down to 11 mm.
    EXPECT_NEAR(cup.hollow, 0.65, 0.05);
    EXPECT_EQ(trace::params_like(species_of("morchella_esculenta"), 0.6, 0.1).form,
              trace::Form::morel);
    EXPECT_EQ(trace::params_like(species_of("ramaria_formosa"), 0.6, 0.1).form,
              trace::Form::automatic);
    // A trace has the hollow that was stated.
    const DrawnForm drawn = drawn_form(trace::Form::funnel);
    for (const double hollow : {0.3, 0.6})
        EXPECT_NEAR(trace::hollow_of(trace::traced(drawn.mask(), drawn.gesture(),
                                                   {0.1, trace::Form::funnel, hollow})
                                         .shape.silhouette),
                    hollow, 0.02);
}

TEST(WholeSpecies, NeedsATemplateWithThePartsOfTheShape) {
    const Swept capped = shape_of(species_of("amanita_muscaria").stages[3]),
                club = shape_of(species_of("clavariadelphus_pistillaris").stages[2]);
    const auto problems_of = [](const char* id, const Swept& shape) {
        return refusal(
            [&] { static_cast<void>(trace::whole_species(species_of(id), shape, 0.6)); });
    };
    EXPECT_TRUE(names(problems_of("ramaria_formosa", capped), "/template", "no outline"));
    EXPECT_TRUE(
        names(problems_of("clavariadelphus_pistillaris", capped), "/template", "no lower face"));
    EXPECT_TRUE(names(problems_of("amanita_muscaria", club), "/template", "has a lower face"));
}

TEST(SizedSpecies, IsTheTemplateInAnotherSizeOnAnotherAxis) {
    for (const char* id : {"cantharellus_cibarius", "boletus_edulis", "cyathus_striatus"}) {
        const Species& own = species_of(id);
        const std::vector<AxisPoint> axis = {{0, 0, 0}, {0.02, 0.5, 0}, {0.08, 0.99, 0}};
        const double height = 3.0 * trace::height_at(own, 0.7);
        const trace::WholeSpecies found = trace::sized_species(own, axis, height, 0.7);
        EXPECT_TRUE(found.certificate.simple) << id;
        EXPECT_NEAR(trace::height_at(found.species, 0.7), height, 1e-9);
        for (std::size_t i = 0; i < own.stages.size(); ++i) {
            const Silhouette &made = shape_of(found.species.stages[i]).silhouette,
                             &old = shape_of(own.stages[i]).silhouette;
            ASSERT_EQ(made.cap.size(), old.cap.size());
            for (std::size_t k = 0; k < old.cap.size(); ++k) {
                EXPECT_NEAR(made.cap[k].r, 3.0 * old.cap[k].r, 1e-12) << id << i;
                EXPECT_NEAR(made.cap[k].y, 3.0 * old.cap[k].y, 1e-12) << id << i;
            }
            EXPECT_FALSE(shape_of(found.species.stages[i]).axis.empty());
        }
    }
}

}  // namespace
}  // namespace sporeprint::trace_whole_species_test
