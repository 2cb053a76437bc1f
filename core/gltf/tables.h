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
constexpr const char* meshopt_compression = "EXT_meshopt_compression";

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

/// The tables of buffer views and accessors, as JSON. Every accessor has a view of its own, and the
/// views of accessors precede all others, so that an accessor and its view have the same index.
struct Tables {
    std::string views, accessors;
    std::size_t count = 0, binary = 0;  ///< number of views; bytes of the BIN chunk so far, padded
    std::size_t decompressed = 0;       ///< bytes of all compressed views when decompressed

    std::size_t view(std::size_t length, int target = 0);

    /// Adds an accessor. `more` holds further members of its JSON object, with a leading comma.
    std::size_t accessor(std::size_t items, int component, const char* type, std::size_t length,
                         int target = 0, const std::string& more = {});

    /// Adds an accessor of vertices whose items have a stride, with a view of its own, and appends
    /// its bytes to `out`.
    ///
    /// filter  of the compressed items; null for none
    std::size_t stream(std::span<const std::uint8_t> data, std::size_t items, int component,
                       const char* type, const std::string& more, bool compressed, Bytes& out,
                       const char* filter = nullptr);

    /// Adds an accessor of transforms of instances, which are no vertices, as floats; compressed
    /// ones are prepared by filtered_vectors().
    std::size_t transforms(std::span<const std::uint8_t> data, std::size_t items, const char* type,
                           bool compressed, Bytes& out);

    /// Adds an accessor of compressed triangles, and appends their bytes to `out`.
    std::size_t compressed_triangles(std::span<const std::uint32_t> indices, std::size_t vertices,
                                     int component, Bytes& out);

    std::size_t vectors(std::span<const glm::vec3> values, const std::string& more = {});

    /// Adds vectors with their bounds, which the specification requires for positions.
    std::size_t positions(std::span<const glm::vec3> values);

  private:
    void append_accessor(std::size_t items, int component, const char* type,
                         const std::string& more);

    /// Begins a view. A compressed one lies in the second buffer, which no file contains.
    void append_view(std::size_t length, bool compressed, const std::string& stride, int target);

    std::size_t close_stream(std::span<const std::uint8_t> data, std::size_t items, bool compressed,
                             Bytes& out, const char* filter);

    std::size_t close_view(std::span<const std::uint8_t> data, Bytes& out);

    /// Closes the view of encoded bytes at the end of `out`, and pads them.
    ///
    /// length  of the encoded bytes
    std::size_t close_compressed_view(std::size_t length, std::size_t items, std::size_t stride,
                                      const char* mode, Bytes& out, const char* filter = nullptr);
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
