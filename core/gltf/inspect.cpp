#include "core/gltf/inspect.h"

#include <cstring>

#include "core/gltf/mesh_counts.h"
#include "core/params/messages.h"
#include "core/params/value.h"
#include "core/problems.h"

namespace sporeprint {

namespace {

std::uint32_t word(std::span<const std::uint8_t> file, std::size_t at) {
    std::uint32_t value = 0;
    std::memcpy(&value, file.data() + at, 4);
    return value;
}

InvalidInput refusal(std::string why) { return {"", std::move(why)}; }

std::uint64_t count_of(const Value& document, const char* key) {
    const Value* list = document.find(key);
    return list && list->is_array() ? list->items().size() : 0;
}

}  // namespace

std::string_view json_chunk(std::span<const std::uint8_t> file) {
    if (file.size() < 20 || word(file, 0) != 0x46546C67)
        throw refusal("not a GLB file: it does not begin with a glTF header");
    if (word(file, 4) != 2)
        throw refusal("glTF version " + std::to_string(word(file, 4)) + "; only version 2 is read");
    if (word(file, 8) != file.size())
        throw refusal("the header says " + std::to_string(word(file, 8)) + " bytes, but " +
                      std::to_string(file.size()) + " came");
    const std::size_t size = word(file, 12);
    if (word(file, 16) != 0x4E4F534A || size > file.size() - 20)
        throw refusal("the JSON chunk is missing or cut short");
    return {reinterpret_cast<const char*>(file.data()) + 20, size};
}

Inspection inspect_json(std::string_view json, const std::stop_token& stop) {
    if (json.size() > most_inspected_json)
        throw refusal("the JSON chunk has " + std::to_string(json.size()) + " bytes; at most " +
                      std::to_string(most_inspected_json) + " are read");
    const auto stop_if_requested = [&] {
        if (stop.stop_requested()) throw Cancelled();
    };
    stop_if_requested();
    std::vector<Problem> problems;
    const Value document = parse(json, problems);
    stop_if_requested();
    if (!problems.empty())
        throw refusal("the JSON chunk cannot be read: " + problems.front().message);
    const Value* generator = document.at_pointer("/asset/generator");
    const Value* canonical = document.at_pointer("/asset/extras/canonical");
    const Value* effective = document.at_pointer("/asset/extras/effective");
    // Tools that rewrite a file set their own asset.generator and keep asset.extras.
    if (!canonical || !canonical->is_string() || !effective || !effective->is_object())
        throw refusal(
            "this file does not carry a request of Sporeprint that made it (asset.extras)");

    Inspection found;
    if (generator && generator->is_string()) found.generator = printable(generator->as_string());
    found.canonical = canonical->as_string();
    found.effective_json = dump(*effective);
    if (found.effective_json.size() > most_effective_json)
        throw refusal("the effective parameters in this file have " +
                      std::to_string(found.effective_json.size()) + " bytes; at most " +
                      std::to_string(most_effective_json) + " are given back");
    const MeshCounts counts = mesh_counts(document);
    found.meshes = counts.meshes;
    found.vertices = counts.vertices;
    found.triangles = counts.triangles;
    found.morph_targets = counts.morph_targets;
    found.materials = count_of(document, "materials");
    found.images = count_of(document, "images");
    found.animations = count_of(document, "animations");
    return found;
}

Inspection inspect_glb(std::span<const std::uint8_t> file) {
    Inspection found = inspect_json(json_chunk(file));
    found.bytes = file.size();
    return found;
}

}  // namespace sporeprint
