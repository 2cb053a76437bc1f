#include "core/gltf/primitives.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <functional>
#include <glm/common.hpp>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "core/gltf/compression.h"
#include "core/gltf/json_text.h"
#include "core/mesh/index_order.h"
#include "core/problems.h"

namespace sporeprint::gltf {

namespace {

/// Throws GenerationError for a mesh that is empty or lacks what its material needs.
void check_mesh(const Mesh& mesh, TextureData data) {
    const std::size_t n = mesh.positions.size();
    if (n == 0 || mesh.indices.empty()) throw GenerationError("an empty mesh cannot be written");
    if (mesh.normals.size() != n || (data == TextureData::all && mesh.tangents.size() != n) ||
        (data != TextureData::none && mesh.texture_coordinates.size() != n) ||
        (!mesh.sway.empty() && mesh.sway.size() != n) ||
        (!mesh.tints.empty() && mesh.tints.size() != n))
        throw GenerationError("a mesh lacks what its material needs of each vertex");
}

std::array<std::uint16_t, 2> normalized_coordinates(const glm::vec2& uv) {
    return {static_cast<std::uint16_t>(std::floor(uv.x * 65535.0F + 0.5F)),
            static_cast<std::uint16_t>(std::floor(uv.y * 65535.0F + 0.5F))};
}

std::uint8_t normalized_byte(float value) {
    return static_cast<std::uint8_t>(std::floor(value * 255.0F + 0.5F));
}

/// Returns the bounds of integers, which a reader compares before it scales them.
std::string bounds_of(std::span<const Quantized16> values) {
    Quantized16 low = values.front(), high = low;
    for (const Quantized16& value : values)
        for (std::size_t k = 0; k < 3; ++k) {
            low[k] = std::min(low[k], value[k]);
            high[k] = std::max(high[k], value[k]);
        }
    const auto list = [](const Quantized16& of) {
        return std::to_string(of[0]) + ',' + std::to_string(of[1]) + ',' + std::to_string(of[2]);
    };
    return ",\"min\":[" + list(low) + "],\"max\":[" + list(high) + "]";
}

constexpr const char* octahedral = "OCTAHEDRAL";

/// Returns a stream of vertices without bytes.
///
/// more      members of its accessor
/// encoded   whether it is compressed
/// filter    of the items, if they are compressed
Stream vertex_stream(const char* attribute, int component, const char* type, std::string more,
                     bool encoded, const char* filter = nullptr) {
    return {.attribute = attribute,
            .component = component,
            .type = type,
            .more = std::move(more),
            .target = vertex_target,
            .mode = encoded ? attributes_mode : nullptr,
            .filter = encoded ? filter : nullptr};
}

/// Sets positions as integers.
void set_positions(Stream& stream, const std::vector<Quantized16>& items) {
    stream.more = bounds_of(items);
    stream.set_items(items);
}

std::vector<std::array<std::uint16_t, 2>> normalized_coordinates(
    std::span<const glm::vec2> coordinates) {
    std::vector<std::array<std::uint16_t, 2>> items;
    items.reserve(coordinates.size());
    for (const glm::vec2& uv : coordinates) items.push_back(normalized_coordinates(uv));
    return items;
}

/// A stream of vertices and what sets its items.
struct StreamPlan {
    Stream stream;
    std::function<void(Stream&)> set;
};

/// Returns the streams of the sway of a mesh: none if it has no sway.
///
/// throws  GenerationError for texture coordinates of a mesh without others, which have to precede
std::vector<StreamPlan> sway_streams(const Mesh& mesh, bool textured, GlbSway format,
                                     bool encoded) {
    if (mesh.sway.empty()) return {};
    const auto plan = [&](const char* name, int component, const char* type, auto components) {
        return StreamPlan{vertex_stream(name, component, type, normalized, encoded),
                          [&mesh, components](Stream& stream) {
                              std::vector<decltype(components(Sway()))> items;
                              items.reserve(mesh.sway.size());
                              for (const Sway& of : mesh.sway) items.push_back(components(of));
                              stream.set_items(items);
                          }};
    };
    if (format != GlbSway::texture_coordinates)
        return {plan(format == GlbSway::color ? "COLOR_0" : "_WIND", u8_component, "VEC4",
                     [](const Sway& of) {
                         return std::array{normalized_byte(of.bend), normalized_byte(of.flutter),
                                           normalized_byte(of.phase), normalized_byte(of.branch)};
                     })};
    if (!textured)
        throw GenerationError("sway as texture coordinates needs a mesh that has others");
    return {plan("TEXCOORD_1", u16_component, "VEC2",
                 [](const Sway& of) {
                     return normalized_coordinates({of.bend, of.phase});
                 }),
            plan("TEXCOORD_2", u16_component, "VEC2", [](const Sway& of) {
                return normalized_coordinates({of.flutter, of.branch});
            })};
}

/// Returns whether the tints of a mesh are written: not where its sway takes the place of colours.
bool writes_tints(const Mesh& mesh, GlbSway format) {
    return !mesh.tints.empty() && (mesh.sway.empty() || format != GlbSway::color);
}

/// Returns the stream of the tints of a mesh. Items of four bytes are aligned as readers need it.
StreamPlan tint_stream(const Mesh& mesh, bool encoded) {
    return {vertex_stream("COLOR_0", u8_component, "VEC4", normalized, encoded),
            [&mesh](Stream& stream) {
                std::vector<std::array<std::uint8_t, 4>> items;
                items.reserve(mesh.tints.size());
                for (const glm::vec3& tint : mesh.tints)
                    items.push_back({normalized_byte(tint.x), normalized_byte(tint.y),
                                     normalized_byte(tint.z), 255});
                stream.set_items(items);
            }};
}

/// Throws GenerationError for a target with another number of vertices than its mesh.
void check_targets(const GlbPrimitive& primitive) {
    const std::size_t vertices = primitive.mesh->positions.size();
    const std::span<const MorphTarget> targets = primitive.targets;
    for (const MorphTarget& target : targets)
        if (target.positions.size() != vertices ||
            target.normals.size() != (targets.front().normals.empty() ? 0 : vertices))
            throw GenerationError("a morph target has another number of vertices than its mesh");
}

/// The members of a primitive while they are written.
class PrimitiveMembers {
  public:
    void attribute(const char* name, std::size_t accessor) {
        attributes_ += attributes_.empty() ? "\"" : ",\"";
        append((attributes_ += name) += "\":", accessor);
    }

