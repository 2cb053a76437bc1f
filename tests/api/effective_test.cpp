// The effective parameters that JSON tells, sent back as a body.
#include <string>

#include "tests/api/support.h"

namespace sporeprint::api::test::effective_test {
namespace {

class EffectiveTest : public RequestedService {
  protected:
    /// Returns the response to the effective parameters that `.json` reports for `target`, sent as a
    /// body with `more` beside them.
    Response sent_back(const std::string& target, const std::string& route, const char* key) {
        const Value description = json_of(ask(target));
        Value body = *description.find("effective");
        if (const Value* own = description.find(key)) {
            Value named = *own;
            if (own->is_array()) {
                named = Value::object();
                for (const Value& part : own->items())
                    named.set(part.find("id")->as_string(), *part.find("weight"));
            }
            body.set(key, std::move(named));
        }
        return ask(post(dump(body), route));
    }
};

// Without the JSON chunk, which holds the request.
std::string binary_of(const Response& response) {
    const std::string file = text_of(response);
    return file.substr(file.find("BIN"));
}

TEST_F(EffectiveTest, TreesAreTheSameResource) {
    for (const std::string id : {"broadleaf", "birch", "spruce", "poplar", "shrub", "herb"}) {
        const std::string query = "?seed=3&lod=3&texture_size=128&autumn=0.25&size=1.5&fork_deg=31";
        const Response got = ask("/v1/trees/" + id + ".glb" + query);
        const Response posted =
            sent_back("/v1/trees/" + id + ".json" + query, "/v1/trees.glb", "preset");
        ASSERT_EQ(posted.status, 200) << id << text_of(posted);
        EXPECT_EQ(header(posted, "ETag"), header(got, "ETag")) << id;
        EXPECT_EQ(header(posted, "Content-Location"), header(got, "Content-Location")) << id;
        EXPECT_TRUE(text_of(posted) == text_of(got)) << id;
    }
}

TEST_F(EffectiveTest, TreesOfOnesOwnRowsAreTheSameResource) {
    const std::string body = R"({"preset":"broadleaf","lod":3,"texture_size":128,)"
                             R"("rows":[[0.5,0.5],[0.25,0.5,0.25]]})";
    const Response own = ask(post(body, "/v1/trees.glb"));
    const Response inspected =
        ask(request("POST", "/v1/inspect", {{"Content-Type", "model/gltf-binary"}}, text_of(own)));
    Value effective = *json_of(inspected).find("effective");
    effective.set("preset", "broadleaf");
    const Response posted = ask(post(dump(effective), "/v1/trees.glb"));
    ASSERT_EQ(posted.status, 200) << text_of(posted);
    EXPECT_EQ(header(posted, "ETag"), header(own, "ETag"));
}

TEST_F(EffectiveTest, LeavesAreTheSameResource) {
    for (const std::string id : {"maple", "fern", "needle"}) {
        const std::string query = "?seed=3&lod=2&texture_size=128&autumn=0.7&venation.vein_deg=41";
        const Response got = ask("/v1/leaves/" + id + ".glb" + query);
        const Response posted =
            sent_back("/v1/leaves/" + id + ".json" + query, "/v1/leaves.glb", "preset");
        ASSERT_EQ(posted.status, 200) << id << text_of(posted);
        EXPECT_EQ(header(posted, "ETag"), header(got, "ETag")) << id;
        EXPECT_TRUE(text_of(posted) == text_of(got)) << id;
    }
}

// What is effective is every value; asking for each of them by name is another request for the same thing.
TEST_F(EffectiveTest, MushroomsAndColoniesHaveTheSameShape) {
    for (const std::string mix : {"boletus_edulis", "amanita_muscaria:0.7,boletus_edulis:0.3",
                                  "ramaria_formosa", "trametes_versicolor"}) {
        const std::string query = "?seed=3&age=0.8&lod=2&textures=none&size=1.25";
        const Response got = ask("/v1/mushrooms/" + mix + ".glb" + query);
        ASSERT_EQ(got.status, 200) << text_of(got);
        const Response posted =
            sent_back("/v1/mushrooms/" + mix + ".json" + query, "/v1/mushrooms.glb", "mix");
        ASSERT_EQ(posted.status, 200) << mix << text_of(posted);
        EXPECT_TRUE(binary_of(posted) == binary_of(got)) << mix;
    }
    for (const std::string mix : {"hypholoma_fasciculare", "armillaria_mellea",
                                  "trametes_versicolor", "marasmius_oreades"}) {
        const std::string query = "?seed=3&count=5&distinct=2&lod=2&textures=none";
        const Response got = ask("/v1/colonies/" + mix + ".glb" + query);
        const Response posted =
            sent_back("/v1/colonies/" + mix + ".json" + query, "/v1/colonies.glb", "mix");
        ASSERT_EQ(posted.status, 200) << mix << text_of(posted);
        EXPECT_TRUE(binary_of(posted) == binary_of(got)) << mix;
    }
}

}  // namespace
}  // namespace sporeprint::api::test::effective_test
