#include "core/geometry/receptacle.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <tuple>
#include <vector>

#include "tests/support/meshes.h"
#include "tests/support/orders.h"

namespace sporeprint::geometry_receptacle_test {
namespace {

Mesh mesh_with(const char* id, std::optional<double> OrnamentsOf<Maybe>::*of, double amount,
               int lod, std::uint32_t seed) {
    MushroomSpec order = order_of(id, 0.6, seed, lod);
    order.params.ornaments.*of = amount;
    Mesh mesh = mesh_of(order);
    expect_valid(mesh);
    return mesh;
}

Mesh cage(double amount, int lod = 0, std::uint32_t seed = 4) {
    return mesh_with("clathrus_ruber", &OrnamentsOf<Maybe>::receptacle, amount, lod, seed);
}

Mesh nest(double amount, int lod = 0, std::uint32_t seed = 4) {
    return mesh_with("cyathus_striatus", &OrnamentsOf<Maybe>::peridioles, amount, lod, seed);
}

/// Returns V - E + F of a closed mesh whose equal positions are one vertex.
int euler_characteristic(const Mesh& mesh) {
    std::map<std::tuple<float, float, float>, int> places;
    std::vector<int> place;
    for (const glm::vec3& p : mesh.positions)
        place.push_back(
            places
                .try_emplace({p.x + 0.0f, p.y + 0.0f, p.z + 0.0f}, static_cast<int>(places.size()))
                .first->second);
    std::set<int> used;
    std::set<std::pair<int, int>> edges;
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3)
        for (std::size_t k = 0; k < 3; ++k) {
            const int a = place[mesh.indices[i + k]], b = place[mesh.indices[i + (k + 1) % 3]];
            used.insert(a);
            edges.insert(std::minmax(a, b));
        }
    return static_cast<int>(used.size()) - static_cast<int>(edges.size()) +
           static_cast<int>(mesh.indices.size() / 3);
}

/// Returns the piece with the largest extent upwards: the net stands on its egg.
Mesh net_of(const Mesh& mesh) {
    Mesh highest;
    float top = -1.0f;
    for (const Mesh& piece : pieces(mesh))
        for (const glm::vec3& p : piece.positions)
            if (p.y > top) {
                top = p.y;
                highest = piece;
            }
    return highest;
}

TEST(Receptacle, IsOneClosedSurfaceWithAHoleForEveryMesh) {
    // A graph of 2 n - 4 corners and 3 n - 6 arms has n - 1 loops, and a surface round a graph with
    // g loops has the Euler characteristic 2 - 2 g.
    const int meshes =
        atlas().find("clathrus_ruber")->species.stages.front().model.receptacle.meshes;
    for (int lod = 0; lod < 2; ++lod)
        for (const std::uint32_t seed : {1u, 2u, 3u})
            EXPECT_EQ(euler_characteristic(net_of(cage(1.0, lod, seed))), 4 - 2 * meshes)
                << lod << ' ' << seed;
    EXPECT_EQ(euler_characteristic(net_of(cage(1.0, 3))), 4 - 2 * 5) << "a net of fewer meshes";
}

TEST(Receptacle, UnfoldsInProportion) {
    const double whole = volume(net_of(cage(1.0)));
    EXPECT_GT(whole, 0.0);
    EXPECT_NEAR(volume(net_of(cage(0.9))) / whole, 0.9 * 0.9 * 0.9, 2e-3)
        << "dents do not shrink with it";
}

TEST(Receptacle, HasTheSameVerticesWhetherFoldedOrNot) {
    MushroomSpec order = order_of("clathrus_ruber", 0.6, 4, 1);
    order.params.ornaments.receptacle = 1.0;
    const std::size_t unfolded = mesh_of(order).positions.size();
    order.params.ornaments.receptacle = 0.0;
    EXPECT_EQ(mesh_of(order).positions.size(), unfolded);
    EXPECT_EQ(pieces(cage(0.0, 1)).size() + 1, pieces(cage(1.0, 1)).size());
}

TEST(Peridioles, AreClosedLensesOneForEachLeft) {
    const int count =
        atlas().find("cyathus_striatus")->species.stages.front().model.peridioles.count;
    const std::size_t body = pieces(nest(0.0)).size();
    EXPECT_EQ(pieces(nest(1.0)).size(), body + static_cast<std::size_t>(count));
    std::size_t last = body;
    for (const double amount : {0.2, 0.4, 0.6, 0.8, 1.0}) {
        const std::size_t now = pieces(nest(amount)).size();
        EXPECT_GT(now, last) << amount;
        last = now;
    }
}

TEST(Peridioles, LieWithinTheirCup) {
    for (const std::uint32_t seed : {1u, 2u, 3u, 4u}) {
        std::vector<Mesh> found = pieces(nest(1.0, 0, seed));
        const auto wider = [](const Mesh& a, const Mesh& b) { return volume(a) < volume(b); };
        std::sort(found.begin(), found.end(), wider);
        float rim = 0.0f;
        for (const glm::vec3& p : found.back().positions) rim = std::max(rim, p.y);
        found.pop_back();
        for (const Mesh& lens : found) {
            if (lens.positions.size() < 100) continue;  // a hair of the outer face
            for (const glm::vec3& p : lens.positions) {
                EXPECT_LT(p.y, rim) << seed;
                EXPECT_GT(p.y, 0.0f) << seed;
            }
        }
    }
}

TEST(Peridioles, OtherSpeciesRefuseThem) {
    MushroomSpec order = order_of("amanita_muscaria", 0.6, 1, 1);
    order.params.ornaments.peridioles = 0.5;
    EXPECT_TRUE(
        names(refusal([&] { (void)mesh_of(order); }), "/ornaments/peridioles", "no bird's nest"));
    order.params.ornaments.peridioles.reset();
    order.params.ornaments.receptacle = 0.5;
    EXPECT_TRUE(
        names(refusal([&] { (void)mesh_of(order); }), "/ornaments/receptacle", "no cage fungus"));
}

}  // namespace
}  // namespace sporeprint::geometry_receptacle_test
