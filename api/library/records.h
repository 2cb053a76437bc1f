// Documents with immutable published versions, their owners and tokens, as a database stores them. Nothing here
// knows what a document says.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <stop_token>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace sporeprint::api {

/// A SHA-256.
using Digest = std::array<std::uint8_t, 32>;

/// Seconds since 1970, UTC.
using Seconds = std::int64_t;

/// What a token allows: to read drafts; to write documents as well; to make and revoke tokens as well.
enum class Scope : std::uint8_t { read, write, admin };

[[nodiscard]] constexpr const char* name(Scope scope) {
    switch (scope) {
        case Scope::read:
            return "read";
        case Scope::write:
            return "write";
        case Scope::admin:
            return "admin";
    }
    return nullptr;
}

/// The limits of one owner; those of bytes and documents are stored with the owner.
inline constexpr std::int64_t most_versions = 64, most_tokens = 32, most_shares = 32;

struct Owner {
    std::string name;
    Seconds created = 0;
    bool is_disabled = false;
    std::int64_t documents = 0;      ///< that are not purged
    std::int64_t max_documents = 0;  ///< allowed
    std::int64_t used_bytes = 0;     ///< texts of all versions, and each of their blobs once
    std::int64_t max_bytes = 0;      ///< allowed
};

struct Token {
    std::string id;
    std::string owner;
    Digest secret{};  ///< SHA-256 of the secret, which is stored nowhere
    std::string label;
    Scope scope = Scope::read;
    Seconds created = 0;
    std::optional<Seconds> expires, last_used, revoked;
    bool is_owner_disabled = false;
};

/// A key for reading one document and its draft.
struct Share {
    std::string id;
    Digest secret{};
    Seconds created = 0;
    Seconds expires = 0;
    bool is_revoked = false;
};

/// Purged documents have no bytes, but their names are never given again.
enum class DocumentState : std::uint8_t { active, unlisted, purged };

[[nodiscard]] constexpr const char* name(DocumentState state) {
    switch (state) {
        case DocumentState::active:
            return "active";
        case DocumentState::unlisted:
            return "unlisted";
        case DocumentState::purged:
            return "purged";
    }
    return nullptr;
}

/// Bytes beside the text of a version, stored once for all documents that have them.
struct Blob {
    std::string
        place;  ///< where in the text they belong, which begins with '/'; of a file its name
    std::string media;  ///< media type
    Digest sha256{};
    std::vector<std::uint8_t> bytes;
};

/// What a version says.
struct Content {
    std::string text;
    Digest hash{};      ///< SHA-256 of `text`, which names the hashes of the blobs
    int format = 1;     ///< of `text`; a later program reads all earlier formats
    std::string kind;   ///< by which lists can be filtered
    std::string title;  ///< in lists
    std::vector<Blob> blobs;
};

/// Returns whether a blob belongs into the text of its version, or is a file beside it.
[[nodiscard]] constexpr bool is_in_text(std::string_view place) { return place.starts_with('/'); }

struct Version {
    int number = 0;             ///< 0 is the draft
    std::int64_t revision = 1;  ///< of the draft: how often it was written
    Seconds made = 0;
    std::string note;
    Content content;
};

struct StoredDocument {
    std::string owner, name;
    int newest = 0;  ///< number of the newest published version; 0 for none
    DocumentState state = DocumentState::active;
    std::string parent, parent2;  ///< of which it was made; empty for none
    Seconds created = 0, updated = 0;
    std::string kind,
        title;  ///< of the newest published version in public lists, else of the draft
};

/// The published versions of a document whose state has changed.
struct Change {
    std::int64_t serial = 0;  ///< grows with every change of any document
    std::string owner, name;
    DocumentState state = DocumentState::active;
    std::vector<std::pair<int, Digest>> versions;  ///< numbers and hashes, ascending
};

/// What is published with a draft.
struct Publication {
    std::string note{};
    std::vector<Blob> files{};  ///< of the version, stored with it
    int number = 0;             ///< of the version that the files are of, which has to be the next
};

/// How a write ended. All but `done` changed nothing.
enum class WriteResult : std::uint8_t {
    done,
    missing,    ///< there is no such owner or document
    taken,      ///< the name is in use, or was that of a purged document
    stale,      ///< the draft is not the expected one
    purged,     ///< the document was purged
    too_many,   ///< documents of the owner, versions, tokens or shares
    too_large,  ///< bytes of the owner
};

struct Written {
    WriteResult result = WriteResult::done;
    int number = 0;             ///< of the published version
    std::int64_t revision = 0;  ///< of the draft
    Digest current{};           ///< hash of the draft as it is now
};

/// Which documents a list contains, and where it begins.
struct Listing {
    std::string owner;   ///< empty for all
    std::string kind;    ///< empty for all
    std::string parent;  ///< empty for all; with or without the number of a version
    std::string part;    ///< of the name or the title, in any case; empty for all
    std::string reader;  ///< whose drafts and unlisted documents are listed too; empty for nobody
    std::optional<DocumentState> state;  ///< nothing for all that the reader may see
    bool has_purged = false;             ///< whether purged documents of the reader are listed too
    std::string after_owner,
        after_name;  ///< the last one of the page before; empty for the first page
    int limit = 50;
};

