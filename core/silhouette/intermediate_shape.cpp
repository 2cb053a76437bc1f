#include "core/silhouette/intermediate_shape.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "core/math/elementary.h"

namespace sporeprint {

namespace {

// Half width over height; centre and half breadth of the lower face as shares of a quarter turn.
constexpr double half_width = 0.175, band_centre = -0.1, band_half_breadth = 0.1;
constexpr double least_height = 0.01;  // relative to the shapes' size

}  // namespace

OutlineNodes intermediate_shape(const std::vector<OutlineNodes>& shapes) {
    const auto count_of_shapes = static_cast<double>(shapes.size());
    double low = 0.0, high = 0.0;
    for (const OutlineNodes& shape : shapes) {
        low += shape.stem.front().position.y / count_of_shapes;
        high += shape.cap.back().position.y / count_of_shapes;
    }
    const glm::dvec2 centre(0.0, 0.5 * (low + high));
    // Shapes may point downwards or end at the height where they begin; the intermediate shape
    // keeps their direction and is never flat.
    const double height = std::copysign(std::max(std::abs(high - low), least_height), high - low);
    const glm::dvec2 half(half_width * std::abs(height), 0.5 * height);
    const double junction = (band_centre - band_half_breadth) * 0.5 * pi;
    const double margin =
        shapes.front().hymenium.empty() ? junction : (band_centre + band_half_breadth) * 0.5 * pi;
    OutlineNodes intermediate;
    for (const CurveName curve : curve_names) {
        const std::size_t count = shapes.front().of(curve).size();
        if (count == 0) continue;
        // Nodes are spaced by the mean arc-length shares of the shapes.
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
            const double share = i + 1 == count ? 1.0 : shares[i];  // exact, so that ends meet
            const auto [s, c] = sine_cosine(from + (to - from) * share);
            intermediate.of(curve).push_back(
                {centre + half * glm::dvec2(c, s), (to - from) * rate * half * glm::dvec2(-s, c)});
        }
    }
    intermediate.stem.front().position.x = intermediate.cap.back().position.x = 0.0;
    if (!intermediate.hymenium.empty())
        intermediate.hymenium.front().position = intermediate.stem.back().position;
    intermediate.cap.front().position = intermediate.hymenium.empty()
                                            ? intermediate.stem.back().position
                                            : intermediate.hymenium.back().position;
    return intermediate;
}

}  // namespace sporeprint
