// Lists of words in a query, such as kinds=tree+log: which enumerators of a NamedEnum they name.
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <string_view>
#include <utility>

#include "api/http/errors.h"
#include "core/params/describe.h"
#include "core/params/messages.h"

namespace sporeprint::api {

/// Which enumerators are named.
template <NamedEnum E, std::size_t Count>
using Chosen = std::array<bool, Count>;

/// Reads a list of names joined by +; all of them without text. Each error names `parameter`.
template <NamedEnum E, std::size_t Count>
Chosen<E, Count> read_words(std::string_view text, const char* parameter,
                            ValidationErrors& errors) {
    Chosen<E, Count> chosen{};
    if (text.empty()) {
        chosen.fill(true);
        return chosen;
    }
    std::string known;
    for (std::size_t i = 0; i < Count; ++i)
        (known += i == 0 ? "" : i + 1 == Count ? " and " : ", ") += name(static_cast<E>(i));
    while (true) {
        const std::string_view one = text.substr(0, text.find('+'));
        std::size_t i = 0;
        while (i < Count && one != name(static_cast<E>(i))) ++i;
        if (i == Count)
            errors.add(400, parameter, in_quotes(one) + " is none of " + known + ", joined by +");
        else if (std::exchange(chosen[i], true))
            errors.add(400, parameter, in_quotes(one) + " is named twice");
        if (one.size() == text.size()) return chosen;
        text.remove_prefix(one.size() + 1);
    }
}

/// Returns the canonical list; nothing if all are named.
template <NamedEnum E, std::size_t Count>
std::string words_text(const std::array<bool, Count>& chosen) {
    std::string list;
    bool is_whole = true;
    for (std::size_t i = 0; i < Count; ++i) {
        is_whole = is_whole && chosen[i];
        if (chosen[i]) (list += list.empty() ? "" : "+") += name(static_cast<E>(i));
    }
    return is_whole ? std::string() : list;
}

}  // namespace sporeprint::api
