#include "core/scene/scene_store.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <utility>

#include "core/params/types.h"

namespace sporeprint {

namespace {

constexpr std::array<std::uint8_t, 8> format = {'S', 'P', 'S', 'C', 'E', 'N', 'E', 1};

void append(Bytes& to, std::uint32_t number) {
    for (int shift = 0; shift < 32; shift += 8)
        to.push_back(static_cast<std::uint8_t>(number >> shift));
}

/// Reads numbers from the start of a file on. What is beyond its end is 0.
class FileReader {
  public:
    explicit FileReader(std::span<const std::uint8_t> file) : left_(file) {}

    std::uint32_t number() {
        std::uint32_t value = 0;
        if (left_.size() < 4) return fail();
        for (std::size_t i = 0; i < 4; ++i) value |= std::uint32_t{left_[i]} << (8 * i);
        left_ = left_.subspan(4);
        return value;
    }
    std::string text(std::size_t length) {
        if (left_.size() < length) {
            fail();
            return {};
        }
        std::string value(left_.begin(), left_.begin() + static_cast<std::ptrdiff_t>(length));
        left_ = left_.subspan(length);
        return value;
    }
    [[nodiscard]] std::size_t size() const { return left_.size(); }
    [[nodiscard]] bool is_done() const { return !failed_ && left_.empty(); }

  private:
    std::uint32_t fail() {
        failed_ = true;
        left_ = {};
        return 0;
    }

    std::span<const std::uint8_t> left_;
    bool failed_ = false;
};

}  // namespace

Bytes file_of(const Scene& scene) {
    Bytes file(format.begin(), format.end());
    file.reserve(file.size() + 12 + 12 * scene.positions.size() + 16 * scene.triangles.size());
    append(file, static_cast<std::uint32_t>(scene.materials.size()));
    append(file, static_cast<std::uint32_t>(scene.positions.size()));
    append(file, static_cast<std::uint32_t>(scene.triangles.size()));
    for (const std::string& name : scene.materials) {
        append(file, static_cast<std::uint32_t>(name.size()));
        file.insert(file.end(), name.begin(), name.end());
    }
    for (const glm::vec3& at : scene.positions)
        for (int axis = 0; axis < 3; ++axis)
            append(file, std::bit_cast<std::uint32_t>(at[axis] + 0.0F));  // -0 is 0
    for (const SceneTriangle& triangle : scene.triangles) {
        for (const std::uint32_t corner : triangle.corners) append(file, corner);
        append(file, triangle.material);
    }
    return file;
}

std::optional<Scene> scene_in(std::span<const std::uint8_t> file) {
    if (file.size() < format.size() || !std::equal(format.begin(), format.end(), file.begin()))
        return std::nullopt;
    FileReader reader(file.subspan(format.size()));
    const std::uint32_t materials = reader.number(), positions = reader.number(),
                        triangles = reader.number();
    if (materials == 0 || materials > most_scene_materials || triangles > most_scene_triangles ||
        positions > 3 * most_scene_triangles)
        return std::nullopt;
    Scene scene;
    for (std::uint32_t i = 0; i < materials; ++i)
        scene.materials.push_back(reader.text(reader.number()));
    if (reader.size() != std::size_t{12} * positions + std::size_t{16} * triangles)
        return std::nullopt;
    scene.positions.resize(positions);
    for (glm::vec3& at : scene.positions)
        for (int axis = 0; axis < 3; ++axis) {
            at[axis] = std::bit_cast<float>(reader.number());
            if (!std::isfinite(at[axis])) return std::nullopt;
        }
    scene.triangles.resize(triangles);
    for (SceneTriangle& triangle : scene.triangles) {
        for (std::uint32_t& corner : triangle.corners) {
            corner = reader.number();
            if (corner >= positions) return std::nullopt;
        }
        const std::uint32_t material = reader.number();
        if (material >= materials) return std::nullopt;
        triangle.material = static_cast<std::uint16_t>(material);
    }
    if (!reader.is_done()) return std::nullopt;
    return scene;
}

std::string id_of(const Scene& scene) {
    const Bytes file = file_of(scene);
    return "s-" + sha256_hex(file.data(), file.size()).substr(0, 32);
}

}  // namespace sporeprint
