// Offspring over HTTP: bred species, mushrooms of them, their URLs and errors.

#include "api/products/offspring.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "core/gltf/inspect.h"
#include "core/grow/mushroom.h"
#include "core/params/reader.h"
#include "tests/api/support.h"

namespace sporeprint::api::products_offspring_test {
namespace {

using test::header;
using test::json_of;
using test::post;
using test::request;
using test::text_of;

const std::string pair = "/v1/offspring/amanita_muscaria/boletus_edulis";
const std::string small = "lod=3&textures=none";

class OffspringTest : public test::RequestedService {};

TEST_F(OffspringTest, IsAWholeSpeciesThatTheAtlasReads) {
    const Response response = ask(pair + ".json?seed=7&share=0.5&mutation=0.2&lock=surface.cap");
    ASSERT_EQ(response.status, 200) << text_of(response);
    EXPECT_EQ(header(response, "Content-Type"), "application/json");
    const Atlas own({.species = {text_of(response)}});
    ASSERT_EQ(own.entries().size(), 1U);
    const Species& child = own.entries().front().species;
    EXPECT_TRUE(child.id.view().starts_with("offspring_"));
    EXPECT_EQ(child.facts.common_name.view(), "Fly agaric × Cep");
    EXPECT_EQ(child.facts.sources.front().view(),
              "Bred of amanita_muscaria and boletus_edulis: seed 7, share 0.5, mutation 0.2, lock "
              "surface.cap");
}

TEST_F(OffspringTest, HasAJsonOfAnotherVersionThanItsMushroomWhereEcologiesChange) {
    const AtlasTexts& texts = built_in_texts();
    AtlasTexts changed = texts;
    const std::string mark = "\"guild\": \"ectomycorrhizal\"";
    for (std::string& text : changed.species)
        if (const std::size_t at = text.find(mark); at != std::string::npos)
            text.replace(at, mark.size(), "\"guild\": \"litter\"");
    const Atlas before(texts), after(changed);
    OffspringSpec spec;
    spec.a.id = "amanita_muscaria";
    spec.b.id = "boletus_edulis";
    EXPECT_EQ(OffspringOfTwo::version(spec, before), OffspringOfTwo::version(spec, after));
    EXPECT_NE(OffspringOfTwo::document_version(spec, before),
              OffspringOfTwo::document_version(spec, after));
    const std::string token = OffspringOfTwo::document_version(spec, before);
    const Response current = ask(pair + ".json?v=" + token);
    EXPECT_EQ(current.status, 200) << text_of(current);
    EXPECT_NE(header(current, "Cache-Control").find("immutable"), std::string::npos);
    EXPECT_EQ(ask(pair + ".json?v=" + OffspringOfTwo::version(spec, before)).status, 410)
        << "the text before there were ecologies";
    EXPECT_EQ(ask(pair + ".glb?" + small + "&v=" + OffspringOfTwo::version(spec, before)).status,
              200);
}

TEST_F(OffspringTest, GrowsTheMushroomOfThatSpecies) {
    const Response response = ask(pair + ".glb?seed=7&age=0.5&individual=3&" + small);
    ASSERT_EQ(response.status, 200) << text_of(response);
    const Atlas own({.species = {text_of(ask(pair + ".json?seed=7"))}});
    MushroomSpec spec;
    spec.mix = {{own.entries().front().species.id.string(), 1000}};
    spec.params.seed = 3;
    spec.params.age = 0.5;
    spec.params.lod = 3;
    spec.params.textures = Textures::none;
    Extras extras;
    extras.canonical = pair + ".glb?seed=7&individual=3&age=0.5&lod=3&textures=none";
    std::string bytes;
    for (const Slice& slice : grow_mushroom(spec, own, extras).glb)
        bytes.append(reinterpret_cast<const char*>(slice.data()), slice.size);
    EXPECT_EQ(text_of(response), bytes);
}

TEST_F(OffspringTest, HasOneUrlForEqualRequests) {
    const std::string canonical = header(
        ask(pair + ".glb?individual=4&lock=size,surface.cap&seed=2&share=0.5&lock=ring&" + small),
        "Content-Location");
    EXPECT_TRUE(canonical.starts_with(pair +
                                      ".glb?seed=2&lock=ring&lock=size&lock=surface.cap&individual="
                                      "4&lod=3&textures=none&v="))
        << canonical;
    const Response again = ask(canonical);
    EXPECT_EQ(header(again, "Cache-Status"), "sporeprint; hit");
    EXPECT_NE(header(again, "Cache-Control").find("immutable"), std::string::npos);
    EXPECT_EQ(generated(), 1U);
    const Response unchanged = ask(canonical, {{"If-None-Match", header(again, "ETag")}});
    EXPECT_EQ(unchanged.status, 304);
}

TEST_F(OffspringTest, IsBredOnceForAllItsFiles) {
    const Response first = ask(pair + ".glb?seed=5&" + small);
    EXPECT_NE(header(first, "Cache-Status").find("sporeprint-morph"), std::string::npos);
    EXPECT_EQ(ask(pair + ".glb?seed=5&lod=2&textures=none").status, 200);
    EXPECT_EQ(ask(pair + ".json?seed=5").status, 200);
    // Only the individual's own correspondence and that of the parents were computed.
    EXPECT_EQ(service_.counters().morph_misses, 2U);
}

TEST_F(OffspringTest, HasHeadersWithoutABody) {
    for (const char* const ending : {".json?seed=3", ".glb?seed=3&lod=3", ".png?seed=3&lod=3"}) {
        const Response head = handle(service_, request("HEAD", pair + ending));
        EXPECT_EQ(head.status, 200) << ending;
        EXPECT_FALSE(header(head, "ETag").empty());
        EXPECT_EQ(header(head, "ETag"), header(ask(pair + ending), "ETag"));
    }
}

TEST_F(OffspringTest, OfOldVersionsIsGone) {
    const Response response = ask(pair + ".glb?seed=3&v=1-00000000");
    EXPECT_EQ(response.status, 410);
    EXPECT_NE(text_of(response).find(pair + ".glb?seed=3&v="), std::string::npos);
}

TEST_F(OffspringTest, IsDrawn) {
    const Response response = ask(pair + ".png?seed=2&lod=3&width=64&height=64");
    EXPECT_EQ(response.status, 200);
    EXPECT_EQ(header(response, "Content-Type"), "image/png");
}

TEST_F(OffspringTest, RefusesByName) {
    const auto problem = [&](const std::string& target, int status, const char* parameter,
                             const char* words) {
        const Response response = ask(target);
        EXPECT_EQ(response.status, status) << target << text_of(response);
        const Value body = json_of(response);
        bool found = false;
        for (const Value& error : body.find("errors")->items())
            found = found || (error.find("parameter")->as_string() == parameter &&
                              error.find("detail")->as_string().find(words) != std::string::npos);
        EXPECT_TRUE(found) << target << text_of(response);
    };
    problem(pair + ".glb?share=1.2", 400, "share", "0..1");
    problem(pair + ".glb?mutation=much", 400, "mutation", "expected a number");
    problem(pair + ".glb?seed=-1", 400, "seed", "outside");
    problem(pair + ".glb?individual=-1", 400, "individual", "outside");
    problem(pair + ".glb?lock=surface.cup", 400, "lock", "did you mean 'surface.cap'?");
    problem(pair + ".glb?lock=", 400, "lock", "no part");
    problem(pair + ".glb?mutaton=0.5", 400, "mutaton", "did you mean 'mutation'?");
    problem(pair + ".glb?seed=1&seed=2", 400, "seed", "more than once");
    problem(pair + ".glb?age=2", 400, "age", "0..1");
    problem(pair + ".glb?textures=linked", 422, "textures", "no addresses");
    problem(pair + ".glb?frames=3", 422, "frames", "clip");
    problem(pair + ".json?lod=2", 400, "lod", "unknown parameter");
    problem("/v1/offspring/amanita_muscara/boletus_edulis.json", 404, "a",
            "did you mean 'amanita_muscaria'?");
    problem("/v1/offspring/amanita_muscaria/ramaria_formosa.glb", 422, "b", "one family");
}

TEST_F(OffspringTest, OfOneSpeciesTwiceIsAMutationOfIt) {
    const Response response =
        ask("/v1/offspring/ramaria_formosa/ramaria_formosa.glb?mutation=0.3&" + small);
    EXPECT_EQ(response.status, 200) << text_of(response);
    EXPECT_EQ(ask("/v1/offspring/russula_emetica/russula_emetica.glb?" + small).status, 200);
}

TEST_F(OffspringTest, HasParentsThatAreOffspringThemselves) {
    const std::string child = text_of(ask(pair + ".json?seed=7"));
    const std::string body =
        R"({"a":)" + child + R"(,"b":"russula_emetica","seed":2,"lock":["ring"])";
    const Response species = ask(post(body + '}', "/v1/offspring.json"));
    ASSERT_EQ(species.status, 200) << text_of(species);
    EXPECT_TRUE(header(species, "Content-Location").empty());
    const Atlas own({.species = {text_of(species)}});
    EXPECT_EQ(own.entries().front().species.facts.scientific_name.view(),
              "Amanita muscaria × Russula emetica");
    const std::string file = R"(,"individual":3,"lod":3,"textures":"none"})";
    const Response grown = ask(post(body + file, "/v1/offspring.glb"));
    ASSERT_EQ(grown.status, 200) << text_of(grown);
    EXPECT_EQ(header(ask(post(body + file, "/v1/offspring.glb")), "Cache-Status"),
              "sporeprint; hit");
}

TEST_F(OffspringTest, OfABodyWithIdsIsThatOfItsUrl) {
    const Response posted = ask(post(
        R"({"a":"amanita_muscaria","b":"boletus_edulis","seed":5,"individual":2,"lod":3,"textures":"none"})",
        "/v1/offspring.glb"));
    const Response got = ask(pair + ".glb?seed=5&individual=2&" + small);
    EXPECT_EQ(header(posted, "ETag"), header(got, "ETag"));
    EXPECT_EQ(header(posted, "Content-Location"), header(got, "Content-Location"));
    EXPECT_EQ(text_of(posted), text_of(got));
}

TEST_F(OffspringTest, RefusesBodiesByPath) {
    const auto problem = [&](const std::string& body, const char* target, int status,
                             const char* parameter, const char* words) {
        const Response response = ask(post(body, target));
        EXPECT_EQ(response.status, status) << body << text_of(response);
        EXPECT_NE(text_of(response).find(std::string("\"") + parameter + '"'), std::string::npos)
            << body << text_of(response);
        EXPECT_NE(text_of(response).find(words), std::string::npos) << body << text_of(response);
    };
    const std::string both = R"("a":"amanita_muscaria","b":"boletus_edulis")";
    const char *const species = "/v1/offspring.json", *const file = "/v1/offspring.glb";
    problem(R"({"a":"amanita_muscaria"})", species, 400, "/b", "is missing");
    problem(R"({"a":"amanita_muscara","b":"boletus_edulis"})", species, 404, "/a", "did you mean");
    problem(R"({"a":{"id":"mine"},"b":"boletus_edulis"})", species, 422, "/a/stages", "stages");
    problem(R"({"a":{"id":"mine","size":3},"b":"boletus_edulis"})", species, 400, "/a/size",
            "unknown");
    problem('{' + both + R"(,"share":2})", species, 400, "/share", "0..1");
    problem('{' + both + R"(,"lock":["surface.cup"]})", species, 400, "/lock", "surface.cap");
    problem('{' + both + R"(,"lod":1})", species, 400, "/lod", "of a mushroom");
    problem('{' + both + R"(,"individual":-1})", file, 400, "/individual", "outside");
    problem('{' + both + R"(,"textures":"linked"})", file, 422, "/textures", "no addresses");
}

}  // namespace
}  // namespace sporeprint::api::products_offspring_test
