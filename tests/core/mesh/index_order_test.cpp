#include "core/mesh/index_order.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <array>
#include <deque>
#include <utility>
#include <vector>

#include "core/grow/mushroom.h"
#include "core/math/random.h"
#include "tests/support/mixes.h"
#include "tests/support/orders.h"

namespace sporeprint::mesh_index_order_test {
namespace {

using Triangles = std::vector<std::array<std::uint32_t, 3>>;

/// Returns the corners of each triangle in their order, starting with the least: the triangle
/// independent of its first corner.
Triangles triangles_of(const Mesh& mesh) {
    Triangles all;
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
        std::array<std::uint32_t, 3> t{mesh.indices[i], mesh.indices[i + 1], mesh.indices[i + 2]};
        std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
        all.push_back(t);
    }
    std::sort(all.begin(), all.end());
    return all;
}

/// Returns the vertex transforms per triangle of a processor with a cache of sixteen.
double misses(const Mesh& mesh) {
    std::deque<std::uint32_t> cache;
    std::size_t missed = 0;
    for (const std::uint32_t index : mesh.indices) {
        if (std::find(cache.begin(), cache.end(), index) != cache.end()) continue;
        ++missed;
        cache.push_back(index);
        if (cache.size() > 16) cache.pop_front();
    }
    return static_cast<double>(missed) / static_cast<double>(mesh.triangles());
}

/// Returns a sheet of side x side squares, row by row.
Mesh sheet(std::uint32_t side) {
    Mesh mesh;
    mesh.positions.resize((side + 1) * (side + 1));
    for (std::uint32_t i = 0; i < side; ++i)
        for (std::uint32_t j = 0; j < side; ++j) {
            const std::uint32_t a = i * (side + 1) + j, c = a + side + 1;
            mesh.indices.insert(mesh.indices.end(), {a, c, a + 1, a + 1, c, c + 1});
        }
    return mesh;
}

TEST(IndexOrder, PreservesTrianglesOrientationAndVertices) {
    Random random(11, 1);
    for (int round = 0; round < 50; ++round) {
        Mesh mesh;
        mesh.positions.resize(40);
        for (int i = 0; i < 3 * 60; ++i)
            mesh.indices.push_back(static_cast<std::uint32_t>(random.uniform() * 40.0));
        const Triangles before = triangles_of(mesh);
        order_for_vertex_cache(mesh);
        EXPECT_EQ(triangles_of(mesh), before);
        EXPECT_EQ(mesh.positions.size(), 40U);
    }
    Mesh none;
    order_for_vertex_cache(none);
    EXPECT_TRUE(none.indices.empty());
}

TEST(IndexOrder, ASheetNeedsTwoThirdsOfAVertexPerTriangle) {
    Mesh mesh = sheet(60);
    EXPECT_GT(misses(mesh), 1.0);
    order_for_vertex_cache(mesh);
    EXPECT_LT(misses(mesh), 0.68);
}

TEST(IndexOrder, AppliesToEveryMushroom) {
    for (const std::string& id : species_ids())
        for (const int lod : {0, 1}) {
            const MushroomSpec order = textured(order_of(id, 0.6, 3, lod));
            const Individual individual = resolved(order);
            const Mesh body = body_mesh(individual, lod), drawn = mushroom_mesh(order, individual);
            EXPECT_EQ(triangles_of(drawn), triangles_of(body)) << id;
            EXPECT_EQ(drawn.positions, body.positions) << id;
            // Segments are tubes, which are built almost in this order.
            EXPECT_LT(misses(drawn), std::max(0.9 * misses(body), 0.75)) << id << " at LOD " << lod;
        }
}

RC_GTEST_PROP(IndexOrder, ByLastVertexKeepsTriangles, ()) {
    const auto vertices = *rc::gen::inRange<std::uint32_t>(1, 40);
    const auto corners = *rc::gen::container<std::vector<std::array<std::uint32_t, 3>>>(
        rc::gen::container<std::array<std::uint32_t, 3>>(rc::gen::inRange(0U, vertices)));
    std::vector<std::uint32_t> indices;
    for (const auto& triangle : corners)
        indices.insert(indices.end(), triangle.begin(), triangle.end());
    const std::vector<std::uint32_t> ordered = triangles_by_last_vertex(indices, vertices);
    RC_ASSERT(ordered.size() == indices.size());
    std::vector<std::array<std::uint32_t, 3>> expected = corners;
    std::stable_sort(expected.begin(), expected.end(), [](const auto& a, const auto& b) {
        const auto [low_a, high_a] = std::ranges::minmax(a);
        const auto [low_b, high_b] = std::ranges::minmax(b);
        return std::pair(high_a, low_a) < std::pair(high_b, low_b);
    });
    for (std::size_t i = 0; i < expected.size(); ++i)
        for (std::size_t k = 0; k < 3; ++k) RC_ASSERT(ordered[3 * i + k] == expected[i][k]);
}

}  // namespace
}  // namespace sporeprint::mesh_index_order_test
