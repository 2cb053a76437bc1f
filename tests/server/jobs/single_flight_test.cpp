#include "server/jobs/single_flight.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <latch>
#include <random>
#include <semaphore>
#include <stdexcept>
#include <thread>

namespace sporeprint::server::jobs_single_flight_test {
namespace {

using namespace std::chrono_literals;
using Numbers = SingleFlight<int>;

/// Records the completions of one waiter and waits for the first.
class Recorder {
  public:
    Numbers::OnComplete then() {
        return [state = state_](const Numbers::Completion& completion) {
            const std::lock_guard lock(state->mutex);
            state->completions.push_back(completion);
            state->changed.notify_all();
        };
    }
    Numbers::Completion wait() {
        std::unique_lock lock(state_->mutex);
        EXPECT_TRUE(
            state_->changed.wait_for(lock, 20s, [&] { return !state_->completions.empty(); }));
        return state_->completions.empty() ? Numbers::Completion{} : state_->completions.front();
    }
    std::size_t count() {
        const std::lock_guard lock(state_->mutex);
        return state_->completions.size();
    }

  private:
    struct State {
        std::mutex mutex;
        std::condition_variable changed;
        std::vector<Numbers::Completion> completions;
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

TEST(ThreadPool, RunsEachTaskOnce) {
    std::atomic<int> ran{0};
    {
        ThreadPool pool(4, 1000);
        for (int i = 0; i < 1000; ++i) EXPECT_TRUE(pool.submit([&] { ++ran; }));
        EXPECT_TRUE(soon([&] { return ran == 1000; }));
    }
    EXPECT_EQ(ran, 1000);
}

TEST(ThreadPool, RefusesTasksBeyondTheQueue) {
    std::counting_semaphore<> gate(0);  // outlives the pool, whose threads wait for it
    ThreadPool pool(2, 3);
    std::vector<ThreadPool::Ticket> tickets;
    for (int i = 0; i < 5; ++i) {
        const auto ticket = pool.submit([&] { gate.acquire(); });
        ASSERT_TRUE(ticket);
        tickets.push_back(*ticket);
    }
    ASSERT_TRUE(soon([&] { return pool.waiting() == 3; }));
    EXPECT_EQ(pool.busy(), 2u);
    EXPECT_FALSE(pool.submit([] {}));
    EXPECT_TRUE(pool.withdraw(tickets[4]));
    EXPECT_FALSE(pool.withdraw(tickets[4])) << "twice";
    EXPECT_FALSE(pool.withdraw(tickets[0])) << "it runs";
    EXPECT_TRUE(pool.submit([] {}));
    gate.release(5);
}

/// Submits tasks to a pool of one thread that is busy, and returns the names of their order.
std::string order_of(const std::vector<std::pair<char, TaskLength>>& tasks) {
    std::counting_semaphore<> gate(0);
    std::string order;
    std::latch over(static_cast<std::ptrdiff_t>(tasks.size()));
    ThreadPool pool(1, tasks.size() + 1);
    EXPECT_TRUE(pool.submit([&] { gate.acquire(); }));
    EXPECT_TRUE(soon([&] { return pool.busy() == 1 && pool.waiting() == 0; }));
    for (const auto& [name, length] : tasks)
        EXPECT_TRUE(pool.submit(
            [&order, &over, name = name] {
                order += name;
                over.count_down();
            },
            length));
    gate.release();
    over.wait();
    return order;
}

TEST(ThreadPool, RunsBriefTasksBeforeLengthyOnesThatWait) {
    constexpr TaskLength brief = TaskLength::brief, lengthy = TaskLength::lengthy;
    EXPECT_EQ(order_of({{'a', brief}, {'b', brief}, {'c', brief}}), "abc");
    EXPECT_EQ(order_of({{'A', lengthy}, {'B', lengthy}, {'c', brief}, {'d', brief}}), "cdAB");
    EXPECT_EQ(order_of({{'a', brief}, {'B', lengthy}, {'c', brief}, {'D', lengthy}, {'e', brief}}),
              "aceBD");
}

TEST(ThreadPool, RunsALengthyTaskInTheEnd) {
    std::vector<std::pair<char, TaskLength>> tasks = {{'A', TaskLength::lengthy}};
    tasks.insert(tasks.end(), 3 * ThreadPool::most_overtaking, {'b', TaskLength::brief});
    EXPECT_EQ(order_of(tasks).find('A'), std::size_t{ThreadPool::most_overtaking});
}

TEST(ThreadPool, SharesWorkWithIdleThreads) {
    std::latch together(3);  // passed only while three threads wait in it
    std::atomic<int> done{0};
    ThreadPool pool(4, 8);
    Numbers single_flight(pool, 8);
    Recorder recorder;
    ASSERT_TRUE(single_flight.join(
        "key",
        [&](std::stop_token) {
            const std::vector<std::function<void()>> subtasks(3, [&] {
                together.arrive_and_wait();
                ++done;
            });
            pool.share(subtasks);
            return done.load();
        },
        recorder.then()));
    EXPECT_EQ(*recorder.wait().result, 3);
}

TEST(ThreadPool, ShareNeverWaitsForABusyThread) {
    ThreadPool pool(1, 8);
    std::atomic<int> done{0};
    std::latch over(2);
    for (int task = 0; task < 2; ++task)
        ASSERT_TRUE(pool.submit([&] {
            const std::vector<std::function<void()>> inner(4, [&] { ++done; });
            const std::vector<std::function<void()>> outer(4, [&] { pool.share(inner); });
            pool.share(outer);
            over.count_down();
        }));
    over.wait();
    EXPECT_EQ(done, 32);
}

TEST(ThreadPool, ShareThrowsTheFirstExceptionAfterAllSubtasksHaveEnded) {
    ThreadPool pool(4, 8);
    std::atomic<int> ran{0};
    std::vector<std::function<void()>> subtasks(8, [&] { ++ran; });
    subtasks[3] = [&] {
        ++ran;
        throw std::runtime_error("subtask 3");
    };
    EXPECT_THROW(pool.share(subtasks), std::runtime_error);
    EXPECT_EQ(ran, 8);
    pool.share({});
}

TEST(SingleFlight, SixtyFourThreadsWithOneKeyComputeItOnce) {
    ThreadPool pool(4, 64);
    Numbers single_flight(pool, 64);
    std::atomic<int> computed{0};
    std::atomic<int> leaders{0};
    std::counting_semaphore<> gate(0);
    {
        std::vector<std::jthread> threads;
        for (int i = 0; i < 64; ++i)
            threads.emplace_back([&] {
                Recorder recorder;
                ASSERT_TRUE(single_flight.join(
                    "key",
                    [&](std::stop_token) {
                        gate.acquire();
                        return ++computed;
                    },
                    recorder.then()));
                const Numbers::Completion completion = recorder.wait();
                ASSERT_TRUE(completion.result);
                EXPECT_EQ(*completion.result, 1);
                if (!completion.collapsed) ++leaders;
            });
        EXPECT_TRUE(soon([&] { return single_flight.waiters() == 64; }));
        gate.release();
    }
    EXPECT_EQ(computed, 1);
    EXPECT_EQ(leaders, 1);
    EXPECT_EQ(single_flight.in_flight(), 0u);
    EXPECT_EQ(single_flight.waiters(), 0u);
}

// Each thread looks up a cached value and joins a computation if there is none: in any order each
// key is computed once. Without LookupGuard a thread whose lookup came just before a completion
// would compute it again.
TEST(SingleFlight, LookupGuardPreventsASecondComputation) {
    ThreadPool pool(4, 1024);
    Numbers single_flight(pool, 1024);
    constexpr int keys = 200;
    std::mutex mutex;
    std::map<std::string, int> cached;
    std::array<std::atomic<int>, keys> computed{};
    std::vector<std::jthread> threads;
    for (unsigned thread = 0; thread < 16; ++thread)
        threads.emplace_back([&, thread] {
            std::minstd_rand random(thread);
            for (int i = 0; i < 400; ++i) {
                const auto which = static_cast<std::size_t>(random() % keys);
                const std::string key = std::to_string(which);
                Recorder recorder;
                {
                    const Numbers::LookupGuard lookup_guard(single_flight);
                    {
                        const std::lock_guard lock(mutex);
                        if (cached.contains(key)) continue;
                    }
                    if (random() % 4 == 0) std::this_thread::yield();
                    ASSERT_TRUE(single_flight.join(
                        key,
                        [&, key, which](std::stop_token) {
                            ++computed[which];
                            const std::lock_guard lock(mutex);
                            cached[key] = static_cast<int>(which);
                            return static_cast<int>(which);
                        },
                        recorder.then()));
                }
                EXPECT_EQ(*recorder.wait().result, static_cast<int>(which));
            }
        });
    threads.clear();
    for (const auto& count : computed) EXPECT_LE(count, 1);
    EXPECT_EQ(single_flight.in_flight(), 0u);
}

TEST(SingleFlight, AnExceptionReachesAllWaitersAndIsNotCached) {
    ThreadPool pool(2, 8);
    Numbers single_flight(pool, 8);
    std::counting_semaphore<> gate(0);
    std::atomic<int> tries{0};
    const Numbers::Work work = [&](std::stop_token) -> int {
        gate.acquire();
        if (++tries == 1) throw std::runtime_error("failure");
        return 7;
    };
    Recorder first, second;
    const Numbers::LookupGuard lookup_guard(single_flight);
    ASSERT_TRUE(single_flight.join("key", work, first.then()));
    ASSERT_TRUE(single_flight.join("key", work, second.then()));
    gate.release();
    for (Recorder* recorder : {&first, &second}) {
        const Numbers::Completion completion = recorder->wait();
        EXPECT_FALSE(completion.result);
        ASSERT_TRUE(completion.error);
        EXPECT_THROW(std::rethrow_exception(completion.error), std::runtime_error);
    }
    Recorder third;
    ASSERT_TRUE(single_flight.join("key", work, third.then()));
    gate.release();
    EXPECT_EQ(*third.wait().result, 7);
}

TEST(SingleFlight, WorkIsStoppedWhenTheLastWaiterCancels) {
    ThreadPool pool(1, 8);
    Numbers single_flight(pool, 8);
    std::atomic<bool> stopped{false};
    std::binary_semaphore running(0);
    const Numbers::Work work = [&](std::stop_token stop) {
        running.release();
        while (!stop.stop_requested()) std::this_thread::sleep_for(1ms);
        stopped = true;
        return 0;
    };
    Recorder first, second;
    const auto one = single_flight.join("key", work, first.then());
    const auto two = single_flight.join("key", work, second.then());
    ASSERT_TRUE(one && two);
    running.acquire();
    EXPECT_TRUE(single_flight.cancel(*one));
    EXPECT_FALSE(single_flight.cancel(*one)) << "twice";
    std::this_thread::sleep_for(20ms);
    EXPECT_FALSE(stopped);
    EXPECT_TRUE(single_flight.cancel(*two));
    EXPECT_TRUE(soon([&] { return stopped.load(); }));
    EXPECT_EQ(first.count() + second.count(), 0u);

    // A stopped computation cannot be joined: the next join starts another.
    Recorder third;
    ASSERT_TRUE(single_flight.join(
        "key", [](std::stop_token) { return 5; }, third.then()));
    EXPECT_EQ(*third.wait().result, 5);
}

TEST(SingleFlight, WorkWithoutWaitersIsWithdrawnFromTheQueue) {
    ThreadPool pool(1, 1);
    Numbers single_flight(pool, 8);
    std::binary_semaphore gate(0), running(0);
    Recorder first, second, third;
    std::atomic<bool> second_ran{false};
    ASSERT_TRUE(single_flight.join(
        "first",
        [&](std::stop_token) {
            running.release();
            gate.acquire();
            return 1;
        },
        first.then()));
    running.acquire();
    const auto ticket = single_flight.join(
        "second",
        [&](std::stop_token) {
            second_ran = true;
            return 2;
        },
        second.then());
    ASSERT_TRUE(ticket);
    EXPECT_FALSE(single_flight.join(
        "third", [](std::stop_token) { return 3; }, third.then()))
        << "full";
    EXPECT_TRUE(single_flight.cancel(*ticket));
    ASSERT_TRUE(single_flight.join(
        "third", [](std::stop_token) { return 3; }, third.then()));
    gate.release();
    EXPECT_EQ(*third.wait().result, 3);
    EXPECT_FALSE(second_ran);
}

TEST(SingleFlight, ARefusedJoinHasNoEffect) {
    ThreadPool pool(1, 0);
    Numbers single_flight(pool, 2);
    std::binary_semaphore gate(0);
    Recorder first, second, third, fourth;
    const Numbers::Work work = [&](std::stop_token) {
        gate.acquire();
        return 1;
    };
    ASSERT_TRUE(single_flight.join("a", work, first.then()));
    ASSERT_TRUE(soon([&] { return pool.busy() == 1 && pool.waiting() == 0; }));
    EXPECT_FALSE(single_flight.join("b", work, second.then()))
        << "neither a thread nor the queue is free";
    ASSERT_TRUE(single_flight.join("a", work, third.then())) << "joining occupies no thread";
    EXPECT_FALSE(single_flight.join("a", work, fourth.then())) << "the list of waiters is full";
    EXPECT_EQ(single_flight.in_flight(), 1u);
    gate.release();
    EXPECT_EQ(*first.wait().result, 1);
    EXPECT_EQ(*third.wait().result, 1);
    EXPECT_EQ(second.count() + fourth.count(), 0u);
}

TEST(SingleFlight, SurvivesManyJoinsAndCancellations) {
    ThreadPool pool(4, 16);
    Numbers single_flight(pool, 64);
    std::atomic<int> completed{0}, refused{0}, cancelled{0};
    std::vector<std::jthread> threads;
    for (unsigned thread = 0; thread < 16; ++thread)
        threads.emplace_back([&, thread] {
            std::minstd_rand random(thread + 1);
            for (int i = 0; i < 300; ++i) {
                const int which = static_cast<int>(random() % 12);
                Recorder recorder;
                std::optional<Numbers::Ticket> ticket;
                {
                    const Numbers::LookupGuard lookup_guard(single_flight);
                    ticket = single_flight.join(
                        std::to_string(which),
                        [which](std::stop_token stop) {
                            for (int k = 0; k < 50 && !stop.stop_requested(); ++k)
                                std::this_thread::yield();
                            if (which == 3) throw std::runtime_error("three");
                            return which;
                        },
                        recorder.then());
                }
                if (!ticket) {
                    ++refused;
                    continue;
                }
                if (random() % 3 == 0 && single_flight.cancel(*ticket)) {
                    ++cancelled;
                    continue;
                }
                const Numbers::Completion completion = recorder.wait();
                EXPECT_EQ(completion.error != nullptr, which == 3);
                if (completion.result) {
                    EXPECT_EQ(*completion.result, which);
                }
                EXPECT_EQ(recorder.count(), 1u);
                ++completed;
            }
        });
    threads.clear();
    EXPECT_EQ(completed + refused + cancelled, 16 * 300);
    EXPECT_TRUE(soon([&] { return single_flight.in_flight() == 0; }));
    EXPECT_EQ(single_flight.waiters(), 0u);
}

}  // namespace
}  // namespace sporeprint::server::jobs_single_flight_test
