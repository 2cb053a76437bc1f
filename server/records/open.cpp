#include "server/records/open.h"

#include <string>

#include "core/params/messages.h"
#include "core/problems.h"
#include "server/records/sqlite.h"

namespace sporeprint::server {

std::unique_ptr<api::Records> open_records(std::string_view library) {
    if (library.find("://") != std::string_view::npos)
        throw InvalidInput("--library",
                           in_quotes(library) + " is an address; allowed is the path of a file");
    return open_sqlite_records(std::string(library));
}

}  // namespace sporeprint::server
