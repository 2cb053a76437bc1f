// Signed URLs: a holder of a key decides which URLs are valid, and until when.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace sporeprint::server {

/// A secret and its public identifier.
struct SigningKey {
    std::string id;      ///< 1 to 32 of a-z, A-Z, 0-9, '-', '_'
    std::string secret;  ///< 16 to 64 bytes
};

/// The result of checking a signed target.
struct SignatureCheck {
    bool is_valid = false;
    std::optional<std::int64_t> expires;  ///< seconds since 1970; nothing if it does not expire
    std::string target;                   ///< without key, expires and sig; unchanged if invalid
    std::string refusal;                  ///< if invalid: a message for the client
};

/// Checks and creates signatures. Immutable, hence thread-safe.
///
/// The last two or three parameters of a signed target are key=ID, optionally expires=SECONDS
/// (since 1970), and sig=SIGNATURE. SIGNATURE is base64url, without padding, of the HMAC-SHA256 of
///
///     v1 LF method LF target LF body LF
///
/// where method is GET (for HEAD too) or POST, target is the path and query as sent, up to but
/// without "&sig=", and body is empty for GET and the lower-case hexadecimal SHA-256 of the body
/// for POST. The bytes sent are signed, without any normalization.
///
/// source  [RFC2104], [RFC4648] §5
class Signatures {
  public:
    /// keys    the first one signs; all are accepted, so that keys can be rotated
    /// throws  InvalidInput if there is no key, a key is malformed, or two have the same id
    explicit Signatures(std::vector<SigningKey> keys);

    /// Reads keys from a text with one "ID HEX" per line, in the format of lines_of().
    ///
    /// name    of the file, for messages
    /// throws  InvalidInput with every problem; no message contains a secret
    [[nodiscard]] static Signatures from_text(const std::string& name, std::string_view text);

    /// Reads keys from a file.
    ///
    /// throws  InvalidInput as from_text(), and if the file cannot be read
    [[nodiscard]] static Signatures from_file(const std::filesystem::path& file);

    /// Checks the signature and expiry of a target.
    ///
    /// now  seconds since 1970
    [[nodiscard]] SignatureCheck check(std::string_view method, std::string_view target,
                                       std::string_view body, std::int64_t now) const;

    /// Returns the target with the signature of the first key.
    ///
    /// target   path and query, without key, expires and sig
    /// expires  seconds since 1970; nothing: it does not expire
    [[nodiscard]] std::string signed_target(std::string_view method, std::string_view target,
                                            std::string_view body,
                                            std::optional<std::int64_t> expires) const;

  private:
    std::vector<SigningKey> keys_;
};

}  // namespace sporeprint::server
