#include "api/batch/manifest.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <optional>
#include <set>

#include "api/http/query.h"
#include "api/http/text.h"
#include "core/math/random.h"
#include "core/params/types.h"
#include "core/problems.h"

namespace sporeprint::api {

namespace {

constexpr std::uint64_t most_items = 10'000'000'000, most_per_shard = 1'000'000;

/// Integers up to here are exact as numbers of JSON.
constexpr double most_integer = 9007199254740991.0;

/// Significant digits of a drawn number: an address stays readable.
constexpr int digits_of_draws = 6;

/// Distinguishes draws of manifests from those that grow shapes, whose purposes are small numbers.
constexpr std::uint32_t purposes_of_manifests = 0x80000000U;

/// Returns a number for a name, which never changes: 32-bit FNV-1a.
std::uint32_t number_of(std::string_view name) {
    std::uint32_t hash = 2166136261U;
    for (const char c : name)
        hash = (hash ^ static_cast<std::uint32_t>(static_cast<unsigned char>(c))) * 16777619U;
    return hash;
}

bool is_whole(const Value& value) {
    return value.is_number() && std::abs(value.as_number()) <= most_integer &&
           std::floor(value.as_number()) == value.as_number();
}

bool is_scalar(const Value& value) {
    return value.is_number() || value.is_string() || value.is_bool();
}

/// Returns a value as it stands in an address.
std::string text_of(const Value& value) {
    return value.is_string() ? value.as_string() : dump(value);
}

/// Returns a number with as many digits as draws have.
double rounded(double number) {
    std::array<char, 40> text{};
    const auto end = std::to_chars(text.data(), text.data() + text.size(), number,
                                   std::chars_format::scientific, digits_of_draws - 1);
    double out = number;
    std::from_chars(text.data(), end.ptr, out);
    return out;
}

/// Returns the names in braces of a path; nothing if a brace has no partner.
std::optional<std::vector<std::string>> names_in(std::string_view path) {
    std::vector<std::string> names;
    for (std::size_t at = 0; (at = path.find_first_of("{}", at)) != path.npos;) {
        const std::size_t end = path.find_first_of("{}", at + 1);
        if (path[at] != '{' || end == path.npos || path[end] != '}' || end == at + 1)
            return std::nullopt;
        names.emplace_back(path.substr(at + 1, end - at - 1));
        at = end + 1;
    }
    return names;
}

}  // namespace

std::string escaped_in_address(std::string_view text) {
    constexpr std::string_view hex = "0123456789ABCDEF", plain = "-._~!$'()*,;:@=";
    std::string out;
    for (const char c : text) {
        const auto byte = static_cast<unsigned char>(c);
        const bool is_word =
            (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
        if (is_word || plain.find(c) != plain.npos) {
            out += c;
            continue;
        }
        out += '%';
        out += hex[byte >> 4U];
        out += hex[byte & 15U];
    }
    return out;
}

/// Reads a spec into a manifest and gathers its problems.
class BatchManifest::Reader {
  public:
    explicit Reader(BatchManifest& out) : out_(out) {}

    void read_list(std::string_view text) {
        std::size_t number = 0;
        for (const std::string_view line : split(text, '\n')) {
            ++number;
            std::string_view target = trimmed(line);
            if (target.ends_with('\r')) target = trimmed(target.substr(0, target.size() - 1));
            if (target.empty() || target.starts_with('#')) continue;
            if (!target.starts_with('/'))
                problem("line " + std::to_string(number),
                        json_string(target) +
                            " is no path and query, all of an address after its host");
            out_.list_.emplace_back(target);
        }
        out_.count_ = out_.list_.size();
        if (out_.list_.empty()) problem("", "there is neither a line nor an object of JSON in it");
        finish();
    }

    void read_spec(std::string_view text) {
        const Value spec = parse(text, problems_);
        finish();
        for (const auto& [key, value] : spec.members()) read_member(key, value);
        check_path();
        check_count(spec.find("count"));
        finish();
    }

  private:
    void problem(const std::string& path, const std::string& message) {
        report(problems_, path, message);
    }

    void finish() const {
        if (!problems_.empty()) throw InvalidInput(problems_);
    }

    void refuse(const std::string& path, const Value& value, const std::string& allowed) {
        constexpr std::size_t most = 80;
        std::string text = value.is_array() || value.is_object() ? dump(value) : shown(value);
        if (text.size() > most) text = text.substr(0, most) + "...";
        problem(path, text + " is not allowed; allowed is " + allowed);
    }

    void read_member(const std::string& key, const Value& value) {
        const std::string path = "/" + key;
        if (key == "path") {
            if (!value.is_string() || !value.as_string().starts_with('/'))
                return refuse(path, value, "a path that begins with '/'");
            out_.path_ = value.as_string();
        } else if (key == "count") {
            whole(path, value, 1, most_items, out_.count_);
        } else if (key == "per_shard") {
            whole(path, value, 1, most_per_shard, out_.per_shard_);
        } else if (key == "seed") {
            whole(path, value, 0, UINT32_MAX, out_.seed_);
        } else if (key == "labels") {
            if (!value.is_bool()) return refuse(path, value, "true or false");
            out_.labels_ = value.as_bool();
        } else if (key == "draws") {
            if (!value.is_string() || (value.as_string() != "item" && value.as_string() != "round"))
                return refuse(path, value, "\"item\" or \"round\"");
            out_.draws_by_round_ = value.as_string() == "round";
        } else if (key == "generator") {
            if (!value.is_string() && !is_whole(value))
                return refuse(path, value, "a version such as \"37\"");
            out_.generator_ = text_of(value);
        } else if (key == "fixed" || key == "each" || key == "number" || key == "choice" ||
                   key == "uniform" || key == "integer") {
            if (!value.is_object()) return refuse(path, value, "an object of names");
            for (const auto& [name, rule] : value.members())
                read_rule(key, std::string(path).append("/").append(name), name, rule);
        } else {
            problem(path,
                    "there is no such member; there are path, count, seed, fixed, each, number, "
                    "choice, uniform, integer, draws, per_shard, labels, generator");
        }
    }

    template <class Whole>
    void whole(const std::string& path, const Value& value, std::uint64_t least, std::uint64_t most,
               Whole& out) {
        if (!is_whole(value) || value.as_number() < static_cast<double>(least) ||
            value.as_number() > static_cast<double>(most))
            return refuse(path, value,
                          "an integer of " + std::to_string(least) + ".." + std::to_string(most));
        out = static_cast<Whole>(value.as_number());
    }

    /// Returns the values of a list of them.
    std::vector<Value> values(const std::string& path, const Value& list) {
        const bool good = list.is_array() && !list.items().empty() &&
                          std::ranges::all_of(list.items(), is_scalar);
        if (!good) refuse(path, list, "a list of numbers, texts or truths, with at least one");
        return good ? list.items() : std::vector<Value>{Value(0)};
    }

    /// Returns whether a value is a range.
    bool is_range(const std::string& path, const Value& range, bool whole_numbers) {
        const bool good = range.is_array() && range.items().size() == 2 &&
                          range.items()[0].is_number() && range.items()[1].is_number() &&
                          range.items()[0].as_number() <= range.items()[1].as_number() &&
                          (!whole_numbers || std::ranges::all_of(range.items(), is_whole));
        if (!good)
            refuse(path, range,
                   whole_numbers ? "[first, last], two integers in their order"
                                 : "[from, to], two numbers in their order");
        return good;
    }

    void read_rule(const std::string& kind, const std::string& path, const std::string& name,
                   const Value& rule) {
        if (name.empty() || name.find_first_of("{}") != name.npos)
            return problem(path, "a name has at least one character, and no braces");
        if (!names_.insert(name).second)
            return problem(path, "this name has a rule already; one is allowed");
        if (kind == "fixed") {
            if (!is_scalar(rule)) return refuse(path, rule, "a number, a text, true or false");
            out_.rules_.push_back({name, rule});
        } else if (kind == "each") {
            Each each{values(path, rule)};
            const std::uint64_t size = each.values.size();
            if (out_.combinations_ > most_items / size)
                return problem(path, "there would be more than " + std::to_string(most_items) +
                                         " combinations");
            out_.combinations_ *= size;
            has_each_ = true;
            out_.rules_.push_back({name, std::move(each)});
        } else if (kind == "number") {
            if (!is_whole(rule)) return refuse(path, rule, "the first integer");
            out_.rules_.push_back({name, Number{rule.as_number()}});
        } else if (kind == "choice") {
            out_.rules_.push_back({name, Choice{values(path, rule)}});
        } else if (kind == "uniform") {
            if (is_range(path, rule, false))
                out_.rules_.push_back(
                    {name, Uniform{rule.items()[0].as_number(), rule.items()[1].as_number()}});
        } else if (is_range(path, rule, true)) {
            const double first = rule.items()[0].as_number(), last = rule.items()[1].as_number();
            if (last - first >= static_cast<double>(UINT32_MAX))
                return refuse(path, rule, "at most 4294967295 integers");
            out_.rules_.push_back({name, Integer{static_cast<std::int64_t>(first),
                                                 static_cast<std::uint64_t>(last - first) + 1}});
        }
    }

    void check_path() {
        if (out_.path_.empty()) return problem("/path", "it is missing: the path of the requests");
        const std::optional<std::vector<std::string>> names = names_in(out_.path_);
        if (!names)
            return problem("/path", json_string(out_.path_) +
                                        " has a brace without its partner, or without a name");
        for (const std::string& name : *names)
            if (!names_.contains(name))
                problem("/path", "{" + name + "} has no rule in fixed, each, number, choice, " +
                                     "uniform or integer");
    }

    void check_count(const Value* count) {
        if (count != nullptr) return;
        if (has_each_)
            out_.count_ = out_.combinations_;
        else
            problem("/count", "it is missing: the number of items");
    }

    BatchManifest& out_;
    std::vector<Problem> problems_;
    std::set<std::string> names_;
    bool has_each_ = false;
};

BatchManifest::BatchManifest(std::string_view text)
    : digest_(sha256_hex(text.data(), text.size())) {
    const std::size_t first = text.find_first_not_of(" \t\r\n");
    Reader reader(*this);
    if (first != text.npos && text[first] == '{')
        reader.read_spec(text);
    else
        reader.read_list(text);
}

Value BatchManifest::value_of(const Named& named, std::uint64_t number,
                              std::uint64_t combination) const {
    if (const auto* fixed = std::get_if<Value>(&named.rule)) return *fixed;
    if (const auto* each = std::get_if<Each>(&named.rule)) return each->values[combination];
    const std::uint64_t round = number / combinations_;
    if (const auto* from = std::get_if<Number>(&named.rule))
        return Value(from->first + static_cast<double>(round));
    const std::uint64_t draw = draws_by_round_ ? round : number;
    Random random(seed_, purposes_of_manifests | number_of(named.name),
                  static_cast<std::uint32_t>(draw), {static_cast<std::int32_t>(draw >> 32U), 0});
    if (const auto* choice = std::get_if<Choice>(&named.rule))
        return choice->values[std::uint64_t{random.bits()} * choice->values.size() >> 32U];
    if (const auto* integer = std::get_if<Integer>(&named.rule)) {
        const std::uint64_t step = std::uint64_t{random.bits()} * integer->values >> 32U;
        return Value(integer->first + static_cast<std::int64_t>(step));
    }
    const auto& range = std::get<Uniform>(named.rule);
    return Value(std::clamp(rounded(random.uniform(range.from, range.to)), range.from, range.to));
}

BatchItem BatchManifest::item(std::uint64_t number) const {
    if (!list_.empty()) return {list_[number], {}};
    BatchItem out;
    // The last name of `each` changes fastest.
    std::uint64_t rest = number % combinations_;
    std::vector<std::uint64_t> combination(rules_.size(), 0);
    for (std::size_t i = rules_.size(); i-- > 0;)
        if (const auto* each = std::get_if<Each>(&rules_[i].rule)) {
            combination[i] = rest % each->values.size();
            rest /= each->values.size();
        }
    std::string path = path_, query;
    for (std::size_t i = 0; i < rules_.size(); ++i) {
        const Named& named = rules_[i];
        Value value = value_of(named, number, combination[i]);
        const std::string text = escaped_in_address(text_of(value)),
                          braced = "{" + named.name + "}";
        const std::size_t at = path.find(braced);
        if (at == path.npos)
            query += (query.empty() ? "?" : "&") + escaped_in_address(named.name) + "=" + text;
        else
            for (std::size_t k = at; k != path.npos; k = path.find(braced, k + text.size()))
                path.replace(k, braced.size(), text);
        out.drawn.emplace_back(named.name, std::move(value));
    }
    out.target = path + query;
    return out;
}

}  // namespace sporeprint::api
