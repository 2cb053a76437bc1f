#include "core/scene/scene_file.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <glm/geometric.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "core/bytes.h"
#include "core/problems.h"
#include "core/scene/scene.h"
#include "tests/support/refusals.h"

namespace sporeprint::scene_file_test {
namespace {

void append_word(Bytes& file, std::uint32_t word) {
    for (int shift = 0; shift < 32; shift += 8)
        file.push_back(static_cast<std::uint8_t>(word >> shift));
}

void append_chunk(Bytes& file, std::uint32_t name, Bytes data, std::uint8_t padding) {
    while (data.size() % 4 != 0) data.push_back(padding);
    append_word(file, static_cast<std::uint32_t>(data.size()));
    append_word(file, name);
    file.insert(file.end(), data.begin(), data.end());
}

/// Returns a GLB file of a document and a buffer.
Bytes glb(std::string_view json, const Bytes& buffer) {
    Bytes chunks;
    append_chunk(chunks, 0x4E4F534A, {json.begin(), json.end()}, ' ');
    append_chunk(chunks, 0x004E4942, buffer, 0);
    Bytes file;
    append_word(file, 0x46546C67);
    append_word(file, 2);
    append_word(file, static_cast<std::uint32_t>(12 + chunks.size()));
    file.insert(file.end(), chunks.begin(), chunks.end());
    return file;
}

/// Four corners of a square of a metre in the plane y = 0 as floats, then indices of two triangles of 16 bits.
Bytes square() {
    constexpr float corners[] = {0, 0, 0, 1, 0, 0, 1, 0, -1, 0, 0, -1};
    constexpr std::uint16_t indices[] = {0, 1, 2, 0, 2, 3};
    Bytes buffer(sizeof(corners) + sizeof(indices));
    std::memcpy(buffer.data(), corners, sizeof(corners));
    std::memcpy(buffer.data() + sizeof(corners), indices, sizeof(indices));
    return buffer;
}

/// What varies of a document with that square.
struct Document {
    std::string nodes = R"([{"mesh":0}])";
    std::string primitive = R"({"attributes":{"POSITION":0},"indices":1,"material":0})";
    std::string accessor = R"({"bufferView":0,"componentType":5126,"count":4,"type":"VEC3"})";
    std::string indices = R"({"bufferView":1,"componentType":5123,"count":6,"type":"SCALAR"})";
    std::string buffer = R"({"byteLength":60})";
    std::string more;

