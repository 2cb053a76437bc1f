#include "api/cache/cache.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <atomic>
#include <chrono>
#include <memory>
#include <set>
#include <thread>

namespace sporeprint::api::cache_cache_test {
namespace {

using Sized = std::shared_ptr<const std::size_t>;

Sized sized(std::size_t bytes) { return std::make_shared<const std::size_t>(bytes); }
std::size_t size_of_it(const Sized& value) { return *value; }

/// S3-FIFO as plainly as possible: vectors, oldest first, searched from end to end.
class NaiveCache {
  public:
    explicit NaiveCache(std::size_t budget) : budget_(budget) {}

    bool find(const std::string& key) {
        for (auto* queue : {&small_, &main_})
            for (Entry& entry : *queue)
                if (entry.key == key) {
                    if (entry.uses < 3) ++entry.uses;
                    return true;
                }
        return false;
    }

    bool insert(const std::string& key, std::size_t value) {
        const std::size_t bytes = value + key.size() + entry_overhead;
        if (bytes > budget_ / 8) return false;
        for (auto* queue : {&small_, &main_})
            for (const Entry& entry : *queue)
                if (entry.key == key) return true;
        bool ghost = false;
        for (std::string& one : ghosts_)
            if (one == key) {
                one.clear();  // its place runs out by itself
                ghost = true;
            }
        while (total(small_) + total(main_) + bytes > budget_) make_room();
        (ghost || bytes > budget_ / 10 ? main_ : small_).push_back({key, bytes, 0});
        return true;
    }

    std::set<std::string> keys() const {
        std::set<std::string> out;
        for (const auto* queue : {&small_, &main_})
            for (const Entry& entry : *queue) out.insert(entry.key);
        return out;
    }

    std::size_t bytes() const { return total(small_) + total(main_); }

  private:
    struct Entry {
        std::string key;
        std::size_t bytes;
        int uses;
    };
    using Queue = std::vector<Entry>;

    static std::size_t total(const Queue& queue) {
        std::size_t sum = 0;
        for (const Entry& entry : queue) sum += entry.bytes;
        return sum;
    }

    static Entry pop(Queue& queue) {
        Entry oldest = queue.front();
        queue.erase(queue.begin());
        return oldest;
    }

    void make_room() {
        if (small_.empty() || total(main_) > budget_ - budget_ / 10) {
            Entry oldest = pop(main_);
            if (oldest.uses-- > 0) main_.push_back(oldest);
            return;
        }
        Entry oldest = pop(small_);
        if (oldest.uses > 1) {
            oldest.uses = 0;
            main_.push_back(oldest);
            return;
        }
        for (std::string& one : ghosts_)
            if (one == oldest.key) one.clear();
        ghosts_.push_back(oldest.key);
        while (ghosts_.size() > std::max<std::size_t>(64, main_.size()))
            ghosts_.erase(ghosts_.begin());
    }

