// What every database of documents has to do, whatever it is; each is tested with the same tests.
#pragma once

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <stdexcept>
#include <string>
#include <system_error>

#include "api/library/records.h"

namespace sporeprint::server::test {

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
        for (const auto& entry : std::filesystem::directory_iterator(path_)) {
            std::ifstream file(entry.path(), std::ios::binary);
            bytes.append(std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>());
        }
        return bytes;
    }

  private:
    std::filesystem::path path_;
};

/// One empty database for one test.
class Backend {
  public:
    Backend() = default;
    Backend(const Backend&) = delete;
    Backend& operator=(const Backend&) = delete;
    virtual ~Backend() = default;

    /// Opens the database once more, as another process would.
    [[nodiscard]] virtual std::unique_ptr<api::Records> open() = 0;
    /// Returns all bytes that the database has on the disk.
    [[nodiscard]] virtual std::string bytes_on_disk() = 0;
};

struct NamedBackend {
    const char* name;
    std::unique_ptr<Backend> (*make)();
};

}  // namespace sporeprint::server::test
