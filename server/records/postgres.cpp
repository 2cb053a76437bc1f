#include "server/records/postgres.h"

#include <libpq-fe.h>
#include <poll.h>
#include <sys/eventfd.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <exception>
#include <iterator>
#include <mutex>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "api/http/errors.h"
#include "core/params/messages.h"
#include "core/problems.h"
#include "server/records/circuit_breaker.h"
#include "server/records/postgres_schema.h"
#include "server/records/sql_records.h"

namespace sporeprint::server {

namespace {

static_assert(std::size(postgres_migrations) == postgres_schema);

using Clock = std::chrono::steady_clock;

/// Connections of one process that statements use at once.
constexpr int most_connections = 8;

/// How often a transaction is begun again, after another one stood in its way or its connection was found broken.
constexpr int most_attempts = 5;

/// How long a request waits for a connection, and how long for the result of one statement. The database itself
/// ends a statement earlier, so that the second is for one that hangs.
constexpr std::chrono::seconds most_wait(5), most_execution(15);

/// How long a statement has no result before it is checked whether the database responds at all, and how often while a
/// database does not respond that is tried again. Without both, everyone who needs the library would wait as long as a
/// statement may, in the threads that grow everything else.
constexpr std::chrono::seconds most_silence(1), between_attempts(3);

/// A failure that took at least this long was a wait in vain.
constexpr std::chrono::milliseconds long_wait(900);

/// Types of values, as PostgreSQL numbers them.
constexpr Oid type_bytea = 17, type_int8 = 20, type_int4 = 23, type_text = 25;

/// What every connection sets. A session that hangs in a transaction would block all writers of its owner.
constexpr const char* settings =
    "SET search_path = sporeprint; SET lock_timeout = '4s'; SET statement_timeout = '10s'; "
    "SET idle_in_transaction_session_timeout = '20s'";

/// Why a statement failed.
struct Failure {
    std::string message;
    std::string state;       ///< SQLSTATE; empty if there is none
    bool is_broken = false;  ///< the connection cannot be used any more

    /// Returns whether the same transaction may succeed the next time: a deadlock, or a conflict of two transactions.
    [[nodiscard]] bool is_conflict() const { return state == "40P01" || state == "40001"; }
};

struct Free {
    void operator()(PGconn* connection) const { PQfinish(connection); }
    void operator()(PGresult* result) const { PQclear(result); }
    void operator()(PQconninfoOption* options) const { PQconninfoFree(options); }
    void operator()(PGnotify* notice) const { PQfreemem(notice); }
    void operator()(char* text) const { PQfreemem(text); }
};
template <class T>
using Owned = std::unique_ptr<T, Free>;

/// Returns a message of libpq without the ends of its lines.
std::string line_of(std::string message) {
    while (!message.empty() && message.back() == '\n') message.pop_back();
    std::replace(message.begin(), message.end(), '\n', ' ');
    return message;
}

// --- Values, in the binary format of PostgreSQL: numbers have their highest byte first ---

std::array<char, 8> bytes_of(std::int64_t value) {
    std::array<char, 8> bytes{};
    auto rest = static_cast<std::uint64_t>(value);
    for (std::size_t i = bytes.size(); i-- > 0; rest >>= 8U)
        bytes[i] = static_cast<char>(static_cast<unsigned char>(rest & 0xffU));
    return bytes;
}

std::uint64_t number_in(std::span<const std::uint8_t> bytes) {
    std::uint64_t value = 0;
    for (const std::uint8_t byte : bytes) value = value << 8U | byte;
    return value;
}

SqlValue value_of(const PGresult* result, int row, int column) {
    if (PQgetisnull(result, row, column) != 0) return {};
    const char* const begin = PQgetvalue(result, row, column);
    const auto length = static_cast<std::size_t>(PQgetlength(result, row, column));
    const std::span bytes(reinterpret_cast<const std::uint8_t*>(begin), length);
    switch (PQftype(result, column)) {
        case type_int8:
            return static_cast<std::int64_t>(number_in(bytes));
        case type_int4:
            return std::int64_t{static_cast<std::int32_t>(number_in(bytes))};
        case type_text:
            return std::string(begin, length);
        case type_bytea:
            return std::vector<std::uint8_t>(bytes.begin(), bytes.end());
        default:
            throw Failure{"column " + std::string(PQfname(result, column)) + " has a type that " +
                              "no statement of this program reads",
                          {}};
    }
}

/// The parameters of a statement in the arrays that libpq wants.
class Parameters {
  public:
    explicit Parameters(std::span<const SqlParameter> parameters) {
        numbers_.reserve(parameters.size());
        for (const SqlParameter& parameter : parameters) std::visit(*this, parameter);
    }
    void operator()(std::monostate) { add(0, nullptr, 0); }
    void operator()(std::int64_t value) {
        numbers_.push_back(bytes_of(value));
        add(type_int8, numbers_.back().data(), numbers_.back().size());
    }
    void operator()(std::string_view text) { add(type_text, text.data(), text.size()); }
    void operator()(std::span<const std::uint8_t> bytes) {
        add(type_bytea, reinterpret_cast<const char*>(bytes.data()), bytes.size());
    }

