#include "core/trace/gesture.h"

#include <algorithm>
#include <cmath>

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
        for (int y = 0; y < mask.height; ++y)
            for (int x = 0; x < mask.width; ++x)
                if (mask.at(x, y)) visit((x + 0.5) * along.x + (y + 0.5) * along.y);
    };
    each([&](double at) {
        least = std::min(least, at);
        most = std::max(most, at);
    });
    double first = 0.0, last = 0.0;
    each([&](double at) { (at < 0.5 * (least + most) ? first : last) += 1.0; });
    return last <= clearly * first;
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
