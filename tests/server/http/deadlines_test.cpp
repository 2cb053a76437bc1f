#include "server/http/deadlines.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <memory>
#include <random>
#include <vector>

namespace sporeprint::server::http_deadlines_test {
namespace {

using namespace std::chrono_literals;

TEST(Deadlines, ExpireNeverEarlyAndAtMostATickLate) {
    const Clock::time_point start = Clock::now();
    Deadlines deadlines(start);
    Timed one;
    deadlines.set(one, start + 100ms);
    EXPECT_GE(deadlines.next(), start + 100ms);
    EXPECT_LE(deadlines.next(), start + 100ms + Deadlines::tick);
    int late = 0;
    deadlines.expire(start + 99ms, [&](Timed&) { ++late; });
    EXPECT_EQ(late, 0);
    deadlines.expire(start + 100ms + Deadlines::tick, [&](Timed& which) {
        EXPECT_EQ(&which, &one);
        ++late;
    });
    EXPECT_EQ(late, 1);
    EXPECT_EQ(deadlines.next(), Clock::time_point::max());
    deadlines.expire(start + 1h, [&](Timed&) { ++late; });
    EXPECT_EQ(late, 1) << "once";
}

TEST(Deadlines, MayBeDestroyedAndSetWhileOthersExpire) {
    const Clock::time_point start = Clock::now();
    Deadlines deadlines(start);
    auto first = std::make_unique<Timed>(), second = std::make_unique<Timed>();
    deadlines.set(*first, start + 10ms);
    deadlines.set(*second, start + 10ms);
    int late = 0;
    deadlines.expire(start + 1s, [&](Timed& which) {
        ++late;
        (&which == first.get() ? second : first).reset();
        deadlines.set(which, start + 2s);
    });
    EXPECT_EQ(late, 1);
    deadlines.expire(start + 3s, [&](Timed&) { ++late; });
    EXPECT_EQ(late, 2);
}

/// Compares the wheel with a sorted map over hours of time in large and small steps.
TEST(Deadlines, AgreeWithASortedList) {
    std::mt19937 random(7);
    const auto below = [&](int limit) { return static_cast<int>(random() % limit); };
    const Clock::time_point start = Clock::now();
    Clock::time_point now = start;
    Deadlines deadlines(start);
    std::vector<Timed> all(50);
    std::map<Timed*, Clock::time_point> model;
    for (int step = 0; step < 20'000; ++step) {
        Timed& one = all[static_cast<std::size_t>(below(50))];
        if (below(2) == 0) {
            const int reach = below(10) == 0 ? 100'000 : 1000;
            model[&one] = now + std::chrono::milliseconds(below(reach) - 5);
            deadlines.set(one, model[&one]);
        }
        now += std::chrono::milliseconds(below(50) == 0 ? below(60'000) : below(20));
        Clock::time_point earliest = Clock::time_point::max();
        for (const auto& [timed, deadline] : model) earliest = std::min(earliest, deadline);
        if (!model.empty()) {
            EXPECT_LE(deadlines.next(), std::max(earliest, now) + 2 * Deadlines::tick);
        }
        deadlines.expire(now, [&](Timed& which) {
            ASSERT_TRUE(model.count(&which));
            EXPECT_LE(model[&which], now);
            model.erase(&which);
        });
        for (const auto& [timed, deadline] : model)
            EXPECT_GT(deadline + Deadlines::tick, now) << "missed in step " << step;
    }
}

}  // namespace
}  // namespace sporeprint::server::http_deadlines_test