    /// Sends a statement; its results come later.
    [[nodiscard]] bool send(PGconn* connection, const char* statement) const {
        const std::vector<int> formats(types_.size(), 1);
        return PQsendQueryParams(connection, statement, static_cast<int>(types_.size()),
                                 types_.data(), values_.data(), lengths_.data(), formats.data(),
                                 1) == 1;
    }

  private:
    std::vector<std::array<char, 8>> numbers_;
    std::vector<Oid> types_;
    std::vector<const char*> values_;
    std::vector<int> lengths_;

    /// type  0 for NULL; otherwise no bytes at all are an empty text, for which libpq wants an address too
    void add(Oid type, const char* begin, std::size_t length) {
        types_.push_back(type);
        values_.push_back(type != 0 && !begin ? "" : begin);
        lengths_.push_back(static_cast<int>(length));
    }
};

class PostgresConnection final : public SqlConnection {
  public:
    /// throws  Failure
    explicit PostgresConnection(const std::string& address) : address_(address) {
        connection_.reset(PQconnectdbParams(keywords.data(), values().data(), 1));
        if (PQstatus(connection_.get()) != CONNECTION_OK) fail_broken();
        PQsetNoticeProcessor(
            connection_.get(), [](void*, const char*) {}, nullptr);
        if (PQsetnonblocking(connection_.get(), 1) != 0) fail_broken();
        const char* const encoding = PQparameterStatus(connection_.get(), "server_encoding");
        if (!encoding || std::string_view(encoding) != "UTF8")
            throw Failure{"the encoding of the database is " +
                              std::string(encoding ? encoding : "unknown") + "; allowed is UTF8",
                          {}};
        run_script(settings);
    }

    SqlResult execute(const char* statement, std::span<const SqlParameter> parameters) override {
        if (!Parameters(parameters).send(connection_.get(), statement)) fail_broken();
        return collect();
    }

    /// Executes several statements without parameters.
    void run_script(const char* statements) {
        if (PQsendQuery(connection_.get(), statements) != 1) fail_broken();
        collect();
    }

    void announce_change() override { execute("NOTIFY sporeprint_library", {}); }
    void reserve_shared_rows() override { reserve("sporeprint.blob"); }
    [[nodiscard]] const char* for_update() const override { return " FOR UPDATE"; }

    /// Waits for what has this name, and reserves it until the end of the transaction.
    void reserve(std::string_view name) {
        const std::array<SqlParameter, 1> parameters = {name};
        execute("SELECT 1 FROM pg_advisory_xact_lock(hashtext($1))", parameters);
    }

    /// Returns when a notice has come, at the latest after a time, or when the other descriptor can be read.
    void wait_for_notice(int other, std::chrono::milliseconds at_most) {
        std::array<pollfd, 2> ready = {
            {{PQsocket(connection_.get()), POLLIN, 0}, {other, POLLIN, 0}}};
        if (::poll(ready.data(), ready.size(), static_cast<int>(at_most.count())) < 0 &&
            errno != EINTR)
            fail_broken();
        if (PQconsumeInput(connection_.get()) == 0) fail_broken();
        while (Owned<PGnotify>(PQnotifies(connection_.get()))) {
        }
    }

  private:
    std::string address_;
    Owned<PGconn> connection_;

