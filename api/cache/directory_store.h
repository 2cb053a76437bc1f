// Generated files in a folder, so that they are available after a restart.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

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
        foreign,    ///< the folder contains files that the store has not written: ignored
        bound       ///< other processes use the folder, with another bound, which holds
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
/// so a power failure never leaves an incomplete file under its final name.
///
/// Processes may share a folder, also on several machines whose file system has locks (flock). The bound is that of the
/// folder: the first process that is alone in it sets it, those that come while others use it take it over. Who exceeds
/// it reads the folder again and evicts what no process has used for longest, one process at a time; as each process
/// counts what it writes itself until then, N of them may exceed the bound by (N - 1) / 16 of it.
class DirectoryStore {
  public:
    using Report = std::function<void(const StoreEvent&)>;

    /// Creates the folder if it is missing, registers its files, and removes those over the bound
    /// or incompletely written. Files that the store has not written are ignored: other names,
    /// links, and files without its first line that are too large or have holes. Its own files that
    /// are larger than the whole bound are removed. A folder in it that is that of another store is
    /// not looked into.
    ///
    /// most_bytes  of all files together, unless others use the folder with another bound; the least recently used are
    ///             evicted first, and none is larger than an eighth of it
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

    /// Returns the bound of the folder, bytes.
    [[nodiscard]] std::uint64_t most_bytes() const { return most_bytes_; }

  private:
    /// A file of the store in its folder.
    struct Found {
        std::filesystem::file_time_type used;
        std::string name;
        std::uint64_t bytes = 0;
    };
    /// All files of the folder.
    struct Stock {
        std::vector<Found> files;      ///< the least recently used first
        std::vector<Found> too_large;  ///< than the whole bound
        StoreEvent foreign;
    };

    /// A descriptor of a folder, for locks that end with the process.
    class FolderLock {
      public:
        explicit FolderLock(const std::filesystem::path& folder);
        FolderLock(const FolderLock&) = delete;
        FolderLock& operator=(const FolderLock&) = delete;
        ~FolderLock();
        /// Returns whether nobody else had a lock; on a file system without locks nobody has.
        [[nodiscard]] bool try_exclusive();
        void share();
        void hold();  ///< exclusively, as soon as nobody else has it
        void release();

      private:
        int file_;
    };

    [[nodiscard]] std::filesystem::path path_of(const std::string& name) const;
    [[nodiscard]] std::uint64_t most_of_one() const { return most_bytes_ / 8; }
    /// Agrees with other processes on the bound, and removes what nobody writes any more.
    void join();
    [[nodiscard]] Stock stock() const;
    /// Registers the files of a folder, and evicts those for which there is no room.
    void take_stock(bool is_start);
    /// Registers a file. Reads and computes nothing.
    void register_file(const std::string& name, std::uint64_t bytes);
    void forget(const std::string& name);
    /// Returns whether files have to be evicted, or others may have written as much as that.
    [[nodiscard]] bool needs_stock() const;

    std::filesystem::path folder_;
    std::uint64_t most_bytes_;
    Report report_;
    std::string token_;  ///< of this process, in names of files that it writes
    FolderLock use_,
        eviction_;         ///< held shared while the store is used; held while files are evicted
    std::mutex evicting_;  ///< of the threads of this process
    mutable std::mutex mutex_;  ///< guards the members below; not held for reading or writing
    std::map<std::string, std::uint64_t, std::less<>> known_;  ///< bytes by name
    std::uint64_t next_aside_ = 0;
    std::uint64_t written_ = 0;  ///< bytes since stock was taken
    DirectoryStats stats_;
};

}  // namespace sporeprint::api
