// Descriptions of parameters: each is described once, and the range check below, the JSON reader,
// the query reader, the schema, the canonical text and the blend are derived from it.
#pragma once

#include <array>
#include <concepts>
#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "core/params/messages.h"
#include "core/params/types.h"
#include "core/problems.h"

namespace sporeprint {

/// The description of one parameter. Its default is not here: the default is the member initialiser
/// of the struct. A described struct or a variant whose name is "" is inlined: its fields belong to
/// the object of its parent.
struct Info {
    const char* name;             ///< JSON key, schema property and slider label: [a-z0-9_]
    const char* unit = "";        ///< "m", "deg", "1/m"; empty for a pure number
    double min = 0.0, max = 0.0;  ///< closed range of a number (or of each list item)
    std::size_t most = 0;         ///< longest list; longest text or upload in bytes
    const char* doc = "";         ///< one sentence, shown as tooltip and in the API docs
    double step = 0.0;            ///< a slider's step; 0 leaves it to the page
    const char* group =
        "";  ///< heading under which controls of one object are grouped; empty: that of the object
    /// Name of the parameter from whose value the default follows; empty for none.
    const char* default_from = "";
};

/// A parameter struct: an aggregate that calls `visit(&T::member, Info{...})` for each member, in
/// their order. It may add a cross-field rule, called only when each field is valid by itself:
/// `void check(const std::string& path, std::vector<Problem>& problems) const`.
template <class T>
concept Described = std::is_aggregate_v<T> && requires {
    T::fields([](auto, const Info&) {});
};

/// An enum whose `const char* name(E)` switches over every enumerator and ends in nullptr, so that
/// -Wswitch proves that none is forgotten and counting up lists them all.
template <class T>
concept NamedEnum = std::is_enum_v<T> && requires(T e) {
    { name(e) } -> std::same_as<const char*>;
};

/// A number that has a range: any integer or floating-point type but bool.
template <class T>
concept Number = std::is_arithmetic_v<T> && !std::is_same_v<T, bool>;

template <class T>
inline constexpr bool is_list = false;
template <class T>
inline constexpr bool is_list<std::vector<T>> = true;

/// A list of fixed length: std::array of numbers.
template <class T>
inline constexpr bool is_tuple = false;
template <Number T, std::size_t N>
inline constexpr bool is_tuple<std::array<T, N>> = true;

template <class T>
inline constexpr bool is_optional = false;
template <class T>
inline constexpr bool is_optional<std::optional<T>> = true;

template <class T>
inline constexpr bool is_variant = false;
template <class... Ts>
inline constexpr bool is_variant<std::variant<Ts...>> = true;

template <class T>
inline constexpr bool is_text = false;
template <std::size_t N>
inline constexpr bool is_text<Text<N>> = true;

template <class T>
inline constexpr bool is_choice = false;
template <int... Values>
inline constexpr bool is_choice<Choice<Values...>> = true;

/// For struct templates that exist twice with the same fields, as values and as overrides:
/// `template <template <class> class Maybe> struct BendOf { Maybe<double> bend_deg{}; ... };`
/// `using Bend = BendOf<Plain>; using BendOverrides = BendOf<Maybe>;`
template <class T>
using Plain = T;
template <class T>
using Maybe = std::optional<T>;

/// Returns the default of such a member: `value` where members are values, unset where they are
/// overrides.
template <template <class> class M, class T>
constexpr M<T> preset(T value) {
    if constexpr (is_optional<M<T>>)
        return std::nullopt;
    else
        return value;
}

/// Returns true if `value` lies in the closed range of `info`; NaN never does. A float is compared
/// with the bounds rounded to float.
template <Number T>
constexpr bool in_range(T value, const Info& info) {
    if constexpr (std::is_same_v<T, float>)
        return value >= static_cast<float>(info.min) && value <= static_cast<float>(info.max);
    else
        return static_cast<double>(value) >= info.min && static_cast<double>(value) <= info.max;
}

/// The key that selects an alternative of a variant.
inline constexpr const char* form_key = "form";

/// The forms of a variant's alternatives, in order: `static constexpr const char* form = "swept"`.
template <class Variant>
struct FormsOf;
template <class... Ts>
struct FormsOf<std::variant<Ts...>> {
    static_assert((Described<Ts> && ...), "every alternative of a variant is described");
    static constexpr std::array<const char*, sizeof...(Ts)> names = {Ts::form...};

    /// Makes `out` hold the alternative called `form`; keeps its values when it already does.
    /// Returns false when there is no such form.
    static constexpr bool select(std::variant<Ts...>& out, std::string_view form) {
        return select(out, form, std::index_sequence_for<Ts...>{});
    }

