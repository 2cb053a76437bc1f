#include "core/model/resolve.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "core/params/canonical.h"
#include "tests/support/meshes.h"
#include "tests/support/orders.h"

namespace sporeprint {
namespace {

Model model_of(const MushroomOrder& order) { return resolve(order, atlas()).model; }

double greatest_radius(const std::vector<OutlinePoint>& points) {
    double radius = 0.0;
    for (const OutlinePoint& p : points) radius = std::max(radius, p.r);
    return radius;
}

TEST(Resolve, AtTheAgeOfAStageAnUnvariedIndividualIsTheTemplate) {
    for (const AtlasEntry& entry : atlas().entries())
        for (const Stage& stage : entry.species.stages) {
            MushroomOrder order = order_of(entry.species.id.string(), stage.age);
            order.params.variation = 0.0;
            Model model = model_of(order);
            const Silhouette &found = silhouette_of(model), &given = silhouette_of(stage.model);
            const auto close = [](const std::vector<OutlinePoint>& a,
                                  const std::vector<OutlinePoint>& b) {
                ASSERT_EQ(a.size(), b.size());
                for (std::size_t i = 0; i < a.size(); ++i) {
                    EXPECT_NEAR(a[i].r, b[i].r, 1e-15);
                    EXPECT_NEAR(a[i].y, b[i].y, 1e-15);
                }
            };
            close(found.stem, given.stem);
            close(found.hymenium, given.hymenium);
            close(found.cap, given.cap);
            model.shape = stage.model.shape;
            EXPECT_EQ(model, stage.model) << entry.species.id.string() << ' ' << stage.age;
        }
}

TEST(Resolve, BetweenStagesAgesBlendLinearly) {
    const auto& stages = atlas().find("boletus_edulis")->species.stages;
    ASSERT_GE(stages.size(), 3u);
    MushroomOrder order = order_of("boletus_edulis", 0.25 * stages[0].age + 0.75 * stages[1].age);
    order.params.variation = 0.0;
    const Silhouette found = silhouette_of(model_of(order));
    const Silhouette &a = silhouette_of(stages[0].model), &b = silhouette_of(stages[1].model);
    for (std::size_t i = 0; i < found.cap.size(); ++i) {
        EXPECT_NEAR(found.cap[i].r, 0.25 * a.cap[i].r + 0.75 * b.cap[i].r, 1e-12);
        EXPECT_NEAR(found.cap[i].y, 0.25 * a.cap[i].y + 0.75 * b.cap[i].y, 1e-12);
    }
}

TEST(Resolve, GrowingNeverJumps) {
    for (const std::string& id : species_ids()) {
        MushroomOrder order = order_of(id, 0.0, 5);
        order.params.variation = 1.0;
        Silhouette last = silhouette_of(model_of(order));
        for (int step = 1; step <= 400; ++step) {
            order.params.age = step / 400.0;
            const Silhouette next = silhouette_of(model_of(order));
            const double size = std::max(0.01, next.cap.back().y);
            for (std::size_t i = 0; i < next.cap.size(); ++i)
                EXPECT_LT(std::hypot(next.cap[i].r - last.cap[i].r, next.cap[i].y - last.cap[i].y),
                          0.05 * size)
                    << id << " at age " << order.params.age;
            last = next;
        }
    }
}

TEST(Resolve, WithoutVariationAllSeedsHaveTheSameProportions) {
    for (const std::string& id : species_ids()) {
        MushroomOrder order = order_of(id, 0.45, 1);
        order.params.variation = 0.0;
        const Individual first = resolve(order, atlas());
        for (std::uint32_t seed = 2; seed < 20; ++seed) {
            order.params.seed = seed;
            const Individual other = resolve(order, atlas());
            EXPECT_EQ(other.model, first.model);
            EXPECT_EQ(other.lightness, 1.0);
        }
    }
}

TEST(Resolve, VariationStaysWithinTheSpreadOfItsSpecies) {
    for (const AtlasEntry& entry : atlas().entries()) {
        const Species& species = entry.species;
        const Spread& spread = species.spread;
        MushroomOrder order = order_of(species.id.string(), 0.6);
        order.params.variation = 0.0;
        const Model plain = model_of(order);
        const Silhouette& s = silhouette_of(plain);
        order.params.variation = 1.0;
        double most_length = 0.0, least_length = 1e9;
        for (std::uint32_t seed = 0; seed < 300; ++seed) {
            order.params.seed = seed;
            const Individual individual = resolve(order, atlas());
            const Silhouette& v = silhouette_of(individual.model);
            const auto within = [&](double factor, double log_spread) {
                return std::abs(std::log(factor)) <= log_spread + 1e-9;
            };
            const double width = greatest_radius(v.stem) / greatest_radius(s.stem);
            EXPECT_TRUE(within(width, spread.size + spread.stem_width)) << seed;
            if (s.stem.back().y > 0.0) {
                const double length = v.stem.back().y / s.stem.back().y;
                EXPECT_TRUE(within(length, spread.size + spread.stem_length)) << seed;
                most_length = std::max(most_length, length);
                least_length = std::min(least_length, length);
            }
            const double height =
                (v.cap.back().y - v.cap.front().y) / (s.cap.back().y - s.cap.front().y);
            EXPECT_TRUE(within(height, spread.size + spread.cap_height)) << seed;
            EXPECT_TRUE(within(individual.lightness, spread.lightness)) << seed;
            const auto &d = individual.model.deformation, &t = plain.deformation;
            EXPECT_LE(d.bend_deg, t.bend_deg + spread.bend_deg);
            EXPECT_LE(d.lean_deg, t.lean_deg + spread.lean_deg);
            EXPECT_LE(d.imperfection, t.imperfection + spread.imperfection);
            EXPECT_GE(d.bend_deg, 0.0);
            EXPECT_EQ(d.twist_deg, t.twist_deg);
        }
        if (s.stem.back().y > 0.0 && spread.size > 0.0) {
            const double reach = std::exp(0.6 * spread.size);
            EXPECT_GT(most_length, reach) << "three hundred individuals use the spread";
            EXPECT_LT(least_length, 1.0 / reach);
        }
    }
}

TEST(Resolve, SizeScalesTheWholeAndNothingElse) {
    for (const std::string& id : species_ids()) {
        MushroomOrder order = order_of(id, 0.6, 8);
        const Individual one = resolve(order, atlas());
        order.params.size = 4.0;
        const Individual four = resolve(order, atlas());
        const Silhouette &a = silhouette_of(one.model), &b = silhouette_of(four.model);
        for (std::size_t i = 0; i < a.cap.size(); ++i) {
            EXPECT_NEAR(b.cap[i].r, 4.0 * a.cap[i].r, 1e-12);
            EXPECT_NEAR(b.cap[i].y, 4.0 * a.cap[i].y, 1e-12);
        }
        EXPECT_EQ(one.model.ring.height, four.model.ring.height);
        EXPECT_NEAR(four.model.ring.width, 4.0 * one.model.ring.width, 1e-12);
        EXPECT_EQ(one.model.deformation, four.model.deformation);
        EXPECT_EQ(one.model.surface, four.model.surface);
    }
}

TEST(Resolve, WhatASpeciesCannotHaveIsRefusedByName) {
    const auto refused = [](const std::string& id, auto member, auto field, auto amount) {
        MushroomOrder order = order_of(id);
        (order.params.*member).*field = amount;
        std::vector<Problem> problems;
        try {
            (void)resolve(order, atlas());
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
    // None of what it has not is no fault.
    EXPECT_TRUE(refused("russula_vinosa", &P::ornaments, &O::warts, 0.0).empty());
    EXPECT_TRUE(refused("russula_vinosa", &P::hymenium, &H::forking, 0.0).empty());
    EXPECT_TRUE(refused("cantharellus_cibarius", &P::hymenium, &H::forking, 0.7).empty());
}

TEST(Resolve, EveryImpossibleWishIsToldAtOnce) {
    MushroomOrder order = order_of("boletus_edulis");
    order.params.hymenium.blades = 60;
    order.params.ornaments.warts = 1.0;
    order.params.ornaments.ring = 1.0;
    EXPECT_EQ(refusal([&] { (void)resolve(order, atlas()); }).size(), 3u);
}

TEST(Resolve, BadOrdersAreRefusedByName) {
    EXPECT_TRUE(names(refusal([] { (void)resolve(order_of("toadstool"), atlas()); }), "mix",
                      "'toadstool'"));
    MushroomOrder order = order_of("boletus_edulis");
    order.mix.push_back({"amanita_muscaria", 500});
    EXPECT_TRUE(names(refusal([&] { (void)resolve(order, atlas()); }), "mix", "2 species"));
    order = order_of("boletus_edulis", 1.2);
    order.params.size = std::nan("");
    order.params.deformation.bend_deg = 91.0;
    const auto problems = refusal([&] { (void)resolve(order, atlas()); });
    EXPECT_TRUE(names(problems, "/age", "1.2"));
    EXPECT_TRUE(names(problems, "/size"));
    EXPECT_TRUE(names(problems, "/deformation/bend_deg", "91"));
    order = order_of("boletus_edulis");
    order.params.deformation.zone_from = 0.5;
    order.params.deformation.zone_to = 0.5;
    EXPECT_TRUE(names(refusal([&] { (void)resolve(order, atlas()); }), "/deformation/zone_to"));
    // The rule holds across what was asked and what the species has.
    order.params.deformation.zone_to.reset();
    order.params.deformation.zone_from = 0.9;
    EXPECT_TRUE(refusal([&] { (void)resolve(order, atlas()); }).empty()) << "0.9 to 1 is a zone";
    order.params.deformation.zone_from.reset();
    order.params.deformation.zone_to = 0.1;
    EXPECT_TRUE(refusal([&] { (void)resolve(order, atlas()); }).empty()) << "0 to 0.1 is a zone";
}

TEST(Resolve, AModelOfOnesOwnIsTakenAsItIs) {
    MushroomOrder order = order_of("x", 0.2, 77);
    order.mix.clear();
    order.model = atlas().find("cantharellus_cibarius")->species.stages[1].model;
    order.params.variation = 1.0;
    EXPECT_EQ(model_of(order), *order.model) << "age and variation do not touch it";
    order.params.weathering.fade = 0.3;
    EXPECT_EQ(model_of(order).weathering.fade, 0.3);
    std::get<Swept>(order.model->shape).silhouette.stem[0].r = 0.001;
    EXPECT_TRUE(names(refusal([&] { (void)resolve(order, atlas()); }), "/model/silhouette/stem/0/r",
                      "off the axis"));
}

/// Calls `use` with each optional of `asked`, its path, and the value of the same place in `effective`.
template <class T, class Use>
void each_wish(const T& asked, const T& effective, const std::string& path, const Use& use) {
    T::fields([&](auto member, const Info& info) {
        const auto &a = asked.*member, &e = effective.*member;
        using Member = std::remove_cvref_t<decltype(a)>;
        if constexpr (is_optional<Member>)
            use(a, e, path + '/' + info.name);
        else if constexpr (Described<Member>)
            each_wish(a, e, path + '/' + info.name, use);
    });
}

TEST(Resolve, WhatIsAskedIsExactlyWhatTheIndividualHas) {
    int resolved = 0;
    EXPECT_TRUE(rc::check("random overrides", [&] {
        MushroomOrder order = order_of(species_ids()[*rc::gen::inRange<std::size_t>(0, 8)]);
        order.params = arbitrary_params();
        try {
            const Individual individual = resolve(order, atlas());
            ++resolved;
            each_wish(order.params, individual.effective, "",
                      [](const auto& asked, const auto& effective, const std::string& path) {
                          // Nothing asked of what the species lacks says as much as not asking.
                          if (asked && effective && *asked != *effective) RC_FAIL(path);
                          if (asked && !effective && *asked != 0) RC_FAIL(path + " is lost");
                      });
            RC_ASSERT(individual.effective.age == order.params.age);
            RC_ASSERT(individual.effective.seed == order.params.seed);
            RC_ASSERT(problems_in(individual.effective).empty());
        } catch (const InvalidInput& refused) {
            for (const Problem& problem : refused.problems())
                RC_ASSERT(problem.path.starts_with("/hymenium/") ||
                          problem.path.starts_with("/ornaments/") ||
                          problem.path == "/deformation/zone_to");
        }
    }));
    // Most random wishes ask something that a species cannot have.
    EXPECT_GT(resolved, 1);
}

TEST(Resolve, EffectiveParametersGiveTheSameIndividualBack) {
    for (const std::string& id : species_ids())
        for (std::uint32_t seed = 1; seed <= 8; ++seed) {
            MushroomOrder order = textured(order_of(id, seed / 8.0, seed, 1));
            order.params.variation = 1.0;
            order.params.deformation.twist_deg = 30.0;
            const Individual first = resolve(order, atlas());
            MushroomOrder again = order;
            again.params = first.effective;
            const Individual second = resolve(again, atlas());
            EXPECT_EQ(second.model, first.model) << id << ' ' << seed;
            EXPECT_EQ(second.lightness, first.lightness);
            EXPECT_EQ(canonical_text(second.effective), canonical_text(first.effective));
            EXPECT_TRUE(same_bits(mushroom_mesh(order, first), mushroom_mesh(again, second)));
        }
}

TEST(Resolve, NoIndividualBendsSoFarThatItsStemFolds) {
    for (const std::string& id : species_ids())
        for (int step = 0; step <= 8; ++step)
            for (std::uint32_t seed = 0; seed < 12; ++seed) {
                MushroomOrder order = order_of(id, step / 8.0, seed, 3);
                order.params.variation = 1.0;
                const auto problems = refusal([&] { (void)mesh_of(order); });
                EXPECT_TRUE(problems.empty())
                    << id << ' ' << order.params.age << ' ' << seed << ": " << problems[0].path
                    << ' ' << problems[0].message;
            }
}

}  // namespace
}  // namespace sporeprint
