// Warming: what is sure to be asked for is made before the service is ready.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <string_view>

#include "server/operations/log.h"
#include "server/request_handler.h"

namespace sporeprint::server {

/// Makes what a list names, path and query a line (lines_of()), as many at once as there are slots, and logs each line of
/// which nothing can be made, with its number and the problem; at the end how many were good. No line is fatal.
///
/// file     where the list is from, for the log
/// text     of the list
/// stop     asked now and then: whether to leave the rest
/// returns  how many lines were good
std::size_t warm(const std::filesystem::path& file, std::string_view text,
                 RequestHandler& request_handler, Log& log, const std::function<bool()>& stop);

}  // namespace sporeprint::server
