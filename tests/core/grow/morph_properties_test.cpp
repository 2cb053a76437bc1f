// Properties of mixes that no room can show alone: nothing folds, nothing jumps, a corner is the species itself.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "tests/support/meshes.h"
#include "tests/support/mixes.h"
#include "tests/support/surfaces.h"

namespace sporeprint {
namespace {

/// What a deviation is compared with: the height of a mature mushroom. A cup that lies flat is up to four times as wide as high, and a
/// thousandth of the way to a slender stem is more than that of its height; for it, and for eggs and buttons, it is the diagonal.
double size(const Mesh& mesh, double age) {
    const Bounds box = bounds(mesh);
    const glm::vec3 sides = box.max - box.min;
    const bool flat =
        static_cast<double>(sides.y) < 0.6 * static_cast<double>(std::max(sides.x, sides.z));
    return flat || age != 0.6 ? diagonal(box) : static_cast<double>(sides.y);
}

// Meshes of a sample of pairs; outlines of every pair are looked at in morph_outlines_test.cpp.
class SomePairs : public ::testing::TestWithParam<SpeciesPair> {
  protected:
    /// The pair at t thousandths of the way from its first species to its second.
    [[nodiscard]] static MushroomOrder at(int t, double age = 0.6, std::uint32_t seed = 3,
                                          int lod = 1) {
        const auto& [a, b] = GetParam();
        return mix_of(present({{a, 1000 - t}, {b, t}}), age, seed, lod);
    }
};

INSTANTIATE_TEST_SUITE_P(Atlas, SomePairs, ::testing::ValuesIn(some_species_pairs(effort(105))),
                         [](const auto& one) {
                             return one.param.first + "_and_" + one.param.second;
                         });

TEST_P(SomePairs, ConvergesToEitherSpecies) {
    for (const double age : {0.1, 0.6, 1.0})
        for (const auto& [corner, near] : {std::pair{0, 1}, std::pair{1000, 999}}) {
            if (age != 0.6 && (age < 0.6) == (corner == 0)) continue;  // one corner will do
            // The finest level: rings of others stand elsewhere along a meridian, and their chords with them.
            const Mesh pure = mesh_of(at(corner, age, 3, 0)), mixed = mesh_of(at(near, age, 3, 0));
            EXPECT_LT(hausdorff(pure, mixed), 0.003 * size(pure, age))
                << "t " << near << ", age " << age;
            // Layers of no thickness that lie on the surface would be seen by nothing but their area.
            EXPECT_NEAR(area(mixed) / area(pure), 1.0, 0.02) << "t " << near << ", age " << age;
        }
}

TEST_P(SomePairs, HasNoJumpFromOneSpeciesToTheOther) {
    for (const double age : {0.3, 0.6}) {
        Mesh last = mesh_of(at(0, age));
        double worst = 0.0;
        int where = 0;
        for (int t = 4; t <= 1000; t += 4) {  // a little more than 1/256
            Mesh now = mesh_of(at(t, age));
            // A lone species has rings of its own: there the surfaces are compared, between mixes the vertices.
            const bool corner = t == 4 || t == 1000;
            const double share = (corner ? hausdorff(last, now) : jump(last, now)) /
                                 std::min(diagonal(bounds(last)), diagonal(bounds(now)));
            if (share > worst) {
                worst = share;
                where = t;
            }
            last = std::move(now);
        }
        EXPECT_LT(worst, 0.02) << "t " << where << ", age " << age;
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

TEST_P(SomePairs, WhatIsBornIsBornSmall) {
    // Sixteen times as close to its birth a piece is sixteen times as small: looked for along age, where amounts pass zero.
    const double size = diagonal(bounds(mesh_of(at(500))));
    for (const double age : {0.0, 0.2, 0.3, 0.55, 0.6, 0.8, 0.85, 0.97}) {
        Mesh last = mesh_of(at(500, age));
        for (int i = 1; i <= 16; ++i) {
            Mesh now = mesh_of(at(500, age + i / 4096.0));
            EXPECT_LT(jump(last, now), 0.02 / 16.0 * size)
                << "age " << age << " + " << i << "/4096";
            last = std::move(now);
        }
    }
}

class RandomMixes : public ::testing::TestWithParam<std::uint32_t> {};

INSTANTIATE_TEST_SUITE_P(Tenths, RandomMixes, ::testing::Range(0u, 10u));

TEST_P(RandomMixes, AreValidMeshes) {
    // Two thousand in all: twenty sets of species a tenth, and ten mixes of each.
    for (std::uint32_t i = 0; i < effort(20); ++i) {
        Random random(GetParam() * 20 + i, 0x6d6978);
        const auto ids = random_species(random);
        for (int draw = 0; draw < 10; ++draw) {
            const Mix mix = random_mix(ids, random);
            const double age = random.uniform();
            const std::uint32_t seed = random.bits();
            const int lod = static_cast<int>(random.bits() % 4);
            MushroomOrder order = textured(mix_of(mix, age, seed, lod));
            order.params.variation = random.uniform();
            SCOPED_TRACE(text_of(mix) + " age " + std::to_string(age) + " seed " +
                         std::to_string(seed) + " lod " + std::to_string(lod) + " variation " +
                         std::to_string(order.params.variation));
            const Mesh mesh = mesh_of(order);
            expect_valid(mesh);
            EXPECT_EQ(mesh.tangents.size(), mesh.positions.size());
            if (HasFailure()) return;
        }
    }
}

TEST(Morph, TowardsACornerOfEightSpeciesTheSurfaceConverges) {
    const auto ids = species_ids();
    for (std::size_t corner = 0; corner < ids.size(); ++corner) {
        Mix mix;
        for (std::size_t k = 0; k < 8; ++k)
            mix.push_back(
                {ids[(corner + k * std::max<std::size_t>(ids.size() / 8, 1)) % ids.size()],
                 k == 0 ? 993 : 1});
        std::sort(mix.begin(), mix.end(),
                  [](const MixPart& a, const MixPart& b) { return a.id < b.id; });
        const std::string& id = ids[corner];
        const Mesh pure = mesh_of(order_of(id, 0.6, 3, 1)), mixed = mesh_of(mix_of(mix, 0.6, 3, 1));
        EXPECT_LT(hausdorff(pure, mixed), 7 * 0.003 * size(pure, 0.6)) << id;
    }
}

TEST(Morph, TheOrderOfSpeciesDoesNotMatter) {
    Mix mix = {{"amanita_muscaria", 300}, {"boletus_edulis", 300}, {"coprinus_comatus", 400}};
    MushroomOrder order = painted(mix_of(mix, 0.45, 11, 1));
    const Bytes first = joined(grow_mushroom(order, atlas()).glb);
    const auto by_id = [](const MixPart& a, const MixPart& b) { return a.id < b.id; };
    int orders = 0;
    while (std::next_permutation(order.mix.begin(), order.mix.end(), by_id)) {
        EXPECT_EQ(joined(grow_mushroom(order, atlas()).glb), first) << text_of(order.mix);
        ++orders;
    }
    EXPECT_EQ(orders, 5);
}

}  // namespace
}  // namespace sporeprint
