// Reading of recorded facts: what the words of a text stand for.
#pragma once

#include <string_view>

namespace sporeprint {

/// Returns what belongs to the word that a text mentions first.
///
/// words   each with a text
/// what    the member that belongs to it
/// others  what is returned if the text mentions none
template <class Words, class Word, class What>
What first_mentioned(std::string_view text, const Words& words, What Word::*what, What others) {
    std::size_t first = std::string_view::npos;
    for (const Word& word : words)
        if (const std::size_t at = text.find(word.text); at < first) {
            first = at;
            others = word.*what;
        }
    return others;
}

}  // namespace sporeprint
