#include "core/grow/set_materials.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "core/grow/set_file.h"
#include "core/surface/codecs.h"
#include "tests/support/glb_reader.h"
#include "tests/support/orders.h"
#include "tests/support/refusals.h"

namespace sporeprint::grow_set_materials_test {
namespace {

/// Returns a request for three species, one of them slimy, at two ages.
SetSpec set_with(AtlasShare atlas) {
    SetSpec spec;
    spec.species = {{{"amanita_muscaria", 1000}},
                    {{"hygrocybe_conica", 1000}},
                    {{"amanita_muscaria", 700}, {"boletus_edulis", 300}}};
    spec.params.ages = {0.3, 0.6};
    spec.params.seeds = 2;
    spec.params.levels = {2};
    spec.params.atlas = atlas;
    spec.mushroom.texture_size.value = 256;
    spec.mushroom.share = ImageShare::species;
    spec.packing = SetPacking::one_file;
    return spec;
}

Bytes file_of(const SetSpec& spec) {
    return joined(grow_set(spec, planned_set(spec, atlas(), {}), atlas()).glb);
}

/// Returns the file of an embedded image.
std::span<const std::uint8_t> file_of_image(const Bytes& file, const Value& json,
                                            std::size_t image) {
    const auto view_index = static_cast<std::size_t>(
        json.find("images")->items()[image].find("bufferView")->as_number());
    const Value& view = json.find("bufferViews")->items()[view_index];
    const auto number = [&](const char* member) {
        const Value* const found = view.find(member);
        return found ? static_cast<std::size_t>(found->as_number()) : 0;
    };
    std::size_t head = 0;  // length of the JSON chunk
    for (std::size_t i = 4; i > 0; --i) head = head << 8 | file[12 + i - 1];
    return {file.data() + 28 + head + number("byteOffset"), number("byteLength")};
}

/// Returns an embedded image, decoded.
Picture picture_of(const Bytes& file, const Value& json, std::size_t image) {
    return decoded_picture(file_of_image(file, json, image), "/image");
}

/// Returns the texel of a picture at a texture coordinate.
std::array<int, 3> texel_at(const Picture& picture, const glm::vec2& uv) {
    const auto place = [](float share, int count) {
        return std::min(static_cast<int>(share * static_cast<float>(count)), count - 1);
    };
    const std::size_t at =
        3 * static_cast<std::size_t>(place(uv.y, picture.height) * picture.width +
                                     place(uv.x, picture.width));
    return {picture.rgb[at], picture.rgb[at + 1], picture.rgb[at + 2]};
}

TEST(SetMaterials, EveryVertexHasTheColoursThatItHasWithoutAnAtlas) {
    const Bytes alone = file_of(set_with(AtlasShare::none));
    const ReadScene separate = expect_scene(alone);
    const Value json_alone = json_chunk(alone);
    for (const AtlasShare share : {AtlasShare::species, AtlasShare::set}) {
        SCOPED_TRACE(name(share));
        const Bytes file = file_of(set_with(share));
        const ReadScene together = expect_scene(file);
        const Value json = json_chunk(file);
        ASSERT_EQ(together.materials.size(), share == AtlasShare::set ? 1U : 3U);
        ASSERT_EQ(together.meshes.size(), separate.meshes.size());
        for (std::size_t image = 0; image < 3; ++image) {
            double off = 0.0;
            std::size_t count = 0;
            for (std::size_t i = 0; i < together.meshes.size(); ++i) {
                const ReadPrimitive &a = separate.meshes[i].front(),
                                    &b = together.meshes[i].front();
                ASSERT_EQ(a.mesh.positions, b.mesh.positions);
                ASSERT_EQ(a.mesh.tangents, b.mesh.tangents);
                const auto picture = [&](const Bytes& of, const Value& with, const ReadScene& scene,
                                         int material) {
                    return picture_of(
                        of, with,
                        static_cast<std::size_t>(
                            scene.materials[static_cast<std::size_t>(material)].images[image]));
                };
                const Picture first = picture(alone, json_alone, separate, a.material);
                const Picture second = picture(file, json, together, b.material);
                for (std::size_t v = 0; v < a.mesh.positions.size(); ++v) {
                    const auto x = texel_at(first, a.mesh.texture_coordinates[v]),
                               y = texel_at(second, b.mesh.texture_coordinates[v]);
                    for (std::size_t c = 0; c < 3; ++c) off += std::abs(x[c] - y[c]);
                    count += 3;
                }
            }
            EXPECT_LT(off / static_cast<double>(count), 2.0)
                << "levels of 255 in image " << image
                << ": blocks of JPEG are the same, but for the chroma at borders of tiles";
        }
    }
}

TEST(SetMaterials, ExtrasNameTheTileOfEveryIndividual) {
    const SetSpec spec = set_with(AtlasShare::set);
    const Value json = json_chunk(file_of(spec));
    const Value& extras = *json.find("asset")->find("extras");
    EXPECT_EQ(dump(*extras.find("atlases")), R"([{"material":0,"columns":4,"rows":2,"tiles":6}])");
    std::set<std::string> tiles;
    std::set<double> numbers;
    for (const Value& one : extras.find("individuals")->items()) {
        EXPECT_EQ(one.find("material")->as_number(), 0.0);
        const double tile = one.find("tile")->as_number();
        numbers.insert(tile);
        tiles.insert(dump(*one.find("species")) + dump(*one.find("age")) + ' ' +
                     std::to_string(tile));
    }
    EXPECT_EQ(numbers.size(), 6U);
    EXPECT_EQ(tiles.size(), 6U) << "seeds share the tile of their species and age";
    const Value none = json_chunk(file_of(set_with(AtlasShare::none)));
    EXPECT_EQ(none.find("asset")->find("extras")->find("atlases"), nullptr);

    const Value own = json_chunk(file_of(set_with(AtlasShare::species)));
    EXPECT_EQ(dump(*own.find("asset")->find("extras")->find("atlases")),
              R"([{"material":0,"columns":2,"rows":1,"tiles":2},)"
              R"({"material":1,"columns":2,"rows":1,"tiles":2},)"
              R"({"material":2,"columns":2,"rows":1,"tiles":2}])");
}

TEST(SetMaterials, ACoatOfSomeTilesIsAnImageWithATexelForEach) {
    const SetSpec spec = set_with(AtlasShare::set);
    const Bytes file = file_of(spec);
    const Value json = json_chunk(file);
    const std::string coat = "/materials/0/extensions/KHR_materials_clearcoat";
    const Value* const factor = json.at_pointer(coat + "/clearcoatFactor");
    ASSERT_NE(factor, nullptr);
    const auto texture =
        static_cast<std::size_t>(json.at_pointer(coat + "/clearcoatTexture/index")->as_number());
    const Value& used = json.find("textures")->items()[texture];
    const Value& sampler =
        json.find("samplers")->items()[static_cast<std::size_t>(used.find("sampler")->as_number())];
    EXPECT_EQ(sampler.find("minFilter")->as_number(), 9728.0);
    const Picture picture =
        picture_of(file, json, static_cast<std::size_t>(used.find("source")->as_number()));
    ASSERT_EQ(picture.width, 4);
    ASSERT_EQ(picture.height, 2);
    const SetPlan plan = planned_set(spec, atlas(), {});
    const auto& individuals = json.find("asset")->find("extras")->find("individuals")->items();
    for (std::size_t i = 0; i < plan.individuals.size(); ++i) {
        const MaterialLook look =
            look_of(resolve(file_spec(spec, plan.individuals[i], 0), atlas()).model);
        const auto tile = static_cast<std::size_t>(individuals[i].find("tile")->as_number());
        EXPECT_NEAR(factor->as_number() * picture.rgb[3 * tile] / 255.0, look.coat, 0.005);
    }
    SetSpec core = spec;
    core.mushroom.file.materials = MaterialSet::core;
    EXPECT_EQ(json_chunk(file_of(core)).find("images")->items().size(), 3U);
}

TEST(SetMaterials, EveryTileHasTheThinnessOfItsFlesh) {
    SetSpec spec = set_with(AtlasShare::set);
    spec.species[0] = {{"fomes_fomentarius", 1000}};
    spec.params.seeds = 1;
    spec.mushroom.file.materials = MaterialSet::rich;
    const Bytes file = file_of(spec);
    const Value json = json_chunk(file);
    const std::string through = "/materials/0/extensions/KHR_materials_diffuse_transmission";
    const Value* const index = json.at_pointer(through + "/diffuseTransmissionTexture/index");
    ASSERT_NE(index, nullptr);
    const Value& texture =
        json.find("textures")->items()[static_cast<std::size_t>(index->as_number())];
    const Picture picture = decoded_alpha(
        file_of_image(file, json, static_cast<std::size_t>(texture.find("source")->as_number())),
        "/image");
    ASSERT_EQ(picture.width, 2 * picture.height);
    const SetPlan plan = planned_set(spec, atlas(), {});
    const auto& individuals = json.find("asset")->find("extras")->find("individuals")->items();
    const int side = picture.width / 4;
    for (std::size_t i = 0; i < plan.individuals.size(); ++i) {
        const Flesh flesh =
            flesh_of(resolve(file_spec(spec, plan.individuals[i], 0), atlas()), in_turn);
        const int tile = static_cast<int>(individuals[i].find("tile")->as_number());
        double found = 0.0, expected = 0.0;
        for (int y = 0; y < side; ++y)
            for (int x = 0; x < side; ++x) {
                const int at = (tile / 4 * side + y) * picture.width + tile % 4 * side + x;
                found += picture.rgb[3 * static_cast<std::size_t>(at)];
                if (flesh.thinness.side > 0)
                    expected += flesh.thinness.shares[static_cast<std::size_t>(y * side + x)];
            }
        EXPECT_EQ(found, expected) << i;
    }
}

TEST(SetMaterials, AnAtlasOfOneImageIsThatOfItsOwn) {
    SetSpec spec = set_with(AtlasShare::species);
    spec.params.ages = {0.6};
    SetSpec none = spec;
    none.params.atlas = AtlasShare::none;
    const ReadScene a = expect_scene(file_of(spec)), b = expect_scene(file_of(none));
    ASSERT_EQ(a.materials.size(), b.materials.size());
    EXPECT_EQ(a.images, b.images);
    for (std::size_t i = 0; i < a.meshes.size(); ++i)
        EXPECT_EQ(a.meshes[i].front().mesh.texture_coordinates,
                  b.meshes[i].front().mesh.texture_coordinates);
}

TEST(SetMaterials, BothFormatsArePaintedOnce) {
    SetSpec spec = set_with(AtlasShare::set);
    spec.species.resize(2);
    spec.mushroom.file.image_format = ImageFormats::webp_jpg;
    std::set<std::string> keys;
    ExecutionContext execution;
    execution.caches.images = [&](const std::string& key, const auto& compute) {
        EXPECT_TRUE(keys.insert(key).second) << "every key once";
        return compute();
    };
    const Value json = json_chunk(
        joined(grow_set(spec, planned_set(spec, atlas(), {}), atlas(), {}, execution).glb));
    EXPECT_EQ(keys.size(), 2U);
    std::size_t webp = 0;
    for (const Value& image : json.find("images")->items())
        webp += image.find("mimeType")->as_string() == "image/webp" ? 1 : 0;
    EXPECT_EQ(webp, 3U);
}

TEST(SetMaterials, WhatOneAtlasCannotHoldIsRefused) {
    SetSpec spec = set_with(AtlasShare::set);
    spec.mushroom.share = ImageShare::individual;
    spec.params.seeds = 3;
    const auto refused = [&] { return refusal([&] { (void)planned_set(spec, atlas(), {}); }); };
    EXPECT_TRUE(names(refused(), "/atlas", "18 different images"));
    EXPECT_TRUE(names(refused(), "/atlas", "share=species"));
    spec.params.atlas = AtlasShare::species;
    EXPECT_TRUE(refused().empty()) << "six tiles each";
    spec.params.atlas = AtlasShare::set;
    spec.mushroom.share = ImageShare::species;
    EXPECT_TRUE(refused().empty());
    spec.mushroom.texture_size.value = 2048;
    spec.params.levels = {0, 3};
    EXPECT_TRUE(names(refused(), "/texture_size", "8192"));
    spec.params.levels = {1, 3};
    EXPECT_TRUE(refused().empty());
    for (const Textures textures : {Textures::none, Textures::linked, Textures::external}) {
        spec.mushroom.textures = textures;
        EXPECT_TRUE(names(refused(), "/atlas", "embedded"));
    }
    spec.mushroom.textures = Textures::embedded;
    spec.packing = SetPacking::files;
    EXPECT_TRUE(names(refused(), "/atlas", "one file"));

    // Only the colours of glow may differ here, those of templates.
    SetSpec glowing = set_with(AtlasShare::set);
    SetMaterials materials(glowing);
    const SetPlan plan = planned_set(glowing, atlas(), {});
    const auto no_flesh = [] { return Flesh{}; };
    (void)materials.add(plan.individuals.front(), {.glow = glm::dvec3(0.5)}, no_flesh);
    (void)materials.add(plan.individuals.back(), {}, no_flesh);
    GlbScene scene;
    EXPECT_TRUE(names(refusal([&] { materials.add_to(scene, atlas(), {}, {}); }), "/atlas",
                      "glow differently"));
}

TEST(SetMaterials, DrawCallsAreThoseOfMaterials) {
    SetSpec spec = set_with(AtlasShare::species);
    spec.params.draw_calls = 3;
    EXPECT_EQ(planned_set(spec, atlas(), {}).seeds, 2) << "no seed is left out";
    spec.params.draw_calls = 2;
    EXPECT_TRUE(
        names(refusal([&] { (void)planned_set(spec, atlas(), {}); }), "/draw_calls", "atlas=set"));
    spec.params.atlas = AtlasShare::set;
    EXPECT_EQ(planned_set(spec, atlas(), {}).seeds, 2);
}

TEST(SetMaterials, EstimatesAreThoseOfTheFile) {
    for (const AtlasShare share : {AtlasShare::species, AtlasShare::set}) {
        SetSpec spec = set_with(share);
        spec.mushroom.texture_size.value = 1024;
        const SetPlan plan = planned_set(spec, atlas(), {});
        const auto size = static_cast<double>(joined(grow_set(spec, plan, atlas()).glb).size());
        EXPECT_NEAR(static_cast<double>(plan.total().bytes) / size, 1.0, 0.45) << name(share);
        const std::uint64_t tile = 256 * 256, tiles = share == AtlasShare::set ? 8 : 2;
        EXPECT_GE(plan.individuals.front().files.front().texels, 3 * (tiles + 1) * tile)
            << "the atlas, and a painting that is copied into it";
    }
}

}  // namespace
}  // namespace sporeprint::grow_set_materials_test