    /// Later keywords win, so that the address may say otherwise, but not in which encoding we write.
    static constexpr std::array keywords = {"connect_timeout",
                                            "tcp_user_timeout",
                                            "keepalives_idle",
                                            "fallback_application_name",
                                            "dbname",
                                            "client_encoding",
                                            static_cast<const char*>(nullptr)};

    /// Returns the values of the keywords.
    [[nodiscard]] std::array<const char*, keywords.size()> values() const {
        return {"2", "10000", "15", "sporeprint", address_.c_str(), "UTF8", nullptr};
    }

    /// Returns whether the database responds to somebody who connects. That takes as long as a connection may.
    [[nodiscard]] bool responds() const {
        return PQpingParams(keywords.data(), values().data(), 1) != PQPING_NO_RESPONSE;
    }

    [[noreturn]] void fail_broken(std::string why = {}) const {
        if (why.empty()) why = line_of(PQerrorMessage(connection_.get()));
        throw Failure{std::move(why), {}, true};
    }

    /// Returns the next result of what was sent, or nullptr after the last.
    Owned<PGresult> next_result() {
        const Clock::time_point end = Clock::now() + most_execution;
        for (;;) {
            const int unsent = PQflush(connection_.get());
            if (unsent < 0) fail_broken();
            if (unsent == 0 && PQisBusy(connection_.get()) == 0)
                return Owned<PGresult>(PQgetResult(connection_.get()));
            const auto left =
                std::chrono::duration_cast<std::chrono::milliseconds>(end - Clock::now());
            if (left.count() <= 0)
                fail_broken("a statement had no result within " +
                            std::to_string(most_execution.count()) + " s");
            pollfd ready{PQsocket(connection_.get()),
                         static_cast<short>(unsent > 0 ? POLLIN | POLLOUT : POLLIN), 0};
            const std::chrono::milliseconds pause =
                std::min<std::chrono::milliseconds>(left, most_silence);
            const int woken = ::poll(&ready, 1, static_cast<int>(pause.count()));
            if (woken < 0 && errno != EINTR) fail_broken();
            if (woken == 0 && !responds()) fail_broken("it does not respond");
            if (PQconsumeInput(connection_.get()) == 0) fail_broken();
        }
    }

    /// Returns the last result of what was sent.
    SqlResult collect() {
        SqlResult result;
        std::exception_ptr
            failure;  // The connection can be used again only after all results are read.
        while (const Owned<PGresult> one = next_result()) {
            try {
                result = rows_of(one.get());
            } catch (const Failure&) {
                failure = std::current_exception();
            }
        }
        if (failure) std::rethrow_exception(failure);
        return result;
    }

    SqlResult rows_of(const PGresult* one) const {
        const ExecStatusType status = PQresultStatus(one);
        if (status != PGRES_TUPLES_OK && status != PGRES_COMMAND_OK) {
            const char* const state = PQresultErrorField(one, PG_DIAG_SQLSTATE);
            const char* const message = PQresultErrorField(one, PG_DIAG_MESSAGE_PRIMARY);
            throw Failure{message ? line_of(message) : line_of(PQresultErrorMessage(one)),
                          state ? state : "", PQstatus(connection_.get()) != CONNECTION_OK};
        }
        SqlResult result;
        std::string_view changed = PQcmdTuples(const_cast<PGresult*>(one));
        for (const char digit : changed) result.changed = 10 * result.changed + (digit - '0');
        result.rows.resize(static_cast<std::size_t>(PQntuples(one)));
        for (int row = 0; row < PQntuples(one); ++row)
            for (int column = 0; column < PQnfields(one); ++column)
                result.rows[static_cast<std::size_t>(row)].push_back(value_of(one, row, column));
        return result;
    }
};

/// A file descriptor that can be read once a thread has to end.
class StopSignal {
  public:
    explicit StopSignal(const std::stop_token& stop)
        : descriptor_(::eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK)),
          callback_(stop, Wake{descriptor_}) {}
    ~StopSignal() { ::close(descriptor_); }
    StopSignal(const StopSignal&) = delete;
    StopSignal& operator=(const StopSignal&) = delete;

    [[nodiscard]] int descriptor() const { return descriptor_; }

