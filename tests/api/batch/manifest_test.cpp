#include "api/batch/manifest.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "core/params/types.h"
#include "core/problems.h"

namespace sporeprint::api::manifest_test {
namespace {

std::vector<std::string> targets_of(const BatchManifest& manifest) {
    std::vector<std::string> out;
    for (std::uint64_t i = 0; i < manifest.count(); ++i) out.push_back(manifest.item(i).target);
    return out;
}

double number_in(const BatchItem& item, std::string_view name) {
    for (const auto& [key, value] : item.drawn)
        if (key == name) return value.as_number();
    ADD_FAILURE() << name << " was not drawn";
    return 0.0;
}

/// Returns the paths of the problems of a text; empty if it is accepted.
std::vector<std::string> problems_of(const std::string& text) {
    try {
        const BatchManifest manifest(text);
        return {};
    } catch (const InvalidInput& invalid) {
        std::vector<std::string> paths;
        for (const Problem& problem : invalid.problems()) {
            EXPECT_FALSE(problem.message.empty());
            paths.push_back(problem.path);
        }
        return paths;
    }
}

TEST(BatchManifest, IsAListOfAddresses) {
    const std::string text =
        "# first\n/v1/trees/birch.glb?lod=3\r\n\n  /v1/leaves/oak.glb  \n# last\n";
    const BatchManifest manifest(text);
    EXPECT_EQ(targets_of(manifest),
              (std::vector<std::string>{"/v1/trees/birch.glb?lod=3", "/v1/leaves/oak.glb"}));
    EXPECT_TRUE(manifest.item(0).drawn.empty());
    EXPECT_EQ(manifest.per_shard(), 1000U);
    EXPECT_EQ(manifest.shards(), 1U);
    EXPECT_EQ(manifest.digest(), sha256_hex(text.data(), text.size()));
    EXPECT_EQ(problems_of("/a.glb\nhttp://host/b.glb\n"), std::vector<std::string>{"line 2"});
    EXPECT_EQ(problems_of("# nothing\n"), std::vector<std::string>{""});
}

TEST(BatchManifest, MakesEveryCombinationInTurn) {
    const BatchManifest manifest(
        R"({"path":"/v1/mushrooms/{mix}.glb","each":{"mix":["a","b"],"lod":[0,1,2]},
            "number":{"seed":7},"fixed":{"textures":"none"},"count":8})");
    EXPECT_EQ(targets_of(manifest),
              (std::vector<std::string>{"/v1/mushrooms/a.glb?lod=0&seed=7&textures=none",
                                        "/v1/mushrooms/a.glb?lod=1&seed=7&textures=none",
                                        "/v1/mushrooms/a.glb?lod=2&seed=7&textures=none",
                                        "/v1/mushrooms/b.glb?lod=0&seed=7&textures=none",
                                        "/v1/mushrooms/b.glb?lod=1&seed=7&textures=none",
                                        "/v1/mushrooms/b.glb?lod=2&seed=7&textures=none",
                                        "/v1/mushrooms/a.glb?lod=0&seed=8&textures=none",
                                        "/v1/mushrooms/a.glb?lod=1&seed=8&textures=none"}));
    EXPECT_EQ(BatchManifest(R"({"path":"/{a}","each":{"a":[1,2],"b":["x","y","z"]}})").count(), 6U);
}

TEST(BatchManifest, EscapesValuesAndFillsNamesInPaths) {
    const BatchManifest manifest(
        R"({"path":"/v1/{world}/y{year}d{day}/{year}.png","count":1,
            "fixed":{"world":"beech,seed=7","year":80,"day":12.5,"name":"ä &/?%{x}","flag":true}})");
    EXPECT_EQ(manifest.item(0).target,
              "/v1/beech,seed=7/y80d12.5/80.png?name=%C3%A4%20%26%2F%3F%25%7Bx%7D&flag=true");
    EXPECT_EQ(escaped_in_address("a~b-c_d.e:f@g,h=i+j#"), "a~b-c_d.e:f@g,h=i%2Bj%23");
}

