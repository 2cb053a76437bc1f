#include "server/warm.h"

#include <algorithm>
#include <chrono>
#include <string>
#include <vector>

#include "server/text_files.h"

namespace sporeprint::server {

namespace {

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

std::size_t warm(const std::filesystem::path& file, std::string_view text, Reception& reception,
                 Log& log, const std::function<bool()>& stop) {
    const auto begun = std::chrono::steady_clock::now();
    const std::vector<TextLine> list = lines_of(text);
    std::size_t good = 0, at = 0;
    while (at < list.size() && !stop()) {
        const std::size_t end = std::min(list.size(), at + 2 * reception.slots());
        std::vector<std::string> targets;
        for (std::size_t i = at; i < end; ++i) targets.emplace_back(list[i].text);
        const std::vector<api::Answer> answers = reception.warm(targets);
        for (std::size_t i = 0; i < answers.size(); ++i) {
            if (answers[i].status == 200)
                ++good;
            else
                log.event(LogLevel::warning, "nothing can be made of a line of the warm list",
                          {{"file", Value(file.string())},
                           {"line", Value(list[at + i].number)},
                           {"target", Value(redacted(list[at + i].text))},
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
