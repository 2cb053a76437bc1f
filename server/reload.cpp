#include "server/reload.h"

#include <exception>
#include <stdexcept>
#include <utility>

#include "core/atlas/atlas.h"
#include "core/problems.h"

namespace sporeprint::server {

namespace {

/// Calls `read` and logs the outcome.
///
/// returns  false if it has thrown
template <class Read>
bool try_to(const char* what, const std::filesystem::path& source, Log& log, Read read) {
    const auto log_failure = [&](const std::string& path, const std::string& why) {
        log.event(LogLevel::error, "reloading failed; all stays as it was",
                  {{"what", Value(what)},
                   {"source", Value(source.string())},
                   {"at", Value(path)},
                   {"why", Value(why)}});
    };
    try {
        read();
    } catch (const InvalidInput& invalid) {
        for (const Problem& problem : invalid.problems())
            log_failure(problem.path, problem.message);
        return false;
    } catch (const std::exception& error) {
        log_failure("", error.what());
        return false;
    }
    log.event(LogLevel::info, "reloaded",
              {{"what", Value(what)}, {"source", Value(source.string())}});
    return true;
}

}  // namespace

bool reload(const Sources& sources, RequestHandler& request_handler, Log& log) {
    AppState state = *request_handler.state();
    bool renewed = false;
    if (!sources.atlas.empty())
        renewed |= try_to("atlas", sources.atlas, log, [&] {
            auto service =
                std::make_shared<api::Service>(atlas_from(sources.atlas), *state.service);
            if (!service->self_test())
                throw std::runtime_error("the first thing made of it for a test could not be made");
            state.service = std::move(service);
        });
    if (!sources.keys.empty())
        renewed |= try_to("keys", sources.keys, log, [&] {
            state.signatures =
                std::make_shared<const Signatures>(Signatures::from_file(sources.keys));
        });
    if (renewed) request_handler.renew(std::move(state));
    return renewed;
}

}  // namespace sporeprint::server
