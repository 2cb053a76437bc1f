#include "core/geometry/fallen_litter.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <vector>

#include "core/geometry/litter_piece.h"
#include "core/surface/charts.h"
#include "tests/support/meshes.h"
#include "tests/support/orders.h"

namespace sporeprint::geometry_fallen_litter_test {
namespace {

MushroomSpec littered(double age, std::uint32_t seed, int lod = 0) {
    MushroomSpec order = textured(order_of("boletus_edulis", age, seed, lod));
    order.params.base = Base::natural;
    return order;
}

/// The vertices of a mesh in a part, above a height.
std::vector<glm::vec3> part_above(const Mesh& mesh, Part part, float height) {
    std::vector<glm::vec3> found;
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        const glm::vec2 uv = mesh.texture_coordinates[i];
        if (mesh.positions[i].y > height && part_at(uv.x, uv.y) == part)
            found.push_back(mesh.positions[i]);
    }
    return found;
}

TEST(FallenLitter, ItLiesOnTheCap) {
    for (const std::uint32_t seed : {1U, 2U, 3U})
        for (const int lod : {0, 1}) {
            const Mesh mesh = mesh_of(littered(0.7, seed, lod));
            const float half = 0.5F * bounds(mesh).max.y;
            const std::vector<glm::vec3> litter = part_above(mesh, Part::ground, half),
                                         cap = part_above(mesh, Part::cap, 0.0F);
            ASSERT_FALSE(litter.empty()) << seed << ' ' << lod;
            for (const glm::vec3& at : litter) {
                float nearest = 1e9F;
                for (const glm::vec3& on : cap) nearest = std::min(nearest, glm::distance(at, on));
                EXPECT_LT(nearest, lod == 0 ? 0.006F : 0.012F) << seed;
            }
        }
}

TEST(FallenLitter, AYoungCapHasNone) {
    const Mesh mesh = mesh_of(littered(0.15, 1));
    const std::vector<glm::vec3> litter = part_above(mesh, Part::ground, 0.5F * bounds(mesh).max.y);
    // The triangles stay, for the sake of clips, but each piece is a point.
    std::vector<glm::vec3> places;
    for (const glm::vec3& at : litter)
        if (std::none_of(places.begin(), places.end(),
                         [&](const glm::vec3& place) { return glm::distance(place, at) < 1e-5F; }))
            places.push_back(at);
    EXPECT_LE(places.size(), 4U);
}

TEST(FallenLitter, SeedsHaveItElsewhereAndCoarseLevelsHaveNone) {
    const auto of = [](std::uint32_t seed, int lod) {
        const Mesh mesh = mesh_of(littered(0.7, seed, lod));
        return part_above(mesh, Part::ground, 0.5F * bounds(mesh).max.y);
    };
    EXPECT_NE(of(1, 0), of(2, 0));
    EXPECT_TRUE(of(1, 2).empty());
    EXPECT_TRUE(of(1, 3).empty());
}

TEST(FallenLitter, ItsCountIsPredicted) {
    GroundLayer layer;
    layer.style.litter.kind = LitterKind::needles;
    layer.style.litter.fallen = 5;
    const Detail detail = detail_of(DetailLevel(0));
    EXPECT_EQ(fallen_litter_count({layer}, detail).triangles,
              5 * form_of(LitterKind::needles).grid.count().triangles);
    layer.style.litter.fallen = 0;
    EXPECT_EQ(fallen_litter_count({layer}, detail).triangles, 0U);
}

}  // namespace
}  // namespace sporeprint::geometry_fallen_litter_test
