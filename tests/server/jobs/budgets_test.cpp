#include "server/jobs/budgets.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <thread>
#include <vector>

namespace sporeprint::server::jobs_budgets_test {
namespace {

using namespace std::chrono_literals;
using std::chrono::microseconds, std::chrono::nanoseconds;

Address client(std::uint32_t number) {
    Address address;
    for (std::size_t i = 0; i < 4; ++i)
        address.bytes[4 + i] = static_cast<std::uint8_t>(number >> (8 * i));
    return address;
}

Budgets::Time at(nanoseconds time) { return Budgets::Time(1h + time); }

TEST(Budgets, FillAtTheirRateAndReportTheTimeToWait) {
    Budgets budgets({.rate = 10, .burst = 100});
    EXPECT_EQ(budgets.spend(client(1), 60, at(0s)), 0us);
    EXPECT_EQ(budgets.spend(client(1), 50, at(0s)), 1s) << "ten are missing";
    EXPECT_EQ(budgets.spend(client(1), 40, at(0s)), 0us);
    EXPECT_EQ(budgets.spend(client(2), 100, at(0s)), 0us) << "buckets are independent";
    EXPECT_EQ(budgets.spend(client(1), 1, at(0s)), 100ms);
    EXPECT_EQ(budgets.spend(client(1), 1, at(99'999'999ns)), 1us);
    EXPECT_EQ(budgets.spend(client(1), 1, at(100ms)), 0us);
    EXPECT_EQ(budgets.spend(client(1), 100, at(1000h)), 0us)
        << "a bucket never exceeds its capacity";
    EXPECT_EQ(budgets.spend(client(1), 1, at(1000h)), 100ms);
    EXPECT_EQ(budgets.spend(client(3), 0, at(1000h)), 0us);
    EXPECT_EQ(budgets.clients(), 2u) << "a request for no work adds no client";
}

TEST(Budgets, AdmitALargeJobWhenFullAndGoNegative) {
    Budgets budgets({.rate = 10, .burst = 100});
    EXPECT_EQ(budgets.spend(client(1), 1, at(0s)), 0us);
    EXPECT_EQ(budgets.spend(client(1), 1000, at(0s)), 100ms) << "only when the bucket is full";
    EXPECT_EQ(budgets.spend(client(1), 1000, at(100ms)), 0us);
    EXPECT_EQ(budgets.spend(client(1), 1, at(100ms)), 90s + 100ms);
    EXPECT_EQ(budgets.spend(client(1), 100, at(100s + 99ms)), 1ms);
    EXPECT_EQ(budgets.spend(client(1), 100, at(100s + 100ms)), 0us);
    EXPECT_EQ(budgets.spend(client(2), UINT64_MAX, at(100s + 100ms)), 0us);
    EXPECT_GT(budgets.spend(client(2), 1, at(1000h)), 1000h);
}

TEST(Budgets, ReportTheirLevelAndTheTimeUntilFull) {
    Budgets budgets({.rate = 10, .burst = 100});
    EXPECT_EQ(budgets.level(client(1), at(0s)).work, 100u);
    EXPECT_EQ(budgets.level(client(1), at(0s)).until_full, 0us);
    EXPECT_EQ(budgets.spend(client(1), 60, at(0s)), 0us);
    EXPECT_EQ(budgets.level(client(1), at(0s)).work, 40u);
    EXPECT_EQ(budgets.level(client(1), at(0s)).until_full, 6s);
    EXPECT_EQ(budgets.level(client(1), at(2s)).work, 60u);
    EXPECT_EQ(budgets.level(client(1), at(2s)).until_full, 4s);
    EXPECT_EQ(budgets.level(client(1), at(60s)).work, 100u);
    EXPECT_EQ(budgets.level(client(2), at(60s)).work, 100u) << "buckets are independent";
    EXPECT_EQ(budgets.spend(client(1), 1000, at(60s)), 0us);
    EXPECT_EQ(budgets.level(client(1), at(60s)).work, 0u) << "its level is negative";
    EXPECT_EQ(budgets.level(client(1), at(60s)).until_full, 100s);
}

TEST(Budgets, ReturnTheCostOfWorkNotBegunUpToFull) {
    Budgets budgets({.rate = 10, .burst = 100});
    EXPECT_EQ(budgets.spend(client(1), 70, at(0s)), 0us);
    budgets.give_back(client(1), 70, at(0s));
    EXPECT_EQ(budgets.spend(client(1), 100, at(0s)), 0us);
    budgets.give_back(client(1), 70, at(5s));
    EXPECT_EQ(budgets.spend(client(1), 101, at(5s)), 0us) << "fifty have flowed in meanwhile: full";
    EXPECT_EQ(budgets.spend(client(1), 1, at(5s)), 200ms) << "the level is -1";
    budgets.give_back(client(9), 5, at(5s));
    EXPECT_EQ(budgets.clients(), 1u);
}

TEST(Budgets, ChargeWorkAlreadyDoneBelowZero) {
    Budgets budgets({.rate = 10, .burst = 100});
    budgets.owe(client(1), 130, at(0s));
    EXPECT_EQ(budgets.spend(client(1), 0, at(0s)), 3s)
        << "not even zero work while the level is negative";
    EXPECT_EQ(budgets.spend(client(1), 20, at(0s)), 5s);
    EXPECT_EQ(budgets.spend(client(1), 20, at(5s)), 0us);
    budgets.owe(client(2), 0, at(5s));
    EXPECT_EQ(budgets.clients(), 1u);
    for (int i = 0; i < 3; ++i) budgets.owe(client(3), UINT64_MAX, at(5s));
    EXPECT_GT(budgets.spend(client(3), 0, at(1000h)), 0us) << "without an overflow";
}

TEST(Budgets, EvictTheClientWhoseBucketIsFullFirst) {
    Budgets budgets({.rate = 1, .burst = 100, .most_clients = 10});
    EXPECT_EQ(budgets.spend(client(1000), 100, at(0s)), 0us);
    for (std::uint32_t i = 0; i < 5000; ++i) {
        EXPECT_EQ(budgets.spend(client(i % 1000), 1, at(1ms * i)), 0us);
        EXPECT_LE(budgets.clients(), 10u);
    }
    EXPECT_GT(budgets.spend(client(1000), 100, at(5s)), 94s)
        << "many small clients do not evict the one with a negative level";
}

/// Compares with a reference bucket that is updated at every step.
RC_GTEST_PROP(Budgets, NeverExceedTheirRateAndRefuseOnlyWhenTooLow, ()) {
    const auto rate = *rc::gen::inRange<std::uint64_t>(1, 2'000'000);
    const auto burst = *rc::gen::inRange<std::uint64_t>(1, 3'000'000);
    Budgets budgets({.rate = rate, .burst = burst});
    // In millionths of work, exactly; 64 bits suffice for these ranges.
    const auto full = static_cast<std::int64_t>(burst) * 1'000'000;
    std::int64_t level = full, now = 0;
    std::uint64_t spent = 0, largest = 0;
    for (int i = 0; i < 200; ++i) {
        const auto passed = *rc::gen::inRange<std::int64_t>(0, i % 10 == 0 ? 30'000'000 : 30'000);
        now += passed;
        level = std::min(full, level + passed * static_cast<std::int64_t>(rate));
        const auto work = *rc::gen::inRange<std::uint64_t>(1, i % 7 == 0 ? 2 * burst + 1 : burst);
        const std::int64_t enough = std::min(static_cast<std::int64_t>(work) * 1'000'000, full);
        const microseconds wait = budgets.spend(client(1), work, at(microseconds(now)));
        if (wait == 0us) {
            RC_ASSERT(level >= enough);
            level -= static_cast<std::int64_t>(work) * 1'000'000;
            spent += work;
            largest = std::max(largest, work);
        } else {
            RC_ASSERT(level < enough);
            const std::int64_t r = static_cast<std::int64_t>(rate);
            RC_ASSERT(level + wait.count() * r >= enough);
            RC_ASSERT(level + (wait.count() - 1) * r < enough);
        }
        const double most = static_cast<double>(rate) * static_cast<double>(now) / 1e6 +
                            static_cast<double>(std::max(burst, largest));
        RC_ASSERT(static_cast<double>(spent) <= most + 1e-3);
    }
}

TEST(Budgets, LoseNothingToRounding) {
    Budgets budgets({.rate = 3, .burst = 1});
    // One unit takes a third of a second; it is requested every third of a millisecond.
    int granted = 0;
    for (int i = 0; i <= 300'000; ++i)
        if (budgets.spend(client(1), 1, at(nanoseconds(333'333) * i)) == 0us) ++granted;
    EXPECT_NEAR(granted, 1 + 3 * 100, 1);
}

TEST(Budgets, AreSharedByAllThreads) {
    Budgets budgets({.rate = 1, .burst = 1000, .most_clients = 4});
    std::atomic<int> granted{0};
    {
        std::vector<std::jthread> threads;
        for (int t = 0; t < 8; ++t)
            threads.emplace_back([&] {
                for (int i = 0; i < 500; ++i)
                    if (budgets.spend(client(7), 1, at(0s)) == 0us) ++granted;
            });
    }
    EXPECT_EQ(granted, 1000);
}

}  // namespace
}  // namespace sporeprint::server::jobs_budgets_test
