// Reads a GLB that somebody sends back, and gives the request that made it.
#pragma once

#include <cstdint>
#include <span>
#include <stop_token>
#include <string>
#include <string_view>

namespace sporeprint {

/// Longest JSON chunk that is read. The largest of our own, of colonies of 256 nodes, have 65 kB;
/// reading a hostile one of this length takes some ten milliseconds and some ten megabytes.
inline constexpr std::size_t most_inspected_json = 1u << 20;

/// Longest text of effective parameters that is given back. The largest of our own have 5 kB.
inline constexpr std::size_t most_effective_json = 64u << 10;

struct Inspection {
    std::string generator;       ///< asset.generator, printable, at most 120 bytes; empty for none
    std::string canonical;       ///< canonical address in asset.extras
    std::string effective_json;  ///< the effective parameters in asset.extras, as JSON
    std::uint64_t vertices = 0, triangles = 0, meshes = 0, materials = 0, images = 0, bytes = 0;
    std::uint64_t morph_targets = 0, animations = 0;
};

/// The JSON chunk of a GLB, by its headers alone, whatever its length.
///
/// throws  InvalidInput (path "") when it is no GLB or is cut short
[[nodiscard]] std::string_view json_chunk(std::span<const std::uint8_t> file);

/// Reads the JSON chunk of a file; buffers and images are not looked at, `bytes` stays 0.
///
/// stop    looked at before and after the chunk is read
/// throws  InvalidInput (path "") when it is longer than most_inspected_json, is no glTF, or
///         carries no request of Sporeprint; Cancelled
/// cost    O(size of the chunk): some ten microseconds a kilobyte; each value takes 40 bytes while
///         it is read
[[nodiscard]] Inspection inspect_json(std::string_view json, const std::stop_token& stop = {});

/// Both for a whole file.
[[nodiscard]] Inspection inspect_glb(std::span<const std::uint8_t> file);

}  // namespace sporeprint
