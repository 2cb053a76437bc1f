#include "api/library/tokens.h"

#include <gtest/gtest.h>

#include <set>

namespace sporeprint::api::library_tokens_test {
namespace {

TEST(Secrets, AreFoundByTheirIdAndProvenByTheirDigest) {
    const Secret made = new_secret(token_prefix);
    EXPECT_EQ(made.text.size(), 4U + 8U + 1U + 43U);
    EXPECT_TRUE(made.text.starts_with("spk_" + made.id + '_'));
    const std::optional<Secret> read = read_secret(token_prefix, made.text);
    ASSERT_TRUE(read);
    EXPECT_EQ(read->id, made.id);
    EXPECT_TRUE(equal_in_constant_time(read->digest, made.digest));
    std::string other = made.text;
    other.back() = other.back() == 'A' ? 'B' : 'A';
    EXPECT_FALSE(equal_in_constant_time(read_secret(token_prefix, other)->digest, made.digest));
    EXPECT_FALSE(read_secret(share_prefix, made.text)) << "a token is no key of a share";
}

TEST(Secrets, AreAllDifferent) {
    std::set<std::string> texts;
    for (int i = 0; i < 100; ++i) texts.insert(new_secret(share_prefix).text);
    EXPECT_EQ(texts.size(), 100U);
}

TEST(Secrets, OfAnotherFormAreNone) {
    const std::string good = new_secret(token_prefix).text;
    EXPECT_FALSE(read_secret(token_prefix, ""));
    EXPECT_FALSE(read_secret(token_prefix, good + "A"));
    EXPECT_FALSE(read_secret(token_prefix, good.substr(0, good.size() - 1)));
    std::string without_mark = good;
    without_mark[12] = 'x';
    EXPECT_FALSE(read_secret(token_prefix, without_mark));
    std::string capital = good;
    capital[5] = 'A';
    EXPECT_FALSE(read_secret(token_prefix, capital)) << "ids are of lower-case letters and digits";
}

TEST(Digests, AreThoseOfTheStandard) {
    EXPECT_EQ(hex_of(sha256_of("abc")),
              "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
    EXPECT_EQ(read_hex(hex_of(sha256_of("abc"))), sha256_of("abc"));
    EXPECT_FALSE(read_hex("ba78"));
    EXPECT_FALSE(read_hex(std::string(63, 'a') + 'g'));
    EXPECT_FALSE(read_hex(std::string(62, 'a') + "-1"));
}

}  // namespace
}  // namespace sporeprint::api::library_tokens_test
