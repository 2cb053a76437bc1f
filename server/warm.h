// Cache warming: listed resources are generated before the service is ready.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <string_view>

#include "server/operations/log.h"
#include "server/request_handler.h"

namespace sporeprint::server {

/// Generates the resources of a list, which has one path and query per line (see lines_of()), in
/// batches of two lines per thread of the pool. A line that fails is logged with its number and the
/// problem, and the next ones are still generated. At the end the numbers of lines that succeeded,
/// failed and were skipped are logged.
///
/// file     path of the list, for the log
/// text     content of the list
/// stop     called before each batch; if it returns true, the remaining lines are skipped
/// returns  the number of lines that succeeded
std::size_t warm(const std::filesystem::path& file, std::string_view text,
                 RequestHandler& request_handler, Log& log, const std::function<bool()>& stop);

}  // namespace sporeprint::server
