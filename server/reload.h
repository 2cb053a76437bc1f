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

/// Reads the sources again and passes the new state to the request handler. An invalid source
/// changes nothing and is logged with the reasons. The caller has to call Transport::invalidate().
///
/// returns  true if anything was replaced
bool reload(const Sources& sources, RequestHandler& request_handler, Log& log);

}  // namespace sporeprint::server
