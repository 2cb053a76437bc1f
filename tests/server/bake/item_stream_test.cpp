#include "server/bake/item_stream.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <stdexcept>
#include <thread>
#include <vector>

namespace sporeprint::server::item_stream_test {
namespace {

using namespace std::chrono_literals;

BakedItem numbered(std::uint64_t number) {
    BakedItem item;
    item.number = number;
    return item;
}

TEST(ItemStream, KeepsTheOrderOfItsRanges) {
    const std::vector<ItemRange> ranges = {{0, 3}, {10, 11}, {7, 9}, {100, 190}};
    for (const std::size_t threads : {1U, 2U, 7U}) {
        ItemStream stream(
            ranges,
            [](std::uint64_t number) {
                // Later ones are ready sooner.
                std::this_thread::sleep_for(std::chrono::microseconds(400 - 2 * number));
                return numbered(number);
            },
            threads);
        for (const ItemRange& range : ranges)
            for (std::uint64_t number = range.begin; number < range.end; ++number)
                EXPECT_EQ(stream.next().number, number);
    }
}

TEST(ItemStream, WorksAheadByAFewItems) {
    std::atomic<std::uint64_t> begun{0};
    ItemStream stream(
        {{0, 1000}},
        [&](std::uint64_t number) {
            ++begun;
            return numbered(number);
        },
        2);
    for (int i = 0; i < 200 && begun < 8; ++i) std::this_thread::sleep_for(5ms);
    std::this_thread::sleep_for(20ms);
    EXPECT_EQ(begun, 8U);
    for (int i = 0; i < 5; ++i) static_cast<void>(stream.next());
    for (int i = 0; i < 200 && begun < 13; ++i) std::this_thread::sleep_for(5ms);
    std::this_thread::sleep_for(20ms);
    EXPECT_EQ(begun, 13U) << "It ends with items that nobody takes.";
}

TEST(ItemStream, PassesOnAnErrorAtItsPlace) {
    ItemStream stream(
        {{0, 9}},
        [](std::uint64_t number) {
            if (number == 4) throw std::runtime_error("four");
            return numbered(number);
        },
        3);
    for (std::uint64_t number = 0; number < 9; ++number) {
        if (number == 4)
            EXPECT_THROW(static_cast<void>(stream.next()), std::runtime_error);
        else
            EXPECT_EQ(stream.next().number, number);
    }
}

TEST(ItemStream, MayBeEmpty) {
    const ItemStream stream({}, numbered, 3);
    SUCCEED();
}

}  // namespace
}  // namespace sporeprint::server::item_stream_test
