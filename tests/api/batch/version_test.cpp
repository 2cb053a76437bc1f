#include "api/batch/version.h"

#include <gtest/gtest.h>

#include <string>

#include "tests/support/atlas.h"
#include "tests/support/small_atlas.h"

namespace sporeprint::api::version_test {
namespace {

TEST(VersionOfAll, ChangesWithTheTemplates) {
    const std::string own = version_of(atlas());
    EXPECT_EQ(own, version_of(*built_in_atlas()));
    EXPECT_NE(own, version_of(*small_atlas()));
    EXPECT_EQ(own.find('-'), own.size() - 9);
    AtlasTexts texts = built_in_texts();
    const std::string before = "\"rank\"";
    std::string& tree = texts.trees.front();
    const std::size_t at = tree.find(before);
    ASSERT_NE(at, std::string::npos);
    tree.insert(tree.find_first_of("0123456789", at), "1");
    EXPECT_NE(own, version_of(Atlas(texts)));
}

}  // namespace
}  // namespace sporeprint::api::version_test
