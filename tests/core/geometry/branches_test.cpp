#include "core/geometry/branches.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "core/geometry/budget.h"
#include "core/math/random.h"
#include "tests/support/effort.h"
#include "tests/support/meshes.h"
#include "tests/support/mixes.h"
#include "tests/support/orders.h"

namespace sporeprint::geometry_branches_test {
namespace {

/// Returns mixes of two and of all branched species.
std::vector<Mix> mixes() {
    const auto ids = branched_ids();
    std::vector<Mix> all;
    for (std::size_t i = 0; i < ids.size(); ++i)
        for (std::size_t j = i + 1; j < ids.size(); ++j)
            all.push_back({{ids[i], 400}, {ids[j], 600}});
    Mix every;
    for (const std::string& id : ids) every.push_back({id, 300});
    every.front().weight += 1000 - 300 * static_cast<int>(ids.size());
    all.push_back(every);
    return all;
}

TEST(Branches, AreValidInEveryMixAtEveryLevelAndAge) {
    for (const Mix& mix : mixes())
        for (int lod = 0; lod < 4; ++lod)
            for (const double age : {0.0, 0.45, 0.6, 1.0}) {
                MushroomSpec order = textured(mix_of(mix, age, 4, lod));
                order.params.variation = 1.0;
                SCOPED_TRACE(text_of(mix) + " lod " + std::to_string(lod) + " age " +
                             std::to_string(age));
                expect_valid(mesh_of(order));
            }
}

TEST(Branches, KeepTheTriangleLimitAndAreCountedInAdvance) {
    Random random(1, 0x6c696d62);
    std::vector<Mix> all = mixes();
    for (const std::string& id : branched_ids()) all.push_back({{id, 1000}});
    for (const Mix& mix : all)
        for (int lod = 0; lod < 4; ++lod) {
            const double age = random.uniform();
            const std::uint32_t seed = random.bits();
            const MushroomSpec order = textured(mix_of(mix, age, seed, lod));
            const Individual individual = resolved(order);
            const MeshCount count = branched_mesh_count(individual, lod);
            EXPECT_LE(count.triangles, most_triangles[static_cast<std::size_t>(lod)]);
            EXPECT_GT(count.triangles, 0U);
            const Mesh mesh = branched_mesh(individual, lod);
            EXPECT_EQ(mesh.positions.size(), count.vertices) << text_of(mix);
            EXPECT_EQ(mesh.triangles(), count.triangles) << text_of(mix);
            const Mesh whole = branched_mesh(individual, lod, {.keep_absent = true});
            const MeshCount most = branched_mesh_count(individual, lod, true);
            EXPECT_EQ(whole.positions.size(), most.vertices) << text_of(mix);
            EXPECT_EQ(whole.triangles(), most.triangles) << text_of(mix);
        }
}

TEST(Branches, ScaleWithSize) {
    for (const std::string& id : branched_ids()) {
        MushroomSpec order = order_of(id, 0.6, 3, 1);
        const Mesh one = mesh_of(order);
        order.params.size = 2.0;
        const Mesh two = mesh_of(order);
        ASSERT_EQ(one.positions.size(), two.positions.size());
        for (std::size_t i = 0; i < one.positions.size(); ++i)
            EXPECT_LT(glm::distance(2.0F * one.positions[i], two.positions[i]), 1e-6F) << id;
    }
}

TEST(Branches, EveryDeformationIsValidOrRefusedByName) {
    int bent = 0;
    for (const std::string& id : branched_ids())
        for (std::uint32_t i = 0; i < effort(48); ++i) {
            Random random(i, 0x6c696d62);
            MushroomSpec order = order_of(id, random.uniform(), i, static_cast<int>(i % 4));
            order.params.deformation.bend_deg = random.uniform(0.0, 90.0);
            order.params.deformation.twist_deg = random.uniform(-180.0, 180.0);
            order.params.deformation.lean_deg = random.uniform(0.0, 45.0);
            order.params.deformation.taper = random.symmetric();
            order.params.deformation.imperfection = random.uniform();
            order.params.weathering.bites = random.uniform();
            Mesh mesh;
            const auto problems = refusal([&] { mesh = mesh_of(order); });
            if (!problems.empty()) {
                EXPECT_TRUE(names(problems, "/deformation/bend_deg", "bends this bush through"));
                continue;
            }
            ++bent;
            SCOPED_TRACE(id + ' ' + std::to_string(i));
            expect_valid(mesh);
        }
    EXPECT_GT(bent, 0);
}

/// Returns a coral of flat segments with ruffled edges, from which spines hang.
MushroomSpec frilled(double ruffle, int spines, int lod) {
    MushroomSpec order = order_of("ramaria_formosa", 0.6, 5, lod);
    Model model = atlas().find("ramaria_formosa")->species.stages[2].model;
    auto& segments = std::get<Branched>(model.shape).segments;
    segments.flatness = 0.85;
    segments.ruffle = ruffle;
    model.spines.count = spines;
    model.spines.length = 0.01;
    model.spines.droop = 1.0;
    order.mix.clear();
    order.model = model;
    return order;
}

TEST(Branches, RuffledSegmentsAndSpinesAreClosedAndCountedInAdvance) {
    for (int lod = 0; lod < 4; ++lod)
        for (const double ruffle : {0.0, 0.4, 1.0}) {
            const MushroomSpec order = frilled(ruffle, 600, lod);
            const Mesh mesh = mesh_of(order);
            expect_valid(mesh);
            const MeshCount count = branched_mesh_count(resolved(order), lod);
            EXPECT_EQ(mesh.positions.size(), count.vertices) << lod << ' ' << ruffle;
            EXPECT_EQ(mesh.triangles(), count.triangles) << lod << ' ' << ruffle;
            EXPECT_LE(count.triangles, most_triangles[static_cast<std::size_t>(lod)]);
        }
}

TEST(Branches, SpinesHangBelowTheirSegments) {
    const Mesh bare = mesh_of(frilled(0.0, 0, 0)), spiny = mesh_of(frilled(0.0, 400, 0));
    EXPECT_EQ(pieces(spiny).size(), pieces(bare).size() + 400);
    // They make nothing higher, and the lowest segments deeper by at most their length and width.
    // Without spines there are triangles for more rings.
    EXPECT_NEAR(bounds(spiny).max.y, bounds(bare).max.y, 1e-4f);
    EXPECT_LE(bounds(spiny).min.y, bounds(bare).min.y);
    EXPECT_GT(bounds(spiny).min.y, bounds(bare).min.y - 0.014f);
}

TEST(Branches, GnarlBendsSegmentsBetweenForksThatStayInPlace) {
    const auto gnarled = [](double gnarl) {
        MushroomSpec order = order_of("artomyces_pyxidatus", 0.6, 5, 0);
        Model model = atlas().find("artomyces_pyxidatus")->species.stages[2].model;
        std::get<Branched>(model.shape).segments.gnarl = gnarl;
        order.mix.clear();
        order.model = model;
        return mesh_of(order);
    };
    const Mesh even = gnarled(0.0), crooked = gnarled(1.0);
    expect_valid(crooked);
    ASSERT_EQ(even.indices, crooked.indices);
    const float height = bounds(even).max.y;
    EXPECT_NEAR(bounds(crooked).max.y, height, 0.01f * height);
    float most = 0.0f;
    for (std::size_t i = 0; i < even.positions.size(); ++i)
        most = std::max(most, glm::distance(even.positions[i], crooked.positions[i]));
    EXPECT_GT(most, 0.01f * height);
    EXPECT_LT(most, 0.06f * height);
}

TEST(Branches, ARuffleMovesEdgesAndNotTheMiddleOfSegments) {
    const Mesh plain = mesh_of(frilled(0.0, 0, 0)), ruffled = mesh_of(frilled(1.0, 0, 0));
    ASSERT_EQ(plain.positions.size(), ruffled.positions.size());
    std::size_t moved = 0;
    for (std::size_t i = 0; i < plain.positions.size(); ++i)
        moved += glm::distance(plain.positions[i], ruffled.positions[i]) > 1e-5f ? 1 : 0;
    EXPECT_GT(moved, plain.positions.size() / 4);
    EXPECT_NEAR(volume(ruffled) / volume(plain), 1.0, 0.25);
}

TEST(Branches, ParametersOfOtherFamiliesAreRefusedByName) {
    const auto refused = [](auto ask) {
        MushroomSpec order = order_of("ramaria_formosa");
        ask(order.params);
        return refusal([&] { (void)resolved(order); });
    };
    EXPECT_TRUE(names(refused([](auto& p) { p.hymenium.blades = 40; }), "/hymenium/blades",
                      "Ramaria formosa is smooth all over"));
    EXPECT_TRUE(names(refused([](auto& p) { p.weathering.waves = 0.5; }), "/weathering/waves",
                      "no margin"));
    EXPECT_TRUE(names(refused([](auto& p) { p.ornaments.ring = 1.0; }), "/ornaments/ring",
                      "no partial veil"));
    EXPECT_TRUE(refused([](auto& p) { p.weathering.bites = 0.5; }).empty());
}

TEST(Branches, FamiliesDoNotMixAndTheRefusalNamesThem) {
    const auto two = refusal([] {
        (void)resolved(mix_of({{"ramaria_formosa", 500}, {"boletus_edulis", 500}}));
    });
    EXPECT_TRUE(names(two, "mix",
                      "Ramaria formosa branches; Boletus edulis does not: a mix needs one family"));
    const auto four = refusal([] {
        (void)resolved(mix_of({{"ramaria_formosa", 250},
                               {"xylaria_hypoxylon", 250},
                               {"boletus_edulis", 250},
                               {"russula_vinosa", 250}}));
    });
    EXPECT_TRUE(
        names(four, "mix",
              "Ramaria formosa, Xylaria hypoxylon branch; Boletus edulis, Russula vinosa do "
              "not: a mix needs one family"));
}

}  // namespace
}  // namespace sporeprint::geometry_branches_test
