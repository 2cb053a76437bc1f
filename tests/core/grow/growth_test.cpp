#include "core/grow/growth.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <stop_token>
#include <string>
#include <thread>
#include <vector>

#include "core/gltf/inspect.h"
#include "core/params/query.h"
#include "tests/support/effort.h"
#include "tests/support/glb_reader.h"
#include "tests/support/keeper.h"
#include "tests/support/meshes.h"
#include "tests/support/orders.h"

namespace sporeprint::grow_growth_test {
namespace {

class EverySpeciesClip : public ::testing::TestWithParam<std::string> {};

INSTANTIATE_TEST_SUITE_P(Atlas, EverySpeciesClip, ::testing::ValuesIn(species_ids()),
                         [](const auto& one) { return one.param; });

std::vector<float> one_hot(std::size_t count, std::size_t at) {
    std::vector<float> weights(count, 0.0f);
    weights[at] = 1.0f;
    return weights;
}

float angle_deg(const glm::vec3& a, const glm::vec3& b) {
    return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b)) * 57.29578f;
}

/// Expects a frame to be the mesh of a static file: the same vertices, and its triangles in their
/// order; triangles that the static file leaves out have no area in the frame.
void expect_same_surface(const Mesh& frame, const Mesh& still) {
    ASSERT_EQ(frame.positions.size(), still.positions.size());
    float apart = 0.0f, turned = 0.0f;
    for (std::size_t i = 0; i < frame.positions.size(); ++i) {
        apart = std::max(apart, glm::distance(frame.positions[i], still.positions[i]));
        turned = std::max(turned, angle_deg(frame.normals[i], still.normals[i]));
    }
    EXPECT_LT(apart, 1e-6f) << "metres";
    EXPECT_LT(turned, 1.0f) << "degrees";
    std::size_t at = 0;
    for (std::size_t i = 0; i < frame.indices.size(); i += 3) {
        if (at < still.indices.size() &&
            std::equal(frame.indices.begin() + static_cast<std::ptrdiff_t>(i),
                       frame.indices.begin() + static_cast<std::ptrdiff_t>(i + 3),
                       still.indices.begin() + static_cast<std::ptrdiff_t>(at))) {
            at += 3;
            continue;
        }
        const glm::dvec3 a = frame.positions[frame.indices[i]],
                         b = frame.positions[frame.indices[i + 1]],
                         c = frame.positions[frame.indices[i + 2]];
        // Vertices are floats: a degenerate triangle is a line within their rounding.
        const double longest =
            std::max({glm::distance(a, b), glm::distance(b, c), glm::distance(c, a)});
        EXPECT_LE(glm::length(glm::cross(b - a, c - a)), 3e-8 * longest) << "triangle " << i / 3;
    }
    EXPECT_EQ(at, still.indices.size()) << "a triangle of the static file is not in the frame";
}

TEST_P(EverySpeciesClip, FramesAreTheStaticMeshesAtTheirAges) {
    constexpr std::array<std::uint32_t, 2> seeds = {7, 1};
    for (int lod = 0; lod < 4; ++lod)
        for (const std::uint32_t seed : std::span(seeds).first(effort(2, 1, 2))) {
            const MushroomSpec spec = order_of(GetParam(), 0.6, seed, lod);
            const ReadBack clip = expect_glb(joined(grow_mushroom(growing(spec), atlas()).glb));
            const std::vector<double> ages = frame_ages(9);
            ASSERT_EQ(clip.targets.size(), ages.size());
            for (std::size_t k = 0; k < ages.size(); ++k) {
                SCOPED_TRACE("lod " + std::to_string(lod) + ", seed " + std::to_string(seed) +
                             ", age " + std::to_string(ages[k]));
                MushroomSpec still = spec;
                still.params.age = ages[k];
                const Mesh frame = posed(clip, one_hot(ages.size(), k));
                expect_valid(frame);
                expect_same_surface(frame, mesh_of(still));
                if (HasFailure()) return;
            }
        }
}

TEST_P(EverySpeciesClip, WithoutPlaybackTheMushroomHasTheRequestedAge) {
    for (const double age : {0.0, 0.37, 0.6, 1.0}) {
        SCOPED_TRACE(age);
        const MushroomSpec spec = order_of(GetParam(), age, 3, 1);
        const ReadBack clip = expect_glb(joined(grow_mushroom(growing(spec), atlas()).glb));
        expect_same_surface(clip.mesh, mesh_of(spec));
    }
}

