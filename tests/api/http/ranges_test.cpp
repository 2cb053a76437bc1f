#include "api/http/ranges.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <set>

#include "tests/api/support.h"

namespace sporeprint::api::http_ranges_test {
namespace {

using test::expect_problem;
using test::first_species;
using test::get;
using test::header;
using test::post;
using test::request;
using test::small;
using test::text_of;

TEST(ByteRanges, OfOneRangeAreReadAndOthersIgnored) {
    const struct {
        const char* header;
        std::size_t first, size;
    } good[] = {{"bytes=0-0", 0, 1},     {"bytes=0-9", 0, 10},
                {"bytes=3-", 3, 7},      {"bytes=9-99", 9, 1},
                {"bytes=-4", 6, 4},      {"bytes=-99", 0, 10},
                {"Bytes= 2-3 ", 2, 2},   {"bytes=0-99999999999999999999999", 0, 10},
                {"bytes=00001-02", 1, 2}};
    for (const auto& [header, first, size] : good) {
        const auto range = byte_range(header, 10);
        ASSERT_TRUE(range) << header;
        EXPECT_EQ(range->first, first) << header;
        EXPECT_EQ(range->size, size) << header;
    }
    for (const char* unsatisfiable :
         {"bytes=10-", "bytes=10-20", "bytes=-0", "bytes=99999999999999999999999-"}) {
        const auto range = byte_range(unsatisfiable, 10);
        ASSERT_TRUE(range) << unsatisfiable;
        EXPECT_EQ(range->size, 0u) << unsatisfiable;
    }
    EXPECT_EQ(byte_range("bytes=0-0", 0)->size, 0u);
    EXPECT_EQ(byte_range("bytes=-1", 0)->size, 0u);
    for (const char* ignored :
         {"", "bytes", "bytes=", "bytes=-", "bytes=3-2", "bytes=0-1,3-4", "bytes=a-b", "bytes=1-x",
          "bytes=+1-2", "bytes=1 -2", "lines=0-1", "bytes 0-1", "0-1", "bytes=--1", "bytes=1-2-3",
          "bytes=0x1-2", "bytes=-1,0-0"})
        EXPECT_FALSE(byte_range(ignored, 10)) << ignored;
}

TEST(ByteRanges, OfABodyAreSlicesOfItsMemory) {
    const Body body = {slice_of("abc"), slice_of(""), slice_of("defg"), slice_of("h")};
    const std::string whole = "abcdefgh";
    for (std::size_t first = 0; first < whole.size(); ++first)
        for (std::size_t size = 0; first + size <= whole.size(); ++size) {
            std::string text;
            for (const Slice& slice : part_of(body, {first, size})) {
                text.append(reinterpret_cast<const char*>(slice.data()), slice.size);
                EXPECT_TRUE(slice.owner == body[0].owner || slice.owner == body[2].owner ||
                            slice.owner == body[3].owner);
                EXPECT_GT(slice.size, 0u);
            }
            EXPECT_EQ(text, whole.substr(first, size));
        }
}

class RangeRequest : public test::RequestedService {
  protected:
    Response range_of(const std::string& target, std::string range, std::vector<Header> more = {}) {
        more.emplace_back("Range", std::move(range));
        return ask(target, std::move(more));
    }
};

TEST_F(RangeRequest, OfWhatIsCachedIsA206ThatCopiesNothing) {
    const std::string image = "/v1/mushrooms/" + first_species() + "/normal.jpg?side=64";
    for (const std::string& target : {small(), image}) {
        const Response first = range_of(target, "bytes=0-9");
        EXPECT_EQ(first.status, 200) << "it had to be made";
        EXPECT_EQ(header(first, "Accept-Ranges"), "bytes");
        const Response whole = ask(target);
        EXPECT_EQ(header(whole, "Accept-Ranges"), "bytes");
        const std::string text = text_of(whole), etag = header(whole, "ETag"),
                          length = std::to_string(text.size());
        EXPECT_EQ(text_of(first), text);
        std::set<const Bytes*> owners;
        for (const Slice& slice : whole.body) owners.insert(slice.owner.get());
        const struct {
            std::string range, part, content_range;
        } cases[] = {
            {"bytes=5-104", text.substr(5, 100), "bytes 5-104/" + length},
            {"bytes=100-", text.substr(100),
             "bytes 100-" + std::to_string(text.size() - 1) + '/' + length},
            {"bytes=-7", text.substr(text.size() - 7),
             "bytes " + std::to_string(text.size() - 7) + '-' + std::to_string(text.size() - 1) +
                 '/' + length},
            {"bytes=0-", text, "bytes 0-" + std::to_string(text.size() - 1) + '/' + length}};
        for (const auto& [range, part, content_range] : cases) {
            const Response response = range_of(target, range);
            EXPECT_EQ(response.status, 206) << range;
            EXPECT_TRUE(text_of(response) == part) << range;
            EXPECT_EQ(header(response, "Content-Range"), content_range);
            for (const char* same : {"ETag", "Content-Type", "Cache-Control", "Content-Location",
                                     "Cache-Status", "Accept-Ranges"})
                EXPECT_EQ(header(response, same), header(whole, same)) << same;
            EXPECT_FALSE(response.cacheable);
            for (const Slice& slice : response.body)
                EXPECT_TRUE(owners.contains(slice.owner.get()));
        }
        EXPECT_EQ(range_of(target, "bytes=1-2", {{"If-Range", etag}}).status, 206);
        for (const char* other : {"\"x\"", "Sun, 06 Nov 1994 08:49:37 GMT"})
            EXPECT_TRUE(text_of(range_of(target, "bytes=1-2", {{"If-Range", other}})) == text);
        EXPECT_EQ(range_of(target, "bytes=1-2", {{"If-Range", "W/" + etag}}).status, 200);
        for (const char* ignored : {"bytes=0-1,3-4", "lines=1-2", "bytes=4-3"}) {
            const Response response = range_of(target, ignored);
            EXPECT_EQ(response.status, 200) << ignored;
            EXPECT_EQ(header(response, "Content-Range"), "");
        }
        EXPECT_EQ(range_of(target, "bytes=0-1", {{"range", "bytes=0-1"}}).status, 200) << "twice";

        const Response beyond = range_of(target, "bytes=" + length + "-");
        expect_problem(beyond, 416);
        EXPECT_EQ(header(beyond, "Content-Range"), "bytes */" + length);
        EXPECT_EQ(range_of(target, "bytes=" + length + "-", {{"If-Range", "\"x\""}}).status, 200);
        // Conditions come first.
        EXPECT_EQ(range_of(target, "bytes=0-1", {{"If-None-Match", etag}}).status, 304);
        expect_problem(range_of(target, "bytes=0-1", {{"If-Match", "\"x\""}}), 412);
        EXPECT_EQ(range_of(target, "bytes=0-1", {{"If-Match", etag}}).status, 206);
        const Response head = ask(request("HEAD", target, {{"Range", "bytes=0-1"}}));
        EXPECT_EQ(head.status, 200);
        EXPECT_EQ(size_of(head.body), text.size());
        EXPECT_EQ(header(head, "Accept-Ranges"), "bytes");
    }
}

TEST_F(RangeRequest, OfJsonAndOfAPostIsIgnored) {
    for (const std::string& target :
         {std::string("/v1/species"), "/v1/mushrooms/" + first_species() + ".json"}) {
        const Response whole = ask(target), again = range_of(target, "bytes=0-1");
        EXPECT_EQ(again.status, 200) << target;
        EXPECT_EQ(text_of(again), text_of(whole));
        EXPECT_EQ(header(again, "Accept-Ranges"), "") << target;
    }
    Request posted =
        post("{\"lod\":3,\"texture_size\":128,\"mix\":{\"" + first_species() + "\":1}}");
    posted.headers.emplace_back("Range", "bytes=0-1");
    EXPECT_EQ(ask(posted).status, 200);
    EXPECT_EQ(ask(posted).status, 200);
    EXPECT_EQ(header(ask(posted), "Accept-Ranges"), "");
}

}  // namespace
}  // namespace sporeprint::api::http_ranges_test
