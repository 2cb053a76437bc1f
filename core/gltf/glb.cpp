#include "core/gltf/glb.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <optional>
#include <utility>

#include "core/gltf/compression.h"
#include "core/gltf/json_text.h"
#include "core/gltf/materials.h"
#include "core/gltf/primitives.h"
#include "core/gltf/tables.h"
#include "core/problems.h"
#include "core/version.h"

namespace sporeprint {

using namespace gltf;

namespace {

constexpr const char *quantization = "KHR_mesh_quantization",
                     *gpu_instancing = "EXT_mesh_gpu_instancing",
                     *materials_variants = "KHR_materials_variants";

/// The animation of the first node.
struct AnimationData {
    std::shared_ptr<const Bytes> bytes;
    std::string animations;  ///< JSON member, with a leading comma
};

AnimationData animation_data(const WeightClip& clip, std::size_t targets, Tables& tables) {
    if (targets == 0 || clip.times.empty() || clip.weights.size() != clip.times.size() * targets)
        throw GenerationError("a clip needs targets, and a weight for each of them at each key");
    Chunk chunk((clip.times.size() + clip.weights.size()) * 4);
    chunk.append(std::span<const float>(clip.times));
    chunk.append(std::span<const float>(clip.weights));
    std::string span = ",\"min\":[";
    append(span, clip.times.front());
    append(span += "],\"max\":[", clip.times.back());
    const std::size_t input = tables.accessor(clip.times.size(), float_component, "SCALAR",
                                              clip.times.size() * 4, 0, span + ']');
    const std::size_t output =
        tables.accessor(clip.weights.size(), float_component, "SCALAR", clip.weights.size() * 4);
    AnimationData out;
    append_quoted(out.animations += ",\"animations\":[{\"name\":", clip.name);
    append(out.animations += ",\"samplers\":[{\"input\":", input);
    append(out.animations += ",\"output\":", output);
    out.animations +=
        ",\"interpolation\":\"LINEAR\"}],\"channels\":[{\"sampler\":0,\"target\":{\"node\":0,"
        "\"path\":\"weights\"}}]}]";
    out.bytes = std::move(chunk.bytes);
    return out;
}

void check_transform(const glm::dvec4& rotation, const glm::vec3& scale) {
    if (!(std::abs(glm::dot(rotation, rotation) - 1.0) < 1e-6))
        throw GenerationError("the rotation of a node is no unit quaternion");
    if (!(std::abs(scale.x * scale.y * scale.z) > 0.0F))
        throw GenerationError("a node has a scale of nothing");
}

// Bits of the transforms of compressed instances: errors are 2^-15 of the distance from the node,
// 0.03 degrees, and 2^-10 of the size, which is a fifth of a millimetre at the tip of a long leaf.
// Tints are as exact as bytes.
constexpr int bits_of_translations = 15, bits_of_rotations = 12, bits_of_scales = 12,
              bits_of_tints = 9;

/// Writes the transforms of instances, as floats, which need no normalisation by readers; nodes
/// with equal ones share their accessors.
class InstanceWriter {
  public:
    InstanceWriter(GlbGeometry storage, Tables& tables, Body& geometries)
        : is_compressed_(storage == GlbGeometry::compressed),
          tables_(tables),
          geometries_(geometries) {}

    /// Returns the attributes of a node's instances, as JSON members.
    ///
    /// step  of the positions of their mesh, by which the node is scaled
    std::string attributes_of(const std::vector<GlbTransform>& places, double step) {
        std::vector<float> translations, rotations, scales, tints;
        bool has_tints = false;
        const auto put_vector = [](std::vector<float>& out, const auto& vector) {
            for (int k = 0; k < vector.length(); ++k) out.push_back(vector[k]);
        };
        for (const GlbTransform& place : places) {
            check_transform(place.rotation, glm::vec3(place.scale));
            put_vector(translations, glm::vec3(place.translation / step));
            put_vector(rotations, glm::vec4(place.rotation));
            put_vector(scales, glm::vec3(place.scale));
            put_vector(tints, place.tint);
            has_tints = has_tints || place.tint != glm::vec3(1.0F);
        }
        std::string attributes;
        append(attributes += "\"TRANSLATION\":",
               accessor_of(translations, "VEC3", 3, bits_of_translations));
        append(attributes += ",\"ROTATION\":",
               accessor_of(rotations, "VEC4", 4, bits_of_rotations));
        append(attributes += ",\"SCALE\":", accessor_of(scales, "VEC3", 3, bits_of_scales));
        if (has_tints)
            append(attributes += ",\"_COLOR_0\":", accessor_of(tints, "VEC3", 3, bits_of_tints));
        return attributes;
    }

