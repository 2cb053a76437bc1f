#include "server/records/sqlite.h"

#include <SQLiteCpp/SQLiteCpp.h>
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cstring>
#include <iterator>
#include <mutex>
#include <set>
#include <span>
#include <string>
#include <system_error>
#include <utility>

#include "api/http/errors.h"
#include "server/records/sqlite_schema.h"

namespace sporeprint::server {

namespace {

using namespace api;

static_assert(std::size(sqlite_migrations) == sqlite_schema);

/// How long a statement waits for another process that writes.
constexpr int busy_ms = 2000;

/// Tokens and shares that are revoked or expired are listed until there are so many times more than may be good.
constexpr std::int64_t most_shown = 4;

[[noreturn]] void unavailable(const std::filesystem::path& file, const std::string& why) {
    throw Unavailable(file.string() + ": " + why);
}

// --- Statements ---

void bind_one(SQLite::Statement& statement, int at, std::int64_t value) {
    statement.bind(at, value);
}
void bind_one(SQLite::Statement& statement, int at, int value) { statement.bind(at, value); }
void bind_one(SQLite::Statement& statement, int at, std::string_view text) {
    statement.bind(at, std::string(text));
}
void bind_one(SQLite::Statement& statement, int at, std::span<const std::uint8_t> bytes) {
    // A null pointer would be NULL, which is not an empty blob.
    statement.bind(at, bytes.empty() ? static_cast<const void*>("") : bytes.data(),
                   static_cast<int>(bytes.size()));
}
void bind_one(SQLite::Statement& statement, int at, const std::optional<Seconds>& time) {
    if (time)
        statement.bind(at, *time);
    else
        statement.bind(at);
}

/// Returns a statement with its parameters.
template <class... Values>
SQLite::Statement prepared(SQLite::Database& database, const char* sql, const Values&... values) {
    SQLite::Statement statement(database, sql);
    int at = 0;
    (bind_one(statement, ++at, values), ...);
    return statement;
}

/// Executes a statement that returns no rows, and returns the number of rows that it has changed.
template <class... Values>
int run(SQLite::Database& database, const char* sql, const Values&... values) {
    return prepared(database, sql, values...).exec();
}

/// Returns the first column of the first row as a number; nothing if there is no row.
template <class... Values>
std::optional<std::int64_t> number(SQLite::Database& database, const char* sql,
                                   const Values&... values) {
    SQLite::Statement statement = prepared(database, sql, values...);
    if (!statement.executeStep()) return std::nullopt;
    return statement.getColumn(0).getInt64();
}

Digest digest_in(const SQLite::Column& column) {
    Digest digest{};
    if (column.getBytes() == static_cast<int>(digest.size()))
        std::memcpy(digest.data(), column.getBlob(), digest.size());
    return digest;
}

std::optional<Seconds> time_in(const SQLite::Column& column) {
    if (column.isNull()) return std::nullopt;
    return column.getInt64();
}

template <class Enum, std::size_t Count>
Enum named_in(const SQLite::Column& column, const std::array<Enum, Count>& all) {
    const std::string text = column.getString();
    for (const Enum one : all)
        if (text == api::name(one)) return one;
    throw SQLite::Exception("unknown word " + text);
}

constexpr std::array scopes = {Scope::read, Scope::write, Scope::admin};
constexpr std::array states = {DocumentState::active, DocumentState::unlisted,
                               DocumentState::purged};

// --- Rows ---

struct OwnerRow {
    std::int64_t id, documents, max_documents, used_bytes, max_bytes;
};

std::optional<OwnerRow> owner_row(SQLite::Database& database, std::string_view name) {
    SQLite::Statement statement = prepared(
        database,
        "SELECT id, documents, max_documents, used_bytes, max_bytes FROM owner WHERE name = ?",
        name);
    if (!statement.executeStep()) return std::nullopt;
    return OwnerRow{statement.getColumn(0).getInt64(), statement.getColumn(1).getInt64(),
                    statement.getColumn(2).getInt64(), statement.getColumn(3).getInt64(),
                    statement.getColumn(4).getInt64()};
}

struct DocumentRow {
    std::int64_t id;
    int newest;
    DocumentState state;
};

std::optional<DocumentRow> document_row(SQLite::Database& database, std::int64_t owner,
                                        std::string_view name) {
    SQLite::Statement statement =
        prepared(database, "SELECT id, newest, state FROM document WHERE owner = ? AND name = ?",
                 owner, name);
    if (!statement.executeStep()) return std::nullopt;
    return DocumentRow{statement.getColumn(0).getInt64(), statement.getColumn(1).getInt(),
                       named_in(statement.getColumn(2), states)};
}

std::optional<DocumentRow> document_row(SQLite::Database& database, std::string_view owner,
                                        std::string_view name) {
    const std::optional<OwnerRow> row = owner_row(database, owner);
    return row ? document_row(database, row->id, name) : std::nullopt;
}

struct DraftRow {
    Digest hash;
    std::int64_t revision, size;
};

DraftRow draft_row(SQLite::Database& database, std::int64_t document) {
    SQLite::Statement statement = prepared(
        database, "SELECT hash, revision, size FROM version WHERE document = ? AND number = 0",
        document);
    if (!statement.executeStep()) throw SQLite::Exception("a document without a draft");
    return {digest_in(statement.getColumn(0)), statement.getColumn(1).getInt64(),
            statement.getColumn(2).getInt64()};
}

/// A draft that a write may change, with its document and the id of its owner.
struct DraftToWrite {
    std::int64_t owner;
    DocumentRow document;
    DraftRow draft;
};

std::int64_t size_of_text(const Content& content) {
    return static_cast<std::int64_t>(content.text.size());
}

/// Gives a document the next serial number, by which others learn of its change.
void mark_changed(SQLite::Database& database, std::int64_t document) {
    run(database, "UPDATE counter SET serial = serial + 1");
    run(database, "UPDATE document SET serial = (SELECT serial FROM counter) WHERE id = ?",
        document);
}

// --- Blobs ---

using Digests = std::set<Digest>;

Digests digests_of(const Content& content) {
    Digests digests;
    for (const Blob& blob : content.blobs) digests.insert(blob.sha256);
    return digests;
}

/// Returns the digests of the blobs of a version, or of all versions of a document for a negative number.
Digests digests_of(SQLite::Database& database, std::int64_t document, int number) {
    SQLite::Statement statement = prepared(
        database,
        "SELECT DISTINCT sha256 FROM version_blob WHERE document = ?1 AND (?2 < 0 OR number = ?2)",
        document, number);
    Digests digests;
    while (statement.executeStep()) digests.insert(digest_in(statement.getColumn(0)));
    return digests;
}

/// Returns the bytes of those blobs that the documents of an owner have.
std::int64_t bytes_of_blobs(SQLite::Database& database, std::int64_t owner,
                            const Digests& digests) {
    std::int64_t bytes = 0;
    for (const Digest& digest : digests)
        bytes +=
            number(
                database,
                "SELECT size FROM blob WHERE sha256 = ?1 AND EXISTS (SELECT 1 FROM version_blob v "
                "JOIN document d ON d.id = v.document WHERE v.sha256 = ?1 AND d.owner = ?2)",
                digest, owner)
                .value_or(0);
    return bytes;
}

void insert_blobs(SQLite::Database& database, std::int64_t document, int number,
                  const std::vector<Blob>& blobs) {
    for (const Blob& blob : blobs) {
        run(database,
            "INSERT INTO blob (sha256, media, size, refs, bytes) VALUES (?, ?, ?, 1, ?) "
            "ON CONFLICT (sha256) DO UPDATE SET refs = refs + 1",
            blob.sha256, blob.media, static_cast<std::int64_t>(blob.bytes.size()),
            std::span<const std::uint8_t>(blob.bytes));
        run(database,
            "INSERT INTO version_blob (document, number, place, sha256) VALUES (?, ?, ?, ?)",
            document, number, blob.place, blob.sha256);
    }
}

/// Unties the blobs of a version, or of all versions for a negative number. drop_unused_blobs() deletes those that
/// nothing uses any more.
void untie_blobs(SQLite::Database& database, std::int64_t document, int number) {
    run(database,
        "UPDATE blob SET refs = refs - (SELECT count(*) FROM version_blob v WHERE v.sha256 = "
        "blob.sha256 "
        "AND v.document = ?1 AND (?2 < 0 OR v.number = ?2)) WHERE sha256 IN (SELECT sha256 FROM "
        "version_blob WHERE document = ?1 AND (?2 < 0 OR number = ?2))",
        document, number);
    run(database, "DELETE FROM version_blob WHERE document = ?1 AND (?2 < 0 OR number = ?2)",
        document, number);
}

void drop_unused_blobs(SQLite::Database& database) {
    run(database, "DELETE FROM blob WHERE refs = 0");
}

/// Replaces the blobs of a draft; those that it has before and after stay as they are.
void replace_blobs(SQLite::Database& database, std::int64_t document,
                   const std::vector<Blob>& blobs) {
    untie_blobs(database, document, 0);
    insert_blobs(database, document, 0, blobs);
    drop_unused_blobs(database);
}

void insert_version(SQLite::Database& database, std::int64_t document, const Version& version) {
    const Content& content = version.content;
    run(database,
        "INSERT INTO version (document, number, revision, hash, format, kind, title, size, made, "
        "note, "
        "text) VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?)",
        document, version.number, version.revision, content.hash, content.format, content.kind,
        content.title, size_of_text(content), version.made, version.note, content.text);
    insert_blobs(database, document, version.number, content.blobs);
}

/// Adds to the bytes of an owner. Returns false, after which the transaction has to be rolled back, if these are
/// then too many.
bool add_bytes(SQLite::Database& database, std::int64_t owner, std::int64_t bytes) {
    run(database, "UPDATE owner SET used_bytes = used_bytes + ? WHERE id = ?", bytes, owner);
    return bytes <= 0 ||
           number(database, "SELECT used_bytes <= max_bytes FROM owner WHERE id = ?", owner) == 1;
}

/// Returns the pattern of LIKE that matches texts with this part.
std::string pattern_of(std::string_view part) {
    std::string pattern = "%";
    for (const char c : part) {
        if (c == '%' || c == '_' || c == '\\') pattern += '\\';
        pattern += c;
    }
    return pattern + '%';
}

// --- The database ---

/// The connections of this process to one file: one that writes, and as many readers as there are at once.
class Connections {
    std::filesystem::path file_;
    std::timed_mutex write_mutex_;
    std::atomic<bool> is_log_dirty_{false};  ///< the write-ahead log has purged bytes
    std::unique_ptr<SQLite::Database> writer_;
    std::mutex readers_mutex_;
    std::vector<std::unique_ptr<SQLite::Database>> idle_readers_;

