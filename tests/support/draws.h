// Random parameters inside their ranges, from the random streams of core: the same on every
// machine.
#pragma once

#include <cmath>
#include <type_traits>

#include "core/math/random.h"
#include "core/params/describe.h"

namespace sporeprint {

/// Sets every number, enum, choice and boolean of `value` to a draw from its range; other members
/// stay unchanged.
template <class T>
void draw(T& value, const Info& info, Random& random) {
    if constexpr (Described<T>) {
        T::fields([&](auto member, const Info& sub) { draw(value.*member, sub, random); });
    } else if constexpr (Number<T>) {
        const double drawn = random.uniform(info.min, info.max);
        value = static_cast<T>(std::is_integral_v<T> ? std::floor(drawn + 0.5) : drawn);
    } else if constexpr (NamedEnum<T>) {
        int count = 0;
        while (name(static_cast<T>(count))) ++count;
        value = static_cast<T>(static_cast<int>(random.uniform() * count));
    } else if constexpr (std::is_same_v<T, IdChoice>) {
        if (value.among.empty()) return;
        const auto count = static_cast<double>(value.among.size());
        const std::string& id = value.among[static_cast<std::size_t>(random.uniform() * count)];
        value.id = decltype(value.id)(std::string_view(id));
    } else if constexpr (is_choice<T>) {
        const auto count = static_cast<double>(std::size(T::values));
        value.value = T::values[static_cast<std::size_t>(random.uniform() * count)];
    } else if constexpr (std::is_same_v<T, bool>) {
        value = random.uniform() < 0.5;
    }
}

/// Draws values of T until one passes check(), and returns it.
template <class T>
T drawn(Random& random) {
    for (;;) {
        T value{};
        draw(value, Info{.name = ""}, random);
        std::vector<Problem> problems;
        check(value, Info{.name = ""}, "", problems);
        if (problems.empty()) return value;
    }
}

}  // namespace sporeprint
