// What the painters of this folder share: rows of texels as independent tasks, and their bytes.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "core/images.h"

namespace sporeprint {

/// Returns a share as a byte; shares beyond 0..1 are the nearer end.
inline std::uint8_t share_as_byte(double share) {
    return static_cast<std::uint8_t>(std::clamp(share, 0.0, 1.0) * 255.0 + 0.5);
}

/// Calls `row(y)` for every row of an image, some rows in each task.
template <class Row>
void for_each_row(int side, const Parallel& parallel, const Row& row) {
    constexpr int rows_per_task = 32;
    std::vector<std::function<void()>> tasks;
    for (int first = 0; first < side; first += rows_per_task)
        tasks.emplace_back([&row, first, side] {
            for (int y = first; y < std::min(side, first + rows_per_task); ++y)
                row(static_cast<std::size_t>(y));
        });
    parallel(tasks);
}

}  // namespace sporeprint