  private:
    template <std::size_t... Is>
    static constexpr bool select(std::variant<Ts...>& out, std::string_view form,
                                 std::index_sequence<Is...>) {
        const auto one = [&]<std::size_t I>(std::integral_constant<std::size_t, I>) {
            if (form != names[I]) return false;
            if (out.index() != I) out.template emplace<I>();
            return true;
        };
        return (one(std::integral_constant<std::size_t, Is>{}) || ...);
    }
};

/// Returns the form of the alternative that `value` holds.
template <class... Ts>
constexpr const char* form_of(const std::variant<Ts...>& value) {
    return FormsOf<std::variant<Ts...>>::names[value.index()];
}

/// Returns every name of an enum: "none, growth".
template <NamedEnum E>
std::string enum_names() {
    std::string text;
    for (int i = 0; const char* one = name(static_cast<E>(i)); ++i)
        text += (i ? ", " : "") + std::string(one);
    return text;
}

/// Returns true if `value` is one of the enumerators.
template <NamedEnum E>
constexpr bool enum_holds(E value) {
    for (int i = 0; name(static_cast<E>(i)); ++i)
        if (static_cast<E>(i) == value) return true;
    return false;
}

/// Returns every value of a Choice: "128, 256, 512".
template <class T>
std::string choice_names() {
    std::string text;
    for (const int one : T::values) text += (text.empty() ? "" : ", ") + std::to_string(one);
    return text;
}

/// Returns the message "'elm' is not one of maple, oak" for a value that a choice does not allow.
inline std::string not_allowed_message(const std::string& shown, const IdChoice& choice) {
    if (choice.among.empty()) return shown + " is not an id of a-z, 0-9 and _";
    std::string names;
    for (const std::string& id : choice.among) names += (names.empty() ? "" : ", ") + id;
    return shown + " is not one of " + names;
}

// --- Compile-time proof that a description is complete and sane -------------------------

/// Converts to any type; it is only used in unevaluated operands.
struct Anything {
    template <class T>
    operator T() const;
};

/// Returns the number of members of the aggregate T.
template <class T, class... Found>
consteval std::size_t member_count() {
    if constexpr (requires { T{Found{}..., Anything{}}; })
        return member_count<T, Found..., Anything>();
    else
        return sizeof...(Found);
}

/// Returns how often `wanted` is a key of T's object; inlined members count, alternatives as their
/// maximum.
template <class T>
constexpr std::size_t key_count(std::string_view wanted);

template <class... Ts>
constexpr std::size_t key_count_of_forms(std::string_view wanted, const std::variant<Ts...>*) {
    std::size_t most = 0;
    ((most = key_count<Ts>(wanted) > most ? key_count<Ts>(wanted) : most), ...);
    return most + (wanted == form_key ? 1 : 0);
}

template <class T>
constexpr std::size_t key_count(std::string_view wanted) {
    std::size_t count = 0;
    T::fields([&](auto member, const Info& info) {
        using Member = std::remove_cvref_t<decltype(std::declval<T&>().*member)>;
        const std::string_view key = info.name;
        if constexpr (Described<Member>) {
            if (key.empty()) count += key_count<Member>(wanted);
        } else if constexpr (is_variant<Member>) {
            if (key.empty())
                count += key_count_of_forms(wanted, static_cast<const Member*>(nullptr));
        }
        if (!key.empty() && key == wanted) ++count;
    });
    return count;
}

/// The result of the proof for T; see `well_described`.
struct Description {
    std::size_t members = 0, described = 0;
    bool distinct = true;    ///< no member is visited twice
    bool named = true;       ///< names are [a-z0-9_]+, unique, "_deg" exactly with unit "deg"
    bool documented = true;  ///< no doc is empty
    bool bounded = true;     ///< numbers have min < max; lists and uploads have `most`
    bool in_bounds = true;   ///< defaults obey their own bounds
};

/// Returns true if a name is [a-z0-9_]+ and ends in "_deg" exactly if its unit is "deg".
constexpr bool proper_name(const Info& info) {
    const std::string_view key = info.name;
    for (const char c : key)
        if (!((c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_')) return false;
    return !key.empty() && key.ends_with("_deg") == (std::string_view(info.unit) == "deg");
}

/// Returns true if the bounds in `info` suit a member of type T.
template <class T>
constexpr bool proper_bounds(const Info& info) {
    if constexpr (is_optional<T>)
        return proper_bounds<typename T::value_type>(info);
    else if constexpr (is_list<T>)
        return info.most > 0 && proper_bounds<typename T::value_type>(info);
    else if constexpr (std::is_integral_v<T> && Number<T>)  // and the type can hold them
        return info.min < info.max &&
               info.min >= static_cast<double>(std::numeric_limits<T>::min()) &&
               info.max <= static_cast<double>(std::numeric_limits<T>::max());
    else if constexpr (Number<T> || is_tuple<T> || std::is_same_v<T, Range>)
        return info.min < info.max;
    else if constexpr (is_text<T>)
        return info.most <= T::capacity;
    else if constexpr (std::is_same_v<T, Upload>)
        return info.most > 0;
    else
        return true;
}

/// Returns true if the default `value` obeys the bounds in `info`.
template <class T>
constexpr bool proper_default(const T& value, const Info& info) {
    if constexpr (is_optional<T>) {
        return !value || proper_default(*value, info);
    } else if constexpr (is_list<T>) {
        bool proper = value.size() <= info.most;
        for (const auto& item : value) proper = proper && proper_default(item, info);
        return proper;
    } else if constexpr (is_tuple<T>) {
        bool proper = true;
        for (const auto item : value) proper = proper && in_range(item, info);
        return proper;
    } else if constexpr (std::is_same_v<T, Range>) {
        return in_range(value.from, info) && in_range(value.to, info) && value.from <= value.to;
    } else if constexpr (Number<T>) {
        return in_range(value, info);
    } else if constexpr (is_text<T>) {
        return info.most == 0 || value.size() <= info.most;
    } else if constexpr (is_choice<T>) {
        return T::allows(value.value);
    } else {
        return true;
    }
}

template <class T>
constexpr bool constructs() {
    T value{};  // not const: GCC 12 cannot build a const vector in a constant expression
    return static_cast<const void*>(&value) != nullptr;
}

/// States whether a default T can be made at compile time. Where it cannot (a std::variant whose
/// alternative holds a list, under Clang 14), its defaults are left to `check` and to GCC.
template <class T>
concept ConstantDefault = requires {
    typename std::bool_constant<constructs<T>()>;
};

template <class A, class B>
constexpr bool same_member(A a, B b) {
    if constexpr (std::is_same_v<A, B>)
        return a == b;
    else
        return false;
}

template <Described T>
consteval Description description() {
    Description found;
    constexpr std::size_t members = member_count<T>();
    found.members = members;
    T::fields([&](auto member, const Info& info) {
        using Member = std::remove_cvref_t<decltype(std::declval<T&>().*member)>;
        ++found.described;
        constexpr bool can_be_inlined = Described<Member> || is_variant<Member>;
        if (!(can_be_inlined && info.name[0] == '\0')) {
            found.named = found.named && proper_name(info) && key_count<T>(info.name) == 1;
            found.documented = found.documented && info.doc[0] != '\0';
        }
        found.bounded = found.bounded && proper_bounds<Member>(info);
    });
    if constexpr (ConstantDefault<T>) {
        T value{};
        const void* seen[members + 1] = {};
        std::size_t count = 0;
        T::fields([&](auto member, const Info& info) {
            const void* const here = &(value.*member);
            for (std::size_t i = 0; i < count && i < members; ++i)
                found.distinct = found.distinct && seen[i] != here;
            if (count < members) seen[count] = here;
            ++count;
            found.in_bounds = found.in_bounds && proper_default(value.*member, info);
        });
    } else {
        std::size_t equal_pairs = 0;
        T::fields([&](auto a, const Info&) {
            T::fields([&](auto b, const Info&) { equal_pairs += same_member(a, b) ? 1 : 0; });
        });
        found.distinct = equal_pairs == found.described;
    }
    return found;
}

template <Described T>
inline constexpr Description description_of = description<T>();

/// Returns true if T's `fields` names every member exactly once, each with a proper name, a doc,
/// valid bounds and a default inside them. Put `static_assert(well_described<T>());` below T.
template <Described T>
consteval bool well_described() {
    constexpr Description found = description_of<T>;
    return found.described == found.members && found.distinct && found.named && found.documented &&
           found.bounded && found.in_bounds;
}

/// Runs the same proof with a message for each error; every consumer of a description calls it.
template <Described T>
consteval void prove() {
    constexpr Description found = description_of<T>;
    static_assert(found.described >= found.members, "fields() forgets a member");
    static_assert(found.described <= found.members && found.distinct,
                  "fields() visits a member twice");
    static_assert(
        found.named,
        "a name is not [a-z0-9_]+, or is used twice, or \"_deg\" and unit \"deg\" disagree");
    static_assert(found.documented, "a doc is empty");
    static_assert(
        found.bounded,
        "a number has no min < max, or a list or upload no `most`, or a text too large a one");
    static_assert(found.in_bounds, "a default is outside its own bounds");
}

// --- The one check of values, used by core itself and by the readers ---------------------

/// Returns the message "1.7 is outside 0..1".
template <Number T>
std::string outside_message(T value, const Info& info) {
    return number_text(value) + " is outside " + number_text(info.min) + ".." +
           number_text(info.max);
}

/// Returns the longest text in bytes that a Text<N> described by `info` may hold.
template <class T>
constexpr std::size_t longest_text(const Info& info) {
    return info.most ? info.most : T::capacity;
}

/// Returns the bounds of each item of the list described by `info`: the range of numbers, the
/// capacity of texts (`most` is the list's own length).
template <class T>
constexpr Info item_info(const Info& info) {
    Info item = info;
    if constexpr (is_text<T>) item.most = 0;
    return item;
}

/// Returns the description of the member `name` of T, so that nothing is described twice.
template <class T>
constexpr Info info_of(std::string_view name) {
    Info found{.name = ""};
    T::fields([&](auto, const Info& info) {
        if (name == info.name) found = info;
    });
    return found;
}

/// Returns the path of the member described by `sub` below `path`; an inlined member has its
/// parent's.
inline std::string member_path(const std::string& path, const Info& sub) {
    return sub.name[0] ? path + '/' + sub.name : path;
}

/// Appends what is wrong with `value` to `problems`, or nothing if it is valid. `path` is the JSON
/// pointer of `value`. Cross-field rules are called when their fields are valid.
template <class T>
void check(const T& value, const Info& info, const std::string& path,
           std::vector<Problem>& problems) {
    if constexpr (Described<T>) {
        prove<T>();
        const std::size_t before = problems.size();
        T::fields([&](auto member, const Info& sub) {
            check(value.*member, sub, member_path(path, sub), problems);
        });
        if constexpr (requires { value.check(path, problems); })
            if (problems.size() == before) value.check(path, problems);
    } else if constexpr (is_variant<T>) {
        std::visit([&](const auto& one) { check(one, info, path, problems); }, value);
    } else if constexpr (is_optional<T>) {
        if (value) check(*value, info, path, problems);
    } else if constexpr (is_list<T> || is_tuple<T>) {
        if constexpr (is_list<T>)
            if (value.size() > info.most)
                return report(problems, path,
                              "a list of " + std::to_string(value.size()) + " items; at most " +
                                  std::to_string(info.most) + " are allowed");
        for (std::size_t i = 0; i < value.size(); ++i)
            check(value[i], item_info<typename T::value_type>(info), path + '/' + std::to_string(i),
                  problems);
    } else if constexpr (Number<T>) {
        if (!in_range(value, info)) report(problems, path, outside_message(value, info));
    } else if constexpr (std::is_same_v<T, Range>) {
        check(value.from, info, path + "/0", problems);
        check(value.to, info, path + "/1", problems);
        if (value.from > value.to)
            report(problems, path,
                   "a range begins with its smaller end, got [" + number_text(value.from) + ", " +
                       number_text(value.to) + "]");
    } else if constexpr (is_text<T>) {
        if (value.size() > longest_text<T>(info))
            report(problems, path,
                   in_quotes(value) + " is longer than " + std::to_string(longest_text<T>(info)) +
                       " bytes");
        else if (!is_plain_text(value))
            report(problems, path, in_quotes(value) + " holds control characters or is not UTF-8");
    } else if constexpr (is_choice<T>) {
        if (!T::allows(value.value))
            report(problems, path,
                   number_text(value.value) + " is not one of " + choice_names<T>());
    } else if constexpr (std::is_same_v<T, IdChoice>) {
        if (!value.allows(value.id))
            report(problems, path, not_allowed_message(in_quotes(value.id), value));
    } else if constexpr (NamedEnum<T>) {
        if (!enum_holds(value))
            report(problems, path,
                   "no name for value " + std::to_string(static_cast<long long>(value)) +
                       "; one of " + enum_names<T>());
    } else if constexpr (std::is_same_v<T, Upload>) {
        if (value.bytes.size() > info.most)
            report(problems, path,
                   std::to_string(value.bytes.size()) + " bytes; at most " +
                       std::to_string(info.most) + " are allowed");
    } else {
        static_assert(std::is_same_v<T, bool> || std::is_same_v<T, Colour>,
                      "no rule for this member type");
    }
}

/// Returns everything that is wrong with `value`, empty if it is valid.
template <Described T>
std::vector<Problem> problems_in(const T& value) {
    std::vector<Problem> problems;
    check(value, Info{.name = ""}, "", problems);
    return problems;
}

/// Throws InvalidInput with every problem of `value`; the first line of core's entry points.
template <Described T>
void require_valid(const T& value) {
    if (std::vector<Problem> problems = problems_in(value); !problems.empty())
        throw InvalidInput(std::move(problems));
}

}  // namespace sporeprint
