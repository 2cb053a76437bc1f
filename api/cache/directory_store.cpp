#include "api/cache/directory_store.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <fstream>
#include <memory>
#include <system_error>
#include <tuple>
#include <utility>
#include <vector>

#include "api/http/encoding.h"
#include "core/problems.h"

namespace sporeprint::api {

namespace {

namespace fs = std::filesystem;

constexpr std::string_view format = "sporeprint 1\n";
constexpr std::size_t digest_length = 32;
constexpr const char* extension = ".body";
constexpr const char* aside = "aside";

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

std::error_code write_all(int file, const void* data, std::size_t size) {
    const char* at = static_cast<const char*>(data);
    while (size > 0) {
        const ssize_t written = ::write(file, at, size);
        if (written < 0 && errno == EINTR) continue;
        if (written < 0) return last_error();
        at += written;
        size -= static_cast<std::size_t>(written);
    }
    return {};
}

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

}  // namespace

DirectoryStore::DirectoryStore(fs::path folder, std::uint64_t most_bytes, Report report)
    : folder_(std::move(folder)), most_bytes_(most_bytes), report_(std::move(report)) {
    std::error_code error;
    fs::create_directories(folder_ / aside, error);
    const fs::path probe = folder_ / aside / ("probe." + std::to_string(getpid()));
    if (!error) error = write(probe, format, {});
    if (error)
        throw InvalidInput(folder_.string(), "the folder cannot be written: " + error.message());
    fs::remove(probe, error);
    take_stock();
}

fs::path DirectoryStore::path_of(const std::string& name) const {
    return folder_ / name.substr(0, 2) / (name + extension);
}

/// Registers the files of earlier processes, the most recently used last.
void DirectoryStore::take_stock() {
    struct Found {
        fs::file_time_type used;
        std::string name;
        std::uint64_t bytes;
    };
    std::vector<Found> found;
    StoreEvent foreign{StoreEvent::Kind::foreign, {}, 0, "not written by the store"};
    std::uint64_t evictions = 0;
    std::error_code error;
    for (fs::directory_iterator i(folder_ / aside, error), end; !error && i != end;
         i.increment(error)) {
        std::error_code ignored;
        fs::remove(i->path(), ignored);
    }
    for (fs::recursive_directory_iterator i(folder_, error), end; !error && i != end;
         i.increment(error)) {
        const fs::path& path = i->path();
        const std::string name = path.stem().string();
        struct stat status {};
        if (::lstat(path.c_str(), &status) != 0) continue;
        if (S_ISDIR(status.st_mode)) {
            std::error_code unknown;
            if (fs::is_directory(path / aside, unknown)) i.disable_recursion_pending();
            continue;
        }
        const bool named = S_ISREG(status.st_mode) && path.extension() == extension &&
                           is_name(name) && path_of(name) == path;
        const auto bytes = static_cast<std::uint64_t>(status.st_size);
        // A file may have been written under a larger bound, and some file systems count the blocks
        // of a new file late: its first line decides.
        const bool plausible = bytes <= most_of_one() && !has_holes(status);
        if (!named || (!plausible && !begins_as_ours(path))) {
            if (foreign.files++ == 0) foreign.file = path;
        } else if (bytes > most_bytes_) {
            std::error_code gone_already;
            fs::remove(path, gone_already);
            ++evictions;
        } else {
            std::error_code unknown;
            const auto used = i->last_write_time(unknown);
            if (!unknown) found.push_back({used, name, bytes});
        }
    }
    if (foreign.files > 0 && report_) report_(foreign);
    std::sort(found.begin(), found.end(), [](const Found& a, const Found& b) {
        return std::tie(a.used, a.name) < std::tie(b.used, b.name);
    });
    const std::lock_guard lock(mutex_);
    stats_.evictions += evictions;
    for (const Found& one : found) register_file(one.name, one.bytes);
    make_room();
}

void DirectoryStore::register_file(const std::string& name, std::uint64_t bytes) {
    forget(name);
    used_.push_front({name, bytes});
    by_name_.emplace(name, used_.begin());
    stats_.bytes += bytes;
    ++stats_.entries;
}

void DirectoryStore::forget(const std::string& name) {
    const auto found = by_name_.find(name);
    if (found == by_name_.end()) return;
    stats_.bytes -= found->second->bytes;
    --stats_.entries;
    used_.erase(found->second);
    by_name_.erase(found);
}

void DirectoryStore::make_room() {
    while (stats_.bytes > most_bytes_) {
        const std::string name = used_.back().name;
        std::error_code gone_already;
        fs::remove(path_of(name), gone_already);
        forget(name);
        ++stats_.evictions;
    }
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
        fs::remove(path, ignored);
    const std::lock_guard lock(mutex_);
    if (body) {
        ++stats_.hits;
        register_file(name, file->size());
        make_room();
    } else {
        ++stats_.misses;
        if (file) ++stats_.damaged;
        forget(name);
    }
    return body;
}

bool DirectoryStore::holds(std::string_view key) const {
    std::error_code unknown;
    return fs::is_regular_file(path_of(digest_of(key)), unknown);
}

bool DirectoryStore::insert(std::string_view key, const Body& body) {
    const std::string name = digest_of(key);
    const fs::path path = path_of(name);
    const std::string head = preamble(key) + digest_of(body);
    const std::uint64_t bytes = head.size() + size_of(body);
    if (bytes > most_of_one()) return false;
    fs::path temporary;
    {
        const std::lock_guard lock(mutex_);
        temporary = folder_ / aside /
                    (name + '.' + std::to_string(getpid()) + '.' + std::to_string(next_aside_++));
    }
    std::error_code error;
    fs::create_directories(path.parent_path(), error);
    if (!error) error = write(temporary, head, body);
    if (!error) fs::rename(temporary, path, error);
    if (error) {
        std::error_code ignored;
        fs::remove(temporary, ignored);
    }
    {
        const std::lock_guard lock(mutex_);
        if (!error) {
            register_file(name, bytes);
            make_room();
            return true;
        }
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
