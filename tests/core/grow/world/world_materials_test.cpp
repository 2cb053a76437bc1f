#include "core/grow/world/world_materials.h"

#include <gtest/gtest.h>

#include <string>

#include "core/surface/paint.h"
#include "tests/support/atlas.h"

namespace sporeprint::grow_world_materials_test {
namespace {

MaterialUrls named_urls() {
    const auto urls = [](const std::string& of) {
        return ImageUrls{{of + "_c.jpg", of + "_n.jpg", of + "_o.jpg"},
                         {of + "_c.webp", of + "_n.webp", of + "_o.webp"}};
    };
    MaterialUrls all;
    all.bark = [urls](const TreeSpec& tree) { return urls(tree.preset); };
    all.leaves = [urls](const std::string& leaf, const LeafPaint&) { return urls(leaf); };
    all.skin = [urls](const MushroomSpec& spec) { return urls(spec.mix.front().id); };
    all.wood = [urls](const WoodPaint&) { return urls("wood"); };
    return all;
}

ImageSet grey_images(ImageFormat format) {
    RawImages images{16, {}, {}};
    for (Bytes& image : images.rgb) image.assign(3 * 16 * 16, 128);
    return encoded(images, format, in_turn);
}

TEST(WorldMaterials, AreMadeOnceForEachName) {
    GlbScene scene;
    const FileOptions file;
    const MaterialUrls urls = named_urls();
    const ExecutionContext execution;
    WorldMaterials materials(scene, Textures::linked, file, urls, atlas(), execution);
    const TreeSpec birch{"birch", params_of(*atlas().find_tree("birch"))};
    const std::size_t bark = materials.bark(birch);
    EXPECT_EQ(materials.bark(birch), bark);
    EXPECT_NE(materials.plain("grass"), bark);
    EXPECT_EQ(materials.plain("grass"), materials.plain("grass"));
    EXPECT_EQ(scene.materials.size(), 2U);
    EXPECT_TRUE(scene.materials[bark].repeats_u);
}

TEST(WorldMaterials, LinkTheirImagesButForThoseOfTheGround) {
    GlbScene scene;
    const FileOptions file;
    const MaterialUrls urls = named_urls();
    const ExecutionContext execution;
    WorldMaterials materials(scene, Textures::linked, file, urls, atlas(), execution);
    const WoodPaint paint{Substrate::birch, {64}};
    const GlbMaterial wood = scene.materials[materials.wood(paint)];
    EXPECT_EQ(wood.image_urls[0], "wood_c.jpg");
    EXPECT_EQ(wood.images, nullptr);
    const GlbMaterial ground = scene.materials[materials.ground("ground", grey_images)];
    EXPECT_NE(ground.images, nullptr);
    EXPECT_EQ(ground.image_urls[0], "");
}

TEST(WorldMaterials, HaveNoImagesInFilesWithout) {
    GlbScene scene;
    const FileOptions file;
    const MaterialUrls none;
    const ExecutionContext execution;
    WorldMaterials materials(scene, Textures::none, file, none, atlas(), execution);
    const WoodPaint paint{Substrate::birch, {64}};
    for (const std::size_t index :
         {materials.wood(paint), materials.ground("ground", grey_images)}) {
        EXPECT_EQ(scene.materials[index].images, nullptr);
        EXPECT_EQ(scene.materials[index].image_urls[0], "");
    }
}

}  // namespace
}  // namespace sporeprint::grow_world_materials_test
