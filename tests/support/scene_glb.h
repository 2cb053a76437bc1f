// GLB files of scenes, as modelling programs export them.
#pragma once

#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

#include "core/bytes.h"
#include "core/scene/scene.h"

namespace sporeprint::scenes {

/// Returns a GLB file with one mesh, which has a primitive without indices for each material.
inline Bytes glb_of(const Scene& scene) {
    Bytes buffer;
    std::string primitives, accessors, views, materials;
    const auto comma = [](std::string& list) { list += list.empty() ? "" : ","; };
    int number = 0;
    for (std::size_t material = 1; material < scene.materials.size(); ++material) {
        const std::size_t start = buffer.size();
        std::size_t count = 0;
        for (const SceneTriangle& triangle : scene.triangles) {
            if (triangle.material != material) continue;
            for (const std::uint32_t corner : triangle.corners) {
                const glm::vec3& at = scene.positions[corner];
                const std::size_t end = buffer.size();
                buffer.resize(end + 12);
                std::memcpy(buffer.data() + end, &at.x, 12);
                ++count;
            }
        }
        comma(materials);
        materials += R"({"name":")" + scene.materials[material] + R"("})";
        if (count == 0) continue;
        comma(primitives);
        primitives += R"({"attributes":{"POSITION":)" + std::to_string(number) +
                      R"(},"material":)" + std::to_string(material - 1) + '}';
        comma(accessors);
        accessors += R"({"bufferView":)" + std::to_string(number) +
                     R"(,"componentType":5126,"type":"VEC3","count":)" + std::to_string(count) +
                     '}';
        comma(views);
        views += R"({"buffer":0,"byteOffset":)" + std::to_string(start) + R"(,"byteLength":)" +
                 std::to_string(buffer.size() - start) + '}';
        ++number;
    }
    std::string json =
        R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],"meshes":[{"primitives":[)" +
        primitives + R"(]}],"materials":[)" + materials + R"(],"accessors":[)" + accessors +
        R"(],"bufferViews":[)" + views + R"(],"buffers":[{"byteLength":)" +
        std::to_string(buffer.size()) + "}]}";
    while (json.size() % 4 != 0) json += ' ';
    Bytes file;
    const auto word = [&](std::size_t value) {
        for (int shift = 0; shift < 32; shift += 8)
            file.push_back(static_cast<std::uint8_t>(value >> shift));
    };
    word(0x46546C67);
    word(2);
    word(12 + 8 + json.size() + 8 + buffer.size());
    word(json.size());
    word(0x4E4F534A);
    file.insert(file.end(), json.begin(), json.end());
    word(buffer.size());
    word(0x004E4942);
    file.insert(file.end(), buffer.begin(), buffer.end());
    return file;
}

}  // namespace sporeprint::scenes
