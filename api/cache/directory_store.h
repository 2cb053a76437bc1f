// Finished files in a folder, so that a service that starts again is warm.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <list>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>

#include "core/bytes.h"

namespace sporeprint::api {

struct DirectoryStats {
    std::uint64_t hits = 0, misses = 0, evictions = 0;
    std::uint64_t damaged = 0;    ///< files that were not what was written; removed
    std::uint64_t unwritten = 0;  ///< bodies that could not be written: no room, no right
    std::uint64_t bytes = 0, entries = 0;
};

/// What a store has to say to whoever runs it.
struct StoreEvent {
    enum class Kind {
        unwritten,  ///< a body could not be written
        foreign  ///< the folder holds files that are not of the store: left alone and not counted
    };
    Kind kind = Kind::unwritten;
    std::filesystem::path file;  ///< the file, or the first of those
    std::uint64_t files = 1;     ///< how many
    std::string why;             ///< in words
};

/// A folder of bodies by key. Thread-safe; blocks for as long as the disk does, so it is asked by jobs, never by plan().
///
/// A file is named by the hash of its key and holds the key, the hash of the body, and the body: what is read is what was
/// written or is removed. Files are written aside and renamed, so no other name is ever half of a file, whenever the power fails.
/// Processes may share a folder; each keeps what it has seen of it within its own bound.
class DirectoryStore {
  public:
    using Report = std::function<void(const StoreEvent&)>;

    /// Makes the folder if it is missing, takes stock of it and removes what is over the bound or was left half written. Files
    /// that the store has not written are left alone and not counted: those of other names, links, and what does not begin as
    /// its own do where it is larger than any of them, or has holes. Its own that are larger than the whole bound are removed.
    ///
    /// most_bytes  of all files together; the least recently used go first, and none is larger than an eighth of it
    /// report      called for events, here and on any thread that inserts, several at once; may be empty
    /// throws      InvalidInput if the folder cannot be made or written
    DirectoryStore(std::filesystem::path folder, std::uint64_t most_bytes, Report report = {});

    /// The body written under `key`; none if there is none that is whole.
    [[nodiscard]] std::optional<Slice> find(std::string_view key);

    /// Writes a body under `key`. A body that cannot be written is counted, reported and forgotten: it can be made again.
    void insert(std::string_view key, const Body& body);

    [[nodiscard]] DirectoryStats stats() const;

  private:
    struct Entry {
        std::string name;
        std::uint64_t bytes = 0;
    };

    [[nodiscard]] std::filesystem::path path_of(const std::string& name) const;
    [[nodiscard]] std::uint64_t most_of_one() const { return most_bytes_ / 8; }
    void take_stock();
    void get_or_compute(const std::string& name, std::uint64_t bytes);  ///< as the latest used
    void forget(const std::string& name);
    void make_room();

    std::filesystem::path folder_;
    std::uint64_t most_bytes_;
    Report report_;
    mutable std::mutex mutex_;  ///< guards all below, and never waits for the disk but to remove
    std::list<Entry> used_;     ///< the latest first
    std::map<std::string, std::list<Entry>::iterator, std::less<>> by_name_;
    std::uint64_t next_aside_ = 0;
    DirectoryStats stats_;
};

}  // namespace sporeprint::api
