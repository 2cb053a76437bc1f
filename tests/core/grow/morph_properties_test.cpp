// Properties of mixes over all modules: nothing folds, nothing jumps, weight 1 reproduces the
// single-species mesh.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "core/geometry/budget.h"
#include "tests/support/meshes.h"
#include "tests/support/mixes.h"
#include "tests/support/surfaces.h"

namespace sporeprint::grow_morph_properties_test {
namespace {

/// Tolerance that a deviation is compared with.
double height(const Mesh& mesh) {
    const Bounds box = bounds(mesh);
    return static_cast<double>(box.max.y - box.min.y);
}

/// 0.3 % of a mesh's height, metres.
double hairs_breadth(const Mesh& mesh) { return 0.003 * height(mesh); }

/// The same, or 0.13 % of its diagonal for flat meshes (a star, a bracket, an old cup), where a
/// small deviation is more of the height.
double hairs_breadth_of_flat(const Mesh& mesh) {
    return std::max(hairs_breadth(mesh), 0.0013 * diagonal(bounds(mesh)));
}

bool has_segments(const MushroomSpec& spec) {
    return is_branched(atlas().find(spec.mix.front().id)->species);
}

/// Returns true when a set has so many triangles that its patches have fewer corners than those of
/// a single species.
bool is_crowded(const MushroomSpec& spec) {
    return budget_of(resolved(spec), spec.params.lod).ornaments.patch_sides <
           detail_of(spec.params.lod).patch_sides;
}

/// Returns true when a species of a set has hanging spines.
bool has_spines(const MushroomSpec& spec) { return !resolved(spec).spines.empty(); }

/// Returns the same order without warts and scales, as far as its species can have any.
MushroomSpec without_patches(MushroomSpec spec) {
    const auto& has = resolved(spec).effective.ornaments;
    auto& requested = spec.params.ornaments;
    for (const auto amount :
         {&OrnamentsOf<Maybe>::warts, &OrnamentsOf<Maybe>::scales, &OrnamentsOf<Maybe>::volva})
        if (has.*amount) requested.*amount = 0.0;
    return spec;
}

/// Returns true when a set at LOD 0 has triangles for all rows of its gills and spines.
bool has_all_rows(const MushroomSpec& spec) {
    const Individual individual = resolved(spec);
    const Budget budget = budget_of(individual, 0);
    const BladeBudget blades = blade_budget(individual, budget.cells.pores > 0);
    return budget.blades.segments == blades.segments && budget.blades.below == blades.below &&
           budget.blades.vein_segments == blades.vein_segments &&
           budget.cells.rings == cell_budget(individual).rings;
}

/// Leaves out of both orders the patches of a set at LOD 0 that has no triangles for all granules
/// and hairs of its species, and all rows of its gills. Returns false when such a set has spines,
/// which no order leaves out, or still has too many triangles for all rows.
bool comparable(MushroomSpec& alone, MushroomSpec& beside) {
    if (budget_of(resolved(beside), 0).ornaments.surplus >= 1.0 && has_all_rows(beside))
        return true;
    alone = without_patches(alone);
    beside = without_patches(beside);
    return !has_spines(beside) && has_all_rows(beside);
}

/// Expects that a species mixed with a thousandth of another deviates by at most `allowance`,
/// without its gills; these follow in expect_solids_converge().
void expect_convergence(MushroomSpec alone, MushroomSpec beside, double (*allowance)(const Mesh&)) {
    if (!has_segments(alone)) alone.params.hymenium.depth = beside.params.hymenium.depth = 0.0;
    if (!comparable(alone, beside)) return;
    const Mesh pure = mesh_of(alone), mixed = mesh_of(beside);
    EXPECT_LT(hausdorff(pure, mixed), allowance(pure))
        << text_of(beside.mix) << ", age " << alone.params.age;
    // Layers of no thickness on the surface would be noticed only by their area.
    EXPECT_NEAR(area(mixed) / area(pure), 1.0, 0.02)
        << text_of(beside.mix) << ", age " << alone.params.age;
}

/// The same with gills, pores and spines.
void expect_solids_converge(MushroomSpec alone, MushroomSpec beside) {
    if (has_segments(alone)) return expect_convergence(alone, beside, hairs_breadth_of_flat);
    if (!comparable(alone, beside)) return;
    const Mesh pure = mesh_of(alone), mixed = mesh_of(beside);
    EXPECT_LT(hausdorff(pure, mixed), hairs_breadth(pure)) << text_of(beside.mix);
    EXPECT_NEAR(area(mixed) / area(pure), 1.0, 0.02) << text_of(beside.mix);
}

class EveryPair : public ::testing::TestWithParam<std::size_t> {
  protected:
    static constexpr std::size_t parts = 8;
};

INSTANTIATE_TEST_SUITE_P(Eighths, EveryPair, ::testing::Range(std::size_t{0}, std::size_t{8}));

TEST_P(EveryPair, ConvergesToEitherSpecies) {
    // Every pair of the atlas takes four minutes on two cores: SPOREPRINT_EFFORT=3 tests all.
    const auto pairs = some_species_pairs(effort(210));
    for (std::size_t i = GetParam(); i < pairs.size(); i += parts)
        for (const auto& [corner, near] : {std::pair{0, 1}, std::pair{1000, 999}}) {
            const auto at = [&pair = pairs[i]](int t) {
                return mix_of(present({{pair.first, 1000 - t}, {pair.second, t}}), 0.6, 3, 0);
            };
            expect_convergence(at(corner), at(near), hairs_breadth);
        }
}

// Meshes of a sample of pairs; outlines of every pair are tested in morph_outlines_test.cpp.
class SomePairs : public ::testing::TestWithParam<SpeciesPair> {
  protected:
    /// Returns the pair at t thousandths from its first species to its second.
    [[nodiscard]] static MushroomSpec at(int t, double age = 0.6, std::uint32_t seed = 3,
                                         int lod = 1) {
        const auto& [a, b] = GetParam();
        return mix_of(present({{a, 1000 - t}, {b, t}}), age, seed, lod);
    }
};

INSTANTIATE_TEST_SUITE_P(Atlas, SomePairs, ::testing::ValuesIn(some_species_pairs(effort(105))),
                         [](const auto& one) {
                             return one.param.first + "_and_" + one.param.second;
                         });

INSTANTIATE_TEST_SUITE_P(Branched, SomePairs, ::testing::ValuesIn(branched_pairs()),
                         [](const auto& one) {
                             return one.param.first + "_and_" + one.param.second;
                         });

TEST_P(SomePairs, ConvergesToEitherSpeciesWhenYoungAndWhenOld) {
    for (const auto& [age, corner] : {std::pair{0.1, 1000}, std::pair{1.0, 0}})
        expect_convergence(at(corner, age, 3, 0), at(std::abs(corner - 1), age, 3, 0),
                           hairs_breadth_of_flat);
}

TEST_P(SomePairs, SolidsConvergeToThoseOfEitherSpecies) {
    for (const auto& [corner, near] : {std::pair{0, 1}, std::pair{1000, 999}})
        expect_solids_converge(at(corner, 0.6, 3, 0), at(near, 0.6, 3, 0));
}

TEST_P(SomePairs, HasNoJumpFromOneSpeciesToTheOther) {
    for (const double age : {0.3, 0.6}) {
        Mesh last = mesh_of(at(0, age));
        double worst = 0.0, worst_corner = 0.0;
        int where = 0;
        for (int t = 4; t <= 1000; t += 4) {  // a little more than 1/256
            Mesh now = mesh_of(at(t, age));
            // A single species has its own rings: there the surfaces are compared, between mixes
            // the vertices.
            const bool corner = t == 4 || t == 1000;
            const double share = (corner ? hausdorff(last, now) : jump(last, now)) /
                                 std::min(diagonal(bounds(last)), diagonal(bounds(now)));
            // At coarse levels a mix of branch graphs keeps other small segments than either
            // species alone, and a mix with spines builds fewer of them.
            if (corner && (has_segments(at(500, age)) || has_spines(at(500, age))))
                worst_corner = std::max(worst_corner, share);
            else if (share > worst) {
                worst = share;
                where = t;
            }
            last = std::move(now);
        }
        EXPECT_LT(worst, 0.02) << "t " << where << ", age " << age;
        EXPECT_LT(worst_corner, 0.05) << "age " << age;
    }
}

TEST_P(SomePairs, HasNoJumpWhileItGrows) {
    const double size = diagonal(bounds(mesh_of(at(500))));
    Mesh last = mesh_of(at(500, 0.0));
    double worst = 0.0;
    int where = 0;
    for (int i = 1; i <= 256; ++i) {
        Mesh now = mesh_of(at(500, i / 256.0));
        const double share = jump(last, now) / size;
        if (share > worst) {
            worst = share;
            where = i;
        }
        last = std::move(now);
    }
    EXPECT_LT(worst, 0.02) << "age " << where << "/256";
}

TEST_P(SomePairs, HasAsManyVerticesAtEveryWeightAndAge) {
    for (const int lod : {0, 1, 2, 3}) {
        const std::size_t count = mesh_of(at(500, 0.6, 3, lod)).positions.size();
        for (const int t : {1, 120, 640, 999})
            for (const double age : {0.0, 0.17, 0.45, 0.8, 1.0})
                EXPECT_EQ(mesh_of(at(t, age, 3, lod)).positions.size(), count)
                    << "lod " << lod << ", t " << t << ", age " << age;
    }
}

TEST_P(SomePairs, NewPiecesBeginSmall) {
    // Sixteen times as close to its first appearance a piece is sixteen times as small; tested
    // along age, where amounts pass zero.
    const double size = diagonal(bounds(mesh_of(at(500))));
    // While such a mix grows, single spines move at a step, as a whole and by up to a millimetre.
    const double bar = has_spines(at(500)) ? 0.02 : 0.02 / 16.0;
    for (const double age : {0.0, 0.2, 0.3, 0.55, 0.6, 0.8, 0.85, 0.97}) {
        Mesh last = mesh_of(at(500, age));
        for (int i = 1; i <= 16; ++i) {
            Mesh now = mesh_of(at(500, age + i / 4096.0));
            EXPECT_LT(jump(last, now), bar * size) << "age " << age << " + " << i << "/4096";
            last = std::move(now);
        }
    }
}

class RandomMixes : public ::testing::TestWithParam<std::uint32_t> {};

INSTANTIATE_TEST_SUITE_P(Tenths, RandomMixes, ::testing::Range(0u, 10u));

TEST_P(RandomMixes, AreValidMeshes) {
    // Two thousand in all: twenty sets of species per tenth, and ten mixes of each.
    int drawn = 0, refused = 0;
    for (std::uint32_t i = 0; i < effort(20); ++i) {
        Random random(GetParam() * 20 + i, 0x6d6978);
        const auto ids = random_species(random);
        for (int draw = 0; draw < 10; ++draw) {
            const Mix mix = random_mix(ids, random);
            const double age = random.uniform();
            const std::uint32_t seed = random.bits();
            const int lod = static_cast<int>(random.bits() % 4);
            MushroomSpec spec = textured(mix_of(mix, age, seed, lod));
            spec.params.variation = random.uniform();
            SCOPED_TRACE(text_of(mix) + " age " + std::to_string(age) + " seed " +
                         std::to_string(seed) + " lod " + std::to_string(lod) + " variation " +
                         std::to_string(spec.params.variation));
            ++drawn;
            Mesh mesh;
            const auto problems = refusal([&] { mesh = mesh_of(spec); });
            if (!problems.empty()) {  // no valid outline: reported, never served
                EXPECT_TRUE(problems.front().path.starts_with("/model/silhouette/"));
                ++refused;
                continue;
            }
            expect_valid(mesh);
            EXPECT_EQ(mesh.tangents.size(), mesh.positions.size());
            if (HasFailure()) return;
        }
    }
    // A set of eight may be too fine for the three rings of the last level of detail at any
    // weights: at most one of twenty sets.
    EXPECT_LE(20 * refused, drawn);
}

TEST(Morph, TheSurfaceOfEightSpeciesConvergesTowardsWeightOne) {
    const auto ids = swept_ids();
    for (std::size_t corner = 0; corner < ids.size(); ++corner) {
        Mix mix;
        for (std::size_t k = 0; k < 8; ++k)
            mix.push_back(
                {ids[(corner + k * std::max<std::size_t>(ids.size() / 8, 1)) % ids.size()],
                 k == 0 ? 993 : 1});
        std::sort(mix.begin(), mix.end(),
                  [](const MixPart& a, const MixPart& b) { return a.id < b.id; });
        const std::string& id = ids[corner];
        MushroomSpec alone = order_of(id, 0.6, 3, 0), beside = mix_of(mix, 0.6, 3, 0);
        alone.params.hymenium.depth = beside.params.hymenium.depth = 0.0;
        // A crowded set has fewer spines, and a net of fewer meshes, at other places.
        if (budget_of(resolved(beside), 0).ornaments.free_solids < 1.0) continue;
        if (!comparable(alone, beside)) continue;
        if (is_crowded(beside)) {  // corners of its patches differ
            alone = without_patches(alone);
            beside = without_patches(beside);
        }
        const Mesh pure = mesh_of(alone), mixed = mesh_of(beside);
        // Seven thousandths of others instead of one: twice the tolerance.
        EXPECT_LT(hausdorff(pure, mixed), 2 * hairs_breadth_of_flat(pure)) << id;
    }
}

TEST(Morph, TheOrderOfSpeciesDoesNotMatter) {
    Mix mix = {{"amanita_muscaria", 300}, {"boletus_edulis", 300}, {"coprinus_comatus", 400}};
    MushroomSpec spec = painted(mix_of(mix, 0.45, 11, 1));
    const Bytes first = joined(grow_mushroom(spec, atlas()).glb);
    const auto by_id = [](const MixPart& a, const MixPart& b) { return a.id < b.id; };
    int orders = 0;
    while (std::next_permutation(spec.mix.begin(), spec.mix.end(), by_id)) {
        EXPECT_EQ(joined(grow_mushroom(spec, atlas()).glb), first) << text_of(spec.mix);
        ++orders;
    }
    EXPECT_EQ(orders, 5);
}

}  // namespace
}  // namespace sporeprint::grow_morph_properties_test
