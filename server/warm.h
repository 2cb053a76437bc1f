// Warming: what is sure to be asked for is made before the service is ready.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>

#include "server/log.h"
#include "server/reception.h"

namespace sporeprint::server {

/// Makes what a file lists, path and query a line (lines_of()), as many at once as there are slots, and logs each line of
/// which nothing can be made, with its number and the problem; at the end how many were good. None of it is fatal, not even
/// that there is no such file.
///
/// stop     asked now and then: whether to leave the rest
/// returns  how many lines were good
std::size_t warm(const std::filesystem::path& file, Reception& reception, Log& log,
                 const std::function<bool()>& stop);

}  // namespace sporeprint::server
