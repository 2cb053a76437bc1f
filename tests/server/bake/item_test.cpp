#include "server/bake/item.h"

#include <gtest/gtest.h>

#include <set>
#include <string>

#include "api/http/response_builder.h"
#include "core/atlas/atlas.h"
#include "core/params/types.h"

namespace sporeprint::server::item_test {
namespace {

api::Service& service() {
    static api::Service one(built_in_atlas(), {});
    return one;
}

std::string text_of(const Body& body) {
    std::string text;
    for (const Slice& slice : body)
        text.append(reinterpret_cast<const char*>(slice.data()), slice.size);
    return text;
}

Value parsed(const std::string& text) {
    std::vector<Problem> problems;
    Value value = parse(text, problems);
    EXPECT_TRUE(problems.empty()) << text;
    return value;
}

const api::BatchManifest& spec() {
    static const api::BatchManifest one(
        R"({"path":"/v1/mushrooms/{mix}.glb","count":12,"fixed":{"lod":3,"textures":"none"},
            "choice":{"mix":["boletus_edulis","no_such_one"]},"uniform":{"age":[0.5,1]},
            "number":{"seed":1}})");
    return one;
}

TEST(BakedItem, HasTheBytesThatAreServed) {
    std::size_t made = 0, failed = 0;
    std::set<std::string> names;
    for (std::uint64_t i = 0; i < spec().count(); ++i) {
        const BakedItem item = baked_item(service(), spec(), i);
        api::Request request;
        request.method = "GET";
        request.target = item.target;
        const api::Response served = api::handle(service(), request);
        EXPECT_EQ(item.status, served.status);
        if (item.failed()) {
            ++failed;
            EXPECT_EQ(item.status, 404);
            EXPECT_TRUE(item.body.empty());
            EXPECT_EQ(item.problem.find("status")->as_number(), 404.0);
            EXPECT_EQ(item.problem.find("instance"), nullptr) << "It differs from run to run.";
            continue;
        }
        ++made;
        const std::string bytes = text_of(item.body);
        EXPECT_EQ(bytes, text_of(served.body));
        EXPECT_EQ(item.sha256, sha256_hex(bytes.data(), bytes.size()));
        EXPECT_EQ(item.etag, api::header_of(served, "ETag"));
        EXPECT_EQ(item.url, api::header_of(served, "Content-Location"));
        EXPECT_NE(item.url.find("&v="), std::string::npos);
        EXPECT_EQ(item.type, "model/gltf-binary");
        EXPECT_EQ(item.labels.at_pointer("/effective/seed")->as_number(),
                  static_cast<double>(i + 1));
        EXPECT_EQ(item.file.find("boletus_edulis_s"), 0U) << item.file;
        EXPECT_TRUE(names.insert(item.file).second);
        EXPECT_EQ(extension_of(item), "glb");
        const Value line = parsed(index_line(item, {"offset", Value(512)}));
        EXPECT_EQ(line.find("key")->as_string(), key_of(i));
        EXPECT_EQ(line.find("bytes")->as_number(), static_cast<double>(bytes.size()));
        EXPECT_EQ(line.find("offset")->as_number(), 512.0);
        EXPECT_EQ(*line.find("labels"), item.labels);
        const Value labels = parsed(labels_text(item));
        EXPECT_EQ(labels.find("url")->as_string(), item.url);
        EXPECT_EQ(*labels.find("drawn"), item.drawn);
    }
    EXPECT_GT(made, 0U);
    EXPECT_GT(failed, 0U);
}

TEST(BakedItem, OfJsonHasNoFileOfLabels) {
    const api::BatchManifest manifest(
        "/v1/worlds/beech,seed=7/weather.json?year=80\n/v1/species\n");
    const BakedItem weather = baked_item(service(), manifest, 0);
    EXPECT_FALSE(weather.failed());
    EXPECT_EQ(labels_text(weather), "");
    EXPECT_TRUE(weather.labels.is_null());
    EXPECT_EQ(extension_of(baked_item(service(), manifest, 1)), "bin");
}

TEST(BakedItem, HasAKeyOfNineDigits) {
    EXPECT_EQ(key_of(0), "000000000");
    EXPECT_EQ(key_of(123), "000000123");
    EXPECT_EQ(key_of(9'999'999'999), "9999999999");
}

}  // namespace
}  // namespace sporeprint::server::item_test
