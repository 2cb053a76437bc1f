#include "core/breed/mutation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <variant>

#include "tests/support/atlas.h"

namespace sporeprint::breed_mutation_test {
namespace {

const Species& species_of(const char* id) { return atlas().find(id)->species; }

Species mutated(const Species& own, std::uint32_t seed, double mutation,
                std::vector<Text<64>> lock = {}) {
    BreedingParams params;
    params.seed = seed;
    params.mutation = mutation;
    params.lock = std::move(lock);
    Species out = own;
    mutate(out, Genes(params));
    return out;
}

TEST(Mutation, OfNothingChangesNothing) {
    for (const AtlasEntry& entry : atlas().entries())
        EXPECT_EQ(mutated(entry.species, 5, 0.0), entry.species);
    EXPECT_EQ(mutated_size(Genes(BreedingParams{.mutation = 0.0})), 1.0);
}

TEST(Mutation, KeepsEverySpeciesValid) {
    for (const AtlasEntry& entry : atlas().entries())
        for (std::uint32_t seed = 0; seed < 5; ++seed) {
            const auto problems = problems_in(mutated(entry.species, seed, 1.0));
            EXPECT_TRUE(problems.empty())
                << entry.species.id.string() << seed << problems.front().path << ' '
                << problems.front().message;
        }
}

TEST(Mutation, DoesNotGrowWhatASpeciesLacks) {
    const Species& own = species_of("boletus_edulis");
    for (std::uint32_t seed = 0; seed < 20; ++seed) {
        const Species other = mutated(own, seed, 1.0);
        for (std::size_t i = 0; i < own.stages.size(); ++i) {
            const Model &before = own.stages[i].model, &after = other.stages[i].model;
            EXPECT_EQ(before.ornaments.glow == 0.0, after.ornaments.glow == 0.0);
            EXPECT_EQ(before.warts.count == 0, after.warts.count == 0);
            EXPECT_EQ(before.ring.width == 0.0, after.ring.width == 0.0);
            EXPECT_EQ(before.weathering.fade == 0.0, after.weathering.fade == 0.0) << i;
        }
    }
}

TEST(Mutation, IsAlikeInAllStages) {
    const Species& own = species_of("amanita_muscaria");
    const Species other = mutated(own, 2, 0.5);
    const Model &first = other.stages.front().model, &last = other.stages.back().model;
    EXPECT_TRUE(last.warts.has_places_of(first.warts));
    EXPECT_NE(first.warts.count, own.stages.front().model.warts.count);
    // Amounts keep the ratio that they have at two ages.
    const auto bumps = [](const Species& species, std::size_t i) {
        return species.stages[i].model.surface.stem.bumps;
    };
    EXPECT_NE(bumps(other, 0), bumps(own, 0));
    EXPECT_NEAR(bumps(other, 0) * bumps(own, 2), bumps(other, 2) * bumps(own, 0), 1e-9);
}

TEST(Mutation, GrowsWithItsAmount) {
    const Species& own = species_of("lactarius_deliciosus");
    const auto distance = [&](double mutation) {
        double sum = 0.0;
        for (std::uint32_t seed = 0; seed < 60; ++seed)
            sum += std::abs(mutated(own, seed, mutation).stages[2].model.surface.cap.roughness -
                            own.stages[2].model.surface.cap.roughness);
        return sum / 60.0;
    };
    const double little = distance(0.1), more = distance(0.3);
    // The mean distance of a normal draw is 0.8 deviations; the range of a roughness is 0.95.
    EXPECT_NEAR(little, 0.8 * 0.25 * 0.95 * 0.1, 0.006);
    EXPECT_GT(more, 2.0 * little);
}

TEST(Mutation, ChangesColoursByHowTheyLook) {
    const Species& own = species_of("amanita_muscaria");
    double sum = 0.0;
    for (std::uint32_t seed = 0; seed < 50; ++seed) {
        const Colour before = own.stages[2].model.surface.stem.top,
                     after = mutated(own, seed, 0.5).stages[2].model.surface.stem.top;
        sum += std::abs(before.r - after.r) + std::abs(before.g - after.g) +
               std::abs(before.b - after.b);
    }
    EXPECT_GT(sum / 50.0, 5.0);
    EXPECT_LT(sum / 50.0, 60.0);
}

TEST(Mutation, LeavesLockedPartsAndChangesNoOther) {
    const Species& own = species_of("amanita_muscaria");
    const Species free = mutated(own, 4, 0.5),
                  locked = mutated(own, 4, 0.5, {Text<64>("surface.cap"), Text<64>("ring")});
    for (std::size_t i = 0; i < own.stages.size(); ++i) {
        Model expected = free.stages[i].model;
        expected.surface.cap = own.stages[i].model.surface.cap;
        expected.ring = own.stages[i].model.ring;
        expected.ornaments.ring = own.stages[i].model.ornaments.ring;
        EXPECT_EQ(locked.stages[i].model, expected);
        EXPECT_NE(locked.stages[i].model, free.stages[i].model);
    }
}

TEST(Mutation, ScalesAWholeWithinTheRangeOfSizes) {
    BreedingParams params;
    params.mutation = 1.0;
    double least = 10.0, most = 0.0;
    for (params.seed = 0; params.seed < 500; ++params.seed) {
        const double factor = mutated_size(Genes(params));
        least = std::min(least, factor);
        most = std::max(most, factor);
    }
    EXPECT_GE(least, 0.25);
    EXPECT_LE(most, 4.0);
    EXPECT_LT(least, 0.4);
    EXPECT_GT(most, 2.5);
}

}  // namespace
}  // namespace sporeprint::breed_mutation_test
