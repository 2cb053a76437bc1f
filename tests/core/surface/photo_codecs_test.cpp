#include "core/surface/photo_codecs.h"

#include <gtest/gtest.h>
#include <png.h>
#include <turbojpeg.h>
#include <webp/encode.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <memory>
#include <string>
#include <vector>

#include "core/surface/codecs.h"
#include "tests/support/refusals.h"

namespace sporeprint::surface_photo_codecs_test {
namespace {

/// A picture whose corners are red, green, blue and white from the upper left clockwise.
Picture corners(int width, int height) {
    Picture picture{width, height, {}};
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const bool right = 2 * x >= width, lower = 2 * y >= height;
            const std::array<int, 3> colour = !right && !lower  ? std::array{220, 20, 20}
                                              : right && !lower ? std::array{20, 200, 20}
                                              : right           ? std::array{20, 20, 220}
                                                                : std::array{240, 240, 240};
            for (const int value : colour) picture.rgb.push_back(static_cast<std::uint8_t>(value));
        }
    return picture;
}

/// Returns the colour of a corner of a picture as a letter.
char corner(const Picture& picture, bool right, bool lower) {
    const auto x = static_cast<std::size_t>(right ? 3 * picture.width / 4 : picture.width / 4),
               y = static_cast<std::size_t>(lower ? 3 * picture.height / 4 : picture.height / 4);
    const std::uint8_t* rgb = &picture.rgb[3 * (y * static_cast<std::size_t>(picture.width) + x)];
    return rgb[0] > 128 ? (rgb[1] > 128 ? 'w' : 'r') : rgb[1] > 128 ? 'g' : 'b';
}

std::string clockwise(const Picture& picture) {
    return {corner(picture, false, false), corner(picture, true, false),
            corner(picture, true, true), corner(picture, false, true)};
}

/// Returns a JPEG file with Exif data that states an orientation and a place on earth.
Bytes with_exif(Bytes jpeg, int orientation, bool is_little) {
    Bytes tiff;
    const auto put = [&](std::uint32_t value, int bytes) {
        for (int i = 0; i < bytes; ++i)
            tiff.push_back(static_cast<std::uint8_t>(
                value >> static_cast<unsigned>(8 * (is_little ? i : bytes - 1 - i))));
    };
    tiff = is_little ? Bytes{'I', 'I'} : Bytes{'M', 'M'};
    put(42, 2);
    put(8, 4);
    put(3, 2);
    for (const auto& [tag, value] : std::vector<std::pair<std::uint32_t, std::uint32_t>>{
             {0x0100, 1}, {0x0112, static_cast<std::uint32_t>(orientation)}, {0x8825, 50}}) {
        put(tag, 2);
        put(3, 2);
        put(1, 4);
        put(value, 2);
        put(0, 2);
    }
    put(0, 4);
    Bytes segment = {0xFF, 0xE1, 0, static_cast<std::uint8_t>(tiff.size() + 8), 'E', 'x', 'i',
                     'f',  0,    0};
    segment.insert(segment.end(), tiff.begin(), tiff.end());
    jpeg.insert(jpeg.begin() + 2, segment.begin(), segment.end());
    return jpeg;
}

Bytes jpeg_of(const Picture& picture) {
    return jpeg(picture.rgb, picture.width, picture.height, 92, Chroma::full);
}

TEST(PhotoCodecs, IsUprightInEachOfTheEightOrientations) {
    // The corners that the upper left, upper right, lower right and lower left of the seen picture show.
    const std::array<std::string, 8> seen = {"rgbw", "grwb", "bwrg", "wbgr",
                                             "rwbg", "wrgb", "bgrw", "gbwr"};
    const Bytes file = jpeg_of(corners(64, 32));
    for (int orientation = 1; orientation <= 8; ++orientation)
        for (const bool is_little : {true, false}) {
            const Bytes turned = with_exif(file, orientation, is_little);
            EXPECT_EQ(orientation_of(turned), orientation);
            const Picture picture = decoded_layers(turned, 2048, "/photo").picture;
            EXPECT_EQ(clockwise(picture), seen[static_cast<std::size_t>(orientation - 1)])
                << orientation;
            EXPECT_EQ(picture.width, orientation < 5 ? 64 : 32);
        }
}

TEST(PhotoCodecs, WithoutValidExifIsAsItIsStored) {
    const Bytes file = jpeg_of(corners(64, 32));
    EXPECT_EQ(orientation_of(file), 1);
    for (const int wrong : {0, 9, 255}) EXPECT_EQ(orientation_of(with_exif(file, wrong, true)), 1);
    Bytes cut = with_exif(file, 6, true);
    for (std::size_t length = 0; length < 80; ++length)
        EXPECT_LE(orientation_of({cut.data(), length}), 8);
    // A directory beyond the data.
    cut[2 + 10 + 4] = 200;
    EXPECT_EQ(orientation_of(cut), 1);
}

TEST(PhotoCodecs, TurnedTwiceIsTheSame) {
    const Picture picture = corners(10, 6);
    for (const int orientation : {2, 3, 4, 5, 7})
        EXPECT_EQ(upright(upright(picture, orientation), orientation).rgb, picture.rgb);
    EXPECT_EQ(upright(upright(picture, 6), 8).rgb, picture.rgb);
}

TEST(PhotoCodecs, IsMadeSmallerWhereItIsLarge) {
    const Picture large = decoded_layers(jpeg_of(corners(5000, 3000)), 2048, "/photo").picture;
    EXPECT_EQ(large.width, 1250);
    EXPECT_EQ(large.height, 750);
    EXPECT_EQ(clockwise(large), "rgbw");
    EXPECT_EQ(decoded_layers(jpeg_of(corners(2048, 20)), 2048, "/photo").picture.width, 2048);
}

Bytes webp_of(const Bytes& rgba, int width, int height) {
    std::uint8_t* out = nullptr;
    const std::size_t size = WebPEncodeLosslessRGBA(rgba.data(), width, height, 4 * width, &out);
    const Bytes file(out, out + size);
    WebPFree(out);
    return file;
}

TEST(PhotoCodecs, GiveAlphaAndShowWhitePaperThroughIt) {
    Bytes rgba;
    for (int i = 0; i < 40 * 40; ++i) {
        const bool inside = i % 40 >= 10 && i % 40 < 30;
        rgba.insert(rgba.end(), {200, 30, 30, static_cast<std::uint8_t>(inside ? 255 : 0)});
    }
    for (const Bytes& file : {png(rgba, 40, 40), webp_of(rgba, 40, 40)}) {
        const LayeredPicture photo = decoded_layers(file, 2048, "/photo");
        ASSERT_EQ(photo.alpha.size(), 1600U);
        EXPECT_EQ(photo.alpha[5 * 40 + 9], 0);
        EXPECT_EQ(photo.alpha[5 * 40 + 10], 255);
        EXPECT_EQ(photo.picture.rgb[0], 255);
        EXPECT_EQ(photo.picture.rgb[3 * 15], 200);
    }
}

std::vector<Problem> refusal_of(const Bytes& file) {
    return refusal([&] { static_cast<void>(decoded_layers(file, 2048, "/photo")); });
}

TEST(PhotoCodecs, RefusesWhatIsNoPhotograph) {
    EXPECT_TRUE(names(refusal_of({}), "/photo", "neither a JPEG"));
    EXPECT_TRUE(names(refusal_of({'G', 'I', 'F', '8', '9', 'a'}), "/photo", "neither a JPEG"));
    EXPECT_TRUE(names(refusal_of(Bytes(most_photo_bytes + 1, 0xFF)), "/photo", "at most 12582912"));
    Bytes scans = jpeg_of(corners(16, 16));
    for (int i = 0; i < 100; ++i) scans.insert(scans.end(), {0xFF, 0xDA});
    EXPECT_TRUE(names(refusal_of(scans), "/photo", "too many scans"));
}

TEST(PhotoCodecs, NamesFilesThatEndEarly) {
    Bytes rgba;
    rgba.reserve(4UL * 64 * 64);
    for (int i = 0; i < 4 * 64 * 64; ++i) rgba.push_back(static_cast<std::uint8_t>(i * 37 % 251));
    Bytes rgb;
    rgb.reserve(3UL * 64 * 64);
    for (int i = 0; i < 3 * 64 * 64; ++i) rgb.push_back(static_cast<std::uint8_t>(i * 37 % 251));
    const auto first = [](const Bytes& file, std::size_t count) {
        return Bytes(file.begin(), file.begin() + static_cast<std::ptrdiff_t>(count));
    };
    const Bytes photo = jpeg(rgb, 64, 64, 90, Chroma::full), drawing = png(rgba, 64, 64);
    for (const double share : {0.5, 0.8, 0.95}) {
        const auto part = [share](const Bytes& file) {
            return static_cast<std::size_t>(share * static_cast<double>(file.size()));
        };
        EXPECT_TRUE(
            names(refusal_of(first(photo, part(photo))), "/photo", "the JPEG file ends early"))
            << share;
        EXPECT_TRUE(
            names(refusal_of(first(drawing, part(drawing))), "/photo", "the PNG file ends early"))
            << share;
    }
    // Some cameras leave the mark of the end out.
    EXPECT_TRUE(refusal_of(first(photo, photo.size() - 2)).empty());
    EXPECT_EQ(decoded_layers(first(photo, photo.size() - 2), 64, "").picture.rgb,
              decoded_layers(photo, 64, "").picture.rgb);
    const Bytes webp = webp_of(rgba, 64, 64);
    EXPECT_TRUE(refusal_of(webp).empty());
    EXPECT_TRUE(
        names(refusal_of(first(webp, webp.size() / 2)), "/photo", "the WebP file ends early"));
}

TEST(PhotoCodecs, RefusesTheColoursOfPrint) {
    const std::unique_ptr<void, int (*)(void*)> handle(tjInitCompress(), tjDestroy);
    const Bytes cmyk(4UL * 16 * 16, 90);
    unsigned char* out = nullptr;
    unsigned long size = 0;
    ASSERT_EQ(tjCompress2(handle.get(), cmyk.data(), 16, 0, 16, TJPF_CMYK, &out, &size, TJSAMP_444,
                          90, 0),
              0);
    const Bytes file(out, out + size);
    tjFree(out);
    EXPECT_TRUE(names(refusal_of(file), "/photo", "the colours of print (CMYK)"));
}

TEST(PhotoCodecs, RefusesAnAnimatedPngFile) {
    Bytes file = png(Bytes(4 * 8 * 8, 255), 8, 8);
    // After the header of 8 bytes and the first chunk of 25: two frames, played for ever.
    const Bytes control = {0, 0, 0, 8, 'a', 'c', 'T',  'L',  0,    0,
                           0, 2, 0, 0, 0,   0,   0xF3, 0x8D, 0x93, 0x70};
    file.insert(file.begin() + 33, control.begin(), control.end());
    EXPECT_TRUE(names(refusal_of(file), "/photo", "an animated PNG file is not a photograph"));
}

TEST(PhotoCodecs, RefusesBombsByTheirHeader) {
    // The frame header of a JPEG file: height and width follow the marker, length and precision.
    Bytes bomb = jpeg_of(corners(16, 16));
    for (std::size_t i = 0; i + 9 < bomb.size(); ++i)
        if (bomb[i] == 0xFF && bomb[i + 1] == 0xC0) {
            for (const std::size_t at : {i + 5, i + 7}) {
                bomb[at] = 0xFA;
                bomb[at + 1] = 0xFA;
            }
            break;
        }
    EXPECT_TRUE(names(refusal_of(bomb), "/photo", "64250 x 64250"));
    Bytes rgba(4 * 8 * 8, 255);
    Bytes file = png(rgba, 8, 8);
    const auto declare = [&](std::uint32_t side, bool interlaced) {
        Bytes changed = file;
        for (std::size_t i = 0; i < 4; ++i)
            changed[16 + i] = changed[20 + i] = static_cast<std::uint8_t>(side >> (24 - 8 * i));
        changed[28] = interlaced ? 1 : 0;
        return changed;
    };
    EXPECT_TRUE(names(refusal_of(declare(60000, false)), "/photo", "60000 x 60000"));
    EXPECT_TRUE(names(refusal_of(declare(11000, false)), "/photo", "25000000"));
    EXPECT_TRUE(names(refusal_of(declare(3000, true)), "/photo", "an interlaced PNG"));
}

}  // namespace
}  // namespace sporeprint::surface_photo_codecs_test
