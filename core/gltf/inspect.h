// Reader of uploaded GLB files: returns the request that produced a file.
#pragma once

#include <cstdint>
#include <span>
#include <stop_token>
#include <string>
#include <string_view>

namespace sporeprint {

/// The largest JSON chunk that is read. The largest of our own, of colonies of 256 nodes, have 65
/// kB; reading a hostile one of this length takes about ten milliseconds and ten megabytes.
inline constexpr std::size_t most_inspected_json = 1u << 20;

/// The largest text of effective parameters that is returned. The largest of our own have 5 kB.
inline constexpr std::size_t most_effective_json = 64u << 10;

struct Inspection {
    std::string generator;       ///< asset.generator, printable, at most 120 bytes; empty for none
    std::string canonical;       ///< canonical URL in asset.extras
    std::string effective_json;  ///< the effective parameters in asset.extras, as JSON
    std::uint64_t vertices = 0, triangles = 0, meshes = 0, materials = 0, images = 0, bytes = 0;
    std::uint64_t morph_targets = 0, animations = 0;
};

/// Returns a view of the JSON chunk of a GLB, whatever its length; only the 20 bytes of the two
/// headers are read.
///
/// throws  InvalidInput (path "") if it is no GLB of version 2 or is truncated
[[nodiscard]] std::string_view json_chunk(std::span<const std::uint8_t> file);

/// Reads the JSON chunk of a file; buffers and images are not read, `bytes` stays 0.
///
/// stop    tested before and after the chunk is read
/// throws  InvalidInput (path "") if it is longer than most_inspected_json, is no glTF, contains no
///         request of Sporeprint or one longer than most_effective_json, or mesh_counts() throws;
///         Cancelled
/// cost    O(size of the chunk): about ten microseconds per kilobyte; each value takes 40 bytes
///         while it is read
[[nodiscard]] Inspection inspect_json(std::string_view json, const std::stop_token& stop = {});

/// Returns inspect_json() of the JSON chunk of a GLB, with `bytes` set to the size of the file.
///
/// throws  InvalidInput as json_chunk() and inspect_json()
[[nodiscard]] Inspection inspect_glb(std::span<const std::uint8_t> file);

}  // namespace sporeprint
