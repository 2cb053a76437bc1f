#include "core/grow/mushroom.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <set>
#include <span>
#include <stop_token>
#include <string>
#include <thread>
#include <vector>

#include "core/grow/names.h"
#include "core/params/corners.h"
#include "core/params/value.h"
#include "tests/support/effort.h"
#include "tests/support/glb_reader.h"
#include "tests/support/keeper.h"
#include "tests/support/meshes.h"
#include "tests/support/mixes.h"

namespace sporeprint::grow_mushroom_test {
namespace {

class EverySpecies : public ::testing::TestWithParam<std::string> {};

INSTANTIATE_TEST_SUITE_P(Atlas, EverySpecies, ::testing::ValuesIn(species_ids()),
                         [](const auto& one) { return one.param; });

TEST_P(EverySpecies, GrowsToValidMeshesAtEveryAgeLevelOfDetailAndSeed) {
    constexpr std::array<std::uint32_t, 3> seeds = {4294967295, 1, 2};
    for (const double age : {0.0, 0.15, 0.3, 0.45, 0.6, 0.8, 1.0})
        for (int lod = 0; lod < 4; ++lod)
            for (const std::uint32_t seed : std::span(seeds).first(effort(3, 1, 3))) {
                SCOPED_TRACE("age " + std::to_string(age) + ", lod " + std::to_string(lod) +
                             ", seed " + std::to_string(seed));
                MushroomSpec spec = on_wood(textured(order_of(GetParam(), age, seed, lod)));
                spec.params.variation = 1.0;
                const Mesh mesh = mesh_of(spec);
                expect_valid(mesh);
                EXPECT_EQ(mesh.tangents.size(), mesh.positions.size());
                if (HasFailure()) return;
            }
}

TEST_P(EverySpecies, IsValidOrRefusedByNameWithEachParameterAtEachEnd) {
    MushroomSpec spec = on_wood(textured(order_of(GetParam(), 0.7, 3, 1)));
    std::set<std::string> refused;
    int grown = 0;
    corners(spec.params, [&](const std::string& path) {
        SCOPED_TRACE(path);
        const auto start = std::chrono::steady_clock::now();
        const auto problems = refusal([&] {
            const Mesh mesh = mesh_of(spec);
            ++grown;
            expect_valid(mesh);
        });
        const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
        EXPECT_LT(took.count(), 5.0) << "hundreds of times what it takes, on a loaded machine";
        for (const Problem& problem : problems) {
            refused.insert(problem.path);
            EXPECT_FALSE(problem.message.empty());
            // A fold is reported at the bend, whatever part of the deformation caused it.
            EXPECT_TRUE(problem.path == path || path.starts_with("/deformation/")) << problem.path;
        }
    });
    EXPECT_GT(grown, 40);
    const std::set<std::string> known = {"/hymenium/blades",
                                         "/hymenium/tiers",
                                         "/hymenium/forking",
                                         "/hymenium/pores_per_mm",
                                         "/hymenium/depth",
                                         "/hymenium/thickness",
                                         "/hymenium/inner_gap",
                                         "/hymenium/inner_depth",
                                         "/hymenium/notch",
                                         "/hymenium/decurrent",
                                         "/hymenium/edge_waves",
                                         "/hymenium/elongation",
                                         "/ornaments/warts",
                                         "/ornaments/scales",
                                         "/ornaments/ring",
                                         "/ornaments/volva",
                                         "/ornaments/peridioles",
                                         "/ornaments/receptacle",
                                         "/weathering/waves",
                                         "/weathering/splits",
                                         "/weathering/peel",
                                         "/weathering/deliquescence",
                                         "/deformation/bend_deg",
                                         "/deformation/irregularity",
                                         "/deformation/zone_to",
                                         "/frames",
                                         "/targets",
                                         "/impostor",
                                         "/substrate",
                                         "/triangles"};
    for (const std::string& path : refused) EXPECT_TRUE(known.contains(path)) << path;
}

TEST_P(EverySpecies, AsAUserModelIsValidOrRefusedByNameWithEachFieldAtEachEnd) {
    MushroomSpec spec = textured(order_of("x", 0.5, 3, 1));
    spec.mix.clear();
    spec.model = atlas().find(GetParam())->species.stages[2].model;
    spec.model->deformation.imperfection = 0.5;
    spec.model->weathering.waves = 0.5;
    // A form attached by a patch wider than high has no stem to bend.
    if (auto* swept = std::get_if<Swept>(&spec.model->shape)) {
        const auto& stem = swept->silhouette.stem;
        double widest = 0.0;
        for (const OutlinePoint& p : stem) widest = std::max(widest, p.r);
        if (stem.back().y - stem.front().y > widest)
            swept->axis = {{0.0, 0.0, 0.0}, {0.01, 0.5, 0.0}, {0.0, 1.0, 0.01}};
    }
    int grown = 0;
    corners(*spec.model, [&](const std::string& path) {
        if (path.starts_with("/surface/")) return;  // does not affect the shape
        SCOPED_TRACE(path);
        const auto problems = refusal([&] {
            const Mesh mesh = mesh_of(spec);
            ++grown;
            expect_valid(mesh);
        });
        for (const Problem& problem : problems)
            EXPECT_TRUE(problem.path.starts_with("/model/silhouette") ||
                        problem.path.starts_with("/model/ramification") ||
                        problem.path == "/model/axis" || problem.path == "/deformation/bend_deg" ||
                        problem.path == "/model/deformation/zone_to")
                << problem.path << ": " << problem.message;
    });
    EXPECT_GT(grown, 60);
}

TEST_P(EverySpecies, IsValidOrRefusedByNameWithRandomParameters) {
    int drawn = 0, grown = 0;
    EXPECT_TRUE(rc::check("random parameters", [&] {
        ++drawn;
        MushroomSpec spec = order_of(GetParam());
        spec.params = arbitrary_params();
        // Parameters that a species cannot have are refused; they are left out half of the time.
        if (*rc::gen::inRange(0, 2)) {
            spec.params.hymenium = {};
            spec.params.ornaments = {};
            spec.params.deformation.zone_from.reset();
            spec.params.deformation.zone_to.reset();
            spec.params.substrate.reset();
        }
        spec.params.textures = Textures::linked;
        // Nearly all numbers of triangles would select the finest level.
        if (spec.params.triangles)
            spec.params.triangles = 20 + *spec.params.triangles % 9000;
        else
            spec.params.lod = std::max(spec.params.lod, 1);
        try {
            const Mesh mesh = mesh_of(spec);
            const auto found = defects(mesh);
            RC_ASSERT(found == std::vector<std::string>{});
            RC_ASSERT(volume(mesh) > 0.0);
            ++grown;
        } catch (const InvalidInput& refused) {
            RC_ASSERT(!refused.problems().empty());
            for (const Problem& problem : refused.problems())
                RC_ASSERT(problem.path.starts_with("/hymenium/") ||
                          problem.path.starts_with("/ornaments/") ||
                          problem.path.starts_with("/weathering/") ||
                          problem.path.starts_with("/deformation/") ||
                          problem.path == "/substrate");
        }
    }));
    EXPECT_GT(7 * grown, drawn);
}

TEST_P(EverySpecies, ReadsBackFromItsFile) {
    for (const double age : {0.0, 0.6, 1.0})
        for (const int lod : {0, 2}) {
            const MushroomSpec spec = painted(order_of(GetParam(), age, 3, lod));
            const Mushroom mushroom = grow_mushroom(spec, atlas());
            const ReadBack found = expect_glb(joined(mushroom.glb));
            EXPECT_EQ(found.mesh.positions.size(), mushroom.vertices);
            EXPECT_EQ(found.mesh.triangles(), mushroom.triangles);
            const int side = 128 >> lod;
            EXPECT_EQ(found.images, (std::vector<std::array<int, 2>>(3, {side, side})));
            EXPECT_EQ(found.node, level_name(product_name(spec), lod));
        }
}

TEST_P(EverySpecies, IsEstimatedBeforeAnyWork) {
    for (const double age : {0.1, 0.6, 1.0})
        for (int lod = 0; lod < 4; ++lod) {
            const MushroomSpec spec = painted(order_of(GetParam(), age, 3, lod), 256);
            const Estimate e = estimate(spec, atlas());
            const Mushroom mushroom = grow_mushroom(spec, atlas());
            EXPECT_EQ(e.vertices, mushroom.vertices);
            EXPECT_GE(e.triangles, mushroom.triangles);
            EXPECT_LE(e.triangles, 3 * mushroom.triangles);
            EXPECT_EQ(e.texels, 3u * (256u >> lod) * (256u >> lod));
            const double bytes = static_cast<double>(size_of(mushroom.glb));
            EXPECT_GT(static_cast<double>(e.bytes), 0.7 * bytes);
            EXPECT_LT(static_cast<double>(e.bytes), 2.5 * bytes);
        }
}

TEST_P(EverySpecies, GivesEqualBytesTwiceAndWithEightThreads) {
    const MushroomSpec spec = painted(order_of(GetParam(), 0.7, 9));
    const Bytes once = joined(grow_mushroom(spec, atlas()).glb);
    EXPECT_EQ(joined(grow_mushroom(spec, atlas()).glb), once);
    ExecutionContext threads;
    threads.parallel = in_threads;
    EXPECT_EQ(joined(grow_mushroom(spec, atlas(), {}, threads).glb), once);
    std::vector<Bytes> together(8);
    {
        std::vector<std::jthread> growers;
        for (Bytes& mine : together)
            growers.emplace_back(
                [&spec, &mine] { mine = joined(grow_mushroom(spec, atlas()).glb); });
    }
    for (const Bytes& mine : together) EXPECT_EQ(mine, once);
}

TEST(Mushroom, AChangeOfShapeReusesTheImages) {
    Keeper keeper;
    MushroomSpec spec = painted(order_of("amanita_muscaria", 0.6, 5));
    const Mushroom straight = grow_mushroom(spec, atlas(), {}, keeper.execution);
    spec.params.deformation.bend_deg = 25.0;
    spec.params.deformation.twist_deg = 10.0;
    spec.params.weathering.waves = 0.7;
    const Mushroom bent = grow_mushroom(spec, atlas(), {}, keeper.execution);
    EXPECT_EQ(keeper.lookups, 2);
    EXPECT_EQ(keeper.made, 1);
    ASSERT_EQ(keeper.cached.size(), 1u);
    for (const Slice& file : keeper.cached.begin()->second->files) {
        EXPECT_TRUE(shares_bytes(straight.glb, file));
        EXPECT_TRUE(shares_bytes(bent.glb, file));
    }
    EXPECT_NE(joined(straight.glb), joined(bent.glb));
    // The cached images equal newly painted ones.
    EXPECT_EQ(joined(grow_mushroom(spec, atlas()).glb), joined(bent.glb));
}

TEST(Mushroom, NearbyAgesShareTheirImagesAndOtherSurfacesDoNot) {
    Keeper keeper;
    MushroomSpec spec = painted(order_of("amanita_muscaria", 0.6, 5, 1));
    const auto made_by = [&](auto change) {
        MushroomSpec changed = spec;
        change(changed.params);
        const int before = keeper.made;
        (void)grow_mushroom(changed, atlas(), Extras(), keeper.execution);
        return keeper.made - before;
    };
    EXPECT_EQ(made_by([](MushroomParams&) {}), 1);
    EXPECT_EQ(made_by([](MushroomParams& p) { p.age = 0.6001; }), 0) << "a 64th of age is one step";
    EXPECT_EQ(made_by([](MushroomParams& p) { p.age = 0.7; }), 1);
    EXPECT_EQ(made_by([](MushroomParams& p) { p.seed = 6; }), 1);
    EXPECT_EQ(made_by([](MushroomParams& p) { p.weathering.fade = 0.9; }), 1);
    EXPECT_EQ(made_by([](MushroomParams& p) { p.hymenium.blades = 90; }), 1);
    EXPECT_EQ(made_by([](MushroomParams& p) { p.ornaments.warts = 0.2; }), 1);
    EXPECT_EQ(made_by([](MushroomParams& p) { p.texture_size.value = 256; }), 1);
    EXPECT_EQ(made_by([](MushroomParams& p) { p.lod = 2; }), 1);
}

// The estimate decides what a request may cost: it must not be too low for any request, and not so
// high that it refuses cheap ones.
TEST(Mushroom, IsEstimatedBeforeAnyWorkForAnyRequest) {
    ExecutionContext execution;
    execution.caches.morphs = cached_morphs();
    for (std::uint32_t i = 0; i < effort(240, 24); ++i) {
        Random random(i, 0x65737469);
        MushroomSpec spec = mix_of(
            i % 3 == 0 ? Mix{{species_ids()[i % species_ids().size()], 1000}} : random_mix(random),
            random.uniform(), random.bits(), static_cast<int>(i % 4));
        spec.params.variation = random.uniform();
        if (i % 2 == 0) spec = painted(std::move(spec), 128 << (i / 2 % 2));
        if (i % 5 == 0) spec = growing(std::move(spec), static_cast<int>(2 + random.bits() % 15));
        SCOPED_TRACE(text_of(spec.mix) + ", draw " + std::to_string(i));
        const Estimate e = estimate(spec, atlas(), execution.caches);
        const Mushroom made = grow_mushroom(spec, atlas(), {}, execution);
        const bool clip = spec.params.animation != Animation::none;
        const auto frames = static_cast<std::uint64_t>(clip ? spec.params.frames : 0);
        EXPECT_EQ(e.vertices, made.vertices * (frames + 1));
        EXPECT_GE(e.triangles, made.triangles);
        EXPECT_LE(e.triangles, 3 * made.triangles);
        const auto bytes = static_cast<double>(size_of(made.glb));
        EXPECT_GT(static_cast<double>(e.bytes), 0.7 * bytes);
        EXPECT_LT(static_cast<double>(e.bytes), 2.5 * bytes);
        if (HasFailure()) return;
    }
}

TEST(Mushroom, StepsAreReportedInOrder) {
    std::vector<std::string> steps;
    ExecutionContext execution;
    execution.observer = [&](Step step) { steps.emplace_back(name(step)); };
    (void)grow_mushroom(painted(order_of("boletus_edulis", 0.6, 1, 3)), atlas(), {}, execution);
    EXPECT_EQ(steps, (std::vector<std::string>{"resolve", "build", "paint", "pack"}));
    steps.clear();
    (void)grow_mushroom(order_of("boletus_edulis", 0.6, 1, 3), atlas(), {}, execution);
    EXPECT_EQ(steps, (std::vector<std::string>{"resolve", "build", "pack"}));
}

TEST(Mushroom, StopsWhenCancelled) {
    std::stop_source source;
    source.request_stop();
    ExecutionContext execution;
    execution.stop = source.get_token();
    bool painted_anyway = false;
    execution.observer = [&](Step step) { painted_anyway |= step == Step::paint; };
    const auto grow = [&] {
        (void)grow_mushroom(painted(order_of("boletus_edulis")), atlas(), {}, execution);
    };
    EXPECT_THROW(grow(), Cancelled);
    EXPECT_FALSE(painted_anyway);
}

TEST(Mushroom, AFailureOfTheCacheIsRethrown) {
    ExecutionContext execution;
    execution.caches.images = [](const auto&, const auto&) -> std::shared_ptr<const ImageSet> {
        throw GenerationError("no");
    };
    const auto grow = [&] {
        (void)grow_mushroom(painted(order_of("boletus_edulis")), atlas(), {}, execution);
    };
    EXPECT_THROW(grow(), GenerationError);
}

TEST(Mushroom, LinkedTexturesNeedUrls) {
    const MushroomSpec spec = textured(order_of("boletus_edulis", 0.6, 1, 2));
    EXPECT_TRUE(names(refusal([&] { (void)grow_mushroom(spec, atlas()); }), "/textures", "linked"));
    const Extras extras{"/v1/x", {{"/a.jpg", "/b.jpg", "/c.jpg"}, {}}};
    const ReadBack found = expect_glb(joined(grow_mushroom(spec, atlas(), extras).glb));
    EXPECT_EQ(found.uris, (std::vector<std::string>{"/a.jpg", "/b.jpg", "/c.jpg"}));
}

// The geometry is that of linked images, and readers load none: the client has them already.
TEST(Mushroom, ExternalTexturesAreAddressesInExtras) {
    MushroomSpec spec = order_of("boletus_edulis", 0.6, 1, 2);
    spec.params.textures = Textures::external;
    EXPECT_TRUE(
        names(refusal([&] { (void)grow_mushroom(spec, atlas()); }), "/textures", "'external'"));
    const Extras extras{"/v1/x", {{"/a.jpg", "/b.jpg", "/c.jpg"}, {}}};
    const Bytes file = joined(grow_mushroom(spec, atlas(), extras).glb);
    const ReadBack found = expect_glb(file);
    EXPECT_TRUE(found.uris.empty());
    EXPECT_TRUE(found.images.empty());
    EXPECT_EQ(found.textures, 0u);
    const Value json = json_chunk(file);
    EXPECT_EQ(dump(*json.find("materials")->items().front().find("extras")),
              R"({"images":{"base_color":"/a.jpg","normal":"/b.jpg","orm":"/c.jpg"}})");
    spec.params.textures = Textures::linked;
    const ReadBack linked = expect_glb(joined(grow_mushroom(spec, atlas(), extras).glb));
    EXPECT_EQ(found.mesh.texture_coordinates, linked.mesh.texture_coordinates);
    EXPECT_TRUE(found.mesh.tangents.empty()) << "no map of normals would use them";
}

TEST(Mushroom, DescribesItselfInExtras) {
    const MushroomSpec spec = order_of("boletus_edulis", 0.6, 1, 2);
    const Bytes file = joined(grow_mushroom(spec, atlas(), {"/v1/canonical", {}}).glb);
    const Value json = json_chunk(file);
    const Mesh mesh = mesh_of(spec);
    EXPECT_EQ(json.at_pointer("/asset/extras/canonical")->as_string(), "/v1/canonical");
    EXPECT_EQ(json.at_pointer("/asset/extras/triangles")->as_number(),
              static_cast<double>(mesh.triangles()));
    EXPECT_EQ(json.at_pointer("/asset/extras/effective/age")->as_number(), 0.6);
    const auto& top = json.at_pointer("/asset/extras/bounds_m/max")->items();
    EXPECT_EQ(static_cast<float>(top.at(1).as_number()), bounds(mesh).max.y);
    EXPECT_EQ(json.at_pointer("/materials")->items().size(), 1u);
    EXPECT_EQ(json.at_pointer("/extensionsRequired"), nullptr);
}

TEST(Mushroom, AUserModelNeedsNoSpecies) {
    MushroomSpec spec = painted(order_of("x", 0.5, 4, 1));
    spec.mix.clear();
    spec.model = atlas().find("russula_vinosa")->species.stages[1].model;
    const ReadBack found = expect_glb(joined(grow_mushroom(spec, Atlas({})).glb));
    EXPECT_EQ(found.node, level_name(product_name(spec), 1));
    EXPECT_TRUE(found.node.starts_with("model_s4_a50_")) << found.node;
    EXPECT_EQ(found.images.size(), 3u);
}

TEST(Mushroom, CrossingModelsAreRefusedByName) {
    MushroomSpec spec = order_of("x");
    spec.mix.clear();
    spec.model = atlas().find("russula_vinosa")->species.stages[1].model;
    auto& silhouette = std::get<Swept>(spec.model->shape).silhouette;
    std::swap(silhouette.cap[1], silhouette.cap[3]);
    const auto problems = refusal([&] { (void)grow_mushroom(spec, atlas()); });
    ASSERT_EQ(problems.size(), 1u);
    EXPECT_TRUE(problems[0].path.starts_with("/model/silhouette/")) << problems[0].path;
}

}  // namespace
}  // namespace sporeprint::grow_mushroom_test
