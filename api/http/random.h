// Random bits for names and secrets that nobody can guess and no other process has.
#pragma once

#include <openssl/rand.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string>

#include "api/http/text.h"

namespace sporeprint::api {

/// Returns random bytes of the system.
///
/// throws  std::runtime_error if it has none
template <std::size_t Count>
std::array<std::uint8_t, Count> random_bytes() {
    std::array<std::uint8_t, Count> bytes{};
    if (RAND_bytes(bytes.data(), static_cast<int>(Count)) != 1)
        throw std::runtime_error("the system gives no random numbers");
    return bytes;
}

/// Returns 128 random bits in base64url.
///
/// throws  as random_bytes()
inline std::string random_name() { return base64url_text(random_bytes<16>()); }

}  // namespace sporeprint::api