    /// Calls a function and converts exceptions of SQLite.
    template <class Function>
    auto guarded(Function function) {
        try {
            return function();
        } catch (const SQLite::Exception& error) {
            unavailable(file_, error.what());
        }
    }

    [[nodiscard]] std::unique_ptr<SQLite::Database> connection() const {
        auto database = std::make_unique<SQLite::Database>(
            file_.string(), SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE, busy_ms);
        database->exec("PRAGMA journal_mode = WAL");
        database->exec("PRAGMA synchronous = FULL");
        database->exec("PRAGMA foreign_keys = ON");
        // Deleted bytes are overwritten, so that nothing of a purged document is left in the file.
        database->exec("PRAGMA secure_delete = ON");
        return database;
    }

    /// Waits until this thread may write, as long as for another process.
    std::unique_lock<std::timed_mutex> turn_to_write() {
        std::unique_lock lock(write_mutex_, std::chrono::milliseconds(busy_ms));
        if (!lock.owns_lock()) unavailable(file_, "too many wait to write to it");
        return lock;
    }

    /// Brings the schema up to date, one transaction for each step.
    void migrate() {
        for (;;) {
            SQLite::Transaction transaction(*writer_, SQLite::TransactionBehavior::IMMEDIATE);
            const std::int64_t schema = number(*writer_, "PRAGMA user_version").value_or(0);
            if (schema > sqlite_schema)
                unavailable(file_, "schema " + std::to_string(schema) +
                                       "; this server knows up to " +
                                       std::to_string(sqlite_schema));
            if (schema == sqlite_schema) return;
            writer_->exec(sqlite_migrations[schema]);
            writer_->exec("PRAGMA user_version = " + std::to_string(schema + 1));
            transaction.commit();
        }
    }

