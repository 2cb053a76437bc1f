#include "core/scene/scene_file.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <glm/geometric.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec4.hpp>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/gltf/inspect.h"
#include "core/params/messages.h"
#include "core/params/value.h"
#include "core/problems.h"

namespace sporeprint {

namespace {

/// Nodes below each other at most.
constexpr int deepest_node = 64;

[[noreturn]] void refuse(const std::string& where, const std::string& message) {
    throw InvalidInput("", where.empty() ? message : where + ": " + message);
}

/// What accessors read: numbers of one type in the buffer of the file.
enum class Component : int {
    byte = 5120,
    unsigned_byte = 5121,
    int16 = 5122,
    unsigned_int16 = 5123,
    unsigned_int32 = 5125,
    float32 = 5126
};

std::size_t bytes_of(Component type) {
    switch (type) {
        case Component::byte:
        case Component::unsigned_byte:
            return 1;
        case Component::int16:
        case Component::unsigned_int16:
            return 2;
        case Component::unsigned_int32:
        case Component::float32:
            return 4;
    }
    return 0;
}

/// The greatest number of an integer type, by which normalised values are divided.
double most_of(Component type) {
    switch (type) {
        case Component::byte:
            return 127.0;
        case Component::unsigned_byte:
            return 255.0;
        case Component::int16:
            return 32767.0;
        case Component::unsigned_int16:
            return 65535.0;
        case Component::unsigned_int32:
            return 4294967295.0;
        case Component::float32:
            break;
    }
    return 1.0;
}

template <class T>
T value_at(const std::uint8_t* at) {
    T value;
    std::memcpy(&value, at, sizeof(T));
    return value;
}

double number_at(const std::uint8_t* at, Component type) {
    switch (type) {
        case Component::byte:
            return value_at<std::int8_t>(at);
        case Component::unsigned_byte:
            return *at;
        case Component::int16:
            return value_at<std::int16_t>(at);
        case Component::unsigned_int16:
            return value_at<std::uint16_t>(at);
        case Component::unsigned_int32:
            return value_at<std::uint32_t>(at);
        case Component::float32:
            return static_cast<double>(value_at<float>(at));
    }
    return 0.0;
}

/// The elements of an accessor, checked to lie in the file.
struct Elements {
    const std::uint8_t* first = nullptr;
    std::size_t count = 0, stride = 0;
    Component type = Component::float32;
    double scale = 1.0;  ///< of normalised integers

    [[nodiscard]] double at(std::size_t element, std::size_t component) const {
        return scale * number_at(first + element * stride + component * bytes_of(type), type);
    }
};

class SceneReader {
  public:
    explicit SceneReader(std::span<const std::uint8_t> file) {
        const std::string_view json = json_chunk(file);
        if (json.size() > most_scene_json)
            refuse("", "the JSON chunk has " + std::to_string(json.size()) + " bytes; at most " +
                           std::to_string(most_scene_json) + " are read");
        std::vector<Problem> problems;
        document_ = parse(json, problems);
        if (!problems.empty()) refuse(problems.front().path, problems.front().message);
        if (!document_.is_object()) refuse("", "the JSON chunk is no object");
        const std::size_t end = 20 + json.size();
        if (file.size() >= end + 8) {
            const auto size = value_at<std::uint32_t>(file.data() + end);
            constexpr std::uint32_t name_of_binary = 0x004E4942;
            if (value_at<std::uint32_t>(file.data() + end + 4) != name_of_binary ||
                size > file.size() - end - 8)
                refuse("", "the second chunk is not the binary one, or is cut short");
            binary_ = file.subspan(end + 8, size);
        }
        refuse_extensions();
        read_materials();
    }

    Scene read() {
        const std::size_t shown = index_of(document_, "scene", "").value_or(0);
        const Value& nodes = item("scenes", shown, "");
        const std::string where = "/scenes/" + std::to_string(shown);
        if (const Value* const list = nodes.find("nodes"))
            for (const std::size_t node : indices_in(*list, where + "/nodes"))
                add_node(node, glm::dmat4(1.0), 0);
        if (scene_.triangles.empty()) refuse("", "the scene shows no triangle");
        check_extent();
        return std::move(scene_);
    }