    void target(std::size_t positions, std::optional<std::size_t> normals) {
        targets_ += targets_.empty() ? ",\"targets\":[" : ",";
        append(targets_ += "{\"POSITION\":", positions);
        if (normals) append(targets_ += ",\"NORMAL\":", *normals);
        targets_ += '}';
    }

    [[nodiscard]] PrimitiveJson json(std::size_t indices) const {
        std::string before = "\"attributes\":{" + attributes_ + "},\"indices\":";
        append(before, indices);
        return {std::move(before), targets_.empty() ? std::string() : targets_ + ']'};
    }

  private:
    std::string attributes_, targets_;
};

/// Appends what only has to be counted if the bytes are elsewhere.
class OptionalChunk {
  public:
    OptionalChunk(std::size_t size, bool is_written) {
        if (is_written) chunk_ = std::make_unique<Chunk>(size);
    }

    template <class T>
    void append(const std::vector<T>& values) {
        if (chunk_) chunk_->append(std::span<const T>(values));
    }
    /// Appends a value for each item, which has its own type in the file.
    template <class Items, class Value>
    void append_each(const Items& items, const Value& value) {
        if (!chunk_) return;
        for (const auto& item : items) put(chunk_->at, value(item));
    }
    /// Sets and appends a stream of four bytes for each of n vertices.
    void append(StreamPlan& plan, std::size_t n) {
        Stream& stream = plan.stream;
        stream.items = n;
        stream.stride = 4;
        stream.length = 4 * n;
        if (!chunk_) return;
        plan.set(stream);
        stream.encode();
        chunk_->append(std::span<const std::uint8_t>(*stream.bytes));
    }
    void move_to(Body& body) {
        if (chunk_) body.emplace_back(std::move(chunk_->bytes));
    }

