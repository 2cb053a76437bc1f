// Parts of worlds by POST: the same resources as those of GET, and worlds with ecologies, founders and masks.

#include "api/products/worlds/part_request.h"

#include <gtest/gtest.h>

#include <memory>
#include <string>

#include "tests/api/support.h"

namespace sporeprint::api::products_world_part_request_test {
namespace {

using test::errors_of;
using test::header;
using test::json_of;
using test::names;
using test::post;
using test::text_of;

const std::string meadow = R"("world":"meadow,seed=7,extent=256","time":"y80d270")";

/// What a GET and a POST name, which have to be one resource.
struct Same {
    const char *get, *post, *body;
};

class WorldPostsTest : public test::RequestedService {
  protected:
    Response send(const std::string& target, const std::string& body) {
        return ask(post(body, target));
    }
    /// Sends a body of a list of placements with some more members.
    Response placements(const std::string& more) {
        return send("/v1/worlds/placements.json",
                    '{' + meadow + R"(,"kinds":"fungus","bbox":"-8,-8,8,8")" + more + '}');
    }
};

TEST_F(WorldPostsTest, AreTheResourcesOfGetWithoutEdits) {
    const std::string path = "/v1/worlds/meadow,seed=7,extent=256/y80d270";
    const Same pairs[] = {
        {"/plot.glb?size=2&texture_size=256", "plot.glb", R"(,"size":2,"texture_size":256)"},
        {"/plot.json?x=3.5", "plot.json", R"(,"x":3.5)"},
        {"/plot.png?size=2&texture_size=256&width=64&height=64&view=top", "plot.png",
         R"(,"size":2,"texture_size":256,"width":64,"height":64,"view":"top")"},
        {"/placements.csv?bbox=-8,-8,8,8", "placements.csv", R"(,"bbox":"-8,-8,8,8")"},
        {"/placements.json?kinds=fungus+tree", "placements.json", R"(,"kinds":"fungus+tree")"},
        {"/maps/height.png?size=65", "maps/height.png", R"(,"size":65)"},
        {"/maps/spores.png?size=64&species=marasmius_oreades", "maps/spores.png",
         R"(,"size":64,"species":"marasmius_oreades")"},
        {"/maps/wetness.json?size=65", "maps/wetness.json", R"(,"size":65)"},
    };
    for (const Same& one : pairs) {
        const Response got = ask(path + one.get);
        ASSERT_EQ(got.status, 200) << one.get << text_of(got);
        const Response posted =
            send(std::string("/v1/worlds/") + one.post, '{' + meadow + one.body + '}');
        ASSERT_EQ(posted.status, 200) << one.post << text_of(posted);
        EXPECT_EQ(header(posted, "ETag"), header(got, "ETag")) << one.post;
        EXPECT_EQ(header(posted, "Cache-Status"), "sporeprint; hit") << one.post;
        EXPECT_EQ(header(posted, "Content-Location"), header(got, "Content-Location"));
        EXPECT_NE(header(posted, "Content-Location"), "");
        EXPECT_EQ(header(posted, "Content-Type"), header(got, "Content-Type"));
    }
}

TEST_F(WorldPostsTest, WithEditsThatChangeNothingAreTheResourcesOfGet) {
    const std::string usual = header(placements(""), "ETag");
    EXPECT_EQ(header(placements(R"(,"ecology":{},"founders":[],"masks":{})"), "ETag"), usual);
    // One white pixel of 8 bits.
    const std::string white =
        "iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAAAAAA6fptVAAAACklEQVR4nGP4DwABAQEAsTj2FAAAAABJRU5ErkJggg"
        "==";
    EXPECT_EQ(errors_of(placements(R"(,"masks":{"fungi":")" + white + "\"}")),
              std::vector<std::string>{});
    EXPECT_EQ(header(placements(R"(,"masks":{"fungi":")" + white + "\"}"), "ETag"), usual);
    // What the atlas has.
    const std::shared_ptr<const Atlas> atlas = built_in_atlas();
    const AtlasEntry* const entry = atlas->find("marasmius_oreades");
    EXPECT_EQ(header(placements(R"(,"ecology":{"marasmius_oreades":{"guild":")" +
                                std::string(name(entry->species.ecology.guild)) + "\"}}"),
                     "ETag"),
              usual);
}

