#include "core/scene/scene.h"

#include <gtest/gtest.h>

#include "tests/support/scenes.h"

namespace sporeprint::scene_test {
namespace {

TEST(Scene, CountsTheMemoryOfItsNamesAndTriangles) {
    scenes::Made one;
    const std::size_t empty = one.scene.bytes();
    one.floor(0, 0, 1, 1, 0, "a material with a long name that needs memory of its own");
    EXPECT_GE(one.scene.bytes(), empty + 4 * sizeof(glm::vec3) + 2 * sizeof(SceneTriangle) + 50);
}

}  // namespace
}  // namespace sporeprint::scene_test
