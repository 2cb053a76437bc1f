#include "api/products/mix.h"

#include <gtest/gtest.h>

#include "core/params/messages.h"
#include "tests/api/support.h"

namespace sporeprint::api::products_mix_test {
namespace {

TEST(ReadMix, ReadsIdsAndWeightsOfTheAtlas) {
    const auto atlas = built_in_atlas();
    ASSERT_GE(atlas->entries().size(), 2u);
    const std::string a = atlas->entries()[0].species.id.string(),
                      b = atlas->entries()[1].species.id.string();
    ValidationErrors errors;
    EXPECT_EQ(mix_text(read_mix(b + ":3," + a + ":7e-0", *atlas, errors)),
              a + ":0.7," + b + ":0.3");
    EXPECT_EQ(mix_text(read_mix(a + ":5", *atlas, errors)), a);
    EXPECT_EQ(mix_text(read_mix_object(Value::object().set(b, 1).set(a, 1), *atlas, errors)),
              a + ":0.5," + b + ":0.5");
    EXPECT_TRUE(errors.empty());
}

TEST(ReadMix, NamesEveryError) {
    const auto atlas = built_in_atlas();
    const std::string a = atlas->entries()[0].species.id.string(),
                      b = atlas->entries()[1].species.id.string();
    const struct {
        std::string text;
        int status;
        const char* words;
    } cases[] = {
        {"", 400, "missing"},
        {a + ":", 400, "not a number"},
        {a + ":x", 400, "not a number"},
        {a + ":+1", 400, "not a number"},
        {a + ":.5", 400, "not a number"},
        {a + ": 1", 400, "not a number"},
        {a + ":0x1", 400, "not a number"},
        {a + ":nan", 400, "not a number"},
        {a + ":1e999", 400, "not a number"},
        {a + ":0", 400, "greater than 0"},
        {a + ":-1", 400, "greater than 0"},
        {a + ":-0", 400, "greater than 0"},
        {a + ":1," + a + ":2", 400, "named twice"},
        {a + ":1," + b, 400, "has no weight"},
        {a + ":1,", 400, "missing"},
        {a.substr(0, a.size() - 1), 404, "did you mean"},
        {"xyzzy", 404, "unknown species"},
        {"a:1,b:1,c:1,d:1,e:1,f:1,g:1,h:1,i:1", 400, "at most 8"},
        {"xyzzy:0", 404, "greater than 0"},
    };
    for (const auto& [text, status, words] : cases) {
        ValidationErrors errors;
        EXPECT_TRUE(read_mix(std::string_view(text), *atlas, errors).empty()) << text;
        EXPECT_EQ(errors.status(), status) << text;
        std::string all;
        for (const Problem& problem : errors.problems()) {
            EXPECT_EQ(problem.path, "mix");
            all += problem.message + '\n';
        }
        EXPECT_NE(all.find(words), std::string::npos) << text << " -> " << all;
    }
}

TEST(ReadMix, OfABodyRefusesWhatIsNoObjectOfNumbers) {
    const auto atlas = built_in_atlas();
    for (const Value& json : {Value("a"), Value(1), Value::array(), Value::object(),
                              Value::object().set(test::first_species(), "1"),
                              Value::object().set(test::first_species(), -1)}) {
        ValidationErrors errors;
        EXPECT_TRUE(read_mix_object(json, *atlas, errors).empty());
        EXPECT_EQ(errors.status(), 400) << dump(json);
    }
}

}  // namespace
}  // namespace sporeprint::api::products_mix_test
