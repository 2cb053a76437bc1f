#include "core/mesh/index_order.h"

#include <meshoptimizer.h>

#include <algorithm>
#include <numeric>

namespace sporeprint {

void order_for_vertex_cache(Mesh& mesh) {
    constexpr unsigned int cache_size = 16;  // the smallest vertex cache of current processors
    meshopt_optimizeVertexCacheFifo(mesh.indices.data(), mesh.indices.data(), mesh.indices.size(),
                                    mesh.positions.size(), cache_size);
}

namespace {

/// Sorts triangles by a key below `keys`; equal ones keep their order.
template <class Key>
std::vector<std::uint32_t> sorted_by(const std::vector<std::uint32_t>& triangles, std::size_t keys,
                                     const Key& key_of) {
    std::vector<std::uint32_t> ends(keys + 1, 0), sorted(triangles.size());
    for (const std::uint32_t triangle : triangles) ++ends[key_of(triangle) + 1];
    std::partial_sum(ends.begin(), ends.end(), ends.begin());
    for (const std::uint32_t triangle : triangles) sorted[ends[key_of(triangle)]++] = triangle;
    return sorted;
}

}  // namespace

std::vector<std::uint32_t> triangles_by_last_vertex(std::span<const std::uint32_t> indices,
                                                    std::size_t vertices) {
    const auto corners = [&](std::uint32_t triangle) {
        return indices.subspan(3 * std::size_t{triangle}, 3);
    };
    std::vector<std::uint32_t> triangles(indices.size() / 3);
    std::iota(triangles.begin(), triangles.end(), 0U);
    triangles = sorted_by(triangles, vertices, [&](std::uint32_t triangle) {
        return *std::ranges::min_element(corners(triangle));
    });
    triangles = sorted_by(triangles, vertices, [&](std::uint32_t triangle) {
        return *std::ranges::max_element(corners(triangle));
    });
    std::vector<std::uint32_t> ordered;
    ordered.reserve(indices.size());
    for (const std::uint32_t triangle : triangles) {
        const auto of = corners(triangle);
        ordered.insert(ordered.end(), of.begin(), of.end());
    }
    return ordered;
}

}  // namespace sporeprint
