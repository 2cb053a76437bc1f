#include "core/model/substrate.h"

#include <gtest/gtest.h>

#include <set>
#include <string>

#include "tests/support/atlas.h"

namespace sporeprint::model_substrate_test {
namespace {

Substrate wood(const char* habitat) {
    Facts facts;
    facts.habitat = Text<96>(habitat);
    return wood_of(facts);
}

TEST(Substrate, IsTheTreeThatTheHabitatMentionsFirst) {
    EXPECT_EQ(wood("trunks of birch and beech"), Substrate::birch);
    EXPECT_EQ(wood("trunks of beech and birch"), Substrate::beech);
    EXPECT_EQ(wood("stumps of conifers, seldom of oak"), Substrate::spruce);
    EXPECT_EQ(wood("willows and poplars by rivers"), Substrate::poplar);
    EXPECT_EQ(wood("dead wood of broad-leaved trees, seldom of pines"), Substrate::beech);
    EXPECT_EQ(wood("meadows"), Substrate::beech) << "no tree is mentioned";
    EXPECT_EQ(wood(""), Substrate::beech);
}

TEST(Substrate, OfBracketsIsThatOfTheirRecordedHabitat) {
    const auto recorded = [](const char* id) { return wood_of(atlas().find(id)->species.facts); };
    EXPECT_EQ(recorded("fomes_fomentarius"), Substrate::birch);
    EXPECT_EQ(recorded("pleurotus_ostreatus"), Substrate::beech);
    EXPECT_EQ(recorded("trametes_versicolor"), Substrate::beech) << "of broad-leaved trees";
}

TEST(Substrate, EachHasANameOfItsOwn) {
    std::set<std::string> names = {name(Substrate::none)};
    for (const Substrate one : all_woods) names.insert(name(one));
    EXPECT_EQ(names.size(), all_woods.size() + 1);
}

}  // namespace
}  // namespace sporeprint::model_substrate_test
