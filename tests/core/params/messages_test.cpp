#include "core/params/messages.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "core/params/value.h"

namespace sporeprint::params_messages_test {
namespace {

TEST(Messages, NumbersAreShortest) {
    EXPECT_EQ(number_text(0.04), "0.04");
    EXPECT_EQ(number_text(-0.0), "0");
    EXPECT_EQ(number_text(-0.0f), "0");
    EXPECT_EQ(number_text(0.1f), "0.1");
    EXPECT_EQ(number_text(1.0), "1");
    EXPECT_EQ(number_text(100000.0), "100000");
    EXPECT_EQ(number_text(4294967295.0), "4294967295");
    EXPECT_EQ(number_text(1e-7), "1e-7");
    EXPECT_EQ(number_text(1e300), "1e300");
    EXPECT_EQ(number_text(-2.5e-300), "-2.5e-300");
    EXPECT_EQ(number_text(7), "7");
    EXPECT_EQ(number_text(std::numeric_limits<double>::infinity()), "inf");
    EXPECT_EQ(number_text(-std::numeric_limits<double>::infinity()), "-inf");
    EXPECT_EQ(number_text(std::nan("")), "nan");
}

TEST(Messages, EveryFiniteNumberReadsBackAsItself) {
    EXPECT_TRUE(rc::check([](std::uint64_t bits) {
        const double number = std::bit_cast<double>(bits);
        RC_PRE(std::isfinite(number));
        double back = 1.0;
        RC_ASSERT(read_number(number_text(number), back));
        RC_ASSERT(back == number);
    }));
}

TEST(Messages, QuotesAreShortAndPrintable) {
    EXPECT_EQ(in_quotes("fast"), "'fast'");
    EXPECT_EQ(in_quotes("a\nb"), "'a?b'");
    EXPECT_EQ(in_quotes("\x01-\xff-\x7f"), "'?-?-?'");
    EXPECT_EQ(in_quotes(std::string(100, 'x')), "'" + std::string(40, 'x') + "...'");
    EXPECT_EQ(in_quotes(std::string(39, 'x') + "é"), "'" + std::string(39, 'x') + "...'")
        << "no letter is cut in two";
}

TEST(Messages, Utf8RefusesOverlongSurrogatesAndBeyondUnicode) {
    EXPECT_TRUE(is_plain_text("Pilz é ё 菌 𝛼"));
    for (const char* bad :
         {"\xc0\x80", "\xc1\xbf", "\xe0\x9f\xbf", "\xed\xa0\x80", "\xf0\x8f\xbf\xbf",
          "\xf4\x90\x80\x80", "\xf5\x80\x80\x80", "\x80", "\xe2\x82", "a\tb"})
        EXPECT_FALSE(is_plain_text(bad)) << testing::PrintToString(std::string(bad));
}

TEST(Messages, ClosestFindsTheIntendedName) {
    const std::vector<std::string> known = {"seed", "age", "size", "weathering.cracks",
                                            "texture_size"};
    EXPECT_EQ(closest("sed", known), "seed");
    EXPECT_EQ(closest("SEED", known), "seed");
    EXPECT_EQ(closest("esed", known), "seed");
    EXPECT_EQ(closest("weathering.crack", known), "weathering.cracks");
    EXPECT_EQ(closest("texturesize", known), "texture_size");
    EXPECT_EQ(closest("colour", known), "");
    EXPECT_EQ(closest("x", known), "");
    EXPECT_EQ(closest("", known), "");
    EXPECT_EQ(closest(std::string(100000, 's'), known), "");
    EXPECT_EQ(unknown_message("sed", known), "unknown parameter; did you mean 'seed'?");
    EXPECT_EQ(unknown_message("colour", known), "unknown parameter");
}

TEST(Messages, PointersAreEscaped) { EXPECT_EQ(pointer_token("a/b~c\n"), "a~1b~0c?"); }

TEST(Messages, IdsAreLowerCase) {
    EXPECT_EQ(invalid_id_message("wych_elm_2"), "");
    EXPECT_EQ(invalid_id_message(""), "is missing");
    EXPECT_EQ(invalid_id_message("Elm"), "'Elm' has other characters than a-z, 0-9 and _");
    EXPECT_NE(invalid_id_message("../elm"), "");
}

TEST(Messages, PercentEncodingKeepsUnreserved) {
    EXPECT_EQ(percent_encoded("aZ09-._~"), "aZ09-._~");
    EXPECT_EQ(percent_encoded("#D2 é&+%"), "%23D2%20%C3%A9%26%2B%25");
}

TEST(Messages, TitlesAreWords) {
    EXPECT_EQ(title_of("gill_count"), "gill count");
    EXPECT_EQ(title_of("bend_deg"), "bend");
}

}  // namespace
}  // namespace sporeprint::params_messages_test
