#include "core/grow/scene/scene_fungi_file.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "core/bytes.h"
#include "core/gltf/inspect.h"
#include "core/params/value.h"
#include "tests/support/orders.h"
#include "tests/support/refusals.h"
#include "tests/support/scene_parts.h"

namespace sporeprint::grow_scene_fungi_file_test {
namespace {

Grown grown(const SceneFungiOptions& options, WorldTime time = scenes::garden_time()) {
    ExecutionContext execution;
    execution.caches.morphs = cached_morphs();
    return grow_scene_fungi(scenes::garden_bodies(), time, species_of(scenes::garden_spec()),
                            options, atlas(), {}, execution);
}

SceneFungiOptions bare() {
    SceneFungiOptions options;
    options.lod = 2;
    options.textures = Textures::none;
    return options;
}

/// Returns the document of a file.
Value document(const Grown& file) {
    const Bytes bytes = joined(file.glb);
    std::vector<Problem> problems;
    Value value = parse(json_chunk(std::span<const std::uint8_t>(bytes)), problems);
    EXPECT_TRUE(problems.empty());
    return value;
}

std::size_t standing() {
    return static_cast<std::size_t>(std::ranges::count_if(
        scenes::garden_bodies(),
        [](const SceneBody& body) { return body.record.stands_at(scenes::garden_time()); }));
}

TEST(SceneFungiFile, HasANodeForEachBodyAtItsPlace) {
    const Value file = document(grown(bare()));
    const Value& nodes = *file.find("nodes");
    ASSERT_EQ(nodes.items().size(), standing());
    const Value& bodies = *file.find("asset")->find("extras")->find("bodies");
    ASSERT_EQ(bodies.items().size(), standing());
    std::size_t i = 0;
    for (const SceneBody& body : scenes::garden_bodies()) {
        if (!body.record.stands_at(scenes::garden_time())) continue;
        const auto node = static_cast<std::size_t>(bodies.items()[i].find("node")->as_number());
        const Value* const place = nodes.items()[node].find("translation");
        ASSERT_NE(place, nullptr);
        for (int axis = 0; axis < 3; ++axis)
            EXPECT_NEAR(place->items()[static_cast<std::size_t>(axis)].as_number(), body.at[axis],
                        1e-6);
        ++i;
    }
}

TEST(SceneFungiFile, HasOneNodeForThoseThatLookAlikeIfReadersCanInstance) {
    SceneFungiOptions options = bare();
    options.instancing = LeafInstancing::gpu;
    const Value file = document(grown(options));
    EXPECT_LT(file.find("nodes")->items().size(), standing());
    EXPECT_EQ(file.find("asset")->find("extras")->find("bodies")->items().size(), standing());
    EXPECT_EQ(file.find("extensionsRequired")->items()[0].as_string(), "EXT_mesh_gpu_instancing");
}

TEST(SceneFungiFile, IsTheSameTwiceAndEmptyBeforeAnythingGrows) {
    EXPECT_EQ(joined(grown(bare()).glb), joined(grown(bare()).glb));
    const Grown none = grown(bare(), time_of(0) - 1000 * ticks_of_year);
    EXPECT_EQ(none.triangles, 0U);
    EXPECT_EQ(document(none).find("nodes")->items().size(), 1U);
}

TEST(SceneFungiFile, RefusesWhatItCannotShow) {
    SceneFungiOptions options = bare();
    options.lod = 3;
    EXPECT_TRUE(names(refusal([&] { static_cast<void>(grown(options)); }), "/lod", "0..2"));
    options = bare();
    options.textures = Textures::linked;
    EXPECT_TRUE(names(refusal([&] { static_cast<void>(grown(options)); }), "/textures"));
}

}  // namespace
}  // namespace sporeprint::grow_scene_fungi_file_test
