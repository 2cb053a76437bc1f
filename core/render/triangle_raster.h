// Rasterisation of triangles by edge functions in fixed point: adjacent triangles share no pixel
// centre and leave none out.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace sporeprint::render {

/// A corner in an image: x to the right, y down, in pixels; depth grows towards the viewer and is
/// linear in x and y.
struct Corner {
    float x = 0.0F, y = 0.0F, depth = 0.0F;
};

/// Largest width and height of an image that is rasterised, pixels.
inline constexpr int largest_raster_side = 2048;

/// A corner in units of 1/16 pixel, relative to pixel centres, and its depth.
struct SnappedCorner {
    std::int32_t x = 0, y = 0;
    float depth = 0.0F;
};

/// Rounds a corner to 1/16 pixel: with this, edge functions fit 32 bits for every image of at most
/// largest_raster_side pixels.
[[nodiscard]] inline SnappedCorner snapped(const Corner& corner) {
    const auto fixed = [](float v) {
        const float within = std::min(std::max(v, 0.0F), static_cast<float>(largest_raster_side));
        return static_cast<std::int32_t>(within * 16.0F + 0.5F) - 8;
    };
    return {fixed(corner.x), fixed(corner.y), corner.depth};
}

/// Calls `plot(x, y, depth)` for each pixel centre inside a triangle of clockwise corners, as seen
/// with y down, which is the image of a counter-clockwise one; others are left out. A centre on a common edge of two triangles
/// belongs to one of them.
///
/// width, height  of the image, at most largest_raster_side
/// first_row      those above it are left out
template <class Plot>
void rasterize(const SnappedCorner& a, const SnappedCorner& b, const SnappedCorner& c, int width,
               int height, Plot&& plot, int first_row = 0) {
    const std::int32_t area = (c.x - a.x) * (b.y - a.y) - (c.y - a.y) * (b.x - a.x);
    if (area <= 0) return;
    const int first_x = std::max((std::min({a.x, b.x, c.x}) + 15) >> 4, 0);
    const int first_y = std::max((std::min({a.y, b.y, c.y}) + 15) >> 4, first_row);
    const int last_x = std::min(std::max({a.x, b.x, c.x}) >> 4, width - 1);
    const int last_y = std::min(std::max({a.y, b.y, c.y}) >> 4, height - 1);
    if (first_x > last_x || first_y > last_y) return;

    // The function of an edge is positive inside; zero belongs to the triangle for left and upper
    // edges alone.
    struct Edge {
        std::int32_t step_x, step_y, at;
    };
    const auto edge = [&](const SnappedCorner& from, const SnappedCorner& to) {
        const std::int32_t dx = to.x - from.x, dy = to.y - from.y;
        const bool has_border = dy > 0 || (dy == 0 && dx < 0);
        return Edge{
            dy * 16, -dx * 16,
            (16 * first_x - from.x) * dy - (16 * first_y - from.y) * dx - (has_border ? 0 : 1)};
    };
    Edge ab = edge(a, b), bc = edge(b, c), ca = edge(c, a);

    const float scale = 1.0F / static_cast<float>(area);
    const auto ab_x = static_cast<float>(b.x - a.x), ab_y = static_cast<float>(b.y - a.y);
    const auto ac_x = static_cast<float>(c.x - a.x), ac_y = static_cast<float>(c.y - a.y);
    const float ab_depth = b.depth - a.depth, ac_depth = c.depth - a.depth;
    const float slope_x = (ac_depth * ab_y - ab_depth * ac_y) * scale;
    const float slope_y = (ab_depth * ac_x - ac_depth * ab_x) * scale;
    for (int y = first_y; y <= last_y; ++y) {
        std::int32_t in_ab = ab.at, in_bc = bc.at, in_ca = ca.at;
        const float row = a.depth + slope_y * static_cast<float>(16 * y - a.y);
        for (int x = first_x; x <= last_x; ++x) {
            if ((in_ab | in_bc | in_ca) >= 0)
                plot(x, y, row + slope_x * static_cast<float>(16 * x - a.x));
            in_ab += ab.step_x;
            in_bc += bc.step_x;
            in_ca += ca.step_x;
        }
        ab.at += ab.step_y;
        bc.at += bc.step_y;
        ca.at += ca.step_y;
    }
}

}  // namespace sporeprint::render
