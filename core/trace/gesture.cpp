#include "core/trace/gesture.h"

#include <algorithm>
#include <cmath>
#include <optional>

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
    const auto middle_of = [&mask](int y) -> std::optional<glm::dvec2> {
        int count = 0;
        double sum = 0.0;
        for (int x = 0; x < mask.width; ++x)
            if (mask.at(x, y)) {
                sum += x + 0.5;
                ++count;
            }
        if (count == 0) return std::nullopt;
        return glm::dvec2(sum / count, y + 0.5);
    };
    Stroke line;
    for (int y = mask.height - 1; y >= 0 && line.empty(); --y)
        if (const std::optional<glm::dvec2> foot = middle_of(y)) line.push_back(*foot);
    for (int y = 0; y < mask.height && line.size() == 1; ++y)
        if (const std::optional<glm::dvec2> top = middle_of(y)) line.push_back(*top);
    return line;
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
