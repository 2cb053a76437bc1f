#include "api/cache/photos.h"

#include <gtest/gtest.h>

#include <chrono>
#include <set>
#include <string>
#include <thread>
#include <vector>

namespace sporeprint::api::cache_photos_test {
namespace {

using namespace std::chrono_literals;

constexpr Photos::Time start{};
/// Of the working copy and the mask of a photograph of 10 x 10 pixels.
constexpr std::size_t cut_bytes = 400;

StoredPhoto photo(std::size_t bytes) {
    return {Slice(std::make_shared<const Bytes>(bytes)), 10, 10, std::nullopt};
}

TEST(Photos, AreFoundByTheirNameUntilTheyExpire) {
    Photos photos(64U << 20U);
    const std::string name = photos.insert(photo(1000), start);
    EXPECT_EQ(name.size(), Photos::name_length);
    EXPECT_EQ(
        name.find_first_not_of("ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789-_"),
        std::string::npos);
    ASSERT_NE(photos.find(name, start + Photos::lifetime - 1s), nullptr);
    EXPECT_EQ(photos.find(name, start)->jpeg.size, 1000U);
    EXPECT_EQ(photos.find(name.substr(1), start), nullptr);
    EXPECT_EQ(photos.find("", start), nullptr);
    EXPECT_EQ(photos.bytes(), 1000U + cut_bytes);
    EXPECT_EQ(photos.find(name, start + Photos::lifetime), nullptr);
    EXPECT_EQ(photos.bytes(), 0U);
}

TEST(Photos, HaveNamesThatNeverRepeat) {
    Photos photos(1);
    std::set<std::string> names;
    for (int i = 0; i < 1000; ++i) EXPECT_TRUE(names.insert(photos.insert(photo(1), start)).second);
}

TEST(Photos, AreForgottenOnRequestAndOnlyOnce) {
    Photos photos(64U << 20U);
    const std::string name = photos.insert(photo(10), start),
                      other = photos.insert(photo(20), start);
    EXPECT_TRUE(photos.erase(name, start));
    EXPECT_FALSE(photos.erase(name, start));
    EXPECT_EQ(photos.find(name, start), nullptr);
    EXPECT_NE(photos.find(other, start), nullptr);
    EXPECT_EQ(photos.bytes(), 20U + cut_bytes);
}

TEST(Photos, ThatAreOldestMakeRoom) {
    Photos photos(3 * (cut_bytes + 1000));
    std::vector<std::string> names;
    for (int i = 0; i < 5; ++i) names.push_back(photos.insert(photo(1000), start + i * 1s));
    const auto now = start + 10s;
    EXPECT_EQ(photos.find(names[0], now), nullptr);
    EXPECT_EQ(photos.find(names[1], now), nullptr);
    for (const std::size_t i : {2U, 3U, 4U}) EXPECT_NE(photos.find(names[i], now), nullptr) << i;
    EXPECT_LE(photos.bytes(), photos.most_bytes());
    // One that is larger than all of it is stored alone.
    const std::string large = photos.insert(photo(photos.most_bytes()), now);
    EXPECT_NE(photos.find(large, now), nullptr);
    EXPECT_EQ(photos.find(names[4], now), nullptr);
}

TEST(Photos, StoreTheirLastCut) {
    Photos photos(64U << 20U);
    const std::string name = photos.insert(photo(10), start);
    const auto cut = std::make_shared<const StoredCut>(StoredCut{"a", {}, trace::Mask(3, 3, true)});
    photos.store_cut(name, cut, start);
    EXPECT_EQ(photos.cut(name, "a", start), cut);
    EXPECT_EQ(photos.cut(name, "b", start), nullptr);
    EXPECT_EQ(photos.cut("another", "a", start), nullptr);
    EXPECT_EQ(photos.last_cut(name, start), cut);
    EXPECT_EQ(photos.last_cut("another", start), nullptr);
    photos.store_cut(name, std::make_shared<const StoredCut>(StoredCut{"b", {}, {}}), start);
    EXPECT_EQ(photos.cut(name, "a", start), nullptr);
    EXPECT_EQ(photos.cut(name, "b", start + Photos::lifetime), nullptr);
    photos.store_cut(name, cut, start + Photos::lifetime);
    EXPECT_EQ(photos.bytes(), 0U);
}

TEST(Photos, MayBeUsedByManyThreads) {
    Photos photos(8 * 1000);
    std::vector<std::jthread> threads;
    for (int thread = 0; thread < 4; ++thread)
        threads.emplace_back([&photos] {
            for (int i = 0; i < 200; ++i) {
                const std::string name = photos.insert(photo(100), start);
                if (const auto found = photos.find(name, start)) {
                    EXPECT_EQ(found->jpeg.size, 100U);
                }
                photos.erase(name, start);
            }
        });
    threads.clear();
    EXPECT_EQ(photos.bytes(), 0U);
}

}  // namespace
}  // namespace sporeprint::api::cache_photos_test
