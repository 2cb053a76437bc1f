// Fuzzes the bytes of a connection: framing of request heads, however they are split, and lookups
// in the hot-response table.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "server/http/head.h"
#include "server/http/hot_table.h"
#include "tests/fuzz/expect.h"

using namespace sporeprint::server;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    std::string_view rest(reinterpret_cast<const char*>(data), size);
    for (int requests = 0; requests < 8; ++requests) {
        const Scan scan = scan_head(rest);
        if (scan.state == Scan::State::incomplete) {
            expect(rest.size() <= longest_head, "a head beyond the limit is refused");
            return 0;
        }
        if (scan.state == Scan::State::refused) {
            expect(scan.status >= 400 && scan.status < 600 && !scan.detail.empty(),
                   "a refusal says why");
            expect(scan_head(rest.substr(0, longest_head)).state == Scan::State::refused,
                   "nothing that comes later mends it");
            return 0;
        }
        expect(scan.used > 0 && scan.used <= rest.size() && scan.used <= longest_head,
               "a head lies within what came");
        expect(rest.substr(0, scan.used).ends_with("\r\n\r\n"), "a head ends with an empty line");

        // The same head with any following bytes, and none while it is incomplete.
        const Scan alone = scan_head(rest.substr(0, scan.used));
        expect(alone.state == Scan::State::complete && alone.used == scan.used &&
                   alone.head.headers == scan.head.headers,
               "what follows a head is no part of it");
        for (const std::size_t cut : {scan.used - 1, scan.used / 2, std::size_t{1}})
            if (cut < scan.used)
                expect(scan_head(rest.substr(0, cut)).state == Scan::State::incomplete,
                       "the beginning of a good head is neither whole nor wrong");

        const Head& head = scan.head;
        expect(head.headers.size() <= most_headers && head.target.size() <= longest_uri,
               "the limits hold");
        std::size_t lengths = 0;
        for (const auto& [name, value] : head.headers) {
            expect(!same_token(name, "Transfer-Encoding") && !same_token(name, "Content-Encoding"),
                   "no encoding of a body is taken");
            lengths += same_token(name, "Content-Length") ? 1 : 0;
            const auto breaks = [](char c) { return c == '\r' || c == '\n' || c == '\0'; };
            expect(std::none_of(value.begin(), value.end(), breaks), "no value breaks a line");
        }
        expect(lengths <= 1 && (lengths == 1) == head.content_length.has_value(),
               "one length, or none");
        const HotLookup lookup = hot_lookup(head);
        expect(!lookup.simple || ((head.method == "GET" || head.method == "HEAD") &&
                                  head.content_length.value_or(0) == 0),
               "a simple question has no body");
        rest.remove_prefix(scan.used);
    }
    return 0;
}
