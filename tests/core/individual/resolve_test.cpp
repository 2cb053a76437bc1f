#include "core/individual/resolve.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

#include "core/individual/proportion.h"
#include "core/params/canonical.h"
#include "core/silhouette/weights.h"
#include "tests/support/effort.h"
#include "tests/support/meshes.h"
#include "tests/support/orders.h"

namespace sporeprint::individual_resolve_test {
namespace {

Model model_of(const MushroomSpec& spec) { return resolve(spec, atlas()).model; }

/// Returns the positions of all rings of LOD 0, base to apex.
std::vector<glm::dvec2> places_of(const Individual& individual) {
    std::vector<glm::dvec2> places;
    for (const CurveName curve : curve_names)
        for (const OutlineSample& sample : individual.outline.rings(curve, 0))
            places.emplace_back(sample.r, sample.y);
    return places;
}

/// Returns the largest distance between corresponding points.
double largest_move(const std::vector<glm::dvec2>& a, const std::vector<glm::dvec2>& b) {
    EXPECT_EQ(a.size(), b.size());
    double most = 0.0;
    for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i)
        most = std::max(most, glm::distance(a[i], b[i]));
    return most;
}

/// Returns the model with the counts of the whole set of stages.
Model with_counts_of(Model model, const Model& set) {
    model.hymenium.blades = set.hymenium.blades;
    model.hymenium.tiers = set.hymenium.tiers;
    model.surface.cap.fibril_count = set.surface.cap.fibril_count;
    model.surface.cap.zone_count = set.surface.cap.zone_count;
    return model;
}

TEST(Resolve, WithoutVariationStagesEqualTheirTemplates) {
    for (const AtlasEntry& entry : swept_atlas().entries())
        for (const Stage& stage : entry.species.stages) {
            MushroomSpec spec = order_of(entry.species.id.string(), stage.age);
            spec.params.variation = 0.0;
            const Individual found = resolve(spec, atlas());
            const Outline drawn(silhouette_of(stage.model));
            const double size = drawn.stem.length() + drawn.cap.length();
            for (const CurveName curve : curve_names) {
                EXPECT_EQ(found.outline.of(curve).empty(), drawn.of(curve).empty());
                if (drawn.of(curve).empty()) continue;
                for (int i = 0; i <= 50; ++i) {
                    const OutlineSample a = found.outline.of(curve).at(i / 50.0);
                    const OutlineSample b = drawn.of(curve).at(i / 50.0);
                    EXPECT_LT(std::hypot(a.r - b.r, a.y - b.y), 2e-3 * size)
                        << entry.species.id.string() << ' ' << stage.age << ' ' << name(curve);
                }
            }
            ASSERT_EQ(found.parts.size(), 1u);
            EXPECT_EQ(found.parts[0].model, with_counts_of(stage.model, found.parts[0].model));
            Model model = with_counts_of(stage.model, found.model);
            model.shape = Swept{};
            EXPECT_EQ(found.model, model) << entry.species.id.string() << ' ' << stage.age;
        }
}

TEST(Resolve, BetweenStagesAgesBlendLinearly) {
    const auto& stages = atlas().find("boletus_edulis")->species.stages;
    ASSERT_GE(stages.size(), 3u);
    // Rings follow the outline's bends; points at equal values of the parameter move along straight
    // lines.
    const auto at = [](double age) {
        MushroomSpec spec = order_of("boletus_edulis", age);
        spec.params.variation = 0.0;
        const Outline outline = resolve(spec, atlas()).outline;
        std::vector<double> even;
        for (int i = 0; i <= 20; ++i) even.push_back(i / 20.0);
        std::vector<glm::dvec2> places;
        for (const CurveName curve : curve_names)
            for (const OutlineSample& place : outline.of(curve).placed(even))
                places.emplace_back(place.r, place.y);
        return places;
    };
    const auto a = at(stages[0].age), b = at(stages[1].age);
    const auto found = at(0.25 * stages[0].age + 0.75 * stages[1].age);
    for (std::size_t i = 0; i < found.size(); ++i)
        EXPECT_LT(glm::distance(found[i], 0.25 * a[i] + 0.75 * b[i]), 1e-12);
}

TEST(Resolve, GrowthIsContinuous) {
    for (const std::string& id : swept_ids()) {
        MushroomSpec spec = order_of(id, 0.0, 5);
        spec.params.variation = 1.0;
        const int steps = static_cast<int>(effort(400, 20, 400));
        spec.params.age = (400 - steps) / 400.0;
        auto last = places_of(resolved(spec));
        for (int step = 400 - steps + 1; step <= 400; ++step) {
            spec.params.age = step / 400.0;
            const auto next = places_of(resolved(spec));
            EXPECT_LT(largest_move(last, next), 0.05 * std::max(0.01, next.back().y))
                << id << " at age " << spec.params.age;
            last = next;
        }
    }
}

TEST(Resolve, WithoutVariationAllSeedsHaveTheSameProportions) {
    for (const std::string& id : species_ids()) {
        MushroomSpec spec = order_of(id, 0.45, 1);
        spec.params.variation = 0.0;
        const Individual first = resolved(spec);
        for (std::uint32_t seed = 2; seed < 20; ++seed) {
            spec.params.seed = seed;
            const Individual other = resolved(spec);
            EXPECT_EQ(other.model, first.model);
            EXPECT_EQ(other.lightness, 1.0);
        }
    }
}

TEST(Resolve, VariationStaysWithinTheSpreadOfItsSpecies) {
    for (const AtlasEntry& entry : swept_atlas().entries()) {
        const Species& species = entry.species;
        const Spread& spread = species.spread;
        MushroomSpec spec = order_of(species.id.string(), 0.6);
        spec.params.variation = 0.0;
        const Individual plain = resolved(spec);
        const auto stem_length = [](const Individual& i) { return i.stem_top; };
        const auto cap_height = [](const Individual& i) {
            return i.outline.cap.at(1.0).y - i.outline.cap.at(0.0).y;
        };
        spec.params.variation = 1.0;
        double most_length = 0.0, least_length = 1e9;
        const std::size_t seeds = effort(300);
        for (std::uint32_t seed = 0; seed < seeds; ++seed) {
            spec.params.seed = seed;
            const Individual individual = resolved(spec);
            const auto within = [&](double factor, double log_spread) {
                return std::abs(std::log(factor)) <= log_spread + 1e-3;
            };
            const double width =
                greatest_radius(individual.outline.stem) / greatest_radius(plain.outline.stem);
            // The widest point of a bulb lies between the sampled ones.
            EXPECT_TRUE(within(width, spread.size + spread.stem_width + 0.005))
                << species.id.view() << ' ' << seed;
            if (stem_length(plain) > 0.0) {
                const double length = stem_length(individual) / stem_length(plain);
                EXPECT_TRUE(within(length, spread.size + spread.stem_length)) << seed;
                most_length = std::max(most_length, length);
                least_length = std::min(least_length, length);
            }
            const double height = cap_height(individual) / cap_height(plain);
            EXPECT_TRUE(within(height, spread.size + spread.cap_height)) << seed;
            EXPECT_TRUE(within(individual.lightness, spread.lightness)) << seed;
            const auto &d = individual.model.deformation, &t = plain.model.deformation;
            EXPECT_LE(d.bend_deg, t.bend_deg + spread.bend_deg);
            EXPECT_LE(d.lean_deg, t.lean_deg + spread.lean_deg);
            EXPECT_LE(d.imperfection, t.imperfection + spread.imperfection);
            // A draw from 0.6 to 1, and 0.8 of it at age 0.6.
            EXPECT_LE(d.irregularity, t.irregularity + 0.8 * spread.irregularity + 1e-12);
            EXPECT_GE(d.irregularity, t.irregularity + 0.48 * spread.irregularity - 1e-12);
            EXPECT_GE(d.bend_deg, 0.0);
            EXPECT_EQ(d.twist_deg, t.twist_deg);
        }
        if (stem_length(plain) > 0.0 && spread.size > 0.0 && seeds >= 300) {
            const double reach = std::exp(0.6 * spread.size);
            EXPECT_GT(most_length, reach) << "three hundred individuals use the spread";
            EXPECT_LT(least_length, 1.0 / reach);
        }
    }
}

TEST(Resolve, OneSeedIsAnotherIndividualInEachSpecies) {
    // The draws of two species for as many seeds are not correlated: their lightness, whose spread
    // is divided out, would be the same draw otherwise.
    const std::vector<std::string> ids{"amanita_muscaria", "boletus_edulis", "russula_emetica",
                                       "coprinus_comatus"};
    const auto draw = [](const std::string& id, std::uint32_t seed) {
        return std::log(resolved(order_of(id, 0.6, seed)).lightness) /
               atlas().find(id)->species.spread.lightness;
    };
    constexpr std::uint32_t seeds = 64;
    for (std::size_t i = 1; i < ids.size(); ++i) {
        double product = 0.0, one = 0.0, other = 0.0;
        for (std::uint32_t seed = 1; seed <= seeds; ++seed) {
            const double a = draw(ids[0], seed), b = draw(ids[i], seed);
            product += a * b;
            one += a * a;
            other += b * b;
        }
        EXPECT_LT(std::abs(product), 0.4 * std::sqrt(one * other)) << ids[i];
    }
}

TEST(Resolve, TheDrawsOfAMixAreTheMeansOfThoseOfItsSpecies) {
    const auto irregularity = [](const Mix& mix, std::uint32_t seed) {
        MushroomSpec spec;
        spec.mix = mix;
        spec.params.seed = seed;
        return resolved(spec).model.deformation.irregularity;
    };
    // Two species of one spread.
    const std::string a = "russula_emetica", b = "boletus_edulis";
    ASSERT_EQ(atlas().find(a)->species.spread.irregularity,
              atlas().find(b)->species.spread.irregularity);
    const auto weights = eased_weights({0.25, 0.75});
    for (std::uint32_t seed = 1; seed <= 8; ++seed)
        EXPECT_NEAR(irregularity({{a, 250}, {b, 750}}, seed),
                    weights[0] * irregularity({{a, 1000}}, seed) +
                        weights[1] * irregularity({{b, 1000}}, seed),
                    1e-12);
}

TEST(Resolve, SizeScalesUniformly) {
    for (const std::string& id : swept_ids()) {
        MushroomSpec spec = order_of(id, 0.6, 8);
        const Individual one = resolved(spec);
        spec.params.size = 4.0;
        const Individual four = resolved(spec);
        const auto a = places_of(one), b = places_of(four);
        for (std::size_t i = 0; i < a.size(); ++i)
            EXPECT_LT(glm::distance(b[i], 4.0 * a[i]), 1e-12);
        EXPECT_EQ(one.ring.height, four.ring.height);
        EXPECT_NEAR(four.ring.width, 4.0 * one.ring.width, 1e-12);
        EXPECT_EQ(one.axis, four.axis);
        EXPECT_EQ(one.model.deformation, four.model.deformation);
        EXPECT_EQ(one.model.surface, four.model.surface);
    }
}

TEST(Resolve, ImpossibleOverridesAreRefusedAndNamed) {
    const auto refused = [](const std::string& id, auto member, auto field, auto amount) {
        MushroomSpec spec = order_of(id);
        (spec.params.*member).*field = amount;
        std::vector<Problem> problems;
        try {
            (void)resolve(spec, atlas());
        } catch (const Impossible& impossible) {
            problems = impossible.problems();
        }
        return problems;
    };
    using P = MushroomParams;
    using H = HymeniumOf<Maybe>;
    using O = OrnamentsOf<Maybe>;
    EXPECT_TRUE(names(refused("boletus_edulis", &P::hymenium, &H::blades, 60), "/hymenium/blades",
                      "Boletus edulis carries pores, not gills"));
    EXPECT_TRUE(
        names(refused("boletus_edulis", &P::hymenium, &H::tiers, 1), "/hymenium/tiers", "pores"));
    EXPECT_TRUE(names(refused("amanita_muscaria", &P::hymenium, &H::pores_per_mm, 1.0),
                      "/hymenium/pores_per_mm", "carries gills, not pores"));
    EXPECT_TRUE(names(refused("cantharellus_cibarius", &P::hymenium, &H::pores_per_mm, 1.0),
                      "/hymenium/pores_per_mm", "carries ridges, not pores"));
    EXPECT_TRUE(names(refused("clavariadelphus_pistillaris", &P::hymenium, &H::blades, 60),
                      "/hymenium/blades", "smooth"));
    EXPECT_TRUE(names(refused("russula_vinosa", &P::hymenium, &H::forking, 0.5),
                      "/hymenium/forking", "do not fork"));
    EXPECT_TRUE(names(refused("russula_vinosa", &P::ornaments, &O::warts, 0.5), "/ornaments/warts",
                      "no universal veil"));
    EXPECT_TRUE(names(refused("amanita_muscaria", &P::ornaments, &O::scales, 0.5),
                      "/ornaments/scales", "does not tear"));
    EXPECT_TRUE(names(refused("boletus_edulis", &P::ornaments, &O::ring, 1.0), "/ornaments/ring",
                      "no partial veil"));
    EXPECT_TRUE(names(refused("clavariadelphus_pistillaris", &P::ornaments, &O::warts, 0.5),
                      "/ornaments/warts", "no cap skin that could carry warts"));
    EXPECT_TRUE(names(refused("amanita_muscaria", &P::hymenium, &H::elongation, 2.0),
                      "/hymenium/elongation", "carries gills, not pores"));
    EXPECT_TRUE(names(refused("disciotis_venosa", &P::hymenium, &H::decurrent, 0.5),
                      "/hymenium/decurrent", "has a smooth lower face"));
    EXPECT_TRUE(names(refused("boletus_edulis", &P::hymenium, &H::thickness, 0.5),
                      "/hymenium/thickness", "carries pores, not gills"));
    EXPECT_TRUE(names(
        refused("clavariadelphus_pistillaris", &P::weathering, &WeatheringOf<Maybe>::waves, 0.5),
        "/weathering/waves", "has no margin that could wave"));
    // A zero amount of something that the species lacks is valid.
    EXPECT_TRUE(refused("russula_vinosa", &P::ornaments, &O::warts, 0.0).empty());
    EXPECT_TRUE(refused("russula_vinosa", &P::hymenium, &H::forking, 0.0).empty());
    EXPECT_TRUE(refused("cantharellus_cibarius", &P::hymenium, &H::forking, 0.7).empty());
}

TEST(Resolve, BracketsStandOnTheWoodOfTheirHeaviestSpecies) {
    const auto resolved_on = [](const Mix& mix, std::optional<Substrate> wanted = {}) {
        MushroomSpec spec = mix_of(mix);
        spec.params.substrate = wanted;
        return resolved(spec);
    };
    const auto wood = [&](const Mix& mix) { return resolved_on(mix).effective.substrate; };
    EXPECT_EQ(wood({{"fomes_fomentarius", 1000}}), Substrate::birch);
    EXPECT_EQ(wood({{"fomes_fomentarius", 600}, {"trametes_versicolor", 400}}), Substrate::birch);
    EXPECT_EQ(wood({{"fomes_fomentarius", 400}, {"trametes_versicolor", 600}}), Substrate::beech);
    EXPECT_EQ(wood({{"amanita_muscaria", 1000}}), std::nullopt);
    EXPECT_EQ(wood({{"amanita_muscaria", 550}, {"trametes_versicolor", 450}}), Substrate::beech)
        << "not the birches under which the fly agaric stands";
    EXPECT_EQ(wood({{"amanita_muscaria", 900}, {"trametes_versicolor", 100}}), std::nullopt)
        << "hardly a bracket";
    const auto bent = [&](const Mix& mix, std::optional<Substrate> wanted = {}) {
        const Individual individual = resolved_on(mix, wanted);
        return individual.trunk_radius > 0.0 ? individual.bending_radius() / individual.trunk_radius
                                             : 0.0;
    };
    EXPECT_EQ(bent({{"trametes_versicolor", 1000}}), 1.0);
    EXPECT_EQ(bent({{"trametes_versicolor", 1000}}, Substrate::none), 0.0) << "a flat wall";
    EXPECT_GT(bent({{"amanita_muscaria", 500}, {"trametes_versicolor", 500}}), 1.0)
        << "what is less of a bracket follows the trunk less";
    MushroomSpec grounded = order_of("amanita_muscaria");
    grounded.params.substrate = Substrate::oak;
    EXPECT_TRUE(names(refusal([&] { (void)resolved(grounded); }), "/substrate",
                      "Amanita muscaria stands on the ground"));
}

TEST(Resolve, AllImpossibleOverridesAreReportedAtOnce) {
    MushroomSpec spec = order_of("boletus_edulis");
    spec.params.hymenium.blades = 60;
    spec.params.ornaments.warts = 1.0;
    spec.params.ornaments.ring = 1.0;
    EXPECT_EQ(refusal([&] { (void)resolved(spec); }).size(), 3u);
}

TEST(Resolve, InvalidRequestsAreRefusedAndNamed) {
    EXPECT_TRUE(names(refusal([] { (void)resolve(order_of("toadstool"), atlas()); }), "mix",
                      "'toadstool'"));
    MushroomSpec spec = order_of("boletus_edulis");
    spec.mix.push_back({"boletus_edulis", 500});
    EXPECT_TRUE(names(refusal([&] { (void)resolved(spec); }), "mix", "named twice"));
    spec.mix.back() = {"amanita_muscaria", 0};
    EXPECT_TRUE(names(refusal([&] { (void)resolved(spec); }), "mix", "not positive"));
    spec.mix.clear();
    EXPECT_TRUE(names(refusal([&] { (void)resolved(spec); }), "mix", "1 to 8"));
    spec = order_of("boletus_edulis");
    spec.arcs.push_back({CurveName::cap, 0.3, 0.5});
    EXPECT_TRUE(names(refusal([&] { (void)resolved(spec); }), "/arcs", "two species"));
    spec = order_of("boletus_edulis", 1.2);
    spec.params.size = std::nan("");
    spec.params.deformation.bend_deg = 91.0;
    const auto problems = refusal([&] { (void)resolved(spec); });
    EXPECT_TRUE(names(problems, "/age", "1.2"));
    EXPECT_TRUE(names(problems, "/size"));
    EXPECT_TRUE(names(problems, "/deformation/bend_deg", "91"));
    spec = order_of("boletus_edulis");
    spec.params.deformation.zone_from = 0.5;
    spec.params.deformation.zone_to = 0.5;
    EXPECT_TRUE(names(refusal([&] { (void)resolved(spec); }), "/deformation/zone_to"));
    // The rule holds across the overrides and the values of the species.
    spec.params.deformation.zone_to.reset();
    spec.params.deformation.zone_from = 0.9;
    EXPECT_TRUE(refusal([&] { (void)resolved(spec); }).empty()) << "0.9 to 1 is a zone";
    spec.params.deformation.zone_from.reset();
    spec.params.deformation.zone_to = 0.1;
    EXPECT_TRUE(refusal([&] { (void)resolved(spec); }).empty()) << "0 to 0.1 is a zone";
}

TEST(Resolve, ACustomModelIsNotVaried) {
    MushroomSpec spec = order_of("x", 0.2, 77);
    spec.mix.clear();
    spec.model = atlas().find("cantharellus_cibarius")->species.stages[1].model;
    spec.params.variation = 1.0;
    Model bodiless = *spec.model;
    bodiless.shape = Swept{};
    EXPECT_EQ(model_of(spec), bodiless) << "age and variation do not touch it";
    EXPECT_EQ(resolved(spec).parts[0].model, *spec.model);
    spec.params.weathering.fade = 0.3;
    EXPECT_EQ(model_of(spec).weathering.fade, 0.3);
    std::get<Swept>(spec.model->shape).silhouette.stem[0].r = 0.001;
    EXPECT_TRUE(names(refusal([&] { (void)resolved(spec); }), "/model/silhouette/stem/0/r",
                      "off the axis"));
}

/// Calls `use` with each optional of the request, its path, and the value of the same place in
/// `effective`.
template <class T, class Use>
void each_wish(const T& requested, const T& effective, const std::string& path, const Use& use) {
    T::fields([&](auto member, const Info& info) {
        const auto &a = requested.*member, &e = effective.*member;
        using Member = std::remove_cvref_t<decltype(a)>;
        if constexpr (is_optional<Member>)
            use(a, e, path + '/' + info.name);
        else if constexpr (Described<Member>)
            each_wish(a, e, path + '/' + info.name, use);
    });
}

TEST(Resolve, GrantedOverridesAreExact) {
    int granted = 0;
    EXPECT_TRUE(rc::check("random overrides", [&] {
        MushroomSpec spec = order_of(*rc::gen::elementOf(species_ids()));
        spec.params = arbitrary_params();
        try {
            const Individual individual = resolved(spec);
            ++granted;
            each_wish(spec.params, individual.effective, "",
                      [](const auto& requested, const auto& effective, const std::string& path) {
                          // A zero override of something that the species lacks is the same as
                          // none.
                          if (requested && effective && *requested != *effective) RC_FAIL(path);
                          if (requested && !effective &&
                              *requested != std::remove_cvref_t<decltype(*requested)>{})
                              RC_FAIL(path + " is lost");
                      });
            RC_ASSERT(individual.effective.age == spec.params.age);
            RC_ASSERT(individual.effective.seed == spec.params.seed);
            RC_ASSERT(problems_in(individual.effective).empty());
        } catch (const InvalidInput& refused) {
            for (const Problem& problem : refused.problems())
                RC_ASSERT(problem.path.starts_with("/hymenium/") ||
                          problem.path.starts_with("/ornaments/") ||
                          problem.path.starts_with("/weathering/") ||
                          problem.path == "/deformation/irregularity" ||
                          problem.path == "/deformation/zone_to" || problem.path == "/substrate");
        }
    }));
    // Most random requests ask for something that a species cannot have.
    EXPECT_GT(granted, 0);
}

TEST(Resolve, EffectiveParametersReproduceTheIndividual) {
    for (const std::string& id : swept_ids())
        for (std::uint32_t seed = 1; seed <= 8; ++seed) {
            MushroomSpec spec = textured(order_of(id, seed / 8.0, seed, 1));
            spec.params.variation = 1.0;
            spec.params.deformation.twist_deg = 30.0;
            const Individual first = resolved(spec);
            MushroomSpec again = spec;
            again.params = first.effective;
            const Individual second = resolve(again, atlas());
            EXPECT_EQ(second.model, first.model) << id << ' ' << seed;
            EXPECT_EQ(places_of(second), places_of(first));
            EXPECT_EQ(second.lightness, first.lightness);
            EXPECT_EQ(canonical_text(second.effective), canonical_text(first.effective));
            EXPECT_TRUE(same_bits(mushroom_mesh(spec, first), mushroom_mesh(again, second)));
        }
}

TEST(Resolve, NaturalBendsNeverFoldTheStem) {
    for (const std::string& id : species_ids())
        for (int step = 0; step <= 8; ++step)
            for (std::uint32_t seed = 0; seed < effort(12); ++seed) {
                MushroomSpec spec = order_of(id, step / 8.0, seed, 3);
                spec.params.variation = 1.0;
                const auto problems = refusal([&] { (void)mesh_of(spec); });
                EXPECT_TRUE(problems.empty()) << id << ' ' << spec.params.age << ' ' << seed << ": "
                                              << problems[0].path << ' ' << problems[0].message;
            }
}

}  // namespace
}  // namespace sporeprint::individual_resolve_test
