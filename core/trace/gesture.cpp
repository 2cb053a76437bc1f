#include "core/trace/gesture.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "core/trace/contour.h"

namespace sporeprint::trace {

Gesture Gesture::scaled(double factor) const {
    Gesture other = *this;
    const auto scale = [factor](Stroke& stroke) {
        for (glm::dvec2& point : stroke) point *= factor;
    };
    scale(other.axis);
    scale(other.cap);
    std::for_each(other.keep.begin(), other.keep.end(), scale);
    std::for_each(other.drop.begin(), other.drop.end(), scale);
    if (other.frame) {
        other.frame->from *= factor;
        other.frame->to *= factor;
    }
    return other;
}

Stroke upright_line(const Mask& mask) {
    int top = mask.height, bottom = -1;
    for (int y = 0; y < mask.height; ++y)
        for (int x = 0; x < mask.width; ++x)
            if (mask.at(x, y)) {
                top = std::min(top, y);
                bottom = y;
            }
    if (bottom < 0) return {};
    const auto middle_of = [&mask](int from, int to) {
        int count = 0;
        double sum = 0.0;
        for (int y = from; y <= to; ++y)
            for (int x = 0; x < mask.width; ++x)
                if (mask.at(x, y)) {
                    sum += x + 0.5;
                    ++count;
                }
        return sum / std::max(count, 1);
    };
    const int height = bottom - top + 1;
    return {{middle_of(bottom - height / 20, bottom), bottom + 0.5},
            {middle_of(top, top + height / 4), top + 0.5}};
}

bool is_reversed(const Stroke& axis, const Mask& mask) {
    constexpr double clearly = 1.25;
    const glm::dvec2 along = axis.back() - axis.front();
    if (along.y <= std::abs(along.x)) return false;
    // The halves of the mushroom along the line, not those of the line, which may be short.
    double least = 1e300, most = -1e300;
    const auto each = [&](const auto& visit) {
        each_pixel(mask,
                   [&](int, int, const glm::dvec2& middle) { visit(glm::dot(middle, along)); });
    };
    each([&](double at) {
        least = std::min(least, at);
        most = std::max(most, at);
    });
    double first = 0.0, last = 0.0;
    each([&](double at) { (at < 0.5 * (least + most) ? first : last) += 1.0; });
    return last <= clearly * first;
}

Stroke without_overshoot(const Stroke& stroke, const Mask& mask, double width) {
    constexpr double most_share = 0.2;
    // Beside the end of a line the cut often has a wedge of what is there, such as a shadow.
    constexpr double narrow_share = 0.3;
    const auto is_in = [&mask](const glm::dvec2& at) {
        return at.x >= 0.0 && at.y >= 0.0 && at.x < mask.width && at.y < mask.height &&
               mask.at(static_cast<int>(at.x), static_cast<int>(at.y));
    };
    Stroke points;
    std::vector<int> widths;
    for (std::size_t i = 0; i + 1 < stroke.size(); ++i) {
        const glm::dvec2 along = stroke[i + 1] - stroke[i];
        const double length = glm::length(along);
        if (length == 0.0) continue;
        const glm::dvec2 across{-along.y / length, along.x / length};
        const int steps = std::max(1, static_cast<int>(length));
        for (int k = 0; k < steps; ++k) {
            const glm::dvec2 at = stroke[i] + along * (k / static_cast<double>(steps));
            int wide = 1;
            for (const double side : {-1.0, 1.0})
                for (int reach = 1; is_in(at + across * (side * reach)); ++reach) ++wide;
            points.push_back(at);
            widths.push_back(wide);
        }
    }
    if (points.empty()) return stroke;
    points.push_back(stroke.back());
    widths.push_back(widths.back());
    std::vector<int> sorted = widths;
    std::sort(sorted.begin(), sorted.end());
    // The border of a mask is a pixel off at times.
    const double most_wide = std::max(width + 2.0, narrow_share * sorted[sorted.size() / 2]);
    const auto is_wide = [most_wide](int wide) { return wide > most_wide; };
    const auto most = static_cast<std::ptrdiff_t>(most_share * static_cast<double>(points.size()));
    const auto first = std::find_if(widths.begin(), widths.end(), is_wide) - widths.begin();
    const auto last = std::find_if(widths.rbegin(), widths.rend(), is_wide) - widths.rbegin();
    const std::ptrdiff_t from = first <= most ? first : 0, to = last <= most ? last : 0;
    if (from == 0 && to == 0) return stroke;
    return {points.begin() + from, points.end() - to};
}

Mask drawn(const std::vector<Stroke>& strokes, int columns, int rows, double width) {
    Mask mask(columns, rows);
    const double reach = 0.5 * width;
    const auto draw = [&](const glm::dvec2& from, const glm::dvec2& to) {
        const auto first = [&](double a, double b) {
            return static_cast<int>(std::floor(std::max(std::min(a, b) - reach, 0.0)));
        };
        const auto last = [&](double a, double b, int size) {
            return static_cast<int>(std::min(std::max(a, b) + reach, size - 1.0));
        };
        for (int y = first(from.y, to.y); y <= last(from.y, to.y, rows); ++y)
            for (int x = first(from.x, to.x); x <= last(from.x, to.x, columns); ++x)
                if (distance_from_segment({x + 0.5, y + 0.5}, from, to) <= reach)
                    mask.inside[mask.index(x, y)] = 1;
    };
    for (const Stroke& stroke : strokes) {
        if (stroke.size() == 1) draw(stroke[0], stroke[0]);
        for (std::size_t i = 0; i + 1 < stroke.size(); ++i) draw(stroke[i], stroke[i + 1]);
    }
    return mask;
}

}  // namespace sporeprint::trace
