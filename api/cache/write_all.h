// Writing to a descriptor until everything is written.
#pragma once

#include <unistd.h>

#include <cerrno>
#include <cstddef>
#include <system_error>

namespace sporeprint::api {

/// Writes all bytes, however many calls of the system that takes. Returns the error that ended it.
inline std::error_code write_all(int file, const void* data, std::size_t size) {
    const char* at = static_cast<const char*>(data);
    while (size > 0) {
        const ssize_t written = ::write(file, at, size);
        if (written < 0 && errno == EINTR) continue;
        if (written < 0) return {errno, std::generic_category()};
        at += written;
        size -= static_cast<std::size_t>(written);
    }
    return {};
}

}  // namespace sporeprint::api
