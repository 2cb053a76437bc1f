#include "core/gltf/glb.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <functional>
#include <glm/common.hpp>
#include <memory>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/grow/mushroom.h"
#include "core/grow/painting.h"
#include "core/params/value.h"
#include "tests/support/glb_parts.h"
#include "tests/support/glb_reader.h"
#include "tests/support/meshes.h"
#include "tests/support/orders.h"

namespace sporeprint::gltf_glb_test {
namespace {

const std::vector<std::string> plain = {"NORMAL", "POSITION"};
const std::vector<std::string> full = {"NORMAL", "POSITION", "TANGENT", "TEXCOORD_0"};

GlbParts parts_of(const std::string& name, const std::array<std::string, 3>& addresses = {}) {
    GlbParts parts;
    parts.name = name;
    parts.image_urls = addresses;
    return parts;
}

TEST(Glb, ABareMeshReadsBackAsItWas) {
    for (const std::string& id : species_ids()) {
        const Mesh mesh = mesh_of(order_of(id, 0.6, 2, 1));
        const ReadBack found = expect_glb(joined(glb(mesh, parts_of(id))));
        EXPECT_EQ(found.attributes, plain);
        EXPECT_TRUE(same_bits(found.mesh, mesh));
        EXPECT_EQ(found.index_component, 5123) << "16 bits while they fit";
        EXPECT_EQ(found.node, id);
        EXPECT_EQ(found.textures, 0u);
        EXPECT_TRUE(found.generator.starts_with("Sporeprint ")) << found.generator;
    }
}

TEST(Glb, TextureCoordinatesAndTangentsAreWrittenExactlyWhenThereAreImages) {
    const Mesh mesh = mesh_of(textured(order_of("mycena_sanguinolenta", 0.6, 2, 2)));
    ASSERT_FALSE(mesh.tangents.empty());
    EXPECT_EQ(expect_glb(joined(glb(mesh, parts_of("m")))).attributes, plain);
    const ReadBack linked =
        expect_glb(joined(glb(mesh, parts_of("m", {"/a.jpg", "/b.jpg", "/c.jpg"}))));
    EXPECT_EQ(linked.attributes, full);
    EXPECT_EQ(linked.uris, (std::vector<std::string>{"/a.jpg", "/b.jpg", "/c.jpg"}));
    EXPECT_TRUE(linked.images.empty());
    EXPECT_EQ(linked.textures, 3u);
    EXPECT_TRUE(same_bits(linked.mesh.tangents, mesh.tangents));
    for (std::size_t i = 0; i < mesh.positions.size(); ++i)
        EXPECT_LT(glm::distance(linked.mesh.texture_coordinates[i], mesh.texture_coordinates[i]),
                  1.1e-5f)
            << "half a step of 1/65535";
}

TEST(Glb, EmbeddedImagesDecodeToTheirSizeAndAreNeverCopied) {
    const MushroomSpec order = painted(order_of("boletus_edulis", 0.6, 2, 1), 256);
    const Individual individual = resolve(order, atlas());
    const Mesh mesh = mushroom_mesh(order, individual);
    const ImageSet images = *painted_images(paint_spec_of(order, atlas()), {});
    GlbParts parts = parts_of("b");
    parts.images = &images;
    const Body body = glb(mesh, parts);
    const ReadBack found = expect_glb(joined(body));
    EXPECT_EQ(found.attributes, full);
    EXPECT_EQ(found.images, (std::vector<std::array<int, 2>>(3, {128, 128})));
    for (const Slice& file : images.files)
        EXPECT_EQ(std::count_if(body.begin(), body.end(),
                                [&](const Slice& slice) {
                                    return slice.owner == file.owner &&
                                           slice.data() == file.data() && slice.size == file.size;
                                }),
                  1)
            << "the body holds the image's own bytes";
    // Head, geometry, and at most the padding of each image.
    EXPECT_LE(body.size(), 8u);
    std::size_t own = 0;
    for (const Slice& slice : body) own += slice.size;
    EXPECT_EQ(own, size_of(body));
}

/// Returns the JSON of a file.
Value document_of(const Body& body) {
    const Bytes file = joined(body);
    std::uint32_t size = 0;
    std::memcpy(&size, file.data() + 12, 4);
    std::vector<Problem> problems;
    Value json =
        parse(std::string_view(reinterpret_cast<const char*>(file.data()) + 20, size), problems);
    EXPECT_EQ(problems, std::vector<Problem>{});
    return json;
}

TEST(Glb, MaterialExtensionsAreNamedExactlyWhenTheyAreUsed) {
    const Mesh mesh = mesh_of(textured(order_of("mycena_sanguinolenta", 0.6, 2, 2)));
    const std::array<std::string, 3> images = {"/a.jpg", "/b.jpg", "/c.jpg"};
    const auto written = [&](const MaterialLook& look, bool textured = true) {
        GlbParts parts = textured ? parts_of("m", images) : parts_of("m");
        parts.look = look;
        return document_of(glb(mesh, parts));
    };
    const Value none = written({});
    EXPECT_EQ(none.find("extensionsUsed"), nullptr);
    EXPECT_EQ(none.at_pointer("/materials/0/extensions"), nullptr);
    EXPECT_EQ(none.at_pointer("/materials/0/emissiveFactor"), nullptr);

    const Value coated = written({.coat = 0.5});
    EXPECT_EQ(dump(*coated.find("extensionsUsed")), R"(["KHR_materials_clearcoat"])");
    const std::string coat = "/materials/0/extensions/KHR_materials_clearcoat";
    EXPECT_EQ(coated.at_pointer(coat + "/clearcoatFactor")->as_number(), 0.5);
    // Its roughness is the painted one: glossy on slime only.
    EXPECT_EQ(coated.at_pointer(coat + "/clearcoatRoughnessFactor")->as_number(), 1.0);
    EXPECT_EQ(coated.at_pointer(coat + "/clearcoatRoughnessTexture/index")->as_number(), 2.0);
    EXPECT_EQ(written({.coat = 0.5}, false).at_pointer(coat + "/clearcoatRoughnessTexture"),
              nullptr);

    const Value all = written({.coat = 1.0, .sheen = glm::dvec3(0.25), .glow = {0.0, 0.5, 0.25}});
    EXPECT_EQ(
        dump(*all.find("extensionsUsed")),
        R"(["KHR_materials_clearcoat","KHR_materials_emissive_strength","KHR_materials_sheen"])");
    EXPECT_EQ(all.find("extensionsRequired"), nullptr);
    EXPECT_EQ(dump(*all.at_pointer("/materials/0/emissiveFactor")), "[0,0.5,0.25]");
    EXPECT_EQ(all.at_pointer("/materials/0/emissiveTexture/index")->as_number(), 0.0);
    EXPECT_EQ(dump(*all.at_pointer("/materials/0/extensions/KHR_materials_sheen/sheenColorFactor")),
              "[0.25,0.25,0.25]");
}

TEST(Glb, LightThatPassesIsAnOptionalExtensionWithOneImage) {
    Mesh mesh = mesh_of(textured(order_of("mycena_sanguinolenta", 0.6, 2, 2)));
    const Slice thinness = slice_of("PNG");
    const auto written = [&](const GlbTransmission& through, bool textured, bool extended = true) {
        GlbScene scene;
        for (const char* name : {"dry", "wet"}) {
            scene.materials.push_back({.name = name, .transmission = through});
            if (textured) scene.materials.back().image_urls = {"/a.jpg", "/b.jpg", "/c.jpg"};
        }
        scene.meshes.push_back({"m", {{&mesh, 0, {}}, {&mesh, 1, {}}}});
        scene.nodes.push_back({.name = "m", .mesh = 0});
        scene.material_extensions = extended;
        return document_of(glb(scene));
    };
    const std::string path = "/materials/1/extensions/KHR_materials_diffuse_transmission";
    EXPECT_EQ(written({}, true).find("extensionsUsed"), nullptr);
    const GlbTransmission through{0.5, {1.0, 0.5, 0.25}, thinness, 0.5};
    EXPECT_EQ(written(through, true, false).find("extensionsUsed"), nullptr);

    const Value rich = written(through, true);
    EXPECT_EQ(dump(*rich.find("extensionsUsed")), R"(["KHR_materials_diffuse_transmission"])");
    EXPECT_EQ(rich.find("extensionsRequired"), nullptr);
    EXPECT_EQ(dump(*rich.at_pointer(path)),
              R"({"diffuseTransmissionFactor":0.5,"diffuseTransmissionTexture":{"index":3},)"
              R"("diffuseTransmissionColorFactor":[1,0.5,0.25],)"
              R"("diffuseTransmissionColorTexture":{"index":0}})");
    EXPECT_EQ(rich.find("images")->items().size(), 4U) << "both materials share it";

    const Value bare = written(through, false);
    EXPECT_EQ(
        dump(*bare.at_pointer(path)),
        R"({"diffuseTransmissionFactor":0.25,"diffuseTransmissionColorFactor":[1,0.5,0.25]})");
    EXPECT_EQ(bare.find("images"), nullptr);
}

TEST(Glb, TheModelDeterminesClearcoatSheenAndEmission) {
    MushroomSpec order = textured(order_of("x", 0.6, 2, 2));
    order.mix.clear();
    order.model = atlas().find("boletus_edulis")->species.stages[2].model;
    order.model->weathering.wetness = 0.0;
    order.params.textures = Textures::none;
    const auto used = [&] {
        const Value json = document_of(grow_mushroom(order, atlas()).glb);
        const Value* names = json.find("extensionsUsed");
        return names ? names->items().size() : 0;
    };
    EXPECT_EQ(used(), 0u);
    order.model->material.slime = 1.0;
    EXPECT_EQ(used(), 1u);
    order.model->material.velvet = 0.5;
    EXPECT_EQ(used(), 2u);
    order.params.ornaments.glow = 0.3;
    EXPECT_EQ(used(), 3u);
}

TEST(Glb, LargeMeshesHaveWideIndices) {
    Mesh mesh;  // many tetrahedra
    for (int i = 0; i < 16384; ++i) {
        const auto at = static_cast<std::uint32_t>(mesh.positions.size());
        const glm::vec3 place(static_cast<float>(i), 0.0f, 0.0f);
        for (const glm::vec3& p : {glm::vec3(0.0f), glm::vec3(0.5f, 0.0f, 0.0f),
                                   glm::vec3(0.0f, 0.5f, 0.0f), glm::vec3(0.0f, 0.0f, 0.5f)}) {
            mesh.positions.push_back(place + p);
            mesh.normals.emplace_back(0.0f, 1.0f, 0.0f);
        }
        for (const std::uint32_t k : {0u, 2u, 1u, 0u, 1u, 3u, 0u, 3u, 2u, 1u, 2u, 3u})
            mesh.indices.push_back(at + k);
    }
    ASSERT_EQ(mesh.positions.size(), 65536u);
    ReadBack found = read_back(joined(glb(mesh, parts_of("many"))));
    EXPECT_EQ(found.index_component, 5125);
    EXPECT_TRUE(same_bits(found.mesh.indices, mesh.indices));
    mesh.positions.resize(65532);
    mesh.normals.resize(65532);
    mesh.indices.resize(mesh.indices.size() - 12);
    found = read_back(joined(glb(mesh, parts_of("fewer"))));
    EXPECT_EQ(found.index_component, 5123);
    EXPECT_TRUE(same_bits(found.mesh.indices, mesh.indices));
}

TEST(Glb, NamesAreEscapedAndExtrasUnchanged) {
    const Mesh mesh = mesh_of(order_of("boletus_edulis", 0.6, 1, 3));
    const std::string name = "a \"quoted\\ name\"\n\x01 é";
    GlbParts parts = parts_of(name);
    parts.extras_json = R"({"canonical":"/v1/x?y=1"})";
    const ReadBack found = expect_glb(joined(glb(mesh, parts)));
    EXPECT_EQ(found.node, name);
    EXPECT_EQ(found.canonical, "/v1/x?y=1");
}

/// Returns two targets for a mesh: one lifts it, one flips its normals.
std::vector<MorphTarget> lift_and_turn(const Mesh& mesh) {
    const std::size_t n = mesh.positions.size();
    std::vector<MorphTarget> targets(2);
    targets[0] = {"lift", std::vector<glm::vec3>(n, {0.0f, 0.25f, 0.0f}),
                  std::vector<glm::vec3>(n, glm::vec3(0.0f))};
    targets[1].name = "\"turn\"";
    targets[1].positions.assign(n, glm::vec3(0.0f));
    for (const glm::vec3& normal : mesh.normals) targets[1].normals.push_back(-2.0f * normal);
    return targets;
}

TEST(Glb, MorphTargetsAndTheirClipReadBackAsTheyWere) {
    const Mesh mesh = mesh_of(order_of("boletus_edulis", 0.6, 1, 3));
    const std::vector<MorphTarget> targets = lift_and_turn(mesh);
    const WeightClip clip{"there and back", {0.0f, 0.5f, 2.0f}, {0, 0, 1, 0, 0.25f, 0.75f}};
    GlbParts parts = parts_of("moving");
    parts.targets = targets;
    parts.clip = &clip;
    const ReadBack found = expect_glb(joined(glb(mesh, parts)));
    EXPECT_TRUE(same_bits(found.mesh, mesh)) << "the mesh itself is the pose without weights";
    ASSERT_EQ(found.targets.size(), 2u);
    for (std::size_t i = 0; i < 2; ++i) {
        EXPECT_EQ(found.targets[i].name, targets[i].name);
        EXPECT_TRUE(same_bits(found.targets[i].positions, targets[i].positions));
        EXPECT_TRUE(same_bits(found.targets[i].normals, targets[i].normals));
    }
    ASSERT_EQ(found.clips.size(), 1u);
    EXPECT_EQ(found.clips[0].name, clip.name);
    EXPECT_TRUE(same_bits(found.clips[0].times, clip.times));
    EXPECT_TRUE(same_bits(found.clips[0].weights, clip.weights));
    EXPECT_EQ(found.node, "moving");
}

TEST(Glb, ImagesFollowTheClip) {
    const MushroomSpec order = painted(order_of("boletus_edulis", 0.6, 3, 2));
    const Individual individual = resolve(order, atlas());
    const Mesh mesh = mushroom_mesh(order, individual);
    const ImageSet images = *painted_images(paint_spec_of(order, atlas()), {});
    const std::vector<MorphTarget> targets = lift_and_turn(mesh);
    const WeightClip clip{"c", {0.0f, 1.0f}, {1, 0, 0, 1}};
    GlbParts parts = parts_of("b");
    parts.targets = targets;
    parts.clip = &clip;
    parts.images = &images;
    const ReadBack found = expect_glb(joined(glb(mesh, parts)));
    EXPECT_EQ(found.attributes, full);
    EXPECT_EQ(found.images, (std::vector<std::array<int, 2>>(3, {32, 32})));
    EXPECT_EQ(found.targets.size(), 2u);
    EXPECT_EQ(found.clips.size(), 1u);
}

TEST(Glb, TargetsWithoutAClipAreLeftToTheViewer) {
    const Mesh mesh = mesh_of(order_of("boletus_edulis", 0.6, 1, 3));
    const std::vector<MorphTarget> targets = lift_and_turn(mesh);
    GlbParts parts = parts_of("posable");
    parts.targets = targets;
    const ReadBack found = expect_glb(joined(glb(mesh, parts)));
    EXPECT_EQ(found.targets.size(), 2u);
    EXPECT_TRUE(found.clips.empty());
}

TEST(Glb, TargetsAndClipsThatDoNotFitAreRefused) {
    const Mesh mesh = mesh_of(order_of("boletus_edulis", 0.6, 1, 3));
    const std::vector<MorphTarget> targets = lift_and_turn(mesh);
    const auto refused = [&](std::span<const MorphTarget> moved, const WeightClip* clip) {
        GlbParts parts = parts_of("b");
        parts.targets = moved;
        parts.clip = clip;
        EXPECT_THROW((void)glb(mesh, parts), GenerationError);
    };
    std::vector<MorphTarget> other = targets;
    other[1].normals.pop_back();
    refused(other, nullptr);
    other = targets;
    other[0].positions.emplace_back(0.0f);
    refused(other, nullptr);
    const WeightClip short_of_one{"c", {0.0f, 1.0f}, {1, 0, 0}}, without_keys{"c", {}, {}},
        good{"c", {0.0f, 1.0f}, {1, 0, 0, 1}};
    refused(targets, &short_of_one);
    refused(targets, &without_keys);
    refused({}, &good);
}

TEST(Glb, WebpImagesAreRequiredUnlessJpegImagesReplaceThem) {
    const Mesh mesh = mesh_of(textured(order_of("boletus_edulis", 0.6, 1, 3)));
    const PaintSpec spec =
        paint_spec_of(painted(order_of("boletus_edulis", 0.6, 1, 3), 128), atlas());
    const ImageSet webp = *painted_images(spec, {}, ImageFormat::webp),
                   jpg = *painted_images(spec, {});
    GlbScene scene;
    scene.materials = {{.name = "m", .images = &webp}};
    scene.meshes = {{"m", {{&mesh, 0, {}}}}};
    scene.nodes = {{.name = "m", .mesh = 0}};
    const auto text = [](const Value& json, const char* pointer) {
        const Value* const found = json.at_pointer(pointer);
        return found ? dump(*found) : "nothing";
    };
    const Value alone = document_of(glb(scene));
    EXPECT_EQ(text(alone, "/extensionsRequired"), R"(["EXT_texture_webp"])");
    EXPECT_EQ(text(alone, "/textures/1"),
              R"({"sampler":0,"extensions":{"EXT_texture_webp":{"source":1}}})");
    EXPECT_EQ(text(alone, "/images/2/mimeType"), R"("image/webp")");
    EXPECT_EQ(text(alone, "/images/3"), "nothing");

    scene.materials[0].fallback = &jpg;
    const Body body = glb(scene);
    const Value both = document_of(body);
    EXPECT_EQ(text(both, "/extensionsRequired"), "nothing");
    EXPECT_EQ(text(both, "/extensionsUsed"), R"(["EXT_texture_webp"])");
    EXPECT_EQ(text(both, "/textures/1"),
              R"({"sampler":0,"source":4,"extensions":{"EXT_texture_webp":{"source":1}}})");
    EXPECT_EQ(text(both, "/images/5/mimeType"), R"("image/jpeg")");
    // Views of images follow all others, in the order of the images.
    const Bytes file = joined(body);
    const auto at = [&](const char* pointer) {
        return static_cast<std::size_t>(both.at_pointer(pointer)->as_number());
    };
    const std::size_t binary = 28 + [&] {
        std::uint32_t size = 0;
        std::memcpy(&size, file.data() + 12, 4);
        return size;
    }();
    const std::string view = "/bufferViews/" + dump(*both.at_pointer("/images/4/bufferView"));
    const std::size_t from = binary + at((view + "/byteOffset").c_str());
    ASSERT_EQ(at((view + "/byteLength").c_str()), jpg.files[1].size);
    EXPECT_EQ(std::memcmp(file.data() + from, jpg.files[1].data(), jpg.files[1].size), 0);

    scene.materials[0] = {.name = "m",
                          .image_urls = {"a.webp", "b.webp", "c.webp"},
                          .url_format = ImageFormat::webp,
                          .fallback_urls = {"a.jpg", "b.jpg", "c.jpg"}};
    const Value linked = document_of(glb(scene));
    EXPECT_EQ(text(linked, "/images/0"), R"({"name":"m_base_color","uri":"a.webp"})");
    EXPECT_EQ(text(linked, "/images/3"), R"({"name":"m_base_color","uri":"a.jpg"})");
    EXPECT_EQ(text(linked, "/textures/2"),
              R"({"sampler":0,"source":5,"extensions":{"EXT_texture_webp":{"source":2}}})");
}

/// Two mushrooms, one of them textured, in three nodes, and their materials.
struct Group {
    Mesh bare = mesh_of(order_of("boletus_edulis", 0.6, 1, 3));
    Mesh painted_mesh = mesh_of(textured(order_of("mycena_sanguinolenta", 0.6, 2, 3)));
    ImageSet images = *painted_images(
        paint_spec_of(painted(order_of("boletus_edulis", 0.6, 1, 3), 128), atlas()), {});
    GlbScene scene;

