#include "core/gltf/inspect.h"

#include <tiny_gltf.h>

#include <cstring>

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

/// The JSON chunk without what would make a reader open files, decode images or follow offsets.
std::string structure_of(const Value& document) {
    Value bare = document;
    for (const char* key :
         {"buffers", "bufferViews", "images", "textures", "samplers", "materials", "animations",
          "extensions", "extensionsUsed", "extensionsRequired", "extras"})
        bare.erase(key);
    if (Value* accessors = bare.find("accessors"); accessors && accessors->is_array())
        for (Value& accessor : accessors->items()) {
            if (!accessor.is_object()) continue;
            accessor.set("bufferView", Value(0));
            accessor.erase("sparse");
        }
    // The reader wants every accessor to have a view; of a buffer it is told nothing.
    Value view = Value::object();
    view.set("buffer", Value(0));
    view.set("byteLength", Value(1));
    Value views = Value::array();
    views.push(std::move(view));
    bare.set("bufferViews", std::move(views));
    return dump(bare);
}

std::uint64_t count_of(const Value& document, const char* key) {
    const Value* list = document.find(key);
    return list && list->is_array() ? list->items().size() : 0;
}

}  // namespace

Inspection inspect_glb(std::span<const std::uint8_t> file) {
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

    std::vector<Problem> problems;
    const Value document =
        parse(std::string_view(reinterpret_cast<const char*>(file.data()) + 20, size), problems);
    if (!problems.empty())
        throw refusal("the JSON chunk cannot be read: " + problems.front().message);
    const Value* generator = document.at_pointer("/asset/generator");
    const Value* canonical = document.at_pointer("/asset/extras/canonical");
    const Value* effective = document.at_pointer("/asset/extras/effective");
    if (!generator || !generator->is_string() || !generator->as_string().starts_with("Sporeprint "))
        throw refusal("this file was not made by Sporeprint: asset.generator says otherwise");
    if (!canonical || !canonical->is_string() || !effective || !effective->is_object())
        throw refusal("this file does not carry the request that made it (asset.extras)");

    tinygltf::TinyGLTF reader;
    tinygltf::Model model;
    std::string error, warning;
    const std::string text = structure_of(document);
    if (!reader.LoadASCIIFromString(&model, &error, &warning, text.data(),
                                    static_cast<unsigned>(text.size()), ""))
        throw refusal("the glTF cannot be read: " + error.substr(0, error.find('\n')));

    Inspection found;
    found.generator = generator->as_string();
    found.canonical = canonical->as_string();
    found.effective_json = dump(*effective);
    found.bytes = file.size();
    found.meshes = model.meshes.size();
    found.materials = count_of(document, "materials");
    found.images = count_of(document, "images");
    found.animations = count_of(document, "animations");
    const auto items = [&](int accessor) -> std::uint64_t {
        return accessor >= 0 && static_cast<std::size_t>(accessor) < model.accessors.size()
                   ? model.accessors[static_cast<std::size_t>(accessor)].count
                   : 0;
    };
    for (const auto& mesh : model.meshes)
        for (const auto& primitive : mesh.primitives) {
            if (const auto position = primitive.attributes.find("POSITION");
                position != primitive.attributes.end())
                found.vertices += items(position->second);
            found.triangles += items(primitive.indices) / 3;
            found.morph_targets += primitive.targets.size();
        }
    return found;
}

}  // namespace sporeprint
