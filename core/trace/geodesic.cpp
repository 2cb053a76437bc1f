#include "core/trace/geodesic.h"

#include <algorithm>
#include <cmath>
#include <queue>
#include <utility>

#include "core/trace/max_flow.h"

namespace sporeprint::trace {

double colour_difference(const Picture& photo, std::size_t a, std::size_t b) {
    double sum = 0.0;
    for (std::size_t c = 0; c < 3; ++c) {
        const double apart = static_cast<double>(photo.rgb[3 * a + c]) - photo.rgb[3 * b + c];
        sum += apart * apart;
    }
    return sum;
}

double contrast_scale(const Picture& photo) {
    const Mask shape(photo.width, photo.height);
    double sum = 0.0, pairs = 0.0;
    for (int y = 0; y < photo.height; ++y)
        for (int x = 0; x < photo.width; ++x)
            for (std::size_t step = 4; step < 8; ++step) {
                const int u = x + grid_steps[step][0], v = y + grid_steps[step][1];
                if (u < 0 || u >= photo.width || v >= photo.height) continue;
                sum += colour_difference(photo, shape.index(x, y), shape.index(u, v));
                pairs += 1.0;
            }
    return sum > 0.0 ? pairs / (2.0 * sum) : 0.0;
}

Geodesics geodesics_from(const Mask& strokes, const Picture& photo, double beta) {
    constexpr double far = 1e18, plain = 0.3, across = 0.7, most = 50.0;
    const std::size_t count = strokes.inside.size();
    Geodesics found{std::vector<double>(count, far),
                    std::vector<std::uint8_t>(count, Geodesics::none)};
    using Entry = std::pair<double, std::uint32_t>;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
    for (std::size_t i = 0; i < count; ++i) {
        if (strokes.inside[i] == 0) continue;
        found.distance[i] = 0.0;
        open.emplace(0.0, static_cast<std::uint32_t>(i));
    }
    while (!open.empty()) {
        const auto [distance, at] = open.top();
        open.pop();
        if (distance > found.distance[at]) continue;
        const int x = static_cast<int>(at) % photo.width, y = static_cast<int>(at) / photo.width;
        for (std::size_t step = 0; step < 8; ++step) {
            const int u = x + grid_steps[step][0], v = y + grid_steps[step][1];
            if (u < 0 || v < 0 || u >= photo.width || v >= photo.height) continue;
            const std::size_t to = strokes.index(u, v);
            const double length =
                grid_steps[step][0] != 0 && grid_steps[step][1] != 0 ? 1.4142135623730951 : 1.0;
            const double edge = std::min(most, 2.0 * beta * colour_difference(photo, at, to));
            const double way = distance + length * std::sqrt(plain + across * edge);
            if (way >= found.distance[to]) continue;
            found.distance[to] = way;
            found.towards[to] = static_cast<std::uint8_t>(7 - step);
            open.emplace(way, static_cast<std::uint32_t>(to));
        }
    }
    return found;
}

}  // namespace sporeprint::trace
