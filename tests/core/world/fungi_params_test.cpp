#include "core/world/fungi_params.h"

#include <gtest/gtest.h>

namespace sporeprint::fungi_params_test {
namespace {

TEST(FungiParams, ReadAListOfSpecies) {
    std::vector<Problem> problems;
    EXPECT_TRUE(species_in("", "", problems).empty());
    EXPECT_EQ(species_in("b+a_c+a", "", problems), (std::vector<std::string>{"a", "a_c", "b"}));
    EXPECT_TRUE(problems.empty());
    EXPECT_EQ(canonical_species("b+a"), "a+b");
    EXPECT_EQ(canonical_species(""), "");
}

TEST(FungiParams, RefuseRepeatedTooManyAndMalformedSpecies) {
    const auto problem_of = [](std::string_view text) {
        std::vector<Problem> problems;
        EXPECT_TRUE(species_in(text, "/species", problems).empty());
        EXPECT_EQ(canonical_species(text), text);
        return problems.empty() ? std::string() : problems.front().message;
    };
    EXPECT_NE(problem_of("a+b+a").find("'a' is named twice"), std::string::npos);
    EXPECT_NE(problem_of("a++b").find("is no species"), std::string::npos);
    EXPECT_NE(problem_of("~own.name").find("is no species"), std::string::npos);
    EXPECT_NE(problem_of("a+b+c+d+e+f+g+h+i+j+k+l+m").find("at most 12"), std::string::npos);
}

}  // namespace
}  // namespace sporeprint::fungi_params_test
