// Secrets of the library: tokens of owners, "spk_" with an id and 256 random bits, and keys of shares.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "api/library/records.h"

namespace sporeprint::api {

/// A secret as its holder has it, and as it is stored.
struct Secret {
    std::string id;    ///< 8 characters by which it is found
    std::string text;  ///< prefix, id, '_' and 43 characters; shown once
    Digest digest{};   ///< SHA-256 of the 43 characters
};

inline constexpr std::string_view token_prefix = "spk_", share_prefix = "sps_";

/// Returns a new secret.
///
/// throws  std::runtime_error if the system has no random numbers
[[nodiscard]] Secret new_secret(std::string_view prefix);

/// Returns the id and the digest that a secret states; nothing for a text of another form. `text` is a copy.
[[nodiscard]] std::optional<Secret> read_secret(std::string_view prefix, std::string_view text);

/// Returns true if two digests are equal, in a time that does not depend on where they differ.
[[nodiscard]] bool equal_in_constant_time(const Digest& a, const Digest& b);

/// Returns true if a stored token or share exists and has this secret. Takes as long if there is none.
template <class Stored>
[[nodiscard]] bool has_secret(const std::optional<Stored>& stored, const Secret& secret) {
    return equal_in_constant_time(stored ? stored->secret : Digest{}, secret.digest) &&
           stored.has_value();
}

/// Returns a token as it is stored, which never expires.
[[nodiscard]] Token stored_token(const Secret& secret, const std::string& owner,
                                 const std::string& label, Scope scope, Seconds now);

[[nodiscard]] Digest sha256_of(std::string_view bytes);

/// Returns 64 hexadecimal digits, and reads them; nothing for any other text.
[[nodiscard]] std::string hex_of(const Digest& digest);
[[nodiscard]] std::optional<Digest> read_hex(std::string_view text);

}  // namespace sporeprint::api
