#include "core/params/types.h"

#include <openssl/evp.h>

#include <algorithm>
#include <array>
#include <climits>
#include <stdexcept>
#include <utility>

#include "core/params/messages.h"

namespace sporeprint {
namespace {

int hex_value(char c) {
    if (c >= '0' && c <= '9') return c - '0';
    if (c >= 'a' && c <= 'f') return c - 'a' + 10;
    if (c >= 'A' && c <= 'F') return c - 'A' + 10;
    return -1;
}

}  // namespace

std::string sha256_hex(const void* bytes, std::size_t size) {
    std::array<unsigned char, EVP_MAX_MD_SIZE> digest{};
    unsigned int length = 0;
    if (EVP_Digest(bytes, size, digest.data(), &length, EVP_sha256(), nullptr) != 1)
        throw std::runtime_error("SHA-256 is not available");
    std::string text;
    for (unsigned int i = 0; i < length; ++i) {
        text += "0123456789abcdef"[digest[i] >> 4];
        text += "0123456789abcdef"[digest[i] & 15];
    }
    return text;
}

Upload uploaded(std::vector<std::uint8_t> bytes) {
    Upload upload;
    if (bytes.empty()) return upload;
    upload.sha256 = Text<64>(std::string_view(sha256_hex(bytes.data(), bytes.size())));
    upload.bytes = std::move(bytes);
    return upload;
}

bool IdChoice::allows(std::string_view candidate) const {
    if (among.empty())
        return candidate.size() <= decltype(id)::capacity && invalid_id_message(candidate).empty();
    return std::find(among.begin(), among.end(), candidate) != among.end();
}

bool read_colour(std::string_view text, Colour& out) {
    if (text.size() != 7 || text[0] != '#') return false;
    std::array<std::uint8_t, 3> channels{};
    for (std::size_t i = 0; i < 3; ++i) {
        const int high = hex_value(text[1 + 2 * i]), low = hex_value(text[2 + 2 * i]);
        if (high < 0 || low < 0) return false;
        channels[i] = static_cast<std::uint8_t>(high * 16 + low);
    }
    out = {channels[0], channels[1], channels[2]};
    return true;
}

std::string colour_text(Colour colour) {
    std::string text = "#";
    for (const std::uint8_t channel : {colour.r, colour.g, colour.b}) {
        text += "0123456789ABCDEF"[channel >> 4];
        text += "0123456789ABCDEF"[channel & 15];
    }
    return text;
}

bool read_base64(std::string_view text, std::vector<std::uint8_t>& out) {
    if (text.size() % 4 != 0 || text.size() > static_cast<std::size_t>(INT_MAX)) return false;
    std::vector<std::uint8_t> bytes(text.size() / 4 * 3);
    const int size =
        EVP_DecodeBlock(bytes.data(), reinterpret_cast<const unsigned char*>(text.data()),
                        static_cast<int>(text.size()));
    if (size < 0) return false;
    // The padding is decoded as zero bytes.
    const std::size_t padding = text.ends_with("==") ? 2 : text.ends_with('=') ? 1 : 0;
    bytes.resize(static_cast<std::size_t>(size) - padding);
    // The decoder of libcrypto accepts other spellings of the same bytes: white space at both ends,
    // '=' elsewhere, unused bits that are not zero.
    if (base64_text(bytes) != text) return false;
    out = std::move(bytes);
    return true;
}

std::string base64_text(std::span<const std::uint8_t> bytes) {
    std::string text((bytes.size() + 2) / 3 * 4 + 1, '\0');  // the encoder appends a zero
    EVP_EncodeBlock(reinterpret_cast<unsigned char*>(text.data()), bytes.data(),
                    static_cast<int>(bytes.size()));
    text.pop_back();
    return text;
}

}  // namespace sporeprint