  public:
    explicit Connections(std::filesystem::path file) : file_(std::move(file)) {
        guarded([&] {
            writer_ = connection();
            migrate();
            return 0;
        });
    }

    /// Calls a function with a connection of its own.
    template <class Function>
    auto read(Function function) {
        return guarded([&] {
            std::unique_ptr<SQLite::Database> database;
            {
                const std::lock_guard lock(readers_mutex_);
                if (!idle_readers_.empty()) {
                    database = std::move(idle_readers_.back());
                    idle_readers_.pop_back();
                }
            }
            if (!database) database = connection();
            auto result = function(*database);
            const std::lock_guard lock(readers_mutex_);
            idle_readers_.push_back(std::move(database));
            return result;
        });
    }

    /// Calls a function in a transaction of the only writer of this process, and commits.
    template <class Function>
    auto write(Function function) {
        return guarded([&] {
            const std::unique_lock lock = turn_to_write();
            SQLite::Transaction transaction(*writer_, SQLite::TransactionBehavior::IMMEDIATE);
            auto result = function(*writer_);
            transaction.commit();
            return result;
        });
    }

    /// The same, but commits only what is done.
    template <class Function>
    Written write_or_roll_back(Function function) {
        Written written;
        guarded([&] {
            const std::unique_lock lock = turn_to_write();
            SQLite::Transaction transaction(*writer_, SQLite::TransactionBehavior::IMMEDIATE);
            written.result = function(*writer_, written);
            if (written.result == WriteResult::done) transaction.commit();
            return 0;
        });
        return written;
    }

    /// Empties the write-ahead log, which has what was deleted until then. Where a reader of another process needs it,
    /// this is tried again by the next call of empty_dirty_log().
    void empty_log() {
        guarded([&] {
            const std::unique_lock lock = turn_to_write();
            writer_->setBusyTimeout(100);
            is_log_dirty_ = number(*writer_, "PRAGMA wal_checkpoint(TRUNCATE)").value_or(1) != 0;
            writer_->setBusyTimeout(busy_ms);
            return 0;
        });
    }

