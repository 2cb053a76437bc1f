#include "core/trace/photo.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <string_view>
#include <vector>

namespace sporeprint::trace_photo_test {
namespace {

using trace::Mask;

Mask mask_of(const std::vector<std::string_view>& rows) {
    Mask mask(static_cast<int>(rows[0].size()), static_cast<int>(rows.size()));
    for (int y = 0; y < mask.height; ++y)
        for (int x = 0; x < mask.width; ++x)
            mask.inside[mask.index(x, y)] =
                rows[static_cast<std::size_t>(y)][static_cast<std::size_t>(x)] == '#' ? 1 : 0;
    return mask;
}

Mask any_mask() {
    Mask mask(*rc::gen::inRange(1, 12), *rc::gen::inRange(1, 12));
    for (std::uint8_t& value : mask.inside) value = *rc::gen::inRange<std::uint8_t>(0, 2);
    return mask;
}

bool is_within(const Mask& inner, const Mask& outer) {
    for (std::size_t i = 0; i < inner.inside.size(); ++i)
        if (inner.inside[i] > outer.inside[i]) return false;
    return true;
}

RC_GTEST_PROP(Reduced, KeepsTheMeanColour, ()) {
    Picture photo{*rc::gen::inRange(1, 90), *rc::gen::inRange(1, 90), {}};
    photo.rgb.resize(3 * static_cast<std::size_t>(photo.width * photo.height));
    for (std::uint8_t& value : photo.rgb) value = *rc::gen::inRange<std::uint8_t>(0, 255);
    const int side = *rc::gen::inRange(1, 60);
    const Picture copy = trace::reduced(photo, side);
    RC_ASSERT(std::max(copy.width, copy.height) ==
              std::min(side, std::max(photo.width, photo.height)));
    RC_ASSERT(copy.rgb.size() == 3 * static_cast<std::size_t>(copy.width * copy.height));
    const auto mean = [](const Picture& of) {
        double sum = 0.0;
        for (const std::uint8_t value : of.rgb) sum += value;
        return sum / static_cast<double>(of.rgb.size());
    };
    // Every pixel is rounded to a whole number.
    RC_ASSERT(std::abs(mean(copy) - mean(photo)) <= 0.51);
}

TEST(Reduced, LeavesASmallPhotographAsItIs) {
    const Picture photo{2, 1, {1, 2, 3, 4, 5, 6}};
    EXPECT_EQ(trace::reduced(photo, 2).rgb, photo.rgb);
    EXPECT_EQ(trace::reduced(photo, 1).rgb, (Bytes{3, 4, 5}));
}

TEST(ReducedSize, HasTheShapeOfTheOriginal) {
    const auto is = [](const trace::PictureSize& size, int width, int height) {
        return size.width == width && size.height == height;
    };
    EXPECT_TRUE(is(trace::reduced_size(2048, 1365, 1024), 1024, 683));
    EXPECT_TRUE(is(trace::reduced_size(800, 1000, 1024), 800, 1000));
    EXPECT_TRUE(is(trace::reduced_size(1, 4000, 100), 1, 100));
}

TEST(Masks, ConnectByEdgesNotByCorners) {
    const Mask mask = mask_of({"##..", "..##", "#..."});
    EXPECT_EQ(trace::connected_with(mask, mask_of({"#...", "....", "...."})),
              mask_of({"##..", "....", "...."}));
    EXPECT_EQ(trace::connected_with(mask, mask_of({"...#", "#...", "...."})).area(), 0U);
}

TEST(Masks, FillHolesButNotBays) {
    EXPECT_EQ(trace::without_holes(mask_of({"####.", "#..#.", "####.", "#.##."})),
              mask_of({"####.", "####.", "####.", "#.##."}));
}

TEST(Masks, HaveALargestPart) {
    EXPECT_EQ(trace::largest_part(mask_of({"##..#", "..###", "#...."})),
              mask_of({"....#", "..###", "....."}));
    // Of two as large, the upper one.
    EXPECT_EQ(trace::largest_part(mask_of({"..##.", ".....", "##..."})),
              mask_of({"..##.", ".....", "....."}));
    EXPECT_EQ(trace::largest_part(mask_of({"...", "..."})).area(), 0U);
}

TEST(Masks, LoseSpursThatAreThinnerThanThreePixels) {
    EXPECT_EQ(trace::opened(mask_of({"###..", "###..", "#####", "..#.."})),
              mask_of({"###..", "###..", "###..", "....."}));
}

RC_GTEST_PROP(Masks, OpenedAreTheUnionOfTheSquaresInside, ()) {
    const Mask mask = any_mask();
    const int reach = *rc::gen::inRange(1, 4);
    Mask expected(mask.width, mask.height);
    const auto square = [&](int x, int y, const auto& visit) {
        for (int v = y - reach; v <= y + reach; ++v)
            for (int u = x - reach; u <= x + reach; ++u) visit(u, v);
    };
    for (int y = 0; y < mask.height; ++y)
        for (int x = 0; x < mask.width; ++x) {
            bool all = true;
            square(x, y, [&](int u, int v) { all = all && mask.at(u, v); });
            if (all) square(x, y, [&](int u, int v) { expected.inside[expected.index(u, v)] = 1; });
        }
    RC_ASSERT(trace::opened(mask, reach) == expected);
}

RC_GTEST_PROP(Masks, AreWithinOrAroundWhatTheyCameFrom, ()) {
    const Mask mask = any_mask(), seeds = [&] {
        Mask other = mask;
        for (std::uint8_t& value : other.inside) value = *rc::gen::inRange<std::uint8_t>(0, 2);
        return other;
    }();
    RC_ASSERT(trace::inverted(trace::inverted(mask)) == mask);
    RC_ASSERT(trace::inverted(mask).area() == mask.inside.size() - mask.area());
    RC_ASSERT(is_within(trace::opened(mask), mask));
    RC_ASSERT(trace::opened(trace::opened(mask)) == trace::opened(mask));
    RC_ASSERT(is_within(mask, trace::without_holes(mask)));
    RC_ASSERT(trace::without_holes(trace::without_holes(mask)) == trace::without_holes(mask));
    const Mask part = trace::connected_with(mask, seeds), largest = trace::largest_part(mask);
    RC_ASSERT(is_within(largest, mask));
    RC_ASSERT(trace::largest_part(largest) == largest);
    RC_ASSERT((largest.area() > 0) == (mask.area() > 0));
    RC_ASSERT(is_within(part, mask));
    RC_ASSERT(trace::connected_with(mask, part) == part);
    RC_ASSERT(trace::resized(mask, mask.width, mask.height) == mask);
    RC_ASSERT(trace::resized(mask, 2 * mask.width, 3 * mask.height).area() == 6 * mask.area());
}

}  // namespace
}  // namespace sporeprint::trace_photo_test
