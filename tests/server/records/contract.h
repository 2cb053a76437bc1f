// What every database of documents has to do, whatever it is; each is tested with the same tests.
#pragma once

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <ostream>
#include <stdexcept>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "api/library/records.h"
#include "api/library/tokens.h"
#include "server/records/open.h"

namespace sporeprint::server::test {

inline std::string text_of_file(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

/// An empty folder for one test.
class TemporaryFolder {
  public:
    TemporaryFolder() {
        std::string name =
            (std::filesystem::temp_directory_path() / "sporeprint-records-XXXXXX").string();
        if (!mkdtemp(name.data())) throw std::runtime_error("no folder for a test");
        path_ = name;
    }
    ~TemporaryFolder() {
        std::error_code ignored;
        std::filesystem::remove_all(path_, ignored);
    }
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;

    [[nodiscard]] std::filesystem::path operator/(const char* name) const { return path_ / name; }

    /// Returns the bytes of all files in it.
    [[nodiscard]] std::string bytes() const {
        std::string bytes;
        for (const auto& entry : std::filesystem::directory_iterator(path_))
            bytes += text_of_file(entry.path());
        return bytes;
    }

  private:
    std::filesystem::path path_;
};

/// Bytes at a place of a version.
inline api::Blob blob(const std::string& place, const std::string& bytes) {
    return {place, "image/jpeg", api::sha256_of(bytes), {bytes.begin(), bytes.end()}};
}

/// A version that says a text.
inline api::Content content(const std::string& text, std::vector<api::Blob> blobs = {}) {
    return {text, api::sha256_of(text), 1, "capped", "Title of " + text, std::move(blobs)};
}

/// One empty database for one test.
class Backend {
  public:
    Backend() = default;
    Backend(const Backend&) = delete;
    Backend& operator=(const Backend&) = delete;
    virtual ~Backend() = default;

    /// Returns what --library says for it.
    [[nodiscard]] virtual std::string library() const = 0;
    /// Opens the database once more, as another process would.
    [[nodiscard]] std::unique_ptr<api::Records> open() const { return open_records(library()); }
    /// Returns whether the database contains these bytes anywhere.
    [[nodiscard]] virtual bool contains(const std::string& bytes) = 0;
};

struct NamedBackend {
    const char* name;
    bool (*is_installed)();
    std::unique_ptr<Backend> (*make)();
};

/// What a failed test prints of it.
inline void PrintTo(const NamedBackend& backend, std::ostream* out) { *out << backend.name; }

}  // namespace sporeprint::server::test