    void empty_dirty_log() {
        if (is_log_dirty_) empty_log();
    }
};

class SqliteRecords final : public Records {
    Connections connections_;

    /// Calls a function in a transaction with a draft that exists and is the expected one, and commits what is done.
    ///
    /// returns  missing, purged or stale if it is not, else what the function returns; `current` and `revision` are
    ///          those of the draft as it was found, unless the function sets others
    template <class Function>
    Written write_draft(std::string_view owner, std::string_view name,
                        const std::optional<Digest>& expected, Function function) {
        return connections_.write_or_roll_back([&](SQLite::Database& database, Written& written) {
            const std::optional<OwnerRow> found_owner = owner_row(database, owner);
            if (!found_owner) return WriteResult::missing;
            const std::optional<DocumentRow> document =
                document_row(database, found_owner->id, name);
            if (!document) return WriteResult::missing;
            if (document->state == DocumentState::purged) return WriteResult::purged;
            const DraftToWrite found{found_owner->id, *document, draft_row(database, document->id)};
            written.current = found.draft.hash;
            written.revision = found.draft.revision;
            if (expected && *expected != found.draft.hash) return WriteResult::stale;
            return function(database, found, written);
        });
    }

  public:
    explicit SqliteRecords(const std::filesystem::path& file) : connections_(file) {}

    bool add_owner(std::string_view name, Seconds now) override {
        return connections_.write([&](SQLite::Database& database) {
            return run(database, "INSERT OR IGNORE INTO owner (name, created) VALUES (?, ?)", name,
                       now) == 1;
        });
    }

    std::optional<Owner> owner(std::string_view name) override {
        std::vector<Owner> found = owners_where("WHERE name = ?", name);
        if (found.empty()) return std::nullopt;
        return std::move(found.front());
    }

    std::vector<Owner> owners() override { return owners_where("WHERE ? = '' ORDER BY name", ""); }

    bool set_limits(std::string_view name, std::int64_t max_documents,
                    std::int64_t max_bytes) override {
        return connections_.write([&](SQLite::Database& database) {
            return run(database, "UPDATE owner SET max_documents = ?, max_bytes = ? WHERE name = ?",
                       max_documents, max_bytes, name) == 1;
        });
    }

    bool set_disabled(std::string_view name, bool is_disabled, Seconds now) override {
        return connections_.write([&](SQLite::Database& database) {
            return run(database, "UPDATE owner SET disabled = ? WHERE name = ?",
                       is_disabled ? std::optional<Seconds>(now) : std::nullopt, name) == 1;
        });
    }

    WriteResult add_token(const Token& token) override {
        return connections_.write([&](SQLite::Database& database) {
            const std::optional<OwnerRow> owner = owner_row(database, token.owner);
            if (!owner) return WriteResult::missing;
            const std::optional<std::int64_t> good =
                number(database,
                       "SELECT count(*) FROM token WHERE owner = ? AND revoked IS NULL AND "
                       "(expires IS NULL OR "
                       "expires > ?)",
                       owner->id, token.created);
            if (good >= most_tokens) return WriteResult::too_many;
            run(database,
                "INSERT INTO token (id, owner, secret_sha256, label, scope, created, expires) "
                "VALUES (?, "
                "?, ?, ?, ?, ?, ?)",
                token.id, owner->id, token.secret, token.label, std::string_view(name(token.scope)),
                token.created, token.expires);
            return WriteResult::done;
        });
    }

    std::optional<Token> token(std::string_view id) override {
        std::vector<Token> found = tokens_where("WHERE t.id = ?", id);
        if (found.empty()) return std::nullopt;
        return std::move(found.front());
    }

    std::vector<Token> tokens(std::string_view owner) override {
        return tokens_where("WHERE o.name = ? ORDER BY t.created, t.id", owner);
    }

    bool revoke_token(std::string_view owner, std::string_view id, Seconds now) override {
        return connections_.write([&](SQLite::Database& database) {
            return run(database,
                       "UPDATE token SET revoked = coalesce(revoked, ?) WHERE id = ? AND owner = "
                       "(SELECT "
                       "id FROM owner WHERE name = ?)",
                       now, id, owner) == 1;
        });
    }

    void note_use(std::string_view id, Seconds now) override {
        const bool is_old = connections_.read([&](SQLite::Database& database) {
            return number(database,
                          "SELECT 1 FROM token WHERE id = ? AND coalesce(last_used, 0) <= ?", id,
                          now - 60)
                .has_value();
        });
        if (!is_old) return;
        connections_.write([&](SQLite::Database& database) {
            return run(database, "UPDATE token SET last_used = ? WHERE id = ?", now, id);
        });
    }

