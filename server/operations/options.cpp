#include "server/operations/options.h"

#include <algorithm>
#include <charconv>

#include "core/params/messages.h"
#include "core/params/query.h"
#include "core/params/reader.h"
#include "core/params/value.h"

namespace sporeprint::server {

namespace {

std::string flag_of(std::string name) {
    std::replace(name.begin(), name.end(), '_', '-');
    return "--" + name;
}

std::string variable_of(std::string name) {
    for (char& c : name)
        if (c >= 'a' && c <= 'z') c = static_cast<char>(c - 'a' + 'A');
    return "SPOREPRINT_" + name;
}

template <class T>
std::string allowed(const Info& info) {
    if constexpr (NamedEnum<T>)
        return enum_names<T>();
    else if constexpr (Number<T>)
        return number_text(info.min) + ".." + number_text(info.max);
    else
        return {};
}

/// Overwrites members of `options` by the texts given; `named` converts an option's name to the
/// path of its problems.
template <class Named>
void read_given(const Given& given, Named named, Options& options, std::vector<Problem>& problems) {
    std::vector<Problem> found;
    QueryReader reader(given, found);
    read_query_members(reader, options, "");
    reader.refuse_the_rest();
    for (Problem& problem : found)
        report(problems, named(problem.path), std::move(problem.message));
}

constexpr std::string_view variable_prefix = "SPOREPRINT_";

bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool is_lower(char c) { return c >= 'a' && c <= 'z'; }

/// Returns true for a port, 1 to 65535 in decimal digits without leading zeros.
bool is_port(std::string_view text) {
    std::uint16_t port = 0;
    const char* const end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(text.data(), end, port);
    return stop == end && error == std::errc() && text.front() != '0';
}

/// Returns true for texts like "tcp://10.0.0.1:8080" or "udp://[fd00::1]:53".
bool is_service_address(std::string_view text) {
    const std::size_t scheme = text.find("://");
    if (scheme == text.npos) return false;
    const std::string_view protocol = text.substr(0, scheme);
    if (protocol != "tcp" && protocol != "udp" && protocol != "sctp") return false;
    text.remove_prefix(scheme + 3);
    const std::size_t colon = text.rfind(':');
    if (colon == text.npos || !is_port(text.substr(colon + 1))) return false;
    const std::string_view host = text.substr(0, colon);
    if (host.starts_with('[') && host.ends_with(']')) {
        const auto address = address_in(host.substr(1, host.size() - 2));
        return address && !address->is_v4();
    }
    const auto address = address_in(host);
    return address && address->is_v4();
}

/// Returns true for a host as browsers write it into an origin: a lower-case name, or an address in
/// canonical form.
bool is_origin_host(std::string_view host) {
    if (host.starts_with('[') && host.ends_with(']')) {
        const std::string_view inside = host.substr(1, host.size() - 2);
        const auto address = address_in(inside);
        return address && !address->is_v4() && text_of(*address) == inside;
    }
    const bool plain = std::all_of(host.begin(), host.end(), [](char c) {
        return is_lower(c) || is_digit(c) || c == '-' || c == '_' || c == '.';
    });
    return plain && !host.empty() && host.front() != '.' && host.find("..") == host.npos;
}

/// Returns true for an origin as browsers serialize it, https://a.example:8443. Browsers compare
/// origins byte by byte, so capitals, a default port, a path or a trailing slash would never match.
///
/// source  RFC 6454 section 6.2
bool is_serialized_origin(std::string_view text) {
    const std::size_t colon = text.find("://");
    if (colon == text.npos || colon == 0) return false;
    const std::string_view scheme = text.substr(0, colon);
    if (!is_lower(scheme.front()) || !std::all_of(scheme.begin(), scheme.end(), [](char c) {
            return is_lower(c) || is_digit(c) || c == '+' || c == '-' || c == '.';
        }))
        return false;
    const std::string_view authority = text.substr(colon + 3);
    const std::size_t bracket = authority.rfind(']');
    const std::size_t port = authority.find(':', bracket == authority.npos ? 0 : bracket);
    if (!is_origin_host(authority.substr(0, port))) return false;
    if (port == authority.npos) return true;
    const std::string_view number = authority.substr(port + 1);
    const bool own = (scheme == "http" && number == "80") || (scheme == "https" && number == "443");
    return is_port(number) && !own;
}

/// Returns the reason why a text is not a valid base path; empty if it is one.
std::string error_in_base_path(std::string_view text) {
    if (text.empty()) return {};
    if (!text.starts_with('/')) return "does not begin with '/'";
    if (text.ends_with('/')) return "ends with '/'";
    const auto is_hex = [](char c) {
        return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'f') || (c >= 'A' && c <= 'F');
    };
    for (std::size_t i = 0; i < text.size(); ++i) {
        const char c = text[i];
        const bool letter =
            (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
        if (c == '%') {
            if (i + 2 >= text.size() || !is_hex(text[i + 1]) || !is_hex(text[i + 2]))
                return "has a '%' without two hexadecimal digits after it";
        } else if (c == '?' || c == '#') {
            return "has a query or a fragment";
        } else if (!letter &&
                   std::string_view("/-._~!$&'()*+,;=:@").find(c) == std::string_view::npos) {
            return "holds what has to be percent-encoded in a path";
        }
    }
    for (std::size_t begin = 1; begin <= text.size();) {
        const std::size_t end = std::min(text.find('/', begin), text.size());
        const std::string_view segment = text.substr(begin, end - begin);
        if (segment.empty() || segment == "." || segment == "..")
            return "has an empty segment, '.' or '..'";
        begin = end + 1;
    }
    return {};
}

}  // namespace

void Options::check(const std::string& path, std::vector<Problem>& problems) const {
    const auto bad = [](std::string_view text, std::string_view forbidden) {
        return std::any_of(text.begin(), text.end(), [&](char c) {
            return static_cast<unsigned char>(c) < 0x20 || c == 0x7f ||
                   forbidden.find(c) != std::string_view::npos;
        });
    };
    if (host.empty() || bad(host, " /"))
        report(problems, path + "/host", in_quotes(host) + " is not a host name or address");
    if (!allow_origin.empty() && allow_origin.view() != "*" && !is_serialized_origin(allow_origin))
        report(
            problems, path + "/allow_origin",
            in_quotes(allow_origin) +
                " is not an origin; allowed are *, nothing, or one as a browser sends it: scheme "
                "and host in lower case and no path, https://a.example or "
                "http://localhost:8080 (null, which any page can have, is not)");
    if (const std::string why = error_in_base_path(base_path); !why.empty())
        report(problems, path + "/base_path",
               in_quotes(base_path) + ' ' + why + "; give one like /sporeprint, or none");
    try {
        static_cast<void>(Networks(trusted_proxies));
    } catch (const InvalidInput& invalid) {
        for (const Problem& problem : invalid.problems())
            report(problems, path + "/trusted_proxies", problem.message);
    }
    if (metrics_port != 0 && metrics_port == port)
        report(problems, path + "/metrics_port",
               std::to_string(metrics_port) + " is the main port too; allowed is any other");
}

std::vector<OptionLine> option_lines() {
    std::vector<OptionLine> lines;
    const Options defaults;
    Options::fields([&](auto member, const Info& info) {
        using Member = std::remove_cvref_t<decltype(defaults.*member)>;
        const Value value = write(defaults.*member);
        std::string help = info.doc;
        const std::string range = allowed<Member>(info);
        std::string more = range.empty() ? "" : range;
        if (*info.unit) more += (more.empty() ? "" : " ") + std::string(info.unit);
        const std::string text = value.is_string() ? value.as_string() : dump(value);
        if (!text.empty()) more += (more.empty() ? "default " : ", default ") + text;
        if (!more.empty()) help += " (" + more + ')';
        lines.push_back({info.name, flag_of(info.name), variable_of(info.name), std::move(help)});
    });
    return lines;
}

Environment environment_from(const Given& variables) {
    constexpr const char* config = "SPOREPRINT_CONFIG";
    const std::vector<OptionLine> lines = option_lines();
    // Compared without their common prefix, which would make all of them similar.
    const std::size_t common = variable_prefix.size();
    std::vector<std::string> known = {std::string(config).substr(common)};
    for (const OptionLine& line : lines) known.push_back(line.variable.substr(common));
    Environment environment;
    for (const auto& [name, value] : variables) {
        if (!name.starts_with(variable_prefix)) continue;
        const auto line = std::find_if(lines.begin(), lines.end(),
                                       [&n = name](const auto& one) { return one.variable == n; });
        if (is_service_link(name, value)) {
            environment.service_links.push_back(name);
        } else if (line != lines.end()) {
            if (!value.empty()) environment.options.emplace_back(line->name, value);
        } else if (name == config) {
            environment.config = value;
        } else {
            const std::string meant(closest(std::string_view(name).substr(common), known));
            environment.unknown.push_back(
                printable(name) +
                (meant.empty() ? "" : "; did you mean 'SPOREPRINT_" + meant + "'?"));
        }
    }
    return environment;
}

bool is_service_link(std::string_view name, std::string_view value) {
    const auto is_name = [](std::string_view text) {
        return !text.empty() && std::all_of(text.begin(), text.end(), [](char c) {
            return (c >= 'A' && c <= 'Z') || is_digit(c) || c == '_';
        });
    };
    const auto is_address = [](std::string_view text) { return address_in(text).has_value(); };
    const auto is_protocol = [](std::string_view text) {
        return text == "tcp" || text == "udp" || text == "sctp";
    };
    constexpr std::string_view service = "SPOREPRINT";
    if (!name.starts_with(variable_prefix)) return false;
    std::string_view rest =
        name.substr(service.size());  // `at` is the start of the name or an underscore
    for (std::size_t at = 0; at != rest.npos; at = rest.find('_', at + 1)) {
        std::string_view ending = rest.substr(at);
        if (at > 0 && !is_name(rest.substr(1, at - 1))) return false;
        if (ending == "_SERVICE_HOST" && is_address(value)) return true;
        if (ending == "_SERVICE_PORT" && is_port(value)) return true;
        if (ending.starts_with("_SERVICE_PORT_") && is_name(ending.substr(14)) && is_port(value))
            return true;
        if (ending == "_PORT" && is_service_address(value)) return true;
        if (!ending.starts_with("_PORT_")) continue;
        ending.remove_prefix(6);
        const std::size_t digits = std::min(ending.find_first_not_of("0123456789"), ending.size());
        if (!is_port(ending.substr(0, digits))) continue;
        ending.remove_prefix(digits);
        for (const std::string_view protocol : {"_TCP", "_UDP", "_SCTP"}) {
            if (!ending.starts_with(protocol)) continue;
            const std::string_view what = ending.substr(protocol.size());
            if ((what.empty() && is_service_address(value)) ||
                (what == "_PROTO" && is_protocol(value)) || (what == "_PORT" && is_port(value)) ||
                (what == "_ADDR" && is_address(value)))
                return true;
        }
    }
    return false;
}

Options options_from(const std::string& file_name, std::string_view file, const Given& environment,
                     const Given& flags) {
    Options options;
    std::vector<Problem> problems, found;
    if (!file.empty()) {
        const Value json = parse(file, found);
        if (found.empty()) read(json, options, Info{.name = ""}, "", found);
        for (Problem& problem : found)
            report(problems,
                   file_name + (problem.path.empty() ? "" : ": " + problem.path.substr(1)),
                   std::move(problem.message));
    }
    read_given(environment, variable_of, options, problems);
    read_given(flags, flag_of, options, problems);
    if (problems.empty()) {
        found.clear();
        options.check("", found);
        // Errors of check() name the flag, whatever the source of the value.
        for (Problem& problem : found)
            report(problems, flag_of(problem.path.substr(1)), std::move(problem.message));
    }
    if (!problems.empty()) throw InvalidInput(std::move(problems));
    return options;
}

std::string config_text(const Options& options) { return dump(write(options), 2); }

}  // namespace sporeprint::server
