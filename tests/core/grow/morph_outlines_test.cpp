// Outlines of mixes as they are swept: whatever the species, ages and weights, none touches itself and none leaves its side of the axis.
#include <gtest/gtest.h>

#include <array>
#include <memory>
#include <string>
#include <vector>

#include "core/silhouette/proof.h"
#include "tests/support/mixes.h"

namespace sporeprint {
namespace {

/// The set of control shapes that mixes of these species are made of.
std::shared_ptr<const MorphSet> set_of(const std::vector<std::string>& ids) {
    Mix mix;
    for (const std::string& id : ids) mix.push_back({id, 1});
    mix.front().weight = 1001 - static_cast<int>(ids.size());
    std::shared_ptr<const MorphSet> found;
    (void)resolve(mix_of(mix), atlas(), [&](const std::string& key, const auto& make) {
        return found = kept_morphs()(key, make);
    });
    return found;
}

/// Weights of all control shapes: those of the species, each times the growth of its stages at its age.
std::vector<double> weights_of(const MorphSet& set, const std::vector<std::string>& ids,
                               const std::vector<double>& shares, const std::vector<double>& ages) {
    std::vector<double> weights;
    for (std::size_t kin = 0; kin < ids.size(); ++kin) {
        const std::size_t count = atlas().find(ids[kin])->species.stages.size();
        const std::vector<double> growth = set.growth_weights(ages[kin]);
        for (std::size_t i = weights.size(), end = i + count; i < end; ++i)
            weights.push_back(shares[kin] * growth[i]);
    }
    return weights;
}

/// What is wrong with an outline at any level of detail; empty when nothing is.
std::string fault_of(const MorphSet& set, const std::vector<double>& weights) {
    const Outline outline(set.nodes(weights), set.places());
    for (int lod = 0; lod < 4; ++lod) {
        const Polyline line = polyline(outline, lod);
        for (const glm::dvec2& p : line)
            if (!(p.x >= 0.0)) return "r < 0 at lod " + std::to_string(lod);
        if (const auto contact = contact_at_rest(line))
            return "segments " + std::to_string(contact->i) + " and " + std::to_string(contact->j) +
                   " touch at lod " + std::to_string(lod);
    }
    return "";
}

class PairOutlines : public ::testing::TestWithParam<std::pair<std::string, std::string>> {};

INSTANTIATE_TEST_SUITE_P(Atlas, PairOutlines, ::testing::ValuesIn(species_pairs()),
                         [](const auto& one) {
                             return one.param.first + "_and_" + one.param.second;
                         });

TEST_P(PairOutlines, AreSimpleAllTheWayBetweenEveryPairOfAges) {
    const std::vector<std::string> ids = {GetParam().first, GetParam().second};
    const auto set = set_of(ids);
    constexpr std::array<double, 5> ages = {0.0, 0.25, 0.5, 0.75, 1.0};
    for (const double a : ages)
        for (const double b : ages) {
            const auto from = weights_of(*set, ids, {1.0, 0.0}, {a, b});
            const auto to = weights_of(*set, ids, {0.0, 1.0}, {a, b});
            EXPECT_TRUE(set->certificate(from, to).simple) << "ages " << a << " and " << b;
            // The proof is believed, and looked at.
            for (int i = 0; i <= 32; ++i)
                EXPECT_EQ(fault_of(*set, weights_of(*set, ids, {1.0 - i / 32.0, i / 32.0}, {a, b})),
                          "")
                    << "ages " << a << " and " << b << ", t " << i << "/32";
        }
}

class RandomOutlines : public ::testing::TestWithParam<std::uint32_t> {};

INSTANTIATE_TEST_SUITE_P(Tenths, RandomOutlines, ::testing::Range(0u, 10u));

TEST_P(RandomOutlines, OfTenThousandMixesAreSimple) {
    for (std::uint32_t i = 0; i < 10'000; ++i) {
        Random random(GetParam() * 10'000 + i, 0x6f75746c);
        const Mix mix = random_mix(random);
        // Mostly of one age, as they are served; the proof holds for different ages, too.
        const bool one_age = random.bits() % 4 != 0;
        const double age = random.uniform();
        std::vector<std::string> ids;
        std::vector<double> shares, ages;
        for (const MixPart& part : mix) {
            const double own = random.uniform();
            ids.push_back(part.id);
            shares.push_back(part.weight / 1000.0);
            ages.push_back(one_age ? age : own);
        }
        const auto set = set_of(ids);
        const std::string fault = fault_of(*set, weights_of(*set, ids, shares, ages));
        ASSERT_EQ(fault, "") << text_of(mix) << (one_age ? " age " : " ages differ, first ")
                             << ages.front();
    }
}

}  // namespace
}  // namespace sporeprint
