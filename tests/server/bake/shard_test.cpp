#include "server/bake/shard.h"

#include <gtest/gtest.h>

#include <fstream>
#include <string>
#include <vector>

#include "core/math/random.h"
#include "core/params/types.h"
#include "tests/server/bake/folder.h"

namespace sporeprint::server::shard_test {
namespace {

using baking::files_in;
using baking::text_of;

/// An item of a text of its own.
BakedItem item_of(std::uint64_t number) {
    BakedItem item;
    item.number = number;
    item.target = "/v1/things/" + std::to_string(number) + ".txt";
    if (number % 5 == 3) {
        item.status = 422;
        item.problem = Value("no");
        return item;
    }
    const std::string text(100 + 37 * number % 900, static_cast<char>('a' + number % 26));
    item.body = {slice_of(text)};
    item.url = item.target + "?v=1";
    item.etag = "\"e\"";
    item.sha256 = sha256_hex(text.data(), text.size());
    item.file = "thing-" + std::to_string(number) + ".txt";
    return item;
}

class Shards : public baking::InFolder {
  protected:
    BakeSet set_of(BakeLayout layout) const {
        BakeSet set;
        set.folder = folder;
        set.manifest = "m";
        set.version = "1-0";
        set.layout = layout;
        set.count = 25;
        set.per_shard = 10;
        return set;
    }

    static ShardHead write(const BakeSet& set, std::uint64_t shard) {
        ShardWriter writer(set, shard);
        for (std::uint64_t i = set.first_of(shard); i < set.end_of(shard); ++i)
            writer.add(item_of(i));
        return writer.commit();
    }
};

TEST_F(Shards, HaveTheItemsThatTheIndexSays) {
    const BakeSet set = set_of(BakeLayout::tar);
    EXPECT_EQ(set.shards(), 3U);
    EXPECT_FALSE(head_of(set, 1));
    const ShardHead head = write(set, 1);
    EXPECT_EQ(head.items, 10U);
    EXPECT_EQ(head.failed, 2U);
    const std::string archive = text_of(folder / "000001.tar");
    EXPECT_EQ(head.bytes, archive.size());
    EXPECT_EQ(head.sha256, sha256_hex(archive.data(), archive.size()));
    std::uint64_t number = 10;
    for_each_line(set, 1, [&](const Value& line) {
        const BakedItem item = item_of(number++);
        EXPECT_EQ(line.find("key")->as_string(), key_of(item.number));
        if (item.failed()) {
            EXPECT_EQ(line.find("status")->as_number(), 422.0);
            EXPECT_EQ(line.find("offset"), nullptr);
            return;
        }
        const auto at = static_cast<std::size_t>(line.find("offset")->as_number()),
                   size = static_cast<std::size_t>(line.find("bytes")->as_number());
        EXPECT_EQ(sha256_hex(archive.data() + at, size), item.sha256);
    });
    EXPECT_EQ(number, 20U);
    EXPECT_EQ(damage_of(set, 1), "");
    EXPECT_EQ(damage_of(set, 0), "missing");
    EXPECT_EQ(write(set, 2).items, 5U) << "The last one is shorter.";
}

TEST_F(Shards, AreFilesWithNamesInTheOtherLayout) {
    const BakeSet set = set_of(BakeLayout::files);
    write(set, 0);
    const std::map<std::string, std::string> files = files_in(folder);
    EXPECT_EQ(files.size(), 9U) << "Eight were made of ten, and an index.";
    EXPECT_EQ(text_of(folder / "thing-7.txt").size(), 100U + 37 * 7);
    EXPECT_EQ(damage_of(set, 0), "");
    std::filesystem::remove(folder / "thing-7.txt");
    EXPECT_NE(damage_of(set, 0).find("thing-7.txt cannot be read"), std::string::npos);
}

TEST_F(Shards, OfAnotherSetAreMissing) {
    const BakeSet set = set_of(BakeLayout::tar);
    write(set, 0);
    BakeSet other = set;
    other.manifest = "other";
    EXPECT_FALSE(head_of(other, 0));
    other = set;
    other.version = "2-0";
    EXPECT_FALSE(head_of(other, 0));
    other = set;
    other.per_shard = 5;
    EXPECT_FALSE(head_of(other, 0));
    std::filesystem::resize_file(folder / "000000.tar", 1024);
    EXPECT_FALSE(head_of(set, 0));
}

TEST_F(Shards, AreThereCompletelyOrNotAtAll) {
    const BakeSet set = set_of(BakeLayout::tar);
    {
        ShardWriter writer(set, 0);
        writer.add(item_of(0));
    }
    EXPECT_TRUE(files_in(folder).empty());
}

TEST_F(Shards, ShowEveryFlippedBit) {
    const BakeSet set = set_of(BakeLayout::tar);
    write(set, 0);
    Random random(3, 0);
    for (const char* name : {"000000.tar", "000000.jsonl"}) {
        const std::string good = text_of(folder / name);
        for (int i = 0; i < 40; ++i) {
            std::string bad = good;
            const std::size_t at = random.bits() % bad.size();
            bad[at] = static_cast<char>(bad[at] ^ (1 << random.bits() % 8));
            std::ofstream(folder / name, std::ios::binary) << bad;
            // What the head says of bytes and of failed items is checked by nobody else.
            const std::size_t end_of_head = good.find('\n');
            if (name[7] == 'j' && at <= end_of_head) continue;
            EXPECT_NE(damage_of(set, 0), "") << name << " at " << at;
        }
        std::ofstream(folder / name, std::ios::binary) << good;
    }
    EXPECT_EQ(damage_of(set, 0), "");
}

}  // namespace
}  // namespace sporeprint::server::shard_test
