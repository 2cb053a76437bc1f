#include "server/warm.h"

#include <algorithm>
#include <chrono>
#include <string>
#include <vector>

#include "api/http/response_text.h"
#include "server/operations/text_files.h"

namespace sporeprint::server {

std::size_t warm(const std::filesystem::path& file, std::string_view text,
                 RequestHandler& request_handler, Log& log, const std::function<bool()>& stop) {
    const auto begun = std::chrono::steady_clock::now();
    const std::vector<TextLine> list = lines_of(text);
    std::size_t good = 0, at = 0;
    while (at < list.size() && !stop()) {
        const std::size_t end = std::min(list.size(), at + 2 * request_handler.threads());
        std::vector<std::string> targets;
        for (std::size_t i = at; i < end; ++i) targets.emplace_back(list[i].text);
        const std::vector<api::Response> responses = request_handler.warm(targets);
        for (std::size_t i = 0; i < responses.size(); ++i) {
            if (responses[i].status == 200)
                ++good;
            else
                log.event(LogLevel::warning, "nothing can be made of a line of the warm list",
                          {{"file", Value(file.string())},
                           {"line", Value(list[at + i].number)},
                           {"target", Value(redacted(list[at + i].text))},
                           {"problem", api::problem_of(responses[i])}});
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