  private:
    void refuse_extensions() const {
        const Value* const required = document_.find("extensionsRequired");
        if (required == nullptr) return;
        if (!required->is_array()) refuse("/extensionsRequired", "expected a list");
        constexpr std::array<std::string_view, 4> harmless = {
            "KHR_mesh_quantization", "KHR_texture_transform", "KHR_materials_unlit",
            "EXT_texture_webp"};
        for (const Value& name : required->items())
            if (!name.is_string() ||
                std::ranges::find(harmless, std::string_view(name.as_string())) == harmless.end())
                refuse("/extensionsRequired", shown(name) +
                                                  " is not read here; export the scene without "
                                                  "it, with geometry that is not compressed");
    }

    void read_materials() {
        scene_.materials.emplace_back();
        const Value* const list = document_.find("materials");
        if (list == nullptr) return;
        if (!list->is_array()) refuse("/materials", "expected a list");
        if (list->items().size() >= most_scene_materials)
            refuse("/materials", "the file has " + std::to_string(list->items().size()) +
                                     " materials; at most " +
                                     std::to_string(most_scene_materials - 1) + " are read");
        for (const Value& material : list->items()) {
            const Value* const name = material.find("name");
            scene_.materials.push_back(
                name != nullptr && name->is_string() ? printable(name->as_string()) : "");
        }
    }

    /// Returns a whole number that is a member, if there is one.
    static std::optional<std::size_t> index_of(const Value& value, const char* name,
                                               const std::string& where) {
        const Value* const member = value.find(name);
        if (member == nullptr) return std::nullopt;
        return whole(*member, where + '/' + name);
    }

    static std::size_t whole(const Value& value, const std::string& where) {
        if (value.is_number()) {
            const double number = value.as_number();
            if (number >= 0.0 && number <= 4294967295.0 && number == std::floor(number))
                return static_cast<std::size_t>(number);
        }
        refuse(where, "expected a whole number, got " + shown(value));
    }

    static std::vector<std::size_t> indices_in(const Value& list, const std::string& where) {
        if (!list.is_array()) refuse(where, "expected a list, got " + shown(list));
        std::vector<std::size_t> indices;
        for (std::size_t i = 0; i < list.items().size(); ++i)
            indices.push_back(whole(list.items()[i], where + '/' + std::to_string(i)));
        return indices;
    }

    /// Returns an item of a list of the document.
    [[nodiscard]] const Value& item(const char* list, std::size_t index,
                                    const std::string& where) const {
        const Value* const items = document_.find(list);
        if (items == nullptr || !items->is_array() || index >= items->items().size() ||
            !items->items()[index].is_object())
            refuse(where, std::string("there is no ") + list + '/' + std::to_string(index));
        return items->items()[index];
    }

    /// Returns numbers of a member, or nothing if there is none.
    template <std::size_t N>
    static std::optional<std::array<double, N>> numbers_of(const Value& value, const char* name,
                                                           const std::string& where) {
        const Value* const list = value.find(name);
        if (list == nullptr) return std::nullopt;
        std::array<double, N> numbers{};
        if (!list->is_array() || list->items().size() != N)
            refuse(where + '/' + name, "expected " + std::to_string(N) + " numbers");
        for (std::size_t i = 0; i < N; ++i) {
            if (!list->items()[i].is_number())
                refuse(where + '/' + name, "expected " + std::to_string(N) + " numbers");
            numbers[i] = list->items()[i].as_number();
        }
        return numbers;
    }

    static glm::dmat4 transform_of(const Value& node, const std::string& where) {
        if (const auto m = numbers_of<16>(node, "matrix", where)) {
            glm::dmat4 matrix(1.0);
            for (int column = 0; column < 4; ++column)
                for (int row = 0; row < 4; ++row)
                    matrix[column][row] = (*m)[static_cast<std::size_t>(4 * column + row)];
            return matrix;
        }
        const auto [tx, ty, tz] =
            numbers_of<3>(node, "translation", where).value_or(std::array{0.0, 0.0, 0.0});
        const auto [x, y, z, w] =
            numbers_of<4>(node, "rotation", where).value_or(std::array{0.0, 0.0, 0.0, 1.0});
        const auto [sx, sy, sz] =
            numbers_of<3>(node, "scale", where).value_or(std::array{1.0, 1.0, 1.0});
        glm::dmat4 matrix(1.0);
        matrix[0] = sx * glm::dvec4(1.0 - 2.0 * (y * y + z * z), 2.0 * (x * y + z * w),
                                    2.0 * (x * z - y * w), 0.0);
        matrix[1] = sy * glm::dvec4(2.0 * (x * y - z * w), 1.0 - 2.0 * (x * x + z * z),
                                    2.0 * (y * z + x * w), 0.0);
        matrix[2] = sz * glm::dvec4(2.0 * (x * z + y * w), 2.0 * (y * z - x * w),
                                    1.0 - 2.0 * (x * x + y * y), 0.0);
        matrix[3] = glm::dvec4(tx, ty, tz, 1.0);
        return matrix;
    }

