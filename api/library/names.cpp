#include "api/library/names.h"

#include <algorithm>
#include <charconv>

#include "api/library/records.h"
#include "core/params/messages.h"

namespace sporeprint::api {

namespace {

bool is_name(std::string_view text, std::size_t longest) {
    const auto is_letter = [](char c) { return c >= 'a' && c <= 'z'; };
    return !text.empty() && text.size() <= longest && is_letter(text.front()) &&
           std::all_of(text.begin(), text.end(),
                       [&](char c) { return is_letter(c) || (c >= '0' && c <= '9') || c == '_'; });
}

}  // namespace

bool is_owner_name(std::string_view text) { return is_name(text, longest_owner); }

bool is_species_name(std::string_view text) { return is_name(text, longest_name); }

std::optional<LibraryName> read_library_name(std::string_view text) {
    if (!is_of_library(text)) return std::nullopt;
    text.remove_prefix(1);
    const std::size_t point = text.find('.');
    if (point == std::string_view::npos) return std::nullopt;
    const std::size_t at = text.find('@', point);
    LibraryName name;
    name.owner = text.substr(0, point);
    name.name = text.substr(point + 1, at == std::string_view::npos ? at : at - point - 1);
    if (!is_owner_name(name.owner) || !is_species_name(name.name)) return std::nullopt;
    if (at == std::string_view::npos) return name;
    const std::string_view digits = text.substr(at + 1);
    name.is_draft = digits == "draft";
    if (name.is_draft) return name;
    const auto [end, error] =
        std::from_chars(digits.data(), digits.data() + digits.size(), name.number);
    if (error != std::errc() || end != digits.data() + digits.size() || digits.front() == '0' ||
        name.number < 1 || name.number > most_versions)
        return std::nullopt;
    return name;
}

std::string text_of(const LibraryName& name) {
    std::string text = '~' + name.owner + '.' + name.name;
    if (name.number > 0) (text += '@') += std::to_string(name.number);
    if (name.is_draft) text += "@draft";
    return text;
}

std::string withdrawn_message(const LibraryName& name) {
    return in_quotes(text_of(name)) + " was withdrawn by its owner";
}

}  // namespace sporeprint::api
