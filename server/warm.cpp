#include "server/warm.h"

#include <algorithm>
#include <chrono>
#include <fstream>
#include <span>
#include <sstream>

namespace sporeprint::server {

namespace {

std::string_view trimmed(std::string_view text) {
    constexpr const char* blanks = " \t\r";
    const std::size_t begin = text.find_first_not_of(blanks);
    if (begin == text.npos) return {};
    return text.substr(begin, text.find_last_not_of(blanks) - begin + 1);
}

/// The problem of an answer as the client would get it.
Value problem_of(const api::Answer& answer) {
    std::string text;
    for (const Slice& slice : answer.body)
        text.append(reinterpret_cast<const char*>(slice.data()), slice.size);
    std::vector<Problem> malformed;
    Value problem = parse(text, malformed);
    return malformed.empty() ? problem : Value(answer.status);
}

}  // namespace

std::vector<WarmTarget> warm_targets(std::string_view text) {
    std::vector<WarmTarget> targets;
    for (std::size_t line = 1; !text.empty(); ++line) {
        const std::size_t end = std::min(text.find('\n'), text.size());
        const std::string_view target = trimmed(text.substr(0, end));
        if (!target.empty() && target.front() != '#')
            targets.push_back({line, std::string(target)});
        text.remove_prefix(std::min(end + 1, text.size()));
    }
    return targets;
}

std::size_t warm(const std::filesystem::path& file, Reception& reception, Log& log,
                 const std::function<bool()>& stop) {
    const auto begun = std::chrono::steady_clock::now();
    std::ifstream in(file);
    std::ostringstream text;
    if (in) text << in.rdbuf();
    if (!in || in.bad()) {
        log.event(LogLevel::error, "the warm list cannot be read",
                  {{"file", Value(file.string())}});
        return 0;
    }
    const std::vector<WarmTarget> list = warm_targets(text.str());
    std::size_t good = 0, at = 0;
    while (at < list.size() && !stop()) {
        const std::size_t end = std::min(list.size(), at + 2 * reception.slots());
        std::vector<std::string> targets;
        for (std::size_t i = at; i < end; ++i) targets.push_back(list[i].target);
        const std::vector<api::Answer> answers = reception.warm(targets);
        for (std::size_t i = 0; i < answers.size(); ++i) {
            if (answers[i].status == 200)
                ++good;
            else
                log.event(LogLevel::warning, "nothing can be made of a line of the warm list",
                          {{"file", Value(file.string())},
                           {"line", Value(list[at + i].line)},
                           {"target", Value(list[at + i].target)},
                           {"problem", problem_of(answers[i])}});
        }
        at = end;
    }
    log.event(
        LogLevel::info, "warm",
        {{"file", Value(file.string())},
         {"good", Value(good)},
         {"faulty", Value(at - good)},
         {"left", Value(list.size() - at)},
         {"ms", Value(static_cast<double>(std::chrono::duration_cast<std::chrono::milliseconds>(
                                              std::chrono::steady_clock::now() - begun)
                                              .count()))}});
    return good;
}

}  // namespace sporeprint::server
