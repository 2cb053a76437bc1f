// Documents in PostgreSQL, the database that several replicas share.
#pragma once

#include <memory>
#include <string>

#include "api/library/records.h"

namespace sporeprint::server {

/// The newest schema that this program knows; the table sporeprint.schema_version has that of the database.
inline constexpr int postgres_schema = 1;

/// Opens the database that an address names, creates the tables (in a schema named sporeprint) where there are none,
/// and brings older ones up to date.
///
/// A write returns when PostgreSQL has committed it. Up to eight connections are opened as they are needed, and one
/// more that listens for changes; those that break are replaced.
///
/// address  postgres://user@host:5432/database, with everything else that libpq allows in an address; what it does not
///          say comes from the variables PGHOST, PGPASSWORD, PGPASSFILE and so on
/// throws   api::Unavailable, with the reason, if the database cannot be used or has a newer schema; InvalidInput
///          (path "--library") if the address cannot be read
[[nodiscard]] std::unique_ptr<api::Records> open_postgres_records(const std::string& address);

}  // namespace sporeprint::server