  private:
    std::unique_ptr<Chunk> chunk_;
};

/// body  null if the bytes are elsewhere
PrimitiveJson write_floats(const GlbPrimitive& primitive, TextureData data, GlbSway sway,
                           Tables& tables, Body* body) {
    const Mesh& mesh = *primitive.mesh;
    check_mesh(mesh, data);
    check_targets(primitive);
    const std::size_t n = mesh.positions.size();
    const bool small = n <= 65535;
    const std::size_t index_bytes = mesh.indices.size() * (small ? 2 : 4);
    const bool has_tangents = data == TextureData::all, has_coordinates = data != TextureData::none;
    const std::size_t sway_size = mesh.sway.empty()                      ? 0
                                  : sway == GlbSway::texture_coordinates ? 8
                                                                         : 4;
    const bool has_tints = writes_tints(mesh, sway);
    OptionalChunk chunk(n * (12 + 12 + (has_tangents ? 16 : 0) + (has_coordinates ? 4 : 0) +
                             sway_size + (has_tints ? 4 : 0)) +
                            padded(index_bytes),
                        body != nullptr);
    PrimitiveMembers out;
    chunk.append(mesh.positions);
    out.attribute("POSITION", tables.positions(mesh.positions));
    chunk.append(mesh.normals);
    out.attribute("NORMAL", tables.vectors(mesh.normals));
    if (has_tangents) {
        chunk.append(mesh.tangents);
        out.attribute("TANGENT",
                      tables.accessor(n, float_component, "VEC4", n * 16, vertex_target));
    }
    if (has_coordinates) {
        chunk.append_each(mesh.texture_coordinates,
                          [](const glm::vec2& uv) { return normalized_coordinates(uv); });
        out.attribute("TEXCOORD_0",
                      tables.accessor(n, u16_component, "VEC2", n * 4, vertex_target, normalized));
    }
    std::vector<StreamPlan> plans = sway_streams(mesh, has_coordinates, sway, false);
    if (has_tints) plans.push_back(tint_stream(mesh, false));
    for (StreamPlan& plan : plans) {
        chunk.append(plan, n);
        out.attribute(plan.stream.attribute, tables.stream(plan.stream));
    }
    if (small)
        chunk.append_each(mesh.indices,
                          [](std::uint32_t i) { return static_cast<std::uint16_t>(i); });
    else
        chunk.append(mesh.indices);
    const std::size_t indices =
        tables.accessor(mesh.indices.size(), small ? u16_component : u32_component, "SCALAR",
                        index_bytes, index_target);
    if (body == nullptr) return out.json(indices);
    chunk.move_to(*body);
    if (primitive.targets.empty()) return out.json(indices);
    Chunk offsets(primitive.targets.size() * n *
                  (primitive.targets.front().normals.empty() ? 12 : 24));
    for (const MorphTarget& target : primitive.targets) {
        offsets.append(std::span<const glm::vec3>(target.positions));
        const std::size_t positions = tables.positions(target.positions);
        std::optional<std::size_t> normals;
        if (!target.normals.empty()) {
            offsets.append(std::span<const glm::vec3>(target.normals));
            normals = tables.vectors(target.normals);
        }
        out.target(positions, normals);
    }
    body->emplace_back(std::move(offsets.bytes));
    return out.json(indices);
}

/// The streams of a quantised primitive: planned, then made by tasks, then written.
class QuantizedPrimitive {
  public:
    /// step  of the positions
    QuantizedPrimitive(const GlbPrimitive& primitive, TextureData data, GlbSway sway, float step,
                       bool compressed)
        : mesh_(*primitive.mesh), reorders_(compressed && primitive.targets.empty()) {
        check_mesh(mesh_, data);
        check_targets(primitive);
        plan_vertices(data, step, compressed);
        for (StreamPlan& plan : sway_streams(mesh_, data != TextureData::none, sway, compressed))
            attributes_.push_back(std::move(plan));
        if (writes_tints(mesh_, sway)) attributes_.push_back(tint_stream(mesh_, compressed));
        const bool small = mesh_.positions.size() <= 65535;
        triangle_stream_ = {.items = mesh_.indices.size(),
                            .stride = small ? 2U : 4U,
                            .component = small ? u16_component : u32_component,
                            .type = "SCALAR",
                            .target = index_target,
                            .mode = compressed ? triangles_mode : nullptr};
        for (const MorphTarget& target : primitive.targets) plan_target(target, step, compressed);
    }

