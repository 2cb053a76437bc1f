// Generated files in a folder, so that they are available after a restart.
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
    std::uint64_t damaged = 0;    ///< files whose hash did not match; removed
    std::uint64_t unwritten = 0;  ///< bodies that could not be written: disk full, no permission
    std::uint64_t bytes = 0, entries = 0;
};

/// An event of the store that the operator should know.
struct StoreEvent {
    enum class Kind {
        unwritten,  ///< a body could not be written
        foreign     ///< the folder contains files that the store has not written: ignored
    };
    Kind kind = Kind::unwritten;
    std::filesystem::path file;  ///< the file, or the first of several
    std::uint64_t files = 1;     ///< number of files
    std::string why;             ///< the reason, as a sentence
};

/// A folder of bodies by key. Thread-safe; its functions block while the disk is busy, so only jobs
/// call them, never plan().
///
/// A file is named by the hash of its key and contains the key, the hash of the body, and the body:
/// a damaged file is recognised and removed. Files are written under a temporary name and renamed,
/// so a power failure never leaves an incomplete file under its final name. Processes may share a
/// folder; each bounds the files that it knows.
class DirectoryStore {
  public:
    using Report = std::function<void(const StoreEvent&)>;

    /// Creates the folder if it is missing, registers its files, and removes those over the bound
    /// or incompletely written. Files that the store has not written are ignored: other names,
    /// links, and files without its first line that are too large or have holes. Its own files that
    /// are larger than the whole bound are removed. A folder in it that is that of another store is
    /// not looked into.
    ///
    /// most_bytes  of all files together; the least recently used are evicted first, and none is
    ///             larger than an eighth of it
    /// report      called for events, here and on any thread that inserts, also concurrently; may
    ///             be empty
    /// throws      InvalidInput if the folder cannot be created or written
    DirectoryStore(std::filesystem::path folder, std::uint64_t most_bytes, Report report = {});

    /// Returns the body written under `key`, which counts as a use; nothing if there is none or it
    /// is damaged. A damaged file is removed.
    [[nodiscard]] std::optional<Slice> find(std::string_view key);

    /// Returns true if there is a file for `key`, which may be damaged. Does not count as a use.
    [[nodiscard]] bool holds(std::string_view key) const;

    /// Writes a body under `key`. A body larger than an eighth of the bound is not written. One
    /// that cannot be written is counted, reported and dropped: it can be generated again.
    ///
    /// returns  whether it was written
    bool insert(std::string_view key, const Body& body);

    [[nodiscard]] DirectoryStats stats() const;

  private:
    struct Entry {
        std::string name;
        std::uint64_t bytes = 0;
    };

    [[nodiscard]] std::filesystem::path path_of(const std::string& name) const;
    [[nodiscard]] std::uint64_t most_of_one() const { return most_bytes_ / 8; }
    void take_stock();
    /// Registers a file as the most recently used one. Reads and computes nothing.
    void register_file(const std::string& name, std::uint64_t bytes);
    void forget(const std::string& name);
    void make_room();

    std::filesystem::path folder_;
    std::uint64_t most_bytes_;
    Report report_;
    mutable std::mutex mutex_;  ///< guards the members below; not held for reading or writing
    std::list<Entry> used_;     ///< most recently used first
    std::map<std::string, std::list<Entry>::iterator, std::less<>> by_name_;
    std::uint64_t next_aside_ = 0;
    DirectoryStats stats_;
};

}  // namespace sporeprint::api
