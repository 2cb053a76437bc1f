#include "api/library/tokens.h"

#include <openssl/crypto.h>

#include <algorithm>
#include <array>
#include <charconv>

#include "api/http/random.h"
#include "api/http/text.h"
#include "core/params/types.h"

namespace sporeprint::api {

namespace {

constexpr std::size_t id_length = 8, secret_length = 43;

/// Characters of ids: 32, none of which looks like another.
constexpr std::string_view id_characters = "abcdefghijkmnpqrstuvwxyz23456789";

}  // namespace

Secret new_secret(std::string_view prefix) {
    Secret secret;
    for (const std::uint8_t byte : random_bytes<id_length>())
        secret.id += id_characters[byte % id_characters.size()];
    const std::string bits = base64url_text(random_bytes<32>());
    secret.text = std::string(prefix) + secret.id + '_' + bits;
    secret.digest = sha256_of(bits);
    return secret;
}

std::optional<Secret> read_secret(std::string_view prefix, std::string_view text) {
    if (!text.starts_with(prefix)) return std::nullopt;
    const std::string_view rest = text.substr(prefix.size());
    if (rest.size() != id_length + 1 + secret_length || rest[id_length] != '_') return std::nullopt;
    const std::string_view id = rest.substr(0, id_length);
    if (id.find_first_not_of(id_characters) != std::string_view::npos) return std::nullopt;
    return Secret{std::string(id), std::string(text), sha256_of(rest.substr(id_length + 1))};
}

bool equal_in_constant_time(const Digest& a, const Digest& b) {
    return CRYPTO_memcmp(a.data(), b.data(), a.size()) == 0;
}

Token stored_token(const Secret& secret, const std::string& owner, const std::string& label,
                   Scope scope, Seconds now) {
    Token token;
    token.id = secret.id;
    token.owner = owner;
    token.secret = secret.digest;
    token.label = label;
    token.scope = scope;
    token.created = now;
    return token;
}

Digest sha256_of(std::string_view bytes) {
    return read_hex(sha256_hex(bytes.data(), bytes.size())).value();
}

std::string hex_of(const Digest& digest) {
    constexpr std::string_view digits = "0123456789abcdef";
    std::string text;
    for (const std::uint8_t byte : digest) {
        text += digits[byte >> 4U];
        text += digits[byte & 15U];
    }
    return text;
}

std::optional<Digest> read_hex(std::string_view text) {
    Digest digest{};
    if (text.size() != 2 * digest.size()) return std::nullopt;
    for (std::size_t i = 0; i < digest.size(); ++i) {
        const char* const begin = text.data() + 2 * i;
        const auto [end, error] = std::from_chars(begin, begin + 2, digest.at(i), 16);
        if (error != std::errc() || end != begin + 2) return std::nullopt;
    }
    return digest;
}

}  // namespace sporeprint::api