    /// Returns after a time, or when the thread has to end.
    void pause(std::chrono::milliseconds at_most) const {
        pollfd ready{descriptor_, POLLIN, 0};
        static_cast<void>(::poll(&ready, 1, static_cast<int>(at_most.count())));
    }

  private:
    struct Wake {
        int descriptor;
        void operator()() const { static_cast<void>(::eventfd_write(descriptor, 1)); }
    };
    int descriptor_;
    std::stop_callback<Wake>
        callback_;  ///< the last member: it ends before the descriptor is closed
};

/// The connections of this process to one database.
class PostgresDatabase final : public SqlDatabase {
    std::string address_;
    std::string name_;  ///< without user and password
    std::mutex mutex_;
    std::condition_variable returned_;
    std::vector<std::unique_ptr<PostgresConnection>> idle_;
    int in_use_ = 0;
    std::unique_ptr<PostgresConnection> listener_;
    CircuitBreaker breaker_{between_attempts};

    [[noreturn]] void unavailable(const std::string& why) const {
        throw api::Unavailable(name_ + ": " + why);
    }

    /// Returns a connection; throws Failure if none can be made.
    std::unique_ptr<PostgresConnection> take() {
        {
            std::unique_lock lock(mutex_);
            if (!returned_.wait_for(lock, most_wait, [&] { return in_use_ < most_connections; }))
                unavailable("too many wait for a connection");
            ++in_use_;
            if (!idle_.empty()) {
                std::unique_ptr<PostgresConnection> connection = std::move(idle_.back());
                idle_.pop_back();
                return connection;
            }
        }
        try {
            return std::make_unique<PostgresConnection>(address_);
        } catch (...) {
            give_back(nullptr);
            throw;
        }
    }

    /// Gives back what take() has returned, or nullptr instead of a connection that cannot be used any more.
    void give_back(std::unique_ptr<PostgresConnection> connection) {
        {
            const std::lock_guard lock(mutex_);
            --in_use_;
            if (connection) idle_.push_back(std::move(connection));
        }
        returned_.notify_one();
    }

    /// Closes what is idle: after one connection was found broken, the others probably are.
    void close_idle() {
        const std::lock_guard lock(mutex_);
        idle_.clear();
    }

    /// Calls a function in a transaction.
    ///
    /// begin  statement that begins it; nullptr for none, so that each statement stands alone
    void transact(const char* begin, const Write& body) {
        for (int attempt = 1;; ++attempt) {
            std::unique_ptr<PostgresConnection> connection;
            bool is_committing = false;
            const Clock::time_point began = Clock::now();
            if (!breaker_.may_try(began))
                unavailable("it did not respond; it is tried again every " +
                            std::to_string(between_attempts.count()) + " s");
            const auto abandon = [&](bool is_broken) {
                if (!connection) return;
                try {
                    if (begin && !is_broken) connection->execute("ROLLBACK", {});
                } catch (const Failure&) {
                    is_broken = true;
                }
                if (is_broken) connection.reset();
                give_back(std::move(connection));
            };
            try {
                connection = take();
                if (begin) connection->execute(begin, {});
                is_committing = body(*connection);
                if (begin) connection->execute(is_committing ? "COMMIT" : "ROLLBACK", {});
                give_back(std::move(connection));
                breaker_.close();
                return;
            } catch (const Failure& failure) {
                const bool was_open = connection != nullptr;
                abandon(failure.is_broken);
                if (failure.is_broken) close_idle();
                const bool was_silent = failure.is_broken && Clock::now() - began >= long_wait;
                if (was_silent)
                    breaker_.open(Clock::now());
                else if (!failure.is_broken)
                    breaker_.close();  // It has responded, if with a refusal.
                if (begin && is_committing && failure.is_broken)
                    unavailable("the connection broke during a commit (" + failure.message +
                                "), so it is not known whether it was committed");
                const bool may_succeed = failure.is_conflict() || (failure.is_broken && was_open &&
                                                                   !was_silent && attempt == 1);
                if (!may_succeed || attempt == most_attempts) unavailable(failure.message);
            } catch (...) {
                abandon(false);
                throw;
            }
        }
    }