  private:
    /// Returns the accessor of vectors, a new one unless these are written already.
    ///
    /// bits  of compressed components
    std::size_t accessor_of(const std::vector<float>& values, const char* type,
                            std::size_t components, int bits) {
        const auto [found, is_new] = written_.try_emplace({type, values}, tables_.count);
        if (!is_new) return found->second;
        Stream stream{.type = type,
                      .mode = is_compressed_ ? attributes_mode : nullptr,
                      .filter = "EXPONENTIAL"};
        if (is_compressed_)
            stream.set_items(filtered_vectors(values, components, bits));
        else
            stream.set_items(values);
        stream.items = values.size() / components;
        stream.stride = components * sizeof(float);
        stream.encode();
        tables_.stream(stream);
        geometries_.emplace_back(stream.bytes);
        return found->second;
    }

    bool is_compressed_;
    Tables& tables_;
    Body& geometries_;
    std::map<std::pair<std::string, std::vector<float>>, std::size_t> written_;
};

/// Returns the member `extensions` of an object, with a leading comma; empty for none.
std::string extensions_json(const std::vector<GlbExtension>& extensions, Extensions& used) {
    if (extensions.empty()) return {};
    std::string list;
    for (const GlbExtension& extension : extensions) {
        append_quoted(list += separator(list), extension.name);
        (list += ':') += extension.json;
        used.use(extension.name);
    }
    return ",\"extensions\":{" + list + "}";
}

/// Returns the JSON object of a node.
///
/// instances  attributes of its instances, if it has any
/// step    factor of the scale, by which the positions of its mesh were divided
std::string node_json(const GlbNode& node, double step, const std::string& instances,
                      Extensions& used) {
    const glm::vec3 translation(node.translation), scale(step * node.scale);
    const glm::vec4 rotation(node.rotation);
    check_transform(node.rotation, scale);
    std::string json = "{\"name\":";
    append_quoted(json, node.name);
    if (node.mesh) append(json += ",\"mesh\":", *node.mesh);
    if (translation != glm::vec3(0.0F)) append_triple(json += ",\"translation\":", translation);
    if (rotation != glm::vec4(0.0F, 0.0F, 0.0F, 1.0F)) {
        append_triple(json += ",\"rotation\":", glm::vec3(rotation));
        json.back() = ',';
        append(json, rotation.w);
        json += ']';
    }
    if (scale != glm::vec3(1.0F)) append_triple(json += ",\"scale\":", scale);
    std::vector<GlbExtension> extensions = node.extensions;
    if (!instances.empty()) {
        extensions.push_back({gpu_instancing, "{\"attributes\":{" + instances + "}}"});
        used.require(gpu_instancing);
    }
    json += extensions_json(extensions, used);
    if (!node.extras_json.empty()) (json += ",\"extras\":") += node.extras_json;
    if (!node.children.empty()) {
        std::string children;
        for (const std::size_t child : node.children)
            append(children += separator(children), child);
        json += ",\"children\":[" + children + "]";
    }
    return json + "}";
}

const std::shared_ptr<const Bytes>& zeros() {
    static const auto bytes = std::make_shared<const Bytes>(4, std::uint8_t{0});
    return bytes;
}

/// Returns the header, the JSON chunk and the start of the BIN chunk.
Slice head_of(std::string json, std::size_t binary) {
    json.append(padded(json.size()) - json.size(), ' ');
    // A file without a buffer has one chunk.
    const std::size_t of_binary = binary > 0 ? 8 : 0;
    const std::size_t total = 12 + 8 + json.size() + of_binary + binary;
    if (total > 0xFFFFFFFFULL) throw GenerationError("the file would exceed 4 GB");
    auto head = std::make_shared<Bytes>(12 + 8 + json.size() + of_binary);
    std::uint8_t* at = head->data();
    put(at, std::uint32_t{0x46546C67});  // "glTF"
    put(at, std::uint32_t{2});
    put(at, static_cast<std::uint32_t>(total));
    put(at, static_cast<std::uint32_t>(json.size()));
    put(at, std::uint32_t{0x4E4F534A});  // "JSON"
    std::memcpy(at, json.data(), json.size());
    at += json.size();
    if (binary > 0) {
        put(at, static_cast<std::uint32_t>(binary));
        put(at, std::uint32_t{0x004E4942});  // "BIN"
    }
    return Slice(std::move(head));
}

/// Returns the steps of the positions of all meshes. Those that have instances have one step, so
/// that levels of detail with instances at equal places share these.
std::vector<float> steps_of(const GlbScene& scene) {
    std::vector<float> steps;
    steps.reserve(scene.meshes.size());
    for (const GlbMesh& mesh : scene.meshes) steps.push_back(step_of(mesh, scene.geometry));
    if (scene.geometry == GlbGeometry::floats) return steps;
    float largest = 0.0F;
    for (const bool is_set : {false, true})
        for (const GlbNode& node : scene.nodes) {
            if (node.instances.empty() || !node.mesh || *node.mesh >= steps.size()) continue;
            if (is_set)
                steps[*node.mesh] = largest;
            else
                largest = std::max(largest, steps[*node.mesh]);
        }
    return steps;
}

TextureData data_for(const GlbMaterial& material) {
    if (!is_textured(material)) return TextureData::none;
    return material.is_external || has_base_colour_alone(material) ? TextureData::coordinates
                                                                   : TextureData::all;
}

/// Returns the member of a primitive that maps variants to materials, with a leading comma; empty
/// for none.
std::string variants_json(const GlbPrimitive& primitive, const GlbScene& scene) {
    const std::vector<std::size_t>& materials = primitive.variant_materials;
    if (materials.empty()) return {};
    if (materials.size() != scene.variants.size())
        throw GenerationError("a primitive has a material for each variant, or for none");
    std::string mappings;
    for (std::size_t i = 0; i < materials.size(); ++i) {
        if (materials[i] >= scene.materials.size())
            throw GenerationError("a variant wears a material that there is not");
        append((mappings += separator(mappings)) += "{\"material\":", materials[i]);
        append(mappings += ",\"variants\":[", i);
        mappings += "]}";
    }
    return std::string(",\"extensions\":{\"") + materials_variants + "\":{\"mappings\":[" +
           mappings + "]}}";
}

/// Returns all primitives of a scene and what is written of each.
///
/// steps  of the positions of each mesh
std::vector<PrimitivePart> parts_of(const GlbScene& scene, const std::vector<float>& steps) {
    std::vector<PrimitivePart> parts;
    for (std::size_t i = 0; i < scene.meshes.size(); ++i) {
        if (scene.meshes[i].primitives.empty()) throw GenerationError("a mesh has no primitives");
        for (const GlbPrimitive& primitive : scene.meshes[i].primitives) {
            const bool has_material = primitive.material != GlbPrimitive::no_material;
            if (has_material && primitive.material >= scene.materials.size())
                throw GenerationError("a primitive wears a material that there is not");
            parts.push_back(
                {&primitive,
                 has_material ? data_for(scene.materials[primitive.material]) : TextureData::none,
                 steps[i]});
        }
    }
    return parts;
}

/// A buffer that is a file of its own.
struct LinkedBuffer {
    std::string uri;
    std::size_t bytes = 0;
};

bool has_linked_geometry(const GlbScene& scene) {
    return std::any_of(scene.meshes.begin(), scene.meshes.end(),
                       [](const GlbMesh& mesh) { return !mesh.geometry_uri.empty(); });
}

/// Throws GenerationError for geometry that cannot be a file of its own.
void check_linked(const GlbScene& scene) {
    if (scene.geometry != GlbGeometry::floats)
        throw GenerationError("quantised geometry cannot be a file of its own");
    for (const GlbMesh& mesh : scene.meshes)
        for (const GlbPrimitive& primitive : mesh.primitives)
            if (!primitive.targets.empty())
                throw GenerationError("geometry with targets cannot be a file of its own");
}

/// Writes all primitives, those of meshes that have an address into buffers of their own.
std::vector<PrimitiveJson> write_linked(const GlbScene& scene,
                                        const std::vector<PrimitivePart>& parts,
                                        const Parallel& parallel, Tables& tables, Body& geometries,
                                        std::vector<LinkedBuffer>& linked) {
    check_linked(scene);
    std::vector<PrimitiveJson> written;
    std::size_t in_file = tables.binary, first = 0;
    for (const GlbMesh& mesh : scene.meshes) {
        const auto own = std::span(parts).subspan(first, mesh.primitives.size());
        first += mesh.primitives.size();
        const bool is_linked = !mesh.geometry_uri.empty();
        tables.buffer = is_linked ? linked.size() + 1 : 0;
        tables.binary = is_linked ? 0 : in_file;
        const std::vector<PrimitiveJson> primitives = write_primitives(
            own, scene.sway, scene.geometry, parallel, tables, is_linked ? nullptr : &geometries);
        written.insert(written.end(), primitives.begin(), primitives.end());
        if (is_linked)
            linked.push_back({mesh.geometry_uri, tables.binary});
        else
            in_file = tables.binary;
    }
    tables.buffer = 0;
    tables.binary = in_file;
    return written;
}

/// Returns the JSON of all meshes, and appends their buffers to `geometries`.
///
/// steps   of the positions of each mesh
/// linked  receives the buffers that are files of their own
std::string meshes_json(const GlbScene& scene, const std::vector<float>& steps,
                        const Parallel& parallel, Tables& tables, Body& geometries,
                        std::vector<LinkedBuffer>& linked) {
    const std::vector<PrimitivePart> parts = parts_of(scene, steps);
    const std::vector<PrimitiveJson> written =
        has_linked_geometry(scene)
            ? write_linked(scene, parts, parallel, tables, geometries, linked)
            : write_primitives(parts, scene.sway, scene.geometry, parallel, tables, &geometries);
    std::string meshes;
    auto next = written.begin();
    for (const GlbMesh& mesh : scene.meshes) {
        std::string primitives;
        for (const GlbPrimitive& primitive : mesh.primitives) {
            (primitives += separator(primitives)) += "{" + next->geometry;
            if (primitive.material != GlbPrimitive::no_material)
                append(primitives += ",\"material\":", primitive.material);
            primitives += variants_json(primitive, scene);
            primitives += next++->targets + "}";
        }
        append_quoted((meshes += separator(meshes)) += "{\"name\":", mesh.name);
        meshes += ",\"primitives\":[" + primitives + "]" + target_weights_json(mesh) + "}";
    }
    return meshes;
}

/// JSON of all nodes, and the indices of the roots of the scene.
struct NodeData {
    std::string nodes, roots;
};

/// Returns which nodes are children of others.
std::vector<bool> children_of(const GlbScene& scene) {
    std::vector<bool> is_child(scene.nodes.size(), false);
    for (const GlbNode& node : scene.nodes) {
        if (node.mesh && !node.children.empty())
            throw GenerationError("a node has a mesh and children");
        for (const std::size_t child : node.children) {
            if (child >= scene.nodes.size() || is_child[child])
                throw GenerationError("a child of a node is no node, or that of another");
            is_child[child] = true;
        }
    }
    return is_child;
}

/// steps  of the positions of each mesh
NodeData node_data(const GlbScene& scene, const std::vector<float>& steps, Tables& tables,
                   Extensions& used, Body& geometries) {
    NodeData data;
    const std::vector<bool> is_child = children_of(scene);
    InstanceWriter writer(scene.geometry, tables, geometries);
    for (std::size_t i = 0; i < scene.nodes.size(); ++i) {
        const GlbNode& node = scene.nodes[i];
        if (node.mesh && *node.mesh >= scene.meshes.size())
            throw GenerationError("a node shows a mesh that there is not");
        if (!node.mesh && !node.instances.empty())
            throw GenerationError("a node without a mesh has instances");
        const double step = node.mesh ? static_cast<double>(steps[*node.mesh]) : 1.0;
        const std::string instances =
            node.instances.empty() ? std::string() : writer.attributes_of(node.instances, step);
        (data.nodes += separator(data.nodes)) += node_json(node, step, instances, used);
        if (node.in_scene && !is_child[i]) append(data.roots += separator(data.roots), i);
    }
    if (data.roots.empty()) throw GenerationError("a scene without nodes shows nothing");
    return data;
}

/// Returns a member with a list of objects; nothing for an empty one, which glTF does not allow.
std::string list_json(const char* name, const std::string& objects) {
    if (objects.empty()) return {};
    return std::string(",\"") + name + "\":[" + objects + "]";
}

/// Appends the image files of all textures, padded.
void append_images(const TextureTables& texture_tables, Body& body) {
    for (const Slice& file : texture_tables.image_files) {
        body.push_back(file);
        if (const std::size_t pad = padded(file.size) - file.size)
            body.push_back(Slice(zeros(), 0, pad));
    }
}

}  // namespace

Body glb(const GlbScene& scene, const Parallel& parallel) {
    if (scene.nodes.empty()) throw GenerationError("a scene without nodes shows nothing");
    Tables tables;
    Body geometries;
    Extensions used;
    if (scene.geometry != GlbGeometry::floats) used.require(quantization);
    if (scene.geometry == GlbGeometry::compressed) used.require(meshopt_compression);
    const std::vector<float> steps = steps_of(scene);
    std::vector<LinkedBuffer> linked;
    const std::string meshes = meshes_json(scene, steps, parallel, tables, geometries, linked);
    const NodeData nodes = node_data(scene, steps, tables, used, geometries);
    AnimationData clip;
    if (scene.clip) {
        if (!scene.nodes.front().mesh) throw GenerationError("a clip animates a node with a mesh");
        const GlbMesh& shown = scene.meshes[*scene.nodes.front().mesh];
        clip = animation_data(*scene.clip, shown.primitives.front().targets.size(), tables);
        geometries.emplace_back(std::move(clip.bytes));
    }
    // The views of images come after those of all accessors.
    TextureTables texture_tables;
    std::string materials;
    for (const GlbMaterial& material : scene.materials)
        (materials += separator(materials)) +=
            material_json(material, scene.material_extensions, texture_tables, tables, used);

    std::string json = "{\"asset\":{\"version\":\"2.0\",\"generator\":\"Sporeprint " +
                       std::to_string(generator_version) + "\"";
    if (!scene.extras_json.empty()) (json += ",\"extras\":") += scene.extras_json;
    std::vector<GlbExtension> of_file = scene.extensions;
    if (!scene.variants.empty()) {
        std::string names;
        for (const std::string& name : scene.variants) {
            append_quoted((names += separator(names)) += "{\"name\":", name);
            names += '}';
        }
        of_file.push_back({materials_variants, "{\"variants\":[" + names + "]}"});
    }
    const std::string extensions = extensions_json(of_file, used);
    json += "}" + used.json() + extensions + ",\"scene\":0,\"scenes\":[{\"nodes\":[" + nodes.roots +
            "]}],\"nodes\":[" + nodes.nodes + "]" + list_json("meshes", meshes) +
            list_json("materials", materials);
    if (!texture_tables.textures.empty())
        json += ",\"textures\":[" + texture_tables.textures + "],\"samplers\":[" +
                texture_tables.samplers + "],\"images\":[" + texture_tables.images + "]";
    // The first buffer of a file that has none of its own would be that of the BIN chunk.
    if (tables.binary == 0 && !linked.empty())
        throw GenerationError("a file with linked geometry has data of its own");
    if (tables.binary > 0) {
        append(json += ",\"buffers\":[{\"byteLength\":", tables.binary);
        for (const LinkedBuffer& buffer : linked) {
            append(json += "},{\"byteLength\":", buffer.bytes);
            append_quoted(json += ",\"uri\":", buffer.uri);
        }
        if (tables.decompressed > 0) {
            append(json += "},{\"byteLength\":", tables.decompressed);
            ((json += ",\"extensions\":{\"") += meshopt_compression) += "\":{\"fallback\":true}}";
        }
        json += "}]";
    }
    json += list_json("bufferViews", tables.views) + list_json("accessors", tables.accessors) +
            clip.animations + "}";

    Body body{head_of(std::move(json), tables.binary)};
    body.insert(body.end(), geometries.begin(), geometries.end());
    append_images(texture_tables, body);
    return body;
}

Body geometry_bytes(const GlbScene& scene, const Parallel& parallel) {
    check_linked(scene);
    Tables tables;
    Body geometries;
    static_cast<void>(write_primitives(parts_of(scene, steps_of(scene)), scene.sway, scene.geometry,
                                       parallel, tables, &geometries));
    return geometries;
}

}  // namespace sporeprint
