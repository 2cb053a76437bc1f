// The library of users' species: what is published, in memory, and the species that requests use.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <shared_mutex>
#include <string>
#include <string_view>

#include "api/cache/cache.h"
#include "api/library/names.h"
#include "api/library/records.h"
#include "core/atlas/atlas.h"

namespace sporeprint::api {

/// The species of users, of which published versions can be named wherever a built-in species can. Thread-safe.
class Library {
  public:
    using Clock = std::function<Seconds()>;

    /// Reads what is published.
    ///
    /// clock   may be called on any thread
    /// throws  Unavailable
    Library(std::shared_ptr<Records> records, Clock clock);

    /// The database. Its functions block, so jobs alone call them.
    [[nodiscard]] Records& records() { return *records_; }

    [[nodiscard]] Seconds now() const { return clock_(); }

    /// Reads what was published or withdrawn since the last time, here or by another process. Returns true if that was
    /// anything; responses to addresses without the number of a version may then be others.
    ///
    /// throws  Unavailable
    bool refresh();

    /// What is known about an id without asking the database.
    struct Found {
        LibraryName name;     ///< with the number of the version, if `status` is 200
        int status = 200;     ///< 200; 404 for what does not exist; 410 for what was purged
        std::string message;  ///< unless `status` is 200
        std::shared_ptr<const AtlasEntry> entry;  ///< nullptr if it has to be loaded
    };

    /// Finds a published version: that of the number, or the newest.
    [[nodiscard]] Found find(std::string_view id);

    /// Reads a published version from the database, unless it is in memory.
    ///
    /// throws  Unavailable, GenerationError; InvalidInput if it was purged meanwhile
    std::shared_ptr<const AtlasEntry> load(const LibraryName& name);

    /// Notes whose a secret of a token is that was just found to be good.
    void note_owner(const Digest& secret, const std::string& owner);

    /// Returns the owner that was noted with a secret in the last minute, without asking the database; empty for
    /// none. That a token was revoked since then is not known here, so this lets nobody in.
    [[nodiscard]] std::string noted_owner(const Digest& secret);

    /// Returns the key of a job that no other job has: what one caller may see or write is shared with nobody.
    [[nodiscard]] std::string next_key() { return "library " + std::to_string(++jobs_); }

  private:
    struct Published {
        DocumentState state = DocumentState::active;
        std::vector<std::pair<int, Digest>> versions;
    };

    std::shared_ptr<Records> records_;
    Clock clock_;
    ComputingCache<std::shared_ptr<const AtlasEntry>> entries_;
    mutable std::shared_mutex mutex_;
    std::map<std::string, Published, std::less<>> published_;  ///< by "~owner.name"
    std::mutex refresh_mutex_;
    std::int64_t serial_ = 0;  ///< of the last change in `published_`; guarded by refresh_mutex_
    std::atomic<std::uint64_t> jobs_{0};
    struct Noted {
        std::string owner;
        Seconds at = 0;
    };
    std::mutex noted_mutex_;
    std::map<Digest, Noted> noted_;
};

/// Returns an entry of an atlas for a species of the library, under the id by which it is named.
[[nodiscard]] std::shared_ptr<const AtlasEntry> entry_of(Species species, const std::string& id);

}  // namespace sporeprint::api