    std::size_t budget_;
    Queue small_, main_;
    std::vector<std::string> ghosts_;
};

RC_GTEST_PROP(CacheProperty, BehavesAsTheNaiveModelAndStaysWithinItsBudget, ()) {
    constexpr std::size_t budget = 40'000;
    Cache<Sized> cache(budget, size_of_it);
    NaiveCache model(budget);
    const auto steps = *rc::gen::container<std::vector<std::pair<int, int>>>(
        400, rc::gen::pair(rc::gen::inRange(0, 120), rc::gen::inRange(0, 6000)));
    for (const auto& [number, size] : steps) {
        const std::string key = "key " + std::to_string(number * number / 120);
        // The size belongs to the key, as with real responses.
        const std::size_t bytes = hash_of(key) % 5 == 0 ? 4500 : hash_of(key) % 900;
        if (size % 3 == 0) {
            RC_ASSERT(cache.find(key).has_value() == model.find(key));
        } else {
            RC_ASSERT(cache.insert(key, sized(bytes)) == model.insert(key, bytes));
        }
        const CacheStats stats = cache.stats();
        RC_ASSERT(stats.bytes <= budget);
        RC_ASSERT(stats.bytes == model.bytes());
        RC_ASSERT(stats.entries == model.keys().size());
        for (const std::string& cached : model.keys()) RC_ASSERT(cache.holds(cached));
    }
}

TEST(Cache, RefusesWhatIsLargerThanAnEighthOfTheBudget) {
    Cache<Sized> cache(1'000'000, size_of_it);
    EXPECT_TRUE(cache.insert("a", sized(125'000 - 1 - entry_overhead)));
    EXPECT_FALSE(cache.insert("b", sized(125'000 - entry_overhead)));
    EXPECT_EQ(cache.stats().refused, 1u);
    EXPECT_FALSE(cache.find("b"));
}

TEST(Cache, ManyKeysThatComeOnceDoNotPushOutOneThatComesOften) {
    Cache<Sized> cache(1'000'000, size_of_it);
    ASSERT_TRUE(cache.insert("often", sized(5'000)));
    for (int i = 0; i < 3; ++i) EXPECT_TRUE(cache.find("often"));
    for (int i = 0; i < 10'000; ++i) {
        cache.insert("once " + std::to_string(i), sized(5'000));
        if (i % 100 == 0) {
            EXPECT_TRUE(cache.find("often")) << i;
        }
    }
}

TEST(Cache, ALargeValueEntersTheMainQueueAndOutlivesKeysThatComeOnce) {
    Cache<Sized> cache(1'000'000, size_of_it);
    ASSERT_TRUE(cache.insert("large", sized(110'000)));  // more than the small queue's tenth
    for (int i = 0; i < 500; ++i) cache.insert("once " + std::to_string(i), sized(5'000));
    EXPECT_TRUE(cache.holds("large"));
}

TEST(Cache, AnObjectOfAnEighthFitsWhateverTheNumberOfShards) {
    for (const std::size_t megabytes : {1, 64, 256, 1024, 4096}) {
        const std::size_t budget = megabytes << 20;
        Cache<Sized> cache(budget, size_of_it);
        EXPECT_TRUE(cache.insert("large", sized(budget / 8 - 5 - entry_overhead))) << megabytes;
        EXPECT_TRUE(cache.insert("again", sized(budget / 8 - 5 - entry_overhead))) << megabytes;
        EXPECT_LE(cache.stats().bytes, budget);
    }
}

TEST(Cache, AValueStaysAliveForThoseWhoHoldIt) {
    Cache<Sized> cache(10'000, size_of_it);
    ASSERT_TRUE(cache.insert("a", sized(900)));
    const std::optional<Sized> held = cache.find("a");
    for (int i = 0; i < 100; ++i) cache.insert("other " + std::to_string(i), sized(900));
    EXPECT_FALSE(cache.holds("a"));
    EXPECT_EQ(**held, 900u);
}

TEST(Cache, SixtyFourThreadsKeepWithinTheBudget) {
    constexpr std::size_t budget = 130u << 20;  // two shards
    Cache<Sized> cache(budget, size_of_it);
    std::atomic<bool> over{false}, wrong{false};
    std::vector<std::jthread> threads;
    for (int t = 0; t < 64; ++t)
        threads.emplace_back([&, t] {
            for (int i = 0; i < 500; ++i) {
                const std::size_t number = static_cast<std::size_t>((t * 7 + i * 13) % 300);
                const std::string key = "key " + std::to_string(number);
                if (const auto found = cache.find(key)) {
                    if (**found != number * 4096) wrong = true;
                } else {
                    cache.insert(key, sized(number * 4096));
                }
                if (cache.stats().bytes > budget) over = true;
            }
        });
    threads.clear();
    EXPECT_FALSE(over);
    EXPECT_FALSE(wrong);
}

TEST(ComputingCache, SixtyFourThreadsMakeOnce) {
    ComputingCache<Sized> cache(1'000'000, size_of_it);
    std::atomic<int> generated{0}, hits{0};
    std::vector<std::jthread> threads;
    for (int t = 0; t < 64; ++t)
        threads.emplace_back([&] {
            bool hit = false;
            const Sized value = cache.get_or_compute(
                "key",
                [&] {
                    ++generated;
                    std::this_thread::sleep_for(std::chrono::milliseconds(30));
                    return sized(7);
                },
                {}, hit);
            EXPECT_EQ(*value, 7u);
            hits += hit;
        });
    threads.clear();
    EXPECT_EQ(generated, 1);
    EXPECT_EQ(hits, 63);
}

TEST(ComputingCache, AFailureIsNotCachedAndWaitersRetry) {
    ComputingCache<Sized> cache(1'000'000, size_of_it);
    std::atomic<int> tries{0}, failures{0}, successes{0};
    std::vector<std::jthread> threads;
    for (int t = 0; t < 16; ++t)
        threads.emplace_back([&] {
            bool hit = false;
            try {
                const Sized value = cache.get_or_compute(
                    "key",
                    [&]() -> Sized {
                        std::this_thread::sleep_for(std::chrono::milliseconds(10));
                        if (++tries <= 3) throw GenerationError("not today");
                        return sized(7);
                    },
                    {}, hit);
                successes += *value == 7;
            } catch (const GenerationError&) {
                ++failures;
            }
        });
    threads.clear();
    EXPECT_EQ(tries, 4);
    EXPECT_EQ(failures, 3);
    EXPECT_EQ(successes, 13);
}

TEST(ComputingCache, AValueTooLargeToKeepIsStillGivenToThoseWhoWait) {
    ComputingCache<Sized> cache(1'000, size_of_it);
    bool hit = true;
    EXPECT_EQ(*cache.get_or_compute(
                  "key", [] { return sized(5'000); }, {}, hit),
              5'000u);
    EXPECT_FALSE(hit);
    EXPECT_EQ(cache.cache().stats().entries, 0u);
}

TEST(ComputingCache, AskingAgainInsideMakeOnTheSameThreadDoesNotWaitForItself) {
    ComputingCache<Sized> cache(1'000'000, size_of_it);
    bool outer = true, inner = true;
    const Sized value = cache.get_or_compute(
        "key",
        [&] {
            return cache.get_or_compute(
                "key", [] { return sized(9); }, {}, inner);
        },
        {}, outer);
    EXPECT_EQ(*value, 9u);
    EXPECT_FALSE(inner);
}

TEST(ComputingCache, AWaiterWhoIsStoppedLeaves) {
    ComputingCache<Sized> cache(1'000'000, size_of_it);
    std::atomic<bool> leading{false}, release{false};
    std::jthread leader([&] {
        bool hit = false;
        static_cast<void>(cache.get_or_compute(
            "key",
            [&] {
                leading = true;
                while (!release) std::this_thread::yield();
                return sized(1);
            },
            {}, hit));
    });
    while (!leading) std::this_thread::yield();
    std::stop_source stop;
    std::jthread stopper([&] {
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
        stop.request_stop();
    });
    bool hit = false;
    EXPECT_THROW(cache.get_or_compute(
                     "key", [] { return sized(2); }, stop.get_token(), hit),
                 Cancelled);
    release = true;
}

}  // namespace
}  // namespace sporeprint::api::cache_cache_test
