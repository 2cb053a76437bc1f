// Small text files written by the operator: options, keys, lists.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace sporeprint::server {

/// Returns the content of a file; nothing if it cannot be read.
[[nodiscard]] std::optional<std::string> read_text(const std::filesystem::path& file);

/// One line of a text.
struct TextLine {
    std::size_t number = 0;  ///< from 1
    std::string_view text;   ///< without surrounding white space
};

/// Returns the lines of a text except empty ones and comments, which begin with '#'.
///
/// returns  views into the text
[[nodiscard]] std::vector<TextLine> lines_of(std::string_view text);

}  // namespace sporeprint::server
