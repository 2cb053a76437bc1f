#include "core/geometry/collar.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "core/mesh/measure.h"
#include "core/surface/charts.h"
#include "tests/support/intrusion.h"
#include "tests/support/meshes.h"
#include "tests/support/orders.h"
#include "tests/support/triangle_grid.h"

namespace sporeprint::geometry_collar_test {
namespace {

const std::vector<std::string> brackets = {"auricularia_auricula_judae", "fomes_fomentarius",
                                           "pleurotus_ostreatus", "stereum_hirsutum",
                                           "trametes_versicolor"};

/// Returns the mesh of a request on a flat wall.
///
/// base  of its azimuth, instead of its own
Mesh on_wall(const MushroomSpec& spec, double base) {
    Individual individual = resolved(spec);
    individual.trunk_radius = 0.0;
    individual.azimuth.base = base;
    return mushroom_mesh(spec, individual);
}

TEST(Collar, IsPartOfAClosedMeshAtEveryLevelAndAge) {
    for (const std::string& id : brackets)
        for (const double age : {0.0, 0.4, 1.0})
            for (const std::uint32_t seed : {1U, 3U})
                for (int lod = 0; lod < 3; ++lod) {
                    SCOPED_TRACE(id + " at " + std::to_string(age));
                    const MushroomSpec spec = textured(order_of(id, age, seed, lod));
                    EXPECT_EQ(defects(mesh_of(spec)), std::vector<std::string>{}) << lod;
                    EXPECT_GT(collar_count(resolved(spec), lod).triangles, 0U);
                }
}

TEST(Collar, SpreadsOverTheBarkAndGoesIntoTheWood) {
    for (const std::string& id : brackets) {
        const MushroomSpec spec = order_of(id);
        const double size = collar_size(resolved(spec));
        ASSERT_GT(size, 0.0) << id;
        const Mesh mesh = on_wall(spec, resolved(spec).azimuth.base);
        const MeshCount count = collar_count(resolved(spec), 0);
        ASSERT_LT(count.vertices, mesh.positions.size());
        double front = -1.0, back = 1.0;
        for (std::size_t i = mesh.positions.size() - count.vertices; i < mesh.positions.size();
             ++i) {
            front = std::max(front, static_cast<double>(mesh.positions[i].z));
            back = std::min(back, static_cast<double>(mesh.positions[i].z));
        }
        EXPECT_GT(front, 0.3 * size) << id;
        EXPECT_LT(back, -0.3 * size) << id;
    }
}

TEST(Collar, LiesOnTheFacesOfTheBracketOrInsideWhereItReachesOutMost) {
    for (const std::string& id : brackets) {
        MushroomSpec spec = order_of(id);
        // Gills reach beyond it, and it lies on their edges.
        spec.params.hymenium.depth = 0.0;
        const Individual individual = resolved(spec);
        const MeshCount count = collar_count(individual, 0);
        Mesh bare = on_wall(spec, individual.azimuth.base);
        const std::vector<glm::vec3> collar(
            bare.positions.end() - static_cast<std::ptrdiff_t>(count.vertices),
            bare.positions.end());
        bare.indices.resize(bare.indices.size() - 3 * count.triangles);
        TriangleGrid grid(bare);
        float front = 0.0F;
        for (const glm::vec3& place : collar) front = std::max(front, place.z);
        const Solid solid(bare);
        for (const glm::vec3& place : collar) {
            const glm::dvec3 at(place);
            if (place.z < 0.8F * front || solid.contains(at)) continue;
            EXPECT_LT(std::sqrt(grid.squared_distance(at)), 0.3 * collar_size(individual)) << id;
        }
    }
}

TEST(Collar, HasTheImageOfTheFacesOfTheBracket) {
    for (const std::string& id : brackets)
        for (int lod = 0; lod < 3; ++lod) {
            const MushroomSpec spec = textured(order_of(id, 0.6, 2, lod));
            const Mesh mesh = mesh_of(spec);
            const std::size_t count = collar_count(resolved(spec), lod).vertices;
            ASSERT_LT(count, mesh.texture_coordinates.size());
            const std::size_t first = mesh.texture_coordinates.size() - count;
            for (std::size_t i = 0; i < count; ++i) {
                const glm::vec2 at = mesh.texture_coordinates[first + i];
                EXPECT_EQ(part_at(static_cast<double>(at.x), static_cast<double>(at.y)),
                          2 * i < count ? Part::hymenium : Part::cap)
                    << id << ", " << lod;
            }
        }
}

TEST(Collar, BelongsToBracketsAndIsTooSmallFromFarAway) {
    for (const char* id : {"boletus_edulis", "amanita_muscaria", "clathrus_ruber"})
        for (int lod = 0; lod < 4; ++lod)
            EXPECT_EQ(collar_count(resolved(order_of(id)), lod).triangles, 0U) << id;
    for (const std::string& id : brackets)
        EXPECT_EQ(collar_count(resolved(order_of(id)), 3).triangles, 0U) << id;
}

TEST(Collar, IsNotThereWithoutALowerFace) {
    const MushroomSpec spec = order_of("daldinia_concentrica");
    Individual individual = resolved(spec);
    individual.azimuth.base = 0.3;
    EXPECT_EQ(collar_count(individual, 0).triangles, 0U);
    EXPECT_EQ(collar_size(individual), 0.0);
    EXPECT_EQ(defects(mushroom_mesh(spec, individual)), std::vector<std::string>{});
}

TEST(Collar, OfWhatHardlyGrowsFromAWallEnclosesNothing) {
    // At any weight the mesh has the same vertices; those of the collar are in one place.
    const MushroomSpec spec = mix_of({{"boletus_edulis", 990}, {"fomes_fomentarius", 10}});
    const Individual individual = resolved(spec);
    const MeshCount count = collar_count(individual, 0);
    EXPECT_EQ(count.triangles, collar_count(resolved(order_of("fomes_fomentarius")), 0).triangles);
    EXPECT_EQ(collar_size(individual), 0.0);
    const Mesh mesh = mesh_of(spec);
    const std::size_t first = mesh.positions.size() - count.vertices;
    for (std::size_t i = first; i < mesh.positions.size(); ++i)
        EXPECT_EQ(mesh.positions[i], mesh.positions[first]);
}

}  // namespace
}  // namespace sporeprint::geometry_collar_test
