#include "api/batch/labels.h"

#include <gtest/gtest.h>

#include <string>

#include "tests/api/support.h"

namespace sporeprint::api::labels_test {
namespace {

using namespace test;

std::string made(const std::string& target) {
    Service service(built_in_atlas(), {});
    const Response response = handle(service, get(target));
    EXPECT_EQ(response.status, 200) << target;
    return text_of(response);
}

TEST(Labels, AreTheExtrasOfAGlbFile) {
    const std::string file =
        made("/v1/mushrooms/boletus_edulis.glb?lod=3&textures=none&seed=9&age=0.25");
    const Value labels = labels_of({slice_of(file)});
    ASSERT_TRUE(labels.is_object());
    EXPECT_EQ(labels.at_pointer("/effective/seed")->as_number(), 9.0);
    EXPECT_EQ(labels.at_pointer("/effective/age")->as_number(), 0.25);
    // A body in pieces has the same ones.
    Body pieces;
    for (std::size_t at = 0; at < file.size(); at += 7)
        pieces.push_back(slice_of(file.substr(at, 7)));
    EXPECT_EQ(labels_of(pieces), labels);
}

TEST(Labels, AreNullForAllElse) {
    EXPECT_TRUE(labels_of({}).is_null());
    EXPECT_TRUE(labels_of({slice_of("{\"asset\":{\"extras\":1}}")}).is_null());
    const std::string file = made("/v1/mushrooms/boletus_edulis.glb?lod=3&textures=none");
    std::string longer = file;
    longer[15] = '\x7f';
    EXPECT_TRUE(labels_of({slice_of(longer)}).is_null()) << "Its JSON is longer than the file.";
    for (std::size_t size = 0; size < 400; size += 3)
        EXPECT_TRUE(labels_of({slice_of(file.substr(0, size))}).is_null());
}

TEST(Labels, OfAnAddressHaveItsExtension) {
    EXPECT_EQ(extension_of("/v1/trees/birch.glb?lod=1.5"), "glb");
    EXPECT_EQ(extension_of("/v1/worlds/beech,v=1.2/season.json"), "json");
    EXPECT_EQ(extension_of("/v1.2/trees"), "");
    EXPECT_EQ(extension_of(""), "");
}

}  // namespace
}  // namespace sporeprint::api::labels_test
