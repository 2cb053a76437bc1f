#include "core/params/schema.h"

#include <gtest/gtest.h>

#include <string>

#include "tests/core/params/sample.h"

namespace sporeprint::params_schema_test {
namespace {

using sample::Request;

std::string at(const Value& schema, std::string_view pointer) {
    const Value* found = schema.at_pointer(pointer);
    return found ? dump(*found) : "nothing at " + std::string(pointer);
}

TEST(Schema, LeavesHaveTypeRangeDefaultAndDescription) {
    const Value json = schema(Request{});
    EXPECT_EQ(at(json, "/type"), "\"object\"");
    EXPECT_EQ(at(json, "/additionalProperties"), "false");
    EXPECT_EQ(at(json, "/properties/seed"),
              R"({"type":"integer","minimum":0,"maximum":4294967295,"default":1,"title":"seed",)"
              R"("description":"The individual."})");
    EXPECT_EQ(at(json, "/properties/cap/properties/radius"),
              R"({"type":"number","minimum":0.002,"maximum":0.5,"default":0.04,"x-step":0.001,)"
              R"("x-unit":"m","title":"radius","description":"Distance from axis to rim."})");
    EXPECT_EQ(at(json, "/properties/rough/default"), "0.3");
    EXPECT_EQ(at(json, "/properties/has_ring"),
              R"({"type":"boolean","default":false,"title":"has ring",)"
              R"("description":"Whether a ring is left."})");
    EXPECT_EQ(at(json, "/properties/animation/enum"), R"(["none","growth"])");
    EXPECT_EQ(at(json, "/properties/texture_size/enum"), "[128,256,512,1024]");
    EXPECT_EQ(at(json, "/properties/texture_size/default"), "1024");
    EXPECT_EQ(at(json, "/properties/cap/properties/colour/default"), "\"#D22B1F\"");
    EXPECT_EQ(at(json, "/properties/v/maxLength"), "12");
    EXPECT_EQ(at(json, "/properties/image/contentEncoding"), "\"base64\"");
    EXPECT_EQ(at(json, "/properties/image/maxLength"), "1336");
    EXPECT_EQ(at(json, "/properties/r/title"), "\"r\"") << "inlined";
}

TEST(Schema, ListsDescribeTheirItems) {
    const Value json = schema(Request{});
    EXPECT_EQ(
        at(json, "/properties/profile"),
        R"({"type":"array","maxItems":16,"items":{"type":"number","minimum":0.1,"maximum":4},)"
        R"("default":[1,0.9,1.1],"title":"profile","description":"Stem radii."})");
    EXPECT_EQ(at(json, "/properties/span/minItems"), "2");
    EXPECT_EQ(at(json, "/properties/span/default"), "[0.25,0.5]");
    EXPECT_EQ(at(json, "/properties/wind/maxItems"), "3");
    EXPECT_EQ(at(json, "/properties/model/oneOf/0/properties/outline/items/properties/r/maximum"),
              "1");
}

TEST(Schema, OptionalsTakeTheirDefaultFromTheSpecies) {
    const Value json = schema(Request{});
    const std::string bend = "/properties/deformation/properties/low/properties/bend_deg";
    EXPECT_EQ(at(json, bend),
              R"({"type":"number","minimum":0,"maximum":90,"x-unit":"deg","title":"bend",)"
              R"("description":"Bend of the axis.","x-default-from":"species"})");
    EXPECT_EQ(at(json, "/properties/tint/x-default-from"), "\"species\"");
    Request request;
    request.deformation.low.bend_deg = 30.0;
    EXPECT_EQ(at(schema(request), bend + "/default"), "30");
}

TEST(Schema, FormsAreDescribed) {
    const Value json = schema(Request{});
    EXPECT_EQ(
        at(json, "/properties/roots"),
        R"({"type":"object","oneOf":[{"type":"object","properties":{"form":{"const":"bare"}},)"
        R"("additionalProperties":false,"required":["form"]},)"
        R"({"type":"object","properties":{"form":{"const":"branched"},)"
        R"("forks":{"type":"integer","minimum":1,"maximum":9,"default":3,"title":"forks",)"
        R"("description":"How often a branch divides."}},"additionalProperties":false,)"
        R"("required":["form"]}],"default":{"form":"bare"},"title":"roots",)"
        R"("description":"What is below ground."})");
    EXPECT_EQ(at(json, "/properties/model/properties/gloss/default"), "0.5") << "beside the forms";
    EXPECT_EQ(at(json, "/properties/model/oneOf/1/properties/form"), R"({"const":"branched"})");
    EXPECT_EQ(at(json, "/properties/model/unevaluatedProperties"), "false");
    EXPECT_EQ(json.at_pointer("/properties/model/oneOf/1/additionalProperties"), nullptr);
}

struct OneForm {
    std::variant<sample::Branched> shape;
    double gloss = 0.5;
    static constexpr void fields(auto visit) {
        visit(&OneForm::shape, Info{.name = ""});
        visit(&OneForm::gloss, Info{.name = "gloss", .max = 1, .doc = "Wetness."});
    }
};

TEST(Schema, TheOnlyFormIsMergedIntoItsParent) {
    const Value json = schema(OneForm{});
    EXPECT_EQ(at(json, "/properties/form"), R"({"const":"branched","default":"branched"})");
    EXPECT_EQ(at(json, "/properties/forks/default"), "3");
    EXPECT_EQ(at(json, "/properties/gloss/default"), "0.5");
    EXPECT_EQ(at(json, "/additionalProperties"), "false");
    EXPECT_EQ(json.find("oneOf"), nullptr);
}

struct TwoInlined {
    std::variant<sample::Swept, sample::Branched> shape;
    static constexpr void fields(auto visit) { visit(&TwoInlined::shape, Info{.name = ""}); }
};

TEST(Schema, DocumentNamesItsDialect) {
    const Value json = schema_document("Model", TwoInlined{});
    EXPECT_EQ(at(json, "/$schema"), "\"https://json-schema.org/draft/2020-12/schema\"");
    EXPECT_EQ(at(json, "/title"), "\"Model\"");
    EXPECT_EQ(at(json, "/oneOf/0/properties/form/const"), "\"swept\"");
}

TEST(Schema, DefaultsComeFromTheGivenObject) {
    Request request;
    request.age = 0.25;
    request.roots = sample::Branched{.forks = 8};
    const Value json = schema(request);
    EXPECT_EQ(at(json, "/properties/age/default"), "0.25");
    EXPECT_EQ(at(json, "/properties/roots/oneOf/1/properties/forks/default"), "8");
    EXPECT_EQ(at(json, "/properties/roots/default"), R"({"form":"branched"})");
}

}  // namespace
}  // namespace sporeprint::params_schema_test