    void add_node(std::size_t index, const glm::dmat4& parent, int depth) {
        const std::string where = "/nodes/" + std::to_string(index);
        const Value& node = item("nodes", index, where);
        if (depth > deepest_node)
            refuse(where, "nodes are more than " + std::to_string(deepest_node) +
                              " deep, or contain each other");
        // A tree has each node once, so there are no more of them than in the file.
        if (seen_.size() <= index) seen_.resize(index + 1);
        if (seen_[index]) refuse(where, "is the child of two nodes");
        seen_[index] = true;
        if (node.find("skin") != nullptr)
            refuse(where, "has a skin, whose pose depends on a moment; export the pose as a mesh");
        const glm::dmat4 matrix = parent * transform_of(node, where);
        if (const auto mesh = index_of(node, "mesh", where)) add_mesh(*mesh, matrix);
        if (const Value* const children = node.find("children"))
            for (const std::size_t child : indices_in(*children, where + "/children"))
                add_node(child, matrix, depth + 1);
    }

    void add_mesh(std::size_t index, const glm::dmat4& matrix) {
        const std::string where = "/meshes/" + std::to_string(index);
        const Value* const primitives = item("meshes", index, where).find("primitives");
        if (primitives == nullptr || !primitives->is_array()) refuse(where, "has no primitives");
        for (std::size_t i = 0; i < primitives->items().size(); ++i)
            add_primitive(primitives->items()[i], matrix,
                          where + "/primitives/" + std::to_string(i));
    }

    void add_primitive(const Value& primitive, const glm::dmat4& matrix, const std::string& where) {
        constexpr std::size_t triangles = 4, fan = 6;
        const std::size_t mode = index_of(primitive, "mode", where).value_or(triangles);
        if (mode < triangles) return;
        if (mode > fan) refuse(where, "mode " + std::to_string(mode) + " is none of glTF");
        const Value* const attributes = primitive.find("attributes");
        const auto position =
            attributes != nullptr ? index_of(*attributes, "POSITION", where) : std::nullopt;
        if (!position) refuse(where, "has no positions, or compressed ones");
        const auto material = index_of(primitive, "material", where);
        if (material && *material + 1 >= scene_.materials.size())
            refuse(where, "there is no materials/" + std::to_string(*material));

        const Elements places = elements(*position, "VEC3");
        const std::size_t first = scene_.positions.size();
        if (first + places.count > 3 * most_scene_triangles) refuse_size();
        for (std::size_t i = 0; i < places.count; ++i) {
            const glm::dvec3 at(matrix *
                                glm::dvec4(places.at(i, 0), places.at(i, 1), places.at(i, 2), 1.0));
            for (int axis = 0; axis < 3; ++axis)
                if (!(std::abs(at[axis]) <= 1e6))
                    refuse(where, "vertex " + std::to_string(i) + " lies at " +
                                      number_text(at[axis]) + " m, which is no place of a scene");
            scene_.positions.emplace_back(at);
        }
        const auto listed = index_of(primitive, "indices", where);
        const Elements indices = listed ? elements(*listed, "SCALAR") : Elements{};
        if (listed && indices.type != Component::unsigned_byte &&
            indices.type != Component::unsigned_int16 && indices.type != Component::unsigned_int32)
            refuse(where, "its indices are not whole numbers");
        const std::size_t count = listed ? indices.count : places.count;
        // Those without an area count too: reading them takes as long.
        corners_ += count;
        if (corners_ > 6 * most_scene_triangles) refuse_size();
        const auto corner = [&](std::size_t i) {
            const auto vertex = listed ? static_cast<std::size_t>(indices.at(i, 0)) : i;
            if (vertex >= places.count)
                refuse(where, "index " + std::to_string(vertex) + " is none of its " +
                                  std::to_string(places.count) + " vertices");
            return static_cast<std::uint32_t>(first + vertex);
        };
        const bool turns_inside_out = glm::determinant(glm::dmat3(matrix)) < 0.0;
        const auto number = static_cast<std::uint16_t>(material ? *material + 1 : 0);
        const auto add = [&](std::size_t a, std::size_t b, std::size_t c) {
            std::array<std::uint32_t, 3> corners = {corner(a), corner(b), corner(c)};
            if (turns_inside_out) std::swap(corners[1], corners[2]);
            const glm::dvec3 p(scene_.positions[corners[0]]), q(scene_.positions[corners[1]]),
                r(scene_.positions[corners[2]]);
            const glm::dvec3 across = glm::cross(q - p, r - p);
            if (glm::dot(across, across) <= 0.0) return;
            if (scene_.triangles.size() >= most_scene_triangles) refuse_size();
            scene_.triangles.push_back({corners, number});
        };
        if (mode == triangles)
            for (std::size_t i = 0; i + 2 < count; i += 3) add(i, i + 1, i + 2);
        else
            for (std::size_t i = 0; i + 2 < count; ++i) {
                if (mode == fan)
                    add(0, i + 1, i + 2);
                else
                    add(i, i + 1 + i % 2, i + 2 - i % 2);
            }
    }

