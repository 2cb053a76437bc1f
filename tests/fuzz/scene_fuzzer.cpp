// Fuzzes uploaded scenes: the bytes as they are, as a stored scene, and as the JSON chunk of a well-formed GLB with a
// few numbers behind it.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/problems.h"
#include "core/scene/scene_file.h"
#include "core/scene/scene_store.h"
#include "core/scene/triangle_tree.h"
#include "tests/fuzz/expect.h"

using namespace sporeprint;

namespace {

void read(std::span<const std::uint8_t> file) {
    try {
        const Scene scene = scene_in_glb(file);
        for (const SceneTriangle& triangle : scene.triangles)
            for (const std::uint32_t corner : triangle.corners)
                expect(corner < scene.positions.size(), "corners are vertices");
        const TriangleTree tree(scene);
        (void)tree.is_blocked({0.0, 60.0, 0.0}, {0.1, -1.0, 0.05}, 0.0, 200.0);
        const std::optional<Scene> stored = scene_in(file_of(scene));
        expect(stored.has_value() && id_of(*stored) == id_of(scene), "a stored scene is the same");
    } catch (const InvalidInput&) {
        // refused with a reason, as specified
    }
}

void append(std::vector<std::uint8_t>& out, std::uint32_t number) {
    for (int shift = 0; shift < 32; shift += 8)
        out.push_back(static_cast<std::uint8_t>(number >> shift));
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    read({data, size});
    (void)scene_in({data, size});

    constexpr std::uint32_t bytes_of_buffer = 96;
    const auto padded = static_cast<std::uint32_t>((size + 3) / 4 * 4);
    std::vector<std::uint8_t> glb;
    append(glb, 0x46546C67);  // "glTF"
    append(glb, 2);
    append(glb, 28 + padded + bytes_of_buffer);
    append(glb, padded);
    append(glb, 0x4E4F534A);  // "JSON"
    glb.insert(glb.end(), data, data + size);
    glb.resize(20 + padded, ' ');
    append(glb, bytes_of_buffer);
    append(glb, 0x004E4942);  // "BIN"
    for (std::uint32_t i = 0; i < bytes_of_buffer / 4; ++i)
        append(glb, i < 12 ? 0x3F800000U + (i * 2654435761U >> 10U) : i % 4);
    read(glb);
    return 0;
}
