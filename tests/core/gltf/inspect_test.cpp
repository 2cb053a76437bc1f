#include "core/gltf/inspect.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <cstring>
#include <functional>
#include <string>
#include <vector>

#include "core/params/reader.h"
#include "tests/support/glb_reader.h"
#include "tests/support/meshes.h"
#include "tests/support/orders.h"

namespace sporeprint::gltf_inspect_test {
namespace {

const std::string address = "/v1/mushrooms/amanita_muscaria.glb?seed=7";

const Bytes& grown() {
    static const Bytes file = joined(
        grow_mushroom(painted(order_of("amanita_muscaria", 0.6, 7, 1)), atlas(), {address, {}})
            .glb);
    return file;
}

void put(Bytes& file, std::size_t at, std::uint32_t value) {
    std::memcpy(file.data() + at, &value, 4);
}

/// Returns a GLB of a JSON chunk alone.
Bytes glb_of(std::string json) {
    while (json.size() % 4) json += ' ';
    Bytes file(20 + json.size());
    put(file, 0, 0x46546C67);
    put(file, 4, 2);
    put(file, 8, static_cast<std::uint32_t>(file.size()));
    put(file, 12, static_cast<std::uint32_t>(json.size()));
    put(file, 16, 0x4E4F534A);
    std::copy(json.begin(), json.end(), file.begin() + 20);
    return file;
}

/// Returns the message with which a file is refused; empty if it is accepted.
std::string why(const Bytes& file) {
    const auto problems = refusal([&] { (void)inspect_glb(file); });
    if (problems.empty()) return "";
    EXPECT_EQ(problems.size(), 1u);
    EXPECT_EQ(problems[0].path, "");
    return problems[0].message;
}

void expect_refused(const Bytes& file, const std::string& words) {
    const std::string found = why(file);
    EXPECT_NE(found.find(words), std::string::npos) << words << " is not in: " << found;
    EXPECT_LT(found.size(), 400u) << "an answer does not grow with its question";
}

TEST(Inspect, ReturnsTheRequestThatProducedTheFile) {
    const MushroomSpec order = painted(order_of("amanita_muscaria", 0.6, 7, 1));
    const Mushroom mushroom = grow_mushroom(order, atlas(), {address, {}});
    const Inspection found = inspect_glb(grown());
    EXPECT_EQ(found.canonical, address);
    EXPECT_EQ(found.generator, "Sporeprint " + std::to_string(generator_version));
    EXPECT_EQ(found.vertices, mushroom.vertices);
    EXPECT_EQ(found.triangles, mushroom.triangles);
    EXPECT_EQ(found.meshes, 1u);
    EXPECT_EQ(found.materials, 1u);
    EXPECT_EQ(found.images, 3u);
    EXPECT_EQ(found.bytes, grown().size());
    std::vector<Problem> problems;
    const auto effective = read_json<MushroomParams>(found.effective_json, problems);
    EXPECT_EQ(problems, std::vector<Problem>{});
    EXPECT_EQ(effective, resolve(order, atlas()).effective);
}

TEST(Inspect, CountsTheTargetsAndClipsOfAGrowingMushroom) {
    EXPECT_EQ(inspect_glb(grown()).morph_targets, 0u);
    EXPECT_EQ(inspect_glb(grown()).animations, 0u);
    const Inspection found = inspect_glb(joined(
        grow_mushroom(growing(order_of("boletus_edulis", 0.6, 1, 3), 5), atlas(), {address, {}})
            .glb));
    EXPECT_EQ(found.morph_targets, 5u);
    EXPECT_EQ(found.animations, 1u);
}

TEST(Inspect, TheReturnedParametersGrowTheSameShape) {
    std::vector<Problem> problems;
    MushroomSpec order = order_of("amanita_muscaria");
    order.params = read_json<MushroomParams>(inspect_glb(grown()).effective_json, problems);
    const Bytes again = joined(grow_mushroom(order, atlas(), {address, {}}).glb);
    // Only the shape is compared: images are painted for the nearest 64th of age, and for requested
    // overrides as requested.
    EXPECT_TRUE(same_bits(expect_glb(again).mesh, expect_glb(grown()).mesh));
}

TEST(Inspect, TruncatedFilesAreRefused) {
    const Bytes& whole = grown();
    for (const std::size_t size : {std::size_t{0}, std::size_t{1}, std::size_t{19}, std::size_t{20},
                                   std::size_t{21}, whole.size() / 2, whole.size() - 1})
        EXPECT_NE(why(Bytes(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(size))), "")
            << size;
    Bytes longer = whole;
    longer.push_back(0);
    expect_refused(longer, "but " + std::to_string(longer.size()) + " came");
}

TEST(Inspect, WrongLengthsAreRefused) {
    for (const std::size_t at : {std::size_t{8}, std::size_t{12}})
        for (const std::uint32_t length : {0u, 1u, 0x7FFFFFFFu, 0xFFFFFFFFu, 0xFFFFFFECu}) {
            Bytes file = grown();
            put(file, at, length);
            EXPECT_NE(why(file), "") << at << ' ' << length;
        }
    Bytes file = grown();
    put(file, 4, 1);
    expect_refused(file, "version 1");
    file = grown();
    put(file, 16, 0x004E4942);
    expect_refused(file, "JSON chunk");
}

// Tools that rewrite a file set their own name as its generator, or none.
TEST(Inspect, TheRequestIsReadFromFilesThatOtherToolsHaveRewritten) {
    for (const std::string generator : {R"("generator":"glTF-Transform v4.1.0",)", R"()"}) {
        const Bytes file = glb_of(
            R"({"asset":{"version":"2.0",)" + generator +
            R"("extras":{"canonical":"/v1/leaves/oak.glb?seed=3","effective":{"seed":3}}}})");
        const Inspection found = inspect_glb(file);
        EXPECT_EQ(found.generator, generator.empty() ? "" : "glTF-Transform v4.1.0");
        EXPECT_EQ(found.canonical, "/v1/leaves/oak.glb?seed=3");
        EXPECT_EQ(found.effective_json, R"({"seed":3})");
    }
}

TEST(Inspect, ForeignFilesAreRefused) {
    const std::string text = "<html><body>not a model at all</body></html>";
    expect_refused(Bytes(text.begin(), text.end()), "not a GLB");
    expect_refused(glb_of(R"({"asset":{"version":"2.0","generator":"Blender"}})"),
                   "does not carry a request of Sporeprint");
    expect_refused(glb_of(R"({"asset":{"version":"2.0"}})"), "does not carry");
    expect_refused(glb_of(R"({"asset":{"version":"2.0","generator":7}})"), "does not carry");
    expect_refused(glb_of(R"({"asset":{"version":"2.0","generator":"Sporeprint 1"}})"),
                   "does not carry");
    expect_refused(
        glb_of(
            R"({"asset":{"version":"2.0","generator":"Sporeprint 1","extras":{"canonical":"x","effective":[]}}})"),
        "does not carry");
    expect_refused(glb_of("[]"), "does not carry");
    expect_refused(glb_of(""), "JSON chunk");
    expect_refused(glb_of(R"({"asset":1,"asset":2})"), "JSON chunk cannot be read");
}

TEST(Inspect, DecompressionBombsAreRefused) {
    expect_refused(glb_of(std::string(100000, '[')), "JSON chunk cannot be read");
    expect_refused(glb_of(std::string(100000, '[') + std::string(100000, ']')), "JSON chunk");
    std::string objects;
    for (int i = 0; i < 100000; ++i) objects += "{\"a\":";
    expect_refused(glb_of(objects), "JSON chunk");
    std::string many = "[0";
    for (int i = 0; i < 300000; ++i) many += ",0";
    expect_refused(glb_of(many + "]"), "JSON chunk");
    expect_refused(glb_of("{\"a\":1e999}"), "JSON chunk");
}

const std::string head =
    R"("asset":{"version":"2.0","generator":"Sporeprint 1","extras":{"canonical":"x","effective":{}}})";

TEST(Inspect, ExternalReferencesInAFileAreNotFollowed) {
    for (
        const std::string& rest :
        {std::string(R"("meshes":[{"primitives":[{"attributes":{"POSITION":99},"indices":-5}]}])"),
         std::string(
             R"("meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":0}]}],)"
             R"("accessors":[{"componentType":5126,"count":4294967295,"type":"VEC3","bufferView":7}])"),
         std::string(R"("accessors":[{"componentType":5126,"count":-1,"type":"VEC3"}])"),
         std::string(R"("images":[{"uri":"file:///etc/passwd"},{"uri":"../../secret.png"}])"),
         std::string(
             R"("buffers":[{"byteLength":1e15,"uri":"data:application/octet-stream;base64,AAAA"}])"),
         std::string(R"("bufferViews":[{"buffer":12,"byteLength":9,"byteOffset":1e18}])"),
         std::string(R"("nodes":[{"children":[0]}],"scenes":[{"nodes":[0]}],"scene":4)"),
         std::string(
             R"("extensions":{"KHR_draco_mesh_compression":{}},"extensionsRequired":["X"])")}) {
        try {
            const Inspection found = inspect_glb(glb_of("{" + head + "," + rest + "}"));
            EXPECT_EQ(found.canonical, "x");
        } catch (const InvalidInput& refused) {
            EXPECT_EQ(refused.problems().size(), 1u);
        }
    }
    EXPECT_EQ(inspect_glb(glb_of("{" + head + "}")).vertices, 0u);
}

TEST(Inspect, LongChunksAreRefusedUnread) {
    expect_refused(glb_of(std::string(most_inspected_json + 1, '[')), "at most 1048576 are read");
    std::stop_source stop;
    stop.request_stop();
    EXPECT_THROW((void)inspect_json("{}", stop.get_token()), Cancelled);
}

TEST(Inspect, MeshesWithTooManyValuesAreRefusedBeforeTinygltfReadsThem) {
    std::string primitives;
    for (int i = 0; i < 50'000; ++i) primitives += i > 0 ? ",{}" : "{}";
    expect_refused(glb_of(R"({"asset":{"version":"2.0","extras":{"canonical":")" + address +
                          R"(","effective":{}}},"meshes":[{"primitives":[)" + primitives + "]}]}"),
                   "at most 40000 are read");
}

