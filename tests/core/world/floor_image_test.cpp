#include "core/world/floor_image.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <string>
#include <thread>
#include <vector>

#include "core/math/noise.h"
#include "core/problems.h"
#include "tests/support/atlas.h"

namespace sporeprint::world_floor_image_test {
namespace {

std::vector<LeafLitter> litter() {
    std::vector<LeafLitter> kinds;
    for (const char* id : {"oak", "birch", "needle"}) {
        const LeafPreset* const preset = atlas().find_leaf(id);
        kinds.push_back({preset->shape, preset->palette});
    }
    return kinds;
}

/// Returns a cover that has all there is, in other shares from place to place.
Cover mixed(double x, double y) {
    CoverConditions at;
    at.light = 0.3 + 0.03 * x;
    at.wetness = 0.5 + 0.04 * y;
    at.fall = {0.3, 0.2, 0.3};
    at.has_needles[2] = true;
    at.day = 130;
    at.stream = x > 4.0 && y > 1.0 ? 0.6 : 0.0;
    return cover_of(at);
}

RawImages painted(const WorldBox& box, int side, const CoverField& field,
                  const Parallel& parallel = in_turn) {
    const std::vector<LeafLitter> kinds = litter();
    return floor_images({7, box, side, 0.5, 130, kinds, &field}, parallel);
}

std::array<std::uint8_t, 3> texel_of(const RawImages& images, ImageKind kind, int column, int row) {
    const Bytes& image = images.rgb[static_cast<std::size_t>(kind)];
    const std::size_t at =
        3 * (static_cast<std::size_t>(row) * static_cast<std::size_t>(images.side) +
             static_cast<std::size_t>(column));
    return {image[at], image[at + 1], image[at + 2]};
}

constexpr std::array all_kinds = {ImageKind::base_color, ImageKind::normal, ImageKind::orm};

TEST(FloorImages, OfNeighboursHaveTheSameBorder) {
    constexpr int side = 256;
    const WorldBox here{2.0, -2.0, 5.0, 1.0}, east{5.0, -2.0, 8.0, 1.0}, north{2.0, 1.0, 5.0, 4.0};
    const RawImages own = painted(here, side, cover_field(here, floor_margin, mixed)),
                    to_east = painted(east, side, cover_field(east, floor_margin, mixed)),
                    to_north = painted(north, side, cover_field(north, floor_margin, mixed));
    for (const ImageKind kind : all_kinds)
        for (int i = 0; i < side; ++i) {
            EXPECT_EQ(texel_of(own, kind, side - 1, i), texel_of(to_east, kind, 0, i)) << i;
            EXPECT_EQ(texel_of(own, kind, i, 0), texel_of(to_north, kind, i, side - 1)) << i;
        }
}

// Coordinates in the largest world are near the greatest that they can be.
TEST(FloorImages, OfNeighboursInTheCornerOfAWorldHaveTheSameBorder) {
    constexpr int side = 128;
    const auto cover = [](double x, double y) { return mixed(x - 2040.0, y - 2040.0); };
    const WorldBox here{2040.0, 2044.0, 2044.0, 2048.0}, east{2044.0, 2044.0, 2048.0, 2048.0};
    const RawImages own = painted(here, side, cover_field(here, floor_margin, cover)),
                    to_east = painted(east, side, cover_field(east, floor_margin, cover));
    for (const ImageKind kind : all_kinds)
        for (int i = 0; i < side; ++i)
            EXPECT_EQ(texel_of(own, kind, side - 1, i), texel_of(to_east, kind, 0, i)) << i;
}

TEST(FloorImages, AreTheSameWithEveryInstructionSet) {
    // Rows of a width that no vector divides.
    const WorldBox box{2.0, -2.0, 5.0, 1.0};
    const CoverField field = cover_field(box, floor_margin, mixed);
    const RawImages first = painted(box, 251, field);
    for (const std::string& name : simd_names()) {
        force_simd(name);
        EXPECT_EQ(painted(box, 251, field).rgb, first.rgb) << name;
    }
    force_simd("auto");
}

TEST(FloorImages, DoNotDependOnTheOrderOfTasks) {
    const WorldBox box{-2.0, -2.0, 2.0, 2.0};
    const CoverField field = cover_field(box, floor_margin, mixed);
    const RawImages forwards = painted(box, 512, field);
    const RawImages backwards =
        painted(box, 512, field, [](std::span<const std::function<void()>> tasks) {
            for (std::size_t i = tasks.size(); i-- > 0;) tasks[i]();
        });
    EXPECT_EQ(forwards.rgb, backwards.rgb);
}

TEST(FloorImages, AreOfAFloor) {
    const WorldBox box{-2.0, -2.0, 2.0, 2.0};
    const RawImages images = painted(box, 256, cover_field(box, floor_margin, mixed));
    double length = 0.0, up = 0.0;
    std::array<double, 3> colour{};
    for (int row = 0; row < images.side; ++row)
        for (int column = 0; column < images.side; ++column) {
            const auto normal = texel_of(images, ImageKind::normal, column, row);
            const auto orm = texel_of(images, ImageKind::orm, column, row);
            const auto base = texel_of(images, ImageKind::base_color, column, row);
            double square = 0.0;
            for (const std::uint8_t channel : normal)
                square += std::pow(channel / 127.5 - 1.0, 2.0);
            length = std::max(length, std::abs(std::sqrt(square) - 1.0));
            up += normal[2] / 127.5 - 1.0;
            EXPECT_EQ(orm[2], 0) << "nothing is of metal";
            for (std::size_t k = 0; k < 3; ++k) colour[k] += base[k];
        }
    EXPECT_LT(length, 0.02) << "normals have length 1";
    EXPECT_GT(up / (images.side * images.side), 0.8) << "the floor looks up";
    EXPECT_GT(colour[0], colour[2]) << "brown and green are warm";
    EXPECT_GT(colour[1], colour[2]);
}

TEST(FloorImages, AreGreenOfGrassAndBrownOfLeaves) {
    const auto ratio = [](double light, double fall) {
        const WorldBox box{-1.0, -1.0, 1.0, 1.0};
        const auto cover = [&](double, double) {
            CoverConditions at;
            at.light = light;
            at.wetness = 0.2;
            at.day = 335;
            at.fall[0] = fall;
            return cover_of(at);
        };
        const RawImages images = painted(box, 128, cover_field(box, floor_margin, cover));
        double red = 0.0, green = 0.0;
        for (std::size_t i = 0; i < images.rgb[0].size(); i += 3) {
            red += images.rgb[0][i];
            green += images.rgb[0][i + 1];
        }
        return green / red;
    };
    EXPECT_GT(ratio(1.0, 0.0), 1.05);
    EXPECT_LT(ratio(0.05, 1.0), 0.85);
}

TEST(FloorImages, RefuseWhatTheyCannotPaint) {
    const WorldBox box{-1.0, -1.0, 1.0, 1.0};
    const CoverField field = cover_field(box, floor_margin, mixed);
    EXPECT_THROW(static_cast<void>(painted(box, 15, field)), InvalidInput);
    EXPECT_THROW(static_cast<void>(painted(box, 4097, field)), InvalidInput);
    EXPECT_THROW(static_cast<void>(painted(box, 64, CoverField{})), InvalidInput);
}

}  // namespace
}  // namespace sporeprint::world_floor_image_test
