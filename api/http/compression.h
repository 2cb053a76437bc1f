// GLB files as gzip: which of them are worth it, what it costs, and the variant itself.
#pragma once

#include <cstdint>
#include <stop_token>

#include "api/http/message.h"

namespace sporeprint::api {

inline constexpr const char* glb_type = "model/gltf-binary";

/// Whether a GLB has a gzip variant: it has at least 1 MiB, and images, which are compressed already, are less than a sixth of it.
/// Depends on nothing but the file, so every server says the same of one URL.
[[nodiscard]] bool is_worth_gzip(const Body& glb);

/// What compressing so many bytes costs.
[[nodiscard]] Cost gzip_cost(std::uint64_t bytes);

/// The same for a GLB that is not made yet, by its estimate; nothing where it will not be worth it.
[[nodiscard]] Cost gzip_cost_of_glb(const Cost& estimate);

/// The gzip variant of a GLB: equal input, equal bytes.
///
/// stop      looked at after each 512 kB
/// parallel  blocks are compressed by themselves, on idle threads too; the bytes do not depend on how many
/// throws    Cancelled
[[nodiscard]] Body gzip_glb(const Body& glb, const std::stop_token& stop, const Parallel& parallel);

/// The key that the gzip variant is kept under.
[[nodiscard]] Key gzip_key(const Key& key);

/// Makes the gzip variant that an answer holds beside its body the answer's body.
void select_gzip(Response& response);

}  // namespace sporeprint::api
