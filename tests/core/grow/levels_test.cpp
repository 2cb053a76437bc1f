#include "core/grow/levels.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <string>
#include <vector>

#include "core/grow/colony.h"
#include "core/grow/colony_estimate.h"
#include "core/grow/colony_individuals.h"
#include "core/grow/leaf.h"
#include "core/grow/mushroom.h"
#include "core/grow/tree.h"
#include "core/params/value.h"
#include "core/problems.h"
#include "tests/support/glb_reader.h"
#include "tests/support/meshes.h"
#include "tests/support/orders.h"
#include "tests/support/refusals.h"

namespace sporeprint::grow_levels_test {
namespace {

const Bounds box_of_one{glm::vec3(0.0F), glm::vec3(0.1F, 1.0F, 0.2F)};

TEST(Levels, SwitchWhereTheNextOutlineIsAPixelOff) {
    std::vector<Level> levels(3);
    set_coverages(levels, box_of_one, std::vector<double>{0.0, 0.01, 0.1});
    // 100 pixels high, an error of 1/100 is one pixel.
    EXPECT_DOUBLE_EQ(levels[0].screen_coverage, 100.0 / screen_pixels);
    EXPECT_DOUBLE_EQ(levels[1].screen_coverage, 10.0 / screen_pixels);
    EXPECT_DOUBLE_EQ(levels[2].screen_coverage, least_pixels / screen_pixels);
}

TEST(Levels, HaveCoveragesThatDescendFromOneAtMost) {
    std::vector<Level> levels(4);
    set_coverages(levels, box_of_one, std::vector<double>{0.0, 0.0, 5.0, 1e-5});
    EXPECT_EQ(levels[0].screen_coverage, 1.0);
    for (std::size_t i = 1; i < levels.size(); ++i) {
        EXPECT_LE(levels[i].screen_coverage, levels[i - 1].screen_coverage);
        EXPECT_GE(levels[i].screen_coverage, least_pixels / screen_pixels);
    }
    EXPECT_THROW(set_coverages(levels, box_of_one, std::vector<double>{0.0}), GenerationError);
}

TEST(Levels, ThePolygonInACircleIsNearerWithMoreCorners) {
    EXPECT_NEAR(inscribed_error(4), 1.0 - std::sqrt(0.5), 1e-12);
    EXPECT_LT(inscribed_error(40), 0.0031);
}

/// One product of each kind, with small images.
struct Products {
    MushroomSpec mushroom, coral;
    ColonySpec colony;
    LeafSpec leaf{"maple", params_of(*atlas().find_leaf("maple"))};
    TreeSpec tree{"birch", params_of(*atlas().find_tree("birch"))};

    Products(int lod, FileOptions file) {
        mushroom.mix = {{"amanita_muscaria", 1000}};
        coral.mix = {{"ramaria_formosa", 1000}};
        colony.mix = {{"hypholoma_fasciculare", 1000}};
        colony.params.count = 5;
        colony.params.distinct = 2;
        const auto set = [&](auto& params) {
            params.lod = lod;
            params.file = file;
            params.texture_size.value = 128;
        };
        set(mushroom.params);
        set(coral.params);
        set(colony.params);
        set(leaf.params);
        set(tree.params);
    }

