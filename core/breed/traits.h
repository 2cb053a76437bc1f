// Walks over the parts of species by their descriptions, so that a new parameter is inherited and
// mutates by itself.
#pragma once

#include <string>
#include <string_view>
#include <type_traits>
#include <variant>
#include <vector>

#include "core/model/species.h"
#include "core/params/describe.h"

namespace sporeprint {

/// The parts that are no members of a species: its ages and facts, and its size.
inline constexpr std::string_view stages_part = "stages", size_part = "size";

/// Returns the path of a member below that of its owner: "surface.cap"; an inlined member has that
/// of its owner.
[[nodiscard]] inline std::string part_path(const std::string& path, const Info& info) {
    if (!info.name[0]) return path;
    return path.empty() ? std::string(info.name) : path + '.' + info.name;
}

/// A trait is a part that is inherited on its own. These are no traits but owners of traits.
template <class T>
inline constexpr bool has_traits =
    std::is_same_v<T, Model> || std::is_same_v<T, Surface> ||
    std::is_same_v<T, OrnamentsOf<Plain>> || std::is_same_v<T, Swept> ||
    std::is_same_v<T, Branched> || is_variant<T>;

/// Traits whose numbers blend. All others come whole from one parent, since they are patterns and
/// counts that only fit together.
template <class T>
inline constexpr bool is_blended_trait =
    std::is_same_v<T, DeformationOf<Plain>> || std::is_same_v<T, WeatheringOf<Plain>> ||
    std::is_same_v<T, SegmentStyle> || std::is_same_v<T, Spread>;

/// Calls `use(out, a, b, path)` for each trait of three models of one family.
template <class T, class Use>
void visit_traits(T& out, const T& a, const T& b, const std::string& path, const Use& use) {
    if constexpr (is_variant<T>) {
        std::visit(
            [&](auto& one) {
                using Form = std::remove_cvref_t<decltype(one)>;
                visit_traits(one, std::get<Form>(a), std::get<Form>(b), path, use);
            },
            out);
    } else if constexpr (has_traits<T>) {
        T::fields([&](auto member, const Info& info) {
            visit_traits(out.*member, a.*member, b.*member, part_path(path, info), use);
        });
    } else {
        use(out, a, b, path);
    }
}

/// Returns pointers to a member of each of the values.
template <class T, class Member>
[[nodiscard]] auto members_of(const std::vector<T*>& values, Member T::*member) {
    std::vector<Member*> members;
    members.reserve(values.size());
    for (T* value : values) members.push_back(&(value->*member));
    return members;
}

}  // namespace sporeprint
