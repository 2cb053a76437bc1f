// Mixes of species: the resolved individual of several species.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <string>
#include <vector>

#include "core/individual/proportion.h"
#include "core/math/purposes.h"
#include "core/params/reader.h"
#include "core/silhouette/weights.h"
#include "tests/support/orders.h"

namespace sporeprint::individual_mix_test {
namespace {

std::vector<glm::dvec2> places_of(const Individual& individual) {
    std::vector<glm::dvec2> places;
    for (const CurveName curve : curve_names)
        for (const OutlineSample& sample : individual.outline.rings(curve, 0))
            places.emplace_back(sample.r, sample.y);
    return places;
}

double largest_move(const Individual& one, const Individual& other, double scale = 1.0) {
    const auto a = places_of(one), b = places_of(other);
    EXPECT_EQ(a.size(), b.size());
    double most = 0.0;
    for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i)
        most = std::max(most, glm::distance(scale * a[i], b[i]));
    return most;
}

using Change = std::function<void(Model&)>;

/// Returns an atlas of a built-in species and its twin "twin", each stage of which is changed.
Atlas with_twin(const std::string& id, const Change& change = {}) {
    const Species& species = atlas().find(id)->species;
    Species twin = species;
    twin.id = Text<48>("twin");
    if (change)
        for (Stage& stage : twin.stages) change(stage.model);
    return Atlas({.species = {dump(write(species)), dump(write(twin))}});
}

Silhouette& drawn(Model& model) { return std::get<Swept>(model.shape).silhouette; }

TEST(Mix, OfTwinsIsTheSpecies) {
    for (const std::string& id : swept_ids()) {
        const Atlas twins = with_twin(id);
        for (const double age : {0.0, 0.45, 1.0}) {
            MushroomSpec spec = mix_of({{id, 300}, {"twin", 700}}, age, 5);
            spec.params.variation = 0.0;  // draws belong to the names of species
            const Individual both = resolve(spec, twins);
            spec.mix = {{id, 1000}};
            const Individual lone = resolve(spec, twins);
            EXPECT_LT(largest_move(lone, both), 1e-3 * places_of(lone).back().y) << id << age;
            EXPECT_EQ(both.layers.size(), lone.layers.size()) << "equal places share a layer";
            for (const PatchLayer& layer : both.layers) EXPECT_NEAR(layer.weight, 1.0, 1e-15);
            EXPECT_NEAR(both.ring.width, lone.ring.width, 1e-12);
            EXPECT_EQ(both.gill_layout, lone.gill_layout);
            EXPECT_EQ(both.has_ring, lone.has_ring);
            EXPECT_NEAR(both.lightness, lone.lightness, 1e-12);
            EXPECT_NEAR(both.model.deformation.bend_deg, lone.model.deformation.bend_deg, 1e-3);
        }
    }
}

TEST(Mix, OfASingleSpeciesDoesNotDependOnItsWeight) {
    for (const int weight : {1, 7, 1000}) {
        MushroomSpec spec = order_of("boletus_edulis", 0.5, 4);
        const Individual thousand = resolve(spec, atlas());
        spec.mix[0].weight = weight;
        const Individual other = resolve(spec, atlas());
        EXPECT_EQ(places_of(other), places_of(thousand));
        EXPECT_EQ(other.model, thousand.model);
    }
}

TEST(Mix, SizesBlendGeometrically) {
    const Atlas twins = with_twin("russula_vinosa", [](Model& model) {
        for (auto* part : {&drawn(model).stem, &drawn(model).hymenium, &drawn(model).cap})
            for (OutlinePoint& p : *part) p = {4.0 * p.r, 4.0 * p.y};
    });
    MushroomSpec spec = order_of("russula_vinosa");
    spec.params.variation = 0.0;
    const Individual one = resolve(spec, twins);
    for (const int weight : {250, 500, 900}) {
        spec.mix = {{"russula_vinosa", 1000 - weight}, {"twin", weight}};
        const Individual mixed = resolve(spec, twins);
        const double scale = std::pow(4.0, eased_weights({1000.0 - weight, 1.0 * weight})[1]);
        EXPECT_LT(largest_move(one, mixed, scale), 2e-3 * scale * places_of(one).back().y);
    }
}

TEST(Mix, OppositeAxesCancelAndTheStemKeepsItsLength) {
    const auto bend = [](double by) {
        return [by](Model& model) {
            std::get<Swept>(model.shape).axis = {{0.0, 0.0, 0.0}, {by, 0.5, 0.0}, {0.0, 1.0, 0.0}};
        };
    };
    Species species = atlas().find("mycena_sanguinolenta")->species, other = species;
    other.id = Text<48>("twin");
    for (Stage& stage : species.stages) bend(0.15)(stage.model);
    for (Stage& stage : other.stages) bend(-0.15)(stage.model);
    const Atlas twins({.species = {dump(write(species)), dump(write(other))}});
    MushroomSpec spec = mix_of({{"mycena_sanguinolenta", 1000}});
    spec.params.variation = 0.0;
    const Individual bent = resolve(spec, twins);
    spec.mix = {{"mycena_sanguinolenta", 500}, {"twin", 500}};
    const Individual straight = resolve(spec, twins);
    EXPECT_GT(bent.axis.greatest_turn(), 0.5);
    EXPECT_LT(straight.axis.greatest_turn(), 1e-12);
    EXPECT_NEAR(straight.stem_top - straight.stem_base, bent.stem_top - bent.stem_base,
                1e-3 * bent.stem_top);
}

TEST(Mix, EachSpeciesAddsItsPatchesAtItsWeight) {
    const Atlas twins = with_twin("amanita_muscaria", [](Model& model) {
        model.warts.count = 30;
        model.warts.height = 1.5;
    });
    const MushroomSpec spec = mix_of({{"amanita_muscaria", 600}, {"twin", 400}});
    const Individual mixed = resolve(spec, twins);
    std::vector<PatchLayer> warts;
    for (const PatchLayer& layer : mixed.layers)
        if (layer.purpose == purposes::warts) warts.push_back(layer);
    ASSERT_EQ(warts.size(), 2u);
    const auto weights = eased_weights({0.6, 0.4});
    EXPECT_NEAR(warts[0].weight, weights[0], 1e-15);
    EXPECT_NEAR(warts[1].weight, weights[1], 1e-15);
    EXPECT_EQ(warts[1].style.count, 30);
    // Species outside the mix contribute nothing.
    EXPECT_EQ(resolve(order_of("amanita_muscaria"), twins).layers.size(), mixed.layers.size() - 1);
    EXPECT_TRUE(resolve(order_of("boletus_edulis"), atlas()).layers.empty());
}

TEST(Mix, TheWidthOfARingIsTheWeightedSum) {
    const Atlas twins = with_twin("amanita_muscaria", [](Model& model) {
        model.ring = {0.2, 0.0, 0.0, 0.01, 1.0};
    });
    MushroomSpec spec = order_of("amanita_muscaria");
    spec.params.variation = 0.0;
    const Individual whole = resolve(spec, twins);
    ASSERT_GT(whole.ring.width, 0.0);
    for (const int weight : {1, 500, 900, 999}) {
        spec.mix = {{"amanita_muscaria", 1000 - weight}, {"twin", weight}};
        const Individual mixed = resolve(spec, twins);
        EXPECT_TRUE(mixed.has_ring);
        EXPECT_NEAR(mixed.ring.width,
                    eased_weights({1000.0 - weight, 1.0 * weight})[0] * whole.ring.width, 1e-12);
        EXPECT_EQ(mixed.ring.height, whole.ring.height) << "where the wider one is";
        EXPECT_NEAR(mixed.ring.thickness, whole.ring.thickness, 1e-12);
    }
    spec.mix = {{"twin", 1000}};
    EXPECT_FALSE(resolve(spec, twins).has_ring);
}

TEST(Mix, TheGillLayoutIsTheDensestOfTheSetForAllWeights) {
    const Atlas twins = with_twin("russula_vinosa", [](Model& model) {
        model.hymenium.blades = 40;
        model.hymenium.tiers = 3;
    });
    const Model& own = atlas().find("russula_vinosa")->species.stages[0].model;
    ASSERT_LT((GillLayout{own.hymenium.blades, own.hymenium.tiers}.at_margin()), 40L << 3);
    for (const int weight : {1, 500, 999})
        for (const double age : {0.0, 0.6, 1.0}) {
            const Individual mixed =
                resolve(mix_of({{"russula_vinosa", 1000 - weight}, {"twin", weight}}, age), twins);
            EXPECT_EQ(mixed.gill_layout, (GillLayout{40, 3}));
            EXPECT_EQ(mixed.effective.hymenium.blades, 40);
            EXPECT_EQ(mixed.parts[0].model.hymenium.blades, own.hymenium.blades)
                << "each is painted with its own";
        }
    // An override applies to all species.
    MushroomSpec spec = mix_of({{"russula_vinosa", 500}, {"twin", 500}});
    spec.params.hymenium.blades = 100;
    spec.params.hymenium.tiers = 0;
    EXPECT_EQ(resolve(spec, twins).gill_layout, (GillLayout{100, 0}));
    EXPECT_EQ(resolve(order_of("boletus_edulis"), atlas()).gill_layout, GillLayout{})
        << "pores have none";
}

TEST(Mix, OverridesThatNoSpeciesCanHaveAreRefused) {
    MushroomSpec spec = mix_of({{"amanita_muscaria", 500}, {"russula_vinosa", 500}});
    spec.params.hymenium.pores_per_mm = 2.0;
    spec.params.ornaments.scales = 0.5;
    const auto problems = refusal([&] { (void)resolve(spec, atlas()); });
    EXPECT_EQ(problems.size(), 2u);
    EXPECT_TRUE(names(problems, "/hymenium/pores_per_mm", "no species of this mix carries pores"));
    EXPECT_TRUE(names(problems, "/ornaments/scales", "no species of this mix"));
    // What one of them can have is granted to that one only.
    spec.mix[1].id = "boletus_edulis";
    spec.params.ornaments = {};
    spec.params.ornaments.warts = 0.25;
    const Individual mixed = resolve(spec, atlas());
    EXPECT_EQ(mixed.effective.hymenium.pores_per_mm, 2.0);
    EXPECT_EQ(mixed.effective.ornaments.warts, 0.25);
    EXPECT_FALSE(mixed.effective.ornaments.scales.has_value());
    for (const PatchLayer& layer : mixed.layers)
        EXPECT_TRUE(layer.purpose != purposes::warts || layer.amount == 0.25);
}

TEST(Mix, OnlyMarginsHaveWaves) {
    MushroomSpec spec = mix_of({{"clavariadelphus_pistillaris", 750}, {"russula_vinosa", 250}});
    spec.params.weathering.waves = 0.8;
    EXPECT_NEAR(resolve(spec, atlas()).waves, 0.8 * eased_weights({0.75, 0.25})[1], 1e-12);
}

TEST(Mix, TheOrderHasNoEffectAndArcsFollowTheirSpecies) {
    MushroomSpec spec = mix_of({{"amanita_muscaria", 400}, {"russula_vinosa", 600}}, 0.6, 9);
    spec.arcs = {{CurveName::cap, 0.3, 0.45}, {CurveName::stem, 0.5, 0.4}};
    const Individual first = resolve(spec, atlas());
    std::swap(spec.mix[0], spec.mix[1]);
    for (Arc& arc : spec.arcs) std::swap(arc.a, arc.b);
    const Individual second = resolve(spec, atlas());
    EXPECT_EQ(places_of(second), places_of(first));
    EXPECT_EQ(second.model, first.model);
    EXPECT_EQ(second.layers, first.layers);
    spec.arcs.clear();
    EXPECT_GT(largest_move(resolve(spec, atlas()), first), 1e-4) << "arcs change the way";
}

TEST(Mix, EightSpeciesAreBlendedAtOnce) {
    Mix mix;
    const auto ids = swept_ids();
    for (std::size_t i = 0; i < 8; ++i) mix.push_back({ids[i * ids.size() / 8], 125});
    const Individual mixed = resolve(mix_of(mix, 0.5, 2), atlas());
    EXPECT_EQ(mixed.parts.size(), 8u);
    double sum = 0.0;
    for (const SpeciesShare& part : mixed.parts) sum += part.weight;
    EXPECT_NEAR(sum, 1.0, 1e-12);
    mix.push_back({"a_ninth", 125});
    EXPECT_TRUE(names(refusal([&] { (void)resolve(mix_of(mix), atlas()); }), "mix", "1 to 8"));
}

TEST(Mix, CacheKeysOfTheCorrespondenceCoverItsInputs) {
    std::vector<std::string> keys;
    const GetOrCompute<MorphSet> listening = [&](const std::string& key, const auto& make) {
        keys.push_back(key);
        return make();
    };
    MushroomSpec spec = mix_of({{"amanita_muscaria", 400}, {"russula_vinosa", 600}});
    const auto key_after = [&](auto change) {
        change();
        (void)resolve(spec, atlas(), listening);
        return keys.back();
    };
    const std::string first = key_after([] {});
    EXPECT_EQ(key_after([&] { spec.mix[0].weight = 30; }), first);
    EXPECT_EQ(key_after([&] { spec.params.age = 0.1; }), first);
    EXPECT_EQ(key_after([&] { spec.params.seed = 8; }), first);
    EXPECT_EQ(key_after([&] { spec.params.lod = 3; }), first);
    EXPECT_EQ(key_after([&] { spec.params.deformation.bend_deg = 8.0; }), first);
    EXPECT_NE(key_after([&] { spec.arcs = {{CurveName::cap, 0.3, 0.45}}; }), first);
    EXPECT_NE(key_after([&] { spec.mix[0].id = "boletus_edulis"; }), first);
}

}  // namespace
}  // namespace sporeprint::individual_mix_test
