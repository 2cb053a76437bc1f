#include "core/surface/codecs.h"

#include <gtest/gtest.h>
#include <png.h>
#include <webp/decode.h>
#include <webp/encode.h>

#include <cstdlib>
#include <cstring>
#include <string>

#include "core/problems.h"

namespace sporeprint::surface_codecs_test {
namespace {

// A smooth gradient of colours, which lossy codecs reproduce closely.
Bytes slope(int width, int height) {
    Bytes rgb;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            rgb.push_back(static_cast<std::uint8_t>(40 + 150 * x / width));
            rgb.push_back(static_cast<std::uint8_t>(60 + 120 * y / height));
            rgb.push_back(100);
        }
    return rgb;
}

Bytes png_of(const Bytes& pixels, int width, int height, png_uint_32 format) {
    png_image image;
    std::memset(&image, 0, sizeof image);
    image.version = PNG_IMAGE_VERSION;
    image.width = static_cast<png_uint_32>(width);
    image.height = static_cast<png_uint_32>(height);
    image.format = format;
    png_alloc_size_t size = 0;
    EXPECT_NE(png_image_write_to_memory(&image, nullptr, &size, 0, pixels.data(), 0, nullptr), 0);
    Bytes file(size);
    EXPECT_NE(png_image_write_to_memory(&image, file.data(), &size, 0, pixels.data(), 0, nullptr),
              0);
    file.resize(size);
    return file;
}

Bytes webp_of(const Bytes& rgb, int width, int height) {
    std::uint8_t* out = nullptr;
    const std::size_t size = WebPEncodeLosslessRGB(rgb.data(), width, height, 3 * width, &out);
    const Bytes file(out, out + size);
    WebPFree(out);
    return file;
}

std::string refusal(const Bytes& file) {
    try {
        (void)decoded_picture(file, "/surface/cap/image");
    } catch (const InvalidInput& error) {
        EXPECT_EQ(error.problems().at(0).path, "/surface/cap/image");
        return error.problems().at(0).message;
    }
    return "";
}

/// Returns the numbers of a grey PNG file of 16 bits, decoded without any conversion.
std::vector<std::uint16_t> numbers_of(const Bytes& file) {
    struct Source {
        const Bytes& bytes;
        std::size_t at = 0;
    } source{file};
    png_structp reader = png_create_read_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
    png_infop info = png_create_info_struct(reader);
    png_set_read_fn(reader, &source, [](png_structp from, png_bytep out, png_size_t size) {
        auto& all = *static_cast<Source*>(png_get_io_ptr(from));
        std::memcpy(out, &all.bytes.at(all.at), size);
        all.at += size;
    });
    png_read_info(reader, info);
    const png_uint_32 width = png_get_image_width(reader, info),
                      height = png_get_image_height(reader, info);
    std::vector<std::uint16_t> numbers;
    Bytes row(std::size_t{2} * width);
    for (png_uint_32 y = 0; y < height; ++y) {
        png_read_row(reader, row.data(), nullptr);
        for (png_uint_32 x = 0; x < width; ++x)
            numbers.push_back(static_cast<std::uint16_t>(256U * row[2 * x] + row[2 * x + 1]));
    }
    png_destroy_read_struct(&reader, &info, nullptr);
    return numbers;
}

TEST(Codecs, PngAndLosslessWebpRoundTripExactly) {
    const Bytes rgb = slope(61, 40);
    for (const Bytes& file : {png_of(rgb, 61, 40, PNG_FORMAT_RGB), webp_of(rgb, 61, 40)}) {
        const Picture picture = decoded_picture(file, "/image");
        EXPECT_EQ(picture.width, 61);
        EXPECT_EQ(picture.height, 40);
        EXPECT_TRUE(picture.rgb == rgb);
    }
}

TEST(Codecs, PngOfNumbersHasThemAndItsTexts) {
    std::vector<std::uint16_t> numbers;
    for (unsigned i = 0; i < 30 * 20; ++i) numbers.push_back(static_cast<std::uint16_t>(i * 109U));
    const Bytes file = png_of_numbers(numbers, 30, 20, {{"Unit", "m"}, {"From", "-3.5"}});
    // Bit depth and colour type of IHDR: 16 bits of grey.
    EXPECT_EQ(file[24], 16);
    EXPECT_EQ(file[25], 0);
    const std::string text(file.begin(), file.end());
    EXPECT_NE(text.find(std::string("tEXtUnit\0m", 10)), std::string::npos);
    EXPECT_NE(text.find(std::string("tEXtFrom\0-3.5", 13)), std::string::npos);
    EXPECT_EQ(text.find("sRGB"), std::string::npos) << "numbers have no colour space";
    EXPECT_EQ(numbers_of(file), numbers);
}

TEST(Codecs, PngOfAPaletteHasTheColoursOfItsNumbers) {
    const std::vector<PaletteColour> palette = {{1, 2, 3}, {250, 0, 128}, {9, 255, 7}};
    Bytes numbers;
    for (int i = 0; i < 20; ++i) numbers.push_back(static_cast<std::uint8_t>(i * i % 3));
    const Bytes file = png_of_palette(numbers, 5, 4, palette, {{"Title", "kinds"}});
    EXPECT_EQ(file[24], 8);
    EXPECT_EQ(file[25], 3) << "colours by numbers";
    const Picture picture = decoded_picture(file, "/image");
    ASSERT_EQ(picture.rgb.size(), 60U);
    for (std::size_t i = 0; i < 20; ++i)
        for (std::size_t channel = 0; channel < 3; ++channel)
            EXPECT_EQ(picture.rgb[3 * i + channel], palette[numbers[i]][channel]);
}

TEST(Codecs, JpegRoundTripsClosely) {
    const Bytes rgb = slope(64, 48);
    const Picture picture = decoded_picture(jpeg(rgb, 64, 48, 92, Chroma::full), "/image");
    ASSERT_EQ(picture.rgb.size(), rgb.size());
    for (std::size_t i = 0; i < rgb.size(); ++i) EXPECT_NEAR(picture.rgb[i], rgb[i], 6);
}

TEST(Codecs, AJpegIsDecodedSmallerWhileItsSidesSuffice) {
    const Bytes file = jpeg(slope(128, 64), 128, 64, 95, Chroma::full);
    for (const auto& [least, width] :
         {std::pair{65, 128}, {33, 128}, {32, 64}, {16, 32}, {1, 16}}) {
        const Picture picture = decoded_smaller(file, "/image", least);
        ASSERT_EQ(picture.width, width) << least;
        ASSERT_EQ(picture.height, width / 2);
        const int x = width / 4, y = width / 8;  // a quarter of the way
        const std::uint8_t* const pixel =
            &picture.rgb.at(static_cast<std::size_t>(y * width + x) * 3);
        EXPECT_NEAR(pixel[0], 40 + 150 / 4, 6);
        EXPECT_NEAR(pixel[1], 60 + 120 / 4, 6);
    }
}

TEST(Codecs, JpegIsTheSameEveryTime) {
    const Bytes rgb = slope(64, 64);
    EXPECT_TRUE(jpeg(rgb, 64, 64, 88, Chroma::halved) == jpeg(rgb, 64, 64, 88, Chroma::halved));
}

TEST(Codecs, TransparencyIsDroppedAndItsColourUnchanged) {
    Bytes rgba;
    for (int i = 0; i < 16; ++i) {
        const std::uint8_t alpha = i % 2 == 0 ? 0 : 128;
        rgba.insert(rgba.end(), {200, 100, 50, alpha});
    }
    const Picture picture = decoded_picture(png_of(rgba, 4, 4, PNG_FORMAT_RGBA), "/image");
    for (std::size_t i = 0; i < picture.rgb.size(); i += 3) {
        EXPECT_EQ(picture.rgb[i], 200);
        EXPECT_EQ(picture.rgb[i + 1], 100);
        EXPECT_EQ(picture.rgb[i + 2], 50);
    }
}

TEST(Codecs, FilesThatAreNoImagesAreRefused) {
    EXPECT_EQ(refusal({}), "neither a PNG, a JPEG nor a WebP file");
    EXPECT_EQ(refusal({'h', 'e', 'l', 'l', 'o'}), "neither a PNG, a JPEG nor a WebP file");
    EXPECT_EQ(refusal({'G', 'I', 'F', '8', '9', 'a'}), "neither a PNG, a JPEG nor a WebP file");
}

TEST(Codecs, BrokenFilesAreRefused) {
    const Bytes rgb = slope(64, 64);
    Bytes files[] = {png_of(rgb, 64, 64, PNG_FORMAT_RGB), jpeg(rgb, 64, 64, 90, Chroma::full),
                     webp_of(rgb, 64, 64)};
    for (Bytes& file : files) {
        for (const std::size_t length : {std::size_t{12}, file.size() / 2}) {
            const Bytes cut(file.begin(), file.begin() + static_cast<std::ptrdiff_t>(length));
            EXPECT_NE(refusal(cut), "");
        }
    }
}

TEST(Codecs, AnImageOfTheLargestSizeIsAccepted) {
    const Bytes rgb(3 * 2048 * 2048, 77);
    EXPECT_EQ(decoded_picture(png_of(rgb, 2048, 2048, PNG_FORMAT_RGB), "/image").width, 2048);
}

TEST(Codecs, LargerImagesAreRefusedByTheirHeaderAlone) {
    const Bytes wide(3 * 2049 * 2, 77);
    const std::string too_wide = "the image is 2049 x 2 pixels; at most 2048 x 2048 are allowed";
    EXPECT_EQ(refusal(png_of(wide, 2049, 2, PNG_FORMAT_RGB)), too_wide);
    EXPECT_EQ(refusal(jpeg(wide, 2049, 2, 90, Chroma::full)), too_wide);
    EXPECT_EQ(refusal(webp_of(wide, 2049, 2)), too_wide);
}

TEST(Codecs, ADecompressionBombIsRefusedBeforeItsPixelsAreDecoded) {
    // The header declares 60000 x 60000 pixels, 10 GB that must not be allocated.
    Bytes bomb = png_of(slope(8, 8), 8, 8, PNG_FORMAT_RGB);
    const std::uint8_t side[4] = {0, 0, 0xEA, 0x60};
    std::memcpy(&bomb[16], side, 4);
    std::memcpy(&bomb[20], side, 4);
    // The checksum of the header chunk is recomputed.
    std::uint32_t crc = 0xFFFFFFFFU;
    for (std::size_t i = 12; i < 29; ++i) {
        crc ^= bomb[i];
        for (int bit = 0; bit < 8; ++bit)
            crc = (crc & 1U) != 0 ? (crc >> 1U) ^ 0xEDB88320U : crc >> 1U;
    }
    crc = ~crc;
    for (std::size_t i = 0; i < 4; ++i)
        bomb[29 + i] = static_cast<std::uint8_t>(crc >> (24 - 8 * i));
    EXPECT_EQ(refusal(bomb), "the image is 60000 x 60000 pixels; at most 2048 x 2048 are allowed");
}

TEST(Codecs, AJpegWithTooManyScansIsRefused) {
    Bytes file = jpeg(slope(16, 16), 16, 16, 90, Chroma::full);
    for (int i = 0; i < 100; ++i) file.insert(file.end(), {0xFF, 0xDA});
    EXPECT_EQ(refusal(file), "the JPEG file has too many scans");
}

TEST(Codecs, WebpReproducesASlopeInFewerBytesThanJpeg) {
    const Bytes rgb = slope(256, 128);
    const Bytes file = webp(rgb, 256, 128, 80);
    EXPECT_EQ(webp(rgb, 256, 128, 80), file);
    EXPECT_LT(file.size(), jpeg(rgb, 256, 128, 88, Chroma::halved).size());
    const Picture decoded = decoded_picture(file, "/surface/cap/image");
    ASSERT_EQ(decoded.width, 256);
    ASSERT_EQ(decoded.height, 128);
    for (std::size_t i = 0; i < rgb.size(); ++i)
        ASSERT_LE(std::abs(int{decoded.rgb[i]} - int{rgb[i]}), 12) << i;
}

TEST(Codecs, WebpRefusesWhatItCannotHold) {
    EXPECT_THROW((void)webp({}, 0, 0, 80), GenerationError);
    const Bytes row(3 * 20000);
    EXPECT_THROW((void)webp(row, 20000, 1, 80), GenerationError) << "at most 16383 texels wide";
    EXPECT_THROW((void)webp(row, 100, 1, 101), GenerationError);
}

TEST(Codecs, WebPWithAlphaKeepsItExactlyAndColoursWhereThereIsNone) {
    constexpr int side = 48;
    const Bytes rgb = slope(side, side);
    Bytes rgba;
    for (std::size_t i = 0; i < rgb.size() / 3; ++i) {
        rgba.insert(rgba.end(), rgb.begin() + static_cast<long>(3 * i),
                    rgb.begin() + static_cast<long>(3 * i + 3));
        rgba.push_back(i % side < side / 2 ? 0 : static_cast<std::uint8_t>(i % 256));
    }
    const Bytes file = webp_with_alpha(rgba, side, side, 80);
    Bytes found(rgba.size());
    ASSERT_NE(WebPDecodeRGBAInto(file.data(), file.size(), found.data(), found.size(), 4 * side),
              nullptr);
    int worst = 0;
    for (std::size_t i = 0; i < rgba.size(); i += 4) {
        ASSERT_EQ(found[i + 3], rgba[i + 3]);
        for (std::size_t c = 0; c < 3; ++c)
            worst = std::max(worst, std::abs(found[i + c] - rgba[i + c]));
    }
    EXPECT_LT(worst, 24) << "black in place of a colour would be a dark fringe";
}

}  // namespace
}  // namespace sporeprint::surface_codecs_test
