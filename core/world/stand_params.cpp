#include "core/world/stand_params.h"

#include <algorithm>
#include <cstddef>

#include "core/params/messages.h"
#include "core/params/value.h"

namespace sporeprint {

namespace {

/// Most kinds of trees in one stand.
constexpr std::size_t most_kinds = 8;

/// Reads one kind and its weight, which is 1 if there is none.
///
/// returns  what is wrong with it, or nothing
std::string read_kind(std::string_view part, const Weights& others,
                      std::pair<std::string, double>& out) {
    const std::size_t colon = part.find(':');
    out = {std::string(part.substr(0, colon)), 1.0};
    if (std::string message = invalid_id_message(out.first); !message.empty())
        return in_quotes(out.first) + " is no kind of tree: " + message;
    if (std::any_of(others.begin(), others.end(),
                    [&](const auto& other) { return other.first == out.first; }))
        return in_quotes(out.first) + " is named twice";
    if (colon == std::string_view::npos) return {};
    const std::string weight(part.substr(colon + 1));
    if (!read_number(weight, out.second) || !(out.second > 0.0))
        return "the weight of " + in_quotes(out.first) + " is " + in_quotes(weight) +
               "; weights are numbers greater than 0";
    return {};
}

}  // namespace

Weights kinds_in(std::string_view text, const std::string& path, std::vector<Problem>& problems) {
    Weights kinds;
    while (true) {
        const std::size_t end = std::min(text.find('+'), text.size());
        std::pair<std::string, double> kind;
        std::string message = read_kind(text.substr(0, end), kinds, kind);
        if (message.empty() && kinds.size() == most_kinds)
            message = "at most " + std::to_string(most_kinds) + " kinds can be mixed";
        if (!message.empty()) {
            report(problems, path, message + "; kinds are written as in broadleaf:0.8+birch:0.2");
            return {};
        }
        kinds.push_back(std::move(kind));
        if (end == text.size()) return kinds;
        text.remove_prefix(end + 1);
    }
}

std::string canonical_kinds(std::string_view text) {
    std::vector<Problem> problems;
    Weights kinds = kinds_in(text, "", problems);
    if (!problems.empty()) return std::string(text);
    const Mix mix = canonical_mix(std::move(kinds));
    if (mix.size() == 1) return mix.front().id;
    std::string out;
    for (const MixPart& part : mix) {
        if (!out.empty()) out += '+';
        ((out += part.id) += ':') += number_text(part.weight / 1000.0);
    }
    return out;
}

}  // namespace sporeprint
