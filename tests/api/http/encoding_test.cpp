#include "api/http/encoding.h"

#include <gtest/gtest.h>
#include <zlib.h>

#include "api/http/documents.h"

namespace sporeprint::api::http_encoding_test {
namespace {

std::string gunzipped(const Slice& slice) {
    z_stream stream{};
    EXPECT_EQ(inflateInit2(&stream, 15 + 16), Z_OK);
    std::string out(1u << 20, ' ');
    stream.next_in = const_cast<Bytef*>(slice.data());
    stream.avail_in = static_cast<uInt>(slice.size);
    stream.next_out = reinterpret_cast<Bytef*>(out.data());
    stream.avail_out = static_cast<uInt>(out.size());
    EXPECT_EQ(inflate(&stream, Z_FINISH), Z_STREAM_END);
    out.resize(stream.total_out);
    inflateEnd(&stream);
    return out;
}

TEST(Etag, IsThatOfXxh3128WithQuotes) {
    // XXH3_128bits of the empty text, by its specification.
    EXPECT_EQ(etag_of(""), "\"99aa06d3014798d86001c324468d497f\"");
    EXPECT_NE(etag_of("a"), etag_of("b"));
    EXPECT_EQ(gzip_etag("\"ab\""), "\"ab-gz\"");
}

TEST(IfNoneMatch, ListsAndWeakTagsMatch) {
    const std::string tag = "\"ab\"";
    for (const char* header :
         {"\"ab\"", "W/\"ab\"", "\"x\", \"ab\"", "\"x,y\",W/\"ab\" , \"z\"", " \"ab\""})
        EXPECT_TRUE(names_etag(header, tag)) << header;
    for (const char* header :
         {"", "*", "ab", "\"a\"", "\"AB\"", "w/\"ab\"", "\"ab", "\"x\" ab", "\"ab-gz\""})
        EXPECT_FALSE(names_etag(header, tag)) << header;
    EXPECT_FALSE(names_etag("W/\"ab\"", tag, Comparison::strong));
    EXPECT_TRUE(names_etag("W/\"ab\", \"ab\"", tag, Comparison::strong));
    EXPECT_TRUE(names_any(" * "));
    EXPECT_FALSE(names_any("\"*\""));
}

TEST(AcceptEncoding, GzipIsAllowedByNameOrStarUnlessRefused) {
    for (const char* header : {"gzip", "GZIP", "x-gzip", "br, gzip;q=0.5", "*", "deflate, *;q=0.1",
                               "gzip;q=1.000", "identity;q=0, gzip"})
        EXPECT_TRUE(accepts_gzip(header)) << header;
    for (const char* header :
         {"", "br", "identity", "gzip;q=0", "gzip; q=0.000", "*;q=0", "gzip;q=0, *", "gzipped"})
        EXPECT_FALSE(accepts_gzip(header)) << header;
}

TEST(Gzip, GivesTheSlicesBackAndIsTheSameEachTime) {
    const Body body = {slice_of("one, "), slice_of(""), slice_of(std::string(5000, 'x'))};
    EXPECT_EQ(gunzipped(gzip(body)), "one, " + std::string(5000, 'x'));
    const Slice again = gzip(body), once = gzip(body);
    EXPECT_EQ(*again.owner, *once.owner);
    EXPECT_EQ(gunzipped(gzip({})), "");
}

TEST(Assets, NamesWithAHashNeverChange) {
    for (const char* name :
         {"app-3F9A1C02.js", "app-3f9a1c02.css", "chunk-XY7QABCD.js.map", "a-b-0123456789ab.js"})
        EXPECT_TRUE(has_hash(name)) << name;
    for (const char* name :
         {"index.html", "favicon.svg", "app.js", "my-settings.js", "app-12.js", "a-12345678"})
        EXPECT_FALSE(has_hash(name)) << name;
}

TEST(Assets, TypesFollowTheEnding) {
    EXPECT_EQ(content_type_of("a.HTML"), "text/html; charset=utf-8");
    EXPECT_EQ(content_type_of("a-1.js"), "text/javascript; charset=utf-8");
    EXPECT_EQ(content_type_of("a"), "application/octet-stream");
    EXPECT_TRUE(compressible("text/html; charset=utf-8"));
    EXPECT_TRUE(compressible("image/svg+xml"));
    EXPECT_FALSE(compressible("model/gltf-binary"));
    EXPECT_FALSE(compressible("image/jpeg"));
}

}  // namespace
}  // namespace sporeprint::api::http_encoding_test