    Group() {
        scene.materials = {{.name = "bare"},
                           {.name = "painted", .images = &images},
                           {.name = "coated", .images = &images, .look = {.coat = 0.5}},
                           {.name = "linked",
                            .image_urls = {"/a.jpg", "/b.jpg", "/c.jpg"},
                            .look = {.coat = 0.5},
                            .repeats_u = true}};
        scene.meshes = {{"both", {{&painted_mesh, 1, {}}, {&bare, 0, {}}, {&painted_mesh, 2, {}}}},
                        {"one", {{&painted_mesh, 3, {}}}}};
        scene.nodes = {{.name = "here", .mesh = 0},
                       {.name = "there",
                        .mesh = 1,
                        .translation = {0.5, -1.0, 0.25},
                        .rotation = {0.0, 0.6, 0.0, 0.8},
                        .scale = glm::dvec3(2.0)},
                       {.name = "again", .mesh = 1, .translation = {0.0, 0.0, 3.0}}};
        scene.extras_json = R"({"canonical":"/v1/x"})";
    }
};

TEST(Glb, PrimitivesOfManyMaterialsReadBackAsTheyWere) {
    const Group group;
    const Body body = glb(group.scene);
    const ReadScene found = expect_scene(joined(body));
    ASSERT_EQ(found.meshes.size(), 2u);
    ASSERT_EQ(found.meshes[0].size(), 3u);
    EXPECT_TRUE(same_bits(found.meshes[0][1].mesh, group.bare));
    EXPECT_EQ(found.meshes[0][0].attributes, full);
    EXPECT_EQ(found.meshes[0][1].attributes, plain) << "each as its own material needs";
    EXPECT_TRUE(same_bits(found.meshes[0][2].mesh.positions, group.painted_mesh.positions));
    EXPECT_EQ(found.meshes[0][0].material, 1);
    EXPECT_EQ(found.meshes[0][2].material, 2);
    ASSERT_EQ(found.materials.size(), 4u);
    using Three = std::array<int, 3>;
    EXPECT_EQ(found.materials[0].images, (Three{-1, -1, -1}));
    EXPECT_EQ(found.materials[1].images, (Three{0, 1, 2}));
    EXPECT_EQ(found.materials[2].images, (Three{0, 1, 2})) << "equal images are there once";
    EXPECT_EQ(found.materials[3].images, (Three{3, 4, 5}));
    EXPECT_EQ(found.materials[1].wrap_s, 33071) << "clamped";
    EXPECT_EQ(found.materials[3].wrap_s, 10497) << "goes round";
    EXPECT_EQ(found.images.size(), 6u);
    EXPECT_EQ(found.uris, (std::vector<std::string>{"/a.jpg", "/b.jpg", "/c.jpg"}));
    for (const Slice& file : group.images.files)
        EXPECT_EQ(std::count_if(body.begin(), body.end(),
                                [&](const Slice& slice) { return slice.data() == file.data(); }),
                  1);
    const Value json = json_chunk(joined(body));
    EXPECT_EQ(dump(*json.find("extensionsUsed")), R"(["KHR_materials_clearcoat"])");
    const std::string rough =
        "/materials/3/extensions/KHR_materials_clearcoat/clearcoatRoughnessTexture/index";
    EXPECT_EQ(json.at_pointer(rough)->as_number(), 5.0);
}

TEST(Glb, NodesHaveTransformsAndOmitTheIdentity) {
    const Group group;
    const ReadScene found = expect_scene(joined(glb(group.scene)));
    ASSERT_EQ(found.nodes.size(), 3u);
    using Numbers = std::vector<double>;
    EXPECT_EQ(found.nodes[0].name, "here");
    EXPECT_EQ(found.nodes[0].mesh, 0);
    EXPECT_EQ(found.nodes[0].translation, Numbers{});
    EXPECT_EQ(found.nodes[0].rotation, Numbers{});
    EXPECT_EQ(found.nodes[0].scale, Numbers{});
    EXPECT_EQ(found.nodes[1].mesh, 1);
    EXPECT_EQ(found.nodes[1].translation, (Numbers{0.5, -1.0, 0.25}));
    EXPECT_EQ(found.nodes[1].rotation, (Numbers{0.0, 0.6, 0.0, 0.8}));
    EXPECT_EQ(found.nodes[1].scale, (Numbers{2.0, 2.0, 2.0}));
    EXPECT_EQ(found.nodes[2].mesh, 1) << "one mesh, shown twice";
    EXPECT_EQ(found.nodes[2].scale, Numbers{});
}

TEST(Glb, InstancesOfANodeReadBackAsTheyWere) {
    Group group;
    const std::vector<GlbTransform> places = {
        {{0.5, -1.0, 0.25}, {0.0, 0.6, 0.0, 0.8}, glm::dvec3(2.0)},
        {{3.0, 0.0, 0.0}, {0.0, 0.0, 0.0, 1.0}, glm::dvec3(0.5)}};
    group.scene.nodes.resize(2);
    group.scene.nodes[1] = {.name = "many", .mesh = 1, .instances = places};
    const ReadScene found = expect_scene(joined(glb(group.scene)));
    EXPECT_EQ(found.required, std::vector<std::string>{"EXT_mesh_gpu_instancing"});
    ASSERT_EQ(found.nodes.size(), 2u);
    EXPECT_TRUE(found.nodes[0].instances.empty());
    ASSERT_EQ(found.nodes[1].instances.size(), 2u);
    for (std::size_t i = 0; i < 2; ++i) {
        EXPECT_EQ(found.nodes[1].instances[i].translation, glm::vec3(places[i].translation));
        EXPECT_EQ(found.nodes[1].instances[i].rotation, glm::vec4(places[i].rotation));
        EXPECT_EQ(found.nodes[1].instances[i].scale, glm::vec3(places[i].scale));
    }
    EXPECT_TRUE(expect_scene(joined(glb(Group().scene))).required.empty());
    group.scene.nodes[1].instances[1].rotation.w = 0.9;
    EXPECT_THROW((void)glb(group.scene), GenerationError);
}

TEST(Glb, NodesFormATreeAndOthersStandBesideTheScene) {
    Group group;
    group.scene.nodes[2].in_scene = false;
    group.scene.nodes[0].extensions = {{"MSFT_lod", R"({"ids":[2]})"}};
    group.scene.nodes[0].extras_json = R"({"MSFT_screencoverage":[0.5,0.1]})";
    group.scene.nodes.push_back({.name = "parent", .children = {1}});
    group.scene.extensions = {{"OMI_physics_shape", R"({"shapes":[]})"}};
    const Value json = json_chunk(joined(glb(group.scene)));
    const auto text = [&](const char* pointer) { return dump(*json.at_pointer(pointer)); };
    EXPECT_EQ(text("/scenes/0/nodes"), "[0,3]");
    EXPECT_EQ(text("/nodes/3"), R"({"name":"parent","children":[1]})");
    EXPECT_EQ(text("/nodes/0/extensions"), R"({"MSFT_lod":{"ids":[2]}})");
    EXPECT_EQ(text("/nodes/0/extras"), R"({"MSFT_screencoverage":[0.5,0.1]})");
    EXPECT_EQ(text("/extensions"), R"({"OMI_physics_shape":{"shapes":[]}})");
    EXPECT_EQ(text("/extensionsUsed"),
              R"(["MSFT_lod","KHR_materials_clearcoat","OMI_physics_shape"])");
    EXPECT_EQ(json.find("extensionsRequired"), nullptr);
}

TEST(Glb, ASceneOfOneMeshIsTheFileOfThatMesh) {
    const Group group;
    GlbParts parts = parts_of("one");
    parts.images = &group.images;
    GlbScene scene;
    scene.materials = {{.name = "one", .images = &group.images}};
    scene.meshes = {{"one", {{&group.painted_mesh, 0, {}}}}};
    scene.nodes = {{.name = "one", .mesh = 0}};
    EXPECT_EQ(joined(glb(scene)), joined(glb(group.painted_mesh, parts)));
}

TEST(Glb, InvalidScenesAreRefused) {
    const auto refused = [](const std::function<void(Group&)>& spoil) {
        Group group;
        spoil(group);
        EXPECT_THROW((void)glb(group.scene), GenerationError);
    };
    refused([](Group& g) { g.scene.nodes.clear(); });
    refused([](Group& g) { g.scene.nodes[1].mesh = 2; });
    refused([](Group& g) { g.scene.nodes[1].children = {2}; });
    refused([](Group& g) { g.scene.nodes.push_back({.name = "p", .children = {4}}); });
    refused([](Group& g) { g.scene.nodes.push_back({.name = "p", .children = {1, 1}}); });
    refused([](Group& g) { g.scene.nodes.push_back({.name = "p", .instances = {{}}}); });
    refused([](Group& g) {
        for (GlbNode& node : g.scene.nodes) node.in_scene = false;
    });
    refused([](Group& g) { g.scene.nodes[1].rotation *= 1.01; });
    refused([](Group& g) { g.scene.nodes[1].rotation.x = NAN; });
    refused([](Group& g) { g.scene.nodes[1].scale.y = 0.0; });
    refused([](Group& g) { g.scene.meshes[0].primitives[0].material = 4; });
    refused([](Group& g) { g.scene.meshes[1].primitives.clear(); });
    refused([](Group& g) { g.scene.meshes[0].primitives[1].material = 1; });
    const Mesh empty;
    refused([&](Group& g) { g.scene.meshes[1].primitives[0].mesh = &empty; });
    Group group;
    const std::vector<MorphTarget> targets = lift_and_turn(group.bare);
    group.scene.meshes[0].primitives[1].targets = targets;
    EXPECT_THROW((void)glb(group.scene), GenerationError) << "one primitive of three moves";
}

TEST(Glb, AnEmptyMeshIsRefused) {
    EXPECT_THROW((void)glb(Mesh{}, parts_of("nothing")), GenerationError);
}

/// A scene of two meshes, the second of which is a file of its own.
GlbScene partly_linked(const Mesh& here, const Mesh& elsewhere) {
    GlbScene scene;
    scene.materials.push_back({.name = "plain"});
    scene.meshes.push_back({"here", {{&here, 0, {}}}});
    scene.meshes.push_back({"elsewhere", {{&elsewhere, 0, {}}}, GlbRole::body, "../shape.bin"});
    scene.nodes.push_back({.name = "here", .mesh = 0});
    scene.nodes.push_back({.name = "elsewhere", .mesh = 1});
    return scene;
}

TEST(Glb, LinkedGeometryIsABufferOfItsOwn) {
    const Mesh here = mesh_of(order_of("amanita_muscaria", 0.6, 3, 1)),
               elsewhere = mesh_of(order_of("boletus_edulis", 0.6, 2, 1));
    const GlbScene scene = partly_linked(here, elsewhere);
    const Value json = json_chunk(joined(glb(scene)));
    const Value::Array& buffers = json.find("buffers")->items();
    ASSERT_EQ(buffers.size(), 2U);
    EXPECT_EQ(buffers[1].find("uri")->as_string(), "../shape.bin");
    GlbScene alone;
    alone.materials.push_back({.name = "plain"});
    alone.meshes.push_back({"elsewhere", {{&elsewhere, 0, {}}}});
    const Bytes geometry = joined(geometry_bytes(alone));
    EXPECT_EQ(buffers[1].find("byteLength")->as_number(), geometry.size());
    // Its views are those of the second buffer, from its beginning.
    std::set<double> starts;
    for (const Value& view : json.find("bufferViews")->items())
        if (view.find("buffer")->as_number() == 1.0)
            starts.insert(view.find("byteOffset")->as_number());
    EXPECT_EQ(*starts.begin(), 0.0);
    EXPECT_EQ(starts.size(), 3U) << "positions, normals and indices";
}

TEST(Glb, GeometryThatIsElsewhereIsDescribedAsIfItWereInTheFile) {
    Mesh mesh = mesh_of(textured(order_of("amanita_muscaria", 0.6, 3, 1)));
    mesh.tints.assign(mesh.positions.size(), glm::vec3(0.5F));
    for (const bool is_swaying : {false, true}) {
        if (is_swaying) mesh.sway.assign(mesh.positions.size(), Sway{.bend = 0.5F});
        GlbScene scene = partly_linked(mesh, mesh);
        scene.materials[0].image_urls = {"a.jpg", "b.jpg", "c.jpg"};
        const Value linked = json_chunk(joined(glb(scene)));
        for (GlbMesh& one : scene.meshes) one.geometry_uri.clear();
        const Value whole = json_chunk(joined(glb(scene)));
        EXPECT_EQ(dump(*linked.find("accessors")), dump(*whole.find("accessors")));
        const Value::Array &views = linked.find("bufferViews")->items(),
                           &same = whole.find("bufferViews")->items();
        ASSERT_EQ(views.size(), same.size());
        for (std::size_t i = 0; i < views.size(); ++i)
            EXPECT_EQ(views[i].find("byteLength")->as_number(),
                      same[i].find("byteLength")->as_number());
    }
}

TEST(Glb, PositionsOnALatticeStayExactWhereTheyAreQuantised) {
    constexpr float step = 1.0F / 4096.0F;
    Mesh mesh = mesh_of(order_of("amanita_muscaria", 0.6, 3, 1));
    for (glm::vec3& at : mesh.positions) at = glm::floor(at / step) * step;
    GlbScene scene;
    scene.geometry = GlbGeometry::quantized;
    scene.materials.push_back({.name = "plain"});
    scene.meshes.push_back({.name = "own", .primitives = {{&mesh, 0, {}}}, .step = step});
    scene.nodes.push_back({.name = "own", .mesh = 0});
    const Value json = json_chunk(joined(glb(scene)));
    EXPECT_EQ(static_cast<float>(json.at_pointer("/nodes/0/scale/0")->as_number()), step)
        << "in the single precision of glTF";
    const Bounds box = bounds(mesh);
    for (const int axis : {0, 1, 2}) {
        const std::string of = '/' + std::to_string(axis);
        EXPECT_EQ(json.at_pointer("/accessors/0/min" + of)->as_number() * static_cast<double>(step),
                  static_cast<double>(box.min[axis]));
        EXPECT_EQ(json.at_pointer("/accessors/0/max" + of)->as_number() * static_cast<double>(step),
                  static_cast<double>(box.max[axis]));
    }
    scene.meshes[0].step = 1e-6F;
    EXPECT_THROW(static_cast<void>(glb(scene)), GenerationError) << "does not fit into 16 bits";
}

TEST(Glb, ABaseColourMayBeAlone) {
    const Mesh mesh = mesh_of(textured(order_of("amanita_muscaria", 0.6, 3, 1)));
    ImageSet images = *painted_images(
        paint_spec_of(order_of("amanita_muscaria", 0.6, 3, 1), atlas()), {}, ImageFormat::jpg);
    images.files[1] = images.files[2] = {};
    GlbScene scene;
    scene.materials.push_back({.name = "plain", .images = &images});
    scene.meshes.push_back({"own", {{&mesh, 0, {}}}});
    scene.nodes.push_back({.name = "own", .mesh = 0});
    const ReadScene read = expect_scene(joined(glb(scene)));
    EXPECT_EQ(read.images.size(), 1U);
    EXPECT_EQ(read.materials[0].images, (std::array<int, 3>{0, -1, -1}));
    EXPECT_EQ(read.meshes[0][0].attributes,
              (std::vector<std::string>{"NORMAL", "POSITION", "TEXCOORD_0"}))
        << "tangents are for normal maps";
}

TEST(Glb, GeometryThatCannotBeAFileOfItsOwnIsRefused) {
    const Mesh mesh = mesh_of(order_of("amanita_muscaria", 0.6, 3, 1));
    GlbScene scene = partly_linked(mesh, mesh);
    scene.geometry = GlbGeometry::quantized;
    EXPECT_THROW(static_cast<void>(glb(scene)), GenerationError);
    EXPECT_THROW(static_cast<void>(geometry_bytes(scene)), GenerationError);
    scene = partly_linked(mesh, mesh);
    scene.meshes.front().geometry_uri = "first.bin";
    EXPECT_THROW(static_cast<void>(glb(scene)), GenerationError) << "without data of its own";
}

}  // namespace
}  // namespace sporeprint::gltf_glb_test