TEST_P(EverySpeciesClip, WeightsAreOneFrameAtEachKeyEvenlyOverEightSeconds) {
    for (const int frames : {2, 5, 16}) {
        const MushroomSpec spec = growing(order_of(GetParam(), 0.6, 1, 3), frames);
        const ReadBack found = expect_glb(joined(grow_mushroom(spec, atlas()).glb));
        const auto n = static_cast<std::size_t>(frames);
        ASSERT_EQ(found.targets.size(), n);
        ASSERT_EQ(found.clips.size(), 1u);
        const ReadClip& clip = found.clips[0];
        EXPECT_EQ(clip.name, "growth");
        ASSERT_EQ(clip.times.size(), n);
        EXPECT_EQ(clip.times.front(), 0.0f);
        EXPECT_EQ(clip.times.back(), 8.0f);
        for (std::size_t k = 0; k < n; ++k) {
            EXPECT_NEAR(clip.times[k], 8.0 * static_cast<double>(k) / (frames - 1), 1e-6);
            const auto row = clip.weights.begin() + static_cast<std::ptrdiff_t>(k * n);
            EXPECT_EQ(std::vector<float>(row, row + frames), one_hot(n, k));
        }
        EXPECT_EQ(found.targets.front().name, "age 0");
        EXPECT_EQ(found.targets.back().name, "age 1");
    }
}

TEST_P(EverySpeciesClip, HalfWayBetweenTwoFramesIsTheirMean) {
    const ReadBack found =
        expect_glb(joined(grow_mushroom(growing(order_of(GetParam(), 0.6, 1, 2), 5), atlas()).glb));
    for (std::size_t k = 0; k + 1 < 5; ++k) {
        std::vector<float> weights(5, 0.0f);
        weights[k] = weights[k + 1] = 0.5f;
        const Mesh before = posed(found, one_hot(5, k)), after = posed(found, one_hot(5, k + 1)),
                   between = posed(found, weights);
        for (std::size_t i = 0; i < between.positions.size(); ++i)
            EXPECT_LT(glm::distance(between.positions[i],
                                    0.5f * (before.positions[i] + after.positions[i])),
                      1e-6f);
    }
}

TEST_P(EverySpeciesClip, ClipsAreEstimatedBeforeAnyWork) {
    for (const int lod : {0, 1, 3})
        for (const int frames : {2, 16}) {
            const MushroomSpec spec =
                growing(painted(order_of(GetParam(), 0.6, 3, lod), 256), frames);
            const Estimate e = estimate(spec, atlas());
            const Mushroom made = grow_mushroom(spec, atlas());
            const auto vertices = made.vertices * static_cast<std::uint64_t>(frames + 1);
            EXPECT_GE(e.vertices, vertices) << "every frame is counted";
            EXPECT_LE(e.vertices, 3 * vertices);
            const auto bytes = static_cast<double>(size_of(made.glb));
            EXPECT_GT(static_cast<double>(e.bytes), 0.7 * bytes);
            EXPECT_LT(static_cast<double>(e.bytes), 2.5 * bytes);
        }
}

TEST(Clip, MixesGrowAsTheirStaticMeshesDo) {
    const std::vector<Mix> mixes = {
        {{"amanita_muscaria", 400}, {"coprinus_comatus", 600}},
        {{"boletus_edulis", 300}, {"disciotis_venosa", 200}, {"clavariadelphus_pistillaris", 500}}};
    for (const Mix& mix : mixes) {
        const MushroomSpec spec = mix_of(mix, 0.6, 5, 1);
        const ReadBack clip = expect_glb(joined(grow_mushroom(growing(spec, 5), atlas()).glb));
        const std::vector<double> ages = frame_ages(5);
        for (std::size_t k = 0; k < ages.size(); ++k) {
            SCOPED_TRACE(mix.front().id + ", age " + std::to_string(ages[k]));
            MushroomSpec still = spec;
            still.params.age = ages[k];
            expect_same_surface(posed(clip, one_hot(ages.size(), k)), mesh_of(still));
        }
    }
}

TEST(Clip, FindsTheCorrespondenceOfItsSpeciesOnce) {
    ExecutionContext execution;
    int lookups = 0;
    execution.caches.morphs = [&](const std::string&, const auto& make) {
        ++lookups;
        return make();
    };
    const MushroomSpec spec = growing(mix_of({{"amanita_muscaria", 400}, {"boletus_edulis", 600}}));
    (void)growth_clip(spec, resolve(spec, atlas()), atlas(), mesh_of(spec), execution);
    EXPECT_EQ(lookups, 1) << "all ages are weights of one set";
}

TEST(Clip, ImagesAreThoseOfTheAge) {
    MushroomSpec spec = painted(order_of("boletus_edulis", 0.3, 4, 1));
    const ReadBack still = expect_glb(joined(grow_mushroom(spec, atlas()).glb));
    const ReadBack clip = expect_glb(joined(grow_mushroom(growing(spec), atlas()).glb));
    EXPECT_EQ(clip.images, still.images);
    EXPECT_EQ(clip.attributes,
              (std::vector<std::string>{"NORMAL", "POSITION", "TANGENT", "TEXCOORD_0"}));
    spec.params.textures = Textures::linked;
    const Extras extras{"/v1/x", {{"/a.jpg", "/b.jpg", "/c.jpg"}, {}}};
    const ReadBack linked = expect_glb(joined(grow_mushroom(growing(spec), atlas(), extras).glb));
    EXPECT_EQ(linked.uris, (std::vector<std::string>{"/a.jpg", "/b.jpg", "/c.jpg"}));
    EXPECT_EQ(linked.targets.size(), 9u);
}

