#include "api/cache/directory_store.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <fstream>
#include <memory>
#include <set>
#include <system_error>
#include <tuple>
#include <utility>
#include <vector>

#include "api/cache/write_all.h"
#include "api/http/encoding.h"
#include "api/http/random.h"
#include "core/problems.h"

namespace sporeprint::api {

namespace {

namespace fs = std::filesystem;

constexpr std::string_view format = "sporeprint 1\n";
constexpr std::size_t digest_length = 32;
constexpr const char* extension = ".body";
constexpr const char* aside = "aside";
/// Holds the bound of the folder, bytes in decimal.
constexpr const char* bound_file = "bound";

/// Returns what a file contains before the hash of the body and the body: format and key.
std::string preamble(std::string_view key) { return std::string(format).append(key) += '\n'; }

/// Returns the body of a file that was written under `key`; nothing if it is damaged or has another
/// key.
std::optional<Slice> body_in(const std::shared_ptr<const Bytes>& file, std::string_view key) {
    const std::string_view text(reinterpret_cast<const char*>(file->data()), file->size());
    const std::string before = preamble(key);
    const std::size_t fixed = before.size() + digest_length;
    if (text.size() < fixed || !text.starts_with(before) ||
        text.substr(before.size(), digest_length) != digest_of(text.substr(fixed)))
        return std::nullopt;
    return Slice(file, fixed, text.size() - fixed);
}

std::error_code last_error() { return {errno, std::generic_category()}; }

/// Writes a file that consists of a head and a body. Returns the error if it cannot be written
/// completely.
std::error_code write(const fs::path& path, std::string_view head, const Body& body) {
    const int file = ::open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
    if (file < 0) return last_error();
    std::error_code error = write_all(file, head.data(), head.size());
    for (const Slice& slice : body)
        if (!error) error = write_all(file, slice.data(), slice.size);
    if (::close(file) != 0 && !error) error = last_error();
    return error;
}

/// Returns true if a file name is one that the store generates: the hash of a key.
bool is_name(std::string_view name) {
    return name.size() == digest_length && name.find_first_not_of("0123456789abcdef") == name.npos;
}

/// Returns true if a file begins with the format line of the store.
bool begins_as_ours(const fs::path& path) {
    std::array<char, format.size()> head{};
    std::ifstream stream(path, std::ios::binary);
    return stream.read(head.data(), head.size()) &&
           std::string_view(head.data(), head.size()) == format;
}

/// Returns the bytes of a file; nullptr if it cannot be read or is too large for the store.
///
/// plausible  bytes up to which a file is read without checking its first line
/// most       bytes up to which it is read at all
std::shared_ptr<const Bytes> contents(const fs::path& path, std::uint64_t plausible,
                                      std::uint64_t most) {
    std::error_code error;
    const std::uintmax_t size = fs::file_size(path, error);
    if (error || size > most || (size > plausible && !begins_as_ours(path))) return nullptr;
    std::ifstream stream(path, std::ios::binary);
    auto bytes = std::make_shared<Bytes>(static_cast<std::size_t>(size));
    if (!stream.read(reinterpret_cast<char*>(bytes->data()),
                     static_cast<std::streamsize>(bytes->size())))
        return nullptr;
    return bytes;
}

/// Returns true if far fewer blocks are allocated than a completely written file would have. A file
/// system may compress files, but not by a factor of eight, since images and most numbers are dense
/// already.
bool has_holes(const struct stat& status) {
    constexpr std::uint64_t block = 512;           // unit of st_blocks on every file system
    constexpr std::uint64_t smallest = 64u << 10;  // smaller files may be stored inside their inode
    const auto size = static_cast<std::uint64_t>(status.st_size);
    return size >= smallest && static_cast<std::uint64_t>(status.st_blocks) * block < size / 8;
}

bool is_file(const fs::path& path) {
    std::error_code unknown;
    return fs::is_regular_file(path, unknown);
}

void remove_file(const fs::path& path) {
    std::error_code gone_already;
    fs::remove(path, gone_already);
}

/// Creates a folder for a store if it is missing.
///
/// returns  the folder
/// throws   InvalidInput if it cannot be created or written
fs::path writable(fs::path folder) {
    std::error_code error;
    fs::create_directories(folder / aside, error);
    const fs::path probe = folder / aside / (random_name() + ".probe");
    if (!error) error = write(probe, format, {});
    if (error)
        throw InvalidInput(folder.string(), "the folder cannot be written: " + error.message());
    remove_file(probe);
    return folder;
}

/// Writes the bound of a folder; one that cannot be written is that of each process alone.
void write_bound(const fs::path& path, std::uint64_t bytes) {
    const fs::path temporary = path.parent_path() / aside / (random_name() + ".bound");
    std::error_code error = write(temporary, std::to_string(bytes) + '\n', {});
    if (!error) fs::rename(temporary, path, error);
    if (error) remove_file(temporary);
}

std::optional<std::uint64_t> read_bound(const fs::path& path) {
    std::ifstream stream(path);
    std::uint64_t bytes = 0;
    return stream >> bytes ? std::optional(bytes) : std::nullopt;
}

}  // namespace

DirectoryStore::FolderLock::FolderLock(const fs::path& folder)
    : file_(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC)) {}