    /// Adds independent tasks that set all items, and find the order in which triangles and vertices
    /// compress well, unless those of targets have to stay in their order.
    void add_first_tasks(std::vector<std::function<void()>>& tasks) {
        if (reorders_) tasks.emplace_back([this] { reorder(); });
        for (std::vector<StreamPlan>* plans : {&attributes_, &targets_})
            for (StreamPlan& plan : *plans) tasks.emplace_back([&plan] { plan.set(plan.stream); });
    }

    /// Adds independent tasks that encode the streams, when the first ones are done.
    void add_last_tasks(std::vector<std::function<void()>>& tasks) {
        // Triangles take longest, so they come first.
        tasks.emplace_back([this] {
            triangle_stream_.encode_triangles(reorders_ ? reordered_.indices : mesh_.indices,
                                              mesh_.positions.size());
        });
        for (std::vector<StreamPlan>* plans : {&attributes_, &targets_})
            for (StreamPlan& plan : *plans)
                tasks.emplace_back([this, &plan] { plan.stream.encode(reordered_.order); });
    }

    /// Writes the streams, once their tasks are done.
    PrimitiveJson write(Tables& tables, Body& body) const {
        const auto written = [&](const Stream& stream) {
            body.emplace_back(stream.bytes);
            return tables.stream(stream);
        };
        PrimitiveMembers out;
        for (const StreamPlan& plan : attributes_)
            out.attribute(plan.stream.attribute, written(plan.stream));
        const std::size_t indices = written(triangle_stream_);
        for (std::size_t i = 0; i < targets_.size(); ++i) {
            const std::size_t positions = written(targets_[i].stream);
            std::optional<std::size_t> normals;
            if (i + 1 < targets_.size() && targets_[i + 1].stream.component == float_component)
                normals = written(targets_[++i].stream);
            out.target(positions, normals);
        }
        return out.json(indices);
    }

  private:
    void plan_vertices(TextureData data, float step, bool compressed) {
        attributes_.push_back({vertex_stream("POSITION", i16_component, "VEC3", {}, compressed),
                               [this, step](Stream& stream) {
                                   set_positions(stream, quantized(mesh_.positions, step));
                               }});
        attributes_.push_back(
            {vertex_stream("NORMAL", i16_component, "VEC3", normalized, compressed, octahedral),
             [this](Stream& stream) {
                 stream.set_items(stream.mode ? octahedral_normals(mesh_.normals)
                                              : quantized_normals(mesh_.normals));
             }});
        if (data == TextureData::all)
            attributes_.push_back(
                {vertex_stream("TANGENT", i8_component, "VEC4", normalized, compressed, octahedral),
                 [this](Stream& stream) {
                     stream.set_items(stream.mode ? octahedral_tangents(mesh_.tangents)
                                                  : quantized_tangents(mesh_.tangents));
                 }});
        if (data != TextureData::none)
            attributes_.push_back(
                {vertex_stream("TEXCOORD_0", u16_component, "VEC2", normalized, compressed),
                 [this](Stream& stream) {
                     stream.set_items(normalized_coordinates(mesh_.texture_coordinates));
                 }});
    }

