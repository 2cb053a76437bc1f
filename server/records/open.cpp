#include "server/records/open.h"

#include <string>

#include "core/params/messages.h"
#include "core/problems.h"
#include "server/records/postgres.h"
#include "server/records/sqlite.h"

namespace sporeprint::server {

std::unique_ptr<api::Records> open_records(std::string_view library) {
    if (is_postgres_address(library)) return open_postgres_records(std::string(library));
    if (library.find("://") != std::string_view::npos)
        throw InvalidInput("--library", in_quotes(library) +
                                            " is an address of no database that is known; allowed "
                                            "are postgres:// and the path of a file");
    return open_sqlite_records(std::string(library));
}

bool is_postgres_address(std::string_view library) {
    return library.starts_with("postgres://") || library.starts_with("postgresql://");
}

}  // namespace sporeprint::server
