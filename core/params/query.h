// Conversion between the pairs of a query string and parameter structs, with dotted names:
// "cap.radius=0.05".
#pragma once

#include <algorithm>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/params/describe.h"
#include "core/params/reader.h"
#include "core/params/value.h"

namespace sporeprint {

/// The decoded names and values of a query, in their order.
using QueryPairs = std::span<const std::pair<std::string, std::string>>;

/// States whether a member of type T can be named in a query: lists, ranges and uploads cannot.
template <class T>
inline constexpr bool in_query =
    !is_list<T> && !is_tuple<T> && !std::is_same_v<T, Range> && !std::is_same_v<T, Upload>;
template <class T>
inline constexpr bool in_query<std::optional<T>> = in_query<T>;

/// Reads the pairs of a query by name and records which names are known and which pairs have been
/// read, so that all others can be reported.
class QueryReader {
  public:
    QueryReader(QueryPairs pairs, std::vector<Problem>& problems)
        : pairs_(pairs), taken_(pairs.size(), false), problems_(problems) {}

    /// Returns the text of `name` and marks its pairs as read; nullptr if it is absent or repeated
    /// (which is reported).
    const std::string* take(const std::string& name) {
        known_.push_back(name);
        const std::string* text = nullptr;
        std::size_t count = 0;
        for (std::size_t i = 0; i < pairs_.size(); ++i) {
            if (pairs_[i].first != name) continue;
            taken_[i] = true;
            text = &pairs_[i].second;
            ++count;
        }
        if (count > 1) report(problems_, name, "given more than once");
        return count == 1 ? text : nullptr;
    }

    /// Returns true if any pair's name begins with `prefix`.
    bool mentions(std::string_view prefix) const {
        return std::any_of(pairs_.begin(), pairs_.end(),
                           [&](const auto& pair) { return pair.first.starts_with(prefix); });
    }

    /// Reports the name of each pair that take() has not returned as unknown, once per name.
    void refuse_the_rest() {
        for (std::size_t i = 0; i < pairs_.size() && problems_.size() < most_problems; ++i) {
            if (taken_[i]) continue;
            const std::string& name = pairs_[i].first;
            for (std::size_t k = i; k < pairs_.size(); ++k)
                if (pairs_[k].first == name) taken_[k] = true;
            report(problems_, printable(name), unknown_message(name, known_));
        }
    }

    std::vector<Problem>& problems() { return problems_; }