TEST(BatchManifest, DrawsByTheNumberOfTheItemAndTheNameAlone) {
    const BatchManifest few(R"({"path":"/x","count":300,"seed":5,"uniform":{"age":[0.1,1]}})"),
        many(R"({"path":"/x","count":900,"seed":5,"choice":{"b":[1,2,3]},
                 "uniform":{"z":[0,9],"age":[0.1,1]},"integer":{"day":[1,365]},"per_shard":7})"),
        other(R"({"path":"/x","count":300,"seed":6,"uniform":{"age":[0.1,1]}})");
    std::size_t equal = 0;
    for (std::uint64_t i = 0; i < 300; ++i) {
        EXPECT_EQ(number_in(few.item(i), "age"), number_in(many.item(i), "age"));
        equal += number_in(few.item(i), "age") == number_in(other.item(i), "age") ? 1 : 0;
    }
    EXPECT_LT(equal, 5U);
    // An item far away is as quick to make, and its draws are its own.
    const BatchManifest endless(
        R"({"path":"/x","count":10000000000,"seed":5,"uniform":{"age":[0.1,1]}})");
    EXPECT_EQ(number_in(endless.item(7), "age"), number_in(few.item(7), "age"));
    EXPECT_NE(number_in(endless.item((std::uint64_t{1} << 32U) + 7), "age"),
              number_in(few.item(7), "age"));
}

TEST(BatchManifest, DrawsOnceForAllCombinationsOfARound) {
    const BatchManifest manifest(
        R"({"path":"/x","count":300,"each":{"lod":[0,1,2]},"number":{"seed":7},
            "uniform":{"age":[0,1]},"integer":{"k":[1,1000]},"choice":{"c":["a","b"]},"draws":"round"})");
    std::set<std::string> ages;
    for (std::uint64_t i = 0; i < manifest.count(); i += 3) {
        const std::string first = manifest.item(i).target;
        for (std::uint64_t k = 1; k < 3; ++k) {
            std::string same = manifest.item(i + k).target;
            same.replace(same.find("lod=") + 4, 1, "0");
            EXPECT_EQ(same, first);
        }
        ages.insert(first.substr(first.find("age=")));
    }
    EXPECT_EQ(ages.size(), 100U) << "Rounds draw anew.";
}

TEST(BatchManifest, DrawsEvenlyWithinWhatIsAllowed) {
    const BatchManifest manifest(
        R"({"path":"/x","count":20000,"uniform":{"u":[-2,6]},"integer":{"i":[-1,2],"one":[9,9]},
            "choice":{"c":["p","q","r"]}})");
    double sum = 0.0, squares = 0.0;
    std::map<double, int> integers;
    std::map<std::string, int> choices;
    for (std::uint64_t i = 0; i < manifest.count(); ++i) {
        const BatchItem item = manifest.item(i);
        const double u = number_in(item, "u");
        EXPECT_GE(u, -2.0);
        EXPECT_LE(u, 6.0);
        sum += u;
        squares += u * u;
        ++integers[number_in(item, "i")];
        EXPECT_EQ(number_in(item, "one"), 9.0);
        for (const auto& [key, value] : item.drawn)
            if (key == "c") ++choices[value.as_string()];
    }
    const double n = 20000.0, mean = sum / n;
    EXPECT_NEAR(mean, 2.0, 0.08);
    EXPECT_NEAR(squares / n - mean * mean, 64.0 / 12.0, 0.15);
    ASSERT_EQ(integers.size(), 4U);
    for (const auto& [value, count] : integers) EXPECT_NEAR(count, n / 4.0, 250.0) << value;
    ASSERT_EQ(choices.size(), 3U);
    for (const auto& [value, count] : choices) EXPECT_NEAR(count, n / 3.0, 280.0) << value;
}

TEST(BatchManifest, HasDrawsOfSixDigits) {
    const BatchManifest manifest(R"({"path":"/x","count":500,"uniform":{"u":[0,1]}})");
    for (std::uint64_t i = 0; i < manifest.count(); ++i) {
        const std::string target = manifest.item(i).target;
        EXPECT_LE(target.size(), std::string("/x?u=0.00123456").size() + 4) << target;
    }
}

