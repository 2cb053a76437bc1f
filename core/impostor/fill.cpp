#include "core/impostor/fill.h"

#include <algorithm>

namespace sporeprint {

namespace {

void add(FilledTexel& sum, const FilledTexel& texel, float weight) {
    sum.colour += texel.colour * weight;
    sum.normal += texel.normal * weight;
    sum.roughness += texel.roughness * weight;
    sum.depth += texel.depth * weight;
    sum.coverage += weight;
}

/// Returns a sum of weighted texels divided by the sum of their weights, which is its coverage.
FilledTexel mean_of(const FilledTexel& sum) {
    if (!(sum.coverage > 0.0F)) return {};
    const float share = 1.0F / sum.coverage;
    return {sum.colour * share, sum.normal * share, sum.roughness * share, sum.depth * share,
            std::min(sum.coverage, 1.0F)};
}

}  // namespace

void FilledFrame::fill() {
    if (side_ < 2) return;
    FilledFrame half((side_ + 1) / 2);
    for (int y = 0; y < half.side_; ++y)
        for (int x = 0; x < half.side_; ++x) {
            FilledTexel sum;
            for (int i = 2 * y; i < std::min(2 * y + 2, side_); ++i)
                for (int j = 2 * x; j < std::min(2 * x + 2, side_); ++j)
                    if (const FilledTexel& one = texel(j, i); one.coverage > 0.0F)
                        add(sum, one, one.coverage);
            half.texel(x, y) = mean_of(sum);
        }
    half.fill();
    for (int y = 0; y < side_; ++y)
        for (int x = 0; x < side_; ++x) {
            FilledTexel& own = texel(x, y);
            if (own.coverage > 0.0F) continue;
            // Between the four nearest texels of the smaller copy, the nearest one counting most.
            const auto beside = [&](int at) {
                return std::clamp(at / 2 + (at % 2 == 0 ? -1 : 1), 0, half.side_ - 1);
            };
            const int near_x = x / 2, near_y = y / 2, far_x = beside(x), far_y = beside(y);
            FilledTexel sum;
            add(sum, half.texel(near_x, near_y), 9.0F / 16.0F);
            add(sum, half.texel(far_x, near_y), 3.0F / 16.0F);
            add(sum, half.texel(near_x, far_y), 3.0F / 16.0F);
            add(sum, half.texel(far_x, far_y), 1.0F / 16.0F);
            sum.coverage = 0.0F;
            own = sum;
        }
}

}  // namespace sporeprint
