// Between two parameter structs, and overrides over values: both field by field.
#pragma once

#include <algorithm>
#include <cassert>
#include <cmath>
#include <string>
#include <type_traits>

#include "core/math/elementary.h"
#include "core/params/describe.h"

namespace sporeprint {

/// a + t (b - a), never outside [a, b]; exactly a at t = 0 and b at t = 1.
inline double between(double a, double b, double t) {
    if (t >= 1.0) return b;
    return std::clamp(a + t * (b - a), std::min(a, b), std::max(a, b));
}

template <class T>
T blend_at(const T& a, const T& b, double t, const std::string& path) {
    if constexpr (Described<T>) {
        prove<T>();
        T out = a;
        T::fields([&](auto member, const Info& sub) {
            out.*member = blend_at(a.*member, b.*member, t, member_path(path, sub));
        });
        return out;
    } else if constexpr (is_variant<T>) {
        if (a.index() != b.index()) return t < 0.5 ? a : b;
        return std::visit(
            [&](const auto& one) -> T {
                using Alternative = std::remove_cvref_t<decltype(one)>;
                return blend_at(one, std::get<Alternative>(b), t, path);
            },
            a);
    } else if constexpr (is_list<T> || is_tuple<T>) {
        if (a.size() != b.size())
            throw GenerationError("lists of " + std::to_string(a.size()) + " and " +
                                  std::to_string(b.size()) + " items cannot be blended: " + path);
        T out = a;
        for (std::size_t i = 0; i < a.size(); ++i)
            out[i] = blend_at<typename T::value_type>(a[i], b[i], t, path);
        return out;
    } else if constexpr (std::is_same_v<T, Range>) {
        return {between(a.from, b.from, t), between(a.to, b.to, t)};
    } else if constexpr (std::is_same_v<T, Colour>) {
        const auto channel = [&](std::uint8_t x, std::uint8_t y) {
            if (x == y) return x;
            const double light = between(srgb_to_linear(x / 255.0), srgb_to_linear(y / 255.0), t);
            const double encoded = std::floor(linear_to_srgb(light) * 255.0 + 0.5);
            return static_cast<std::uint8_t>(std::clamp(encoded, 0.0, 255.0));
        };
        return {channel(a.r, b.r), channel(a.g, b.g), channel(a.b, b.b)};
    } else if constexpr (std::is_integral_v<T> && Number<T>) {
        return static_cast<T>(
            std::floor(between(static_cast<double>(a), static_cast<double>(b), t) + 0.5));
    } else if constexpr (Number<T>) {
        return static_cast<T>(between(static_cast<double>(a), static_cast<double>(b), t));
    } else {
        return t < 0.5 ? a : b;
    }
}

/// The struct at `t` in [0, 1] on the way from `a` (t = 0, exactly) to `b` (t = 1, exactly):
/// numbers and ranges linearly, integers rounded half up, lists item by item, colours in linear
/// light, equal alternatives of a variant inside; everything else from the nearer (t < 0.5: a).
/// Throws GenerationError when two lists differ in length.
template <class T>
T blend(const T& a, const T& b, double t) {
    assert(t >= 0.0 && t <= 1.0);
    if (t <= 0.0) return a;
    if (t >= 1.0) return b;
    return blend_at(a, b, t, "");
}

template <Described Overrides, Described Values>
consteval bool same_fields();

/// Whether `Override` is `Member` made optional, or both are structs with the same fields.
template <class Overrides, class Override, class Values, class Member>
constexpr bool fits(Override Overrides::*, Member Values::*) {
    if constexpr (Described<Override> && Described<Member>)
        return same_fields<Override, Member>();
    else
        return std::is_same_v<Override, std::optional<Member>>;
}

/// Whether two descriptions have the same names in the same order, each override fitting its value.
template <Described Overrides, Described Values>
consteval bool same_fields() {
    bool same = member_count<Overrides>() == member_count<Values>();
    std::size_t i = 0;
    Overrides::fields([&](auto override_member, const Info& override_info) {
        std::size_t j = 0;
        Values::fields([&](auto member, const Info& info) {
            if (i == j)
                same = same && fits(override_member, member) &&
                       std::string_view(override_info.name) == info.name;
            ++j;
        });
        ++i;
    });
    return same;
}

template <Described Overrides, Described Values>
void overlay(const Overrides& from, Values& to);

/// One member of `overlay`; does nothing for a pair that does not belong together. (A function of
/// its own: Clang 14 mixes up the types of nested generic lambdas.)
template <class Override, class Member>
void overlay_member(const Override& from, Member& to) {
    if constexpr (std::is_same_v<Override, std::optional<Member>>) {
        if (from) to = *from;
    } else if constexpr (Described<Override> && Described<Member>) {
        if constexpr (same_fields<Override, Member>()) overlay(from, to);
    }
}

/// Copies each optional that is set in `from` over its value in `to`, also in nested structs.
/// Both have the same fields in the same order: the two versions of one struct template.
template <Described Overrides, Described Values>
void overlay(const Overrides& from, Values& to) {
    static_assert(same_fields<Overrides, Values>(), "overrides and values have different fields");
    std::size_t i = 0;
    Overrides::fields([&](auto override_member, const Info&) {
        std::size_t j = 0;
        Values::fields([&](auto member, const Info&) {
            if (i == j) overlay_member(from.*override_member, to.*member);
            ++j;
        });
        ++i;
    });
}

}  // namespace sporeprint
