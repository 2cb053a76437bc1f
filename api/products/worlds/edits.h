// Ecologies, founders and masks of a world as a body names them.
#pragma once

#include "api/http/errors.h"
#include "api/products/worlds/worlds.h"
#include "core/params/value.h"
#include "core/world/world_edits.h"

namespace sporeprint::api {

/// Largest sum of the bytes of the PNG files of all masks of a body, and of their pixels.
inline constexpr std::size_t most_mask_bytes = 4u << 20, most_mask_pixels = 4u << 20;

/// Largest number of founders in a body.
inline constexpr std::size_t most_founders = 256;

/// Removes `ecology`, `founders` and `masks` from a body and reads them. Errors name their places in it: 400 for the
/// form and values out of range, 422 for what does not fit the world or is no image of a mask.
///
/// returns  null if they change nothing
[[nodiscard]] SharedEdits take_edits(Value& body, const WorldParams& world, const Atlas& atlas,
                                     ValidationErrors& errors);

/// Returns the schemas of these members.
[[nodiscard]] Value::Object edit_members();

}  // namespace sporeprint::api