    Written create(std::string_view owner, std::string_view name, const Content& content,
                   std::string_view parent, std::string_view parent2, Seconds now) override {
        Version draft;
        draft.made = now;
        draft.content = content;
        StoredDocument document;
        document.owner = owner;
        document.name = name;
        document.parent = parent;
        document.parent2 = parent2;
        document.created = document.updated = now;
        return restore(document, {std::move(draft)});
    }

    Written restore(const StoredDocument& document, const std::vector<Version>& versions) override {
        return connections_.write_or_roll_back([&](SQLite::Database& database, Written& written) {
            const std::optional<OwnerRow> owner = owner_row(database, document.owner);
            if (!owner) return WriteResult::missing;
            if (document_row(database, owner->id, document.name)) return WriteResult::taken;
            if (owner->documents >= owner->max_documents ||
                versions.size() > static_cast<std::size_t>(most_versions) + 1)
                return WriteResult::too_many;
            Digests digests;
            for (const Version& version : versions) {
                const Digests own = digests_of(version.content);
                digests.insert(own.begin(), own.end());
                written.number = std::max(written.number, version.number);
                if (version.number > 0) continue;
                written.current = version.content.hash;
                written.revision = version.revision;
            }
            run(database,
                "INSERT INTO document (owner, name, newest, state, parent, parent2, created, "
                "updated) "
                "VALUES (?, ?, ?, ?, ?, ?, ?, ?)",
                owner->id, document.name, written.number,
                std::string_view(api::name(document.state)), document.parent, document.parent2,
                document.created, document.updated);
            const std::int64_t id = database.getLastInsertRowid();
            std::int64_t bytes = -bytes_of_blobs(database, owner->id, digests);
            for (const Version& version : versions) {
                insert_version(database, id, version);
                bytes += size_of_text(version.content);
            }
            bytes += bytes_of_blobs(database, owner->id, digests);
            run(database, "UPDATE owner SET documents = documents + 1 WHERE id = ?", owner->id);
            if (written.number > 0) mark_changed(database, id);
            return add_bytes(database, owner->id, bytes) ? WriteResult::done
                                                         : WriteResult::too_large;
        });
    }

    Written replace(std::string_view owner, std::string_view name,
                    const std::optional<Digest>& expected, const Content& content,
                    Seconds now) override {
        return write_draft(
            owner, name, expected,
            [&](SQLite::Database& database, const DraftToWrite& found, Written& written) {
                Digests digests = digests_of(database, found.document.id, 0);
                const Digests added = digests_of(content);
                digests.insert(added.begin(), added.end());
                std::int64_t bytes =
                    -bytes_of_blobs(database, found.owner, digests) - found.draft.size;
                replace_blobs(database, found.document.id, content.blobs);
                run(database,
                    "UPDATE version SET revision = revision + 1, hash = ?, format = ?, kind = ?, "
                    "title "
                    "= ?, "
                    "size = ?, made = ?, text = ? WHERE document = ? AND number = 0",
                    content.hash, content.format, content.kind, content.title,
                    size_of_text(content), now, content.text, found.document.id);
                run(database, "UPDATE document SET updated = ? WHERE id = ?", now,
                    found.document.id);
                bytes += bytes_of_blobs(database, found.owner, digests) + size_of_text(content);
                written.current = content.hash;
                written.revision = found.draft.revision + 1;
                return add_bytes(database, found.owner, bytes) ? WriteResult::done
                                                               : WriteResult::too_large;
            });
    }

    Written publish(std::string_view owner, std::string_view name,
                    const std::optional<Digest>& expected, std::string_view note,
                    Seconds now) override {
        return write_draft(
            owner, name, expected,
            [&](SQLite::Database& database, const DraftToWrite& found, Written& written) {
                if (found.document.newest >= most_versions) return WriteResult::too_many;
                written.number = found.document.newest + 1;
                run(database,
                    "INSERT INTO version (document, number, revision, hash, format, kind, title, "
                    "size, "
                    "made, "
                    "note, text) SELECT document, ?1, revision, hash, format, kind, title, size, "
                    "?2, "
                    "?3, text "
                    "FROM version WHERE document = ?4 AND number = 0",
                    written.number, now, note, found.document.id);
                run(database,
                    "INSERT INTO version_blob (document, number, place, sha256) SELECT document, "
                    "?1, "
                    "place, "
                    "sha256 FROM version_blob WHERE document = ?2 AND number = 0",
                    written.number, found.document.id);
                run(database,
                    "UPDATE blob SET refs = refs + (SELECT count(*) FROM version_blob v WHERE "
                    "v.sha256 "
                    "= "
                    "blob.sha256 AND v.document = ?1 AND v.number = ?2) WHERE sha256 IN (SELECT "
                    "sha256 "
                    "FROM "
                    "version_blob WHERE document = ?1 AND number = ?2)",
                    found.document.id, written.number);
                // Publishing what was withdrawn puts it into lists again.
                run(database,
                    "UPDATE document SET newest = ?, updated = ?, state = 'active' WHERE id = ?",
                    written.number, now, found.document.id);
                mark_changed(database, found.document.id);
                return add_bytes(database, found.owner, found.draft.size) ? WriteResult::done
                                                                          : WriteResult::too_large;
            });
    }

