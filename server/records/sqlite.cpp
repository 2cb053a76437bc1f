#include "server/records/sqlite.h"

#include <SQLiteCpp/SQLiteCpp.h>
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <iterator>
#include <mutex>
#include <optional>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "api/http/errors.h"
#include "server/records/sql_records.h"
#include "server/records/sqlite_schema.h"

namespace sporeprint::server {

namespace {

static_assert(std::size(sqlite_migrations) == sqlite_schema);

/// How long a statement waits for another process that writes.
constexpr int busy_ms = 2000;

[[noreturn]] void unavailable(const std::filesystem::path& file, const std::string& why) {
    throw api::Unavailable(file.string() + ": " + why);
}

/// Binds a parameter to its name in a statement.
struct Bind {
    SQLite::Statement& statement;
    std::string name;

    void operator()(std::monostate) const { statement.bind(name.c_str()); }
    void operator()(std::int64_t value) const { statement.bind(name.c_str(), value); }
    void operator()(std::string_view text) const {
        statement.bind(name.c_str(), std::string(text));
    }
    void operator()(std::span<const std::uint8_t> bytes) const {
        // A null pointer would be NULL, which is not an empty blob.
        statement.bind(name.c_str(), bytes.empty() ? static_cast<const void*>("") : bytes.data(),
                       static_cast<int>(bytes.size()));
    }
};

SqlValue value_of(const SQLite::Column& column) {
    if (column.isNull()) return {};
    if (column.isInteger()) return column.getInt64();
    if (!column.isBlob()) return column.getString();
    const auto* const begin = static_cast<const std::uint8_t*>(column.getBlob());
    return std::vector<std::uint8_t>(begin, begin + column.getBytes());
}

class SqliteConnection final : public SqlConnection {
  public:
    explicit SqliteConnection(const std::filesystem::path& file)
        : database_(file.string(), SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE, busy_ms) {
        database_.exec("PRAGMA journal_mode = WAL");
        database_.exec("PRAGMA synchronous = FULL");
        database_.exec("PRAGMA foreign_keys = ON");
        // Deleted bytes are overwritten, so that nothing of a purged document is left in the file.
        database_.exec("PRAGMA secure_delete = ON");
    }

    SqlResult execute(const char* statement, std::span<const SqlParameter> parameters) override {
        SQLite::Statement prepared(database_, statement);
        int at = 0;
        for (const SqlParameter& parameter : parameters)
            std::visit(Bind{prepared, '$' + std::to_string(++at)}, parameter);
        SqlResult result;
        while (prepared.executeStep()) {
            SqlRow& row = result.rows.emplace_back();
            row.reserve(static_cast<std::size_t>(prepared.getColumnCount()));
            for (int i = 0; i < prepared.getColumnCount(); ++i)
                row.push_back(value_of(prepared.getColumn(i)));
        }
        result.changed = prepared.getChanges();
        return result;
    }

    /// Other processes look at the file now and then.
    void announce_change() override {}
    /// A transaction that writes has the whole file.
    void reserve_shared_rows() override {}
    [[nodiscard]] const char* for_update() const override { return ""; }

    [[nodiscard]] SQLite::Database& database() { return database_; }

  private:
    SQLite::Database database_;
};

/// The connections of this process to one file: one that writes, and as many readers as there are at once.
class SqliteDatabase final : public SqlDatabase {
    std::filesystem::path file_;
    std::timed_mutex write_mutex_;
    std::atomic<bool> is_log_dirty_{false};  ///< the write-ahead log has purged bytes
    std::unique_ptr<SqliteConnection> writer_;
    std::mutex readers_mutex_;
    std::vector<std::unique_ptr<SqliteConnection>> idle_readers_;

    /// Calls a function and converts exceptions of SQLite.
    template <class Function>
    void guarded(Function function) {
        try {
            function();
        } catch (const SQLite::Exception& error) {
            unavailable(file_, error.what());
        }
    }

    /// Waits until this thread may write, as long as for another process.
    std::unique_lock<std::timed_mutex> turn_to_write() {
        std::unique_lock lock(write_mutex_, std::chrono::milliseconds(busy_ms));
        if (!lock.owns_lock()) unavailable(file_, "too many wait to write to it");
        return lock;
    }

