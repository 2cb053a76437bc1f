#include "core/breed/breeding.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "tests/support/atlas.h"

namespace sporeprint::breed_breeding_test {
namespace {

BreedingParams params_with(std::vector<Text<64>> lock) {
    BreedingParams params;
    params.lock = std::move(lock);
    return params;
}

TEST(Genes, BlendAroundTheShareAndNotAtItsEnds) {
    BreedingParams params;
    double sum = 0.0, least = 1.0, most = 0.0;
    for (params.seed = 0; params.seed < 400; ++params.seed) {
        const double share = Genes(params).blended("silhouette");
        sum += share;
        least = std::min(least, share);
        most = std::max(most, share);
    }
    EXPECT_NEAR(sum / 400.0, 0.5, 0.02);
    EXPECT_NEAR(least, 0.5 - 0.175, 0.01);
    EXPECT_NEAR(most, 0.5 + 0.175, 0.01);
    for (const double share : {0.0, 1.0}) {
        params.share = share;
        EXPECT_EQ(Genes(params).blended("silhouette"), share);
        EXPECT_EQ(Genes(params).is_of_second("ring"), share == 1.0);
    }
}

TEST(Genes, ComeFromTheSecondParentAsOftenAsItsShare) {
    BreedingParams params;
    params.share = 0.3;
    int second = 0;
    for (params.seed = 0; params.seed < 2000; ++params.seed)
        second += Genes(params).is_of_second("hymenium") ? 1 : 0;
    EXPECT_NEAR(second / 2000.0, 0.3, 0.04);
}

TEST(Genes, AreDrawnByPathAlone) {
    const BreedingParams free, locked = params_with({Text<64>("surface.cap")});
    for (const char* path : {"surface.stem.bumps", "hymenium", "size"}) {
        EXPECT_EQ(Genes(free).blended(path), Genes(locked).blended(path));
        EXPECT_EQ(Genes(free).mutating(path).normal(), Genes(locked).mutating(path).normal());
    }
    EXPECT_NE(Genes(free).mutating("surface.stem.bumps").normal(),
              Genes(free).mutating("surface.cap.bumps").normal());
}

TEST(Genes, LockAPartWithAllThatBelongsToIt) {
    const BreedingParams params =
        params_with({Text<64>("surface.cap"), Text<64>("ring"), Text<64>("hymenium.blades")});
    const Genes genes(params);
    EXPECT_TRUE(genes.is_locked("surface.cap"));
    EXPECT_TRUE(genes.is_locked("surface.cap.ramp.0"));
    EXPECT_FALSE(genes.is_locked("surface.capital"));
    EXPECT_FALSE(genes.is_locked("surface"));
    EXPECT_TRUE(genes.is_locked("ornaments.ring"));
    EXPECT_FALSE(genes.is_locked("ornaments.warts"));
    EXPECT_TRUE(genes.is_locked_within("hymenium"));
    EXPECT_FALSE(genes.is_locked("hymenium"));
    EXPECT_FALSE(genes.is_locked_within("surface.cap"));
}

TEST(LockableParts, AreThoseOfTheFamily) {
    const auto has = [](const std::vector<std::string>& parts, const char* part) {
        return std::find(parts.begin(), parts.end(), part) != parts.end();
    };
    const auto swept = lockable_parts(atlas().find("amanita_muscaria")->species),
               branched = lockable_parts(atlas().find("ramaria_formosa")->species);
    for (const char* part : {"stages", "size", "spread.size", "ground.soil", "silhouette", "axis",
                             "azimuth.lobes", "surface.cap.ramp", "ornaments.ring"})
        EXPECT_TRUE(has(swept, part)) << part;
    // An outline and an ecology are inherited as wholes.
    EXPECT_FALSE(has(swept, "silhouette.cap"));
    EXPECT_TRUE(has(swept, "ecology"));
    EXPECT_FALSE(has(swept, "ecology.genet"));
    EXPECT_FALSE(has(swept, "limbs"));
    EXPECT_TRUE(has(branched, "limbs.height"));
    EXPECT_TRUE(has(branched, "ramification"));
    EXPECT_FALSE(has(branched, "silhouette"));
}

}  // namespace
}  // namespace sporeprint::breed_breeding_test
