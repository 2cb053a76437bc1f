#include "core/colony/cap.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "core/colony/colony_spec.h"
#include "core/geometry/sweep.h"
#include "tests/support/meshes.h"
#include "tests/support/orders.h"

namespace sporeprint::colony_cap_test {
namespace {

std::vector<std::string> with_stems() {
    std::vector<std::string> ids;
    for (const std::string& id : swept_ids()) {
        ColonySpec spec;
        spec.mix = {{id, 1000}};
        if (colony_traits(spec, atlas()).capped) ids.push_back(id);
    }
    return ids;
}

class EveryCap : public ::testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Species, EveryCap, ::testing::ValuesIn(with_stems()),
                         [](const auto& one) { return one.param; });

TEST_P(EveryCap, IsAClosedMeshAtEveryAgeAndLevel) {
    for (const double age : {0.0, 0.3, 0.6, 1.0})
        for (const int lod : {1, 2, 3})
            for (const double neck : {1.0, 3.0}) {
                SCOPED_TRACE(std::to_string(age) + " lod " + std::to_string(lod) + " neck " +
                             std::to_string(neck));
                const Individual individual = resolved(textured(order_of(GetParam(), age, 3, lod)));
                expect_valid(cap_mesh(individual, {lod, neck, true}));
            }
}

// The neck starts inside a stem of the radius that it is made for, and crosses its surface once,
// below the junction.
TEST_P(EveryCap, IsClosedByADiscInsideItsStem) {
    for (const double neck : {1.0, 2.0}) {
        Individual individual = resolved(order_of(GetParam(), 0.6, 1, 1));
        individual.model.deformation.imperfection = 0.0;
        individual.model.deformation.irregularity = 0.0;
        const double radius = stem_fit(individual).radius / neck;
        const double bottom = -neck_length(neck) * radius;
        individual.has_ring = false;
        individual.layers.clear();
        const Mesh mesh = cap_mesh(individual, {1, neck, false});
        // Rings of the stem come first: the pole, the disc, the neck.
        std::size_t row = 0;
        while (mesh.positions[row] == mesh.positions[0]) ++row;
        ASSERT_GE(row, 41U) << "and columns of cuts";
        const auto radius_of = [&](std::size_t i) {
            const glm::vec3 p = mesh.positions[i];
            return static_cast<double>(std::sqrt(p.x * p.x + p.z * p.z));
        };
        for (std::size_t i = 0; i < row; ++i) {
            EXPECT_EQ(mesh.positions[i], mesh.positions[0]) << "one pole";
            EXPECT_LT(mesh.positions[row + i].y, -0.95 * radius)
                << "below where the stem's skin ends";
            EXPECT_GT(mesh.positions[row + i].y, 1.01 * bottom);
            EXPECT_GT(radius_of(row + i), 0.8 * radius);
            EXPECT_LT(radius_of(row + i), 0.95 * radius);
            if (neck == 1.0) {
                EXPECT_LT(radius_of(2 * row + i), 0.995 * radius) << "still inside";
            }
        }
        int at_junction = 0;
        for (std::size_t i = 0; i < mesh.positions.size(); ++i)
            if (std::abs(mesh.positions[i].y) < 1e-6 &&
                std::abs(radius_of(i) - radius * neck) < 2e-4 * radius)
                ++at_junction;
        EXPECT_GE(at_junction, 2 * 40) << "rings of stem and hymenium";
    }
}

// Above the junction the mesh is that of the whole mushroom: cap and hymenium have the same
// vertices as on their own stem.
TEST_P(EveryCap, EqualsThatOfTheWholeMushroom) {
    Individual individual = resolved(order_of(GetParam(), 0.6, 4, 1));
    individual.axis = AxisCurve();
    individual.model.deformation = {};
    individual.model.deformation.imperfection = 0.0;
    individual.model.weathering = {};
    individual.damage = {};
    individual.layers.clear();
    individual.has_ring = individual.has_sac = false;
    const float junction = static_cast<float>(stem_fit(individual).height);
    const Mesh whole = swept_mesh(individual, 1, {.textured = false});
    const Mesh cap = cap_mesh(individual, {1, 1.0, false});
    ASSERT_LT(cap.positions.size(), whole.positions.size());
    // Rings of the stem come first; counted from the apex, rings are equal.
    const std::size_t own_stem = 41U * static_cast<std::size_t>(detail_of(1).stem_rings);
    const std::size_t compared = whole.positions.size() - own_stem;
    for (std::size_t i = 1; i <= compared; ++i) {
        const glm::vec3 a = whole.positions[whole.positions.size() - i];
        const glm::vec3 b = cap.positions[cap.positions.size() - i];
        EXPECT_EQ(a.x, b.x);
        EXPECT_EQ(a.y - junction, b.y);
        EXPECT_EQ(a.z, b.z);
        if (HasFailure()) return;
    }
}

TEST(Cap, KeepsItsRingOnTheStemOfTheColony) {
    const Individual individual = resolved(order_of("amanita_muscaria", 0.6, 1, 1));
    ASSERT_TRUE(individual.has_ring);
    Individual without = individual;
    without.has_ring = false;
    const Mesh ringed = cap_mesh(individual, {1, 1.0, false}),
               bare = cap_mesh(without, {1, 1.0, false});
    EXPECT_GT(ringed.positions.size(), bare.positions.size());
    EXPECT_LT(bounds(ringed).min.y, bounds(bare).min.y) << "it hangs below the neck";
    const double radius = stem_fit(individual).radius;
    double inner = 1.0;
    for (std::size_t i = bare.positions.size(); i < ringed.positions.size(); ++i) {
        const glm::vec3 p = ringed.positions[i];
        inner = std::min(inner, static_cast<double>(std::sqrt(p.x * p.x + p.z * p.z)));
    }
    EXPECT_LT(inner, radius) << "it begins inside the stem";
    EXPECT_GT(inner, 0.85 * radius);
}

}  // namespace
}  // namespace sporeprint::colony_cap_test