DirectoryStore::FolderLock::~FolderLock() {
    if (file_ >= 0) ::close(file_);
}

bool DirectoryStore::FolderLock::try_exclusive() {
    while (::flock(file_, LOCK_EX | LOCK_NB) != 0)
        if (errno != EINTR) return errno != EWOULDBLOCK;
    return true;
}

void DirectoryStore::FolderLock::share() {
    while (::flock(file_, LOCK_SH) != 0 && errno == EINTR) {
    }
}

void DirectoryStore::FolderLock::hold() {
    while (::flock(file_, LOCK_EX) != 0 && errno == EINTR) {
    }
}

void DirectoryStore::FolderLock::release() { ::flock(file_, LOCK_UN); }

DirectoryStore::DirectoryStore(fs::path folder, std::uint64_t most_bytes, Report report)
    : folder_(writable(std::move(folder))),
      most_bytes_(most_bytes),
      report_(std::move(report)),
      // Ids of processes are equal in containers.
      token_(random_name()),
      use_(folder_ / aside),
      eviction_(folder_) {
    join();
    take_stock(true);
}

fs::path DirectoryStore::path_of(const std::string& name) const {
    return folder_ / name.substr(0, 2) / (name + extension);
}

void DirectoryStore::join() {
    const bool is_alone = use_.try_exclusive();
    if (is_alone) {
        write_bound(folder_ / bound_file, most_bytes_);
    } else {
        use_.share();
        const std::optional<std::uint64_t> of_folder = read_bound(folder_ / bound_file);
        if (of_folder && *of_folder != most_bytes_) {
            if (report_)
                report_({StoreEvent::Kind::bound, folder_, 0,
                         "other processes use the folder with a bound of " +
                             std::to_string(*of_folder) + " bytes, which holds in place of " +
                             std::to_string(most_bytes_)});
            most_bytes_ = *of_folder;
        }
    }
    // What others write now is new.
    constexpr auto abandoned = std::chrono::hours(1);
    const auto now = fs::file_time_type::clock::now();
    std::error_code error;
    for (fs::directory_iterator i(folder_ / aside, error), end; !error && i != end;
         i.increment(error)) {
        std::error_code ignored;
        const auto written = fs::last_write_time(i->path(), ignored);
        if (is_alone || (!ignored && now - written > abandoned)) remove_file(i->path());
    }
    if (is_alone) use_.share();
}

DirectoryStore::Stock DirectoryStore::stock() const {
    Stock found;
    found.foreign = {StoreEvent::Kind::foreign, {}, 0, "not written by the store"};
    std::error_code error;
    for (fs::recursive_directory_iterator i(folder_, error), end; !error && i != end;
         i.increment(error)) {
        const fs::path& path = i->path();
        const std::string name = path.stem().string();
        struct stat status {};
        if (::lstat(path.c_str(), &status) != 0) continue;
        if (S_ISDIR(status.st_mode)) {
            std::error_code unknown;
            if (path == folder_ / aside || fs::is_directory(path / aside, unknown))
                i.disable_recursion_pending();
            continue;
        }
        if (path == folder_ / bound_file) continue;
        const bool named = S_ISREG(status.st_mode) && path.extension() == extension &&
                           is_name(name) && path_of(name) == path;
        const auto bytes = static_cast<std::uint64_t>(status.st_size);
        // A file may have been written under a larger bound, and some file systems count the blocks
        // of a new file late: its first line decides.
        const bool plausible = bytes <= most_of_one() && !has_holes(status);
        if (!named || (!plausible && !begins_as_ours(path))) {
            if (found.foreign.files++ == 0) found.foreign.file = path;
            continue;
        }
        std::error_code unknown;
        const auto used = i->last_write_time(unknown);
        if (!unknown)
            (bytes > most_bytes_ ? found.too_large : found.files).push_back({used, name, bytes});
    }
    std::sort(found.files.begin(), found.files.end(), [](const Found& a, const Found& b) {
        return std::tie(a.used, a.name) < std::tie(b.used, b.name);
    });
    return found;
}