/// A database of documents. All functions may be called on any thread, and block until the disk or the
/// network is done.
///
/// throws  Unavailable from every function if the database cannot be used
class Records {
  public:
    Records() = default;
    Records(const Records&) = delete;
    Records& operator=(const Records&) = delete;
    virtual ~Records() = default;

    // --- Owners ---

    /// Adds an owner. Returns false if the name is taken.
    virtual bool add_owner(std::string_view name, Seconds now) = 0;
    [[nodiscard]] virtual std::optional<Owner> owner(std::string_view name) = 0;
    [[nodiscard]] virtual std::vector<Owner> owners() = 0;  ///< by name
    /// Sets the limits of an owner. Returns false if there is none.
    virtual bool set_limits(std::string_view name, std::int64_t max_documents,
                            std::int64_t max_bytes) = 0;
    /// Makes all tokens of an owner useless, or useful again. Returns false if there is no such owner.
    virtual bool set_disabled(std::string_view name, bool is_disabled, Seconds now) = 0;

    // --- Tokens ---

    /// Adds a token: done, missing (owner) or too_many of those that are neither revoked nor expired.
    virtual WriteResult add_token(const Token& token) = 0;
    [[nodiscard]] virtual std::optional<Token> token(std::string_view id) = 0;
    [[nodiscard]] virtual std::vector<Token> tokens(std::string_view owner) = 0;  ///< by creation
    /// Returns false if the owner has no token of this id.
    virtual bool revoke_token(std::string_view owner, std::string_view id, Seconds now) = 0;
    /// Notes when a token was used, at most once a minute.
    virtual void note_use(std::string_view id, Seconds now) = 0;

    // --- Documents ---

    /// Creates a document whose draft has this content: done, missing (owner), taken, too_many, too_large.
    virtual Written create(std::string_view owner, std::string_view name, const Content& content,
                           std::string_view parent, std::string_view parent2, Seconds now) = 0;
    /// Replaces a draft: done, missing, stale, purged, too_large.
    ///
    /// expected  hash of the draft that is replaced; nothing for any
    virtual Written replace(std::string_view owner, std::string_view name,
                            const std::optional<Digest>& expected, const Content& content,
                            Seconds now) = 0;
    /// Publishes the draft as the next version: done, missing, stale (also if files are of another version),
    /// purged, too_many, too_large.
    virtual Written publish(std::string_view owner, std::string_view name,
                            const std::optional<Digest>& expected, const Publication& publication,
                            Seconds now) = 0;
    /// Creates a document with all its versions at once, each with the number that it has; the draft is 0 and
    /// comes first: done, missing (owner), taken, too_many, too_large. A purged document has no versions. Files are
    /// among the blobs of their version.
    virtual Written restore(const StoredDocument& document,
                            const std::vector<Version>& versions) = 0;
    /// Takes a document out of lists, or deletes all its bytes: done, missing, stale, purged.
    virtual Written withdraw(std::string_view owner, std::string_view name,
                             const std::optional<Digest>& expected, bool is_purged,
                             Seconds now) = 0;
    /// Returns a document, also a purged one.
    [[nodiscard]] virtual std::optional<StoredDocument> document(std::string_view owner,
                                                                 std::string_view name) = 0;
    /// Returns a version with its blobs; number 0 is the draft.
    [[nodiscard]] virtual std::optional<Version> version(std::string_view owner,
                                                         std::string_view name, int number) = 0;
    /// Returns the files of a published version by name, without their bytes.
    [[nodiscard]] virtual std::vector<Blob> files(std::string_view owner, std::string_view name,
                                                  int number) = 0;
    /// Returns a file of a published version.
    [[nodiscard]] virtual std::optional<Blob> file(std::string_view owner, std::string_view name,
                                                   int number, std::string_view file) = 0;
    /// Returns the documents of a list, by owner and name.
    [[nodiscard]] virtual std::vector<StoredDocument> list(const Listing& listing) = 0;
    /// Returns all documents that have changed since a serial number, by serial number.
    [[nodiscard]] virtual std::vector<Change> changes(std::int64_t since) = 0;
    /// Returns when another process may have changed something, after a time, or when it is stopped. A database
    /// that cannot tell, or cannot be used, lets the time pass. Called on one thread at a time.
    virtual void wait_for_change(const std::stop_token& stop, std::int64_t at_most_ms) = 0;

    // --- Shares ---

    /// Adds a share: done, missing, purged, or too_many of those that are still good.
    virtual WriteResult add_share(std::string_view owner, std::string_view name,
                                  const Share& share) = 0;
    [[nodiscard]] virtual std::vector<Share> shares(std::string_view owner,
                                                    std::string_view name) = 0;
    /// Returns a share of a document by its id.
    [[nodiscard]] virtual std::optional<Share> share(std::string_view owner, std::string_view name,
                                                     std::string_view id) = 0;
    /// Returns false if the document has no such share.
    virtual bool revoke_share(std::string_view owner, std::string_view name,
                              std::string_view id) = 0;
};

}  // namespace sporeprint::api