    /// Returns the number of the schema; 0 if there is none.
    static std::int64_t schema_of(SqlConnection& sql) {
        // Not to_regclass(), which may say what was true before this transaction waited for another.
        const SqlResult exists = sql.execute(
            "SELECT 1 FROM pg_catalog.pg_tables WHERE schemaname = 'sporeprint' AND tablename = "
            "'schema_version'",
            {});
        if (exists.rows.empty()) return 0;
        const SqlResult found = sql.execute("SELECT number FROM schema_version", {});
        return found.rows.empty() ? 0 : std::get<std::int64_t>(found.rows.front().front());
    }

    /// Brings the schema up to date in one transaction, while other processes wait for it.
    void migrate() {
        std::int64_t schema = 0;
        read([&](SqlConnection& sql) { schema = schema_of(sql); });
        if (schema < postgres_schema)
            transact("BEGIN ISOLATION LEVEL READ COMMITTED", [&](SqlConnection& sql) {
                auto& connection = static_cast<PostgresConnection&>(sql);
                connection.reserve("sporeprint.schema_version");
                schema = schema_of(sql);
                if (schema >= postgres_schema) return false;
                if (schema == 0)
                    connection.run_script(
                        "CREATE SCHEMA IF NOT EXISTS sporeprint; "
                        "CREATE TABLE schema_version (number BIGINT NOT NULL); "
                        "INSERT INTO schema_version VALUES (0)");
                for (; schema < postgres_schema; ++schema)
                    connection.run_script(postgres_migrations[schema]);
                const std::array<SqlParameter, 1> number = {schema};
                sql.execute("UPDATE schema_version SET number = $1", number);
                return true;
            });
        if (schema > postgres_schema)
            unavailable("schema " + std::to_string(schema) + "; this server knows up to " +
                        std::to_string(postgres_schema));
    }

  public:
    PostgresDatabase(std::string address, std::string name)
        : address_(std::move(address)), name_(std::move(name)) {
        migrate();
    }

    void read(const Use& use) override {
        transact(nullptr, [&](SqlConnection& sql) {
            use(sql);
            return false;
        });
    }

    void read_at_one_moment(const Use& use) override {
        transact("BEGIN ISOLATION LEVEL REPEATABLE READ READ ONLY", [&](SqlConnection& sql) {
            use(sql);
            return false;
        });
    }

    void write(const Write& write) override {
        transact("BEGIN ISOLATION LEVEL READ COMMITTED", write);
    }

    /// PostgreSQL itself overwrites what was deleted, when it needs the space.
    void erase_deleted(bool) override {}

    void wait_for_change(const std::stop_token& stop, std::int64_t at_most_ms) override {
        const StopSignal stopped(stop);
        const std::chrono::milliseconds at_most(at_most_ms);
        try {
            if (!listener_) {
                listener_ = std::make_unique<PostgresConnection>(address_);
                listener_->execute("LISTEN sporeprint_library", {});
                return;  // There may have been changes before.
            }
            listener_->wait_for_notice(stopped.descriptor(), at_most);
        } catch (const Failure&) {
            listener_.reset();
            stopped.pause(at_most);
        }
    }
};

/// Returns the address without what is secret in it.
std::string public_name(const PQconninfoOption* options) {
    std::string host = "localhost", port, database;
    for (const PQconninfoOption* option = options; option->keyword; ++option) {
        if (!option->val || *option->val == '\0') continue;
        const std::string_view keyword = option->keyword;
        if (keyword == "host") host = option->val;
        if (keyword == "port") port = std::string(":") + option->val;
        if (keyword == "dbname") database = option->val;
    }
    return "postgres://" + host + port + '/' + database;
}

}  // namespace

std::unique_ptr<api::Records> open_postgres_records(const std::string& address) {
    char* error = nullptr;
    const Owned<PQconninfoOption> options(PQconninfoParse(address.c_str(), &error));
    const Owned<char> reason(error);
    if (!options)
        throw InvalidInput("--library", "the address of PostgreSQL cannot be read: " +
                                            line_of(error ? error : "no memory") +
                                            "; allowed is postgres://user@host:5432/database");
    return sql_records(std::make_unique<PostgresDatabase>(address, public_name(options.get())));
}

}  // namespace sporeprint::server
