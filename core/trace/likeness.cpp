#include "core/trace/likeness.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <vector>

#include "core/trace/lab.h"

namespace sporeprint::trace {

namespace {

/// Returns the middle value of some numbers; 0 of none.
double median(std::vector<double>& values) {
    if (values.empty()) return 0.0;
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

}  // namespace

Likeness likeness_of(const Picture& picture, const Mask& mask) {
    int top = mask.height, bottom = -1;
    std::vector<int> widths(static_cast<std::size_t>(mask.height), 0);
    for (int y = 0; y < mask.height; ++y) {
        int first = mask.width, last = -1;
        for (int x = 0; x < mask.width; ++x)
            if (mask.at(x, y)) {
                first = std::min(first, x);
                last = x;
            }
        if (last < 0) continue;
        widths[static_cast<std::size_t>(y)] = last - first + 1;
        top = std::min(top, y);
        bottom = y;
    }
    Likeness found;
    if (bottom < top) return found;
    const int height = bottom - top + 1;
    for (std::size_t k = 0; k < Likeness::heights; ++k) {
        const double share =
            (static_cast<double>(k) + 0.5) / static_cast<double>(Likeness::heights);
        const int y = bottom - static_cast<int>(share * height);
        found.half_widths[k] =
            0.5 * widths[static_cast<std::size_t>(std::max(y, top))] / static_cast<double>(height);
    }
    for (std::size_t band = 0; band < Likeness::bands; ++band) {
        std::array<std::vector<double>, 3> channels;
        const auto row = [&](std::size_t of) {
            return bottom + 1 -
                   static_cast<int>(of * static_cast<std::size_t>(height) / Likeness::bands);
        };
        for (int y = row(band + 1); y < row(band); ++y)
            for (int x = 0; x < mask.width; ++x) {
                if (!mask.at(x, y)) continue;
                const std::uint8_t* rgb = &picture.rgb[3 * mask.index(x, y)];
                for (std::size_t c = 0; c < 3; ++c) channels[c].push_back(rgb[c]);
            }
        const glm::dvec3 lab =
            lab_of({median(channels[0]), median(channels[1]), median(channels[2])});
        found.colours[band] = {0.5 * lab.x, lab.y, lab.z};
    }
    return found;
}

Unlikeness unlikeness(const Likeness& a, const Likeness& b) {
    Unlikeness found;
    for (std::size_t k = 0; k < Likeness::heights; ++k) {
        const double apart = a.half_widths[k] - b.half_widths[k];
        found.shape += apart * apart / static_cast<double>(Likeness::heights);
    }
    found.shape = std::sqrt(found.shape);
    for (std::size_t band = 0; band < Likeness::bands; ++band)
        found.colour +=
            glm::length(a.colours[band] - b.colours[band]) / static_cast<double>(Likeness::bands);
    return found;
}

}  // namespace sporeprint::trace