    /// Brings the schema up to date, one transaction for each step.
    void migrate() {
        SQLite::Database& database = writer_->database();
        for (;;) {
            SQLite::Transaction transaction(database, SQLite::TransactionBehavior::IMMEDIATE);
            const int schema = database.execAndGet("PRAGMA user_version").getInt();
            if (schema > sqlite_schema)
                unavailable(file_, "schema " + std::to_string(schema) +
                                       "; this server knows up to " +
                                       std::to_string(sqlite_schema));
            if (schema == sqlite_schema) return;
            database.exec(sqlite_migrations[schema]);
            database.exec("PRAGMA user_version = " + std::to_string(schema + 1));
            transaction.commit();
        }
    }

    /// Calls a function with a connection for reading.
    template <class Function>
    void with_reader(Function function) {
        guarded([&] {
            std::unique_ptr<SqliteConnection> reader;
            {
                const std::lock_guard lock(readers_mutex_);
                if (!idle_readers_.empty()) {
                    reader = std::move(idle_readers_.back());
                    idle_readers_.pop_back();
                }
            }
            if (!reader) reader = std::make_unique<SqliteConnection>(file_);
            function(*reader);
            const std::lock_guard lock(readers_mutex_);
            idle_readers_.push_back(std::move(reader));
        });
    }

  public:
    explicit SqliteDatabase(std::filesystem::path file) : file_(std::move(file)) {
        guarded([&] {
            writer_ = std::make_unique<SqliteConnection>(file_);
            migrate();
        });
    }

    void read(const Use& use) override {
        with_reader([&](SqliteConnection& reader) { use(reader); });
    }

    void read_at_one_moment(const Use& use) override {
        with_reader([&](SqliteConnection& reader) {
            const SQLite::Transaction transaction(reader.database());
            use(reader);
        });
    }

    void write(const Write& write) override {
        guarded([&] {
            const std::unique_lock lock = turn_to_write();
            SQLite::Transaction transaction(writer_->database(),
                                            SQLite::TransactionBehavior::IMMEDIATE);
            if (write(*writer_)) transaction.commit();
        });
    }

    /// Empties the write-ahead log, which has what was deleted until then. Where a reader of another process needs it,
    /// this is tried again by the next call.
    void erase_deleted(bool is_new) override {
        if (!is_new && !is_log_dirty_) return;
        guarded([&] {
            const std::unique_lock lock = turn_to_write();
            SQLite::Database& database = writer_->database();
            database.setBusyTimeout(100);
            is_log_dirty_ = database.execAndGet("PRAGMA wal_checkpoint(TRUNCATE)").getInt() != 0;
            database.setBusyTimeout(busy_ms);
        });
    }

    void wait_for_change(const std::stop_token& stop, std::int64_t at_most_ms) override {
        std::mutex mutex;
        std::condition_variable_any woken;
        std::unique_lock lock(mutex);
        woken.wait_for(lock, stop, std::chrono::milliseconds(at_most_ms), [] { return false; });
    }
};

}  // namespace

std::unique_ptr<api::Records> open_sqlite_records(const std::filesystem::path& file) {
    std::error_code error;
    if (file.has_parent_path() && !std::filesystem::is_directory(file.parent_path(), error))
        unavailable(file, "its folder does not exist");
    // Nobody else on the machine may read drafts. The files beside it have the permissions of this one.
    const int descriptor = ::open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, S_IRUSR | S_IWUSR);
    if (descriptor >= 0) ::close(descriptor);
    return sql_records(std::make_unique<SqliteDatabase>(file));
}

void back_up_sqlite_records(const std::filesystem::path& from, const std::filesystem::path& to) {
    std::error_code error;
    if (std::filesystem::exists(to, error)) unavailable(to, "exists already");
    try {
        SQLite::Database database(from.string(), SQLite::OPEN_READONLY, busy_ms);
        SQLite::Statement statement(database, "VACUUM INTO ?");
        statement.bind(1, to.string());
        statement.exec();
    } catch (const SQLite::Exception& failure) {
        unavailable(from, failure.what());
    }
}

}  // namespace sporeprint::server
