#include "core/params/reader.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <string>
#include <vector>

#include "tests/core/params/arbitrary.h"
#include "tests/core/params/sample.h"

namespace sporeprint::params_reader_test {
namespace {

using sample::Request;

Request accepted(std::string_view text) {
    std::vector<Problem> problems;
    Request request = read_json<Request>(text, problems);
    for (const Problem& problem : problems)
        ADD_FAILURE() << problem.path << ": " << problem.message;
    return request;
}

std::vector<Problem> problems_of(std::string_view text) {
    std::vector<Problem> problems;
    read_json<Request>(text, problems);
    return problems;
}

/// Expects that `text` has exactly this problem.
void expect_problem(std::string_view text, const std::string& path, const std::string& message) {
    const std::vector<Problem> problems = problems_of(text);
    ASSERT_EQ(problems.size(), 1u) << text;
    EXPECT_EQ(problems[0].path, path) << text;
    EXPECT_EQ(problems[0].message, message) << text;
}

TEST(Reader, AbsentKeepsTheDefault) { EXPECT_EQ(accepted("{}"), Request{}); }

TEST(Reader, ReadsEveryKind) {
    const Request request = accepted(R"({
        "seed": 4294967295, "age": 1e-1, "has_ring": true, "animation": "growth",
        "texture_size": 256, "rough": 0.1, "cap": {"radius": 0.05, "gill_count": 7.0, "colour": "#ffffff"},
        "r": 0.75, "deformation": {"low": {"bend_deg": 30}, "taper": -1}, "tint": "#010203",
        "season": [9, 10], "spare": {"radius": 0.1}, "v": "7-3fa91c02",
        "model": {"form": "branched", "forks": 4, "gloss": 1}, "roots": {"form": "branched"},
        "ground": {}, "span": [0, 1], "wind": [1, 2, 3], "profile": [], "tags": ["a", "é"],
        "image": "Zm9vYmFy"})");
    EXPECT_EQ(request.seed, 4294967295u);
    EXPECT_EQ(request.age, 0.1);
    EXPECT_TRUE(request.has_ring);
    EXPECT_EQ(request.animation, sample::Animation::growth);
    EXPECT_EQ(request.texture_size, 256);
    EXPECT_EQ(request.rough, 0.1f);
    EXPECT_EQ(request.cap.gill_count, 7);
    EXPECT_EQ(request.cap.tilt_deg, 4.0);
    EXPECT_EQ(request.origin.r, 0.75);
    EXPECT_EQ(request.deformation.low.bend_deg, 30.0);
    EXPECT_FALSE(request.deformation.high.bend_deg);
    EXPECT_EQ(request.tint, (Colour{1, 2, 3}));
    EXPECT_EQ(request.season, (Range{9, 10}));
    EXPECT_EQ(request.spare->radius, 0.1);
    EXPECT_EQ(request.v.view(), "7-3fa91c02");
    EXPECT_EQ(std::get<sample::Branched>(request.model.shape).forks, 4u);
    EXPECT_EQ(request.model.gloss, 1.0);
    EXPECT_EQ(request.roots.index(), 1u);
    EXPECT_TRUE(request.profile.empty());
    EXPECT_EQ(request.tags[1].view(), "é");
    EXPECT_EQ(request.image.bytes.size(), 6u);
}

TEST(Reader, ReadsOverExistingValues) {
    Request request;
    request.age = 0.25;
    request.model.shape = sample::Branched{.forks = 7};
    std::vector<Problem> problems;
    read(Value::object().set("model", Value::object().set("gloss", 0.75)), request,
         Info{.name = ""}, "", problems);
    EXPECT_TRUE(problems.empty());
    EXPECT_EQ(request.age, 0.25);
    EXPECT_EQ(std::get<sample::Branched>(request.model.shape).forks, 7u);
    EXPECT_EQ(request.model.gloss, 0.75);
}

TEST(Reader, ReportsEachErrorWithItsPointer) {
    expect_problem("[]", "", "expected an object, got a list");
    expect_problem(R"({"age":1.7})", "/age", "1.7 is outside 0..1");
    expect_problem(R"({"age":"old"})", "/age", "expected a number, got 'old'");
    expect_problem(R"({"age":null})", "/age", "expected a number, got null");
    expect_problem(R"({"age":true})", "/age", "expected a number, got true");
    expect_problem(R"({"sed":1})", "/sed", "unknown parameter; did you mean 'seed'?");
    expect_problem(R"({"ab/cd":1})", "/ab~1cd", "unknown parameter");
    expect_problem(R"({"seed":2.5})", "/seed", "expected a whole number, got 2.5");
    expect_problem(R"({"seed":-1})", "/seed", "-1 is outside 0..4294967295");
    expect_problem(R"({"seed":1e300})", "/seed", "1e300 is outside 0..4294967295");
    expect_problem(R"({"rough":1e300})", "/rough", "1e300 is outside 0.1..0.3");
    expect_problem(R"({"rough":0.31})", "/rough", "0.31 is outside 0.1..0.3");
    expect_problem(R"({"has_ring":1})", "/has_ring", "expected true or false, got 1");
    expect_problem(R"({"animation":"fast"})", "/animation", "'fast' is not one of none, growth");
    expect_problem(R"({"animation":1})", "/animation", "1 is not one of none, growth");
    expect_problem(R"({"texture_size":300})", "/texture_size",
                   "300 is not one of 128, 256, 512, 1024");
    expect_problem(R"({"cap":7})", "/cap", "expected an object, got 7");
    expect_problem(R"({"cap":{"gill":1}})", "/cap/gill", "unknown parameter");
    expect_problem(R"({"cap":{"colour":"red"}})", "/cap/colour",
                   "expected a colour like #D22B1F, got 'red'");
    expect_problem(R"({"r":2})", "/r", "2 is outside 0..1");
    expect_problem(R"({"tint":null})", "/tint",
                   "null is not a value; leave the parameter out for the species' own");
    expect_problem(R"({"deformation":{"low":{"bend_deg":100}}})", "/deformation/low/bend_deg",
                   "100 is outside 0..90");
    expect_problem(R"({"season":[10,9]})", "/season",
                   "a range begins with its smaller end, got [10, 9]");
    expect_problem(R"({"season":[0,9]})", "/season/0", "0 is outside 1..12");
    expect_problem(R"({"span":[0.1]})", "/span", "expected a range [from, to], got a list");
    expect_problem(R"({"wind":[0,1]})", "/wind", "expected a list of 3 numbers, got a list");
    expect_problem(R"({"wind":[0,1,"x"]})", "/wind/2", "expected a number, got 'x'");
    expect_problem(R"({"profile":[1,9]})", "/profile/1", "9 is outside 0.1..4");
    expect_problem(R"({"profile":[1,1,1,1,1,1,1,1,1,1,1,1,1,1,1,1,1]})", "/profile",
                   "a list of 17 items; at most 16 are allowed");
    expect_problem(R"({"v":"0123456789abc"})", "/v", "'0123456789abc' is longer than 12 bytes");
    expect_problem(R"({"v":"a\u0000"})", "/v", "'a?' holds control characters or is not UTF-8");
    expect_problem(R"({"v":1})", "/v", "expected text, got 1");
    expect_problem(R"({"image":"Zg="})", "/image",
                   "this is not base64 (RFC 4648, padded, no white space)");
    expect_problem(R"({"image":")" + base64_text(std::vector<std::uint8_t>(1001)) + "\"}", "/image",
                   "1001 bytes; at most 1000 are allowed");
    expect_problem(R"({"image":")" + std::string(4000, 'A') + "\"}", "/image",
                   "more than 1000 bytes; at most 1000 are allowed");
    expect_problem(R"({"model":{"form":"bare","anything":1}})", "/model/form",
                   "'bare' is not one of swept, branched");
    expect_problem(R"({"model":{"form":"branched","outline":[]}})", "/model/outline",
                   "unknown parameter");
    expect_problem(R"({"model":{"outline":[{},{"r":-1}]}})", "/model/outline/1/r",
                   "-1 is outside 0..1");
    expect_problem(R"({"ground":{"form":3}})", "/ground/form", "3 is not one of bare");
    expect_problem(R"({"stem_radius":0.1})", "/stem_radius", "must be smaller than /cap/radius");
    expect_problem(R"({"age":0.5,"age":0.5})", "/age", "given more than once");
}