    [[nodiscard]] std::string text() const {
        return R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":)" + nodes +
               R"(,"meshes":[{"primitives":[)" + primitive +
               R"(]}],"materials":[{"name":"Oak log"},{}],"accessors":[)" + accessor + ',' +
               indices +
               R"(],"bufferViews":[{"buffer":0,"byteLength":48},{"buffer":0,"byteOffset":48,"byteLength":12}],"buffers":[)" +
               buffer + ']' + more + '}';
    }
    [[nodiscard]] Scene scene() const { return scene_in_glb(glb(text(), square())); }
};

/// Returns the first problem with which a document is refused.
std::string refused(const Document& document) {
    const std::vector<Problem> problems = refusal([&] { static_cast<void>(document.scene()); });
    return problems.empty() ? "(read)" : problems.front().message;
}

double area(const Scene& scene) {
    double sum = 0.0;
    for (const SceneTriangle& triangle : scene.triangles) {
        const glm::dvec3 a(scene.positions[triangle.corners[0]]),
            b(scene.positions[triangle.corners[1]]), c(scene.positions[triangle.corners[2]]);
        sum += 0.5 * glm::length(glm::cross(b - a, c - a));
    }
    return sum;
}

/// Returns the sum of the normals of all triangles, by their areas.
glm::dvec3 facing(const Scene& scene) {
    glm::dvec3 sum(0.0);
    for (const SceneTriangle& triangle : scene.triangles) {
        const glm::dvec3 a(scene.positions[triangle.corners[0]]),
            b(scene.positions[triangle.corners[1]]), c(scene.positions[triangle.corners[2]]);
        sum += 0.5 * glm::cross(b - a, c - a);
    }
    return sum;
}

TEST(SceneFile, HasTrianglesAndNamesOfMaterials) {
    const Scene scene = Document().scene();
    ASSERT_EQ(scene.triangles.size(), 2U);
    EXPECT_EQ(scene.positions.size(), 4U);
    EXPECT_EQ(scene.materials, (std::vector<std::string>{"", "Oak log", ""}));
    for (const SceneTriangle& triangle : scene.triangles)
        EXPECT_EQ(scene.materials[triangle.material], "Oak log");
    EXPECT_DOUBLE_EQ(area(scene), 1.0);
    EXPECT_NEAR(facing(scene).y, 1.0, 1e-12) << "the square looks up";
}

TEST(SceneFile, PutsMeshesWhereNodesHaveThem) {
    Document document;
    // Twice as large, a quarter turn about y, and 10 m to the east; its child is 3 m above it.
    document.nodes =
        R"([{"children":[1],"translation":[10,0,0],"scale":[2,2,2],"rotation":[0,0.7071067811865476,0,0.7071067811865476]},)"
        R"({"mesh":0,"matrix":[1,0,0,0,0,1,0,0,0,0,1,0,0,1.5,0,1]}])";
    const Scene scene = document.scene();
    EXPECT_NEAR(area(scene), 4.0, 1e-5);
    const auto has = [&](glm::vec3 wanted) {
        return std::ranges::any_of(
            scene.positions, [&](const glm::vec3& at) { return glm::length(at - wanted) < 1e-5F; });
    };
    // (1, 0, 0) turns to (0, 0, -1), and (0, 0, -1) to (-1, 0, 0).
    for (const glm::vec3 corner :
         {glm::vec3(10, 3, 0), glm::vec3(10, 3, -2), glm::vec3(8, 3, -2), glm::vec3(8, 3, 0)})
        EXPECT_TRUE(has(corner)) << corner.x << ' ' << corner.z;
}

TEST(SceneFile, KeepsTheOutsideOfMirroredMeshesOutside) {
    Document document;
    document.nodes = R"([{"mesh":0,"scale":[-1,1,1]}])";
    EXPECT_NEAR(facing(document.scene()).y, 1.0, 1e-6);
}

TEST(SceneFile, ReadsStripsFansAndTrianglesWithoutIndices) {
    Document document;
    document.primitive = R"({"attributes":{"POSITION":0},"mode":6})";
    const Scene fan = document.scene();
    ASSERT_EQ(fan.triangles.size(), 2U);
    EXPECT_DOUBLE_EQ(area(fan), 1.0);
    EXPECT_NEAR(facing(fan).y, 1.0, 1e-12);
    // 0 1 3 2 is a strip of the same square.
    document.primitive = R"({"attributes":{"POSITION":0},"mode":5,"indices":1})";
    document.indices = R"({"bufferView":1,"componentType":5123,"count":4,"type":"SCALAR"})";
    Bytes buffer = square();
    constexpr std::uint16_t strip[] = {0, 1, 3, 2};
    std::memcpy(buffer.data() + 48, strip, sizeof(strip));
    const Scene read = scene_in_glb(glb(document.text(), buffer));
    ASSERT_EQ(read.triangles.size(), 2U);
    EXPECT_NEAR(facing(read).y, 1.0, 1e-12) << "every second one of a strip is turned round";
    document.primitive = R"({"attributes":{"POSITION":0}})";
    EXPECT_EQ(document.scene().triangles.size(), 1U) << "what is left over is no triangle";
}

TEST(SceneFile, ReadsQuantisedPlaces) {
    Document document;
    document.more = R"(,"extensionsRequired":["KHR_mesh_quantization"])";
    document.accessor =
        R"({"bufferView":0,"componentType":5123,"normalized":true,"count":4,"type":"VEC3"})";
    document.nodes = R"([{"mesh":0,"scale":[3,1,1]}])";
    Bytes buffer = square();
    constexpr std::uint16_t corners[] = {0, 0, 65535, 65535, 0, 65535, 65535, 0, 0, 0, 0, 0};
    std::memcpy(buffer.data(), corners, sizeof(corners));
    EXPECT_NEAR(area(scene_in_glb(glb(document.text(), buffer))), 3.0, 1e-6);
}

TEST(SceneFile, LeavesOutPointsLinesAndWhatHasNoArea) {
    Document document;
    document.primitive =
        R"({"attributes":{"POSITION":0},"mode":1},{"attributes":{"POSITION":0},"indices":1})";
    EXPECT_EQ(document.scene().triangles.size(), 2U);
    document.primitive = R"({"attributes":{"POSITION":0},"mode":0})";
    EXPECT_EQ(refused(document), "the scene shows no triangle");
    document = {};
    document.nodes = R"([{"mesh":0,"scale":[1,1,0]}])";
    EXPECT_EQ(refused(document), "the scene shows no triangle");
}

TEST(SceneFile, NamesWhatIsNotRead) {
    const auto expect = [](const Document& document, const std::string& words) {
        EXPECT_NE(refused(document).find(words), std::string::npos) << refused(document);
    };
    Document document;
    document.buffer = R"({"byteLength":60,"uri":"file:///etc/passwd"})";
    expect(document, "/buffers/0: is not in this file");
    document = {};
    document.more = R"(,"extensionsRequired":["KHR_draco_mesh_compression"])";
    expect(document, "'KHR_draco_mesh_compression' is not read here");
    document = {};
    document.nodes = R"([{"mesh":0,"skin":0}])";
    expect(document, "/nodes/0: has a skin");
    document = {};
    document.accessor =
        R"({"bufferView":0,"componentType":5126,"count":4,"type":"VEC3","sparse":{}})";
    expect(document, "/accessors/0: is sparse");
    document.accessor = R"({"componentType":5126,"count":4,"type":"VEC3"})";
    expect(document, "/accessors/0: has no bufferView");
    document.accessor = R"({"bufferView":0,"componentType":5126,"count":5,"type":"VEC3"})";
    expect(document, "/accessors/0: reaches beyond the end");
    document.accessor =
        R"({"bufferView":0,"byteOffset":4294967295,"componentType":5126,"count":1,"type":"VEC3"})";
    expect(document, "/accessors/0: reaches beyond the end");
    document.accessor = R"({"bufferView":7,"componentType":5126,"count":4,"type":"VEC3"})";
    expect(document, "there is no bufferViews/7");
    document.accessor = R"({"bufferView":0,"componentType":5126,"count":-1,"type":"VEC3"})";
    expect(document, "/accessors/0/count: expected a whole number, got -1");
    document.accessor = R"({"bufferView":0,"componentType":5,"count":4,"type":"VEC3"})";
    expect(document, "/accessors/0: has a componentType");
    document = {};
    document.indices = R"({"bufferView":1,"componentType":5126,"count":3,"type":"SCALAR"})";
    expect(document, "not whole numbers");
    document = {};
    document.primitive = R"({"attributes":{"POSITION":0},"indices":1,"material":9})";
    expect(document, "there is no materials/9");
    document = {};
    document.nodes = R"([{"children":[1]},{"children":[0]}])";
    expect(document, "/nodes/0: is the child of two nodes");
    document.nodes = R"([{"mesh":0,"scale":[60,1,1]}])";
    expect(document, "60 m long");
    document.nodes = R"([{"mesh":0,"translation":[1e300,0,0]}])";
    expect(document, "no place of a scene");
    document.nodes = R"([{"mesh":4}])";
    expect(document, "there is no meshes/4");
}

TEST(SceneFile, RefusesAnIndexBeyondTheVertices) {
    Bytes buffer = square();
    buffer[50] = 4;
    const auto problems =
        refusal([&] { static_cast<void>(scene_in_glb(glb(Document().text(), buffer))); });
    ASSERT_FALSE(problems.empty());
    EXPECT_NE(problems.front().message.find("index 4"), std::string::npos);
}

TEST(SceneFile, RefusesWhatIsNoFileOfAScene) {
    const Bytes whole = glb(Document().text(), square());
    for (std::size_t length = 0; length < whole.size(); length += 7) {
        const std::span<const std::uint8_t> part(whole.data(), length);
        EXPECT_FALSE(refusal([&] { static_cast<void>(scene_in_glb(part)); }).empty()) << length;
    }
    Bytes longer = whole;
    longer.push_back(0);
    EXPECT_FALSE(refusal([&] { static_cast<void>(scene_in_glb(longer)); }).empty());
}

TEST(SceneFile, RefusesMoreTrianglesThanAllowedAlsoIfTheyAreOneManyTimes) {
    Document document;
    std::string nodes = R"({"mesh":0})";
    std::string children = "[1";
    for (int i = 2; i <= 60'000; ++i) children += ',' + std::to_string(i);
    std::string all = R"([{"children":)" + children + "]}";
    for (int i = 1; i <= 60'000; ++i) all += ',' + nodes;
    document.nodes = all + ']';
    // Each has the square five times.
    std::string primitives = R"({"attributes":{"POSITION":0},"indices":1})";
    for (int i = 0; i < 4; ++i) primitives += R"(,{"attributes":{"POSITION":0},"indices":1})";
    document.primitive = primitives;
    EXPECT_NE(refused(document).find("more than 200000 triangles"), std::string::npos)
        << refused(document);
}

}  // namespace
}  // namespace sporeprint::scene_file_test