    [[nodiscard]] std::vector<Grown> grown() const {
        std::vector<Grown> all;
        all.push_back(grow_mushroom(mushroom, atlas()));
        all.push_back(grow_mushroom(coral, atlas()));
        all.push_back(grow_leaf(leaf, atlas()));
        all.push_back(grow_tree(tree, atlas()));
        all.push_back(grow_colony(colony, atlas()));
        return all;
    }
};

constexpr std::size_t mushrooms = 2, whole_meshes = 4;  // products before the leaf, the colony

FileOptions chain(Lods lods, Compression compress = Compression::none) {
    FileOptions file;
    file.compress = compress;
    file.lods = lods;
    return file;
}

/// Returns the number that a pointer names; -1 if it names none.
double number_at(const Value& json, const std::string& pointer) {
    const Value* found = json.at_pointer(pointer);
    return found && found->is_number() ? found->as_number() : -1.0;
}

/// Returns the place of a whole level among the levels of a file.
std::size_t index_of(const Grown& file, int lod) {
    const Value json = json_chunk(joined(file.glb));
    std::size_t at = 0;
    while (number_at(json, "/asset/extras/levels/" + std::to_string(at) + "/lod") != lod) ++at;
    return at;
}

TEST(Levels, OfAFileAreTheMeshesOfFilesOfTheirOwn) {
    const std::vector<Grown> chains = Products(1, chain(Lods::nodes)).grown();
    for (int lod = 1; lod <= last_lod; ++lod) {
        const std::vector<Grown> alone = Products(lod, {}).grown();
        for (std::size_t i = 0; i < whole_meshes; ++i) {
            const ReadScene all = expect_scene(joined(chains[i].glb)),
                            one = expect_scene(joined(alone[i].glb));
            const std::size_t at = index_of(chains[i], lod);
            ASSERT_EQ(all.meshes[at].size(), one.meshes[0].size());
            for (std::size_t k = 0; k < one.meshes[0].size(); ++k)
                EXPECT_TRUE(same_bits(all.meshes[at][k].mesh, one.meshes[0][k].mesh)) << i << lod;
            if (i < mushrooms)
                EXPECT_NE(all.nodes[at].name, one.nodes[0].name) << "numbered within the file";
            else
                EXPECT_EQ(all.nodes[at].name, one.nodes[0].name);
            EXPECT_EQ(all.images, expect_scene(joined(Products(1, {}).grown()[i].glb)).images)
                << "one set, that of the first level";
        }
    }
}

TEST(Levels, ByMsftLodAreOutsideTheSceneButForTheFirst) {
    for (const Compression compress : {Compression::none, Compression::meshopt})
        for (const Grown& file : Products(0, chain(Lods::msft, compress)).grown()) {
            const Value json = json_chunk(joined(file.glb));
            EXPECT_EQ(json.at_pointer("/scenes/0/nodes")->items().size(), 1u);
            const auto root = static_cast<std::size_t>(number_at(json, "/scenes/0/nodes/0"));
            const Value& first = json.find("nodes")->items()[root];
            const auto& ids = first.at_pointer("/extensions/MSFT_lod/ids")->items();
            const auto& coverages = first.at_pointer("/extras/MSFT_screencoverage")->items();
            ASSERT_EQ(coverages.size(), json.at_pointer("/asset/extras/levels")->items().size());
            ASSERT_EQ(ids.size(), coverages.size() - 1);
            double before = 1.0;
            for (std::size_t i = 0; i < coverages.size(); ++i) {
                EXPECT_EQ(coverages[i].as_number(),
                          number_at(json, "/asset/extras/levels/" + std::to_string(i) +
                                              "/screen_coverage"));
                EXPECT_LE(coverages[i].as_number(), before);
                before = coverages[i].as_number();
            }
            for (std::size_t i = 0; i < ids.size(); ++i) {
                const Value& level =
                    json.find("nodes")->items()[static_cast<std::size_t>(ids[i].as_number())];
                const std::string name(level.find("name")->as_string());
                EXPECT_TRUE(name.ends_with("_LOD" + std::to_string(i + 1))) << name;
                const Value* stated =
                    json.at_pointer("/asset/extras/levels/" + std::to_string(i + 1) + "/name");
                EXPECT_TRUE(!stated || stated->as_string() == name) << name;
                EXPECT_EQ(level.find("translation"), nullptr) << "one pivot";
            }
            EXPECT_EQ(dump(*json.find("extensionsUsed")).find("MSFT_lod") != std::string::npos,
                      true);
            const Value* required = json.find("extensionsRequired");
            EXPECT_TRUE(!required || dump(*required).find("MSFT") == std::string::npos);
        }
}

TEST(Levels, HaveTheGeometryOfNodesInEitherForm) {
    const std::vector<Grown> nodes = Products(2, chain(Lods::nodes)).grown(),
                             msft = Products(2, chain(Lods::msft)).grown();
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        ASSERT_EQ(nodes[i].glb.size(), msft[i].glb.size());
        for (std::size_t k = 1; k < nodes[i].glb.size(); ++k)  // the first slice is the JSON
            EXPECT_EQ(
                std::memcmp(nodes[i].glb[k].data(), msft[i].glb[k].data(), nodes[i].glb[k].size),
                0);
    }
}

TEST(Levels, OfTheLastAreOne) {
    for (const Grown& file : Products(last_lod, chain(Lods::msft)).grown()) {
        const Value json = json_chunk(joined(file.glb));
        EXPECT_EQ(json.find("extensionsUsed"), nullptr) << "a list of no nodes is no glTF";
        EXPECT_EQ(json.at_pointer("/asset/extras/levels")->items().size(), 1u);
    }
}

TEST(Levels, OfAColonyAreNodesWithItsMembers) {
    const Value json = json_chunk(joined(Products(1, chain(Lods::nodes)).grown()[4].glb));
    const auto& roots = json.at_pointer("/scenes/0/nodes")->items();
    ASSERT_EQ(roots.size(), 3u);
    std::size_t members = 0;
    for (const Value& root : roots) {
        const Value& node = json.find("nodes")->items()[static_cast<std::size_t>(root.as_number())];
        EXPECT_EQ(node.find("mesh"), nullptr);
        const std::size_t children = node.find("children")->items().size();
        EXPECT_TRUE(members == 0 || children == members) << "the same individuals";
        members = children;
    }
}

TEST(Levels, AreAllEstimated) {
    const auto within = [](const Estimate& estimated, const Grown& file, const Estimate& first) {
        EXPECT_GE(1.05 * static_cast<double>(estimated.vertices),
                  static_cast<double>(file.vertices));
        EXPECT_GT(estimated.vertices, first.vertices);
        EXPECT_EQ(estimated.texels, first.texels) << "one set of images";
        EXPECT_GE(1.3 * static_cast<double>(estimated.bytes),
                  static_cast<double>(size_of(file.glb)));
    };
    const Products all(1, chain(Lods::msft)), one(1, {});
    const std::vector<Grown> files = all.grown();
    within(estimate(all.mushroom, atlas()), files[0], estimate(one.mushroom, atlas()));
    within(estimate(all.coral, atlas()), files[1], estimate(one.coral, atlas()));
    within(estimate(all.leaf), files[2], estimate(one.leaf));
    within(estimate(all.tree), files[3], estimate(one.tree));
    within(estimate(all.colony, typical_individual(all.colony, atlas()), atlas()), files[4],
           estimate(one.colony, typical_individual(one.colony, atlas()), atlas()));
}

TEST(Levels, OfAMushroomAreNumberedFromZero) {
    const Value json = json_chunk(joined(Products(1, chain(Lods::nodes)).grown()[0].glb));
    const auto& levels = json.at_pointer("/asset/extras/levels")->items();
    EXPECT_GT(levels.size(), 3u) << "with levels between the whole ones";
    for (std::size_t i = 0; i < levels.size(); ++i) {
        const std::string name(levels[i].find("name")->as_string());
        EXPECT_TRUE(name.starts_with("amanita_muscaria_s1_a60_")) << name;
        EXPECT_TRUE(name.ends_with("_from1_LOD" + std::to_string(i))) << name;
    }
}

TEST(Levels, AreNotAnimated) {
    MushroomSpec spec = Products(2, chain(Lods::msft)).mushroom;
    spec.params.animation = Animation::growth;
    EXPECT_TRUE(names(refusal([&] { (void)grow_mushroom(spec, atlas()); }), "/lods", "clip"));
}

}  // namespace
}  // namespace sporeprint::grow_levels_test
