#include "core/grow/world/plot.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <string>

#include "core/params/messages.h"
#include "tests/support/atlas.h"
#include "tests/support/glb_reader.h"
#include "tests/support/orders.h"
#include "tests/support/plots.h"

namespace sporeprint::grow_plot_test {
namespace {

PlotOptions quick() {
    PlotOptions options;
    options.lod = 2;
    options.texture_size = 128;
    return options;
}

ExecutionContext with_morphs() {
    ExecutionContext execution;
    execution.caches.morphs = cached_morphs();
    return execution;
}

TEST(Plot, IsAValidFileWithinItsBudget) {
    const PlotContent content = small_wood().content();
    const Grown grown = grow_plot(content, quick(), atlas(), {}, with_morphs());
    const Bytes file = joined(grown.glb);
    const ReadScene scene = expect_scene(file);
    EXPECT_LE(grown.triangles, most_plot_triangles);
    EXPECT_LE(scene.nodes.size(), most_plot_nodes);
    EXPECT_LE(file.size(), 12'000'000U);
    std::set<std::string> names;
    for (const ReadNode& node : scene.nodes) names.insert(node.name);
    EXPECT_EQ(names.size(), scene.nodes.size());
    EXPECT_TRUE(scene.required.empty());
    EXPECT_EQ(joined(grow_plot(content, quick(), atlas(), {}, with_morphs()).glb), file);
}

TEST(Plot, NamesWhatItShows) {
    const PlotContent content = small_wood().content();
    PlotOptions options = quick();
    options.textures = Textures::none;
    const Value json =
        json_chunk(joined(grow_plot(content, options, atlas(), {}, with_morphs()).glb));
    const Value& extras = *json.find("asset")->find("extras");
    const auto& nodes = json.find("nodes")->items();
    const auto& bodies = extras.find("bodies")->items();
    ASSERT_GT(bodies.size(), 10U);
    for (const Value& body : bodies) {
        const auto node = static_cast<std::size_t>(body.find("node")->as_number());
        ASSERT_LT(node, nodes.size());
        EXPECT_EQ(nodes[node].find("name")->as_string().find(body.find("species")->as_string()),
                  0U);
        EXPECT_EQ(body.find("id")->as_string().size(), 16U);
    }
    EXPECT_EQ(extras.find("trees")->items().size(), 1U);
    EXPECT_EQ(extras.find("dead_wood")->items().size(), 2U);
    EXPECT_EQ(json.find("images"), nullptr);
}

TEST(Plot, ConsistsOfLayers) {
    const PlotContent content = small_wood().content();
    PlotOptions options = quick();
    options.textures = Textures::none;
    const auto names_of = [&](const PlotContent& of) {
        std::set<std::string> names;
        const Bytes file = joined(grow_plot(of, options, atlas(), {}, with_morphs()).glb);
        for (const ReadNode& node : expect_scene(file).nodes) names.insert(node.name);
        return names;
    };
    const std::set<std::string> whole = names_of(content);
    std::set<std::string> together;
    for (std::size_t layer = 0; layer < plot_layer_count; ++layer) {
        options.layers.fill(false);
        options.layers[layer] = true;
        const std::set<std::string> own = names_of(content);
        EXPECT_FALSE(own.empty()) << name(static_cast<PlotLayer>(layer));
        together.insert(own.begin(), own.end());
    }
    EXPECT_EQ(together, whole);
    // The layer of fungi, where none stands, is a file without meshes.
    PlotContent winter = content;
    winter.time += 100 * ticks_of_day;
    const Value json =
        json_chunk(joined(grow_plot(winter, options, atlas(), {}, with_morphs()).glb));
    EXPECT_EQ(json.find("nodes")->items().size(), 1U);
    for (const char* list : {"meshes", "materials", "buffers", "bufferViews", "accessors"})
        EXPECT_EQ(json.find(list), nullptr) << list;
    options.layers.fill(false);
    EXPECT_THROW(static_cast<void>(grow_plot(content, options, atlas())), InvalidInput);
}

TEST(Plot, RepeatsBodiesAndLeavesByInstances) {
    PlotOptions options = quick();
    options.textures = Textures::none;
    options.instancing = LeafInstancing::gpu;
    const Bytes file =
        joined(grow_plot(small_wood().content(), options, atlas(), {}, with_morphs()).glb);
    const ReadScene scene = expect_scene(file);
    std::size_t instances = 0;
    for (const ReadNode& node : scene.nodes) instances += node.instances.size();
    EXPECT_GT(instances, 60U);
    EXPECT_LE(scene.nodes.size(), 60U);
}

TEST(Plot, OfManyBodiesStaysWithinItsBudget) {
    SmallWood wood;
    const std::vector<FruitBody> few = wood.bodies;
    for (std::uint64_t k = 1; k < 20; ++k)
        for (FruitBody body : few) {
            body.id += k << 40U;
            body.at.y -= static_cast<std::int32_t>(k * 3000);
            wood.bodies.push_back(body);
        }
    PlotOptions options = quick();
    options.textures = Textures::none;
    const Grown grown = grow_plot(wood.content(), options, atlas(), {}, with_morphs());
    EXPECT_LE(grown.triangles, most_plot_triangles);
    const ReadScene scene = expect_scene(joined(grown.glb));
    EXPECT_LE(scene.nodes.size(), most_plot_nodes);
}

TEST(Plot, WithoutTreesAndFungiIsASlabWithGrassAndFlowers) {
    PlotContent content = small_wood().content();
    content.trees = {};
    content.dead_wood = {};
    content.bodies = {};
    content.kinds.clear();
    PlotOptions options = quick();
    options.textures = Textures::none;
    const ReadScene scene =
        expect_scene(joined(grow_plot(content, options, atlas(), {}, with_morphs()).glb));
    std::vector<std::string> names;
    for (const ReadNode& node : scene.nodes) names.push_back(node.name);
    // In September.
    EXPECT_EQ(names, (std::vector<std::string>{"plot_ground", "plot_soil", "daisy",
                                               "brown_knapweed", "grass"}));
}

TEST(Plot, RefusesWhatItCannotShow) {
    PlotContent content = small_wood().content();
    PlotOptions options = quick();
    const auto grown = [&] {
        static_cast<void>(grow_plot(content, options, atlas(), {}, with_morphs()));
    };
    content.kinds = {"no_such_tree"};
    EXPECT_THROW(grown(), InvalidInput);
    content = small_wood().content();
    content.size = 1.0;
    EXPECT_THROW(grown(), InvalidInput);
    content.size = 4.0;
    options.texture_size = 4096;
    EXPECT_THROW(grown(), InvalidInput);
    options.texture_size = 128;
    options.textures = Textures::linked;
    EXPECT_THROW(grown(), Impossible);
}

TEST(DayOfYear, GoesFromOneTo365) {
    EXPECT_EQ(day_of_year(time_of(0, 1)), 1);
    EXPECT_EQ(day_of_year(time_of(80, 365)), 365);
    EXPECT_EQ(day_of_year(time_of(81, 1) - 1), 365);
    EXPECT_EQ(day_of_year(time_of(-3, 200)), 200);
}

TEST(PlotContent, OfTheSouthHasTheSeasonsOfHalfAYearLater) {
    PlotContent content;
    content.time = time_of(80, 10);
    EXPECT_EQ(content.northern_day(), 10);
    content.is_southern = true;
    EXPECT_EQ(content.northern_day(), 192);
    content.time = time_of(80, 200);
    EXPECT_EQ(content.northern_day(), 17);
    EXPECT_TRUE(leaves_on(content.northern_day()).bare);
}

TEST(LeavesOn, TurnInAutumnAndAreGoneInWinter) {
    EXPECT_EQ(leaves_on(200), (LeafState{0.0, 0.0, false}));
    EXPECT_GT(leaves_on(310).autumn, 0.5);
    EXPECT_TRUE(leaves_on(350).bare);
    EXPECT_TRUE(leaves_on(40).bare);
    std::set<double> states;
    for (int day = 1; day <= 365; ++day) states.insert(leaves_on(day).autumn);
    EXPECT_LE(states.size(), 17U) << "so that trees of a plot are cached";
}

TEST(LeavesOn, AreYoungInMayAndGreenerFromDayToDay) {
    EXPECT_GT(leaves_on(118).spring, 0.8);
    EXPECT_EQ(leaves_on(170).spring, 0.0);
    EXPECT_EQ(leaves_on(100).spring, 0.0) << "there are none yet";
    std::set<double> states;
    for (int day = 113; day <= 365; ++day) {
        EXPECT_LE(leaves_on(day).spring, leaves_on(day - 1).bare ? 1.0 : leaves_on(day - 1).spring);
        states.insert(leaves_on(day).spring);
    }
    EXPECT_LE(states.size(), 9U) << "so that trees of a plot are cached";
}

}  // namespace
}  // namespace sporeprint::grow_plot_test
