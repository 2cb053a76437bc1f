// Canonical keys: requests that mean the same have the same key, whatever their spelling of
// numbers, escapes, order, method or signature; other requests have other keys.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "api/service.h"
#include "core/atlas/atlas.h"
#include "core/math/random.h"
#include "server/operations/signatures.h"
#include "tests/api/support.h"

namespace sporeprint::server::canonical_key_test {
namespace {

using api::Key;

/// The values of all parameters of a request, including those that it does not name.
struct RequestValues {
    std::vector<std::pair<std::string, int>> mix;  ///< thousandths, by id
    std::map<std::string, double> values;
    bool operator==(const RequestValues&) const = default;
};

/// A parameter and its range.
struct Parameter {
    std::string_view name;
    double standard;  ///< value if not named; `own`: that of the species
    double from, to;
    bool whole;
};

constexpr double own = -1e9;

constexpr std::array<Parameter, 9> parameters = {{
    {"seed", 1, 0, 4294967295.0, true},
    {"age", 0.6, 0, 1, false},
    {"size", 1, 0.25, 4, false},
    {"variation", 0.5, 0, 1, false},
    {"lod", 0, 0, 3, true},
    {"deformation.bend_deg", own, 0, 20, false},
    {"deformation.lean_deg", own, 0, 10, false},
    {"weathering.fade", own, 0, 1, false},
    {"weathering.dew", own, 0, 1, false},
}};

constexpr std::array<std::string_view, 4> species = {"amanita_muscaria", "boletus_edulis",
                                                     "lepista_nuda", "russula_vinosa"};

/// The random draws of one case.
class Draws {
  public:
    explicit Draws(std::uint32_t seed) : random_(seed, 0x6d65616e) {}

    std::size_t below(std::size_t count) {
        return random_.bits() % static_cast<std::uint32_t>(count);
    }
    bool one_in(std::size_t count) { return below(count) == 0; }

    double value_of(const Parameter& parameter) {
        // Few different values, so that two requests often share one; the standard is one of them.
        if (one_in(3)) return parameter.standard;
        const double value =
            parameter.from + (parameter.to - parameter.from) * static_cast<double>(below(9)) / 8.0;
        return parameter.whole ? static_cast<double>(static_cast<std::uint32_t>(value)) : value;
    }

    RequestValues request_values() {
        RequestValues out;
        int left = 1000;
        const std::size_t last = below(species.size());
        for (std::size_t i = 0; i < last; ++i) {
            const int weight = 1 + static_cast<int>(below(static_cast<std::size_t>(left) / 2));
            out.mix.emplace_back(species[i], weight);
            left -= weight;
        }
        out.mix.emplace_back(species[last], left);
        for (const Parameter& parameter : parameters)
            out.values[std::string(parameter.name)] = value_of(parameter);
        return out;
    }

    template <class T>
    void shuffle(std::vector<T>& things) {
        for (std::size_t i = 0; i + 1 < things.size(); ++i)
            std::swap(things[i], things[i + below(things.size() - i)]);
    }

    /// Writes a number in a random format.
    std::string number(double value) {
        std::array<char, 64> text{};
        const auto format = one_in(3) ? std::chars_format::scientific : std::chars_format::general;
        std::string out(text.data(),
                        std::to_chars(text.data(), text.data() + text.size(), value, format).ptr);
        if (out.find_first_of(".e") == std::string::npos && one_in(3)) out += ".0";
        if (out.find('.') != std::string::npos && out.find('e') == std::string::npos && one_in(3))
            out += "000";
        return out;
    }

    std::string escaped(std::string_view text) {
        constexpr std::string_view lower = "0123456789abcdef", upper = "0123456789ABCDEF";
        std::string out;
        for (const char c : text) {
            if (!one_in(8)) {
                out += c;
                continue;
            }
            const auto byte = static_cast<unsigned char>(c);
            const std::string_view digits = one_in(2) ? lower : upper;
            out += {'%', digits[byte >> 4U], digits[byte & 15U]};
        }
        return out;
    }