  private:
    QueryPairs pairs_;
    std::vector<bool> taken_;
    std::vector<std::string> known_;
    std::vector<Problem>& problems_;
};

/// Converts a query's text to the JSON value that read() expects for a member of type T. Text that
/// is not a number is reported for a numeric member, and false is returned. For all other members
/// unsuitable text becomes a JSON string, which read() then reports.
template <class T>
bool value_from_query(const std::string& text, Value& value, const std::string& name,
                      std::vector<Problem>& problems) {
    if constexpr (is_optional<T>) {
        return value_from_query<typename T::value_type>(text, value, name, problems);
    } else if constexpr (std::is_same_v<T, bool>) {
        if (text == "true" || text == "false")
            value = Value(text == "true");
        else
            value = Value(text);
    } else if constexpr (Number<T> || is_choice<T>) {
        double number = 0.0;
        if (!read_number(text, number)) {
            report(problems, name,
                   "expected " +
                       std::string(std::is_floating_point_v<T> ? "a number" : "a whole number") +
                       ", got " + in_quotes(text));
            return false;
        }
        value = Value(number);
    } else {
        value = Value(text);
    }
    return true;
}

/// True for structs and variants, whose members have names of their own in a query, and for optional
/// ones.
template <class T>
inline constexpr bool has_query_members = Described<T> || is_variant<T>;
template <class T>
inline constexpr bool has_query_members<std::optional<T>> = Described<T> || is_variant<T>;

/// Reads the members of a described struct or variant into `out`. In the query, their names are
/// preceded by `prefix`, such as "cap.".
template <class T>
void read_query_members(QueryReader& query, T& out, const std::string& prefix) {
    if constexpr (is_variant<T>) {
        const std::string name = prefix + form_key;
        if (const std::string* form = query.take(name); form && !FormsOf<T>::select(out, *form)) {
            std::string names;
            for (const char* one : FormsOf<T>::names)
                names += (names.empty() ? "" : ", ") + std::string(one);
            report(query.problems(), name, in_quotes(*form) + " is not one of " + names);
        }
        std::visit([&](auto& one) { read_query_members(query, one, prefix); }, out);
    } else {
        prove<T>();
        T::fields([&](auto member, const Info& sub) {
            using Member = std::remove_cvref_t<decltype(out.*member)>;
            const std::string name = prefix + sub.name;
            if constexpr (Described<Member> || is_variant<Member>) {
                read_query_members(query, out.*member, sub.name[0] ? name + '.' : prefix);
            } else if constexpr (is_optional<Member>) {
                using Inner = typename Member::value_type;
                if constexpr (Described<Inner> || is_variant<Inner>) {
                    // The optional is read even if it is absent, so that its names are known for
                    // suggestions.
                    Inner inner = out.*member ? *(out.*member) : Inner{};
                    read_query_members(query, inner, name + '.');
                    if (query.mentions(name + '.')) out.*member = std::move(inner);
                } else if constexpr (in_query<Inner>) {
                    Value value;
                    if (const std::string* text = query.take(name))
                        if (value_from_query<Member>(*text, value, name, query.problems()))
                            read(value, out.*member, sub, name, query.problems());
                }
            } else if constexpr (in_query<Member>) {
                Value value;
                if (const std::string* text = query.take(name))
                    if (value_from_query<Member>(*text, value, name, query.problems()))
                        read(value, out.*member, sub, name, query.problems());
            }
        });
    }
}

/// Returns the query name of a JSON pointer: "/cap/radius" is "cap.radius".
inline std::string query_name(std::string_view pointer) {
    std::string name(pointer.substr(pointer.starts_with('/') ? 1 : 0));
    std::replace(name.begin(), name.end(), '/', '.');
    return name;
}

/// Reads decoded pairs over the values already in `out`. Appends every problem, `path` being the
/// query name: unknown (with the name probably meant), repeated, malformed, out of range and, if
/// there is none, violations of the cross-field rules. Numbers follow JSON's grammar.
template <class T>
void read_query(QueryPairs pairs, T& out, std::vector<Problem>& problems) {
    const std::size_t before = problems.size();
    QueryReader query(pairs, problems);
    read_query_members(query, out, "");
    query.refuse_the_rest();
    if (problems.size() != before) return;
    for (Problem& problem : problems_in(out))
        report(problems, query_name(problem.path), std::move(problem.message));
}

/// Returns true if read_query() knows a name.
///
/// prefix  of all names, such as "cap."
template <class T>
bool is_query_name(std::string_view name, const std::string& prefix = "") {
    if constexpr (is_optional<T>) {
        return is_query_name<typename T::value_type>(name, prefix);
    } else if constexpr (is_variant<T>) {
        return name == prefix + form_key || [&]<class... Forms>(const std::variant<Forms...>*) {
            return (is_query_name<Forms>(name, prefix) || ...);
        }(static_cast<const T*>(nullptr));
    } else {
        bool found = false;
        const T* const none = nullptr;
        T::fields([&](auto member, const Info& sub) {
            using Member = std::remove_cvref_t<decltype(none->*member)>;
            const std::string own = prefix + sub.name;
            if constexpr (has_query_members<Member>)
                found = found || is_query_name<Member>(name, sub.name[0] ? own + '.' : prefix);
            else
                found = found || name == own;
        });
        return found;
    }
}

/// Appends the members of `value` that differ from `defaults`; see `query_text`.
template <class T>
void query_members(const T& value, const T& defaults, const std::string& prefix, std::string& out) {
    const auto pair = [&](const std::string& name, std::string_view text) {
        if (!out.empty()) out += '&';
        ((out += name) += '=') += percent_encoded(text);
    };
    if constexpr (is_variant<T>) {
        const bool same = value.index() == defaults.index();
        if (!same) pair(prefix + form_key, form_of(value));
        std::visit(
            [&](const auto& one) {
                using Alternative = std::remove_cvref_t<decltype(one)>;
                query_members(one, same ? std::get<Alternative>(defaults) : Alternative{}, prefix,
                              out);
            },
            value);
    } else {
        prove<T>();
        T::fields([&](auto member, const Info& sub) {
            const auto& mine = value.*member;
            const auto& standard = defaults.*member;
            using Member = std::remove_cvref_t<decltype(mine)>;
            const std::string name = prefix + sub.name;
            const auto leaf = [&](const auto& content) {
                const Value json = write(content);
                if (json.is_string())
                    pair(name, json.as_string());
                else
                    pair(name, dump(json));
            };
            if constexpr (Described<Member> || is_variant<Member>) {
                query_members(mine, standard, sub.name[0] ? name + '.' : prefix, out);
            } else if constexpr (is_optional<Member>) {
                using Inner = typename Member::value_type;
                if constexpr (Described<Inner> || is_variant<Inner>) {
                    if (mine) query_members(*mine, standard ? *standard : Inner{}, name + '.', out);
                } else if constexpr (in_query<Inner>) {
                    if (mine && mine != standard) leaf(*mine);
                }
            } else if constexpr (in_query<Member>) {
                if (!(mine == standard)) leaf(mine);
            }
        });
    }
}

/// Returns the query, without '?', that makes `value` from `defaults`: "a=1&b.c=0.5", only
/// differences, in field order, shortest digits, percent-encoded. Lists, ranges and uploads cannot
/// be expressed, nor that an optional set in `defaults` is empty in `value`.
template <class T>
std::string query_text(const T& value, const T& defaults = {}) {
    std::string out;
    query_members(value, defaults, "", out);
    return out;
}

}  // namespace sporeprint
