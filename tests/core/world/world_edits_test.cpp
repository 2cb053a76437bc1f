#include "core/world/world_edits.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <memory>
#include <set>
#include <utility>
#include <vector>

namespace sporeprint::world_edits_test {
namespace {

std::shared_ptr<const WorldMask> mask(std::vector<std::uint16_t> values) {
    return std::make_shared<const WorldMask>(
        WorldMask{256, values.size() == 4 ? 2 : 1, std::move(values)});
}

WorldEdits some() {
    WorldEdits edits;
    edits.ecologies["a"].months = {7, 3, 7};
    edits.founders["b"] = {{5.0, 1.0, 20}, {-4.0, 2.0, -200}, {5.0, 1.0, 20}};
    edits.masks["trees"] = mask({0, 1, 2, 65535});
    edits.masks["fungi"] = mask({65535, 65535, 65535, 65535});
    return edits;
}

TEST(Months, AreBits) {
    EXPECT_EQ(bits_of_months(std::vector{7}), 0x040);
    EXPECT_EQ(bits_of_months(std::vector{1, 12, 1}), 0x801);
    EXPECT_EQ(bits_of_months({}), 0xFFF);
}

TEST(WorldEdits, AreSettledWithoutOrderAndRepetition) {
    const WorldEdits edits = settled(some());
    EXPECT_EQ(edits.ecologies.at("a").months, (std::vector{3, 7}));
    EXPECT_EQ(edits.founders.at("b"), (std::vector<Founder>{{-4.0, 2.0, -200}, {5.0, 1.0, 20}}));
    EXPECT_NE(edits.mask("trees"), nullptr);
    EXPECT_EQ(edits.mask("fungi"), nullptr) << "it takes nothing away";
    EXPECT_EQ(edits.mask("a"), nullptr);
    EXPECT_FALSE(edits.empty());
    EXPECT_GT(edits.bytes(), sizeof(WorldEdits));
}

TEST(WorldEdits, ThatChangeNothingAreNone) {
    WorldEdits edits;
    edits.founders["b"] = {};
    edits.masks["fungi"] = mask({65535});
    EXPECT_FALSE(edits.empty());
    EXPECT_TRUE(settled(edits).empty());
    EXPECT_EQ(settled(edits).text, "");
}

TEST(WorldEdits, HaveOneTextIfTheyAreEqual) {
    WorldEdits other = some();
    std::ranges::reverse(other.founders["b"]);
    other.ecologies["a"].months = {3, 7};
    other.masks.erase("fungi");
    EXPECT_EQ(settled(other).text, settled(some()).text);

    std::set<std::string> texts{settled(some()).text};
    const auto add = [&](const auto& change) {
        WorldEdits edits = some();
        change(edits);
        texts.insert(settled(edits).text);
    };
    add([](WorldEdits& edits) { edits.ecologies["a"].months = {7}; });
    add([](WorldEdits& edits) { edits.ecologies["a"].ecology.genet.speed = 0.2; });
    add([](WorldEdits& edits) { edits.founders["b"][0].x = 5.25; });
    add([](WorldEdits& edits) { edits.founders["c"] = std::move(edits.founders["b"]); });
    add([](WorldEdits& edits) { edits.masks["trees"] = mask({0, 1, 3, 65535}); });
    add([](WorldEdits& edits) { edits.masks["fungi"] = edits.masks["trees"]; });
    EXPECT_EQ(texts.size(), 7U);
}

}  // namespace
}  // namespace sporeprint::world_edits_test
