// Fuzzes key files and signed URLs: no message contains a secret, no unsigned target is valid, and
// a signature is valid for exactly what was signed.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "core/problems.h"
#include "server/operations/signatures.h"
#include "tests/fuzz/expect.h"

using namespace sporeprint;
using namespace sporeprint::server;

namespace {

constexpr std::int64_t now = 1'900'000'000;
constexpr std::string_view secret_hex = "00112233445566778899aabbccddeeff";

/// Reads a key file that contains `text`.
void read_keys(std::string_view text) {
    std::string file("good ");
    file += secret_hex;
    file += '\n';
    file += text;
    try {
        const Signatures keys = Signatures::from_text("keys", file);
        expect(
            keys.check("GET", keys.signed_target("GET", "/", "", std::nullopt), "", now).is_valid,
            "keys that are taken sign");
    } catch (const InvalidInput& errors) {
        expect(!errors.problems().empty(), "keys are refused with a reason");
        for (const Problem& problem : errors.problems())
            expect((problem.path + problem.message).find(secret_hex) == std::string::npos,
                   "no secret is told");
    }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const Signatures signatures({{"k", "0123456789abcdef"}, {"old", "fedcba9876543210"}});
    const std::string_view text(reinterpret_cast<const char*>(data), size);
    read_keys(text);

    // The input is a URL, with a body that begins after the first line.
    const auto end = text.find('\n');
    const std::string_view target = text.substr(0, end);
    const std::string_view body = end == text.npos ? std::string_view{} : text.substr(end + 1);
    for (const std::string_view method : {"GET", "HEAD", "POST", "PUT"}) {
        const SignatureCheck checked = signatures.check(method, target, body, now);
        expect(!checked.is_valid && !checked.refusal.empty(), "no unsigned target is valid");
        expect(checked.target == target, "an invalid target is returned unchanged");
    }
    if (target.empty() || target.front() != '/' || target.find('#') != target.npos) return 0;

    for (const std::string_view method : {"GET", "POST"})
        for (const std::optional<std::int64_t> expires :
             {std::optional<std::int64_t>{}, std::optional(now + 1)}) {
            const std::string generated = signatures.signed_target(method, target, body, expires);
            const SignatureCheck good = signatures.check(method, generated, body, now);
            expect(good.is_valid && good.expires == expires, "a signed target is valid");
            expect(good.target == target, "it is returned without its signature");
            expect(!expires || !signatures.check(method, generated, body, now + 1).is_valid,
                   "until it ends");
            expect(
                !signatures.check(method == "GET" ? "POST" : "GET", generated, body, now).is_valid,
                "by its own method");
            std::string other = generated;
            other[size % other.size()] = static_cast<char>(other[size % other.size()] ^ 1);
            expect(!signatures.check(method, other, body, now).is_valid,
                   "no other target is valid");
            if (method == "POST")
                expect(!signatures.check(method, generated, std::string(body) + 'x', now).is_valid,
                       "nor another body");
        }
    return 0;
}
