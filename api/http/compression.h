// GLB files as gzip: which files have a gzip variant, what compressing costs, and the variant.
#pragma once

#include <cstdint>
#include <stop_token>

#include "api/http/message.h"

namespace sporeprint::api {

inline constexpr const char* glb_type = "model/gltf-binary";

/// Returns true if a GLB has a gzip variant: it has at least 1 MiB, and images, which are
/// compressed already, are less than a sixth of it. The result depends on the file alone, so all
/// servers agree for one URL.
[[nodiscard]] bool is_worth_gzip(const Body& glb);

/// Returns the cost of compressing this number of bytes.
[[nodiscard]] Cost gzip_cost(std::uint64_t bytes);

/// Returns the same cost for a GLB that is not generated yet, from its estimate; zero if it will
/// have no gzip variant.
[[nodiscard]] Cost gzip_cost_of_glb(const Cost& estimate);

/// Returns the gzip variant of a GLB; equal input gives equal bytes.
///
/// stop      checked after each 512 kB
/// parallel  runs the compression of each block, also on idle threads; the bytes do not depend on
///           their number
/// throws    Cancelled
[[nodiscard]] Body gzip_glb(const Body& glb, const std::stop_token& stop, const Parallel& parallel);

/// Returns the cache key of the gzip variant.
[[nodiscard]] Key gzip_key(const Key& key);

/// Replaces the body of a response by the gzip variant that it holds beside it.
void select_gzip(Response& response);

}  // namespace sporeprint::api
