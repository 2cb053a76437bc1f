#include "core/world/fungi_params.h"

#include <algorithm>

#include "core/params/messages.h"

namespace sporeprint {

namespace {

/// Returns what is wrong with the next of a list of species, or nothing.
std::string problem_of(std::string_view id, const std::vector<std::string>& others) {
    if (std::string message = invalid_id_message(id); !message.empty())
        return in_quotes(id) + " is no species: " + message;
    if (std::find(others.begin(), others.end(), id) != others.end())
        return in_quotes(id) + " is named twice";
    if (others.size() == most_world_species)
        return "at most " + std::to_string(most_world_species) + " species live in a world";
    return {};
}

}  // namespace

std::vector<std::string> species_in(std::string_view text, const std::string& path,
                                    std::vector<Problem>& problems) {
    std::vector<std::string> ids;
    if (text.empty()) return ids;
    while (true) {
        const std::size_t end = std::min(text.find('+'), text.size());
        const std::string_view id = text.substr(0, end);
        if (const std::string message = problem_of(id, ids); !message.empty()) {
            report(problems, path, message);
            return {};
        }
        ids.emplace_back(id);
        if (end == text.size()) break;
        text.remove_prefix(end + 1);
    }
    std::sort(ids.begin(), ids.end());
    return ids;
}

std::string canonical_species(std::string_view text) {
    std::vector<Problem> problems;
    std::string out;
    for (const std::string& id : species_in(text, "", problems)) {
        if (!out.empty()) out += '+';
        out += id;
    }
    return problems.empty() ? out : std::string(text);
}

}  // namespace sporeprint
