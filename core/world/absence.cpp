#include "core/world/absence.h"

#include <algorithm>
#include <string_view>
#include <vector>

#include "core/params/messages.h"

namespace sporeprint {

namespace {

/// Returns the kinds of trees that grow in a stand.
std::vector<std::string> kinds_of(const StandParams& stand) {
    std::vector<std::string> kinds;
    std::vector<Problem> problems;
    if (stand.density > 0.0)
        for (const auto& [id, weight] : kinds_in(stand.kinds, "stand.kinds", problems))
            kinds.push_back(id);
    if (!stand.lone.empty()) kinds.push_back(stand.lone.string());
    return kinds;
}

const char* substrate_of(Guild guild) {
    switch (guild) {
        case Guild::ectomycorrhizal:
            return "lives on the roots of ";
        case Guild::litter:
            return "lives on the litter of ";
        case Guild::wood:
            return "lives on the dead wood of ";
        case Guild::grass:
            break;
    }
    return "";
}

/// Returns names in a sentence: "oak", "oak or beech", "oak, beech or pine".
std::string either(const std::vector<Text<48>>& names) {
    std::string list;
    for (std::size_t i = 0; i < names.size(); ++i) {
        if (i > 0) list += i + 1 == names.size() ? " or " : ", ";
        list += names[i].view();
    }
    return list;
}

}  // namespace

std::string reason_of_absence(const Ecology& ecology, const WorldParams& params) {
    if (params.fungi.abundance <= 0.0) return "No fungus fruits, since fungi.abundance is 0.";
    const double acidity = params.soil.acidity;
    if (ecology.acidity.at(acidity) <= 0.0)
        return "It tolerates an acidity of the soil of " +
               number_text(ecology.acidity.tolerates.from) + " to " +
               number_text(ecology.acidity.tolerates.to) + "; soil.acidity is " +
               number_text(acidity) + '.';
    if (ecology.guild == Guild::grass) return {};
    const std::vector<std::string> kinds = kinds_of(params.stand);
    const auto lives_with = [&](const std::string& kind) {
        return ecology.trees.empty() ||
               std::ranges::any_of(ecology.trees,
                                   [&](const Text<48>& tree) { return tree.view() == kind; });
    };
    if (std::ranges::none_of(kinds, lives_with))
        return std::string("It ") + substrate_of(ecology.guild) +
               (ecology.trees.empty() ? "trees, and no tree grows here."
                                      : either(ecology.trees) + ", none of which grows here.");
    if (ecology.guild == Guild::wood && params.stand.dead_wood <= 0.0)
        return "It lives on dead wood, of which nothing is left, since stand.dead_wood is 0.";
    return {};
}

}  // namespace sporeprint
