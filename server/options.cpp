#include "server/options.h"

#include <algorithm>

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

/// Reads texts over `options`; `named` makes the path of a problem from an option's name.
template <class Named>
void read_given(const Given& given, Named named, Options& options, std::vector<Problem>& problems) {
    std::vector<Problem> found;
    QueryReader reader(given, found);
    read_query_members(reader, options, "");
    reader.refuse_the_rest();
    for (Problem& problem : found)
        report(problems, named(problem.path), std::move(problem.message));
}

}  // namespace

void Options::check(const std::string& path, std::vector<Problem>& problems) const {
    const auto bad = [](std::string_view text, std::string_view marks) {
        return std::any_of(text.begin(), text.end(), [&](char c) {
            return static_cast<unsigned char>(c) < 0x20 || c == 0x7f ||
                   marks.find(c) != std::string_view::npos;
        });
    };
    if (host.empty() || bad(host, " /"))
        report(problems, path + "/host", in_quotes(host) + " is not a host name or address");
    if (bad(allow_origin, " ,"))
        report(problems, path + "/allow_origin",
               in_quotes(allow_origin) + " is not one origin; allowed are * and https://a.example");
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

Given given_by_environment(const char* (*variable)(const char*)) {
    Given given;
    for (const OptionLine& line : option_lines()) {
        const char* text = variable(line.variable.c_str());
        if (text && *text) given.emplace_back(line.name, text);
    }
    return given;
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
        // A rule between options is told by the flag, wherever the values came from.
        for (Problem& problem : found)
            report(problems, flag_of(problem.path.substr(1)), std::move(problem.message));
    }
    if (!problems.empty()) throw InvalidInput(std::move(problems));
    return options;
}

std::string config_text(const Options& options) { return dump(write(options), 2); }

}  // namespace sporeprint::server
