#include "core/breed/breeding.h"

#include <type_traits>
#include <variant>

#include "core/breed/traits.h"
#include "core/params/messages.h"
#include "core/problems.h"

namespace sporeprint {

namespace {

/// Appends the names of the members of a part, and of what is in them.
template <class T>
void name_parts(const T& value, const std::string& path, std::vector<std::string>& names) {
    if constexpr (is_variant<T>) {
        std::visit([&](const auto& one) { name_parts(one, path, names); }, value);
    } else {
        T::fields([&](auto member, const Info& info) {
            using Member = std::remove_cvref_t<decltype(value.*member)>;
            if constexpr (Described<Member> || is_variant<Member>) {
                const std::string name = part_path(path, info);
                if (info.name[0]) names.push_back(name);
                // An outline is inherited as a whole.
                if constexpr (!std::is_same_v<Member, Silhouette>)
                    name_parts(value.*member, name, names);
            } else {
                names.push_back(part_path(path, info));
            }
        });
    }
}

}  // namespace

std::vector<std::string> lockable_parts(const Species& species) {
    std::vector<std::string> names = {std::string(stages_part), std::string(size_part), "spread"};
    name_parts(species.spread, "spread", names);
    names.emplace_back("ground");
    name_parts(species.ground, "ground", names);
    // A part of one ecology may be impossible in another: rings of 20 m in a wood.
    names.emplace_back("ecology");
    name_parts(species.stages.front().model, "", names);
    return names;
}

std::vector<Problem> lock_problems(const Species& species, const BreedingParams& params) {
    const std::vector<std::string> parts = lockable_parts(species);
    std::vector<Problem> problems;
    for (std::size_t i = 0; i < params.lock.size(); ++i) {
        const std::string_view lock = params.lock[i];
        if (std::find(parts.begin(), parts.end(), lock) != parts.end()) continue;
        const std::string_view meant = closest(lock, parts);
        report(problems, "/lock/" + std::to_string(i),
               in_quotes(lock) + " is no part of these species" +
                   (meant.empty() ? "; parts are such as surface.cap, silhouette, ring and size"
                                  : "; did you mean " + in_quotes(meant) + "?"));
    }
    return problems;
}

}  // namespace sporeprint
