// Text of the JSON chunk: numbers, strings and lists.
#pragma once

#include <cstddef>
#include <glm/vec3.hpp>
#include <string>

namespace sporeprint::gltf {

/// Appends a number in its shortest form; -0 is written as 0.
void append(std::string& out, float value);
void append(std::string& out, std::size_t value);

/// Appends a string in quotes, with escapes.
void append_quoted(std::string& out, const std::string& text);

/// Appends a vector of three components as a JSON array.
void append_triple(std::string& out, const glm::vec3& corner);

/// Returns the separator before the next item of a list of JSON objects.
[[nodiscard]] const char* separator(const std::string& list);

}  // namespace sporeprint::gltf