  private:
    Random random_;
};

/// Writes the weights in a random unit and order.
std::vector<std::pair<std::string, std::string>> spelled_mix(const RequestValues& request_values,
                                                             Draws& draws) {
    constexpr std::array<double, 4> units = {1.0, 2.0, 0.125, 4096.0};  // exact in binary
    const double unit = units[draws.below(units.size())];
    std::vector<std::pair<std::string, std::string>> parts;
    for (const auto& [id, weight] : request_values.mix)
        parts.emplace_back(id, draws.number(weight * unit));
    draws.shuffle(parts);
    return parts;
}

/// Returns the parameters that a spelling names: all that are not standard, and some that are.
std::vector<std::pair<std::string, double>> named_parameters(const RequestValues& request_values,
                                                             Draws& draws) {
    std::vector<std::pair<std::string, double>> out;
    for (const Parameter& parameter : parameters) {
        const double value = request_values.values.at(std::string(parameter.name));
        if (value == own || (value == parameter.standard && !draws.one_in(3))) continue;
        out.emplace_back(parameter.name, value);
    }
    draws.shuffle(out);
    return out;
}

/// Writes the request as the target of a GET.
std::string target_of(const RequestValues& request_values, Draws& draws) {
    std::string target = "/v1/mushrooms/", mix;
    for (const auto& [id, weight] : spelled_mix(request_values, draws)) {
        if (!mix.empty()) mix += ',';
        mix += id;
        if (request_values.mix.size() > 1 || draws.one_in(2)) mix += ':' + weight;
    }
    target += draws.escaped(mix + ".glb");
    char before = '?';
    for (const auto& [name, value] : named_parameters(request_values, draws)) {
        target += before + draws.escaped(name) + '=' + draws.escaped(draws.number(value));
        before = '&';
    }
    return target;
}

/// Writes the same request as the body of a POST.
std::string body_of(const RequestValues& request_values, Draws& draws) {
    std::vector<std::string> members;
    std::string mix;
    for (const auto& [id, weight] : spelled_mix(request_values, draws)) {
        if (!mix.empty()) mix += ", ";
        mix += '"' + id + "\": " + weight;
    }
    members.push_back("\"mix\": {" + mix + "}");
    std::map<std::string, std::string> groups;
    for (const auto& [name, value] : named_parameters(request_values, draws)) {
        const auto dot = name.find('.');
        const std::string member = '"' + (dot == std::string::npos ? name : name.substr(dot + 1)) +
                                   "\":" + draws.number(value);
        if (dot == std::string::npos) {
            members.push_back(member);
        } else {
            std::string& group = groups[name.substr(0, dot)];
            group += (group.empty() ? "" : " , ") + member;
        }
    }
    for (const auto& [name, inside] : groups) members.push_back('"' + name + "\":{" + inside + '}');
    draws.shuffle(members);
    std::string body;
    for (const std::string& member : members) body += (body.empty() ? "{" : ",") + member;
    return body + '}';
}

/// Returns the key of a request; fails with the response if it is refused.
Key key_of(const api::Request& request) {
    static api::Service service(built_in_atlas(), api::ServiceOptions{});
    const auto planned = api::test::plan(service, request);
    if (const auto* job = std::get_if<api::Job>(&planned)) return job->key;
    const auto& response = std::get<api::Response>(planned);
    RC_FAIL(request.target + ' ' + request.body + ": " + std::to_string(response.status) + ' ' +
            api::test::text_of(response));
    return {};
}

Key key_of_get(const std::string& target) { return key_of(api::test::get(target)); }

Key key_of_post(const std::string& body) { return key_of(api::test::post(body)); }

RC_GTEST_PROP(CanonicalKeyProperty, IsTheSameForAllSpellings, ()) {
    Draws draws(*rc::gen::arbitrary<std::uint32_t>());
    const RequestValues request_values = draws.request_values();
    const Key key = key_of_get(target_of(request_values, draws));
    RC_ASSERT(key_of_get(target_of(request_values, draws)) == key);
    RC_ASSERT(key_of_get("http://any.host:8080" + target_of(request_values, draws)) == key);
    RC_ASSERT(key_of_post(body_of(request_values, draws)) == key);
}

RC_GTEST_PROP(CanonicalKeyProperty, DiffersForDifferentRequests, ()) {
    Draws draws(*rc::gen::arbitrary<std::uint32_t>());
    const RequestValues one = draws.request_values();
    RequestValues other = one;
    if (draws.one_in(4)) other.mix = draws.request_values().mix;
    for (const Parameter& parameter : parameters)
        if (draws.one_in(parameters.size()))
            other.values[std::string(parameter.name)] = draws.value_of(parameter);
    RC_CLASSIFY(one == other);
    RC_ASSERT((key_of_get(target_of(one, draws)) == key_of_get(target_of(other, draws))) ==
              (one == other));
}

RC_GTEST_PROP(CanonicalKeyProperty, IncludesNeitherSignatureNorExpiry, ()) {
    Draws draws(*rc::gen::arbitrary<std::uint32_t>());
    constexpr std::int64_t now = 1'900'000'000;
    const Signatures signatures({{"new", std::string(32, 'n')}, {"old", std::string(32, 'o')}});
    const Signatures before({{"old", std::string(32, 'o')}});
    const RequestValues request_values = draws.request_values();
    const std::string target = target_of(request_values, draws);
    const Key key = key_of_get(target);
    for (const Signatures* by : {&signatures, &before})
        for (const std::int64_t left :
             {std::int64_t{0}, static_cast<std::int64_t>(draws.below(9999))}) {
            const std::string generated = by->signed_target(
                "GET", target, "", left == 0 ? std::nullopt : std::optional(now + left));
            const SignatureCheck checked = signatures.check("GET", generated, "", now);
            RC_ASSERT(checked.is_valid);
            RC_ASSERT(key_of_get(checked.target) == key);
        }
}

}  // namespace
}  // namespace sporeprint::server::canonical_key_test
