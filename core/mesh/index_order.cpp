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

/// Sorts triangles by their keys, each below `most`; equal ones keep their order.
std::vector<std::uint32_t> sorted_by(const std::vector<std::uint32_t>& keys, std::size_t most,
                                     const std::vector<std::uint32_t>& triangles) {
    std::vector<std::uint32_t> ends(most + 1, 0), sorted(triangles.size());
    for (const std::uint32_t key : keys) ++ends[key + 1];
    std::partial_sum(ends.begin(), ends.end(), ends.begin());
    for (const std::uint32_t triangle : triangles) sorted[ends[keys[triangle]]++] = triangle;
    return sorted;
}

}  // namespace

std::vector<std::uint32_t> triangles_by_last_vertex(std::span<const std::uint32_t> indices,
                                                    std::size_t vertices) {
    const std::size_t count = indices.size() / 3;
    std::vector<std::uint32_t> first(count), last(count), triangles(count);
    for (std::size_t i = 0; i < count; ++i) {
        const auto [low, high] =
            std::minmax({indices[3 * i], indices[3 * i + 1], indices[3 * i + 2]});
        first[i] = low;
        last[i] = high;
    }
    std::iota(triangles.begin(), triangles.end(), 0U);
    triangles = sorted_by(last, vertices, sorted_by(first, vertices, triangles));
    std::vector<std::uint32_t> ordered;
    ordered.reserve(indices.size());
    for (const std::uint32_t triangle : triangles) {
        const auto of = indices.subspan(3 * std::size_t{triangle}, 3);
        ordered.insert(ordered.end(), of.begin(), of.end());
    }
    return ordered;
}

}  // namespace sporeprint