TEST(Inspect, ReturnedTextIsBounded) {
    const auto with = [](const std::string& generator, const std::string& effective) {
        return glb_of(R"({"asset":{"generator":")" + generator +
                      R"(","extras":{"canonical":"x","effective":)" + effective + "}}}");
    };
    const std::string text(most_effective_json, 'x');
    expect_refused(with("Sporeprint 1", "{\"a\":\"" + text + "\"}"),
                   "at most 65536 are given back");
    const Inspection found = inspect_glb(with("Sporeprint 1\\n" + text, "{}"));
    EXPECT_LT(found.generator.size(), 200u);
    EXPECT_EQ(found.generator.find('\n'), std::string::npos);
}

TEST(Inspect, RandomBytesAreRefused) {
    EXPECT_TRUE(
        rc::check("random bytes", [](const Bytes& file) { RC_ASSERT(!why(file).empty()); }));
    EXPECT_TRUE(rc::check("random bytes behind a header",
                          [](const std::string& json) { RC_ASSERT(!why(glb_of(json)).empty()); }));
}

TEST(Inspect, DamagedFilesAreReadOrRefusedNeverCrash) {
    EXPECT_TRUE(rc::check("a few bytes changed", [] {
        Bytes file = grown();
        for (auto n = *rc::gen::inRange(1, 6); n > 0; --n)
            file[*rc::gen::inRange<std::size_t>(0, 3000)] =
                static_cast<std::uint8_t>(*rc::gen::inRange(0, 256));
        try {
            (void)inspect_glb(file);
        } catch (const InvalidInput&) {
        }
    }));
}

}  // namespace
}  // namespace sporeprint::gltf_inspect_test