TEST(BatchManifest, SharesItsItemsAmongShards) {
    for (const std::uint64_t per : {1U, 3U, 10U, 11U}) {
        const BatchManifest manifest(R"({"path":"/x","count":10,"number":{"seed":1},"per_shard":)" +
                                     std::to_string(per) + "}");
        EXPECT_EQ(manifest.shards(), (10 + per - 1) / per);
    }
    EXPECT_TRUE(BatchManifest(R"({"path":"/x","count":1})").has_labels());
    EXPECT_FALSE(BatchManifest(R"({"path":"/x","count":1,"labels":false})").has_labels());
    EXPECT_EQ(BatchManifest(R"({"path":"/x","count":1,"generator":37})").generator(), "37");
}

TEST(BatchManifest, NamesWhatIsWrong) {
    const std::vector<std::pair<std::string, std::vector<std::string>>> wrong = {
        {"{}", {"/path", "/count"}},
        {R"({"path":"x","count":1})", {"/path", "/path"}},
        {R"({"path":"/x","count":0})", {"/count"}},
        {R"({"path":"/x","count":1.5})", {"/count"}},
        {R"({"path":"/x","count":1e11})", {"/count"}},
        {R"({"path":"/x","count":"9"})", {"/count"}},
        {R"({"path":"/x","count":1,"seed":-1})", {"/seed"}},
        {R"({"path":"/x","count":1,"seed":4294967296})", {"/seed"}},
        {R"({"path":"/x","count":1,"per_shard":0})", {"/per_shard"}},
        {R"({"path":"/x","count":1,"labels":1})", {"/labels"}},
        {R"({"path":"/x","count":1,"generator":{}})", {"/generator"}},
        {R"({"path":"/x","count":1,"draws":"seed"})", {"/draws"}},
        {R"({"path":"/x","count":1,"colour":1})", {"/colour"}},
        {R"({"path":"/x{","count":1})", {"/path"}},
        {R"({"path":"/x{}","count":1})", {"/path"}},
        {R"({"path":"/x}a{","count":1})", {"/path"}},
        {R"({"path":"/{a}","count":1})", {"/path"}},
        {R"({"path":"/x","count":1,"fixed":[]})", {"/fixed"}},
        {R"({"path":"/x","count":1,"fixed":{"a":[1]}})", {"/fixed/a"}},
        {R"({"path":"/x","count":1,"fixed":{"a":1},"choice":{"a":[1]}})", {"/choice/a"}},
        {R"({"path":"/x","count":1,"fixed":{"":1}})", {"/fixed/"}},
        {R"({"path":"/x","count":1,"each":{"a":[]}})", {"/each/a"}},
        {R"({"path":"/x","count":1,"choice":{"a":[null]}})", {"/choice/a"}},
        {R"({"path":"/x","count":1,"uniform":{"a":[2,1]}})", {"/uniform/a"}},
        {R"({"path":"/x","count":1,"uniform":{"a":[1,2,3]}})", {"/uniform/a"}},
        {R"({"path":"/x","count":1,"integer":{"a":[0.5,2]}})", {"/integer/a"}},
        {R"({"path":"/x","count":1,"integer":{"a":[0,9e15]}})", {"/integer/a"}},
        {R"({"path":"/x","count":1,"number":{"a":0.5}})", {"/number/a"}},
        {R"({"path":"/x","count":1,)", {""}},
    };
    for (const auto& [text, paths] : wrong) EXPECT_EQ(problems_of(text), paths) << text;
    try {
        const BatchManifest manifest(R"({"path":"/x","count":1,"uniform":{"age":[1,0.1]}})");
        FAIL() << "A range is in its order.";
    } catch (const InvalidInput& invalid) {
        EXPECT_EQ(invalid.problems()[0].message,
                  "[1,0.1] is not allowed; allowed is [from, to], two numbers in their order");
    }
    std::string lists = R"({"path":"/x","each":{)";
    for (int i = 0; i < 40; ++i)
        lists += (i > 0 ? ",\"n" : "\"n") + std::to_string(i) + "\":[1,2,3,4]";
    EXPECT_FALSE(problems_of(lists + "}}").empty()) << "More combinations than there are numbers.";
}

}  // namespace
}  // namespace sporeprint::api::manifest_test
