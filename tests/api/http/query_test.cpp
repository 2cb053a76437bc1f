#include "api/http/query.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "core/params/messages.h"

namespace sporeprint::api::http_query_test {
namespace {

using Pairs = std::vector<std::pair<std::string, std::string>>;

Target split_well(std::string_view target) {
    std::vector<Problem> problems;
    Target out = split_target(target, problems);
    EXPECT_TRUE(problems.empty()) << target << ": "
                                  << (problems.empty() ? "" : problems[0].message);
    return out;
}

TEST(Target, IsSplitBeforeItIsDecoded) {
    const Target target = split_well("/v1/a%2Fb/c?x=1%262&y=%3D");
    EXPECT_EQ(target.segments, (std::vector<std::string>{"v1", "a/b", "c"}));
    EXPECT_EQ(target.query, (Pairs{{"x", "1&2"}, {"y", "="}}));
}

TEST(Target, KeepsAPlusSign) { EXPECT_EQ(split_well("/?a=1+2").query[0].second, "1+2"); }

TEST(Target, OfTheRootHasOneEmptySegment) {
    EXPECT_EQ(split_well("/").segments, std::vector<std::string>{""});
    EXPECT_TRUE(split_well("/?").query.empty());
}

TEST(Target, InAbsoluteFormIsTaken) {
    EXPECT_EQ(split_well("http://example.org:80/v1?a=b").segments, std::vector<std::string>{"v1"});
    EXPECT_EQ(split_well("http://example.org").segments, std::vector<std::string>{""});
}

TEST(Target, AnEmptyValueIsAValue) { EXPECT_EQ(split_well("/?a=").query, (Pairs{{"a", ""}})); }

TEST(Target, AllErrorsAreNamed) {
    const std::pair<const char*, const char*> cases[] = {
        {"/a%2", "path"},     {"/a%GG", "path"},    {"/a%00", "path"}, {"/a%FF", "path"},
        {"/?a=%", "a"},       {"/?%zz=1", "query"}, {"/?a", "a"},      {"/?a=1&&b=2", "query"},
        {"/?a=1&", "query"},  {"/?&a=1", "query"},  {"/?a=%0A", "a"},  {"/?a=%C3", "a"},
        {"relative", "path"}, {"", "path"},
    };
    for (const auto& [target, where] : cases) {
        std::vector<Problem> problems;
        static_cast<void>(split_target(target, problems));
        ASSERT_EQ(problems.size(), 1u) << target;
        EXPECT_EQ(problems[0].path, where) << target;
        EXPECT_FALSE(problems[0].message.empty());
    }
    std::vector<Problem> problems;
    static_cast<void>(split_target("/?a&b=%&&c=1", problems));
    EXPECT_EQ(problems.size(), 3u);
}

RC_GTEST_PROP(TargetProperty, DecodingUndoesEncoding, (const std::string& text)) {
    std::string decoded;
    RC_ASSERT(percent_decode(percent_encoded(text), decoded));
    RC_ASSERT(decoded == text);
}

RC_GTEST_PROP(TargetProperty, AnyBytesAreTakenWithoutHarm, (const std::string& bytes)) {
    std::vector<Problem> problems;
    static_cast<void>(split_target(bytes, problems));
    static_cast<void>(split_target("/" + bytes, problems));
    static_cast<void>(split_target("/?" + bytes, problems));
    RC_ASSERT(problems.size() <= most_problems);
}

}  // namespace
}  // namespace sporeprint::api::http_query_test
