#include "server/operations/signatures.h"

#include <openssl/crypto.h>
#include <openssl/evp.h>
#include <openssl/hmac.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <stdexcept>
#include <utility>

#include "api/http/query.h"
#include "api/http/text.h"
#include "core/params/messages.h"
#include "core/params/types.h"
#include "server/operations/text_files.h"

namespace sporeprint::server {

namespace {

constexpr std::size_t least_secret = 16, most_secret = 64, longest_id = 32;

using Digest = std::array<unsigned char, 32>;

bool is_id(std::string_view text) {
    return !text.empty() && text.size() <= longest_id &&
           std::all_of(text.begin(), text.end(), [](char c) {
               return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
                      c == '-' || c == '_';
           });
}

std::optional<std::string> bytes_of(std::string_view hex) {
    if (hex.size() % 2 != 0) return std::nullopt;
    std::string bytes;
    for (std::size_t i = 0; i < hex.size(); i += 2) {
        unsigned value = 0;
        const auto [end, error] = std::from_chars(hex.data() + i, hex.data() + i + 2, value, 16);
        if (error != std::errc() || end != hex.data() + i + 2) return std::nullopt;
        bytes += static_cast<char>(value);
    }
    return bytes;
}

std::string signature(const SigningKey& key, std::string_view method, std::string_view target,
                      std::string_view body) {
    std::string text = "v1\n";
    text.append(method == "HEAD" ? "GET" : method) += '\n';
    text.append(target) += '\n';
    if (method == "POST") text += sha256_hex(body.data(), body.size());
    text += '\n';
    Digest digest;
    unsigned length = 0;
    if (HMAC(EVP_sha256(), key.secret.data(), static_cast<int>(key.secret.size()),
             reinterpret_cast<const unsigned char*>(text.data()), text.size(), digest.data(),
             &length) == nullptr ||
        length != digest.size())
        throw std::runtime_error("HMAC-SHA256 is not to be had");
    return api::base64url_text(digest);
}

/// Removes the last parameter of a target if it has this name, and returns its value.
std::optional<std::string_view> take_last(std::string_view& target, std::string_view name) {
    const std::size_t query = target.find('?');
    const std::size_t spot = target.find_last_of("?&");
    if (query == std::string_view::npos || spot < query) return std::nullopt;
    const std::string_view last = target.substr(spot + 1);
    if (!last.starts_with(name) || last.size() <= name.size() || last[name.size()] != '=')
        return std::nullopt;
    target = target.substr(0, spot);
    return last.substr(name.size() + 1);
}

/// Returns the errors of keys, by index. No message contains any part of a key, as a secret swapped
/// with its id would then appear in a log.
std::vector<std::pair<std::size_t, std::string>> errors_of(const std::vector<SigningKey>& keys) {
    std::vector<std::pair<std::size_t, std::string>> errors;
    for (std::size_t i = 0; i < keys.size(); ++i) {
        if (!is_id(keys[i].id))
            errors.emplace_back(i, "the id has to be 1 to " + std::to_string(longest_id) +
                                       " of a-z, A-Z, 0-9, '-' and '_'");
        if (const std::size_t size = keys[i].secret.size();
            size < least_secret || size > most_secret)
            errors.emplace_back(i, "the secret has " + std::to_string(size) +
                                       " bytes; allowed are " + std::to_string(least_secret) +
                                       " to " + std::to_string(most_secret));
        const auto same = [&](const SigningKey& one) { return one.id == keys[i].id; };
        if (std::any_of(keys.begin(), keys.begin() + static_cast<std::ptrdiff_t>(i), same))
            errors.emplace_back(i, "a key before it has the same id");
    }
    return errors;
}

}  // namespace

Signatures::Signatures(std::vector<SigningKey> keys) : keys_(std::move(keys)) {
    std::vector<Problem> problems;
    if (keys_.empty()) report(problems, "keys", "there is no key");
    for (const auto& [i, error] : errors_of(keys_))
        report(problems, "keys/" + std::to_string(i), error);
    if (!problems.empty()) throw InvalidInput(std::move(problems));
}

Signatures Signatures::from_text(const std::string& name, std::string_view text) {
    std::vector<SigningKey> keys;
    std::vector<std::size_t> lines;  // line number of each key
    std::vector<Problem> problems;
    const auto at = [&](std::size_t line) { return name + ':' + std::to_string(line); };
    for (auto [number, rest] : lines_of(text)) {
        std::vector<std::string_view> words;
        for (std::size_t begin = 0; begin != std::string_view::npos;
             begin = rest.find_first_not_of(" \t\r")) {
            rest.remove_prefix(begin);
            words.push_back(rest.substr(0, rest.find_first_of(" \t\r")));
            rest.remove_prefix(words.back().size());
        }
        const std::optional<std::string> secret =
            words.size() == 2 ? bytes_of(words[1]) : std::nullopt;
        if (!secret) {
            report(problems, at(number), "a line is an id and a secret in hexadecimal digits");
            continue;
        }
        keys.push_back({std::string(words[0]), *secret});
        lines.push_back(number);
    }
    for (const auto& [i, error] : errors_of(keys)) report(problems, at(lines[i]), error);
    if (keys.empty() && problems.empty()) report(problems, name, "there is no key");
    if (!problems.empty()) throw InvalidInput(std::move(problems));
    return Signatures(std::move(keys));
}

Signatures Signatures::from_file(const std::filesystem::path& file) {
    const std::optional<std::string> text = read_text(file);
    if (!text) throw InvalidInput(file.string(), "the file of keys cannot be read");
    return from_text(file.string(), *text);
}

SignatureCheck Signatures::check(std::string_view method, std::string_view target,
                                 std::string_view body, std::int64_t now) const {
    const auto refused = [&](std::string refusal) {
        return SignatureCheck{false, std::nullopt, std::string(target), std::move(refusal)};
    };
    std::string_view rest = api::origin_form(target);
    const std::optional<std::string_view> given = take_last(rest, "sig");
    if (!given) return refused("the address is not signed; its last parameter has to be sig");
    const std::string_view covered = rest;
    const std::optional<std::string_view> expires = take_last(rest, "expires");
    const std::optional<std::string_view> id = take_last(rest, "key");
    if (!id)
        return refused(
            "a signed address ends with key, expires if it does, and sig, in this order");
    const auto key = std::find_if(keys_.begin(), keys_.end(),
                                  [&](const SigningKey& one) { return one.id == *id; });
    if (key == keys_.end()) return refused("there is no key " + in_quotes(*id));
    const std::string wanted = signature(*key, method, covered, body);
    if (given->size() != wanted.size() ||
        CRYPTO_memcmp(given->data(), wanted.data(), wanted.size()) != 0)
        return refused("the signature is not that of this address");
    std::optional<std::int64_t> valid_until;
    if (expires) {
        std::int64_t until = 0;
        const auto [end, error] =
            std::from_chars(expires->data(), expires->data() + expires->size(), until);
        if (error != std::errc() || end != expires->data() + expires->size())
            return refused("expires is " + in_quotes(*expires) +
                           "; it has to be seconds since 1970");
        if (now >= until) return refused("the address was good until " + std::to_string(until));
        valid_until = until;
    }
    return {true, valid_until, std::string(rest), {}};
}

std::string Signatures::signed_target(std::string_view method, std::string_view target,
                                      std::string_view body,
                                      std::optional<std::int64_t> expires) const {
    const SigningKey& key = keys_.front();
    std::string covered(target);
    covered += covered.find('?') == std::string::npos ? '?' : '&';
    covered += "key=" + key.id;
    if (expires) covered += "&expires=" + std::to_string(*expires);
    return covered + "&sig=" + signature(key, method, covered, body);
}

}  // namespace sporeprint::server
