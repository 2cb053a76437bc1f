#include "api/http/compression.h"

#include <gtest/gtest.h>
#include <zlib.h>

#include <algorithm>
#include <thread>

#include "core/problems.h"
#include "tests/api/support.h"

namespace sporeprint::api::http_compression_test {
namespace {

using test::first_species;
using test::get;
using test::header;
using test::request;
using test::small;
using test::text_of;

std::string text_of(const Body& body) {
    Response response;
    response.body = body;
    return test::text_of(response);
}

/// What one gzip member holds, read to its last byte.
std::string gunzipped(const std::string& bytes) {
    z_stream stream{};
    EXPECT_EQ(inflateInit2(&stream, 15 + 16), Z_OK);
    stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
    stream.avail_in = static_cast<uInt>(bytes.size());
    std::string out;
    int state = Z_OK;
    while (state == Z_OK) {
        const std::size_t had = out.size();
        out.resize(had + (1u << 20));
        stream.next_out = reinterpret_cast<Bytef*>(out.data() + had);
        stream.avail_out = 1u << 20;
        state = inflate(&stream, Z_NO_FLUSH);
        out.resize(out.size() - stream.avail_out);
    }
    EXPECT_EQ(state, Z_STREAM_END);
    EXPECT_EQ(stream.avail_in, 0u);
    inflateEnd(&stream);
    return out;
}

void on_threads(std::span<const std::function<void()>> pieces) {
    std::vector<std::jthread> threads;
    for (const auto& piece : pieces) threads.emplace_back(piece);
}

TEST(Compression, GivesTheBytesBackAndIsTheSameOnAnyNumberOfThreads) {
    std::string text;
    for (std::uint32_t i = 0; text.size() < 2'000'000; ++i)
        text += std::to_string(i * 2654435761u % 1000) + ',';
    const std::size_t cuts[] = {0, 1, 700'000, 700'000, 1'048'576, text.size()};
    Body body;
    for (std::size_t i = 0; i + 1 < std::size(cuts); ++i)
        body.push_back(slice_of(text.substr(cuts[i], cuts[i + 1] - cuts[i])));
    const std::string once = text_of(gzip_glb(body, {}, in_turn));
    EXPECT_TRUE(gunzipped(once) == text);
    EXPECT_LT(once.size(), text.size() / 2);
    EXPECT_TRUE(text_of(gzip_glb(body, {}, on_threads)) == once);
    EXPECT_TRUE(text_of(gzip_glb({slice_of(text)}, {}, in_turn)) == once) << "wherever it is cut";
    EXPECT_EQ(gunzipped(text_of(gzip_glb({}, {}, in_turn))), "");
    for (const std::size_t size :
         {std::size_t{1}, std::size_t{512} << 10, (std::size_t{512} << 10) + 1})
        EXPECT_TRUE(gunzipped(text_of(gzip_glb({slice_of(text.substr(0, size))}, {}, in_turn))) ==
                    text.substr(0, size));
    std::stop_source stop;
    stop.request_stop();
    EXPECT_THROW(static_cast<void>(gzip_glb(body, stop.get_token(), in_turn)), Cancelled);
}

const std::string tree = "/v1/trees/broadleaf.glb?lod=1&textures=none";
const std::vector<Header> gzip_please = {{"Accept-Encoding", "gzip, deflate, br"}};

class GzipOfGlb : public test::RequestedService {
  protected:
    std::vector<Header> with_gzip(std::vector<Header> more) {
        more.insert(more.end(), gzip_please.begin(), gzip_please.end());
        return more;
    }
};

TEST_F(GzipOfGlb, IsAVariantOfALargeMeshWithItsOwnTagAndCacheEntry) {
    const Response plain = ask(tree);
    ASSERT_EQ(plain.status, 200) << text_of(plain);
    ASSERT_GT(size_of(plain.body), 1u << 20);
    EXPECT_EQ(header(plain, "Vary"), "Accept-Encoding");
    EXPECT_EQ(header(plain, "Content-Encoding"), "");
    const std::string etag = header(plain, "ETag"),
                      gz_etag = etag.substr(0, etag.size() - 1) + "-gz\"";

    // HEAD of the variant that is not there yet compresses nothing.
    const Response head = ask(request("HEAD", tree, gzip_please));
    EXPECT_FALSE(head.has_body);
    const Response zipped = ask(tree, gzip_please);
    EXPECT_EQ(header(zipped, "Cache-Status"), "sporeprint-gzip; fwd=miss; stored, sporeprint; hit");
    const Response again = ask(tree, gzip_please);
    EXPECT_EQ(header(again, "Cache-Status"), "sporeprint; hit");
    EXPECT_TRUE(again.cacheable);
    EXPECT_EQ(again.body.at(1).owner, zipped.body.at(1).owner) << "compressed once";
    for (const Response* response : {&head, &zipped, &again}) {
        EXPECT_EQ(response->status, 200);
        EXPECT_EQ(header(*response, "ETag"), gz_etag);
        EXPECT_EQ(header(*response, "Content-Encoding"), "gzip");
        for (const char* same : {"Vary", "Content-Type", "Content-Location", "Content-Disposition",
                                 "Cache-Control", "Accept-Ranges"})
            EXPECT_EQ(header(*response, same), header(plain, same)) << same;
    }
    EXPECT_TRUE(gunzipped(text_of(zipped)) == text_of(plain));
    EXPECT_LT(size_of(zipped.body) * 10, size_of(plain.body) * 8);
    const Response warm_head = ask(request("HEAD", tree, gzip_please));
    EXPECT_TRUE(warm_head.has_body);
    EXPECT_EQ(size_of(warm_head.body), size_of(zipped.body));
    EXPECT_EQ(header(ask(tree), "ETag"), etag) << "who does not ask gets it plain";
    EXPECT_EQ(header(ask(tree, {{"Accept-Encoding", "br, gzip;q=0"}}), "Content-Encoding"), "");
    EXPECT_EQ(generated(), 1u);
    EXPECT_EQ(service_.counters().glb_cache_entries, 2u);
}

TEST_F(GzipOfGlb, IsCompressedWithTheFileByOneJobForTheFirstRequest) {
    auto planned = plan_here(service_, get(tree, gzip_please));
    ASSERT_TRUE(std::holds_alternative<Job>(planned));
    Job& job = std::get<Job>(planned);
    auto plainly = plan_here(service_, get(tree));
    EXPECT_EQ(std::get<Job>(plainly).key, job.key) << "one flight";
    EXPECT_GT(job.cost.work(), std::get<Job>(plainly).cost.work() + 10'000) << "and charged";
    const Response shared = job.run(
        {}, [](Step) {}, in_turn);
    service_.finish(job.key, shared);
    const Response zipped =
        service_.deliver(get(tree, gzip_please), job.delivery, shared, Outcome::generated, {});
    const Response plain = service_.deliver(get(tree), std::get<Job>(plainly).delivery, shared,
                                            Outcome::collapsed, {});
    EXPECT_EQ(header(zipped, "Content-Encoding"), "gzip");
    EXPECT_TRUE(header(zipped, "Cache-Status").ends_with("sporeprint; fwd=miss; stored"));
    EXPECT_EQ(header(plain, "Content-Encoding"), "");
    EXPECT_TRUE(zipped.gzipped.empty() && plain.gzipped.empty());
    EXPECT_TRUE(gunzipped(text_of(zipped)) == text_of(plain));
    for (const auto& response : {ask(tree), ask(tree, gzip_please)})
        EXPECT_EQ(header(response, "Cache-Status"), "sporeprint; hit");
    EXPECT_EQ(generated(), 1u);
}

TEST_F(GzipOfGlb, IsConditionalByEitherTagBeforeAnythingIsMade) {
    const std::string etag = header(ask(request("HEAD", tree)), "ETag"),
                      gz_etag = etag.substr(0, etag.size() - 1) + "-gz\"";
    for (int round = 0; round < 2; ++round) {
        for (const std::string& tag : {etag, gz_etag}) {
            const Response response = ask(tree, with_gzip({{"If-None-Match", tag}}));
            EXPECT_EQ(response.status, 304);
            EXPECT_EQ(header(response, "ETag"), tag) << "that of what the client has";
            EXPECT_EQ(header(response, "Vary"), "Accept-Encoding");
            EXPECT_EQ(ask(request("HEAD", tree, with_gzip({{"If-Match", tag}}))).status, 200);
        }
        EXPECT_EQ(generated(), round == 0 ? 0u : 1u);
        test::expect_problem(ask(tree, {{"If-Match", gz_etag}}), 412);
        EXPECT_EQ(ask(tree, {{"If-None-Match", gz_etag}}).status, 200)
            << "of no use to this client";
    }
    EXPECT_EQ(header(ask(tree, with_gzip({{"If-None-Match", "*"}})), "ETag"), gz_etag);
}

TEST_F(GzipOfGlb, HasRangesForWhoNamesItInIfRange) {
    const std::string plain = text_of(ask(tree)), zipped = text_of(ask(tree, gzip_please));
    const std::string etag = header(ask(tree), "ETag"),
                      gz_etag = header(ask(tree, gzip_please), "ETag");
    const Response of_zipped =
        ask(tree, with_gzip({{"Range", "bytes=1000-1999"}, {"If-Range", gz_etag}}));
    EXPECT_EQ(of_zipped.status, 206);
    EXPECT_EQ(header(of_zipped, "Content-Encoding"), "gzip");
    EXPECT_TRUE(text_of(of_zipped) == zipped.substr(1000, 1000));
    EXPECT_EQ(header(of_zipped, "Content-Range"),
              "bytes 1000-1999/" + std::to_string(zipped.size()));
    for (std::vector<Header> more :
         {std::vector<Header>{}, std::vector<Header>{{"If-Range", etag}}}) {
        more.emplace_back("Range", "bytes=1000-1999");
        const Response of_plain = ask(tree, with_gzip(more));
        EXPECT_EQ(of_plain.status, 206);
        EXPECT_EQ(header(of_plain, "ETag"), etag);
        EXPECT_EQ(header(of_plain, "Content-Encoding"), "");
        EXPECT_TRUE(text_of(of_plain) == plain.substr(1000, 1000));
    }
}

TEST_F(GzipOfGlb, IsNotMadeOfSmallFilesNorOfImages) {
    for (const std::string& target :
         {small(), "/v1/mushrooms/" + first_species() + ".glb",  // mostly images
          "/v1/mushrooms/" + first_species() + ".glb?lod=1&textures=none"}) {
        const Response cold = ask(target, gzip_please), warm = ask(target, gzip_please);
        for (const Response* response : {&cold, &warm}) {
            EXPECT_EQ(header(*response, "Content-Encoding"), "") << target;
            EXPECT_EQ(header(*response, "Vary"), "") << target << ": one answer for all clients";
        }
        EXPECT_EQ(header(warm, "Cache-Status"), "sporeprint; hit");
    }
    EXPECT_GT(size_of(ask("/v1/mushrooms/" + first_species() + ".glb").body), 1u << 20);
}

}  // namespace
}  // namespace sporeprint::api::http_compression_test
