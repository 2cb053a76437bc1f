#include "api/http/encoding.h"

#include <xxhash.h>
#include <zlib.h>

#include <algorithm>
#include <memory>
#include <new>

#include "api/http/text.h"

namespace sporeprint::api {

namespace {

std::string digits_of(XXH128_hash_t hash) {
    XXH128_canonical_t bytes;
    XXH128_canonicalFromHash(&bytes, hash);
    std::string out;
    for (const unsigned char byte : bytes.digest) {
        out += "0123456789abcdef"[byte >> 4];
        out += "0123456789abcdef"[byte & 15];
    }
    return out;
}

}  // namespace

std::string digest_of(std::string_view text) {
    return digits_of(XXH3_128bits(text.data(), text.size()));
}

std::string digest_of(const Body& body) {
    const std::unique_ptr<XXH3_state_t, decltype(&XXH3_freeState)> state(XXH3_createState(),
                                                                         &XXH3_freeState);
    if (!state) throw std::bad_alloc();
    XXH3_128bits_reset(state.get());
    for (const Slice& slice : body) XXH3_128bits_update(state.get(), slice.data(), slice.size);
    return digits_of(XXH3_128bits_digest(state.get()));
}

std::string etag_of(std::string_view key) { return '"' + digest_of(key) + '"'; }

std::string gzip_etag(std::string_view etag) {
    return etag.size() < 2 ? std::string(etag)
                           : std::string(etag.substr(0, etag.size() - 1)) + "-gz\"";
}

bool names_any(std::string_view list) { return trimmed(list) == "*"; }

bool names_etag(std::string_view list, std::string_view etag, Comparison comparison) {
    // Parsed by hand, since a quoted tag may contain commas.
    std::string_view rest = list;
    for (;;) {
        while (!rest.empty() &&
               (rest.front() == ' ' || rest.front() == '\t' || rest.front() == ','))
            rest.remove_prefix(1);
        const bool is_weak = rest.starts_with("W/");
        if (is_weak) rest.remove_prefix(2);
        if (!rest.starts_with('"')) return false;
        const std::size_t end = rest.find('"', 1);
        if (end == std::string_view::npos) return false;
        if (rest.substr(0, end + 1) == etag && !(is_weak && comparison == Comparison::strong))
            return true;
        rest.remove_prefix(end + 1);
    }
}

bool accepts_gzip(std::string_view accept_encoding) {
    // The hot table of the server calls this for each request, so nothing is allocated here.
    int named = -1, any = -1;  // -1 absent, 0 refused, 1 allowed
    const auto next = [](std::string_view& rest, char separator) {
        const std::size_t end = std::min(rest.find(separator), rest.size());
        const std::string_view piece = trimmed(rest.substr(0, end));
        rest.remove_prefix(std::min(end + 1, rest.size()));
        return piece;
    };
    while (!accept_encoding.empty()) {
        std::string_view item = next(accept_encoding, ',');
        const std::string_view coding = next(item, ';');
        bool allowed = true;
        while (!item.empty()) {
            const std::string_view parameter = next(item, ';');
            if (parameter.size() < 2 || lower(parameter[0]) != 'q' || parameter[1] != '=') continue;
            allowed = parameter.find_first_of("123456789", 2) != std::string_view::npos;
        }
        if (same_word(coding, "gzip") || same_word(coding, "x-gzip")) named = allowed ? 1 : 0;
        if (coding == "*") any = allowed ? 1 : 0;
    }
    return named >= 0 ? named == 1 : any == 1;
}

Slice gzip(const Body& body) {
    z_stream stream{};
    if (deflateInit2(&stream, 6, Z_DEFLATED, 15 + 16, 8, Z_DEFAULT_STRATEGY) != Z_OK)
        throw std::bad_alloc();
    auto out =
        std::make_shared<Bytes>(deflateBound(&stream, static_cast<uLong>(size_of(body))) + 32);
    stream.next_out = out->data();
    stream.avail_out = static_cast<uInt>(out->size());
    for (std::size_t i = 0; i <= body.size(); ++i) {
        const bool last = i == body.size();
        stream.next_in = last ? nullptr : const_cast<Bytef*>(body[i].data());
        stream.avail_in = last ? 0 : static_cast<uInt>(body[i].size);
        deflate(&stream, last ? Z_FINISH : Z_NO_FLUSH);
    }
    out->resize(stream.total_out);
    deflateEnd(&stream);
    return Slice(std::move(out));
}

}  // namespace sporeprint::api