void DirectoryStore::take_stock(bool is_start) {
    const std::lock_guard one_thread(evicting_);
    if (!is_start && !needs_stock()) return;
    eviction_.hold();
    const Stock found = stock();
    if (is_start && found.foreign.files > 0 && report_) report_(found.foreign);
    std::uint64_t bytes = 0;
    std::set<std::string_view> names;
    for (const Found& one : found.files) {
        bytes += one.bytes;
        names.insert(one.name);
    }
    std::uint64_t room = most_bytes_;
    {
        const std::lock_guard lock(mutex_);
        const bool has_others = std::ranges::any_of(
            names, [&](std::string_view name) { return !known_.contains(name); });
        // Where others write too, this would have to be done again for each file.
        if (has_others && !is_start) room -= most_bytes_ / 16;
    }
    std::size_t first = 0;
    if (bytes > most_bytes_)
        for (; bytes > room; ++first) {
            bytes -= found.files[first].bytes;
            remove_file(path_of(found.files[first].name));
        }
    for (const Found& one : found.too_large) remove_file(path_of(one.name));
    eviction_.release();
    const std::lock_guard lock(mutex_);
    stats_.evictions += first + found.too_large.size();
    // What other threads have written meanwhile.
    std::map<std::string, std::uint64_t, std::less<>> known;
    for (const auto& [name, size] : known_)
        if (!names.contains(name) && is_file(path_of(name))) known.emplace(name, size);
    for (; first < found.files.size(); ++first)
        known.emplace(found.files[first].name, found.files[first].bytes);
    known_ = std::move(known);
    written_ = 0;
    stats_.entries = known_.size();
    stats_.bytes = 0;
    for (const auto& [name, size] : known_) stats_.bytes += size;
}

void DirectoryStore::register_file(const std::string& name, std::uint64_t bytes) {
    forget(name);
    known_.emplace(name, bytes);
    stats_.bytes += bytes;
    ++stats_.entries;
}

void DirectoryStore::forget(const std::string& name) {
    const auto found = known_.find(name);
    if (found == known_.end()) return;
    stats_.bytes -= found->second;
    --stats_.entries;
    known_.erase(found);
}

bool DirectoryStore::needs_stock() const {
    const std::lock_guard lock(mutex_);
    return stats_.bytes > most_bytes_ || written_ > most_bytes_ / 16;
}

std::optional<Slice> DirectoryStore::find(std::string_view key) {
    const std::string name = digest_of(key);
    const fs::path path = path_of(name);
    const std::shared_ptr<const Bytes> file = contents(path, most_of_one(), most_bytes_);
    std::optional<Slice> body;
    if (file) body = body_in(file, key);
    std::error_code ignored;
    if (body)
        fs::last_write_time(path, fs::file_time_type::clock::now(),
                            ignored);  // keeps the order of use for the next start
    else if (file)
        remove_file(path);
    {
        const std::lock_guard lock(mutex_);
        if (body) {
            ++stats_.hits;
            register_file(name, file->size());
        } else {
            ++stats_.misses;
            if (file) ++stats_.damaged;
            forget(name);
        }
    }
    if (body && needs_stock()) take_stock(false);
    return body;
}

bool DirectoryStore::holds(std::string_view key) const { return is_file(path_of(digest_of(key))); }

bool DirectoryStore::insert(std::string_view key, const Body& body) {
    const std::string name = digest_of(key);
    const fs::path path = path_of(name);
    const std::string head = preamble(key) + digest_of(body);
    const std::uint64_t bytes = head.size() + size_of(body);
    if (bytes > most_of_one()) return false;
    fs::path temporary;
    {
        const std::lock_guard lock(mutex_);
        temporary = folder_ / aside / (token_ + '.' + std::to_string(next_aside_++));
    }
    std::error_code error;
    fs::create_directories(path.parent_path(), error);
    if (!error) error = write(temporary, head, body);
    // By the clock that find() uses, which is finer than that of the file system.
    if (!error) fs::last_write_time(temporary, fs::file_time_type::clock::now(), error);
    if (!error) fs::rename(temporary, path, error);
    if (error) remove_file(temporary);
    if (!error) {
        {
            const std::lock_guard lock(mutex_);
            register_file(name, bytes);
            written_ += bytes;
        }
        if (needs_stock()) take_stock(false);
        return true;
    }
    {
        const std::lock_guard lock(mutex_);
        ++stats_.unwritten;
    }
    if (report_) report_({StoreEvent::Kind::unwritten, path, 1, error.message()});
    return false;
}

DirectoryStats DirectoryStore::stats() const {
    const std::lock_guard lock(mutex_);
    return stats_;
}

}  // namespace sporeprint::api