TEST_F(WorldPostsTest, WithEditsAreResourcesWithoutAddress) {
    const std::string founder =
        R"(,"founders":[{"species":"marasmius_oreades","x":3,"y":-4,"year":0}])";
    const Response one = placements(founder);
    ASSERT_EQ(one.status, 200) << text_of(one);
    EXPECT_EQ(header(one, "Content-Location"), "");
    EXPECT_NE(header(one, "ETag"), header(placements(""), "ETag"));
    EXPECT_TRUE(json_of(one).find("links")->members().empty());
    EXPECT_EQ(json_of(one).find("world")->as_string().substr(0, 24), "meadow,seed=7,extent=256");
    // Numbers written otherwise, and a member named twice.
    const Response other = placements(
        R"(,"founders":[{"year":0,"x":3.0,"y":-4e0,"species":"marasmius_oreades"},
        {"species":"marasmius_oreades","x":3,"y":-4,"year":-0}])");
    EXPECT_EQ(header(other, "ETag"), header(one, "ETag"));
    EXPECT_EQ(header(other, "Cache-Status"), "sporeprint; hit");
    const Response glb = send("/v1/worlds/plot.glb",
                              '{' + meadow + R"(,"size":2,"texture_size":256)" + founder + '}');
    ASSERT_EQ(glb.status, 200) << text_of(glb);
    EXPECT_TRUE(text_of(glb).starts_with("glTF"));
    const Response map =
        send("/v1/worlds/maps/spores.json", '{' + meadow + R"(,"size":64)" + founder + '}');
    ASSERT_EQ(map.status, 200) << text_of(map);
    EXPECT_TRUE(json_of(map).find("links")->members().empty());
}

TEST_F(WorldPostsTest, NameWhatIsWrongByItsPlaceInTheBody) {
    const std::string target = "/v1/worlds/plot.json";
    EXPECT_TRUE(names(send(target, "[1]"), "", "expected an object"));
    EXPECT_EQ(send(target, "{").status, 400);
    const Response nothing = send(target, "{}");
    EXPECT_EQ(nothing.status, 400);
    EXPECT_TRUE(names(nothing, "/world", "is missing"));
    EXPECT_TRUE(names(nothing, "/time", "is missing"));
    const auto with = [&](const std::string& members) { return send(target, '{' + members + '}'); };
    EXPECT_TRUE(names(with(R"("world":7,"time":"y80d270")"), "/world", "expected text"));
    const Response unknown = with(R"("world":"medow","time":"y80d270")");
    EXPECT_EQ(unknown.status, 404);
    EXPECT_TRUE(names(unknown, "/world", "did you mean 'meadow'"));
    EXPECT_TRUE(names(with(R"("world":"meadow,climate.rain=-1","time":"y80d270")"), "/world",
                      "climate.rain: "));
    EXPECT_TRUE(names(with(R"("world":"meadow","time":"y80d366")"), "/time", "y200d365"));
    EXPECT_TRUE(names(with(R"("world":"meadow","time":"y80")"), "/time", "y80d270"));
    EXPECT_TRUE(names(with(meadow + R"(,"size":33)"), "/size", "32"));
    EXPECT_TRUE(names(with(meadow + R"(,"sise":3)"), "/sise", "size"));
    const Response outside = with(meadow + R"(,"x":125)");
    EXPECT_EQ(outside.status, 422);
    EXPECT_TRUE(names(outside, "/x", "outside the world"));
    EXPECT_TRUE(names(with(meadow + R"(,"layers":"moss")"), "/layers", "ground"));
    EXPECT_TRUE(names(send(target + "?size=3", '{' + meadow + '}'), "size", "takes none"));
    const Response map = send("/v1/worlds/maps/hight.png", '{' + meadow + '}');
    EXPECT_EQ(map.status, 404);
    EXPECT_TRUE(names(map, "map", "height"));
    EXPECT_TRUE(names(send("/v1/worlds/placements.csv", '{' + meadow + R"(,"bbox":"0,0"})"),
                      "/bbox", "four numbers"));
}

TEST_F(WorldPostsTest, TakeTheTokenOfToday) {
    const std::string token = json_of(ask("/v1/worlds/meadow.json")).find("v")->as_string();
    EXPECT_EQ(placements(R"(,"v":")" + token + '"').status, 200);
    const Response old = placements(R"(,"v":"1-00000000")");
    EXPECT_EQ(old.status, 410);
    EXPECT_TRUE(names(old, "/v", token));
    EXPECT_EQ(
        send("/v1/worlds/plot.json", R"({"world":"meadow,v=1-00000000","time":"y80d270"})").status,
        410);
}

TEST_F(WorldPostsTest, AreNotFoundByGet) {
    for (const char* path : {"/v1/worlds/plot.json", "/v1/worlds/placements.json"}) {
        const Response response = ask(path);
        EXPECT_EQ(response.status, 405) << path;
        EXPECT_EQ(header(response, "Allow"), "POST, OPTIONS") << path;
    }
    EXPECT_EQ(test::most_body(service_, "POST", "/v1/worlds/plot.glb"), most_part_body);
}

}  // namespace
}  // namespace sporeprint::api::products_world_part_request_test
