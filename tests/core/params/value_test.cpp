#include "core/params/value.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

namespace sporeprint::params_value_test {
namespace {

std::vector<Problem> problems_of(std::string_view text) {
    std::vector<Problem> problems;
    parse(text, problems);
    return problems;
}

Value parsed(std::string_view text) {
    std::vector<Problem> problems;
    Value value = parse(text, problems);
    EXPECT_TRUE(problems.empty()) << text << ": " << problems[0].message;
    return value;
}

std::string nested(std::size_t depth) { return std::string(depth, '[') + std::string(depth, ']'); }

TEST(Value, ReadsAndWritesEveryKind) {
    const std::string text =
        R"({"z":null,"a":true,"b":[1,-2.5,1e-7,4294967295],"c":"é\"\\\n\u0001","d":{},"e":[]})";
    const Value value = parsed(text);
    EXPECT_EQ(dump(value), text) << "order is kept";
    EXPECT_EQ(parsed(dump(value, 2)), value);
    EXPECT_EQ(dump(parsed("{\"a\":[1,{}],\"b\":{}}"), 2),
              "{\n  \"a\": [\n    1,\n    {}\n  ],\n  \"b\": {}\n}");
}

TEST(Value, NumbersAreShortestAndWhole) {
    EXPECT_EQ(dump(parsed("[1.0, -0.0, -0, 0.10, 1e2, 0.3000000000000000444]")),
              "[1,0,0,0.1,100,0.30000000000000004]");
    EXPECT_EQ(dump(Value(std::nan(""))), "null");
    EXPECT_EQ(parsed("18446744073709551616").as_number(), 18446744073709551616.0);
}

TEST(Value, RepeatedKeysAreRefusedWithTheirPointer) {
    const std::vector<Problem> expected = {{"/a/1/x~1y", "given more than once"},
                                           {"/b", "given more than once"}};
    EXPECT_EQ(problems_of(R"({"a":[0,{"x/y":1,"x/y":1,"x/y":2}],"b":1,"b":2})"), expected);
    EXPECT_EQ(problems_of(R"({"a":1,"\u0061":2})").size(), 1u) << "escapes hide nothing";
}

TEST(Value, AZeroByteDoesNotEndTheText) {
    const auto problems = problems_of(std::string_view("{}\0{", 4));
    ASSERT_EQ(problems.size(), 1u);
    EXPECT_EQ(problems[0].message, "not JSON: a zero byte at position 2");
}

TEST(Value, DepthIsBounded) {
    EXPECT_TRUE(problems_of(nested(deepest_json)).empty());
    const std::vector<Problem> deep = problems_of(nested(deepest_json + 1));
    ASSERT_EQ(deep.size(), 1u);
    EXPECT_EQ(deep[0].message, "nested deeper than 32 levels");
    EXPECT_EQ(problems_of(std::string(100'000, '[')).size(), 1u);
    std::string objects;
    for (int i = 0; i < 100'000; ++i) objects += "{\"a\":";
    const std::vector<Problem> deep_objects = problems_of(objects);
    ASSERT_EQ(deep_objects.size(), 1u);
    EXPECT_EQ(deep_objects[0].path.substr(0, 8), "/a/a/a/a");
}

TEST(Value, AmountIsBounded) {
    std::string text = "[0";
    for (std::size_t i = 0; i < most_json_values; ++i) text += ",0";
    ASSERT_EQ(problems_of(text + "]").size(), 1u);
    EXPECT_EQ(problems_of(text + "]")[0].message, "more than 200000 values");
}

TEST(Value, NumbersThatAreNotFiniteAreRefusedWithTheirPointer) {
    const std::vector<Problem> expected = {{"/a/1", "'1e999' is too large for a number"}};
    EXPECT_EQ(problems_of(R"({"a":[0,1e999]})"), expected);
    EXPECT_EQ(problems_of("-1e999").size(), 1u);
    EXPECT_EQ(parsed("1e-999").as_number(), 0.0);
    EXPECT_EQ(problems_of("NaN").size(), 1u);
    EXPECT_EQ(problems_of("Infinity").size(), 1u);
}

TEST(Value, MalformedTextIsReportedWithItsPlace) {
    const std::vector<Problem> problems = problems_of("{\"a\":1,\n  b}");
    ASSERT_EQ(problems.size(), 1u);
    EXPECT_EQ(problems[0].path, "");
    EXPECT_EQ(problems[0].message, "malformed JSON at line 2, column 3: invalid literal");
    for (const char* bad : {"",
                            " ",
                            "{",
                            "[1,]",
                            "{\"a\"}",
                            "{a:1}",
                            "'a'",
                            "01",
                            "+1",
                            ".5",
                            "1.",
                            "0x10",
                            "[1] 2",
                            "/**/1",
                            "\"\\x\"",
                            "\"\n\"",
                            "\"\\ud800\"",
                            "tru",
                            "\"\xff\"",
                            "\"\xed\xa0\x80\"",
                            "\xff",
                            "[\"\xc3\"]",
                            "{\"\xc3(\":1}"})
        EXPECT_EQ(problems_of(bad).size(), 1u) << bad;
    for (const Problem& problem : problems_of("[\"\xff\xfe\"]"))
        EXPECT_EQ(dump(Value(problem.message)).find("ufffd"), std::string::npos)
            << "a message is always UTF-8";
}

TEST(Value, NumbersOfAQueryFollowTheSameGrammar) {
    double out = 7.0;
    for (const char* bad : {"", "+1", ".5", "1.", "01", "0x1", "inf", "nan", " 1", "1 ", "1e",
                            "1e+", "--1", "1,0", "1e999", "-", "1_0", "1f"})
        EXPECT_FALSE(read_number(bad, out)) << bad;
    EXPECT_EQ(out, 7.0);
    for (const auto& [text, number] : {std::pair{"0.37", 0.37},
                                       {"0.370", 0.37},
                                       {"3.7e-1", 0.37},
                                       {"-0", 0.0},
                                       {"1E+2", 100.0},
                                       {"1e-999", 0.0},
                                       {"0", 0.0}}) {
        EXPECT_TRUE(read_number(text, out)) << text;
        EXPECT_EQ(out, number);
    }
}

TEST(Value, PointersFindValues) {
    const Value value = parsed(R"({"a/b":[10,{"~":true}],"":5})");
    EXPECT_EQ(value.at_pointer(""), &value);
    ASSERT_TRUE(value.at_pointer("/a~1b/1/~0"));
    EXPECT_TRUE(value.at_pointer("/a~1b/1/~0")->as_bool());
    ASSERT_TRUE(value.at_pointer("/"));
    EXPECT_EQ(value.at_pointer("/")->as_number(), 5.0);
    for (const char* none : {"/x", "/a~1b/2", "/a~1b/01", "/a~1b/-1", "/a~1b/0/0", "a", "/a~1b/x"})
        EXPECT_EQ(value.at_pointer(none), nullptr) << none;
}

TEST(Value, CanBeBuiltInCode) {
    Value value;
    value.set("a", 1).set("b", Value::array().push("x").push(false)).set("a", 2u);
    EXPECT_EQ(dump(value), R"({"a":2,"b":["x",false]})");
    value.erase("a");
    EXPECT_EQ(value.find("a"), nullptr);
    EXPECT_EQ(dump(Value("\xff")), "\"\\ufffd\"");
}

}  // namespace
}  // namespace sporeprint::params_value_test