TEST(Clip, TargetsOfPositionsAloneLeaveTheNormals) {
    MushroomSpec spec = growing(order_of("boletus_edulis", 0.6, 4, 2));
    const Grown both = grow_mushroom(spec, atlas());
    spec.params.targets = Targets::position;
    const Grown moved = grow_mushroom(spec, atlas());
    const Value json = json_chunk(joined(moved.glb));
    const auto& targets = json.at_pointer("/meshes/0/primitives/0/targets")->items();
    ASSERT_EQ(targets.size(), 9u);
    for (const Value& target : targets) {
        EXPECT_NE(target.find("POSITION"), nullptr);
        EXPECT_EQ(target.find("NORMAL"), nullptr);
    }
    EXPECT_LT(size_of(moved.glb) + 12 * moved.vertices * targets.size(), size_of(both.glb))
        << "and their bytes are not there";
    spec.params.animation = Animation::none;
    spec.params.frames = MushroomParams{}.frames;
    EXPECT_TRUE(names(refusal([&] { (void)grow_mushroom(spec, atlas()); }), "/targets", "growth"));
}

TEST(Clip, AClipContainsTheRequestThatMadeIt) {
    const MushroomSpec spec = growing(painted(order_of("boletus_edulis", 0.6, 7, 1)), 4);
    const Mushroom made = grow_mushroom(spec, atlas(), {"/v1/canonical", {}});
    const Inspection found = inspect_glb(joined(made.glb));
    EXPECT_EQ(found.canonical, "/v1/canonical");
    EXPECT_EQ(found.vertices, made.vertices) << "of the mesh, however many frames it has";
    EXPECT_EQ(found.triangles, made.triangles);
    std::vector<Problem> problems;
    const auto effective = read_json<MushroomParams>(found.effective_json, problems);
    EXPECT_EQ(problems, std::vector<Problem>{});
    EXPECT_EQ(effective.animation, Animation::growth);
    EXPECT_EQ(effective.frames, 4);
}

TEST(Clip, GivesEqualBytesTwiceAndWithManyThreads) {
    const MushroomSpec spec = growing(order_of("amanita_muscaria", 0.6, 2, 1));
    const Bytes once = joined(grow_mushroom(spec, atlas()).glb);
    EXPECT_EQ(joined(grow_mushroom(spec, atlas()).glb), once);
    ExecutionContext threads;
    threads.parallel = in_threads;
    EXPECT_EQ(joined(grow_mushroom(spec, atlas(), {}, threads).glb), once);
}

TEST(Clip, AnImpossibleAgeIsRefusedByName) {
    // Buttons are stout: a bend that a grown stem allows folds the young one.
    int refused = 0;
    for (const std::string& id : species_ids()) {
        MushroomSpec spec = order_of(id, 0.6, 1, 3);
        spec.params.deformation.bend_deg = 90.0;
        if (!refusal([&] { (void)mesh_of(spec); }).empty()) continue;
        const auto problems = refusal([&] { (void)grow_mushroom(growing(spec), atlas()); });
        if (problems.empty()) continue;
        ++refused;
        EXPECT_TRUE(names(problems, "/deformation/bend_deg", "in the clip, at age 0")) << id;
    }
    EXPECT_GT(refused, 0);
}

TEST(Clip, AUserModelHasNoStages) {
    MushroomSpec spec = growing(order_of("x"));
    spec.mix.clear();
    spec.model = atlas().find("russula_vinosa")->species.stages[1].model;
    EXPECT_TRUE(
        names(refusal([&] { (void)grow_mushroom(spec, atlas()); }), "/animation", "no stages"));
    EXPECT_TRUE(names(refusal([&] { (void)estimate(spec, atlas()); }), "/animation", "no stages"));
}

TEST(Clip, FramesNeedAClipSoThatEqualBytesHaveOneUrl) {
    MushroomParams params;
    std::vector<Problem> problems;
    const std::vector<std::pair<std::string, std::string>> alone = {{"frames", "5"}};
    read_query(alone, params, problems);
    EXPECT_TRUE(names(problems, "frames", "animation=growth"));
    problems.clear();
    params = {};
    const std::vector<std::pair<std::string, std::string>> both = {{"frames", "5"},
                                                                   {"animation", "growth"}};
    read_query(both, params, problems);
    EXPECT_TRUE(problems.empty());
    EXPECT_EQ(query_text(params), "animation=growth&frames=5");
    params = {};
    const std::vector<std::pair<std::string, std::string>> spelt = {{"frames", "9"}};
    read_query(spelt, params, problems);
    EXPECT_TRUE(problems.empty()) << "what it is anyway may be said";
    EXPECT_EQ(query_text(params), "");
}

TEST(Clip, StopsWhenCancelled) {
    std::stop_source source;
    ExecutionContext execution;
    execution.stop = source.get_token();
    const MushroomSpec spec = growing(order_of("boletus_edulis", 0.6, 1, 1));
    const Mesh mesh = mesh_of(spec);
    source.request_stop();
    EXPECT_THROW((void)growth_clip(spec, resolve(spec, atlas()), atlas(), mesh, execution),
                 Cancelled);
}

}  // namespace
}  // namespace sporeprint::grow_growth_test
