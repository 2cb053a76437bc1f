#include "core/trace/geodesic.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "core/trace/max_flow.h"

namespace sporeprint::trace_geodesic_test {
namespace {

Picture paper(int width, int height, std::uint8_t grey) {
    return {width, height,
            Bytes(3 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height), grey)};
}

TEST(Geodesics, OnPlainPaperAreStraightAndDiagonalSteps) {
    const Picture photo = paper(40, 30, 90);
    EXPECT_EQ(trace::contrast_scale(photo), 0.0);
    trace::Mask stroke(40, 30);
    stroke.inside[stroke.index(12, 9)] = 1;
    const trace::Geodesics found = trace::geodesics_from(stroke, photo, 0.0);
    for (int y = 0; y < 30; ++y)
        for (int x = 0; x < 40; ++x) {
            const int dx = std::abs(x - 12), dy = std::abs(y - 9);
            const double steps = std::max(dx, dy) + (std::sqrt(2.0) - 1.0) * std::min(dx, dy);
            EXPECT_NEAR(found.distance[stroke.index(x, y)], std::sqrt(0.3) * steps, 1e-9);
        }
}

TEST(Geodesics, GoRoundAnEdge) {
    // A black wall with a gap at its lower end.
    Picture photo = paper(61, 61, 200);
    const trace::Mask shape(61, 61);
    for (int y = 0; y < 55; ++y)
        for (std::size_t c = 0; c < 3; ++c) photo.rgb[3 * shape.index(30, y) + c] = 0;
    trace::Mask stroke(61, 61);
    stroke.inside[stroke.index(26, 51)] = 1;
    const trace::Geodesics found =
        trace::geodesics_from(stroke, photo, trace::contrast_scale(photo));
    int x = 34, y = 51, lowest = y;
    while (found.towards[shape.index(x, y)] != trace::Geodesics::none) {
        const auto& step = trace::grid_steps[found.towards[shape.index(x, y)]];
        x += step[0];
        y += step[1];
        lowest = std::max(lowest, y);
    }
    EXPECT_TRUE(stroke.at(x, y));
    EXPECT_EQ(lowest, 55);
}

RC_GTEST_PROP(Geodesics, FallAlongTheirWays, ()) {
    Picture photo = paper(*rc::gen::inRange(2, 20), *rc::gen::inRange(2, 20), 0);
    for (std::uint8_t& value : photo.rgb) value = *rc::gen::inRange<std::uint8_t>(0, 255);
    trace::Mask stroke(photo.width, photo.height);
    stroke.inside[*rc::gen::inRange<std::size_t>(0, stroke.inside.size())] = 1;
    const trace::Geodesics found =
        trace::geodesics_from(stroke, photo, trace::contrast_scale(photo));
    for (int y = 0; y < photo.height; ++y)
        for (int x = 0; x < photo.width; ++x) {
            const std::size_t at = stroke.index(x, y);
            RC_ASSERT((found.towards[at] == trace::Geodesics::none) == stroke.at(x, y));
            if (stroke.at(x, y)) continue;
            const auto& step = trace::grid_steps[found.towards[at]];
            RC_ASSERT(found.distance[stroke.index(x + step[0], y + step[1])] < found.distance[at]);
        }
}

}  // namespace
}  // namespace sporeprint::trace_geodesic_test
