#include "core/colony/colony_spec.h"

#include <gtest/gtest.h>

#include <string>

#include "tests/support/orders.h"
#include "tests/support/refusals.h"

namespace sporeprint::colony_colony_spec_test {
namespace {

ColonySpec colony_of(const std::string& id) {
    ColonySpec spec;
    spec.mix = {{id, 1000}};
    return spec;
}

Habit recorded(const char* id) { return habit_of(atlas().find(id)->species); }

TEST(ColonySpec, TheHabitIsTheOneRecordedFirst) {
    EXPECT_EQ(recorded("armillaria_mellea"), Habit::tuft) << "dense tufts";
    EXPECT_EQ(recorded("mycena_haematopus"), Habit::tuft) << "clusters with joined bases";
    EXPECT_EQ(recorded("marasmius_oreades"), Habit::ring) << "rings, arcs, groups";
    EXPECT_EQ(recorded("amanita_muscaria"), Habit::troop) << "scattered, groups, rings";
    EXPECT_EQ(recorded("cantharellus_cibarius"), Habit::troop) << "troops";
    EXPECT_EQ(recorded("coprinellus_disseminatus"), Habit::troop) << "swarms of hundreds";
    EXPECT_EQ(recorded("trametes_versicolor"), Habit::tier) << "overlapping tiers";
    EXPECT_EQ(recorded("fomes_fomentarius"), Habit::tier) << "several on one trunk";
    EXPECT_EQ(recorded("tremella_mesenterica"), Habit::tier) << "several on a branch";
    EXPECT_EQ(recorded("pleurotus_ostreatus"), Habit::tier);
    const Species unsaid;
    EXPECT_EQ(habit_of(unsaid), Habit::troop);
}

TEST(ColonySpec, StemsCarryCapsAndOtherFormsAreWholeIndividuals) {
    for (const char* id : {"amanita_muscaria", "boletus_edulis", "cantharellus_cibarius",
                           "hydnum_repandum", "morchella_esculenta", "phallus_impudicus"})
        EXPECT_TRUE(colony_traits(colony_of(id), atlas()).capped) << id;
    for (const char* id : {"disciotis_venosa", "lycoperdon_perlatum", "geastrum_triplex",
                           "tremella_mesenterica", "trametes_versicolor", "pleurotus_ostreatus"})
        EXPECT_FALSE(colony_traits(colony_of(id), atlas()).capped) << id;
    EXPECT_TRUE(colony_traits(colony_of("fomes_fomentarius"), atlas()).lateral);
    ColonySpec mix = colony_of("armillaria_mellea");
    mix.mix = {{"armillaria_mellea", 600}, {"lycoperdon_perlatum", 400}};
    EXPECT_FALSE(colony_traits(mix, atlas()).capped);
    EXPECT_EQ(colony_traits(mix, atlas()).habit, Habit::tuft) << "that of the most weight";
    std::swap(mix.mix[0].weight, mix.mix[1].weight);
    EXPECT_EQ(colony_traits(mix, atlas()).habit, Habit::troop);
}

TEST(ColonySpec, OneSeedIsAnotherLayoutInEachSetOfSpecies) {
    const auto seed = [](const ColonySpec& spec) { return colony_traits(spec, atlas()).seed; };
    ColonySpec one = colony_of("armillaria_mellea");
    EXPECT_NE(seed(one), seed(colony_of("hypholoma_fasciculare")));
    ColonySpec next = one;
    next.params.seed = 2;
    EXPECT_NE(seed(one), seed(next));
    next.params.seed = one.params.seed;
    next.params.age = 0.9;
    EXPECT_EQ(seed(one), seed(next));
    ColonySpec mix = one;
    mix.mix = {{"armillaria_mellea", 600}, {"hypholoma_fasciculare", 400}};
    EXPECT_NE(seed(mix), seed(one));
    ColonySpec other = one;
    other.mix = {{"hypholoma_fasciculare", 700}, {"armillaria_mellea", 300}};
    EXPECT_EQ(seed(mix), seed(other)) << "weights and order move nothing";
}

TEST(ColonySpec, RootsAreShownWhereThereAreSome) {
    ColonySpec spec = colony_of("armillaria_mellea");
    EXPECT_EQ(colony_traits(spec, atlas()).roots, RootsShown::buried);
    spec.params.habit = Habit::rooted;
    EXPECT_EQ(colony_traits(spec, atlas()).roots, RootsShown::shown);
    spec.params.roots = RootsShown::buried;
    EXPECT_EQ(colony_traits(spec, atlas()).roots, RootsShown::buried);
}

TEST(ColonySpec, TiersStandOnTheWoodThatIsRecorded) {
    const auto wood = [](const std::string& id, std::optional<Substrate> given = {}) {
        ColonySpec spec = colony_of(id);
        spec.params.substrate = given;
        return colony_traits(spec, atlas()).substrate;
    };
    EXPECT_EQ(wood("fomes_fomentarius"), Substrate::birch);
    EXPECT_EQ(wood("pleurotus_ostreatus"), Substrate::beech);
    EXPECT_EQ(wood("trametes_versicolor"), Substrate::beech) << "of broad-leaved trees";
    EXPECT_EQ(wood("tremella_mesenterica"), Substrate::oak);
    EXPECT_EQ(wood("fomes_fomentarius", Substrate::none), Substrate::none);
    EXPECT_EQ(wood("fomes_fomentarius", Substrate::spruce), Substrate::spruce);
    EXPECT_EQ(wood("armillaria_mellea"), Substrate::none) << "no tier";
    EXPECT_EQ(wood("armillaria_mellea", Substrate::none), Substrate::none);
}

TEST(ColonySpec, IncompatibleParametersAreRefusedByName) {
    const auto problems = [](const std::string& id, auto change) {
        ColonySpec spec = colony_of(id);
        change(spec.params);
        return refusal([&] { (void)colony_traits(spec, atlas()); });
    };
    EXPECT_TRUE(names(problems("trametes_versicolor", [](auto& p) { p.habit = Habit::ring; }),
                      "/habit", "wall"));
    EXPECT_TRUE(names(problems("armillaria_mellea", [](auto& p) { p.roots = RootsShown::shown; }),
                      "/roots", "habit=rooted"));
    EXPECT_TRUE(names(problems("armillaria_mellea", [](auto& p) { p.growth.depth = 3; }), "/depth",
                      "habit=rooted"));
    EXPECT_TRUE(names(problems("armillaria_mellea", [](auto& p) { p.growth.stem_decay = 0.1; }),
                      "/stem_decay", "habit=rooted"));
    EXPECT_TRUE(names(problems("armillaria_mellea", [](auto& p) { p.trunk_radius = 0.2; }),
                      "/trunk_radius", "habit=tier"));
    EXPECT_TRUE(names(problems("armillaria_mellea", [](auto& p) { p.substrate = Substrate::oak; }),
                      "/substrate", "habit=tier"));
    EXPECT_TRUE(names(problems("lycoperdon_perlatum", [](auto& p) { p.cap_scale = 2.0; }),
                      "/cap_scale", "whole"));
    EXPECT_TRUE(names(problems("lycoperdon_perlatum", [](auto& p) { p.growth.stem_height = 0.1; }),
                      "/stem_height", "without a stem"));
    EXPECT_TRUE(names(problems("armillaria_mellea", [](auto& p) { p.count = 257; }), "/count"));
    EXPECT_TRUE(names(problems("armillaria_mellea", [](auto& p) { p.distinct = 0; }), "/distinct"));
    EXPECT_TRUE(names(problems("armilaria", [](auto&) {}), "mix", "no species"));
    EXPECT_TRUE(problems("armillaria_mellea",
                         [](auto& p) {
                             p.growth.stem_height = 0.1;
                             p.growth.stem_displacement = 0.02;
                             p.growth.stem_segments = 3;
                             p.growth.root_radius = 0.003;
                         })
                    .empty())
        << "every habit with stems has these";
    ColonySpec nobody;
    EXPECT_TRUE(names(refusal([&] { (void)colony_traits(nobody, atlas()); }), "mix"));
}

}  // namespace
}  // namespace sporeprint::colony_colony_spec_test
