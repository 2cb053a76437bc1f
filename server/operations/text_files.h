// Small files that people write for the server: options, keys, lists.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace sporeprint::server {

/// The bytes of a file; nothing when it cannot be read.
[[nodiscard]] std::optional<std::string> read_text(const std::filesystem::path& file);

struct TextLine {
    std::size_t number = 0;  ///< from 1
    std::string_view text;   ///< without blanks around it
};

/// The lines of a text that say something: empty ones and those that begin with '#' are passed over. They point into the text.
[[nodiscard]] std::vector<TextLine> lines_of(std::string_view text);

}  // namespace sporeprint::server
