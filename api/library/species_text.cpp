#include "api/library/species_text.h"

#include <utf8proc.h>

#include <algorithm>
#include <cstdlib>
#include <map>
#include <memory>
#include <utility>

#include "api/library/tokens.h"
#include "core/params/describe.h"
#include "core/params/messages.h"
#include "core/params/reader.h"

namespace sporeprint::api {

namespace {

/// Appends all uploads that are not empty.
template <class T>
void collect_uploads(const T& value, std::vector<const Upload*>& uploads) {
    if constexpr (std::is_same_v<T, Upload>) {
        if (!value.empty()) uploads.push_back(&value);
    } else if constexpr (Described<T>) {
        T::fields([&](auto member, const Info&) { collect_uploads(value.*member, uploads); });
    } else if constexpr (is_variant<T>) {
        std::visit([&](const auto& one) { collect_uploads(one, uploads); }, value);
    } else if constexpr (is_optional<T>) {
        if (value) collect_uploads(*value, uploads);
    } else if constexpr (is_list<T>) {
        for (const auto& item : value) collect_uploads(item, uploads);
    }
}

/// Calls visit(pointer, value) for a value and all that it contains.
template <class Visit>
void each_value(Value& value, const std::string& pointer, Visit visit) {
    visit(pointer, value);
    if (value.is_object()) {
        for (auto& [key, member] : value.members())
            each_value(member, pointer + '/' + pointer_token(key), visit);
    } else if (value.is_array()) {
        for (std::size_t i = 0; i < value.items().size(); ++i)
            each_value(value.items()[i], pointer + '/' + std::to_string(i), visit);
    }
}

const char* media_of(const std::vector<std::uint8_t>& bytes) {
    if (bytes.size() > 2 && bytes[0] == 0xFF && bytes[1] == 0xD8) return "image/jpeg";
    if (bytes.size() > 4 && bytes[0] == 0x89 && bytes[1] == 'P') return "image/png";
    return "image/webp";
}

/// Returns true for control characters, and those that change the direction of a text.
bool is_deceptive(char32_t c) {
    return c < 0x20 || (c >= 0x7F && c < 0xA0) || c == 0x200E || c == 0x200F || c == 0x061C ||
           (c >= 0x202A && c <= 0x202E) || (c >= 0x2066 && c <= 0x2069) || c == 0xFEFF;
}

/// Returns the first deceptive character of a UTF-8 text; 0 if there is none. Texts that were parsed are valid.
char32_t deceptive_in(std::string_view text) {
    for (std::size_t i = 0; i < text.size();) {
        const auto first = static_cast<std::uint8_t>(text[i]);
        const std::size_t length = first < 0x80 ? 1 : first < 0xE0 ? 2 : first < 0xF0 ? 3 : 4;
        char32_t c = length == 1 ? first : first & (0x7FU >> length);
        for (std::size_t k = 1; k < length && i + k < text.size(); ++k)
            c = c << 6U | (static_cast<std::uint8_t>(text[i + k]) & 0x3FU);
        if (is_deceptive(c)) return c;
        i += length;
    }
    return 0;
}

void add_differences(const Value& a, const Value& b, const std::string& pointer, std::size_t most,
                     std::vector<std::string>& found) {
    if (found.size() >= most || a == b) return;
    if (a.is_object() && b.is_object()) {
        for (const auto& [key, value] : a.members()) {
            const Value* const other = b.find(key);
            add_differences(value, other ? *other : Value(), pointer + '/' + pointer_token(key),
                            most, found);
        }
        for (const auto& [key, value] : b.members())
            if (!a.find(key))
                add_differences(Value(), value, pointer + '/' + pointer_token(key), most, found);
        return;
    }
    if (a.is_array() && b.is_array() && a.items().size() == b.items().size()) {
        for (std::size_t i = 0; i < a.items().size(); ++i)
            add_differences(a.items()[i], b.items()[i], pointer + '/' + std::to_string(i), most,
                            found);
        return;
    }
    found.push_back(pointer);
}

}  // namespace

Content content_of(const Species& species) {
    Content content;
    content.format = species_format;
    content.kind = name(species.facts.form);
    content.title = species.facts.common_name.string();
    std::vector<const Upload*> uploads;
    collect_uploads(species, uploads);
    Value json = write(species);
    // An image is a text of thousands of characters; no other text is equal to one of them.
    std::vector<std::pair<std::string, const Upload*>> images;
    images.reserve(uploads.size());
    for (const Upload* const upload : uploads)
        images.emplace_back(base64_text(upload->bytes), upload);
    each_value(json, "", [&](const std::string& pointer, Value& value) {
        if (images.empty() || !value.is_string()) return;
        const auto image = std::find_if(images.begin(), images.end(), [&](const auto& one) {
            return one.first == value.as_string();
        });
        if (image == images.end()) return;
        const Upload& upload = *image->second;
        content.blobs.push_back({pointer, media_of(upload.bytes),
                                 read_hex(upload.sha256.view()).value(), upload.bytes});
        value = Value::object().set("sha256", upload.sha256.view());
    });
    std::sort(content.blobs.begin(), content.blobs.end(),
              [](const Blob& a, const Blob& b) { return a.place < b.place; });
    content.text = dump(json);
    content.hash = sha256_of(content.text);
    return content;
}

Value json_of(const Content& content) {
    std::vector<Problem> problems;
    Value json = parse(content.text, problems);
    if (!problems.empty()) throw GenerationError("a stored species is no JSON");
    if (content.blobs.empty()) return json;
    std::map<std::string_view, const Blob*> blobs;
    for (const Blob& blob : content.blobs) blobs.emplace(blob.place, &blob);
    each_value(json, "", [&](const std::string& pointer, Value& value) {
        const auto found = blobs.find(pointer);
        if (found != blobs.end()) value = base64_text(found->second->bytes);
    });
    return json;
}

Species species_of(const Content& content) {
    if (content.format < 1 || content.format > species_format)
        throw GenerationError("a stored species has format " + std::to_string(content.format) +
                              "; this server knows up to " + std::to_string(species_format));
    std::vector<Problem> problems;
    Species species = read_json<Species>(dump(json_of(content)), problems);
    if (!problems.empty())
        throw GenerationError("a stored species cannot be read: " + problems.front().path + ": " +
                              problems.front().message);
    return species;
}

void refuse_deceptive_texts(const Value& species, const std::string& path,
                            std::vector<Problem>& problems) {
    Value copy = species;
    each_value(copy, path, [&](const std::string& pointer, const Value& value) {
        if (!value.is_string()) return;
        if (const char32_t c = deceptive_in(value.as_string()); c != 0)
            report(
                problems, pointer, "has the character U+" + [c] {
                    constexpr std::string_view digits = "0123456789ABCDEF";
                    std::string hex;
                    for (int shift = 12; shift >= 0; shift -= 4)
                        hex += digits[(c >> static_cast<unsigned>(shift)) & 15U];
                    return hex;
                }() + "; allowed are texts without control characters and marks of direction");
    });
}

std::string composed(std::string_view text) {
    if (std::all_of(text.begin(), text.end(), [](char c) { return (c & 0x80) == 0; }))
        return std::string(text);
    utf8proc_uint8_t* out = nullptr;
    const utf8proc_ssize_t size =
        utf8proc_map(reinterpret_cast<const utf8proc_uint8_t*>(text.data()),
                     static_cast<utf8proc_ssize_t>(text.size()), &out,
                     static_cast<utf8proc_option_t>(UTF8PROC_STABLE | UTF8PROC_COMPOSE));
    const std::unique_ptr<utf8proc_uint8_t, decltype(&std::free)> owned(out, std::free);
    if (size < 0) throw GenerationError(utf8proc_errmsg(size));
    return {reinterpret_cast<const char*>(out), static_cast<std::size_t>(size)};
}

void compose_texts(Value& species) {
    each_value(species, "", [](const std::string&, Value& value) {
        if (value.is_string()) value = composed(value.as_string());
    });
}

std::vector<std::string> differences(const Value& a, const Value& b, std::size_t most) {
    std::vector<std::string> found;
    add_differences(a, b, "", most, found);
    return found;
}

}  // namespace sporeprint::api
