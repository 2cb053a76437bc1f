#include "core/grow/translucency.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "core/grow/colony.h"
#include "core/grow/leaf.h"
#include "core/grow/mushroom.h"
#include "tests/support/glb_reader.h"
#include "tests/support/orders.h"
#include "tests/support/solids.h"

namespace sporeprint::grow_translucency_test {
namespace {

constexpr const char* extension = "KHR_materials_diffuse_transmission";

MushroomSpec order_with(MaterialSet materials, const std::string& id) {
    MushroomSpec spec = order_of(id, 0.6, 3, 2);
    spec.params.textures = Textures::embedded;
    spec.params.texture_size.value = 128;
    spec.params.file.materials = materials;
    return spec;
}

Value document_of(const MushroomSpec& spec) {
    return json_chunk(joined(grow_mushroom(spec, atlas()).glb));
}

/// Returns how a file states the transmission of its first material; null if it does not.
const Value* transmission(const Value& json) {
    return json.at_pointer(std::string("/materials/0/extensions/") + extension);
}

TEST(Translucency, LightThatPassesAPlateFallsWithItsThickness) {
    constexpr double translucency = 0.002;
    double before = 1.0;
    for (const float depth : {0.0005F, 0.002F, 0.005F}) {
        const Mesh mesh = plate(0.1F, depth);
        const Thinness thinness = thinness_of(mesh, translucency, 64, in_turn);
        const double expected = std::exp(-static_cast<double>(depth) / translucency);
        // The middles of both faces, which are the halves of the image.
        for (const std::size_t x : {16U, 48U})
            EXPECT_NEAR(thinness.shares[32 * 64 + x] / 255.0, expected, 0.5 / 255.0 + 1e-6);
        EXPECT_LT(expected, before);
        before = expected;
    }
}

TEST(Translucency, TexelsBesideATriangleContinueIt) {
    Mesh mesh = plate(0.1F, 0.001F);
    // The upper face fills a corner of the image, and nothing else is there.
    for (std::size_t i = 0; i < mesh.positions.size(); ++i)
        mesh.texture_coordinates[i] =
            mesh.normals[i].y > 0.0F ? mesh.texture_coordinates[i] * 0.5F + 0.25F : glm::vec2(0.3F);
    const Thinness thinness = thinness_of(mesh, 0.002, 64, in_turn);
    for (const std::uint8_t share : thinness.shares)
        EXPECT_NEAR(share / 255.0, std::exp(-0.5), 0.12) << "no texel is opaque";
}

TEST(Translucency, OnlyRichFilesOfTranslucentFleshStateIt) {
    for (const std::string& id : species_ids()) {
        SCOPED_TRACE(id);
        const bool is_translucent =
            resolve(order_of(id), atlas()).model.material.translucency > 0.0;
        const Value rich = document_of(order_with(MaterialSet::rich, id));
        EXPECT_EQ(transmission(rich) != nullptr, is_translucent);
        EXPECT_EQ(rich.find("extensionsRequired"), nullptr);
    }
    for (const char* id : {"fomes_fomentarius", "trametes_versicolor", "daldinia_concentrica"}) {
        const Value rich = document_of(order_with(MaterialSet::rich, id)),
                    full = document_of(order_with(MaterialSet::full, id));
        EXPECT_EQ(transmission(rich), nullptr) << id;
        EXPECT_EQ(dump(*rich.find("materials")), dump(*full.find("materials"))) << id;
        EXPECT_EQ(dump(*rich.find("images")), dump(*full.find("images"))) << id;
    }
    for (const MaterialSet other : {MaterialSet::full, MaterialSet::core})
        EXPECT_EQ(transmission(document_of(order_with(other, "mycena_galericulata"))), nullptr);
}

TEST(Translucency, ThinFleshHasAnImageAndMoreLightThanThickFlesh) {
    const Value json = document_of(order_with(MaterialSet::rich, "mycena_galericulata"));
    const Value* const through = transmission(json);
    ASSERT_NE(through, nullptr);
    EXPECT_GT(through->find("diffuseTransmissionFactor")->as_number(), 0.0);
    EXPECT_LE(through->find("diffuseTransmissionFactor")->as_number(), 1.0);
    EXPECT_EQ(json.find("images")->items().size(), 4U);
    const auto texture = static_cast<std::size_t>(
        through->find("diffuseTransmissionTexture")->find("index")->as_number());
    const auto image = static_cast<std::size_t>(
        json.find("textures")->items()[texture].find("source")->as_number());
    EXPECT_EQ(json.find("images")->items()[image].find("mimeType")->as_string(), "image/png");

    const auto mean_of = [](const char* id) {
        return flesh_of(resolve(order_of(id), atlas()), in_turn).thinness.mean;
    };
    EXPECT_GT(mean_of("mycena_galericulata"), mean_of("amanita_muscaria") + 0.1);
    EXPECT_GT(mean_of("tremella_mesenterica"), mean_of("boletus_edulis") + 0.1);
}

TEST(Translucency, WithoutImagesItIsTheSameEverywhere) {
    MushroomSpec spec = order_with(MaterialSet::rich, "mycena_galericulata");
    const double most =
        transmission(document_of(spec))->find("diffuseTransmissionFactor")->as_number();
    spec.params.textures = Textures::none;
    const Value json = document_of(spec);
    ASSERT_NE(transmission(json), nullptr);
    const double mean = transmission(json)->find("diffuseTransmissionFactor")->as_number();
    EXPECT_GT(mean, 0.0);
    EXPECT_LT(mean, most);
    EXPECT_EQ(transmission(json)->find("diffuseTransmissionTexture"), nullptr);
    EXPECT_EQ(transmission(json)->find("diffuseTransmissionColorTexture"), nullptr);
}

TEST(Translucency, VariantsShareTheImage) {
    MushroomSpec spec = order_with(MaterialSet::rich, "mycena_galericulata");
    spec.params.variants = Variants::weather;
    const Value json = document_of(spec);
    EXPECT_EQ(json.find("images")->items().size(), 13U);
    for (std::size_t i = 0; i < json.find("materials")->items().size(); ++i)
        EXPECT_NE(json.find("materials")->items()[i].find("extensions")->find(extension), nullptr);
}

TEST(Translucency, AMixIsBetweenItsSpecies) {
    MushroomSpec spec = order_of("mycena_galericulata");
    spec.mix = {{"mycena_galericulata", 500}, {"boletus_edulis", 500}};
    const double mixed = resolve(spec, atlas()).model.material.translucency;
    EXPECT_GT(mixed, resolve(order_of("boletus_edulis"), atlas()).model.material.translucency);
    EXPECT_LT(mixed, resolve(order_of("mycena_galericulata"), atlas()).model.material.translucency);
}

TEST(Translucency, ColoniesAndLeavesStateItToo) {
    ColonySpec colony;
    colony.mix = {{"coprinellus_disseminatus", 1000}};
    colony.params.count = 5;
    colony.params.lod = 3;
    colony.params.texture_size.value = 128;
    colony.params.file.materials = MaterialSet::rich;
    EXPECT_NE(transmission(json_chunk(joined(grow_colony(colony, atlas()).glb))), nullptr);

    LeafSpec leaf;
    leaf.preset = "oak";
    leaf.params = params_of(*atlas().find_leaf("oak"));
    leaf.params.texture_size.value = 128;
    EXPECT_EQ(transmission(json_chunk(joined(grow_leaf(leaf, atlas()).glb))), nullptr);
    leaf.params.file.materials = MaterialSet::rich;
    const Value json = json_chunk(joined(grow_leaf(leaf, atlas()).glb));
    ASSERT_NE(transmission(json), nullptr);
    EXPECT_EQ(transmission(json)->find("diffuseTransmissionTexture"), nullptr);
    EXPECT_LT(transmission(json)->find("diffuseTransmissionColorFactor")->items()[2].as_number(),
              transmission(json)->find("diffuseTransmissionColorFactor")->items()[1].as_number());
}

}  // namespace
}  // namespace sporeprint::grow_translucency_test
