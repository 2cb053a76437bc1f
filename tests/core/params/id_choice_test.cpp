// A choice among ids that are known at run time only, as every reader and writer of parameters
// treats it.

#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "core/params/canonical.h"
#include "core/params/corners.h"
#include "core/params/query.h"
#include "core/params/reader.h"
#include "core/params/schema.h"
#include "tests/support/refusals.h"

namespace sporeprint::params_id_choice_test {
namespace {

struct Garden {
    IdChoice tree{"oak"};
    int count = 1;

    static constexpr void fields(auto visit) {
        visit(&Garden::tree, Info{.name = "tree", .doc = "What grows in it."});
        visit(&Garden::count, Info{.name = "count", .min = 1, .max = 9, .doc = "How many."});
    }
    bool operator==(const Garden&) const = default;
};
static_assert(well_described<Garden>());

const std::vector<std::string> trees{"oak", "wych_elm"};

Garden garden() {
    Garden one;
    one.tree.among = trees;
    return one;
}

TEST(IdChoice, IsReadFromJsonAndQueryIfAllowed) {
    Garden one = garden();
    std::vector<Problem> problems;
    read(Value::object().set("tree", "wych_elm"), one, Info{.name = ""}, "", problems);
    EXPECT_EQ(one.tree, IdChoice{"wych_elm"});
    const std::pair<std::string, std::string> pair{"tree", "oak"};
    read_query({&pair, 1}, one, problems);
    EXPECT_EQ(one.tree, IdChoice{"oak"});
    EXPECT_EQ(problems, std::vector<Problem>{});
    EXPECT_EQ(write(one).find("tree")->as_string(), "oak");
}

TEST(IdChoice, OtherValuesAreReportedLikeThoseOfAnEnum) {
    for (const Value& bad : {Value("elm"), Value(""), Value(std::string(99, 'x'))}) {
        Garden one = garden();
        std::vector<Problem> problems;
        read(Value::object().set("tree", bad), one, Info{.name = ""}, "", problems);
        EXPECT_TRUE(names(problems, "/tree", shown(bad) + " is not one of oak, wych_elm"));
        EXPECT_EQ(one, garden()) << "a faulty value changes nothing";
    }
    Garden one = garden();
    std::vector<Problem> problems;
    read(Value::object().set("tree", 7), one, Info{.name = ""}, "", problems);
    EXPECT_TRUE(names(problems, "/tree", "7 is not one of oak, wych_elm"));
    one.tree.id = "elm";
    EXPECT_TRUE(names(problems_in(one), "/tree", "'elm' is not one of oak, wych_elm"));
}

TEST(IdChoice, WithoutAListAnyIdIsAllowed) {
    Garden one;
    std::vector<Problem> problems;
    read(Value::object().set("tree", "baobab"), one, Info{.name = ""}, "", problems);
    EXPECT_EQ(problems, std::vector<Problem>{});
    EXPECT_EQ(one.tree, IdChoice{"baobab"});
    for (const Value& bad : {Value("Elm"), Value(""), Value(std::string(49, 'x')), Value(true)})
        read(Value::object().set("tree", bad), one, Info{.name = ""}, "", problems);
    EXPECT_EQ(problems.size(), 4u);
    EXPECT_TRUE(names(problems, "/tree", "'Elm' is not an id"));
}

TEST(IdChoice, IsBareInCanonicalTextAndQueries) {
    Garden one = garden();
    one.tree.id = "wych_elm";
    EXPECT_EQ(canonical_text(one), "{tree:wych_elm,count:1,}");
    EXPECT_EQ(query_text(one, garden()), "tree=wych_elm");
    EXPECT_EQ(query_text(garden(), garden()), "");
}

TEST(IdChoice, HasTheSchemaOfAnEnum) {
    const Value of_list = schema(garden());
    EXPECT_EQ(dump(*of_list.at_pointer("/properties/tree/enum")), R"(["oak","wych_elm"])");
    EXPECT_EQ(of_list.at_pointer("/properties/tree/default")->as_string(), "oak");
    const Value of_any = schema(Garden{});
    EXPECT_EQ(of_any.at_pointer("/properties/tree/type")->as_string(), "string");
    EXPECT_EQ(of_any.at_pointer("/properties/tree/enum"), nullptr);
}

TEST(IdChoice, CornersAreAllOfItsIds) {
    Garden one = garden();
    std::vector<std::string> visited;
    corners(one, [&](const std::string& path) {
        if (path == "/tree") visited.push_back(one.tree.id.string());
    });
    EXPECT_EQ(visited, trees);
    EXPECT_EQ(one, garden());
}

}  // namespace
}  // namespace sporeprint::params_id_choice_test
