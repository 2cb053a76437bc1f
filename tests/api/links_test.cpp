// Links in responses: relative in files, under a base path where there is one.
#include <string>
#include <vector>

#include "tests/api/support.h"

namespace sporeprint::api::test::links_test {
namespace {

class LinksTest : public RequestedService {};

// A reference that begins with a segment that holds ':' would be a scheme.
void expect_relative(const std::string& reference) {
    EXPECT_FALSE(reference.starts_with('/')) << reference;
    EXPECT_EQ(reference.substr(0, reference.find('/')).find(':'), std::string::npos) << reference;
}

std::vector<std::string> references_in(const Response& file) {
    const std::string text = text_of(file);
    std::vector<std::string> found;
    constexpr std::string_view begin = "\"uri\":\"";
    for (std::size_t at = 0; (at = text.find(begin, at)) != std::string::npos;) {
        at += begin.size();
        found.push_back(text.substr(at, text.find('"', at) - at));
    }
    return found;
}

/// Returns the request for the same file with textures=external.
Request external(Request request) {
    for (std::string* text : {&request.target, &request.body}) {
        const std::size_t at = text->find("linked");
        if (at != std::string::npos) text->replace(at, 6, "external");
    }
    return request;
}

/// Returns the references in extras of materials.
std::vector<std::string> external_references_in(const Response& file) {
    const std::string text = text_of(file);
    std::vector<std::string> found;
    for (std::size_t at = 0; (at = text.find("{\"images\":{", at)) != std::string::npos; ++at)
        for (const std::string kind : {"base_color", "normal", "orm"}) {
            const std::size_t begin = text.find(kind + "\":\"", at) + kind.size() + 3;
            found.push_back(text.substr(begin, text.find('"', begin) - begin));
        }
    return found;
}

TEST(Resolved, GoesUpAndDownAsClientsDo) {
    EXPECT_EQ(resolved("../b/c:d.jpg?x=../y", "/v1/a/x.glb?q=/z"), "/v1/b/c:d.jpg?x=../y");
    EXPECT_EQ(resolved("b/c.jpg", "/v1/a.glb"), "/v1/b/c.jpg");
    EXPECT_EQ(resolved("../../b", "/p/v1/m/a/b.glb"), "/p/v1/b");
    EXPECT_EQ(resolved("./a:1/b.jpg", "/v1/m/x.glb"), "/v1/m/a:1/b.jpg");
}

TEST_F(LinksTest, HoldWhereverAFileWasFetchedFrom) {
    struct Case {
        Request request;
        std::size_t images;
    };
    const std::string small = "\"lod\":3,\"texture_size\":128,\"textures\":\"linked\"}";
    const std::string query = ".glb?lod=3&texture_size=128&textures=linked";
    const std::string mix = "amanita_muscaria:0.7,boletus_edulis:0.3";
    const std::vector<Case> cases = {
        {get("/v1/mushrooms/boletus_edulis" + query), 3},
        {get("/v1/mushrooms/" + mix + query), 3},
        {get("/v1/mushrooms/amanita_muscaria%3A0.7%2Cboletus_edulis%3A0.3" + query), 3},
        {get("http://a.example/v1/mushrooms/boletus_edulis" + query), 3},
        {get("/v1/colonies/" + mix + query + "&count=2&distinct=1"), 3},
        {get("/v1/leaves/oak" + query), 3},
        {get("/v1/trees/herb" + query), 6},
        {post("{\"mix\":{\"boletus_edulis\":1}," + small), 3},
        {post("{\"mix\":{\"amanita_muscaria\":7,\"boletus_edulis\":3}," + small), 3},
        {post("{\"t\":0.3," + small, "/v1/morphs/amanita_muscaria/boletus_edulis.glb"), 3},
        {post("{\"mix\":{\"boletus_edulis\":1},\"count\":2," + small, "/v1/colonies.glb"), 3},
        {post("{\"preset\":\"oak\"," + small, "/v1/leaves.glb"), 3},
        {post("{\"preset\":\"herb\"," + small, "/v1/trees.glb"), 6}};
    for (const std::string base : {"", "/a/%7Eb"}) {
        ServiceOptions options;
        options.base_path = base;
        Service service(built_in_atlas(), options);
        for (const Case& one : cases) {
            Request request = one.request;
            const bool absolute = request.target.starts_with("http");
            if (absolute && !base.empty()) continue;
            if (!absolute) request.target = base + request.target;
            SCOPED_TRACE(request.method + ' ' + request.target);
            const Response file = handle(service, request);
            ASSERT_EQ(file.status, 200) << text_of(file);
            for (const std::string& reference : references_in(file)) expect_relative(reference);
            const Response alone = handle(service, external(request));
            EXPECT_EQ(references_in(alone), std::vector<std::string>{});
            EXPECT_EQ(external_references_in(alone), references_in(file)) << text_of(alone);
            const std::string from =
                absolute ? request.target.substr(std::string("http://a.example").size())
                         : request.target;
            const std::vector<std::string> images = linked_images(file, from);
            EXPECT_EQ(images.size(), one.images);
            for (const std::string& address : images) {
                EXPECT_TRUE(address.starts_with(base + "/v1/")) << address;
                const Response image = handle(service, get(address));
                EXPECT_EQ(image.status, 200) << address << text_of(image);
                EXPECT_EQ(header(image, "Content-Type"),
                          address.find(".png") == std::string::npos ? "image/jpeg" : "image/png");
                EXPECT_EQ(header(image, "Content-Location"), address);
            }
        }
    }
}

// Loaders of web engines accept references to what is below the folder of a file, and some of them
// append the query of the file.
TEST_F(LinksTest, OfAFileThatWasGotAreBelowItsFolderAndIgnoreItsParameters) {
    Service service(built_in_atlas(), {});
    const std::string query = "lod=2&texture_size=256&textures=linked&seed=7&size=1.5&profile=web";
    const std::string of_mushrooms = "&deformation.bend_deg=9&ornaments.ring=0.2&age=0.55";
    for (const std::string& file :
         {"/v1/mushrooms/amanita_muscaria:0.7,boletus_edulis:0.3.glb?" + query + of_mushrooms,
          "/v1/colonies/amanita_muscaria.glb?count=2&distinct=1&" + query,
          "/v1/leaves/oak.glb?autumn=0.3&curl_deg=4&" + query,
          "/v1/trees/herb.glb?leaves.droop=0.5&" + query}) {
        const Response response = handle(service, get(file));
        ASSERT_EQ(response.status, 200) << file << text_of(response);
        for (const std::string& reference : references_in(response)) {
            EXPECT_FALSE(reference.starts_with("../")) << reference;
            const std::string address = resolved(reference, file);
            const Response image = handle(service, get(address));
            ASSERT_EQ(image.status, 200) << address << text_of(image);
            std::string appended = address;
            const std::string own = address.substr(address.find('?'));
            for (const auto& pair : {std::string("lod=2"), std::string("texture_size=256"),
                                     std::string("textures=linked"), std::string("seed=7"),
                                     std::string("size=1.5"), std::string("profile=web")})
                if (own.find(pair.substr(0, pair.find('=') + 1)) == std::string::npos ||
                    pair.starts_with("size="))
                    appended += '&' + pair;
            const Response again = handle(service, get(appended));
            ASSERT_EQ(again.status, 200) << appended << text_of(again);
            EXPECT_EQ(header(again, "ETag"), header(image, "ETag")) << appended;
        }
    }
}

// The bytes of a file that links depend on how deep its address lies; no other's do.
TEST_F(LinksTest, AreAnotherRepresentationWhereTheyAreWrittenOtherwise) {
    const auto body = [](const std::string& textures) {
        return R"({"mix":{"amanita_muscaria":0.7,"boletus_edulis":0.3},"lod":3,"texture_size":128,)"
               R"("textures":")" +
               textures + "\"}";
    };
    const std::string address =
        "/v1/mushrooms/"
        "amanita_muscaria:0.7,boletus_edulis:0.3.glb?lod=3&texture_size=128&textures=";
    const std::string morph = R"({"t":0.3,"lod":3,"texture_size":128,"textures":"linked"})";
    for (const std::string textures : {"embedded", "none"}) {
        const Response got = ask(address + textures), posted = ask(post(body(textures)));
        EXPECT_EQ(header(got, "ETag"), header(posted, "ETag"));
        EXPECT_EQ(text_of(got), text_of(posted));
        EXPECT_EQ(header(got, "Content-Location"), header(posted, "Content-Location"));
    }
    const Response got = ask(address + "linked"), posted = ask(post(body("linked"))),
                   between = ask(post(morph, "/v1/morphs/amanita_muscaria/boletus_edulis.glb"));
    EXPECT_NE(header(got, "ETag"), header(posted, "ETag"));
    EXPECT_NE(header(got, "ETag"), header(between, "ETag"));
    EXPECT_NE(header(posted, "ETag"), header(between, "ETag"));
    EXPECT_NE(text_of(got), text_of(posted));
    EXPECT_NE(header(got, "Content-Location"), "");
    EXPECT_EQ(header(posted, "Content-Location"), "") << "no GET gives these bytes";
    EXPECT_EQ(header(between, "Content-Location"), "");
    // What was cached for one is not sent to the other.
    EXPECT_EQ(text_of(ask(address + "linked")), text_of(got));
    EXPECT_EQ(text_of(ask(post(body("linked")))), text_of(posted));
    EXPECT_EQ(header(ask(post(body("linked"))), "Cache-Status"), "sporeprint; hit");
}

class BasePathTest : public testing::Test {
  protected:
    static ServiceOptions under(const std::string& base) {
        ServiceOptions options;
        options.base_path = base;
        return options;
    }
    Response ask(const std::string& target) { return handle(service_, get(target)); }
    Response plain(const std::string& target) { return handle(other_, get(target)); }

