#include "core/render/visibility.h"

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
        const auto show_where = [&](const auto& is_drawn) {
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
        };
        if (!cutouts) {
            show_where([](int, int) { return true; });
            continue;
        }
        const Cutout cutout = cutouts(first);
        show_where([&](int x, int y) { return cutout.shows(x, y); });
    }
}

}  // namespace sporeprint::render
