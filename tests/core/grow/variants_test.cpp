#include "core/grow/variants.h"

#include <gtest/gtest.h>

#include <set>
#include <string>
#include <vector>

#include "core/grow/mushroom.h"
#include "core/grow/painting.h"
#include "tests/support/glb_reader.h"
#include "tests/support/orders.h"
#include "tests/support/refusals.h"

namespace sporeprint::grow_variants_test {
namespace {

MushroomSpec order_with_variants(const std::string& id) {
    MushroomSpec spec = order_of(id, 0.6, 3, 2);
    spec.params.textures = Textures::embedded;
    spec.params.texture_size.value = 128;
    spec.params.variants = Variants::weather;
    return spec;
}

TEST(Variants, EverySpeciesHasFourThatAreOnlyPainted) {
    for (const std::string& id : species_ids()) {
        SCOPED_TRACE(id);
        const MushroomSpec spec = order_with_variants(id);
        const Individual individual = resolve(spec, atlas());
        const std::vector<Variant> variants = variants_of(spec, individual);
        ASSERT_EQ(variants.size(), 4U);
        const Mesh mesh = mushroom_mesh(spec, individual);
        std::set<std::string> images{image_key(paint_spec_of(spec, atlas()), ImageFormat::jpg)};
        for (const Variant& variant : variants) {
            if (!variant.has_own_images) continue;
            const Individual other = resolve(variant.painted, atlas());
            EXPECT_EQ(mushroom_mesh(variant.painted, other).positions, mesh.positions)
                << variant.name;
            images.insert(image_key(paint_spec_of(variant.painted, atlas()), ImageFormat::jpg));
        }
        EXPECT_EQ(images.size(), 4U) << "the requested one, dry, wet and aged";
        EXPECT_GT(variants[1].look.coat, variants[0].look.coat) << "wet over dry";
        EXPECT_GT(variants[3].look.sheen.x, variants[0].look.sheen.x) << "frosted over dry";
    }
    const MushroomSpec plain = order_of("boletus_edulis");
    EXPECT_TRUE(variants_of(plain, resolve(plain, atlas())).empty());
}

TEST(Variants, AFileMapsThemToMaterials) {
    const MushroomSpec spec = order_with_variants("amanita_muscaria");
    const Bytes file = joined(grow_mushroom(spec, atlas()).glb);
    const Value json = json_chunk(file);
    const Value* const root = json.at_pointer("/extensions/KHR_materials_variants/variants");
    ASSERT_NE(root, nullptr);
    std::vector<std::string> names;
    for (const Value& variant : root->items()) names.push_back(variant.find("name")->as_string());
    EXPECT_EQ(names, (std::vector<std::string>{"dry", "wet", "aged", "frosted"}));
    EXPECT_EQ(json.find("materials")->items().size(), 5U);
    EXPECT_EQ(json.find("images")->items().size(), 12U) << "frosted has those of the requested one";
    const Value& primitive = json.find("meshes")->items()[0].find("primitives")->items()[0];
    const auto& mappings =
        primitive.at_pointer("/extensions/KHR_materials_variants/mappings")->items();
    ASSERT_EQ(mappings.size(), 4U);
    for (std::size_t i = 0; i < mappings.size(); ++i) {
        EXPECT_EQ(mappings[i].find("material")->as_number(), static_cast<double>(i + 1));
        EXPECT_EQ(mappings[i].find("variants")->items()[0].as_number(), static_cast<double>(i));
        const std::string& own = json.find("materials")->items()[i + 1].find("name")->as_string();
        EXPECT_TRUE(own.ends_with('_' + names[i])) << own;
    }
    EXPECT_EQ(primitive.find("material")->as_number(), 0.0);
}

TEST(Variants, AClipHasThemToo) {
    MushroomSpec spec = order_with_variants("boletus_edulis");
    spec.params.animation = Animation::growth;
    spec.params.frames = 2;
    const Value json = json_chunk(joined(grow_mushroom(spec, atlas()).glb));
    EXPECT_EQ(json.find("materials")->items().size(), 5U);
    EXPECT_EQ(json.find("animations")->items().size(), 1U);
}

TEST(Variants, EstimatesCountTheirImages) {
    const MushroomSpec spec = order_with_variants("boletus_edulis");
    const auto size = static_cast<double>(joined(grow_mushroom(spec, atlas()).glb).size());
    EXPECT_NEAR(static_cast<double>(estimate(spec, atlas()).bytes) / size, 1.0, 0.5);
}

TEST(Variants, NeedImagesAndExtensions) {
    MushroomSpec spec = order_with_variants("boletus_edulis");
    spec.params.textures = Textures::none;
    EXPECT_TRUE(names(refusal([&] { (void)estimate(spec, atlas()); }), "/variants", "textures"));
    spec = order_with_variants("boletus_edulis");
    spec.params.file.materials = MaterialSet::core;
    EXPECT_TRUE(names(refusal([&] { (void)estimate(spec, atlas()); }), "/variants", "materials"));
}

}  // namespace
}  // namespace sporeprint::grow_variants_test
