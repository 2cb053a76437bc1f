#include "core/silhouette/intermediate_shape.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "core/math/elementary.h"

namespace sporeprint {

namespace {

// Half its width over its height; the lower face's middle and half its breadth, as shares of a quarter turn.
constexpr double bud_width = 0.175, bud_middle = -0.1, bud_band = 0.1;
constexpr double least_height = 0.01;  // of the shapes' size

}  // namespace

OutlineNodes bud_of(const std::vector<OutlineNodes>& shapes) {
    const auto count_of_shapes = static_cast<double>(shapes.size());
    double low = 0.0, high = 0.0;
    for (const OutlineNodes& shape : shapes) {
        low += shape.stem.front().position.y / count_of_shapes;
        high += shape.cap.back().position.y / count_of_shapes;
    }
    const glm::dvec2 centre(0.0, 0.5 * (low + high));
    // Shapes may hang from their stems, or end where they begin; their bud hangs too, and never is flat.
    const double height = std::copysign(std::max(std::abs(high - low), least_height), high - low);
    const glm::dvec2 half(bud_width * std::abs(height), 0.5 * height);
    const double junction = (bud_middle - bud_band) * 0.5 * pi;
    const double margin =
        shapes.front().hymenium.empty() ? junction : (bud_middle + bud_band) * 0.5 * pi;
    OutlineNodes bud;
    for (const CurveName curve : curve_names) {
        const std::size_t count = shapes.front().of(curve).size();
        if (count == 0) continue;
        // As the shapes run through their own lengths on average.
        const auto even = [&](std::size_t i) {
            return static_cast<double>(i) / static_cast<double>(count - 1);
        };
        std::vector<double> shares(count, 0.0);
        for (const OutlineNodes& shape : shapes) {
            std::vector<double> lengths{0.0};
            const std::vector<OutlineNode>& own = shape.of(curve);
            for (std::size_t i = 1; i < count; ++i)
                lengths.push_back(lengths.back() +
                                  glm::distance(own[i].position, own[i - 1].position));
            for (std::size_t i = 0; i < count; ++i)
                shares[i] += (lengths.back() > 0.0 ? lengths[i] / lengths.back() : even(i)) /
                             count_of_shapes;
        }
        const double from = curve == CurveName::stem       ? -0.5 * pi
                            : curve == CurveName::hymenium ? junction
                                                           : margin;
        const double to = curve == CurveName::stem       ? junction
                          : curve == CurveName::hymenium ? margin
                                                         : 0.5 * pi;
        for (std::size_t i = 0; i < count; ++i) {
            const std::size_t before = i == 0 ? 0 : i - 1, after = std::min(i + 1, count - 1);
            const double rate = (shares[after] - shares[before]) / (even(after) - even(before));
            const double share = i + 1 == count ? 1.0 : shares[i];  // without rounding: ends meet
            const auto [s, c] = sine_cosine(from + (to - from) * share);
            bud.of(curve).push_back(
                {centre + half * glm::dvec2(c, s), (to - from) * rate * half * glm::dvec2(-s, c)});
        }
    }
    bud.stem.front().position.x = bud.cap.back().position.x = 0.0;
    if (!bud.hymenium.empty()) bud.hymenium.front().position = bud.stem.back().position;
    bud.cap.front().position =
        bud.hymenium.empty() ? bud.stem.back().position : bud.hymenium.back().position;
    return bud;
}

}  // namespace sporeprint
