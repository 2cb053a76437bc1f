// Which database --library names.
#pragma once

#include <memory>
#include <string_view>

#include "api/library/records.h"

namespace sporeprint::server {

/// Opens the database that --library names: a file of SQLite, or a database of PostgreSQL by its address.
///
/// throws  api::Unavailable, with the reason; InvalidInput (path "--library") if the text names no database that this
///         program knows
[[nodiscard]] std::unique_ptr<api::Records> open_records(std::string_view library);

/// Returns whether --library names a database of PostgreSQL.
[[nodiscard]] bool is_postgres_address(std::string_view library);

}  // namespace sporeprint::server
