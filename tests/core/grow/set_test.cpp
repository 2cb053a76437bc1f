#include "core/grow/set.h"

#include <gtest/gtest.h>

#include <numeric>
#include <set>
#include <string>

#include "core/grow/mushroom.h"
#include "tests/support/orders.h"

namespace sporeprint::grow_set_test {
namespace {

SetSpec small_set() {
    SetSpec spec;
    spec.species = {{{"amanita_muscaria", 1000}},
                    {{"boletus_edulis", 1000}},
                    {{"amanita_muscaria", 700}, {"boletus_edulis", 300}}};
    spec.params.ages = {0.3, 0.6};
    spec.params.seeds = 4;
    spec.params.levels = {1, 3};
    return spec;
}

SetPlan planned(const SetSpec& spec) { return planned_set(spec, atlas(), {}); }

TEST(Set, ContainsEveryCombinationOnce) {
    const SetSpec spec = small_set();
    const SetPlan plan = planned(spec);
    EXPECT_EQ(plan.seeds, 4);
    EXPECT_EQ(plan.texture_size, 1024);
    ASSERT_EQ(plan.individuals.size(), 3U * 2U * 4U);
    EXPECT_EQ(most_files(spec), 2 * plan.individuals.size());
    std::set<std::string> seen;
    for (const SetIndividual& one : plan.individuals) {
        EXPECT_EQ(one.files.size(), 2U);
        EXPECT_EQ(one.shown, 1U);
        EXPECT_TRUE(seen.insert(std::to_string(one.species) + ' ' + std::to_string(one.params.age) +
                                ' ' + std::to_string(one.params.seed))
                        .second);
    }
}

TEST(Set, EstimatesAreThoseOfItsFiles) {
    const SetSpec spec = small_set();
    const SetPlan plan = planned(spec);
    std::uint64_t bytes = 0;
    for (const SetIndividual& one : plan.individuals)
        for (std::size_t level = 0; level < one.files.size(); ++level) {
            const Estimate alone = estimate(file_spec(spec, one, level), atlas());
            EXPECT_EQ(one.files[level].bytes, alone.bytes);
            EXPECT_EQ(one.files[level].triangles, alone.triangles);
            bytes += alone.bytes;
        }
    EXPECT_EQ(plan.total().bytes, bytes);
}

TEST(Set, KeepsWithinItsBudgets) {
    SetSpec spec = small_set();
    spec.params.draw_calls = 30;  // 3 species, 2 ages, 2 levels: 12 for each seed
    EXPECT_EQ(planned(spec).seeds, 2);
    spec.params.draw_calls = 0;
    const std::uint64_t all = planned(spec).total().bytes;
    std::uint64_t last = all;
    int last_size = 1024;
    for (const double share : {1.0, 0.7, 0.4}) {
        spec.params.megabytes = share * static_cast<double>(all) / 1e6;
        const SetPlan plan = planned(spec);
        EXPECT_LE(static_cast<double>(plan.total().bytes), spec.params.megabytes * 1e6 + 1.0);
        EXPECT_LE(plan.total().bytes, last) << "a smaller budget never gives more";
        EXPECT_LE(plan.texture_size, last_size);
        for (const SetIndividual& one : plan.individuals)
            EXPECT_EQ(one.params.texture_size.value, plan.texture_size);
        last = plan.total().bytes;
        last_size = plan.texture_size;
    }
    EXPECT_LT(last_size, 1024);
    EXPECT_GE(planned(spec).seeds, 1);
}

TEST(Set, RefusesBudgetsThatNothingFitsIntoWithTheLeast) {
    SetSpec spec = small_set();
    spec.params.draw_calls = 11;
    const auto refusal = [&] {
        try {
            (void)planned(spec);
        } catch (const Impossible& impossible) {
            return impossible.problems().at(0);
        }
        return Problem{};
    };
    EXPECT_EQ(refusal().path, "/draw_calls");
    EXPECT_NE(refusal().message.find("needs 12 draw calls"), std::string::npos);
    spec.params.draw_calls = 0;
    spec.params.megabytes = 0.001;
    EXPECT_EQ(refusal().path, "/megabytes");
    // What the refusal names is enough.
    const std::string message = refusal().message;
    spec.params.megabytes = std::stod(message.substr(message.find("needs ") + 6));
    EXPECT_EQ(planned(spec).seeds, 1);
    EXPECT_EQ(planned(spec).texture_size, 128);
}

TEST(Set, DistributesTheIndividualsOfAScene) {
    SetSpec spec = small_set();
    for (const int shown : {1, 7, 24, 100, 301}) {
        spec.params.individuals = shown;
        const SetPlan plan = planned(spec);
        std::uint64_t sum = 0, least = ~std::uint64_t{0}, most = 0;
        for (const SetIndividual& one : plan.individuals) {
            sum += one.shown;
            least = std::min(least, one.shown);
            most = std::max(most, one.shown);
        }
        EXPECT_EQ(sum, static_cast<std::uint64_t>(shown));
        EXPECT_LE(most - least, 1U);
        EXPECT_GE(least, shown >= 6 ? 1U : 0U) << "no file that is never shown";
    }
}

TEST(Set, RepeatedOrMissingValuesAreProblems) {
    SetParams params;
    params.ages = {0.3, 0.6, 0.3};
    params.levels = {};
    std::vector<Problem> problems;
    check(params, Info{.name = ""}, "", problems);
    ASSERT_EQ(problems.size(), 2U);
    EXPECT_EQ(problems[0].path, "/ages/2");
    EXPECT_EQ(problems[1].path, "/levels");
}

}  // namespace
}  // namespace sporeprint::grow_set_test
