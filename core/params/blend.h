// Blending of weighted parameter structs, and overrides over values, both field by field.
#pragma once

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <functional>
#include <limits>
#include <string_view>
#include <type_traits>

#include "core/math/elementary.h"
#include "core/params/describe.h"

namespace sporeprint {

/// The greatest number of values blended at once: the species of a mix, or the stages of a species.
inline constexpr std::size_t most_blended = 8;

/// The input of a blend: one to `most_blended` values of one type with their weights.
template <class T>
struct Shares {
    std::array<const T*, most_blended> values{};
    std::array<double, most_blended> weights{};  ///< >= 0, sum 1
    std::size_t count = 0;

    void add(const T& value, double weight) {
        assert(count < most_blended && weight >= 0.0);
        values[count] = &value;
        weights[count++] = weight;
    }
    /// Returns the same weights with what `part` (a member, or a function of a value that returns a
    /// reference) selects.
    template <class Part>
    [[nodiscard]] auto of(Part part) const {
        Shares<std::remove_cvref_t<decltype(std::invoke(part, *values[0]))>> parts;
        parts.count = count;
        parts.weights = weights;
        for (std::size_t i = 0; i < count; ++i) parts.values[i] = &std::invoke(part, *values[i]);
        return parts;
    }
    /// Returns the value of the largest weight, the first of equal ones.
    [[nodiscard]] const T& heaviest() const {
        std::size_t best = 0;
        for (std::size_t i = 1; i < count; ++i)
            if (weights[i] > weights[best]) best = i;
        return *values[best];
    }
};

/// Returns true if numbers of this description are sizes, which blend geometrically: lengths that
/// cannot be 0.
inline bool is_size(const Info& info) { return std::string_view(info.unit) == "m" && info.min > 0; }

/// Returns the weighted mean of numbers (`by_ratio`: the geometric mean of positive ones), never
/// outside the range of those with positive weight, and exact when these are equal.
template <Number T>
double mean_of(const Shares<T>& shares, bool by_ratio = false) {
    double sum = 0.0, least = std::numeric_limits<double>::infinity(), most = -least;
    for (std::size_t i = 0; i < shares.count; ++i) {
        if (!(shares.weights[i] > 0.0)) continue;
        const auto x = static_cast<double>(*shares.values[i]);
        sum += shares.weights[i] * (by_ratio ? logarithm(x) : x);
        least = std::min(least, x);
        most = std::max(most, x);
    }
    if (!(least < most)) return least;
    return std::clamp(by_ratio ? exponential(sum) : sum, least, most);
}

/// Returns the weighted mean of colours in linear light.
inline Colour blend_colours(const Shares<Colour>& shares) {
    const auto channel = [&](std::uint8_t Colour::*which) {
        double light = 0.0;
        std::uint8_t least = 255, most = 0;
        for (std::size_t i = 0; i < shares.count; ++i) {
            if (!(shares.weights[i] > 0.0)) continue;
            const std::uint8_t x = shares.values[i]->*which;
            light += shares.weights[i] * srgb_to_linear(x / 255.0);
            least = std::min(least, x);
            most = std::max(most, x);
        }
        if (least >= most) return most;
        const double encoded = std::floor(linear_to_srgb(light) * 255.0 + 0.5);
        return static_cast<std::uint8_t>(
            std::clamp(encoded, static_cast<double>(least), static_cast<double>(most)));
    };
    return {channel(&Colour::r), channel(&Colour::g), channel(&Colour::b)};
}

template <class T>
T blend_shares(const Shares<T>& shares, const Info& info) {
    const T& heaviest = shares.heaviest();
    if constexpr (Described<T>) {
        prove<T>();
        T out = heaviest;
        T::fields([&](auto member, const Info& sub) {
            out.*member = blend_shares(shares.of(member), sub);
        });
        return out;
    } else if constexpr (is_variant<T>) {
        return std::visit(
            [&](const auto& one) -> T {
                using Alternative = std::remove_cvref_t<decltype(one)>;
                for (std::size_t i = 0; i < shares.count; ++i)
                    if (shares.values[i]->index() != heaviest.index()) return heaviest;
                return blend_shares(shares.of([](const T& value) -> const Alternative& {
                    return *std::get_if<Alternative>(&value);
                }),
                                    info);
            },
            heaviest);
    } else if constexpr (is_list<T> || is_tuple<T>) {
        for (std::size_t i = 0; i < shares.count; ++i)
            if (shares.values[i]->size() != heaviest.size()) return heaviest;
        T out = heaviest;
        for (std::size_t k = 0; k < out.size(); ++k)
            out[k] = blend_shares(
                shares.of([k](const T& list) -> const typename T::value_type& { return list[k]; }),
                info);
        return out;
    } else if constexpr (std::is_same_v<T, Range>) {
        return {mean_of(shares.of(&Range::from), is_size(info)),
                mean_of(shares.of(&Range::to), is_size(info))};
    } else if constexpr (std::is_same_v<T, Colour>) {
        return blend_colours(shares);
    } else if constexpr (std::is_integral_v<T> && Number<T>) {
        T most = *shares.values[0];
        for (std::size_t i = 1; i < shares.count; ++i) most = std::max(most, *shares.values[i]);
        return most;
    } else if constexpr (Number<T>) {
        return static_cast<T>(mean_of(shares, is_size(info)));
    } else {
        return heaviest;
    }
}

/// Returns the blend of several weighted structs, independent of their order (up to ties and
/// rounding): the weighted mean of numbers and ranges, the geometric one of lengths that cannot be
/// 0 (sizes), of colours in linear light, of lists of equal length item by item, of equal
/// alternatives of a variant by their fields. Integers are counts, fixed for a set: the largest of
/// all, including those of weight 0, so that nothing appears suddenly. Everything else (names,
/// switches, lists of unequal length) is that of the largest weight.
///
/// returns  exactly the one value when a single one has positive weight, except for its counts
template <class T>
T blend(const Shares<T>& shares) {
    assert(shares.count > 0);
    return blend_shares(shares, Info{.name = ""});
}

template <Described Overrides, Described Values>
consteval bool same_fields();

/// Returns true if `Override` is `Member` made optional, or both are structs with the same fields.
template <class Overrides, class Override, class Values, class Member>
constexpr bool fits(Override Overrides::*, Member Values::*) {
    if constexpr (Described<Override> && Described<Member>)
        return same_fields<Override, Member>();
    else
        return std::is_same_v<Override, std::optional<Member>>;
}

/// Returns true if two descriptions have the same names in the same order, each override fitting
/// its value.
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

/// Copies one member of `overlay`; does nothing for a pair that does not match. (It is a separate
/// function because Clang 14 confuses the types of nested generic lambdas.)
template <class Override, class Member>
void overlay_member(const Override& from, Member& to) {
    if constexpr (std::is_same_v<Override, std::optional<Member>>) {
        if (from) to = *from;
    } else if constexpr (Described<Override> && Described<Member>) {
        if constexpr (same_fields<Override, Member>()) overlay(from, to);
    }
}

/// Copies each optional that is set in `from` over its value in `to`, also in nested structs. Both
/// have the same fields in the same order: the two versions of one struct template.
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
