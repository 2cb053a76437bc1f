// Random values of any described struct, always inside their ranges, for property tests.
#pragma once

#include <rapidcheck.h>

#include <cstdint>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "core/params/describe.h"

namespace sporeprint {

/// Returns a number in [0, 1], often one of the ends.
inline double arbitrary_fraction() {
    const auto step = *rc::gen::inRange<std::uint32_t>(0, 1u << 20);
    if (step % 16 == 0) return 0.0;
    if (step % 16 == 1) return 1.0;
    return static_cast<double>(step) / 1048575.0;
}

/// Fills `value` with random content that obeys `info`. Callers have to satisfy cross-field rules.
template <class T>
void arbitrary(T& value, const Info& info) {
    if constexpr (Described<T>) {
        T::fields([&](auto member, const Info& sub) { arbitrary(value.*member, sub); });
    } else if constexpr (is_variant<T>) {
        const auto& forms = FormsOf<T>::names;
        FormsOf<T>::select(value, forms[*rc::gen::inRange<std::size_t>(0, forms.size())]);
        std::visit([&](auto& one) { arbitrary(one, info); }, value);
    } else if constexpr (is_optional<T>) {
        value.reset();
        if (*rc::gen::inRange(0, 2)) arbitrary(value.emplace(), info);
    } else if constexpr (is_list<T>) {
        value.assign(*rc::gen::inRange<std::size_t>(0, info.most + 1), {});
        for (auto& item : value) arbitrary(item, info);
    } else if constexpr (is_tuple<T>) {
        for (auto& item : value) arbitrary(item, info);
    } else if constexpr (std::is_same_v<T, Range>) {
        arbitrary(value.from, info);
        arbitrary(value.to, info);
        if (value.from > value.to) std::swap(value.from, value.to);
    } else if constexpr (NamedEnum<T>) {
        int count = 0;
        while (name(static_cast<T>(count))) ++count;
        value = static_cast<T>(*rc::gen::inRange(0, count));
    } else if constexpr (std::is_same_v<T, bool>) {
        value = *rc::gen::inRange(0, 2) == 1;
    } else if constexpr (is_text<T>) {
        static const std::string letters[] = {"a", "Z", "7", " ", "\"", "\\", "&", "é", "%", "𝛼"};
        std::string text;
        for (auto length = *rc::gen::inRange<std::size_t>(0, T::capacity + 1); length > 0;
             --length) {
            const std::string& letter = letters[*rc::gen::inRange<std::size_t>(0, 10)];
            if (text.size() + letter.size() <= (info.most ? info.most : T::capacity))
                text += letter;
        }
        value = T(std::string_view(text));
    } else if constexpr (std::is_same_v<T, Colour>) {
        const auto rgb = *rc::gen::inRange<std::uint32_t>(0, 1u << 24);
        value = {static_cast<std::uint8_t>(rgb >> 16), static_cast<std::uint8_t>(rgb >> 8 & 255u),
                 static_cast<std::uint8_t>(rgb & 255u)};
    } else if constexpr (std::is_same_v<T, Upload>) {
        std::vector<std::uint8_t> bytes(
            *rc::gen::inRange<std::size_t>(0, std::min<std::size_t>(info.most, 64) + 1));
        for (auto& byte : bytes) byte = static_cast<std::uint8_t>(*rc::gen::inRange(0, 256));
        value = uploaded(std::move(bytes));
    } else if constexpr (is_choice<T>) {
        value.value = T::values[*rc::gen::inRange<std::size_t>(0, std::size(T::values))];
    } else if constexpr (std::is_integral_v<T>) {
        value = static_cast<T>(info.min + arbitrary_fraction() * (info.max - info.min));
    } else {
        static_assert(Number<T>);
        value = static_cast<T>(info.min + arbitrary_fraction() * (info.max - info.min));
        if (!in_range(value, info)) value = static_cast<T>(info.max);
    }
}

/// Returns a random T whose members are inside their ranges.
template <Described T>
T arbitrary_of() {
    T value{};
    arbitrary(value, Info{.name = ""});
    return value;
}

}  // namespace sporeprint
