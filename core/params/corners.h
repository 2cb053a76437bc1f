// Visits the ends of every range: for tests that run a generator at all its extremes.
#pragma once

#include <initializer_list>
#include <string>
#include <type_traits>

#include "core/params/describe.h"

namespace sporeprint {

/// Sets every leaf of `value` in turn to each of its extremes, calls `use(path)` with the changed
/// `value`, and restores the leaf: numbers at both ends, ranges at both and at their widest,
/// booleans, enums and choices at each value, colours black and white, empty optionals set, each
/// alternative of a variant with its defaults, lists unchanged, item by item. One function, because
/// it is a table: each branch is the rule of one kind of member.
template <class T, class Use>
void walk_corners(T& value, const Info& info, const std::string& path, const Use& use) {
    const auto each = [&](std::initializer_list<T> extremes) {
        const T original = value;
        for (const T& extreme : extremes) {
            value = extreme;
            use(path);
        }
        value = original;
    };
    if constexpr (Described<T>) {
        prove<T>();
        T::fields([&](auto member, const Info& sub) {
            walk_corners(value.*member, sub, member_path(path, sub), use);
        });
    } else if constexpr (is_variant<T>) {
        const T original = value;
        for (const char* form : FormsOf<T>::names) {
            value = original;
            FormsOf<T>::select(value, form);
            use(path + '/' + form_key);
            std::visit([&](auto& one) { walk_corners(one, info, path, use); }, value);
        }
        value = original;
    } else if constexpr (is_optional<T>) {
        const T original = value;
        value.reset();
        use(path);
        value = original;
        if (!value) value.emplace();
        walk_corners(*value, info, path, use);
        value = original;
    } else if constexpr (is_list<T> || is_tuple<T>) {
        for (std::size_t i = 0; i < value.size(); ++i) {
            if constexpr (!std::is_same_v<T, std::vector<bool>>)
                walk_corners(value[i], info, path + '/' + std::to_string(i), use);
        }
    } else if constexpr (std::is_same_v<T, Range>) {
        each({{info.min, info.min}, {info.min, info.max}, {info.max, info.max}});
    } else if constexpr (NamedEnum<T>) {
        const T original = value;
        for (int i = 0; name(static_cast<T>(i)); ++i) {
            value = static_cast<T>(i);
            use(path);
        }
        value = original;
    } else if constexpr (std::is_same_v<T, IdChoice>) {
        const T original = value;
        for (const std::string& id : original.among) {
            value.id = decltype(value.id)(std::string_view(id));
            use(path);
        }
        value = original;
    } else if constexpr (std::is_same_v<T, bool>) {
        each({false, true});
    } else if constexpr (std::is_same_v<T, Colour>) {
        each({{0, 0, 0}, {255, 255, 255}});
    } else if constexpr (is_choice<T>) {
        const T original = value;
        for (const int one : T::values) {
            value = T{one};
            use(path);
        }
        value = original;
    } else if constexpr (Number<T>) {
        each({static_cast<T>(info.min), static_cast<T>(info.max)});
    } else {
        static_assert(is_text<T> || std::is_same_v<T, Upload>, "no rule for this member type");
    }
}

/// Visits the extremes of all of `value`; see `walk_corners`. `use` receives the JSON pointer of
/// the changed leaf and finds it in `value`, which is unchanged at the end.
template <Described T, class Use>
void corners(T& value, const Use& use) {
    walk_corners(value, Info{.name = ""}, "", use);
}

}  // namespace sporeprint
