// Documents in a database that understands SQL. The tables are those of sqlite_schema.h and postgres_schema.h.
#pragma once

#include <memory>

#include "api/library/records.h"
#include "server/records/sql.h"

namespace sporeprint::server {

/// Returns documents stored in a database whose tables exist.
[[nodiscard]] std::unique_ptr<api::Records> sql_records(std::unique_ptr<SqlDatabase> database);

}  // namespace sporeprint::server
