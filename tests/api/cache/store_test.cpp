#include "api/cache/store.h"

#include <gtest/gtest.h>

#include <atomic>
#include <thread>
#include <vector>

#include "core/silhouette/morph_set.h"

namespace sporeprint::api::cache_store_test {
namespace {

Morph a_morph() {
    Silhouette shape;
    shape.stem = {{.r = 0.0, .y = 0.0}, {.r = 0.01, .y = 0.0}, {.r = 0.01, .y = 0.08}};
    shape.hymenium = {{.r = 0.01, .y = 0.08}, {.r = 0.04, .y = 0.08}};
    shape.cap = {{.r = 0.04, .y = 0.08}, {.r = 0.03, .y = 0.1}, {.r = 0.0, .y = 0.11}};
    return std::make_shared<const MorphSet>(
        std::vector<ControlShape>{{.silhouette = shape, .size = 0.1}});
}

Painting a_painting(std::size_t bytes) {
    auto painting = std::make_shared<RawImages>();
    painting->rgb[0].resize(bytes);
    return painting;
}

class StoreTest : public testing::Test {
  protected:
    JobContext job_context() { return {store_, {}, observer_, parallel_}; }

    const Observer observer_ = [](Step) {};
    const Parallel parallel_ = in_turn;
    Store store_{ServiceOptions{}};
};

TEST_F(StoreTest, ALoanTellsWhatTheCachesSaidAndNothingOfThoseItDidNotAsk) {
    const JobContext nothing = job_context();
    EXPECT_EQ(nothing.cache_status(), "");

    const JobContext first = job_context();
    static_cast<void>(first.execution().caches.morphs("set", a_morph));
    EXPECT_EQ(first.cache_status(), "sporeprint-morph; fwd=miss; stored");
    static_cast<void>(first.execution().caches.morphs("set", a_morph));
    EXPECT_EQ(first.cache_status(), "sporeprint-morph; fwd=miss; stored")
        << "it was not there before this job";

    const JobContext second = job_context();
    static_cast<void>(second.execution().caches.images(
        "images", [] { return std::make_shared<const ImageSet>(); }));
    static_cast<void>(second.execution().caches.morphs("set", a_morph));
    EXPECT_EQ(second.cache_status(), "sporeprint-morph; hit, sporeprint-images; fwd=miss; stored");
    EXPECT_EQ(store_.counters.morph_hits, 2u);
    EXPECT_EQ(store_.counters.morph_misses, 1u);
    EXPECT_EQ(store_.counters.image_misses, 1u);
    EXPECT_EQ(store_.counters.painted, 1u);
    store_.measure();
    EXPECT_EQ(store_.counters.morph_cache_entries, 1u);
    EXPECT_GE(store_.counters.morph_cache_bytes, a_morph()->bytes());
}

TEST_F(StoreTest, JobsThatWantOneNewThingAtOnceMakeItOnce) {
    std::atomic<int> generated{0}, painted{0}, waiting{0};
    std::vector<std::jthread> threads;
    for (int i = 0; i < 8; ++i)
        threads.emplace_back([&] {
            const JobContext mine = job_context();
            ++waiting;
            const auto all_are_here = [&] {
                while (waiting < 8) std::this_thread::yield();
            };
            static_cast<void>(mine.execution().caches.morphs("set", [&] {
                all_are_here();
                ++generated;
                return a_morph();
            }));
            static_cast<void>(mine.execution().caches.paintings("painting", [&] {
                ++painted;
                return a_painting(1000);
            }));
        });
    threads.clear();
    EXPECT_EQ(generated, 1);
    EXPECT_EQ(painted, 1);
    EXPECT_EQ(store_.counters.morph_misses, 1u);
    EXPECT_EQ(store_.counters.morph_hits, 7u);
    EXPECT_EQ(store_.counters.painting_misses, 1u);
    EXPECT_EQ(store_.counters.painting_hits, 7u);
}

TEST_F(StoreTest, PaintingsAreCachedInTheBudgetOfTheImages) {
    ServiceOptions options;
    options.image_cache_bytes = 1u << 20;
    Store small(options);
    const JobContext mine(small, {}, observer_, parallel_);
    for (int i = 0; i < 40; ++i)
        static_cast<void>(mine.execution().caches.paintings(std::to_string(i),
                                                            [] { return a_painting(100'000); }));
    small.measure();
    EXPECT_LE(small.counters.image_cache_bytes, options.image_cache_bytes);
    EXPECT_GE(small.counters.image_cache_entries, 5u);
    EXPECT_GE(small.counters.image_evictions, 30u);
    EXPECT_EQ(mine.cache_status(), "") << "a painting is no image set";
    static_cast<void>(
        mine.execution().caches.paintings("huge", [] { return a_painting(900'000); }));
    EXPECT_FALSE(small.images.cache().holds("huge"));
}

TEST_F(StoreTest, FailuresAreNotCached) {
    const JobContext mine = job_context();
    EXPECT_THROW(static_cast<void>(mine.execution().caches.morphs(
                     "set", []() -> Morph { throw GenerationError("no"); })),
                 GenerationError);
    EXPECT_EQ(mine.cache_status(), "");
    EXPECT_NE(mine.execution().caches.morphs("set", a_morph), nullptr);
}

}  // namespace
}  // namespace sporeprint::api::cache_store_test
