// Cache warming: listed resources are generated before the service is ready.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <string_view>

#include "server/operations/log.h"
#include "server/request_handler.h"

namespace sporeprint::server {

/// Generates the resources of a list, which has one path and query per line (lines_of()), as many
/// in parallel as the pool has threads. Each line that fails is logged with its number and the
/// problem, and at the end the number of successes. No line is fatal.
///
/// file     path of the list, for the log
/// text     content of the list
/// stop     polled between batches; true: skip the remaining lines
/// returns  the number of lines that succeeded
std::size_t warm(const std::filesystem::path& file, std::string_view text,
                 RequestHandler& request_handler, Log& log, const std::function<bool()>& stop);

}  // namespace sporeprint::server
