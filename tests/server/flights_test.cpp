#include "server/flights.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <latch>
#include <random>
#include <semaphore>
#include <stdexcept>
#include <thread>

namespace sporeprint::server {
namespace {

using namespace std::chrono_literals;
using Numbers = Flights<int>;

/// Waits for one landing.
class Arrival {
  public:
    Numbers::Then then() {
        return [state = state_](const Numbers::Landing& landing) {
            const std::lock_guard lock(state->mutex);
            state->landings.push_back(landing);
            state->changed.notify_all();
        };
    }
    Numbers::Landing wait() {
        std::unique_lock lock(state_->mutex);
        EXPECT_TRUE(state_->changed.wait_for(lock, 20s, [&] { return !state_->landings.empty(); }));
        return state_->landings.empty() ? Numbers::Landing{} : state_->landings.front();
    }
    std::size_t count() {
        const std::lock_guard lock(state_->mutex);
        return state_->landings.size();
    }

  private:
    struct State {
        std::mutex mutex;
        std::condition_variable changed;
        std::vector<Numbers::Landing> landings;
    };
    std::shared_ptr<State> state_ = std::make_shared<State>();
};

template <class Condition>
bool soon(Condition condition) {
    for (int i = 0; i < 4000; ++i) {
        if (condition()) return true;
        std::this_thread::sleep_for(5ms);
    }
    return false;
}

TEST(Slots, RunEachTaskOnce) {
    std::atomic<int> ran{0};
    {
        Slots slots(4, 1000);
        for (int i = 0; i < 1000; ++i) EXPECT_TRUE(slots.submit([&] { ++ran; }));
        EXPECT_TRUE(soon([&] { return ran == 1000; }));
    }
    EXPECT_EQ(ran, 1000);
}

TEST(Slots, RefuseWhatTheQueueCannotHold) {
    Slots slots(2, 3);
    std::counting_semaphore<> gate(0);
    std::vector<Slots::Ticket> tickets;
    for (int i = 0; i < 5; ++i) {
        const auto ticket = slots.submit([&] { gate.acquire(); });
        ASSERT_TRUE(ticket);
        tickets.push_back(*ticket);
    }
    ASSERT_TRUE(soon([&] { return slots.waiting() == 3; }));
    EXPECT_EQ(slots.busy(), 2u);
    EXPECT_FALSE(slots.submit([] {}));
    EXPECT_TRUE(slots.withdraw(tickets[4]));
    EXPECT_FALSE(slots.withdraw(tickets[4])) << "twice";
    EXPECT_FALSE(slots.withdraw(tickets[0])) << "it runs";
    EXPECT_TRUE(slots.submit([] {}));
    gate.release(5);
}

TEST(Slots, ShareWorkWithIdleThreads) {
    Slots slots(4, 8);
    std::latch together(3);  // only passed when three threads are inside at once
    std::atomic<int> done{0};
    Numbers flights(slots, 8);
    Arrival arrival;
    ASSERT_TRUE(flights.board(
        "key",
        [&](std::stop_token) {
            const std::vector<std::function<void()>> pieces(3, [&] {
                together.arrive_and_wait();
                ++done;
            });
            slots.share(pieces);
            return done.load();
        },
        arrival.then()));
    EXPECT_EQ(*arrival.wait().result, 3);
}

TEST(Slots, ShareNeverWaitsForABusyThread) {
    Slots slots(1, 8);
    std::atomic<int> done{0};
    std::latch over(2);
    for (int task = 0; task < 2; ++task)
        ASSERT_TRUE(slots.submit([&] {
            const std::vector<std::function<void()>> inner(4, [&] { ++done; });
            const std::vector<std::function<void()>> outer(4, [&] { slots.share(inner); });
            slots.share(outer);
            over.count_down();
        }));
    over.wait();
    EXPECT_EQ(done, 32);
}

TEST(Slots, ShareThrowsWhatAPieceThrewWhenAllHaveEnded) {
    Slots slots(4, 8);
    std::atomic<int> ran{0};
    std::vector<std::function<void()>> pieces(8, [&] { ++ran; });
    pieces[3] = [&] {
        ++ran;
        throw std::runtime_error("piece 3");
    };
    EXPECT_THROW(slots.share(pieces), std::runtime_error);
    EXPECT_EQ(ran, 8);
    slots.share({});
}

TEST(Flights, SixtyFourThreadsWithOneKeyMakeItOnce) {
    Slots slots(4, 64);
    Numbers flights(slots, 64);
    std::atomic<int> made{0};
    std::atomic<int> leaders{0};
    std::counting_semaphore<> gate(0);
    {
        std::vector<std::jthread> threads;
        for (int i = 0; i < 64; ++i)
            threads.emplace_back([&] {
                Arrival arrival;
                ASSERT_TRUE(flights.board(
                    "key",
                    [&](std::stop_token) {
                        gate.acquire();
                        return ++made;
                    },
                    arrival.then()));
                const Numbers::Landing landing = arrival.wait();
                ASSERT_TRUE(landing.result);
                EXPECT_EQ(*landing.result, 1);
                if (!landing.collapsed) ++leaders;
            });
        EXPECT_TRUE(soon([&] { return flights.waiters() == 64; }));
        gate.release();
    }
    EXPECT_EQ(made, 1);
    EXPECT_EQ(leaders, 1);
    EXPECT_EQ(flights.in_the_air(), 0u);
    EXPECT_EQ(flights.waiters(), 0u);
}

// Each thread looks for a kept value and boards when there is none: whatever the order, one key is
// made once. Without Glance a thread that looked just before a landing would make it again.
TEST(Flights, BetweenLookAndBoardNothingIsMadeTwice) {
    Slots slots(4, 1024);
    Numbers flights(slots, 1024);
    constexpr int keys = 200;
    std::mutex mutex;
    std::map<std::string, int> kept;
    std::array<std::atomic<int>, keys> made{};
    std::vector<std::jthread> threads;
    for (unsigned thread = 0; thread < 16; ++thread)
        threads.emplace_back([&, thread] {
            std::minstd_rand random(thread);
            for (int i = 0; i < 400; ++i) {
                const auto which = static_cast<std::size_t>(random() % keys);
                const std::string key = std::to_string(which);
                Arrival arrival;
                {
                    const Numbers::Glance glance(flights);
                    {
                        const std::lock_guard lock(mutex);
                        if (kept.contains(key)) continue;
                    }
                    if (random() % 4 == 0) std::this_thread::yield();
                    ASSERT_TRUE(flights.board(
                        key,
                        [&, key, which](std::stop_token) {
                            ++made[which];
                            const std::lock_guard lock(mutex);
                            kept[key] = static_cast<int>(which);
                            return static_cast<int>(which);
                        },
                        arrival.then()));
                }
                EXPECT_EQ(*arrival.wait().result, static_cast<int>(which));
            }
        });
    threads.clear();
    for (const auto& count : made) EXPECT_LE(count, 1);
    EXPECT_EQ(flights.in_the_air(), 0u);
}

TEST(Flights, AFailureReachesThoseWhoWaitAndIsNotKept) {
    Slots slots(2, 8);
    Numbers flights(slots, 8);
    std::counting_semaphore<> gate(0);
    std::atomic<int> tries{0};
    const Numbers::Work work = [&](std::stop_token) -> int {
        gate.acquire();
        if (++tries == 1) throw std::runtime_error("bad luck");
        return 7;
    };
    Arrival first, second;
    const Numbers::Glance glance(flights);
    ASSERT_TRUE(flights.board("key", work, first.then()));
    ASSERT_TRUE(flights.board("key", work, second.then()));
    gate.release();
    for (Arrival* arrival : {&first, &second}) {
        const Numbers::Landing landing = arrival->wait();
        EXPECT_FALSE(landing.result);
        ASSERT_TRUE(landing.error);
        EXPECT_THROW(std::rethrow_exception(landing.error), std::runtime_error);
    }
    Arrival third;
    ASSERT_TRUE(flights.board("key", work, third.then()));
    gate.release();
    EXPECT_EQ(*third.wait().result, 7);
}

TEST(Flights, WorkIsStoppedWhenTheLastWaiterLeaves) {
    Slots slots(1, 8);
    Numbers flights(slots, 8);
    std::atomic<bool> stopped{false};
    std::binary_semaphore running(0);
    const Numbers::Work work = [&](std::stop_token stop) {
        running.release();
        while (!stop.stop_requested()) std::this_thread::sleep_for(1ms);
        stopped = true;
        return 0;
    };
    Arrival first, second;
    const auto one = flights.board("key", work, first.then());
    const auto two = flights.board("key", work, second.then());
    ASSERT_TRUE(one && two);
    running.acquire();
    EXPECT_TRUE(flights.leave(*one));
    EXPECT_FALSE(flights.leave(*one)) << "twice";
    std::this_thread::sleep_for(20ms);
    EXPECT_FALSE(stopped);
    EXPECT_TRUE(flights.leave(*two));
    EXPECT_TRUE(soon([&] { return stopped.load(); }));
    EXPECT_EQ(first.count() + second.count(), 0u);

    // Nobody joins what was stopped: the next one starts anew.
    Arrival third;
    ASSERT_TRUE(flights.board(
        "key", [](std::stop_token) { return 5; }, third.then()));
    EXPECT_EQ(*third.wait().result, 5);
}

TEST(Flights, WorkThatNobodyWaitsForLeavesTheQueue) {
    Slots slots(1, 1);
    Numbers flights(slots, 8);
    std::binary_semaphore gate(0), running(0);
    Arrival first, second, third;
    std::atomic<bool> second_ran{false};
    ASSERT_TRUE(flights.board(
        "first",
        [&](std::stop_token) {
            running.release();
            gate.acquire();
            return 1;
        },
        first.then()));
    running.acquire();
    const auto seat = flights.board(
        "second",
        [&](std::stop_token) {
            second_ran = true;
            return 2;
        },
        second.then());
    ASSERT_TRUE(seat);
    EXPECT_FALSE(flights.board(
        "third", [](std::stop_token) { return 3; }, third.then()))
        << "full";
    EXPECT_TRUE(flights.leave(*seat));
    ASSERT_TRUE(flights.board(
        "third", [](std::stop_token) { return 3; }, third.then()));
    gate.release();
    EXPECT_EQ(*third.wait().result, 3);
    EXPECT_FALSE(second_ran);
}

TEST(Flights, ARefusedFlightLeavesNothingBehind) {
    Slots slots(1, 0);
    Numbers flights(slots, 2);
    std::binary_semaphore gate(0);
    Arrival first, second, third, fourth;
    const Numbers::Work work = [&](std::stop_token) {
        gate.acquire();
        return 1;
    };
    ASSERT_TRUE(flights.board("a", work, first.then()));
    ASSERT_TRUE(soon([&] { return slots.busy() == 1 && slots.waiting() == 0; }));
    EXPECT_FALSE(flights.board("b", work, second.then())) << "no slot, no queue";
    ASSERT_TRUE(flights.board("a", work, third.then())) << "joining costs no slot";
    EXPECT_FALSE(flights.board("a", work, fourth.then())) << "the waiting room is full";
    EXPECT_EQ(flights.in_the_air(), 1u);
    gate.release();
    EXPECT_EQ(*first.wait().result, 1);
    EXPECT_EQ(*third.wait().result, 1);
    EXPECT_EQ(second.count() + fourth.count(), 0u);
}

TEST(Flights, SurviveManyWhoComeAndGo) {
    Slots slots(4, 16);
    Numbers flights(slots, 64);
    std::atomic<int> landed{0}, refused{0}, left{0};
    std::vector<std::jthread> threads;
    for (unsigned thread = 0; thread < 16; ++thread)
        threads.emplace_back([&, thread] {
            std::minstd_rand random(thread + 1);
            for (int i = 0; i < 300; ++i) {
                const int which = static_cast<int>(random() % 12);
                Arrival arrival;
                std::optional<Numbers::Seat> seat;
                {
                    const Numbers::Glance glance(flights);
                    seat = flights.board(
                        std::to_string(which),
                        [which](std::stop_token stop) {
                            for (int k = 0; k < 50 && !stop.stop_requested(); ++k)
                                std::this_thread::yield();
                            if (which == 3) throw std::runtime_error("three");
                            return which;
                        },
                        arrival.then());
                }
                if (!seat) {
                    ++refused;
                    continue;
                }
                if (random() % 3 == 0 && flights.leave(*seat)) {
                    ++left;
                    continue;
                }
                const Numbers::Landing landing = arrival.wait();
                EXPECT_EQ(landing.error != nullptr, which == 3);
                if (landing.result) {
                    EXPECT_EQ(*landing.result, which);
                }
                EXPECT_EQ(arrival.count(), 1u);
                ++landed;
            }
        });
    threads.clear();
    EXPECT_EQ(landed + refused + left, 16 * 300);
    EXPECT_TRUE(soon([&] { return flights.in_the_air() == 0; }));
    EXPECT_EQ(flights.waiters(), 0u);
}

}  // namespace
}  // namespace sporeprint::server
