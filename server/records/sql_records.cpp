#include "server/records/sql_records.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <utility>

#include "api/http/errors.h"

namespace sporeprint::server {

namespace {

using namespace api;

/// Tokens and shares that are revoked or expired are listed until there are so many times more than may be good.
constexpr std::int64_t most_shown = 4;

// --- Statements ---

SqlParameter parameter_of(std::int64_t value) { return value; }
SqlParameter parameter_of(std::string_view text) { return text; }
SqlParameter parameter_of(std::span<const std::uint8_t> bytes) { return bytes; }
SqlParameter parameter_of(const std::optional<Seconds>& time) {
    return time ? SqlParameter(*time) : SqlParameter();
}

/// Executes a statement with its parameters.
template <class... Values>
SqlResult execute(SqlConnection& sql, const char* statement, const Values&... values) {
    const std::array<SqlParameter, sizeof...(Values)> parameters = {parameter_of(values)...};
    return sql.execute(statement, parameters);
}

/// Executes a statement that returns no rows, and returns the number of rows that it has changed.
template <class... Values>
std::int64_t run(SqlConnection& sql, const char* statement, const Values&... values) {
    return execute(sql, statement, values...).changed;
}

std::int64_t number_in(const SqlValue& value) { return std::get<std::int64_t>(value); }

int small_number_in(const SqlValue& value) { return static_cast<int>(number_in(value)); }

const std::string& text_in(const SqlValue& value) { return std::get<std::string>(value); }

std::optional<Seconds> time_in(const SqlValue& value) {
    if (std::holds_alternative<std::monostate>(value)) return std::nullopt;
    return number_in(value);
}

Digest digest_in(const SqlValue& value) {
    const auto& bytes = std::get<std::vector<std::uint8_t>>(value);
    Digest digest{};
    if (bytes.size() == digest.size()) std::memcpy(digest.data(), bytes.data(), digest.size());
    return digest;
}

template <class Enum, std::size_t Count>
Enum named_in(const SqlValue& value, const std::array<Enum, Count>& all) {
    for (const Enum one : all)
        if (text_in(value) == api::name(one)) return one;
    throw Unavailable("the database of the library has an unknown word, " + text_in(value));
}

constexpr std::array scopes = {Scope::read, Scope::write, Scope::admin};
constexpr std::array states = {DocumentState::active, DocumentState::unlisted,
                               DocumentState::purged};

/// Returns the first column of the first row as a number; nothing if there is no row, or NULL.
template <class... Values>
std::optional<std::int64_t> number(SqlConnection& sql, const char* statement,
                                   const Values&... values) {
    const SqlResult result = execute(sql, statement, values...);
    return result.rows.empty() ? std::nullopt : time_in(result.rows.front().front());
}

// --- Rows ---

/// Returns what a function makes of each row.
template <class Function>
auto each_of(const SqlResult& result, Function function) {
    std::vector<decltype(function(std::declval<const SqlRow&>()))> made;
    made.reserve(result.rows.size());
    for (const SqlRow& row : result.rows) made.push_back(function(row));
    return made;
}

struct OwnerRow {
    std::int64_t id, documents, max_documents;
};

/// Returns an owner whose documents no other transaction can write until the end of this one.
std::optional<OwnerRow> owner_to_write(SqlConnection& sql, std::string_view name) {
    const std::string statement =
        std::string("SELECT id, documents, max_documents FROM owner WHERE name = $1") +
        sql.for_update();
    const SqlResult found = execute(sql, statement.c_str(), name);
    if (found.rows.empty()) return std::nullopt;
    const SqlRow& row = found.rows.front();
    return OwnerRow{number_in(row[0]), number_in(row[1]), number_in(row[2])};
}

struct DocumentRow {
    std::int64_t id;
    int newest;
    DocumentState state;
};

std::optional<DocumentRow> document_row(SqlConnection& sql, std::string_view owner,
                                        std::string_view name) {
    const SqlResult found =
        execute(sql,
                "SELECT d.id, d.newest, d.state FROM document d JOIN owner o ON o.id = d.owner "
                "WHERE o.name = $1 AND d.name = $2",
                owner, name);
    if (found.rows.empty()) return std::nullopt;
    const SqlRow& row = found.rows.front();
    return DocumentRow{number_in(row[0]), small_number_in(row[1]), named_in(row[2], states)};
}

struct DraftRow {
    Digest hash;
    std::int64_t revision, size;
};

DraftRow draft_row(SqlConnection& sql, std::int64_t document) {
    const SqlResult found =
        execute(sql, "SELECT hash, revision, size FROM version WHERE document = $1 AND number = 0",
                document);
    if (found.rows.empty())
        throw Unavailable("the database of the library has a document without a draft");
    const SqlRow& row = found.rows.front();
    return {digest_in(row[0]), number_in(row[1]), number_in(row[2])};
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

/// Gives a document the next serial number, by which others learn of its change. This is the last statement of a
/// transaction, since all writers wait for it.
void mark_changed(SqlConnection& sql, std::int64_t document) {
    run(sql, "UPDATE counter SET serial = serial + 1");
    run(sql, "UPDATE document SET serial = (SELECT serial FROM counter) WHERE id = $1", document);
    sql.announce_change();
}

// --- Blobs ---

using Digests = std::set<Digest>;

Digests digests_of(const std::vector<Blob>& blobs) {
    Digests digests;
    for (const Blob& blob : blobs) digests.insert(blob.sha256);
    return digests;
}

/// Returns the digests of the blobs of a version, or of all versions of a document for a negative number.
Digests digests_of(SqlConnection& sql, std::int64_t document, int number) {
    const SqlResult found = execute(sql,
                                    "SELECT DISTINCT sha256 FROM version_blob WHERE document = $1 "
                                    "AND ($2 < 0 OR number = $2)",
                                    document, number);
    Digests digests;
    for (const SqlRow& row : found.rows) digests.insert(digest_in(row[0]));
    return digests;
}

/// Returns the bytes of those blobs that the documents of an owner have.
std::int64_t bytes_of_blobs(SqlConnection& sql, std::int64_t owner, const Digests& digests) {
    std::int64_t bytes = 0;
    for (const Digest& digest : digests)
        bytes += number(sql,
                        "SELECT size FROM blob WHERE sha256 = $1 AND EXISTS (SELECT 1 FROM "
                        "version_blob v JOIN document d ON d.id = v.document "
                        "WHERE v.sha256 = $1 AND d.owner = $2)",
                        digest, owner)
                     .value_or(0);
    return bytes;
}

void insert_blobs(SqlConnection& sql, std::int64_t document, int number,
                  const std::vector<Blob>& blobs) {
    for (const Blob& blob : blobs) {
        run(sql,
            "INSERT INTO blob (sha256, media, size, refs, bytes) VALUES ($1, $2, $3, 1, $4) "
            "ON CONFLICT (sha256) DO UPDATE SET refs = blob.refs + 1",
            blob.sha256, blob.media, static_cast<std::int64_t>(blob.bytes.size()),
            std::span<const std::uint8_t>(blob.bytes));
        run(sql,
            "INSERT INTO version_blob (document, number, place, sha256) VALUES ($1, $2, $3, $4)",
            document, number, blob.place, blob.sha256);
    }
}

/// Gives a version the blobs of the draft.
void tie_blobs_of_draft(SqlConnection& sql, std::int64_t document, int number) {
    run(sql,
        "INSERT INTO version_blob (document, number, place, sha256) SELECT document, $1, place, "
        "sha256 FROM version_blob WHERE document = $2 AND number = 0",
        number, document);
    run(sql,
        "UPDATE blob SET refs = refs + (SELECT count(*) FROM version_blob v WHERE v.sha256 = "
        "blob.sha256 AND v.document = $1 AND v.number = $2) WHERE sha256 IN (SELECT sha256 FROM "
        "version_blob WHERE document = $1 AND number = $2)",
        document, number);
}

/// Unties the blobs of a version, or of all versions for a negative number. drop_unused_blobs() deletes those that
/// nothing uses any more. They are reserved.
void untie_blobs(SqlConnection& sql, std::int64_t document, int number) {
    run(sql,
        "UPDATE blob SET refs = refs - (SELECT count(*) FROM version_blob v WHERE v.sha256 = "
        "blob.sha256 AND v.document = $1 AND ($2 < 0 OR v.number = $2)) WHERE sha256 IN (SELECT "
        "sha256 FROM version_blob WHERE document = $1 AND ($2 < 0 OR number = $2))",
        document, number);
    run(sql, "DELETE FROM version_blob WHERE document = $1 AND ($2 < 0 OR number = $2)", document,
        number);
}

void drop_unused_blobs(SqlConnection& sql) { run(sql, "DELETE FROM blob WHERE refs = 0"); }

/// Replaces the blobs of a draft; those that it has before and after stay as they are.
void replace_blobs(SqlConnection& sql, std::int64_t document, const std::vector<Blob>& blobs) {
    untie_blobs(sql, document, 0);
    insert_blobs(sql, document, 0, blobs);
    drop_unused_blobs(sql);
}

void insert_version(SqlConnection& sql, std::int64_t document, const Version& version) {
    const Content& content = version.content;
    run(sql,
        "INSERT INTO version (document, number, revision, hash, format, kind, title, size, made, "
        "note, text) VALUES ($1, $2, $3, $4, $5, $6, $7, $8, $9, $10, $11)",
        document, version.number, version.revision, content.hash, content.format, content.kind,
        content.title, size_of_text(content), version.made, version.note, content.text);
    insert_blobs(sql, document, version.number, content.blobs);
}

/// Adds to the bytes of an owner. Returns false, after which the transaction has to be rolled back, if these are
/// then too many.
bool add_bytes(SqlConnection& sql, std::int64_t owner, std::int64_t bytes) {
    run(sql, "UPDATE owner SET used_bytes = used_bytes + $1 WHERE id = $2", bytes, owner);
    return bytes <= 0 ||
           number(sql, "SELECT 1 FROM owner WHERE id = $1 AND used_bytes <= max_bytes", owner)
               .has_value();
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

class SqlRecords final : public Records {
    std::unique_ptr<SqlDatabase> database_;

    /// Calls a function that reads, and returns its result.
    template <class Function>
    auto read(Function function) {
        decltype(function(std::declval<SqlConnection&>())) result;
        database_->read([&](SqlConnection& sql) { result = function(sql); });
        return result;
    }

    template <class Function>
    auto read_at_one_moment(Function function) {
        decltype(function(std::declval<SqlConnection&>())) result;
        database_->read_at_one_moment([&](SqlConnection& sql) { result = function(sql); });
        return result;
    }

    /// Calls a function in a transaction that is committed, and returns its result.
    template <class Function>
    auto write(Function function) {
        decltype(function(std::declval<SqlConnection&>())) result;
        database_->write([&](SqlConnection& sql) {
            result = function(sql);
            return true;
        });
        return result;
    }

    /// The same, but commits only what is done.
    template <class Function>
    Written write_or_roll_back(Function function) {
        Written written;
        database_->write([&](SqlConnection& sql) {
            written = {};
            written.result = function(sql, written);
            return written.result == WriteResult::done;
        });
        return written;
    }

    /// Calls a function in a transaction with a draft that exists and is the expected one, and commits what is done.
    ///
    /// returns  missing, purged or stale if it is not, else what the function returns; `current` and `revision` are
    ///          those of the draft as it was found, unless the function sets others
    template <class Function>
    Written write_draft(std::string_view owner, std::string_view name,
                        const std::optional<Digest>& expected, Function function) {
        return write_or_roll_back([&](SqlConnection& sql, Written& written) {
            const std::optional<OwnerRow> found_owner = owner_to_write(sql, owner);
            if (!found_owner) return WriteResult::missing;
            const std::optional<DocumentRow> document = document_row(sql, owner, name);
            if (!document) return WriteResult::missing;
            if (document->state == DocumentState::purged) return WriteResult::purged;
            const DraftToWrite found{found_owner->id, *document, draft_row(sql, document->id)};
            written.current = found.draft.hash;
            written.revision = found.draft.revision;
            if (expected && *expected != found.draft.hash) return WriteResult::stale;
            return function(sql, found, written);
        });
    }

  public:
    explicit SqlRecords(std::unique_ptr<SqlDatabase> database) : database_(std::move(database)) {}

    // --- Owners ---

    bool add_owner(std::string_view name, Seconds now) override {
        return write([&](SqlConnection& sql) {
            return run(sql,
                       "INSERT INTO owner (name, created) VALUES ($1, $2) ON CONFLICT DO NOTHING",
                       name, now) == 1;
        });
    }

    std::optional<Owner> owner(std::string_view name) override {
        std::vector<Owner> found = owners_where("WHERE name = $1", name);
        if (found.empty()) return std::nullopt;
        return std::move(found.front());
    }

    std::vector<Owner> owners() override { return owners_where("WHERE $1 = '' ORDER BY name", ""); }

    bool set_limits(std::string_view name, std::int64_t max_documents,
                    std::int64_t max_bytes) override {
        return write([&](SqlConnection& sql) {
            return run(sql, "UPDATE owner SET max_documents = $1, max_bytes = $2 WHERE name = $3",
                       max_documents, max_bytes, name) == 1;
        });
    }

    bool set_disabled(std::string_view name, bool is_disabled, Seconds now) override {
        return write([&](SqlConnection& sql) {
            return run(sql, "UPDATE owner SET disabled = $1 WHERE name = $2",
                       is_disabled ? std::optional<Seconds>(now) : std::nullopt, name) == 1;
        });
    }

    // --- Tokens ---

    WriteResult add_token(const Token& token) override {
        return write([&](SqlConnection& sql) {
            const std::optional<OwnerRow> owner = owner_to_write(sql, token.owner);
            if (!owner) return WriteResult::missing;
            const std::optional<std::int64_t> good =
                number(sql,
                       "SELECT count(*) FROM token WHERE owner = $1 AND revoked IS NULL AND "
                       "(expires IS NULL OR expires > $2)",
                       owner->id, token.created);
            if (good >= most_tokens) return WriteResult::too_many;
            run(sql,
                "INSERT INTO token (id, owner, secret_sha256, label, scope, created, expires) "
                "VALUES ($1, $2, $3, $4, $5, $6, $7)",
                token.id, owner->id, token.secret, token.label, std::string_view(name(token.scope)),
                token.created, token.expires);
            return WriteResult::done;
        });
    }

    std::optional<Token> token(std::string_view id) override {
        std::vector<Token> found = tokens_where("WHERE t.id = $1", id);
        if (found.empty()) return std::nullopt;
        return std::move(found.front());
    }

    std::vector<Token> tokens(std::string_view owner) override {
        return tokens_where("WHERE o.name = $1 ORDER BY t.created, t.id", owner);
    }

    bool revoke_token(std::string_view owner, std::string_view id, Seconds now) override {
        return write([&](SqlConnection& sql) {
            return run(sql,
                       "UPDATE token SET revoked = coalesce(revoked, $1) WHERE id = $2 AND owner = "
                       "(SELECT id FROM owner WHERE name = $3)",
                       now, id, owner) == 1;
        });
    }

    void note_use(std::string_view id, Seconds now) override {
        const bool is_old = read([&](SqlConnection& sql) {
            return number(sql, "SELECT 1 FROM token WHERE id = $1 AND coalesce(last_used, 0) <= $2",
                          id, now - 60)
                .has_value();
        });
        if (!is_old) return;
        write([&](SqlConnection& sql) {
            return run(sql, "UPDATE token SET last_used = $1 WHERE id = $2", now, id);
        });
    }

    // --- Documents ---

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
        return write_or_roll_back([&](SqlConnection& sql, Written& written) {
            const std::optional<OwnerRow> owner = owner_to_write(sql, document.owner);
            if (!owner) return WriteResult::missing;
            if (document_row(sql, document.owner, document.name)) return WriteResult::taken;
            const bool is_purged = document.state == DocumentState::purged;
            if ((!is_purged && owner->documents >= owner->max_documents) ||
                versions.size() > static_cast<std::size_t>(most_versions) + 1)
                return WriteResult::too_many;
            Digests digests;
            for (const Version& version : versions) {
                digests.merge(digests_of(version.content.blobs));
                written.number = std::max(written.number, version.number);
                if (version.number > 0) continue;
                written.current = version.content.hash;
                written.revision = version.revision;
            }
            const int newest = is_purged ? document.newest : written.number;
            const std::int64_t id =
                number(sql,
                       "INSERT INTO document (owner, name, newest, state, parent, parent2, "
                       "created, updated) VALUES ($1, $2, $3, $4, $5, $6, $7, $8) RETURNING id",
                       owner->id, document.name, newest,
                       std::string_view(api::name(document.state)), document.parent,
                       document.parent2, document.created, document.updated)
                    .value_or(0);
            if (!digests.empty()) sql.reserve_shared_rows();
            std::int64_t bytes = -bytes_of_blobs(sql, owner->id, digests);
            for (const Version& version : versions) {
                insert_version(sql, id, version);
                bytes += size_of_text(version.content);
            }
            bytes += bytes_of_blobs(sql, owner->id, digests);
            if (!is_purged)
                run(sql, "UPDATE owner SET documents = documents + 1 WHERE id = $1", owner->id);
            if (!add_bytes(sql, owner->id, bytes)) return WriteResult::too_large;
            if (newest > 0) mark_changed(sql, id);
            return WriteResult::done;
        });
    }

    Written replace(std::string_view owner, std::string_view name,
                    const std::optional<Digest>& expected, const Content& content,
                    Seconds now) override {
        return write_draft(
            owner, name, expected,
            [&](SqlConnection& sql, const DraftToWrite& found, Written& written) {
                Digests digests = digests_of(sql, found.document.id, 0);
                digests.merge(digests_of(content.blobs));
                std::int64_t bytes = -bytes_of_blobs(sql, found.owner, digests) - found.draft.size;
                if (!digests.empty()) {
                    sql.reserve_shared_rows();
                    replace_blobs(sql, found.document.id, content.blobs);
                }
                run(sql,
                    "UPDATE version SET revision = revision + 1, hash = $1, format = $2, kind = "
                    "$3, title = $4, size = $5, made = $6, text = $7 WHERE document = $8 AND "
                    "number = 0",
                    content.hash, content.format, content.kind, content.title,
                    size_of_text(content), now, content.text, found.document.id);
                run(sql, "UPDATE document SET updated = $1 WHERE id = $2", now, found.document.id);
                bytes += bytes_of_blobs(sql, found.owner, digests) + size_of_text(content);
                written.current = content.hash;
                written.revision = found.draft.revision + 1;
                return add_bytes(sql, found.owner, bytes) ? WriteResult::done
                                                          : WriteResult::too_large;
            });
    }

    Written publish(std::string_view owner, std::string_view name,
                    const std::optional<Digest>& expected, const Publication& publication,
                    Seconds now) override {
        return write_draft(
            owner, name, expected,
            [&](SqlConnection& sql, const DraftToWrite& found, Written& written) {
                if (found.document.newest >= most_versions) return WriteResult::too_many;
                const std::vector<Blob>& files = publication.files;
                if (!files.empty() && publication.number != found.document.newest + 1)
                    return WriteResult::stale;
                written.number = found.document.newest + 1;
                run(sql,
                    "INSERT INTO version (document, number, revision, hash, format, kind, title, "
                    "size, made, note, text) SELECT document, $1, revision, hash, format, kind, "
                    "title, size, $2, $3, text FROM version WHERE document = $4 AND number = 0",
                    written.number, now, publication.note, found.document.id);
                if (!files.empty() || !digests_of(sql, found.document.id, 0).empty())
                    sql.reserve_shared_rows();
                tie_blobs_of_draft(sql, found.document.id, written.number);
                const Digests digests = digests_of(files);
                std::int64_t bytes = found.draft.size - bytes_of_blobs(sql, found.owner, digests);
                insert_blobs(sql, found.document.id, written.number, files);
                bytes += bytes_of_blobs(sql, found.owner, digests);
                // Publishing what was withdrawn puts it into lists again.
                run(sql,
                    "UPDATE document SET newest = $1, updated = $2, state = 'active' WHERE id = $3",
                    written.number, now, found.document.id);
                if (!add_bytes(sql, found.owner, bytes)) return WriteResult::too_large;
                mark_changed(sql, found.document.id);
                return WriteResult::done;
            });
    }

    Written withdraw(std::string_view owner, std::string_view name,
                     const std::optional<Digest>& expected, bool is_purged, Seconds now) override {
        const Written done = write_draft(
            owner, name, expected, [&](SqlConnection& sql, const DraftToWrite& found, Written&) {
                if (is_purged)
                    purge(sql, found, now);
                else
                    run(sql, "UPDATE document SET state = 'unlisted', updated = $1 WHERE id = $2",
                        now, found.document.id);
                // Of what was never published nobody else knows.
                if (found.document.newest > 0) mark_changed(sql, found.document.id);
                return WriteResult::done;
            });
        if (is_purged && done.result == WriteResult::done) database_->erase_deleted(true);
        return done;
    }

    std::optional<StoredDocument> document(std::string_view owner, std::string_view name) override {
        return read([&](SqlConnection& sql) -> std::optional<StoredDocument> {
            const SqlResult found =
                execute(sql,
                        "SELECT o.name, d.name, d.newest, d.state, d.parent, d.parent2, d.created, "
                        "d.updated, coalesce(v.kind, ''), coalesce(v.title, '') FROM document d "
                        "JOIN owner o ON o.id = d.owner LEFT JOIN version v ON v.document = d.id "
                        "AND v.number = d.newest WHERE o.name = $1 AND d.name = $2",
                        owner, name);
            if (found.rows.empty()) return std::nullopt;
            return document_in(found.rows.front());
        });
    }

    std::optional<Version> version(std::string_view owner, std::string_view name,
                                   int number) override {
        // Text and blobs are those of the same moment.
        return read_at_one_moment([&](SqlConnection& sql) -> std::optional<Version> {
            const std::optional<DocumentRow> document = document_row(sql, owner, name);
            if (!document) return std::nullopt;
            const SqlResult result =
                execute(sql,
                        "SELECT number, revision, made, note, text, hash, format, kind, title FROM "
                        "version WHERE document = $1 AND number = $2",
                        document->id, number);
            if (result.rows.empty()) return std::nullopt;
            const SqlRow& row = result.rows.front();
            Version found;
            found.number = small_number_in(row[0]);
            found.revision = number_in(row[1]);
            found.made = number_in(row[2]);
            found.note = text_in(row[3]);
            found.content.text = text_in(row[4]);
            found.content.hash = digest_in(row[5]);
            found.content.format = small_number_in(row[6]);
            found.content.kind = text_in(row[7]);
            found.content.title = text_in(row[8]);
            SqlResult blobs =
                execute(sql,
                        "SELECT v.place, b.media, b.sha256, b.bytes FROM version_blob v JOIN blob "
                        "b ON b.sha256 = v.sha256 WHERE v.document = $1 AND v.number = $2 "
                        "AND v.place LIKE '/%' ORDER BY v.place",
                        document->id, number);
            for (SqlRow& blob : blobs.rows) found.content.blobs.push_back(blob_in(blob));
            return found;
        });
    }

    std::vector<Blob> files(std::string_view owner, std::string_view name, int number) override {
        return read([&](SqlConnection& sql) {
            const SqlResult found =
                execute(sql,
                        "SELECT v.place, b.media, b.sha256 FROM document d JOIN owner o ON o.id = "
                        "d.owner JOIN version_blob v ON v.document = d.id JOIN blob b ON b.sha256 "
                        "= v.sha256 WHERE o.name = $1 AND d.name = $2 AND v.number = $3 "
                        "AND v.place NOT LIKE '/%' ORDER BY v.place",
                        owner, name, number);
            return each_of(found, [](const SqlRow& row) {
                return Blob{text_in(row[0]), text_in(row[1]), digest_in(row[2]), {}};
            });
        });
    }

    std::optional<Blob> file(std::string_view owner, std::string_view name, int number,
                             std::string_view file) override {
        return read([&](SqlConnection& sql) -> std::optional<Blob> {
            SqlResult found =
                execute(sql,
                        "SELECT v.place, b.media, b.sha256, b.bytes FROM document d JOIN owner o "
                        "ON o.id = d.owner JOIN version_blob v ON v.document = d.id JOIN blob b ON "
                        "b.sha256 = v.sha256 WHERE o.name = $1 AND d.name = $2 AND v.number = $3 "
                        "AND v.place = $4 AND v.place NOT LIKE '/%'",
                        owner, name, number, file);
            if (found.rows.empty()) return std::nullopt;
            return blob_in(found.rows.front());
        });
    }

    std::vector<StoredDocument> list(const Listing& listing) override {
        return read([&](SqlConnection& sql) {
            const std::string_view state = listing.state ? name(*listing.state) : "";
            // Others see what is published and listed; the reader sees all that is not purged, by its draft.
            const SqlResult found =
                execute(sql,
                        "SELECT o.name, d.name, d.newest, d.state, d.parent, d.parent2, d.created, "
                        "d.updated, coalesce(v.kind, ''), coalesce(v.title, '') FROM document d "
                        "JOIN owner o ON o.id = d.owner LEFT JOIN version v ON v.document = d.id "
                        "AND v.number = CASE WHEN o.name = $1 THEN 0 ELSE d.newest END "
                        "WHERE (d.state <> 'purged' OR $10 = 1) "
                        "AND (o.name = $1 OR (d.state = 'active' AND d.newest > 0)) "
                        "AND ($2 = '' OR o.name = $2) AND ($3 = '' OR v.kind = $3) "
                        "AND ($4 = '' OR d.parent = $4 OR d.parent2 = $4 OR "
                        "substr(d.parent, 1, length($4) + 1) = $4 || '@' OR "
                        "substr(d.parent2, 1, length($4) + 1) = $4 || '@') "
                        "AND ($5 = '' OR d.state = $5) AND ($6 = '%%' OR "
                        "lower(d.name) LIKE lower($6) ESCAPE '\\' OR "
                        "lower(v.title) LIKE lower($6) ESCAPE '\\') "
                        "AND (o.name, d.name) > ($7, $8) ORDER BY o.name, d.name LIMIT $9",
                        listing.reader, listing.owner, listing.kind, listing.parent, state,
                        pattern_of(listing.part), listing.after_owner, listing.after_name,
                        listing.limit, listing.has_purged ? 1 : 0);
            return each_of(found, document_in);
        });
    }

    std::vector<Change> changes(std::int64_t since) override {
        database_->erase_deleted(false);
        return read_at_one_moment([&](SqlConnection& sql) {
            const SqlResult found =
                execute(sql,
                        "SELECT d.serial, o.name, d.name, d.state, d.id FROM document d JOIN "
                        "owner o ON o.id = d.owner WHERE d.serial > $1 ORDER BY d.serial",
                        since);
            std::vector<Change> changes;
            for (const SqlRow& row : found.rows) {
                Change change{number_in(row[0]),
                              text_in(row[1]),
                              text_in(row[2]),
                              named_in(row[3], states),
                              {}};
                const SqlResult versions = execute(sql,
                                                   "SELECT number, hash FROM version WHERE "
                                                   "document = $1 AND number > 0 ORDER BY number",
                                                   number_in(row[4]));
                for (const SqlRow& version : versions.rows)
                    change.versions.emplace_back(small_number_in(version[0]),
                                                 digest_in(version[1]));
                changes.push_back(std::move(change));
            }
            return changes;
        });
    }

    void wait_for_change(const std::stop_token& stop, std::int64_t at_most_ms) override {
        database_->wait_for_change(stop, at_most_ms);
    }

    // --- Shares ---

    WriteResult add_share(std::string_view owner, std::string_view name,
                          const Share& share) override {
        return write([&](SqlConnection& sql) {
            if (!owner_to_write(sql, owner)) return WriteResult::missing;
            const std::optional<DocumentRow> document = document_row(sql, owner, name);
            if (!document) return WriteResult::missing;
            if (document->state == DocumentState::purged) return WriteResult::purged;
            run(sql,
                "DELETE FROM share WHERE document = $1 AND (revoked IS NOT NULL OR expires <= $2) "
                "AND (SELECT count(*) FROM share WHERE document = $1) >= $3",
                document->id, share.created, most_shown * most_shares);
            const std::optional<std::int64_t> good =
                number(sql,
                       "SELECT count(*) FROM share WHERE document = $1 AND revoked IS NULL AND "
                       "expires > $2",
                       document->id, share.created);
            if (good >= most_shares) return WriteResult::too_many;
            run(sql,
                "INSERT INTO share (id, document, secret_sha256, created, expires) VALUES ($1, $2, "
                "$3, $4, $5)",
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
        return write([&](SqlConnection& sql) {
            const std::optional<DocumentRow> document = document_row(sql, owner, name);
            return document &&
                   run(sql,
                       "UPDATE share SET revoked = coalesce(revoked, 1) WHERE id = $1 AND "
                       "document = $2",
                       id, document->id) == 1;
        });
    }

  private:
    static void purge(SqlConnection& sql, const DraftToWrite& found, Seconds now) {
        const Digests digests = digests_of(sql, found.document.id, -1);
        std::int64_t bytes = -bytes_of_blobs(sql, found.owner, digests);
        bytes -= number(sql, "SELECT CAST(sum(size) AS BIGINT) FROM version WHERE document = $1",
                        found.document.id)
                     .value_or(0);
        if (!digests.empty()) {
            sql.reserve_shared_rows();
            untie_blobs(sql, found.document.id, -1);
            drop_unused_blobs(sql);
        }
        run(sql, "DELETE FROM version WHERE document = $1", found.document.id);
        run(sql, "DELETE FROM share WHERE document = $1", found.document.id);
        bytes += bytes_of_blobs(sql, found.owner, digests);
        run(sql,
            "UPDATE document SET state = 'purged', updated = $1, parent = '', parent2 = '' WHERE "
            "id = $2",
            now, found.document.id);
        run(sql, "UPDATE owner SET documents = documents - 1 WHERE id = $1", found.owner);
        add_bytes(sql, found.owner, bytes);
    }

    /// Moves the bytes out of a row of place, media type, digest and bytes.
    static Blob blob_in(SqlRow& row) {
        return {text_in(row[0]), text_in(row[1]), digest_in(row[2]),
                std::get<std::vector<std::uint8_t>>(std::move(row[3]))};
    }

    static StoredDocument document_in(const SqlRow& row) {
        StoredDocument document;
        document.owner = text_in(row[0]);
        document.name = text_in(row[1]);
        document.newest = small_number_in(row[2]);
        document.state = named_in(row[3], states);
        document.parent = text_in(row[4]);
        document.parent2 = text_in(row[5]);
        document.created = number_in(row[6]);
        document.updated = number_in(row[7]);
        document.kind = text_in(row[8]);
        document.title = text_in(row[9]);
        return document;
    }

    /// Returns the shares of a document, or that with an id.
    std::vector<Share> shares_where(std::string_view owner, std::string_view name,
                                    std::string_view id) {
        return read([&](SqlConnection& sql) {
            const SqlResult found =
                execute(sql,
                        "SELECT s.id, s.secret_sha256, s.created, s.expires, s.revoked FROM share "
                        "s JOIN document d ON d.id = s.document JOIN owner o ON o.id = d.owner "
                        "WHERE o.name = $1 AND d.name = $2 AND ($3 = '' OR s.id = $3) "
                        "ORDER BY s.created, s.id",
                        owner, name, id);
            return each_of(found, [](const SqlRow& row) {
                return Share{text_in(row[0]), digest_in(row[1]), number_in(row[2]),
                             number_in(row[3]), time_in(row[4]).has_value()};
            });
        });
    }

    std::vector<Owner> owners_where(const char* condition, std::string_view value) {
        const std::string statement =
            std::string(
                "SELECT name, created, disabled, documents, max_documents, used_bytes, max_bytes "
                "FROM owner ") +
            condition;
        return read([&](SqlConnection& sql) {
            return each_of(execute(sql, statement.c_str(), value), [](const SqlRow& row) {
                return Owner{text_in(row[0]),   number_in(row[1]), time_in(row[2]).has_value(),
                             number_in(row[3]), number_in(row[4]), number_in(row[5]),
                             number_in(row[6])};
            });
        });
    }

    std::vector<Token> tokens_where(const char* condition, std::string_view value) {
        const std::string statement =
            std::string(
                "SELECT t.id, o.name, t.secret_sha256, t.label, t.scope, t.created, t.expires, "
                "t.last_used, t.revoked, o.disabled FROM token t JOIN owner o ON o.id = t.owner ") +
            condition;
        return read([&](SqlConnection& sql) {
            return each_of(execute(sql, statement.c_str(), value), [](const SqlRow& row) {
                Token token;
                token.id = text_in(row[0]);
                token.owner = text_in(row[1]);
                token.secret = digest_in(row[2]);
                token.label = text_in(row[3]);
                token.scope = named_in(row[4], scopes);
                token.created = number_in(row[5]);
                token.expires = time_in(row[6]);
                token.last_used = time_in(row[7]);
                token.revoked = time_in(row[8]);
                token.is_owner_disabled = time_in(row[9]).has_value();
                return token;
            });
        });
    }
};

}  // namespace

std::unique_ptr<Records> sql_records(std::unique_ptr<SqlDatabase> database) {
    return std::make_unique<SqlRecords>(std::move(database));
}

}  // namespace sporeprint::server
