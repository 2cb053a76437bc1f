#include "core/scene/scene_store.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <span>
#include <string>

#include "tests/support/scenes.h"

namespace sporeprint::scene_store_test {
namespace {

Scene some() {
    return scenes::Made()
        .floor(-1, -1, 1, 1, 0, "soil")
        .box({0, 0, 0}, {0.2F, 0.2F, 0.2F}, "Öld lög")
        .scene;
}

TEST(SceneStore, ReadsWhatItWrites) {
    const Scene scene = some();
    const auto read = scene_in(file_of(scene));
    ASSERT_TRUE(read);
    EXPECT_TRUE(*read == scene);
    EXPECT_TRUE(is_scene_id(id_of(scene)));
    EXPECT_EQ(id_of(*read), id_of(scene));
}

TEST(SceneStore, HasAnotherIdForEachDifference) {
    Scene scene = some();
    const std::string id = id_of(scene);
    scene.materials.back() += '.';
    EXPECT_NE(id_of(scene), id);
    scene = some();
    scene.positions[0].x = -1.5F;
    EXPECT_NE(id_of(scene), id);
    scene = some();
    scene.positions[0].y = -0.0F;
    EXPECT_EQ(id_of(scene), id) << "0 and -0 are one place";
    scene.triangles[0].material = 0;
    EXPECT_NE(id_of(scene), id);
}

TEST(SceneStore, RefusesWhatIsDamaged) {
    const Bytes file = file_of(some());
    for (std::size_t length = 0; length < file.size(); ++length)
        EXPECT_FALSE(scene_in(std::span(file).first(length))) << length;
    Bytes longer = file;
    longer.push_back(0);
    EXPECT_FALSE(scene_in(longer));
    Bytes other = file;
    other[7] = 2;
    EXPECT_FALSE(scene_in(other)) << "another format";
    other = file;
    other[other.size() - 4] = 200;
    EXPECT_FALSE(scene_in(other)) << "no such material";
    other = file;
    other[other.size() - 8] = 200;
    EXPECT_FALSE(scene_in(other)) << "no such vertex";
    EXPECT_FALSE(is_scene_id("s-0123"));
    EXPECT_FALSE(is_scene_id("t-0123456789abcdef0123456789abcdef"));
}

}  // namespace
}  // namespace sporeprint::scene_store_test
