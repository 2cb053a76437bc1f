// What every database of documents has to do, whatever it is; each is tested with the same tests.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "api/library/records.h"

namespace sporeprint::server::test {

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
