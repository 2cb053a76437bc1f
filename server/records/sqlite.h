// Documents in one SQLite file, the database that needs no other program.
#pragma once

#include <filesystem>
#include <memory>

#include "api/library/records.h"

namespace sporeprint::server {

/// The newest schema that this program knows; `user_version` of the file.
inline constexpr int sqlite_schema = 1;

/// Opens a file of documents, creates it if it does not exist, and brings an older schema up to date.
///
/// A write returns when it is on the disk (write-ahead log, synchronous=FULL). One connection writes; others read
/// what was committed before they began. Several processes may use one file of a local disk.
///
/// throws  api::Unavailable, with the reason, if the file cannot be used or has a newer schema
[[nodiscard]] std::unique_ptr<api::Records> open_sqlite_records(const std::filesystem::path& file);

/// Writes a consistent copy of a file of documents, which may be in use, into a new file.
///
/// throws  api::Unavailable if `from` cannot be read, or `to` exists or cannot be written
void back_up_sqlite_records(const std::filesystem::path& from, const std::filesystem::path& to);

}  // namespace sporeprint::server
