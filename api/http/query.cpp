#include "api/http/query.h"

#include "core/params/messages.h"

namespace sporeprint::api {

namespace {

int hex_digit(char c) {
    if (c >= '0' && c <= '9') return c - '0';
    if (c >= 'a' && c <= 'f') return c - 'a' + 10;
    if (c >= 'A' && c <= 'F') return c - 'A' + 10;
    return -1;
}

/// Decodes one piece of a target and adds a problem for whatever is malformed.
std::string decoded(std::string_view text, const char* what, std::vector<Problem>& problems) {
    std::string out;
    if (!percent_decode(text, out))
        report(problems, what,
               in_quotes(text) + " has a '%' without two hexadecimal digits after it");
    else if (!is_plain_text(out))
        report(problems, what, in_quotes(out) + " holds control characters or is not UTF-8");
    else
        return out;
    return {};
}

}  // namespace

bool percent_decode(std::string_view text, std::string& out) {
    out.clear();
    for (std::size_t i = 0; i < text.size(); ++i) {
        if (text[i] != '%') {
            out += text[i];
            continue;
        }
        const int high = i + 1 < text.size() ? hex_digit(text[i + 1]) : -1;
        const int low = i + 2 < text.size() ? hex_digit(text[i + 2]) : -1;
        if (high < 0 || low < 0) return false;
        out += static_cast<char>(high * 16 + low);
        i += 2;
    }
    return true;
}

std::string_view origin_form(std::string_view target) {
    for (const std::string_view scheme : {"http://", "https://"}) {
        if (!target.starts_with(scheme)) continue;
        const std::size_t slash = target.find_first_of("/?", scheme.size());
        return slash == std::string_view::npos ? "/" : target.substr(slash);
    }
    return target;
}

std::string_view below(std::string_view base, std::string_view target) {
    target = origin_form(target);
    if (base.empty() || !target.starts_with(base)) return target;
    const std::string_view rest = target.substr(base.size());
    return rest.starts_with('/') ? rest : target;
}

Target split_target(std::string_view target, std::vector<Problem>& problems) {
    Target out;
    target = origin_form(target);
    const std::size_t spot = target.find('?');
    const std::string_view path = target.substr(0, spot);
    out.path = decoded(path, "path", problems);
    if (!path.starts_with('/')) {
        if (path != "*") report(problems, "path", "a path begins with '/'");
        return out;
    }
    for (std::size_t begin = 1; begin <= path.size();) {
        const std::size_t end = std::min(path.find('/', begin), path.size());
        std::string segment;
        if (percent_decode(path.substr(begin, end - begin), segment))
            out.segments.push_back(std::move(segment));
        begin = end + 1;
    }
    if (spot == std::string_view::npos || spot + 1 == target.size()) return out;
    const std::string_view query = target.substr(spot + 1);
    for (std::size_t begin = 0; begin <= query.size();) {
        const std::size_t end = std::min(query.find('&', begin), query.size());
        const std::string_view part = query.substr(begin, end - begin);
        begin = end + 1;
        const std::size_t equals = part.find('=');
        if (part.empty()) {
            report(problems, "query", "there is an empty parameter at a '&'");
            continue;
        }
        const std::size_t before = problems.size();
        std::string key = decoded(part.substr(0, equals), "query", problems);
        if (problems.size() > before) continue;
        if (equals == std::string_view::npos) {
            report(problems, printable(key), "has no value; write " + printable(key) + "=...");
            continue;
        }
        const std::string parameter = printable(key);
        std::string value = decoded(part.substr(equals + 1), parameter.c_str(), problems);
        if (problems.size() == before) out.query.emplace_back(std::move(key), std::move(value));
    }
    return out;
}

}  // namespace sporeprint::api
