// Scenes as they are stored: a file of their triangles and materials, and the id that follows from it.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "core/bytes.h"
#include "core/scene/scene.h"

namespace sporeprint {

/// Returns true if a text has the form of an id of a scene: "s-" and 32 hexadecimal digits.
[[nodiscard]] constexpr bool is_scene_id(std::string_view text) {
    return text.size() == 34 && text.starts_with("s-") &&
           text.find_first_not_of("0123456789abcdef", 2) == std::string_view::npos;
}

/// Returns a scene as bytes, which scene_in() reads. Equal scenes have equal bytes.
[[nodiscard]] Bytes file_of(const Scene& scene);

/// Returns the scene that file_of() has written; nothing for other bytes.
[[nodiscard]] std::optional<Scene> scene_in(std::span<const std::uint8_t> file);

/// Returns the id of a scene: "s-" and the first 32 digits of the SHA-256 of file_of() it.
[[nodiscard]] std::string id_of(const Scene& scene);

}  // namespace sporeprint
