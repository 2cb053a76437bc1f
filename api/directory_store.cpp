#include "api/directory_store.h"

#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <memory>
#include <system_error>
#include <tuple>
#include <utility>
#include <vector>

#include "api/encoding.h"
#include "core/params/problems.h"

namespace sporeprint::api {

namespace {

namespace fs = std::filesystem;

constexpr std::string_view format = "sporeprint 1\n";
constexpr std::size_t digest_length = 32;
constexpr const char* extension = ".body";
constexpr const char* aside = "aside";

/// Before the hash of the body and the body itself.
std::string preamble(std::string_view key) { return std::string(format).append(key) += '\n'; }

/// The body of a file that holds what was written under `key`, whole.
std::optional<Slice> body_in(const std::shared_ptr<const Bytes>& file, std::string_view key) {
    const std::string_view text(reinterpret_cast<const char*>(file->data()), file->size());
    const std::string before = preamble(key);
    const std::size_t fixed = before.size() + digest_length;
    if (text.size() < fixed || !text.starts_with(before) ||
        text.substr(before.size(), digest_length) != digest_of(text.substr(fixed)))
        return std::nullopt;
    return Slice(file, fixed, text.size() - fixed);
}

std::shared_ptr<const Bytes> contents(const fs::path& path) {
    std::error_code error;
    const std::uintmax_t size = fs::file_size(path, error);
    if (error) return nullptr;
    std::ifstream stream(path, std::ios::binary);
    auto bytes = std::make_shared<Bytes>(static_cast<std::size_t>(size));
    if (!stream.read(reinterpret_cast<char*>(bytes->data()),
                     static_cast<std::streamsize>(bytes->size())))
        return nullptr;
    return bytes;
}

bool write(const fs::path& path, std::string_view head, const Body& body) {
    std::ofstream stream(path, std::ios::binary | std::ios::trunc);
    stream.write(head.data(), static_cast<std::streamsize>(head.size()));
    for (const Slice& slice : body)
        stream.write(reinterpret_cast<const char*>(slice.data()),
                     static_cast<std::streamsize>(slice.size));
    stream.close();
    return !stream.fail();
}

}  // namespace

DirectoryStore::DirectoryStore(fs::path folder, std::uint64_t most_bytes)
    : folder_(std::move(folder)), most_bytes_(most_bytes) {
    std::error_code error;
    fs::create_directories(folder_ / aside, error);
    const fs::path probe = folder_ / aside / ("probe." + std::to_string(getpid()));
    if (error || !write(probe, format, {}))
        throw InvalidInput(folder_.string(), "the folder cannot be written" +
                                                 (error ? ": " + error.message() : std::string()));
    fs::remove(probe, error);
    take_stock();
}

fs::path DirectoryStore::path_of(const std::string& name) const {
    return folder_ / name.substr(0, 2) / (name + extension);
}

/// Finds what earlier processes left, the latest used last.
void DirectoryStore::take_stock() {
    struct Found {
        fs::file_time_type used;
        std::string name;
        std::uint64_t bytes;
    };
    std::vector<Found> found;
    std::error_code error;
    for (fs::directory_iterator i(folder_ / aside, error), end; !error && i != end;
         i.increment(error)) {
        std::error_code ignored;
        fs::remove(i->path(), ignored);
    }
    for (fs::recursive_directory_iterator i(folder_, error), end; !error && i != end;
         i.increment(error)) {
        const std::string name = i->path().stem().string();
        std::error_code unknown;
        if (i->path().extension() != extension || path_of(name) != i->path() ||
            !i->is_regular_file(unknown))
            continue;
        const auto bytes = i->file_size(unknown);
        const auto used = i->last_write_time(unknown);
        if (!unknown) found.push_back({used, name, bytes});
    }
    std::sort(found.begin(), found.end(), [](const Found& a, const Found& b) {
        return std::tie(a.used, a.name) < std::tie(b.used, b.name);
    });
    const std::lock_guard lock(mutex_);
    for (const Found& one : found) remember(one.name, one.bytes);
    make_room();
}

void DirectoryStore::remember(const std::string& name, std::uint64_t bytes) {
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
    const std::shared_ptr<const Bytes> file = contents(path);
    std::optional<Slice> body;
    if (file) body = body_in(file, key);
    std::error_code ignored;
    if (body)
        fs::last_write_time(path, fs::file_time_type::clock::now(),
                            ignored);  // its order, for the next start
    else if (file)
        fs::remove(path, ignored);
    const std::lock_guard lock(mutex_);
    if (body) {
        ++stats_.hits;
        remember(name, file->size());
        make_room();
    } else {
        ++stats_.misses;
        if (file) ++stats_.damaged;
        forget(name);
    }
    return body;
}

void DirectoryStore::insert(std::string_view key, const Body& body) {
    const std::string name = digest_of(key);
    const fs::path path = path_of(name);
    const std::string head = preamble(key) + digest_of(body);
    const std::uint64_t bytes = head.size() + size_of(body);
    if (bytes > most_bytes_ / 8) return;
    fs::path temporary;
    {
        const std::lock_guard lock(mutex_);
        temporary = folder_ / aside /
                    (name + '.' + std::to_string(getpid()) + '.' + std::to_string(next_aside_++));
    }
    std::error_code error;
    fs::create_directories(path.parent_path(), error);
    const bool written = write(temporary, head, body);
    if (written) fs::rename(temporary, path, error);
    const std::lock_guard lock(mutex_);
    if (written && !error) {
        remember(name, bytes);
        make_room();
        return;
    }
    ++stats_.unwritten;
    fs::remove(temporary, error);
}

DirectoryStats DirectoryStore::stats() const {
    const std::lock_guard lock(mutex_);
    return stats_;
}

}  // namespace sporeprint::api
