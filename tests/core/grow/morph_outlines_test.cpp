// Outlines of mixes as they are swept: for all species, ages and weights none intersects itself or
// crosses the axis.
#include <gtest/gtest.h>

#include <array>
#include <memory>
#include <string>
#include <vector>

#include "core/silhouette/proof.h"
#include "tests/support/mixes.h"

namespace sporeprint::grow_morph_outlines_test {
namespace {

/// Returns the set of control shapes that mixes of these species consist of.
std::shared_ptr<const MorphSet> set_of(const std::vector<std::string>& ids) {
    Mix mix;
    for (const std::string& id : ids) mix.push_back({id, 1});
    mix.front().weight = 1001 - static_cast<int>(ids.size());
    std::shared_ptr<const MorphSet> found;
    (void)resolve(mix_of(mix), atlas(), [&](const std::string& key, const auto& make) {
        return found = cached_morphs()(key, make);
    });
    return found;
}

/// Returns the weights of all control shapes: those of the species, each times the growth of its
/// stages at its age.
std::vector<double> weights_of(const MorphSet& set, const std::vector<std::string>& ids,
                               const std::vector<double>& shares, const std::vector<double>& ages) {
    std::vector<double> weights;
    for (std::size_t species_index = 0; species_index < ids.size(); ++species_index) {
        const std::size_t count = atlas().find(ids[species_index])->species.stages.size();
        const std::vector<double> growth = set.growth_weights(ages[species_index]);
        for (std::size_t i = weights.size(), end = i + count; i < end; ++i)
            weights.push_back(shares[species_index] * growth[i]);
    }
    return weights;
}

/// Returns what is wrong with an outline at any level of detail; empty when nothing is.
std::string error_of(const MorphSet& set, const std::vector<double>& weights) {
    const Outline outline(set.nodes(weights));
    for (int lod = 0; lod < 4; ++lod) {
        const Polyline line = polyline(outline, lod);
        for (const glm::dvec2& p : line)
            if (!(p.x >= 0.0)) return "r < 0 at lod " + std::to_string(lod);
        if (const auto contact = static_intersection(line))
            return "segments " + std::to_string(contact->i) + " and " + std::to_string(contact->j) +
                   " touch at lod " + std::to_string(lod);
    }
    return "";
}

/// Distributes many cases over threads.
class Parts : public ::testing::TestWithParam<std::size_t> {
  protected:
    static constexpr std::size_t parts = 8;
};

class PairOutlines : public Parts {};
class RandomOutlines : public Parts {};

INSTANTIATE_TEST_SUITE_P(Eighths, PairOutlines, ::testing::Range(std::size_t{0}, std::size_t{8}));
INSTANTIATE_TEST_SUITE_P(Eighths, RandomOutlines, ::testing::Range(std::size_t{0}, std::size_t{8}));

TEST_P(PairOutlines, AreRefusedForNoPairOfTheAtlas) {
    // Individuals with their own proportions, as far from their templates as possible: a mix of a
    // pair is never refused.
    const auto pairs = sanitized ? some_species_pairs(8) : species_pairs();
    for (std::size_t i = GetParam(); i < pairs.size(); i += parts)
        for (const double age : {0.0, 0.25, 0.5, 0.75, 1.0})
            for (const int t : {250, 500, 750}) {
                MushroomSpec spec = mix_of({{pairs[i].first, 1000 - t}, {pairs[i].second, t}}, age,
                                           static_cast<std::uint32_t>(i));
                spec.params.variation = 1.0;
                EXPECT_NO_THROW((void)resolve(spec, atlas(), cached_morphs()))
                    << text_of(spec.mix) << ", age " << age;
            }
}

TEST_P(PairOutlines, AreSimpleBetweenEveryPairOfAges) {
    // Every pair of the atlas; with sanitizers only some.
    const auto pairs = sanitized ? some_species_pairs(8) : species_pairs();
    constexpr std::array<double, 5> ages = {0.0, 0.25, 0.5, 0.75, 1.0};
    const int looks = static_cast<int>(effort(32, 4));
    for (std::size_t i = GetParam(); i < pairs.size(); i += parts) {
        SCOPED_TRACE(pairs[i].first + " and " + pairs[i].second);
        const std::vector<std::string> ids = {pairs[i].first, pairs[i].second};
        const auto set = set_of(ids);
        for (const double a : ages)
            for (const double b : ages) {
                const auto from = weights_of(*set, ids, {1.0, 0.0}, {a, b});
                const auto to = weights_of(*set, ids, {0.0, 1.0}, {a, b});
                EXPECT_TRUE(set->certificate(from, to).simple) << "ages " << a << " and " << b;
                // The proof is checked against samples.
                for (int look = 0; look <= looks; ++look) {
                    const double t = static_cast<double>(look) / looks;
                    EXPECT_EQ(error_of(*set, weights_of(*set, ids, {1.0 - t, t}, {a, b})), "")
                        << "ages " << a << " and " << b << ", t " << t;
                }
            }
    }
}

TEST_P(RandomOutlines, OfAHundredThousandMixesAreSimple) {
    // Five hundred sets of two to eight species, with two hundred mixes each.
    for (std::size_t i = GetParam(); i < effort(500); i += parts) {
        Random random(static_cast<std::uint32_t>(i), 0x6f75746c);
        const auto ids = random_species(random);
        const auto set = set_of(ids);
        for (int draw = 0; draw < 200; ++draw) {
            // Mostly of one age, as they are served; the proof also holds for different ages, and
            // for any stages.
            std::vector<double> weights;
            std::string what;
            if (draw % 10 == 0) {
                double sum = 0.0;
                while (sum == 0.0) {
                    weights.assign(set->size(), 0.0);
                    for (double& w : weights)
                        if (random.bits() % 2 == 0) sum += w = random.uniform();
                }
                for (double& w : weights) w /= sum;
                what = "any stages";
            } else {
                const Mix mix = random_mix(ids, random);
                const bool one_age = draw % 10 < 7;
                const double age = random.uniform();
                std::vector<double> shares, ages;
                for (const MixPart& part : mix) {
                    shares.push_back(part.weight / 1000.0);
                    ages.push_back(one_age ? age : random.uniform());
                }
                weights = weights_of(*set, ids, shares, ages);
                what = text_of(mix) + (one_age ? " age " : " ages differ, first ") +
                       std::to_string(ages.front());
            }
            ASSERT_EQ(error_of(*set, weights), "") << "set " << i << ": " << what;
        }
    }
}

}  // namespace
}  // namespace sporeprint::grow_morph_outlines_test
