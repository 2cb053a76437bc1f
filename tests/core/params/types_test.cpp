#include "core/params/types.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

namespace sporeprint::params_types_test {
namespace {

std::vector<std::uint8_t> bytes_of(std::string_view text) { return {text.begin(), text.end()}; }

TEST(Types, TextHoldsUpToItsCapacity) {
    constexpr Text<4> text = "abcd";
    static_assert(text.view() == "abcd" && text == Text<4>("abcd"));
    EXPECT_THROW(Text<4>(std::string_view("abcde")), std::length_error);
    EXPECT_TRUE(Text<4>().empty());
}

TEST(Types, ColoursAreReadInEitherCaseAndWrittenUpper) {
    Colour colour;
    EXPECT_TRUE(read_colour("#d22B1f", colour));
    EXPECT_EQ(colour, (Colour{0xd2, 0x2b, 0x1f}));
    EXPECT_EQ(colour_text(colour), "#D22B1F");
    for (const char* bad : {"", "#", "d22b1f", "#d22b1", "#d22b1f0", "#d22b1g", "#fff", "#+12345"})
        EXPECT_FALSE(read_colour(bad, colour)) << bad;
    EXPECT_EQ(colour_text(colour), "#D22B1F") << "a refused text changes nothing";
}

// The test vectors of RFC 4648 §10 and FIPS 180-2.
TEST(Types, Base64FollowsItsTestVectors) {
    const std::pair<const char*, const char*> vectors[] = {{"", ""},
                                                           {"f", "Zg=="},
                                                           {"fo", "Zm8="},
                                                           {"foo", "Zm9v"},
                                                           {"foob", "Zm9vYg=="},
                                                           {"fooba", "Zm9vYmE="},
                                                           {"foobar", "Zm9vYmFy"}};
    for (const auto& [plain, coded] : vectors) {
        EXPECT_EQ(base64_text(bytes_of(plain)), coded);
        std::vector<std::uint8_t> back;
        EXPECT_TRUE(read_base64(coded, back));
        EXPECT_EQ(back, bytes_of(plain));
    }
}

TEST(Types, Base64IsStrict) {
    std::vector<std::uint8_t> out = {7};
    for (const char* bad : {"Zg", "Zg=", "Zh==", "Zm9=", "Z===", "====", "Zm 9", "Zm9v\n",
                            "Zg==Zg==", "Zm-_", "=Zm9", "Zm9vZ"})
        EXPECT_FALSE(read_base64(bad, out)) << bad;
    EXPECT_EQ(out, std::vector<std::uint8_t>{7});
}

TEST(Types, Base64OfAnyBytesReadsBack) {
    EXPECT_TRUE(rc::check([](const std::vector<std::uint8_t>& bytes) {
        std::vector<std::uint8_t> back;
        RC_ASSERT(read_base64(base64_text(bytes), back));
        RC_ASSERT(back == bytes);
    }));
}

TEST(Types, DigestsFollowTheStandard) {
    EXPECT_EQ(uploaded(bytes_of("abc")).sha256.view(),
              "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
    EXPECT_TRUE(uploaded({}).empty());
    EXPECT_TRUE(uploaded({}).sha256.empty());
    EXPECT_NE(uploaded(bytes_of("abc")), uploaded(bytes_of("abd")));
}

}  // namespace
}  // namespace sporeprint::params_types_test
