// What a database that understands SQL does for the documents; each kind of database implements it once.
//
// Statements are written so that SQLite and PostgreSQL both understand them; parameters are $1, $2 and so on.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <stop_token>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace sporeprint::server {

/// A parameter of a statement: NULL, a number, a text or bytes. Texts and bytes are those of the caller.
using SqlParameter =
    std::variant<std::monostate, std::int64_t, std::string_view, std::span<const std::uint8_t>>;

/// A value of a row: NULL, a number, a text or bytes.
using SqlValue = std::variant<std::monostate, std::int64_t, std::string, std::vector<std::uint8_t>>;

using SqlRow = std::vector<SqlValue>;

/// What a statement returns.
struct SqlResult {
    std::vector<SqlRow> rows;
    std::int64_t changed = 0;  ///< number of rows that were inserted, updated or deleted
};

class SqlConnection {
  public:
    SqlConnection() = default;
    SqlConnection(const SqlConnection&) = delete;
    SqlConnection& operator=(const SqlConnection&) = delete;
    virtual ~SqlConnection() = default;

    /// Executes one statement. Every parameter is used in it.
    virtual SqlResult execute(const char* statement, std::span<const SqlParameter> parameters) = 0;
    /// Tells other processes, after the transaction is committed, that changes() has news.
    virtual void announce_change() = 0;
    /// Waits until no other transaction writes rows that several owners share, and reserves them until the end of this
    /// one; otherwise two that write them in different orders would wait for each other.
    virtual void reserve_shared_rows() = 0;
    /// Returns the end of a SELECT that reserves its rows until the end of the transaction.
    [[nodiscard]] virtual const char* for_update() const = 0;
};

/// A database with connections of its own. All functions may be called on any thread.
///
/// throws  api::Unavailable from every function if the database cannot be used
class SqlDatabase {
  public:
    using Use = std::function<void(SqlConnection&)>;
    /// Returns whether the transaction is to be committed. It may be called again from the beginning, after another
    /// transaction stood in its way, so it sets all of its results anew.
    using Write = std::function<bool(SqlConnection&)>;

    SqlDatabase() = default;
    SqlDatabase(const SqlDatabase&) = delete;
    SqlDatabase& operator=(const SqlDatabase&) = delete;
    virtual ~SqlDatabase() = default;

    /// Reads; each statement sees what was committed before it. It may be called again from the beginning.
    virtual void read(const Use& use) = 0;
    /// Reads; all statements see the same moment. It may be called again from the beginning.
    virtual void read_at_one_moment(const Use& use) = 0;
    /// Writes in one transaction, which is on the disk when this returns.
    virtual void write(const Write& write) = 0;
    /// Is called after bytes were deleted for good, and now and then afterwards.
    virtual void erase_deleted(bool is_new) = 0;
    /// Returns after announce_change() of another process, after a time, or when it is stopped.
    virtual void wait_for_change(const std::stop_token& stop, std::int64_t at_most_ms) = 0;
};

}  // namespace sporeprint::server
