#include "core/geometry/budget.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/support/meshes.h"
#include "tests/support/mixes.h"
#include "tests/support/orders.h"

namespace sporeprint::geometry_budget_test {
namespace {

Budget budget_at(const Mix& mix, double age, int lod) {
    return budget_of(resolved(mix_of(mix, age, 3, lod)), lod);
}

TEST(Budget, EverySetKeepsTheTriangleLimitOfItsLevel) {
    const auto expect_within_limit = [](const Mix& mix) {
        for (int lod = 0; lod < 4; ++lod)
            EXPECT_LE(budget_at(mix, 0.6, lod).count.triangles,
                      most_triangles[static_cast<std::size_t>(lod)])
                << text_of(mix) << " lod " << lod;
    };
    for (const auto& [a, b] : some_species_pairs(effort(120)))
        expect_within_limit({{a, 500}, {b, 500}});
    Random random(1, 0x62756467);
    for (std::uint32_t i = 0; i < effort(200); ++i) {
        const auto ids = random_species(random);
        const Mix mix = random_mix(ids, random);
        if (refusal([&] { resolved(mix_of(mix)); }).empty()) expect_within_limit(mix);
    }
}

/// Expects that a set has the patches, shells and blades that its level of detail offers.
void expect_nothing_given_up(const Mix& mix, int lod) {
    const Individual individual = resolved(mix_of(mix, 0.6, 3, lod));
    const Budget budget = budget_of(individual, lod);
    const Detail& whole = detail_of(lod);
    SCOPED_TRACE(text_of(mix) + " lod " + std::to_string(lod));
    EXPECT_EQ(budget.ornaments.patch_sides, whole.patch_sides);
    EXPECT_EQ(budget.ornaments.patch_rings, whole.patch_rings);
    EXPECT_EQ(budget.ornaments.sac_rings, whole.sac_rings);
    EXPECT_EQ(budget.ornaments.patches, whole.patches);
    if (lod > 0 || individual.outline.hymenium.empty()) return;
    const BladeBudget blades = blade_budget(individual, budget.cells.pores > 0);
    EXPECT_EQ(budget.blades.tiers, blades.tiers);
    EXPECT_EQ(budget.blades.veins, blades.veins);
    // Rows beyond six only make blades smoother, and are the first that large sets leave out.
    EXPECT_GE(budget.blades.segments, std::min(blades.segments, 6));
}

TEST(Budget, ASingleSpeciesIsNotCoarsened) {
    for (const std::string& id : swept_ids())
        for (int lod = 0; lod < 4; ++lod) expect_nothing_given_up({{id, 1000}}, lod);
}

TEST(Budget, GranulesAndFineHairsAreBuiltWhereTrianglesAreLeft) {
    const auto surplus = [](const Mix& mix, int lod) {
        return budget_at(mix, 0.6, lod).ornaments.surplus;
    };
    for (const char* const id : {"lycoperdon_perlatum", "cyathus_striatus"}) {
        EXPECT_EQ(surplus({{id, 1000}}, 0), 1.0) << id;
        EXPECT_LT(surplus({{id, 500}, {"amanita_phalloides", 500}}, 0), 1.0)
            << id << ": the gills of the other come first";
        EXPECT_EQ(surplus({{id, 1000}}, 1), 0.0) << id;
    }
    OrnamentDetail detail = detail_of(0);
    EXPECT_EQ(detail.offered(100, sure_patches), 100.0);
    EXPECT_EQ(detail.offered(1000, sure_patches), 1000.0);
    detail.surplus = 0.0;
    EXPECT_EQ(detail.offered(100, sure_patches), 100.0);
    EXPECT_EQ(detail.offered(1000, sure_patches), sure_patches);
}

TEST(Budget, APairIsNotCoarsenedAtTheFinestLevel) {
    for (const auto& [a, b] : species_pairs()) expect_nothing_given_up({{a, 500}, {b, 500}}, 0);
}

TEST(Budget, NoWeightAndNoAgeChangesIt) {
    Random random(2, 0x62756467);
    for (std::uint32_t i = 0; i < effort(20); ++i) {
        const auto ids = random_species(random);
        const int lod = static_cast<int>(i % 2);
        const Budget one = budget_at(random_mix(ids, random), 0.6, lod);
        for (const double age : {0.0, 0.31, 1.0}) {
            const Budget other = budget_at(random_mix(ids, random), age, lod);
            EXPECT_EQ(other.count.vertices, one.count.vertices);
            EXPECT_EQ(other.count.triangles, one.count.triangles);
            EXPECT_EQ(other.ornaments.patch_sides, one.ornaments.patch_sides);
            EXPECT_EQ(other.blades.tiers, one.blades.tiers);
        }
    }
}

TEST(Budget, CountsWhatIsBuilt) {
    Random random(3, 0x62756467);
    for (std::uint32_t i = 0; i < effort(40); ++i) {
        const auto ids = random_species(random);
        const MushroomSpec order =
            textured(mix_of(random_mix(ids, random), random.uniform(), 3, static_cast<int>(i % 4)));
        if (!refusal([&] { resolved(order); }).empty()) continue;
        const Budget budget = budget_of(resolved(order), order.params.lod);
        const Mesh mesh = mesh_of(order);
        // Absent parts keep their vertices, and lose their triangles.
        EXPECT_LE(mesh.positions.size(), budget.count.vertices) << text_of(order.mix);
        EXPECT_GE(static_cast<double>(mesh.positions.size()),
                  0.97 * static_cast<double>(budget.count.vertices))
            << text_of(order.mix);
        EXPECT_LE(mesh.triangles(), budget.count.triangles) << text_of(order.mix);
        const Mesh whole = mesh_of(growing(order));
        EXPECT_LE(whole.triangles(), budget.count.triangles) << text_of(order.mix);
        EXPECT_GE(static_cast<double>(whole.triangles()),
                  0.95 * static_cast<double>(budget.count.triangles))
            << text_of(order.mix);
    }
}

}  // namespace
}  // namespace sporeprint::geometry_budget_test
