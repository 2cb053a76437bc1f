#include "core/gltf/mesh_counts.h"

#include <tiny_gltf.h>

#include <string>
#include <string_view>

#include "core/problems.h"

namespace sporeprint {

namespace {

/// Returns the number of JSON values at and below `value`.
std::size_t size_of_tree(const Value& value) {
    std::size_t sum = 1;
    if (value.is_array())
        for (const Value& item : value.items()) sum += size_of_tree(item);
    if (value.is_object())
        for (const auto& [key, member] : value.members()) sum += size_of_tree(member);
    return sum;
}

/// Returns the part of a document that is passed to tinygltf.
std::string structure_of(const Value& document) {
    Value structure = Value::object();
    structure.set("asset", Value::object().set("version", "2.0"));
    std::size_t values = 0;
    for (const char* const key : {"accessors", "meshes"})
        if (const Value* const list = document.find(key)) {
            values += size_of_tree(*list);
            structure.set(key, *list);
        }
    if (values > most_counted_values)
        throw InvalidInput("", "the glTF has " + std::to_string(values) +
                                   " values in its accessors and meshes; at most " +
                                   std::to_string(most_counted_values) + " are read");
    if (Value* const accessors = structure.find("accessors"); accessors && accessors->is_array())
        for (Value& accessor : accessors->items()) {
            if (!accessor.is_object()) continue;
            accessor.set("bufferView", Value(0));
            accessor.erase("sparse");
        }
    Value views = Value::array();
    views.push(Value::object().set("buffer", Value(0)).set("byteLength", Value(1)));
    structure.set("bufferViews", std::move(views));
    return dump(structure);
}

}  // namespace

MeshCounts mesh_counts(const Value& document) {
    tinygltf::TinyGLTF reader;
    tinygltf::Model model;
    std::string error, warning;
    const std::string text = structure_of(document);
    if (!reader.LoadASCIIFromString(&model, &error, &warning, text.data(),
                                    static_cast<unsigned>(text.size()), ""))
        throw InvalidInput("", "the glTF cannot be read: " + error.substr(0, error.find('\n')));

    const auto elements = [&](int accessor) -> std::uint64_t {
        return accessor >= 0 && static_cast<std::size_t>(accessor) < model.accessors.size()
                   ? model.accessors[static_cast<std::size_t>(accessor)].count
                   : 0;
    };
    MeshCounts counts;
    counts.meshes = model.meshes.size();
    for (const auto& mesh : model.meshes)
        for (const auto& primitive : mesh.primitives) {
            if (const auto position = primitive.attributes.find("POSITION");
                position != primitive.attributes.end())
                counts.vertices += elements(position->second);
            counts.triangles += elements(primitive.indices) / 3;
            counts.morph_targets += primitive.targets.size();
        }
    return counts;
}

}  // namespace sporeprint
