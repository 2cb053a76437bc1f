// Tables of evenly spaced entries over 0..1.
#pragma once

#include <algorithm>
#include <cstddef>

namespace sporeprint {

/// A place between two neighbouring entries of a table.
struct Between {
    std::size_t below;
    double t;  ///< 0 at that entry, 1 at the next one
};

/// Returns where a place, 0..1, is in a table of evenly spaced entries.
///
/// entries  at least 2
[[nodiscard]] inline Between between_entries(double place, std::size_t entries) {
    const double at = place * static_cast<double>(entries - 1);
    const auto below = std::min(static_cast<std::size_t>(at), entries - 2);
    return {below, at - static_cast<double>(below)};
}

/// Returns what a table of evenly spaced entries has at a place, 0..1, linear between them.
template <class Table>
[[nodiscard]] auto of_table(const Table& table, double place) {
    const auto [below, t] = between_entries(place, table.size());
    return (1.0 - t) * table[below] + t * table[below + 1];
}

}  // namespace sporeprint
