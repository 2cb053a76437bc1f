// Archives in the ustar format whose bytes depend on their files alone.
#pragma once

#include <cstdint>
#include <exception>
#include <functional>
#include <memory>
#include <string>

#include "core/bytes.h"

struct archive;

namespace sporeprint::server {

/// Writes an archive: all files are of 1970, of user 0 and of mode 0644.
class TarWriter {
  public:
    using Sink = std::function<void(const void* data, std::size_t size)>;

    /// sink  receives the bytes; what it throws comes out of the functions below
    explicit TarWriter(Sink sink);
    ~TarWriter();
    TarWriter(const TarWriter&) = delete;
    TarWriter& operator=(const TarWriter&) = delete;

    /// Adds a file.
    ///
    /// returns  where its bytes begin in the archive
    /// throws   std::runtime_error if the format cannot hold it
    std::uint64_t add(const std::string& name, const Body& body);

    /// Writes the end.
    void finish();

  private:
    struct Free {
        void operator()(archive* one) const;
    };
    /// Called by libarchive.
    static std::int64_t write(archive* /*of*/, void* self, const void* data, std::size_t size);
    void check(int code, const std::string& what);

    Sink sink_;
    std::exception_ptr error_;  ///< of the sink
    std::unique_ptr<archive, Free> archive_;
};

}  // namespace sporeprint::server
