// One mushroom has one URL: however a mix is written, the response is one resource, generated once.
#include <gtest/gtest.h>

#include <cstdint>
#include <string>
#include <vector>

#include "tests/api/support.h"

namespace sporeprint::api::products_mix_resources_test {
namespace {

using test::get;
using test::header;
using test::post;
using test::text_of;

std::string species(std::size_t number) { return test::swept_species(*built_in_atlas())[number]; }

class MixResources : public testing::Test {
  protected:
    Response ask(const std::string& mix) {
        return handle(service_, get("/v1/mushrooms/" + mix + ".glb?lod=3&texture_size=128&seed=5"));
    }

    /// Requests all of `words` and expects one response, generated once.
    void expect_one_resource(const std::vector<std::string>& words, const std::string& canonical) {
        const std::uint64_t before = service_.counters().generated;
        const Response first = ask(words.front());
        ASSERT_EQ(first.status, 200) << text_of(first);
        EXPECT_TRUE(header(first, "Content-Location")
                        .starts_with("/v1/mushrooms/" + canonical + ".glb?seed=5&"))
            << header(first, "Content-Location");
        for (const std::string& mix : words) {
            SCOPED_TRACE(mix);
            const Response response = ask(mix);
            ASSERT_EQ(response.status, 200) << text_of(response);
            EXPECT_EQ(header(response, "ETag"), header(first, "ETag"));
            EXPECT_EQ(header(response, "Content-Location"), header(first, "Content-Location"));
            EXPECT_EQ(header(response, "Cache-Status"), "sporeprint; hit");
            EXPECT_EQ(text_of(response), text_of(first));
            const Response unchanged =
                handle(service_, get("/v1/mushrooms/" + mix + ".glb?lod=3&texture_size=128&seed=5",
                                     {{"If-None-Match", header(first, "ETag")}}));
            EXPECT_EQ(unchanged.status, 304);
        }
        EXPECT_EQ(service_.counters().generated, before + 1);
    }

    Service service_{built_in_atlas(), ServiceOptions{}};
};

TEST_F(MixResources, ALoneSpeciesIsItselfWhateverItsWeight) {
    const std::string a = species(0), b = species(1);
    expect_one_resource({a, a + ":5", a + ":0.001", a + ":9999," + b + ":1",
                         b + ":0.0004," + a + ":0.9996", a + ":1e300," + b + ":1"},
                        a);
    const Response posted =
        handle(service_, post("{\"mix\":{\"" + a + "\":9999,\"" + b +
                              "\":1},\"lod\":3,\"texture_size\":128,\"seed\":5}"));
    EXPECT_EQ(header(posted, "ETag"), header(ask(a), "ETag"));
    EXPECT_EQ(service_.counters().generated, 1u);
}

TEST_F(MixResources, AMixIsItselfInAnyOrderAndAtAnyScale) {
    const std::string a = species(0), b = species(1), c = species(2);
    expect_one_resource({a + ":0.5," + b + ":0.5", b + ":1," + a + ":1", a + ":500," + b + ":500"},
                        a + ":0.5," + b + ":0.5");
    expect_one_resource({a + ":0.2," + b + ":0.3," + c + ":0.5", c + ":5," + a + ":2," + b + ":3",
                         b + ":0.6," + c + ":1," + a + ":0.4"},
                        a + ":0.2," + b + ":0.3," + c + ":0.5");
}

}  // namespace
}  // namespace sporeprint::api::products_mix_resources_test
