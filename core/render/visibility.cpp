#include "core/render/visibility.h"

#include <optional>

namespace sporeprint::render {

Visibility::Visibility(int columns, int rows)
    : width(columns),
      height(rows),
      nearness(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows), nothing),
      draw(nearness.size()),
      corner(nearness.size()) {}

void Visibility::show(std::size_t of_draw, std::span<const std::uint32_t> indices,
                      std::span<const SnappedCorner> corners, int from, int to,
                      std::span<const std::uint32_t> of, const Cutouts& cutouts) {
    for (std::size_t i = 0; i + 2 < indices.size(); i += 3) {
        const std::uint32_t first = of.empty() ? static_cast<std::uint32_t>(i) : of[i / 3];
        // Few triangles have a sample that is nearest, so where the holes are is found at the first one.
        std::optional<Cutout> cutout;
        const auto is_drawn = [&](int x, int y) {
            if (!cutouts) return true;
            if (!cutout) cutout = cutouts(first);
            return cutout->shows(x, y);
        };
        rasterize(
            corners[indices[i]], corners[indices[i + 1]], corners[indices[i + 2]], width, to,
            [&](int x, int y, float near) {
                const auto at = static_cast<std::size_t>(y * width + x);
                if (near <= nearness[at] || !is_drawn(x, y)) return;
                nearness[at] = near;
                draw[at] = static_cast<std::uint32_t>(of_draw);
                corner[at] = first;
            },
            from);
    }
}

}  // namespace sporeprint::render
