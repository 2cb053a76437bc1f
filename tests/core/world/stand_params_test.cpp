#include "core/world/stand_params.h"

#include <gtest/gtest.h>

namespace sporeprint::stand_params_test {
namespace {

std::string problem_of(std::string_view text) {
    std::vector<Problem> problems;
    const Weights kinds = kinds_in(text, "/kinds", problems);
    EXPECT_EQ(kinds.empty(), !problems.empty());
    return problems.empty() ? std::string() : problems.front().message;
}

TEST(StandParams, ReadKindsWithAndWithoutWeights) {
    std::vector<Problem> problems;
    EXPECT_EQ(kinds_in("birch", "", problems), (Weights{{"birch", 1.0}}));
    EXPECT_EQ(kinds_in("spruce:3+birch:0.5+a_b", "", problems),
              (Weights{{"spruce", 3.0}, {"birch", 0.5}, {"a_b", 1.0}}));
    EXPECT_TRUE(problems.empty());
}

TEST(StandParams, RefuseKindsThatAreNotOfThatForm) {
    EXPECT_NE(problem_of("").find("'' is no kind of tree"), std::string::npos);
    EXPECT_NE(problem_of("birch+").find("as in broadleaf:0.8+birch:0.2"), std::string::npos);
    EXPECT_NE(problem_of("Birch").find("'Birch' is no kind of tree"), std::string::npos);
    EXPECT_NE(problem_of("birch:0").find("greater than 0"), std::string::npos);
    EXPECT_NE(problem_of("birch:-1").find("'-1'"), std::string::npos);
    EXPECT_NE(problem_of("birch:two").find("'two'"), std::string::npos);
    EXPECT_NE(problem_of("birch:1e999").find("'1e999'"), std::string::npos);
    EXPECT_NE(problem_of("birch+birch:2").find("named twice"), std::string::npos);
    EXPECT_EQ(problem_of("a+b+c+d+e+f+g+h"), "");
    EXPECT_NE(problem_of("a+b+c+d+e+f+g+h+i").find("at most 8"), std::string::npos);
}

TEST(StandParams, HaveOneTextForEqualMixtures) {
    EXPECT_EQ(canonical_kinds("birch:7"), "birch");
    EXPECT_EQ(canonical_kinds("spruce:3+birch:1"), "birch:0.25+spruce:0.75");
    EXPECT_EQ(canonical_kinds("birch+spruce:3"), canonical_kinds("spruce:0.75+birch:0.25"));
    EXPECT_EQ(canonical_kinds(canonical_kinds("a+b+c")), canonical_kinds("a+b+c"));
    EXPECT_EQ(canonical_kinds("birch:no"), "birch:no");
}

TEST(StandParams, AreCheckedAsAWhole) {
    StandParams params;
    std::vector<Problem> problems;
    params.check("", problems);
    EXPECT_TRUE(problems.empty());
    params.kinds = Text<256>(std::string(161, 'a'));
    params.check("", problems);
    ASSERT_EQ(problems.size(), 1U);
    EXPECT_EQ(problems.front().path, "/kinds");
    EXPECT_NE(problems.front().message.find("at most 160"), std::string::npos);
}

}  // namespace
}  // namespace sporeprint::stand_params_test