    Written withdraw(std::string_view owner, std::string_view name,
                     const std::optional<Digest>& expected, bool is_purged, Seconds now) override {
        const Written done = write_draft(
            owner, name, expected,
            [&](SQLite::Database& database, const DraftToWrite& found, Written&) {
                // Of what was never published nobody else knows.
                if (found.document.newest > 0) mark_changed(database, found.document.id);
                if (!is_purged) {
                    run(database,
                        "UPDATE document SET state = 'unlisted', updated = ? WHERE id = ?", now,
                        found.document.id);
                    return WriteResult::done;
                }
                const Digests digests = digests_of(database, found.document.id, -1);
                std::int64_t bytes = -bytes_of_blobs(database, found.owner, digests);
                bytes -= number(database, "SELECT sum(size) FROM version WHERE document = ?",
                                found.document.id)
                             .value_or(0);
                untie_blobs(database, found.document.id, -1);
                drop_unused_blobs(database);
                run(database, "DELETE FROM version WHERE document = ?", found.document.id);
                run(database, "DELETE FROM share WHERE document = ?", found.document.id);
                bytes += bytes_of_blobs(database, found.owner, digests);
                run(database,
                    "UPDATE document SET state = 'purged', updated = ?, parent = '', parent2 = '' "
                    "WHERE id = ?",
                    now, found.document.id);
                run(database, "UPDATE owner SET documents = documents - 1 WHERE id = ?",
                    found.owner);
                add_bytes(database, found.owner, bytes);
                return WriteResult::done;
            });
        // The write-ahead log has the purged bytes until it is emptied.
        if (is_purged && done.result == WriteResult::done) connections_.empty_log();
        return done;
    }

    std::optional<StoredDocument> document(std::string_view owner, std::string_view name) override {
        return connections_.read([&](SQLite::Database& database) -> std::optional<StoredDocument> {
            SQLite::Statement statement = prepared(database,
                                                   "SELECT o.name, d.name, d.newest, d.state, "
                                                   "d.parent, d.parent2, d.created, d.updated, "
                                                   "coalesce(v.kind, ''), coalesce(v.title, '') "
                                                   "FROM document d JOIN owner o ON o.id = "
                                                   "d.owner LEFT JOIN version v ON v.document = "
                                                   "d.id AND v.number = d.newest WHERE o.name = "
                                                   "? AND d.name = ?",
                                                   owner, name);
            if (!statement.executeStep()) return std::nullopt;
            return document_in(statement);
        });
    }

    std::optional<Version> version(std::string_view owner, std::string_view name,
                                   int number) override {
        return connections_.read([&](SQLite::Database& database) -> std::optional<Version> {
            // One transaction, so that text and blobs are those of the same moment.
            const SQLite::Transaction transaction(database);
            const std::optional<DocumentRow> document = document_row(database, owner, name);
            if (!document) return std::nullopt;
            SQLite::Statement statement = prepared(
                database,
                "SELECT number, revision, made, note, text, hash, format, kind, title FROM "
                "version WHERE document = ? AND number = ?",
                document->id, number);
            if (!statement.executeStep()) return std::nullopt;
            Version found;
            found.number = statement.getColumn(0).getInt();
            found.revision = statement.getColumn(1).getInt64();
            found.made = statement.getColumn(2).getInt64();
            found.note = statement.getColumn(3).getString();
            found.content.text = statement.getColumn(4).getString();
            found.content.hash = digest_in(statement.getColumn(5));
            found.content.format = statement.getColumn(6).getInt();
            found.content.kind = statement.getColumn(7).getString();
            found.content.title = statement.getColumn(8).getString();
            SQLite::Statement blobs =
                prepared(database,
                         "SELECT v.place, b.media, b.sha256, b.bytes FROM version_blob v JOIN blob "
                         "b ON b.sha256 = "
                         "v.sha256 WHERE v.document = ? AND v.number = ? ORDER BY v.place",
                         document->id, number);
            while (blobs.executeStep()) {
                const SQLite::Column bytes = blobs.getColumn(3);
                const auto* const begin = static_cast<const std::uint8_t*>(bytes.getBlob());
                found.content.blobs.push_back({blobs.getColumn(0).getString(),
                                               blobs.getColumn(1).getString(),
                                               digest_in(blobs.getColumn(2)),
                                               {begin, begin + bytes.getBytes()}});
            }
            return found;
        });
    }

