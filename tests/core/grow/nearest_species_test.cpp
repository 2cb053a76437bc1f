#include "core/grow/nearest_species.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "tests/support/atlas.h"
#include "tests/support/effort.h"
#include "tests/support/orders.h"
#include "tests/support/photographs.h"

namespace sporeprint::grow_nearest_species_test {
namespace {

const NearestSpecies& nearest() {
    static const NearestSpecies made(atlas());
    return made;
}

TEST(NearestSpecies, OfOtherIndividualsIsMostlyTheirOwn) {
    const std::vector<std::string> ids = species_ids();
    const std::size_t count = std::max(effort(2 * ids.size(), 12), ids.size() / 2);
    std::size_t first = 0, in_three = 0;
    for (std::size_t i = 0; i < count; ++i) {
        const std::string& id = ids[5 * i % ids.size()];
        const Photograph photo = photograph(
            {id, i % 2 == 0 ? 0.55 : 0.85, static_cast<std::uint32_t>(11 + i), View::front, 384},
            Scenery::plain);
        const std::vector<NearSpecies> found =
            nearest().find(trace::likeness_of(photo.picture, photo.truth), 3);
        ASSERT_EQ(found.size(), 3U);
        first += found[0].id == id ? 1 : 0;
        in_three += std::any_of(found.begin(), found.end(),
                                [&](const NearSpecies& one) { return one.id == id; })
                        ? 1
                        : 0;
    }
    const auto all = static_cast<double>(count);
    EXPECT_GE(static_cast<double>(first), 0.8 * all) << count;
    EXPECT_GE(static_cast<double>(in_three), 0.9 * all) << count;
}

TEST(NearestSpecies, AreSortedAndEachIsNamedOnce) {
    const Photograph photo =
        photograph({"boletus_edulis", 0.7, 3, View::front, 256}, Scenery::plain);
    const trace::Likeness likeness = trace::likeness_of(photo.picture, photo.truth);
    const std::vector<NearSpecies> found = nearest().find(likeness, 1000);
    EXPECT_EQ(found.size(), species_ids().size());
    for (std::size_t i = 1; i < found.size(); ++i)
        EXPECT_LE(found[i - 1].apart.total(), found[i].apart.total());
    std::vector<std::string> ids;
    for (const NearSpecies& one : found) ids.push_back(one.id);
    std::sort(ids.begin(), ids.end());
    EXPECT_EQ(std::unique(ids.begin(), ids.end()), ids.end());
    EXPECT_TRUE(nearest().find(likeness, 0).empty());
    // One species drawn alone is as near as among all.
    for (const std::size_t i : {std::size_t{0}, found.size() / 2}) {
        const NearSpecies alone = near_species(likeness, found[i].id, atlas());
        EXPECT_EQ(alone.age, found[i].age);
        EXPECT_EQ(alone.apart.total(), found[i].apart.total());
    }
}

}  // namespace
}  // namespace sporeprint::grow_nearest_species_test