    [[nodiscard]] Elements elements(std::size_t index, std::string_view shape) const {
        const std::string where = "/accessors/" + std::to_string(index);
        const Value& accessor = item("accessors", index, where);
        if (accessor.find("sparse") != nullptr)
            refuse(where, "is sparse, which is not read here; export whole accessors");
        const Value* const type = accessor.find("type");
        if (type == nullptr || !type->is_string() || type->as_string() != shape)
            refuse(where, "is no " + std::string(shape));
        Elements out;
        out.count = index_of(accessor, "count", where).value_or(0);
        out.type = static_cast<Component>(index_of(accessor, "componentType", where).value_or(0));
        const std::size_t size = bytes_of(out.type);
        if (size == 0) refuse(where, "has a componentType that is none of glTF");
        const Value* const normalised = accessor.find("normalized");
        if (normalised != nullptr && normalised->is_bool() && normalised->as_bool())
            out.scale = 1.0 / most_of(out.type);

        const auto view_index = index_of(accessor, "bufferView", where);
        if (!view_index) refuse(where, "has no bufferView, as compressed geometry has not");
        const std::string view_where = "/bufferViews/" + std::to_string(*view_index);
        const Value& view = item("bufferViews", *view_index, view_where);
        const std::size_t buffer = index_of(view, "buffer", view_where).value_or(0);
        const Value& of_buffer = item("buffers", buffer, view_where);
        if (buffer != 0 || of_buffer.find("uri") != nullptr)
            refuse("/buffers/" + std::to_string(buffer),
                   "is not in this file; export one GLB with all that belongs to it");
        const std::size_t width = size * (shape == "VEC3" ? 3 : 1);
        const std::size_t start = index_of(view, "byteOffset", view_where).value_or(0),
                          length = index_of(view, "byteLength", view_where).value_or(0),
                          within = index_of(accessor, "byteOffset", where).value_or(0);
        out.stride = index_of(view, "byteStride", view_where).value_or(width);
        if (start > binary_.size() || length > binary_.size() - start)
            refuse(view_where, "reaches beyond the end of the file");
        // All of these are below 2^32, so that products and sums fit.
        if (out.count > 0 && (out.stride < width || within > length ||
                              (out.count - 1) * out.stride + width > length - within))
            refuse(where, "reaches beyond the end of its bufferView");
        out.first = binary_.data() + start + within;
        return out;
    }

    [[noreturn]] static void refuse_size() {
        refuse("", "the scene has more than " + std::to_string(most_scene_triangles) +
                       " triangles, or more vertices than these need; export a simpler one");
    }

    void check_extent() const {
        glm::dvec3 low(std::numeric_limits<double>::max()), high(-low);
        for (const SceneTriangle& triangle : scene_.triangles)
            for (const std::uint32_t corner : triangle.corners) {
                const glm::dvec3 at(scene_.positions[corner]);
                low = glm::min(low, at);
                high = glm::max(high, at);
            }
        const glm::dvec3 size = high - low;
        const double longest = std::max({size.x, size.y, size.z});
        if (longest > most_scene_extent)
            refuse("", "the scene is " + number_text(std::round(10.0 * longest) / 10.0) +
                           " m long; at most " + number_text(most_scene_extent) +
                           " are allowed, so are its units metres?");
    }

    Value document_;
    std::span<const std::uint8_t> binary_;
    std::vector<bool> seen_;
    std::size_t corners_ = 0;  ///< that were read so far
    Scene scene_;
};

}  // namespace

Scene scene_in_glb(std::span<const std::uint8_t> file) { return SceneReader(file).read(); }

}  // namespace sporeprint