    std::vector<StoredDocument> list(const Listing& listing) override {
        return connections_.read([&](SQLite::Database& database) {
            const std::string_view state = listing.state ? name(*listing.state) : "";
            // Others see what is published and listed; the reader sees all that is not purged, by its draft.
            SQLite::Statement statement = prepared(
                database,
                "SELECT o.name, d.name, d.newest, d.state, d.parent, d.parent2, d.created, "
                "d.updated, "
                "v.kind, v.title FROM document d JOIN owner o ON o.id = d.owner JOIN version v ON "
                "v.document = d.id AND v.number = iif(o.name = ?1, 0, d.newest) WHERE d.state <> "
                "'purged' "
                "AND (o.name = ?1 OR (d.state = 'active' AND d.newest > 0)) AND (?2 = '' OR o.name "
                "= ?2) "
                "AND (?3 = '' OR v.kind = ?3) AND (?4 = '' OR d.parent = ?4 OR d.parent2 = ?4 OR "
                "substr(d.parent, 1, length(?4) + 1) = ?4 || '@' OR substr(d.parent2, 1, "
                "length(?4) + 1) = "
                "?4 || '@') AND (?5 = '' OR d.state = ?5) AND (?6 = '%%' OR d.name LIKE ?6 ESCAPE "
                "'\\' OR "
                "v.title LIKE ?6 ESCAPE '\\') AND (o.name, d.name) > (?7, ?8) ORDER BY o.name, "
                "d.name "
                "LIMIT ?9",
                listing.reader, listing.owner, listing.kind, listing.parent, state,
                pattern_of(listing.part), listing.after_owner, listing.after_name, listing.limit);
            std::vector<StoredDocument> documents;
            while (statement.executeStep()) documents.push_back(document_in(statement));
            return documents;
        });
    }

    std::vector<Change> changes(std::int64_t since) override {
        connections_.empty_dirty_log();
        return connections_.read([&](SQLite::Database& database) {
            const SQLite::Transaction transaction(database);
            SQLite::Statement statement = prepared(database,
                                                   "SELECT d.id, d.serial, o.name, d.name, d.state "
                                                   "FROM document d JOIN owner o ON o.id = "
                                                   "d.owner WHERE d.serial > ? ORDER BY d.serial",
                                                   since);
            std::vector<Change> changes;
            while (statement.executeStep()) {
                Change change{statement.getColumn(1).getInt64(),
                              statement.getColumn(2).getString(),
                              statement.getColumn(3).getString(),
                              named_in(statement.getColumn(4), states),
                              {}};
                SQLite::Statement versions = prepared(database,
                                                      "SELECT number, hash FROM version WHERE "
                                                      "document = ? AND number > 0 ORDER BY number",
                                                      statement.getColumn(0).getInt64());
                while (versions.executeStep())
                    change.versions.emplace_back(versions.getColumn(0).getInt(),
                                                 digest_in(versions.getColumn(1)));
                changes.push_back(std::move(change));
            }
            return changes;
        });
    }

    WriteResult add_share(std::string_view owner, std::string_view name,
                          const Share& share) override {
        return connections_.write([&](SQLite::Database& database) {
            const std::optional<DocumentRow> document = document_row(database, owner, name);
            if (!document) return WriteResult::missing;
            if (document->state == DocumentState::purged) return WriteResult::purged;
            run(database,
                "DELETE FROM share WHERE document = ?1 AND (revoked IS NOT NULL OR expires <= ?2) "
                "AND (SELECT "
                "count(*) FROM share WHERE document = ?1) >= ?3",
                document->id, share.created, most_shown * most_shares);
            const std::optional<std::int64_t> good = number(
                database,
                "SELECT count(*) FROM share WHERE document = ? AND revoked IS NULL AND expires > ?",
                document->id, share.created);
            if (good >= most_shares) return WriteResult::too_many;
            run(database,
                "INSERT INTO share (id, document, secret_sha256, created, expires) VALUES (?, ?, "
                "?, ?, ?)",
                share.id, document->id, share.secret, share.created, share.expires);
            return WriteResult::done;
        });
    }

    std::vector<Share> shares(std::string_view owner, std::string_view name) override {
        return shares_where(owner, name, "");
    }

    std::optional<Share> share(std::string_view owner, std::string_view name,
                               std::string_view id) override {
        std::vector<Share> found = shares_where(owner, name, id);
        if (found.empty()) return std::nullopt;
        return std::move(found.front());
    }

    bool revoke_share(std::string_view owner, std::string_view name, std::string_view id) override {
        return connections_.write([&](SQLite::Database& database) {
            const std::optional<DocumentRow> document = document_row(database, owner, name);
            return document &&
                   run(database,
                       "UPDATE share SET revoked = coalesce(revoked, 1) WHERE id = ? AND "
                       "document = ?",
                       id, document->id) == 1;
        });
    }

