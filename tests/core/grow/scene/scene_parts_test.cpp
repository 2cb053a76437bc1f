#include "core/grow/scene/scene_parts.h"

#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <vector>

#include "tests/support/refusals.h"
#include "tests/support/scene_parts.h"

namespace sporeprint::grow_scene_parts_test {
namespace {

using scenes::garden_caches;
using scenes::garden_spec;

TEST(SceneParts, HaveTheSpeciesOfTheWorldInTheirOrder) {
    const SceneFungi& fungi = scenes::garden_fungi();
    EXPECT_EQ(species_of(garden_spec()),
              (std::vector<std::string>{"fomes_fomentarius", "hypholoma_fasciculare",
                                        "marasmius_oreades", "pleurotus_ostreatus"}));
    ASSERT_EQ(fungi.species.size(), 4U);
    EXPECT_EQ(fungi.species[2].ecology.guild, Guild::grass);
    EXPECT_TRUE(fungi.species[0].ecology.body.perennial);
    EXPECT_EQ(fungi.genets.size(), 4U);
    EXPECT_DOUBLE_EQ(fungi.habitat->conditions.abundance, 3.0);
    EXPECT_GT(fungi.bytes(), 11 * 4 * fungi.habitat->surfels().size());
}

TEST(SceneParts, AreComputedOnceForEachKey) {
    SceneCaches caches = garden_caches();
    int shapes = 0, fungi = 0;
    std::shared_ptr<const SceneShape> shape;
    caches.shapes = [&](const std::string&, const auto& make) {
        if (!shape) {
            shape = make();
            ++shapes;
        }
        return shape;
    };
    caches.fungi = [&](const std::string&, const auto& make) {
        ++fungi;
        return make();
    };
    SceneSpec spec = garden_spec();
    spec.world.fungi.species = Text<620>("marasmius_oreades");
    const auto one = fungi_of_scene(spec, atlas(), caches, {});
    spec.world.seed = 4;
    const auto other = fungi_of_scene(spec, atlas(), caches, {});
    EXPECT_EQ(shapes, 1);
    EXPECT_EQ(fungi, 2);
    EXPECT_EQ(one->habitat->shape, other->habitat->shape);
}

TEST(SceneParts, HaveAnotherKeyForAllThatMattersAlone) {
    const std::string key = fungi_key(garden_spec());
    SceneSpec spec = garden_spec();
    spec.world.terrain.relief = 300.0;
    spec.world.stand.density = 0.1;
    spec.world.extent.value = 256;
    EXPECT_EQ(fungi_key(spec), key);
    const auto differs = [&](const auto& change) {
        SceneSpec changed = garden_spec();
        change(changed);
        EXPECT_NE(fungi_key(changed), key);
    };
    differs([](SceneSpec& s) { s.id = "s-other"; });
    differs([](SceneSpec& s) { s.world.seed = 8; });
    differs([](SceneSpec& s) { s.world.climate.rain = 600.0; });
    differs([](SceneSpec& s) { s.world.soil.acidity = 0.9; });
    differs([](SceneSpec& s) { s.world.fungi.abundance = 1.0; });
    differs([](SceneSpec& s) { s.scene.decay = 0.5; });
    differs([](SceneSpec& s) { s.scene.substrates = Text<1000>("Lawn:none"); });
}

TEST(SceneParts, NameWhatIsMissing) {
    const auto refused = [](const auto& change) {
        SceneSpec spec = garden_spec();
        change(spec);
        return refusal(
            [&] { static_cast<void>(fungi_of_scene(spec, atlas(), garden_caches(), {})); });
    };
    EXPECT_TRUE(names(refused([](SceneSpec& s) { s.id = "s-1"; }), "scene", "upload it"));
    EXPECT_TRUE(names(refused([](SceneSpec& s) { s.scene.substrates = Text<1000>("Rock:none"); }),
                      "substrates", "no material 'Rock'"));
    EXPECT_TRUE(
        names(refused([](SceneSpec& s) { s.world.fungi.species = Text<620>("boletus_plasticus"); }),
              "fungi.species", "boletus_plasticus"));
}

}  // namespace
}  // namespace sporeprint::grow_scene_parts_test
