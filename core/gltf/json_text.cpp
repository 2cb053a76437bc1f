#include "core/gltf/json_text.h"

#include <charconv>

namespace sporeprint::gltf {

void append(std::string& out, float value) {
    char text[32];
    out.append(text, std::to_chars(text, text + sizeof text, value + 0.0F).ptr);  // -0 + 0 is 0
}

void append(std::string& out, std::size_t value) { out += std::to_string(value); }

void append_quoted(std::string& out, const std::string& text) {
    constexpr char hex[] = "0123456789abcdef";
    out += '"';
    for (const char c : text) {
        if (c == '"' || c == '\\')
            (out += '\\') += c;
        else if (static_cast<unsigned char>(c) < 0x20)
            ((out += "\\u00") += hex[c >> 4]) += hex[c & 15];
        else
            out += c;
    }
    out += '"';
}

void append_triple(std::string& out, const glm::vec3& corner) {
    append(out += '[', corner.x);
    append(out += ',', corner.y);
    append(out += ',', corner.z);
    out += ']';
}

const char* separator(const std::string& list) { return list.empty() ? "" : ","; }

}  // namespace sporeprint::gltf