  private:
    static StoredDocument document_in(SQLite::Statement& statement) {
        StoredDocument document;
        document.owner = statement.getColumn(0).getString();
        document.name = statement.getColumn(1).getString();
        document.newest = statement.getColumn(2).getInt();
        document.state = named_in(statement.getColumn(3), states);
        document.parent = statement.getColumn(4).getString();
        document.parent2 = statement.getColumn(5).getString();
        document.created = statement.getColumn(6).getInt64();
        document.updated = statement.getColumn(7).getInt64();
        document.kind = statement.getColumn(8).getString();
        document.title = statement.getColumn(9).getString();
        return document;
    }

    /// Returns the shares of a document, or that with an id.
    std::vector<Share> shares_where(std::string_view owner, std::string_view name,
                                    std::string_view id) {
        return connections_.read([&](SQLite::Database& database) {
            SQLite::Statement statement =
                prepared(database,
                         "SELECT s.id, s.secret_sha256, s.created, s.expires, s.revoked IS NOT "
                         "NULL FROM share s "
                         "JOIN document d ON d.id = s.document JOIN owner o ON o.id = d.owner "
                         "WHERE o.name = ?1 AND "
                         "d.name = ?2 AND (?3 = '' OR s.id = ?3) ORDER BY s.created, s.id",
                         owner, name, id);
            std::vector<Share> shares;
            while (statement.executeStep())
                shares.push_back(
                    {statement.getColumn(0).getString(), digest_in(statement.getColumn(1)),
                     statement.getColumn(2).getInt64(), statement.getColumn(3).getInt64(),
                     statement.getColumn(4).getInt() != 0});
            return shares;
        });
    }

    std::vector<Owner> owners_where(const char* condition, std::string_view value) {
        return connections_.read([&](SQLite::Database& database) {
            SQLite::Statement statement = prepared(
                database,
                (std::string(
                     "SELECT name, created, disabled IS NOT NULL, documents, max_documents, "
                     "used_bytes, max_bytes FROM owner ") +
                 condition)
                    .c_str(),
                value);
            std::vector<Owner> owners;
            while (statement.executeStep())
                owners.push_back(
                    {statement.getColumn(0).getString(), statement.getColumn(1).getInt64(),
                     statement.getColumn(2).getInt() != 0, statement.getColumn(3).getInt64(),
                     statement.getColumn(4).getInt64(), statement.getColumn(5).getInt64(),
                     statement.getColumn(6).getInt64()});
            return owners;
        });
    }

    std::vector<Token> tokens_where(const char* condition, std::string_view value) {
        return connections_.read([&](SQLite::Database& database) {
            SQLite::Statement statement = prepared(
                database,
                (std::string("SELECT t.id, o.name, t.secret_sha256, t.label, t.scope, t.created, "
                             "t.expires, t.last_used, t.revoked, o.disabled IS NOT NULL FROM token "
                             "t JOIN owner o ON o.id = t.owner ") +
                 condition)
                    .c_str(),
                value);
            std::vector<Token> tokens;
            while (statement.executeStep()) {
                Token token;
                token.id = statement.getColumn(0).getString();
                token.owner = statement.getColumn(1).getString();
                token.secret = digest_in(statement.getColumn(2));
                token.label = statement.getColumn(3).getString();
                token.scope = named_in(statement.getColumn(4), scopes);
                token.created = statement.getColumn(5).getInt64();
                token.expires = time_in(statement.getColumn(6));
                token.last_used = time_in(statement.getColumn(7));
                token.revoked = time_in(statement.getColumn(8));
                token.is_owner_disabled = statement.getColumn(9).getInt() != 0;
                tokens.push_back(std::move(token));
            }
            return tokens;
        });
    }
};

}  // namespace

std::unique_ptr<Records> open_sqlite_records(const std::filesystem::path& file) {
    std::error_code error;
    if (file.has_parent_path() && !std::filesystem::is_directory(file.parent_path(), error))
        unavailable(file, "its folder does not exist");
    // Nobody else on the machine may read drafts. The files beside it have the permissions of this one.
    const int descriptor = ::open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, S_IRUSR | S_IWUSR);
    if (descriptor >= 0) ::close(descriptor);
    return std::make_unique<SqliteRecords>(file);
}

void back_up_sqlite_records(const std::filesystem::path& from, const std::filesystem::path& to) {
    std::error_code error;
    if (std::filesystem::exists(to, error)) unavailable(to, "exists already");
    try {
        SQLite::Database database(from.string(), SQLite::OPEN_READONLY, busy_ms);
        SQLite::Statement statement = prepared(database, "VACUUM INTO ?", to.string());
        statement.exec();
    } catch (const SQLite::Exception& failure) {
        unavailable(from, failure.what());
    }
}

}  // namespace sporeprint::server
