#include "core/params/query.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <string>
#include <utility>
#include <vector>

#include "tests/core/params/arbitrary.h"
#include "tests/core/params/sample.h"

namespace sporeprint::params_query_test {
namespace {

using sample::Request;
using Pairs = std::vector<std::pair<std::string, std::string>>;

std::vector<Problem> problems_of(const Pairs& pairs) {
    Request request;
    std::vector<Problem> problems;
    read_query(pairs, request, problems);
    return problems;
}

void expect_problem(const Pairs& pairs, const std::string& path, const std::string& message) {
    const std::vector<Problem> problems = problems_of(pairs);
    ASSERT_EQ(problems.size(), 1u) << pairs[0].first << '=' << pairs[0].second;
    EXPECT_EQ(problems[0].path, path);
    EXPECT_EQ(problems[0].message, message);
}

/// Returns the decoded pairs of a query text.
Pairs split(std::string_view text) {
    Pairs pairs;
    const auto decoded = [](std::string_view coded) {
        std::string plain;
        for (std::size_t i = 0; i < coded.size(); ++i) {
            if (coded[i] == '%') {
                plain +=
                    static_cast<char>(std::stoi(std::string(coded.substr(i + 1, 2)), nullptr, 16));
                i += 2;
            } else {
                plain += coded[i];
            }
        }
        return plain;
    };
    while (!text.empty()) {
        const std::string_view pair = text.substr(0, text.find('&'));
        const std::size_t equals = pair.find('=');
        pairs.emplace_back(decoded(pair.substr(0, equals)), decoded(pair.substr(equals + 1)));
        text.remove_prefix(std::min(pair.size() + 1, text.size()));
    }
    return pairs;
}

TEST(Query, ReadsDottedNamesOfEveryLeaf) {
    const Pairs pairs = {{"seed", "7"},
                         {"age", "2.5e-1"},
                         {"has_ring", "true"},
                         {"animation", "growth"},
                         {"texture_size", "512"},
                         {"rough", "0.3"},
                         {"cap.radius", "0.05"},
                         {"cap.colour", "#ffFFff"},
                         {"y", "-1"},
                         {"deformation.high.bend_deg", "45"},
                         {"deformation.low.mode", "growth"},
                         {"tint", "#000000"},
                         {"spare.radius", "0.25"},
                         {"v", "7-3fa91c02"},
                         {"model.form", "branched"},
                         {"model.forks", "5"},
                         {"roots.forks", "9"},
                         {"roots.form", "branched"}};
    Request request;
    std::vector<Problem> problems;
    read_query(pairs, request, problems);
    for (const Problem& problem : problems)
        ADD_FAILURE() << problem.path << ": " << problem.message;
    EXPECT_EQ(request.seed, 7u);
    EXPECT_EQ(request.age, 0.25);
    EXPECT_TRUE(request.has_ring);
    EXPECT_EQ(request.texture_size, 512);
    EXPECT_EQ(request.rough, 0.3f);
    EXPECT_EQ(request.cap.radius, 0.05);
    EXPECT_EQ(request.origin.y, -1.0);
    EXPECT_EQ(request.deformation.high.bend_deg, 45.0);
    EXPECT_EQ(request.deformation.low.mode, sample::Animation::growth);
    EXPECT_EQ(request.tint, (Colour{0, 0, 0}));
    EXPECT_EQ(request.spare->radius, 0.25);
    EXPECT_EQ(std::get<sample::Branched>(request.model.shape).forks, 5u);
    EXPECT_EQ(std::get<sample::Branched>(request.roots).forks, 9u) << "in any order";
}

TEST(Query, ReportsEachErrorWithItsName) {
    expect_problem({{"age", "1.7"}}, "age", "1.7 is outside 0..1");
    expect_problem({{"sed", "1"}}, "sed", "unknown parameter; did you mean 'seed'?");
    expect_problem({{"cap.radus", "1"}}, "cap.radus",
                   "unknown parameter; did you mean 'cap.radius'?");
    expect_problem({{"cap", "1"}}, "cap", "unknown parameter");
    expect_problem({{"age", "0.5"}, {"age", "0.5"}}, "age", "given more than once");
    expect_problem({{"zzz", "1"}, {"zzz", "2"}}, "zzz", "unknown parameter");
    for (const char* bad : {"+1", ".5", "1.", "0x1", "inf", "nan", " 1", "1 ", "", "1e999", "one"})
        expect_problem({{"age", bad}}, "age", "expected a number, got '" + std::string(bad) + "'");
    expect_problem({{"seed", "x"}}, "seed", "expected a whole number, got 'x'");
    expect_problem({{"seed", "2.5"}}, "seed", "expected a whole number, got 2.5");
    expect_problem({{"seed", "4294967296"}}, "seed", "4294967296 is outside 0..4294967295");
    for (const char* bad : {"1", "True", "yes", ""})
        expect_problem({{"has_ring", bad}}, "has_ring",
                       "expected true or false, got '" + std::string(bad) + "'");
    expect_problem({{"animation", "fast"}}, "animation", "'fast' is not one of none, growth");
    expect_problem({{"texture_size", "300"}}, "texture_size",
                   "300 is not one of 128, 256, 512, 1024");
    expect_problem({{"model.form", "bare"}}, "model.form", "'bare' is not one of swept, branched");
    expect_problem({{"model.forks", "5"}}, "model.forks",
                   "unknown parameter; did you mean 'model.form'?");
    expect_problem({{"deformation.taper", "2"}}, "deformation.taper", "2 is outside -1..1");
    expect_problem({{"stem_radius", "0.1"}}, "stem_radius", "must be smaller than /cap/radius");
    expect_problem({{"a\nb\xff", "1"}}, "a?b?", "unknown parameter");
}

TEST(Query, ListsRangesAndUploadsHaveNoNames) {
    for (const char* name :
         {"profile", "profile.0", "tags", "wind", "span", "season", "image", "model.outline"})
        EXPECT_EQ(problems_of({{name, "1"}}).size(), 1u) << name;
}

TEST(Query, ReportsAllErrorsAtOnceUpToALimit) {
    EXPECT_EQ(problems_of({{"age", "2"}, {"sed", "1"}, {"has_ring", "x"}}).size(), 3u);
    Pairs many;
    for (int i = 0; i < 1000; ++i) many.emplace_back("x" + std::to_string(i), "1");
    EXPECT_EQ(problems_of(many).size(), most_problems);
}

TEST(Query, TextContainsOnlyDifferences) {
    EXPECT_EQ(query_text(Request{}), "");
    Request request;
    request.seed = 7;
    request.cap.radius = 0.05;
    request.cap.colour = {255, 0, 170};
    request.deformation.low.bend_deg = 0.0;
    request.model.shape = sample::Branched{};
    request.rough = 0.1f;
    EXPECT_EQ(query_text(request),
              "seed=7&rough=0.1&cap.radius=0.05&cap.colour=%23FF00AA&deformation.low.bend_deg=0"
              "&model.form=branched");
    EXPECT_EQ(query_text(request, request), "");
}

TEST(Query, TextReadsBackEqual) {
    EXPECT_TRUE(rc::check([] {
        Request request = arbitrary_of<Request>();
        request.cap.radius = 0.5;  // the cross-field rule
        const Request standard;    // for what a query cannot express
        request.season = standard.season;
        request.span = standard.span;
        request.wind = standard.wind;
        request.profile = standard.profile;
        request.tags = standard.tags;
        request.image = standard.image;
        if (auto* swept = std::get_if<sample::Swept>(&request.model.shape))
            swept->outline = sample::Swept{}.outline;
        if (request.spare == sample::Cap{}) request.spare.reset();
        const std::string text = query_text(request);
        Request back;
        std::vector<Problem> problems;
        read_query(split(text), back, problems);
        for (const Problem& problem : problems) RC_FAIL(problem.path + ": " + problem.message);
        RC_ASSERT(back == request);
        RC_ASSERT(query_text(back) == text);
    }));
}

TEST(Query, ArbitraryPairsAreHandled) {
    EXPECT_TRUE(rc::check([](const std::vector<std::pair<std::string, std::string>>& pairs) {
        std::vector<Problem> problems;
        Request request;
        read_query(pairs, request, problems);
        RC_ASSERT(problems.size() <= most_problems);
        RC_ASSERT(problems_in(request).empty());
    }));
}

}  // namespace
}  // namespace sporeprint::params_query_test
