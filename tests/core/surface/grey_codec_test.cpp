#include "core/surface/grey_codec.h"

#include <gtest/gtest.h>

#include <string>

#include "core/problems.h"
#include "core/surface/codecs.h"
#include "tests/support/grey_png.h"

namespace sporeprint::grey_codec_test {
namespace {

/// Returns why a file is refused; empty if it is not.
std::string refusal(const Bytes& file, int most = 64) {
    try {
        static_cast<void>(decoded_grey(file, most, "/mask"));
    } catch (const InvalidInput& refused) {
        EXPECT_EQ(refused.problems().front().path, "/mask");
        return refused.problems().front().message;
    }
    return {};
}

Bytes gradient() {
    return grey_png(16, [](int column, int row) { return 16 * row + column; });
}

TEST(GreyPng, Of16BitsHasTheNumbersThatWereWritten) {
    std::vector<std::uint16_t> numbers;
    for (std::uint32_t i = 0; i < 7 * 5; ++i)
        numbers.push_back(static_cast<std::uint16_t>(i * 7919));
    const Bytes file = png_of_numbers(numbers, 7, 5, {{"Title", "numbers"}});
    const GreyValues grey = decoded_grey(file, 7, "");
    EXPECT_EQ(grey.width, 7);
    EXPECT_EQ(grey.height, 5);
    EXPECT_EQ(grey.values, numbers);
}

TEST(GreyPng, Of8BitsReachesFromNothingToAll) {
    const GreyValues grey = decoded_grey(gradient(), 16, "");
    ASSERT_EQ(grey.values.size(), 256U);
    for (std::size_t i = 0; i < 256; ++i) EXPECT_EQ(grey.values[i], 257 * i);
}

TEST(GreyPng, IgnoresWhatIsBesideThePixels) {
    Bytes file = gradient();
    Bytes gamma;
    append_word(gamma, 100);
    Bytes chunk, text(100'000, 'x');
    append_chunk(chunk, "gAMA", gamma);
    append_chunk(chunk, "tEXt", text);
    constexpr std::ptrdiff_t behind_the_head = 33;
    file.insert(file.begin() + behind_the_head, chunk.begin(), chunk.end());
    EXPECT_EQ(decoded_grey(file, 16, "").values, decoded_grey(gradient(), 16, "").values);
}

TEST(GreyPng, IsNoOtherFile) {
    EXPECT_NE(refusal({}).find("not a PNG"), std::string::npos);
    EXPECT_NE(refusal(Bytes(100, 0xFF)).find("not a PNG"), std::string::npos);
    EXPECT_NE(refusal(jpeg(Bytes(192), 8, 8, 80, Chroma::full)).find("not a PNG"),
              std::string::npos);
    EXPECT_NE(refusal(png(Bytes(256), 8, 8)).find("not grey"), std::string::npos);
    EXPECT_NE(refusal(png_of_numbers(Bytes(192), 8, 8, {})).find("not grey"), std::string::npos);
    EXPECT_NE(refusal(png_file({8, 8, 4, 0}, Bytes(40))).find("not grey"), std::string::npos);
    EXPECT_NE(refusal(png_file({8, 8, 8, 4}, Bytes(136))).find("not grey"), std::string::npos);
}

TEST(GreyPng, IsRefusedByItsHeaderIfItIsTooLarge) {
    EXPECT_NE(refusal(gradient(), 15).find("at most 15 x 15"), std::string::npos);
    EXPECT_EQ(refusal(gradient(), 16), "");
    for (const PngHeader header :
         {PngHeader{2'000'000'000, 1}, PngHeader{1, 0}, PngHeader{0, 1}, PngHeader{1, 0xFFFF'FFFF}})
        EXPECT_NE(refusal(png_file(header, Bytes(2))).find("pixels"), std::string::npos);
}

TEST(GreyPng, IsRefusedIfItIsBroken) {
    const Bytes whole = gradient();
    for (std::size_t size = 33; size < whole.size(); size += 7)
        EXPECT_NE(refusal(Bytes(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(size))),
                  "")
            << size;
    Bytes longer = whole;
    longer.push_back(0);
    EXPECT_NE(refusal(longer).find("followed by other bytes"), std::string::npos);
    for (std::size_t at = 29; at < whole.size(); at += 3) {
        Bytes other = whole;
        other[at] ^= 0x40;
        EXPECT_NE(refusal(other), "") << at;
    }
    // Too few rows, and a hundred times as many as there should be.
    EXPECT_NE(refusal(png_file({8, 8, 8, 0}, Bytes(63))), "");
    EXPECT_NE(refusal(png_file({8, 8, 8, 0}, Bytes(7200))), "");
    EXPECT_EQ(refusal(png_file({8, 8, 8, 0}, Bytes(72))), "");
}

}  // namespace
}  // namespace sporeprint::grey_codec_test
