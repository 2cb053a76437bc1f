#include "server/records/circuit_breaker.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <thread>
#include <vector>

namespace sporeprint::server::circuit_breaker_test {
namespace {

using namespace std::chrono_literals;
using Clock = CircuitBreaker::Clock;

TEST(CircuitBreaker, EveryCallerMayTryWhileTheServiceResponds) {
    CircuitBreaker breaker(3s);
    const Clock::time_point now = Clock::now();
    for (int i = 0; i < 10; ++i) EXPECT_TRUE(breaker.may_try(now));
}

TEST(CircuitBreaker, OneCallerInEachIntervalMayTryWhileItIsOpen) {
    CircuitBreaker breaker(3s);
    const Clock::time_point now = Clock::now();
    breaker.open(now);
    EXPECT_FALSE(breaker.may_try(now));
    EXPECT_FALSE(breaker.may_try(now + 2999ms));
    std::atomic<int> allowed{0};
    {
        std::vector<std::jthread> callers;
        for (int i = 0; i < 8; ++i)
            callers.emplace_back([&] { allowed += breaker.may_try(now + 3s) ? 1 : 0; });
    }
    EXPECT_EQ(allowed, 1);
    EXPECT_FALSE(breaker.may_try(now + 5999ms)) << "the attempt begins an interval of its own";
    EXPECT_TRUE(breaker.may_try(now + 6s));
}

TEST(CircuitBreaker, AnAttemptThatFailsBeginsTheIntervalAgainAndOneThatSucceedsEndsIt) {
    CircuitBreaker breaker(3s);
    const Clock::time_point now = Clock::now();
    breaker.open(now);
    ASSERT_TRUE(breaker.may_try(now + 3s));
    breaker.open(now + 5s);
    EXPECT_FALSE(breaker.may_try(now + 7s));
    ASSERT_TRUE(breaker.may_try(now + 8s));
    breaker.close();
    for (int i = 0; i < 10; ++i) EXPECT_TRUE(breaker.may_try(now + 8s));
}

}  // namespace
}  // namespace sporeprint::server::circuit_breaker_test
