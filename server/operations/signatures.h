// Signed addresses: who holds a key says which addresses may be asked for, and until when.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace sporeprint::server {

struct SigningKey {
    std::string id;      ///< 1 to 32 of a-z, A-Z, 0-9, '-', '_'
    std::string secret;  ///< 16 to 64 bytes
};

/// A target whose signature was looked at. What the signature adds never reaches those who give the target its meaning.
struct SignatureCheck {
    bool is_valid = false;
    std::optional<std::int64_t> expires;  ///< seconds since 1970; nothing if it never does
    std::string target;  ///< without key, expires and sig; as it came if it is not good
    std::string refusal;     ///< a sentence for the client if it is not good
};

/// Checks and makes signatures. Immutable, so thread-safe.
///
/// A signed target ends with key=ID, perhaps expires=SECONDS (since 1970), and sig=SIGNATURE as its last three or two parameters.
/// SIGNATURE is base64url, without padding, of the HMAC-SHA256 of
///
///     v1 LF method LF target LF body LF
///
/// where method is GET (of HEAD too) or POST, target the path and query as they are sent up to and without "&sig=", and body nothing for
/// GET and the lower-case hexadecimal SHA-256 of the body for POST. What is signed is what is sent: a client needs to know no other form.
///
/// source  [RFC2104], [RFC4648] §5
class Signatures {
  public:
    /// keys    the first signs; all are accepted, so that a new one can be brought in before an old one goes
    /// throws  InvalidInput if there is none, one is malformed, or two have one id
    explicit Signatures(std::vector<SigningKey> keys);

    /// Keys of a text, "ID HEX" a line; empty lines and those that begin with '#' are passed over.
    ///
    /// name    of the text, for messages
    /// throws  InvalidInput with every problem, none of which shows a secret
    [[nodiscard]] static Signatures from_text(const std::string& name, std::string_view text);

    /// The same of a file.
    [[nodiscard]] static Signatures from_file(const std::filesystem::path& file);

    /// now  seconds since 1970
    [[nodiscard]] SignatureCheck check(std::string_view method, std::string_view target,
                                std::string_view body, std::int64_t now) const;

    /// The target with the signature of the first key.
    ///
    /// target   path and query, without key, expires and sig
    /// expires  seconds since 1970; none for ever
    [[nodiscard]] std::string signed_target(std::string_view method, std::string_view target,
                                            std::string_view body,
                                            std::optional<std::int64_t> expires) const;

  private:
    std::vector<SigningKey> keys_;
};

}  // namespace sporeprint::server