TEST(Reader, ReportsAllErrorsAtOnce) {
    const std::vector<Problem> problems =
        problems_of(R"({"zz":1,"age":7,"cap":{"radius":"x","colour":1},"wind":{},"yy":2})");
    ASSERT_EQ(problems.size(), 6u);
    EXPECT_EQ(problems[0].path, "/age");
    EXPECT_EQ(problems[5].path, "/yy");
}

TEST(Reader, HostileTextIsRefusedWithBoundedProblems) {
    std::string many = "{\"a\":0";
    for (int i = 0; i < 50'000; ++i) many += ",\"sed" + std::to_string(i) + "\":0";
    EXPECT_EQ(problems_of(many + "}").size(), most_problems);
    EXPECT_EQ(problems_of(std::string(100'000, '[')).size(), 1u);
    const std::vector<Problem> long_key = problems_of("{\"" + std::string(100'000, 'k') + "\":1}");
    ASSERT_EQ(long_key.size(), 1u);
    EXPECT_LT(long_key[0].path.size() + long_key[0].message.size(), 300u);
}

TEST(Reader, WrittenValuesReadBackEqual) {
    EXPECT_TRUE(rc::check([] {
        Request request = arbitrary_of<Request>();
        request.cap.radius = 0.5;  // the cross-field rule
        const std::string text = dump(write(request));
        std::vector<Problem> problems;
        const Request back = read_json<Request>(text, problems);
        for (const Problem& problem : problems) RC_FAIL(problem.path + ": " + problem.message);
        RC_ASSERT(back == request);
        RC_ASSERT(dump(write(back)) == text);
    }));
}

TEST(Reader, WritesAllValuesInOrderWithoutEmptyOnes) {
    const Value json = write(Request{});
    EXPECT_EQ(json.members().front().first, "seed");
    EXPECT_EQ(json.find("tint"), nullptr);
    EXPECT_EQ(json.find("image"), nullptr);
    EXPECT_EQ(
        dump(*json.find("model")),
        R"({"form":"swept","outline":[{"r":0.1,"y":0},{"r":0.2,"y":0.5}],"twist":0,"gloss":0.5})");
    EXPECT_EQ(dump(*json.find("rough")), "0.3");
    EXPECT_EQ(dump(*json.find("span")), "[0.25,0.5]");
    EXPECT_EQ(dump(*json.find("deformation")), R"({"low":{},"high":{}})");
}

}  // namespace
}  // namespace sporeprint::params_reader_test
