// Reloading: files that the service was started with are read again, while it serves.
#pragma once

#include <filesystem>

#include "server/operations/log.h"
#include "server/request_handler.h"

namespace sporeprint::server {

/// What is read again; an empty path is not.
struct Sources {
    std::filesystem::path atlas;  ///< folder of templates
    std::filesystem::path keys;   ///< file of signing keys
};

/// Reads them again and gives the reception what they hold now. Of a source that is no good all stays as it was, and the log
/// names what is wrong. Answers that were ready to be given again are the transport's to forget.
///
/// returns  whether anything was put in the place of another
bool reload(const Sources& sources, RequestHandler& request_handler, Log& log);

}  // namespace sporeprint::server
