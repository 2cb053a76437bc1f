#include "core/model/ecology.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <set>
#include <string>
#include <vector>

#include "core/math/purposes.h"
#include "core/math/random.h"
#include "core/params/reader.h"

namespace sporeprint::model_ecology_test {
namespace {

TEST(Response, IsATrapezium) {
    const ShareResponse response{{0.2, 1.0}, {0.4, 0.6}};
    EXPECT_EQ(response.at(0.0), 0.0);
    EXPECT_EQ(response.at(0.1999), 0.0);
    EXPECT_EQ(response.at(0.2), 0.0);
    EXPECT_NEAR(response.at(0.25), 0.25, 1e-12);
    EXPECT_NEAR(response.at(0.3), 0.5, 1e-12);
    EXPECT_EQ(response.at(0.4), 1.0);
    EXPECT_EQ(response.at(0.5), 1.0);
    EXPECT_EQ(response.at(0.6), 1.0);
    EXPECT_NEAR(response.at(0.8), 0.5, 1e-12);
    EXPECT_NEAR(response.at(0.9), 0.25, 1e-12);
    EXPECT_EQ(response.at(1.0), 0.0);
}

TEST(Response, OfTheDefaultIsOneEverywhere) {
    for (const double value : {0.0, 0.3, 1.0}) EXPECT_EQ(ShareResponse{}.at(value), 1.0);
    for (const double celsius : {-20.0, 0.0, 45.0}) EXPECT_EQ(WarmthResponse{}.at(celsius), 1.0);
}

TEST(Response, EndsAbruptlyWhereBothRangesEnd) {
    // Neither side of such a response divides by its width of nothing.
    const ShareResponse at_both{{0.2, 0.7}, {0.2, 0.7}};
    EXPECT_EQ(at_both.at(0.2), 1.0);
    EXPECT_EQ(at_both.at(0.7), 1.0);
    EXPECT_EQ(at_both.at(0.1999), 0.0);
    EXPECT_EQ(at_both.at(0.7001), 0.0);
    const ShareResponse of_a_point{{0.5, 0.5}, {0.5, 0.5}};
    EXPECT_EQ(of_a_point.at(0.5), 1.0);
    EXPECT_EQ(of_a_point.at(0.50001), 0.0);
}

TEST(Response, LiesBetweenNothingAndOneAndRisesToThePreferred) {
    constexpr std::uint32_t cases = 400;
    for (std::uint32_t i = 0; i < cases; ++i) {
        Random random(i, purposes::mutation, 7);
        std::array<double, 4> ends{};
        for (double& end : ends) end = random.uniform();
        std::sort(ends.begin(), ends.end());
        const ShareResponse response{{ends[0], ends[3]}, {ends[1], ends[2]}};
        std::vector<Problem> problems;
        response.check("", problems);
        ASSERT_TRUE(problems.empty());
        double before = 0.0;
        for (int step = 0; step <= 100; ++step) {
            const double value = step / 100.0, now = response.at(value);
            EXPECT_GE(now, 0.0);
            EXPECT_LE(now, 1.0);
            if (value <= ends[2]) {
                EXPECT_GE(now, before);
            } else if (value - 0.01 >= ends[1]) {
                EXPECT_LE(now, before);
            }
            EXPECT_EQ(now > 0.0, value > ends[0] && value < ends[3]) << value;
            before = now;
        }
    }
}

TEST(Response, RefusesAPreferenceThatItDoesNotTolerate) {
    std::vector<Problem> problems;
    ShareResponse{{0.3, 0.6}, {0.2, 0.5}}.check("/light", problems);
    ASSERT_EQ(problems.size(), 1U);
    EXPECT_EQ(problems[0].path, "/light/prefers");
    ShareResponse{{0.3, 0.6}, {0.4, 0.7}}.check("/light", problems);
    EXPECT_EQ(problems.size(), 2U);
}

TEST(Ecology, HasAReachAboveEightMetresInTurfAlone) {
    Ecology ecology;
    ecology.genet.reach = 20.0;
    for (const Guild guild : {Guild::ectomycorrhizal, Guild::litter, Guild::grass, Guild::wood}) {
        ecology.guild = guild;
        std::vector<Problem> problems;
        check(ecology, Info{.name = ""}, "", problems);
        EXPECT_EQ(problems.empty(), guild == Guild::grass) << name(guild);
        if (!problems.empty()) {
            EXPECT_EQ(problems[0].path, "/genet/reach");
        }
    }
}

TEST(Ecology, ReadsBackFromItsJson) {
    Ecology ecology;
    ecology.guild = Guild::wood;
    ecology.trees = {Text<48>("birch"), Text<48>("spruce")};
    ecology.decay = {0.1, 0.6};
    ecology.on_standing_wood = true;
    ecology.temperature = {{-2.0, 16.0}, {2.0, 12.0}};
    ecology.body.perennial = true;
    std::vector<Problem> problems;
    EXPECT_EQ(read_json<Ecology>(dump(write(ecology)), problems), ecology);
    EXPECT_TRUE(problems.empty());
    EXPECT_EQ(read_json<Ecology>("{}", problems), Ecology{});
    EXPECT_TRUE(problems.empty());
    (void)read_json<Ecology>(R"({"guild":"moss","light":{"likes":[0,1]}})", problems);
    std::set<std::string> paths;
    for (const Problem& problem : problems) paths.insert(problem.path);
    EXPECT_EQ(paths, (std::set<std::string>{"/guild", "/light/likes"}));
}

}  // namespace
}  // namespace sporeprint::model_ecology_test
