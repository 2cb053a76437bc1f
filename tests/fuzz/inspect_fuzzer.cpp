// Fuzzes uploaded GLB files: the bytes as they are, and as the JSON chunk of a well-formed GLB.

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/gltf/inspect.h"
#include "core/problems.h"

using namespace sporeprint;

namespace {

void inspect(std::span<const std::uint8_t> file) {
    try {
        (void)inspect_glb(file);
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
    inspect({data, size});

    const auto padded = static_cast<std::uint32_t>((size + 3) / 4 * 4);
    std::vector<std::uint8_t> glb;
    append(glb, 0x46546C67);  // "glTF"
    append(glb, 2);
    append(glb, 20 + padded);
    append(glb, padded);
    append(glb, 0x4E4F534A);  // "JSON"
    glb.insert(glb.end(), data, data + size);
    glb.resize(20 + padded, ' ');
    inspect(glb);
    return 0;
}