    void plan_target(const MorphTarget& target, float step, bool compressed) {
        targets_.push_back({vertex_stream(nullptr, i16_component, "VEC3", {}, compressed),
                            [&target, step](Stream& stream) {
                                set_positions(stream, quantized(target.positions, step));
                            }});
        if (!target.normals.empty())
            targets_.push_back({vertex_stream(nullptr, float_component, "VEC3", {}, compressed),
                                [&target](Stream& stream) { stream.set_items(target.normals); }});
    }

    void reorder() {
        const std::size_t n = mesh_.positions.size();
        reordered_ = renumbered_by_first_use(triangles_by_last_vertex(mesh_.indices, n), n);
    }

    const Mesh& mesh_;
    bool reorders_;
    Renumbered reordered_;  ///< empty unless it reorders
    std::vector<StreamPlan> attributes_;
    Stream triangle_stream_;
    std::vector<StreamPlan> targets_;  ///< positions of each, followed by normals if it has them
};

}  // namespace

std::vector<PrimitiveJson> write_primitives(std::span<const PrimitivePart> parts, GlbSway sway,
                                            GlbGeometry storage, const Parallel& parallel,
                                            Tables& tables, Body* body) {
    std::vector<PrimitiveJson> written;
    written.reserve(parts.size());
    if (storage == GlbGeometry::floats) {
        for (const PrimitivePart& part : parts)
            written.push_back(write_floats(*part.primitive, part.data, sway, tables, body));
        return written;
    }
    // Tasks hold the addresses of the primitives, which a deque never moves.
    std::deque<QuantizedPrimitive> primitives;
    std::vector<std::function<void()>> first, last;
    for (const PrimitivePart& part : parts) {
        QuantizedPrimitive& primitive = primitives.emplace_back(
            *part.primitive, part.data, sway, part.step, storage == GlbGeometry::compressed);
        primitive.add_first_tasks(first);
        primitive.add_last_tasks(last);
    }
    parallel(first);
    parallel(last);
    for (const QuantizedPrimitive& primitive : primitives)
        written.push_back(primitive.write(tables, *body));
    return written;
}

std::string target_weights_json(const GlbMesh& mesh) {
    const auto& targets = mesh.primitives.front().targets;
    for (const GlbPrimitive& other : mesh.primitives)
        if (other.targets.size() != targets.size())
            throw GenerationError("the primitives of a mesh have as many targets each");
    if (targets.empty()) return {};
    std::string names, zeros;
    for (const MorphTarget& target : targets) {
        append_quoted(names += names.empty() ? "" : ",", target.name);
        zeros += zeros.empty() ? "0" : ",0";
    }
    return ",\"weights\":[" + zeros + "],\"extras\":{\"targetNames\":[" + names + "]}";
}

float step_of(const GlbMesh& mesh, GlbGeometry storage) {
    if (storage == GlbGeometry::floats) return 1.0F;
    float largest = 0.0F;
    for (const GlbPrimitive& primitive : mesh.primitives) {
        largest = largest_coordinate(primitive.mesh->positions, largest);
        for (const MorphTarget& target : primitive.targets)
            largest = largest_coordinate(target.positions, largest);
    }
    if (mesh.step > 0.0F) {
        constexpr float most = 32767.0F;
        if (largest > most * mesh.step)
            throw GenerationError("a mesh is too large for the step of its positions");
        return mesh.step;
    }
    return largest > 0.0F ? largest / static_cast<float>(most_quantized) : 1.0F;
}

}  // namespace sporeprint::gltf
