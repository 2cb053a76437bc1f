// Buffer views and accessors of a file, and the bytes to which they refer.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <glm/vec3.hpp>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "core/bytes.h"

namespace sporeprint::gltf {

constexpr int float_component = 5126, u8_component = 5121, u16_component = 5123,
              u32_component = 5125, i16_component = 5122, i8_component = 5120;
constexpr int vertex_target = 34962, index_target = 34963;
constexpr const char* normalized = ",\"normalized\":true";
constexpr const char *meshopt_compression = "EXT_meshopt_compression",
                     *attributes_mode = "ATTRIBUTES", *triangles_mode = "TRIANGLES";

/// Returns a size rounded up to a multiple of four, to which views are padded.
constexpr std::size_t padded(std::size_t size) { return (size + 3) & ~std::size_t{3}; }

/// Returns the bytes of a vector of items without padding between their members.
template <class T>
std::span<const std::uint8_t> bytes_of(const std::vector<T>& items) {
    return {reinterpret_cast<const std::uint8_t*>(items.data()), items.size() * sizeof(T)};
}

/// Writes the bytes of a value and advances.
template <class T>
void put(std::uint8_t*& at, const T& value) {
    std::memcpy(at, &value, sizeof value);
    at += sizeof value;
}

/// The items that an accessor reads, with a view of their own.
struct Stream {
    const char* attribute = nullptr;  ///< of a primitive or a target; null for what is none
    std::size_t items = 0;
    std::size_t stride = 0;  ///< bytes from one item to the next, before they are encoded
    int component = float_component;
    const char* type = nullptr;
    std::string more = {};              ///< members of the accessor, with a leading comma
    int target = 0;                     ///< of the view: vertex_target, index_target or 0
    const char* mode = nullptr;         ///< of EXT_meshopt_compression; null for bytes as they are
    const char* filter = nullptr;       ///< of encoded items; null for none
    Bytes data = {};                    ///< all items, one after another, until they are encoded
    std::shared_ptr<Bytes> bytes = {};  ///< as they lie in the file, padded
    std::size_t length = 0;             ///< of the bytes without their padding

    /// Sets the items of vertices or instances.
    template <class Item>
    void set_items(const std::vector<Item>& list) {
        items = list.size();
        stride = sizeof(Item);
        const auto* const first = reinterpret_cast<const std::uint8_t*>(list.data());
        data.assign(first, first + items * stride);
    }

    /// Turns the data into the bytes, encoded as the mode says.
    ///
    /// order  of the items in the file, as indices of those in the data; empty for all as they are
    void encode(std::span<const std::uint32_t> order = {});

    /// Sets the bytes of triangles, whose indices have 2 or 4 bytes, as the stride says.
    void encode_triangles(std::span<const std::uint32_t> indices, std::size_t vertices);

  private:
    void set_bytes(Bytes encoded);
};

/// The tables of buffer views and accessors, as JSON. Every accessor has a view of its own, and the
/// views of accessors precede all others, so that an accessor and its view have the same index.
struct Tables {
    std::string views, accessors;
    std::size_t count = 0, binary = 0;  ///< number of views; bytes of the BIN chunk so far, padded
    std::size_t decompressed = 0;       ///< bytes of all compressed views when decompressed
    std::size_t buffer = 0;             ///< that views are of: 0 for the BIN chunk

    std::size_t view(std::size_t length, int target = 0);

    /// Adds an accessor. `more` holds further members of its JSON object, with a leading comma.
    std::size_t accessor(std::size_t items, int component, const char* type, std::size_t length,
                         int target = 0, const std::string& more = {});

    /// Adds the accessor and the view of a stream, whose bytes are the next of the BIN chunk.
    std::size_t stream(const Stream& stream);

    std::size_t vectors(std::span<const glm::vec3> values, const std::string& more = {});

    /// Adds vectors with their bounds, which the specification requires for positions.
    std::size_t positions(std::span<const glm::vec3> values);

  private:
    void append_accessor(std::size_t items, int component, const char* type,
                         const std::string& more);
};

/// A part of the BIN chunk.
struct Chunk {
    explicit Chunk(std::size_t size) : bytes(std::make_shared<Bytes>(size)), at(bytes->data()) {}

    template <class T>
    void append(std::span<const T> values) {
        if (values.empty()) return;
        std::memcpy(at, values.data(), values.size_bytes());
        at += values.size_bytes();
    }

    std::shared_ptr<Bytes> bytes;
    std::uint8_t* at;
};

}  // namespace sporeprint::gltf