    const std::string base_ = "/forest/spore";
    Service service_{built_in_atlas(), under(base_)};
    Service other_{built_in_atlas(), ServiceOptions{}};
};

TEST_F(BasePathTest, FilesAreTheSameWithAndWithoutIt) {
    const std::string target = "/v1/leaves/oak.glb?lod=3&texture_size=128";
    const Response bare = plain(target);
    for (const std::string& requested : {base_ + target, target}) {
        const Response file = ask(requested);
        ASSERT_EQ(file.status, 200) << requested;
        EXPECT_EQ(text_of(file), text_of(bare));
        EXPECT_EQ(header(file, "ETag"), header(bare, "ETag"));
        EXPECT_EQ(header(file, "Content-Location"), base_ + header(bare, "Content-Location"));
        EXPECT_EQ(ask(header(file, "Content-Location")).status, 200);
    }
    EXPECT_EQ(service_.counters().generated, 1U) << "they are one resource";
    // The canonical request in a file and in JSON is that of the service itself.
    EXPECT_EQ(json_of(ask(base_ + "/v1/leaves/oak.json")).find("canonical")->as_string(),
              "/v1/leaves/oak.glb");
    EXPECT_EQ(header(ask(base_ + "/v1/leaves/oak.json"), "ETag"),
              header(plain("/v1/leaves/oak.json"), "ETag"));
}

TEST_F(BasePathTest, LinksBeginWithIt) {
    const auto link = [](const Response& response, const char* pointer) {
        const Value body = json_of(response);
        const Value* found = body.at_pointer(pointer);
        return found ? found->as_string() : std::string();
    };
    for (const std::string& before : {base_, std::string()}) {
        EXPECT_EQ(link(ask(before + "/v1"), "/links/species"), base_ + "/v1/species");
        EXPECT_EQ(link(ask(before + "/v1/species"), "/species/0/links/model"),
                  base_ + "/v1/mushrooms/" + first_species() + ".glb");
        EXPECT_EQ(link(ask(before + "/v1/species?family=branched"), "/species/0/links/self")
                      .find(base_ + "/v1/species/"),
                  0U);
        EXPECT_EQ(link(ask(before + "/v1/leaves"), "/leaves/0/links/self").find(base_), 0U);
        EXPECT_EQ(link(ask(before + "/v1/trees"), "/trees/0/links/model").find(base_), 0U);
        EXPECT_EQ(link(ask(before + "/openapi.json"), "/servers/0/url"), base_);
    }
    EXPECT_EQ(link(plain("/v1"), "/links/species"), "/v1/species");
    EXPECT_EQ(link(plain("/openapi.json"), "/servers/0/url"), "/");
    // A document is another one with other links; one without is not.
    EXPECT_NE(header(ask("/v1/leaves"), "ETag"), header(plain("/v1/leaves"), "ETag"));
    EXPECT_EQ(header(ask("/v1/leaves/schema"), "ETag"), header(plain("/v1/leaves/schema"), "ETag"));
    const Response old = ask(base_ + "/v1/leaves/oak.glb?v=1-00000000");
    EXPECT_EQ(old.status, 410);
    EXPECT_EQ(link(old, "/type"), base_ + "/problems/" + problem_type(410).slug);
    EXPECT_EQ(link(old, "/canonical").find(base_ + "/v1/leaves/oak.glb?v="), 0U);
    EXPECT_EQ(ask(link(old, "/canonical")).status, 200);
    EXPECT_EQ(link(ask(base_ + "/v1/nothing"), "/type").find(base_ + "/problems/"), 0U);
}

TEST_F(BasePathTest, WhatOnlyBeginsLikeItIsNotUnderIt) {
    EXPECT_EQ(ask("/forest/sporeprint/v1/species").status, 404);
    EXPECT_EQ(ask(base_ + base_ + "/v1/species").status, 404) << "it is taken off once";
    EXPECT_EQ(plain(base_ + "/v1/species").status, 404);
    EXPECT_EQ(ask("http://a.example" + base_ + "/v1/species").status, 200);
}

// The page's links are relative, and without a '/' at the end they would leave the base path.
TEST_F(BasePathTest, TheBarePathLeadsToThePage) {
    const Response response = ask(base_ + "?leaf=oak");
    EXPECT_EQ(response.status, 308);
    EXPECT_EQ(header(response, "Location"), base_ + "/?leaf=oak");
    EXPECT_EQ(ask(base_ + "/").status, 200);
    EXPECT_EQ(ask(header(ask(base_), "Location")).status, 200);
}

TEST_F(BasePathTest, BodiesAreAsLargeAsElsewhere) {
    EXPECT_EQ(test::most_body(service_, "POST", base_ + "/v1/inspect"),
              test::most_body(other_, "POST", "/v1/inspect"));
    EXPECT_EQ(test::most_body(service_, "POST", "/v1/inspect"),
              test::most_body(other_, "POST", "/v1/inspect"));
    EXPECT_GT(test::most_body(other_, "POST", "/v1/inspect"),
              test::most_body(other_, "POST", base_ + "/v1/inspect"));
}

}  // namespace
}  // namespace sporeprint::api::test::links_test
