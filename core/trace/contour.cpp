#include "core/trace/contour.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>

#include "core/math/elementary.h"

namespace sporeprint::trace {

namespace {

/// Steps along the edges of pixels: right, down, left and up.
constexpr std::array<std::array<int, 2>, 4> ways = {{{1, 0}, {0, 1}, {-1, 0}, {0, -1}}};

/// Returns the midpoints of all edges between the inside and the outside, in order.
Contour cracks_of(const Mask& mask) {
    int x = 0, y = 0;
    while (!mask.at(x, y)) {
        if (++x == mask.width) {
            x = 0;
            ++y;
        }
    }
    // The upper edge of the first pixel is walked to the right, with the inside on the right hand.
    const int first_x = x, first_y = y;
    std::size_t way = 0;
    Contour found;
    do {
        const int dx = ways[way][0], dy = ways[way][1];
        found.emplace_back(x + 0.5 * dx, y + 0.5 * dy);
        x += dx;
        y += dy;
        // The two pixels ahead of the corner, on the right hand and on the left.
        const int rx = ways[(way + 1) % 4][0], ry = ways[(way + 1) % 4][1];
        const auto pixel = [&](int side) {
            // Both sums are 0 or -2 about the corner, so that halving them is exact.
            return mask.at(x + (dx + side * rx - 1) / 2, y + (dy + side * ry - 1) / 2);
        };
        const bool right = pixel(1), left = pixel(-1);
        if (!right)
            way = (way + 1) % 4;
        else if (left)
            way = (way + 3) % 4;
    } while (x != first_x || y != first_y || way != 0);
    return found;
}

double length_of(const Contour& contour) {
    double sum = 0.0;
    for (std::size_t i = 0; i < contour.size(); ++i)
        sum += glm::length(contour[(i + 1) % contour.size()] - contour[i]);
    return sum;
}

/// Returns evenly spaced points on a closed polygon.
Contour evenly_spaced(const Contour& contour, std::size_t count) {
    Contour found;
    found.reserve(count);
    const double step = length_of(contour) / static_cast<double>(count);
    double passed = 0.0;
    std::size_t edge = 0;
    for (std::size_t k = 0; k < count; ++k) {
        const double target = static_cast<double>(k) * step;
        glm::dvec2 from = contour[edge], to = contour[(edge + 1) % contour.size()];
        while (edge + 1 < contour.size() && passed + glm::length(to - from) < target) {
            passed += glm::length(to - from);
            ++edge;
            from = contour[edge];
            to = contour[(edge + 1) % contour.size()];
        }
        const double length = glm::length(to - from);
        const double t = length > 0.0 ? std::clamp((target - passed) / length, 0.0, 1.0) : 0.0;
        found.push_back(from + t * (to - from));
    }
    return found;
}

}  // namespace

Contour contour_of(const Mask& mask, double sigma) {
    const Contour cracks = cracks_of(mask);
    Contour even = evenly_spaced(cracks, cracks.size());
    if (sigma <= 0.0) return even;
    const double spacing = length_of(even) / static_cast<double>(even.size());
    const auto reach = static_cast<std::ptrdiff_t>(std::ceil(3.0 * sigma / spacing));
    std::vector<double> weights;
    double all = 0.0;
    for (std::ptrdiff_t k = -reach; k <= reach; ++k) {
        const double away = static_cast<double>(k) * spacing / sigma;
        weights.push_back(exponential(-0.5 * away * away));
        all += weights.back();
    }
    const auto count = static_cast<std::ptrdiff_t>(even.size());
    Contour smooth;
    smooth.reserve(even.size());
    for (std::ptrdiff_t i = 0; i < count; ++i) {
        glm::dvec2 sum(0.0);
        for (std::ptrdiff_t k = -reach; k <= reach; ++k)
            sum += weights[static_cast<std::size_t>(k + reach)] *
                   even[static_cast<std::size_t>(((i + k) % count + count) % count)];
        smooth.push_back(sum / all);
    }
    return smooth;
}

Mask inside_of(const Contour& contour, const PictureSize& size) {
    Mask mask(size.width, size.height);
    std::vector<double> crossings;
    for (int y = 0; y < size.height; ++y) {
        const double row = y + 0.5;
        crossings.clear();
        for (std::size_t i = 0; i < contour.size(); ++i) {
            const glm::dvec2 &a = contour[i], &b = contour[(i + 1) % contour.size()];
            if ((a.y <= row) != (b.y <= row))
                crossings.push_back(a.x + (b.x - a.x) * (row - a.y) / (b.y - a.y));
        }
        std::sort(crossings.begin(), crossings.end());
        for (std::size_t i = 0; i + 1 < crossings.size(); i += 2) {
            const auto column = [&](double x) {
                return static_cast<int>(std::ceil(std::clamp(x - 0.5, 0.0, size.width + 0.0)));
            };
            const int from = column(crossings[i]), to = column(crossings[i + 1]);
            for (int x = from; x < to; ++x) mask.inside[mask.index(x, y)] = 1;
        }
    }
    return mask;
}

std::vector<double> arc_lengths(const std::vector<glm::dvec2>& line) {
    std::vector<double> arcs{0.0};
    for (std::size_t i = 1; i < line.size(); ++i)
        arcs.push_back(arcs.back() + glm::length(line[i] - line[i - 1]));
    return arcs;
}

double distance_from_segment(const glm::dvec2& point, const glm::dvec2& from,
                             const glm::dvec2& to) {
    const glm::dvec2 along = to - from, off = point - from;
    const double square = glm::dot(along, along);
    const double t = square > 0.0 ? std::clamp(glm::dot(off, along) / square, 0.0, 1.0) : 0.0;
    return glm::length(off - t * along);
}

double area_of(const Contour& contour) {
    double sum = 0.0;
    for (std::size_t i = 0; i < contour.size(); ++i) {
        const glm::dvec2 &a = contour[i], &b = contour[(i + 1) % contour.size()];
        sum += a.x * b.y - b.x * a.y;
    }
    return 0.5 * std::abs(sum);
}

std::optional<double> first_hit(const Contour& contour, const glm::dvec2& from,
                                const glm::dvec2& direction) {
    std::optional<double> nearest;
    for (std::size_t i = 0; i < contour.size(); ++i) {
        const glm::dvec2 a = contour[i] - from, b = contour[(i + 1) % contour.size()] - from;
        const double side_a = direction.x * a.y - direction.y * a.x,
                     side_b = direction.x * b.y - direction.y * b.x;
        if ((side_a > 0.0) == (side_b > 0.0)) continue;
        const double t = side_a / (side_a - side_b);
        const double distance = glm::dot(direction, a + t * (b - a));
        if (distance >= 0.0 && (!nearest || distance < *nearest)) nearest = distance;
    }
    return nearest;
}

}  // namespace sporeprint::trace
