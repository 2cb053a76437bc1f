// Reloading: templates and signing keys are read again while requests are served.
#pragma once

#include <filesystem>

#include "server/operations/log.h"
#include "server/request_handler.h"

namespace sporeprint::server {

/// The sources that a reload reads; an empty path is skipped.
struct Sources {
    std::filesystem::path atlas;  ///< folder of templates
    std::filesystem::path keys;   ///< file of signing keys
};

/// Reads the sources again and passes the new state to the request handler. The sources are
/// independent: one that is invalid, or whose templates fail Service::self_test(), is logged with
/// the reasons and leaves its part of the state as it was, while the other is still replaced. The
/// caller has to call Transport::invalidate() afterwards.
///
/// returns  true if at least one source was replaced
bool reload(const Sources& sources, RequestHandler& request_handler, Log& log);

}  // namespace sporeprint::server
