#include "core/atlas/atlas.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string>
#include <utility>
#include <vector>

#include "core/params/reader.h"
#include "core/silhouette/morph_set.h"
#include "core/silhouette/proof.h"
#include "tests/support/atlas.h"
#include "tests/support/effort.h"
#include "tests/support/meshes.h"
#include "tests/support/orders.h"

namespace sporeprint::atlas_atlas_test {
namespace {

/// A temporary folder of one test, removed when the test ends.
class Folder {
  public:
    Folder()
        : path_(std::filesystem::path(::testing::TempDir()) /
                ("atlas_" + std::to_string(::testing::UnitTest::GetInstance()->random_seed()) +
                 "_" + ::testing::UnitTest::GetInstance()->current_test_info()->name())) {
        std::filesystem::remove_all(path_);
        std::filesystem::create_directories(path_);
    }
    ~Folder() { std::filesystem::remove_all(path_); }
    Folder(const Folder&) = delete;
    Folder& operator=(const Folder&) = delete;

    void write(const std::string& name, const std::string& text) const {
        std::filesystem::create_directories((path_ / name).parent_path());
        std::ofstream(path_ / name, std::ios::binary) << text;
    }
    [[nodiscard]] const std::filesystem::path& path() const { return path_; }

  private:
    std::filesystem::path path_;
};

/// Returns the template of a species with one piece of its text replaced.
std::string edited(const std::string& id, const std::string& from, const std::string& to) {
    std::string json = atlas().find(id)->json;
    const std::size_t at = json.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    return json.replace(at, from.size(), to);
}

TEST(Atlas, HoldsItsSpeciesSortedById) {
    const std::vector<std::string> ids = species_ids();
    EXPECT_TRUE(std::is_sorted(ids.begin(), ids.end()));
    EXPECT_EQ(std::adjacent_find(ids.begin(), ids.end()), ids.end());
    for (const std::string& id : ids) {
        ASSERT_NE(atlas().find(id), nullptr) << id;
        EXPECT_EQ(atlas().find(id)->species.id.string(), id);
    }
    EXPECT_EQ(atlas().find("amanita"), nullptr);
    EXPECT_EQ(atlas().find(""), nullptr);
    EXPECT_EQ(atlas().find("zzz"), nullptr);
}

TEST(Atlas, EverySpeciesHasStagesFromButtonToDecay) {
    for (const AtlasEntry& entry : atlas().entries()) {
        const std::string id = entry.species.id.string();
        const auto& stages = entry.species.stages;
        ASSERT_GE(stages.size(), 5u) << id;
        EXPECT_EQ(stages.front().age, 0.0) << id;
        EXPECT_EQ(stages.back().age, 1.0) << id;
        const auto between = [&](double from, double to) {
            return std::any_of(stages.begin(), stages.end(), [&](const Stage& stage) {
                return stage.age >= from && stage.age <= to;
            });
        };
        EXPECT_TRUE(between(0.2, 0.35)) << id << " is never young";
        EXPECT_TRUE(between(0.6, 0.6)) << id << " has no template at maturity";
        EXPECT_TRUE(between(0.8, 0.85)) << id << " is never old";
        EXPECT_EQ(stages.back().model.weathering.wetness, 0.0) << id << ": rain is no age";
        EXPECT_FALSE(entry.species.facts.sources.empty());
    }
}

TEST(Atlas, GrowthIsMonotoneUntilMaturityAndLossesArePermanent) {
    for (const AtlasEntry& entry : atlas().entries()) {
        const std::string id = entry.species.id.string();
        const auto& stages = entry.species.stages;
        for (std::size_t i = 1; i < stages.size(); ++i) {
            const Model &before = stages[i - 1].model, &after = stages[i].model;
            EXPECT_GE(after.weathering.fade, before.weathering.fade) << id;
            EXPECT_GE(after.surface.stem.base_stain, before.surface.stem.base_stain) << id;
            if (const auto* grown = std::get_if<Branched>(&after.shape)) {
                const SegmentStyle &old = grown->segments,
                                   &young = std::get<Branched>(before.shape).segments;
                // Branches fork as they rise, and no fork closes again.
                EXPECT_GE(old.unfolding, young.unfolding) << id << " at " << stages[i].age;
                EXPECT_EQ(old.unfolding == 1.0, stages[i].age >= 0.6) << id;
                if (stages[i].age <= 0.6) {
                    EXPECT_GT(old.height, young.height) << id;
                }
                continue;
            }
            const Silhouette &young = std::get<Swept>(before.shape).silhouette,
                             &old = std::get<Swept>(after.shape).silhouette;
            // The width is that of the whole shape: rays of an earthstar reach further than the sac
            // that its cap becomes.
            const auto widest = [](const Silhouette& shape) {
                double r = 0.0;
                for (const auto* part : {&shape.stem, &shape.hymenium, &shape.cap})
                    for (const OutlinePoint& p : *part) r = std::max(r, p.r);
                return r;
            };
            // The height is measured from the underground part, or from below the middle of a wall,
            // to the top.
            const auto tall = [](const Silhouette& shape) {
                double low = 0.0, high = 0.0;
                for (const auto* part : {&shape.stem, &shape.hymenium, &shape.cap})
                    for (const OutlinePoint& p : *part) {
                        low = std::min(low, p.y);
                        high = std::max(high, p.y);
                    }
                return high - low;
            };
            if (stages[i].age <= 0.6) {
                // A species that grows tall from a wide egg becomes slimmer.
                EXPECT_TRUE(widest(old) > widest(young) || tall(old) > tall(young))
                    << id << " at " << stages[i].age;
                // A cup flattens while it widens; rays of an earthstar bend down and lift it.
                EXPECT_TRUE(tall(old) > tall(young) || old.stem.back().y > young.stem.back().y)
                    << id << " at " << stages[i].age;
            } else {
                EXPECT_LE(after.ornaments.warts, before.ornaments.warts) << id;
                EXPECT_LE(after.ornaments.scales, before.ornaments.scales) << id;
                EXPECT_LE(after.ornaments.ring, before.ornaments.ring) << id;
            }
            EXPECT_GE(after.weathering.waves, before.weathering.waves) << id;
        }
    }
}

TEST(Atlas, NoOutlineTouchesItselfAtAnyAge) {
    for (const AtlasEntry& entry : swept_atlas().entries()) {
        std::vector<ControlShape> shapes;
        for (const Stage& stage : entry.species.stages)
            shapes.push_back({std::get<Swept>(stage.model.shape).silhouette, 1.0, 0, stage.age});
        const MorphSet set(shapes);
        const auto line = [&](std::size_t stage, int lod) {
            std::vector<double> weights(shapes.size());
            weights[stage] = 1.0;
            const Outline outline(set.nodes(weights));
            Polyline points;
            for (const CurveName curve : {CurveName::stem, CurveName::hymenium, CurveName::cap})
                for (const OutlineSample& ring : outline.rings(curve, lod))
                    // The first ring of a sub-curve is the last of the one before it.
                    if (points.empty() || points.back() != glm::dvec2(ring.r, ring.y))
                        points.emplace_back(ring.r, ring.y);
            return points;
        };
        for (int lod = 0; lod < 4; ++lod)
            for (std::size_t stage = 0; stage + 1 < shapes.size(); ++stage) {
                const auto intersection =
                    first_intersection(line(stage, lod), line(stage + 1, lod));
                EXPECT_FALSE(intersection)
                    << entry.species.id.string() << ", lod " << lod << ": "
                    << (intersection ? intersection->t : 0.0) << " of the way from "
                    << shapes[stage].age << " to " << shapes[stage + 1].age;
            }
    }
}

TEST(Atlas, ExtremeIndividualsAreValidAtAndBetweenStages) {
    for (const AtlasEntry& entry : atlas().entries()) {
        const auto& stages = entry.species.stages;
        for (std::size_t i = 0; i < stages.size(); ++i)
            for (const double onwards : {0.0, 0.5}) {
                if (i + 1 == stages.size() && onwards > 0.0) continue;
                const double next = onwards > 0.0 ? stages[i + 1].age : stages[i].age;
                for (std::uint32_t seed = 1; seed <= effort(12); ++seed) {
                    MushroomSpec order =
                        order_of(entry.species.id.string(),
                                 stages[i].age + onwards * (next - stages[i].age), seed, 2);
                    order.params.variation = 1.0;
                    SCOPED_TRACE(entry.species.id.string() + " at " +
                                 std::to_string(order.params.age) + ", seed " +
                                 std::to_string(seed));
                    expect_valid(mesh_of(order));
                }
            }
    }
}

TEST(Atlas, TheServedTemplateReadsBackAsTheSameSpecies) {
    for (const AtlasEntry& entry : atlas().entries()) {
        std::vector<Problem> problems;
        EXPECT_EQ(read_json<Species>(entry.json, problems), entry.species);
        EXPECT_EQ(problems, std::vector<Problem>{});
        const Atlas again({.species = {entry.json}});
        EXPECT_EQ(again.entries()[0].hash, entry.hash);
        EXPECT_EQ(again.entries()[0].json, entry.json);
    }
}

TEST(Atlas, AnotherTemplateHasAnotherHash) {
    const Atlas other(
        {.species = {edited("boletus_edulis", "\"common_name\":\"", "\"common_name\":\"My ")}});
    EXPECT_NE(other.entries()[0].hash, atlas().find("boletus_edulis")->hash);
}

TEST(Atlas, ProblemsNameTheirSpecies) {
    const std::string boletus = atlas().find("boletus_edulis")->json;
    EXPECT_TRUE(names(refusal([&] {
                          (void)Atlas({.species = {boletus, boletus}});
                      }),
                      "boletus_edulis:/id", "two templates"));
    const auto problems = refusal([&] {
        (void)Atlas(
            {.species = {edited("boletus_edulis", "\"spread\":{", "\"spread\":{\"speed\":1,"), "{}",
                         edited("russula_vinosa", "\"season\":[", "\"season\":[0,")}});
    });
    EXPECT_TRUE(names(problems, "boletus_edulis:/spread/speed"));
    EXPECT_TRUE(names(problems, "a template without id:/id", "missing"));
    EXPECT_TRUE(names(problems, "russula_vinosa:/facts/season/0"));
}

TEST(Atlas, OrderOfTextsDoesNotMatter) {
    std::vector<std::string> texts;
    for (const AtlasEntry& entry : atlas().entries()) texts.insert(texts.begin(), entry.json);
    const Atlas other({.species = texts});
    for (std::size_t i = 0; i < other.entries().size(); ++i)
        EXPECT_EQ(other.entries()[i].species.id, atlas().entries()[i].species.id);
}

TEST(Atlas, OnlyTheTemplatesOfAFolderAreRead) {
    const Folder folder;
    folder.write("porcini.json", atlas().find("boletus_edulis")->json);
    folder.write("notes.txt", "not a template");
    const auto found = atlas_from(folder.path());
    ASSERT_EQ(found->entries().size(), 1u);
    EXPECT_EQ(found->entries()[0].species, atlas().find("boletus_edulis")->species);
}

TEST(Atlas, InvalidFoldersAndFilesAreNamed) {
    const Folder folder;
    const auto said = [&] { return refusal([&] { (void)atlas_from(folder.path()); }); };
    EXPECT_TRUE(names(said(), folder.path().string(), "no *.json"));
    EXPECT_TRUE(names(refusal([&] { (void)atlas_from(folder.path() / "nowhere"); }),
                      (folder.path() / "nowhere").string(), "cannot be read"));
    folder.write("broken.json", "{\"id\": \"x\",");
    ASSERT_FALSE(said().empty());
    EXPECT_NE(said()[0].path.find("broken.json"), std::string::npos) << said()[0].path;
    folder.write("broken.json", "{\"id\": \"x\", \"id\": \"y\"}");
    EXPECT_NE(said()[0].path.find("broken.json"), std::string::npos) << said()[0].path;
    folder.write("broken.json", edited("boletus_edulis", "\"age\":0.6", "\"age\":7"));
    const auto problems = said();
    ASSERT_FALSE(problems.empty());
    EXPECT_NE(problems[0].path.find("broken.json:/stages/"), std::string::npos) << problems[0].path;
}

/// Returns the ids of leaves, trees or worlds, in their order.
template <class Presets>
std::vector<std::string> ids_of(const Presets& presets) {
    std::vector<std::string> ids;
    for (const auto& preset : presets) ids.push_back(preset.id.string());
    return ids;
}

using Ids = std::vector<std::string>;

/// Returns the JSON of a built-in leaf under another id.
std::string leaf_json(const std::string& id, const std::string& like, int rank = 1000) {
    return dump(write(*leaf_preset(like)).set("id", id).set("rank", rank));
}

/// Returns the JSON of a built-in tree under another id, with another leaf.
std::string tree_json(const std::string& id, const std::string& like, const std::string& leaf,
                      int rank = 1000) {
    return dump(write(*tree_preset(like)).set("id", id).set("leaf", leaf).set("rank", rank));
}

TEST(Atlas, LeavesAndTreesStandByRank) {
    EXPECT_TRUE(std::ranges::is_sorted(atlas().leaves(), {}, &LeafPreset::rank));
    EXPECT_TRUE(std::ranges::is_sorted(atlas().trees(), {}, &TreePreset::rank));
    EXPECT_EQ(atlas().leaves().front().id.view(), "maple");
    EXPECT_EQ(atlas().trees().front().id.view(), "broadleaf");
    EXPECT_TRUE(std::ranges::equal(atlas().leaf_ids(), ids_of(atlas().leaves())));
    const Atlas own(
        {.leaves = {leaf_json("b", "oak"), leaf_json("c", "ivy", 1), leaf_json("a", "fern")},
         .trees = {tree_json("b", "herb", "c", 2), tree_json("a", "herb", "a", 3)}});
    EXPECT_EQ(ids_of(own.leaves()), (Ids{"c", "a", "b"})) << "equal ranks by id";
    EXPECT_EQ(ids_of(own.trees()), (Ids{"b", "a"}));
}

TEST(Atlas, FindsLeavesAndTreesByTheirOwnIds) {
    ASSERT_NE(atlas().find_leaf("birch"), nullptr);
    ASSERT_NE(atlas().find_tree("birch"), nullptr);
    EXPECT_EQ(atlas().find("birch"), nullptr);
    EXPECT_EQ(atlas().find_leaf("spruce"), nullptr);
    EXPECT_EQ(atlas().find_tree("maple"), nullptr);
    EXPECT_EQ(atlas().find_tree(""), nullptr);
}

TEST(Atlas, LeavesTreesAndWorldsReadBackFromTheirJson) {
    AtlasTexts texts;
    for (const LeafPreset& leaf : atlas().leaves()) texts.leaves.push_back(dump(write(leaf)));
    for (const TreePreset& tree : atlas().trees()) texts.trees.push_back(dump(write(tree)));
    for (const WorldPreset& world : atlas().worlds()) texts.worlds.push_back(dump(write(world)));
    Atlas again(texts);
    EXPECT_TRUE(std::ranges::equal(again.leaves(), atlas().leaves()));
    EXPECT_TRUE(std::ranges::equal(again.trees(), atlas().trees()));
    EXPECT_TRUE(std::ranges::equal(again.worlds(), atlas().worlds()));
    EXPECT_EQ(again.leaf_text(), atlas().leaf_text());
    const Atlas moved = std::move(again);
    EXPECT_TRUE(moved.trees()[0].leaf.allows("needle"));
    EXPECT_EQ(moved.trees()[0].leaf.among.data(), moved.leaf_ids().data());
}

TEST(Atlas, WorldsStandByRankAndAreFoundByTheirIds) {
    EXPECT_TRUE(std::ranges::is_sorted(atlas().worlds(), {}, &WorldPreset::rank));
    EXPECT_EQ(atlas().worlds().front().id.view(), "beech");
    ASSERT_NE(atlas().find_world("birch"), nullptr);
    EXPECT_EQ(atlas().find_world("maple"), nullptr);
    const std::string wood = R"({"id":"wood","name":"Wood"})";
    const auto problems = refusal([&] {
        (void)Atlas({.worlds = {wood, wood, R"({"id":"wet","name":"Wet","climate":{"rain":3001}})",
                                R"({"id":"bare"})"}});
    });
    EXPECT_TRUE(names(problems, "wood:/id", "two templates"));
    EXPECT_TRUE(names(problems, "wet:/climate/rain", "3001 is outside"));
    EXPECT_TRUE(names(problems, "bare:/name", "missing"));
}

TEST(Atlas, ProblemsOfLeavesAndTreesNameTheirId) {
    const auto said = [](const AtlasTexts& texts) { return refusal([&] { (void)Atlas(texts); }); };
    const std::string oak = leaf_json("oak", "oak");
    EXPECT_TRUE(names(said({.leaves = {oak, oak}}), "oak:/id", "two templates"));
    const std::string herb = tree_json("herb", "herb", "oak");
    EXPECT_TRUE(names(said({.leaves = {oak}, .trees = {herb, herb}}), "herb:/id", "two templates"));
    const auto leaves = said({.leaves = {R"({"id":"thin","name":"Thin","shape":{"length":9}})",
                                         R"({"id":"My Leaf","name":"Mine"})", R"({"id":"bare"})",
                                         R"({"name":"Nobody"})"}});
    EXPECT_TRUE(names(leaves, "thin:/shape/length", "9 is outside"));
    EXPECT_TRUE(names(leaves, "My Leaf:/id", "other characters than"));
    EXPECT_TRUE(names(leaves, "bare:/name", "missing"));
    EXPECT_TRUE(names(leaves, "a template without id:/id", "missing"));
}

TEST(Atlas, ATreeOfAnUnknownLeafIsRefused) {
    const auto said = [](const std::string& leaf, const std::vector<std::string>& leaves) {
        return refusal(
            [&] { (void)Atlas({.leaves = leaves, .trees = {tree_json("t", "herb", leaf)}}); });
    };
    const std::vector<std::string> leaves{leaf_json("oak", "oak"), leaf_json("maple", "maple", 1)};
    EXPECT_TRUE(names(said("oka", leaves), "t:/leaf",
                      "'oka' is not one of maple, oak; did you mean 'oak'?"));
    EXPECT_TRUE(names(said("zzzzzz", leaves), "t:/leaf", "'zzzzzz' is not one of maple, oak"));
    EXPECT_TRUE(names(said("oak", {}), "t:/leaf", "no leaves"));
    EXPECT_EQ(said("oak", leaves), std::vector<Problem>{});
}

TEST(Atlas, AFolderHoldsTheFourKinds) {
    const Folder folder;
    const std::string boletus = atlas().find("boletus_edulis")->json;
    folder.write("species/porcini.json", boletus);
    const auto species_only = atlas_from(folder.path());
    EXPECT_EQ(species_only->entries().size(), 1u);
    EXPECT_EQ(ids_of(species_only->leaves()), ids_of(atlas().leaves()));
    EXPECT_EQ(ids_of(species_only->trees()), ids_of(atlas().trees()));
    EXPECT_EQ(ids_of(species_only->worlds()), ids_of(atlas().worlds()));

    folder.write("leaves/elm.json", leaf_json("elm", "birch"));
    folder.write("leaves/notes.txt", "not a template");
    folder.write("trees/elm.json", tree_json("elm", "shrub", "elm"));
    folder.write("worlds/fen.json", R"({"id":"fen","name":"Fen"})");
    folder.write("agaric.json", atlas().find("amanita_muscaria")->json);
    const auto all = atlas_from(folder.path());
    EXPECT_EQ(all->entries().size(), 2u) << "beside the subfolder, too";
    EXPECT_EQ(ids_of(all->leaves()), Ids{"elm"});
    EXPECT_EQ(ids_of(all->trees()), Ids{"elm"});
    EXPECT_EQ(ids_of(all->worlds()), Ids{"fen"});

    folder.write("again.json", boletus);
    EXPECT_TRUE(
        names(refusal([&] { (void)atlas_from(folder.path()); }), "boletus_edulis:/id", "two"));
}

TEST(Atlas, AFolderOfTreesKeepsTheBuiltInSpeciesAndLeaves) {
    const Folder folder;
    folder.write("trees/hedge.json", tree_json("hedge", "shrub", "ivy"));
    const auto found = atlas_from(folder.path());
    EXPECT_EQ(found->entries().size(), atlas().entries().size());
    EXPECT_EQ(ids_of(found->leaves()), ids_of(atlas().leaves()));
    EXPECT_EQ(ids_of(found->trees()), Ids{"hedge"});
}

TEST(Atlas, InvalidFilesOfLeavesAndTreesAreNamed) {
    const Folder folder;
    const auto said = [&] { return refusal([&] { (void)atlas_from(folder.path()); }); };
    const auto first_path = [&] {
        const auto problems = said();
        return problems.empty() ? std::string() : problems[0].path;
    };
    folder.write("trees/broken.json", "{\"id\": ");
    EXPECT_NE(first_path().find("trees/broken.json"), std::string::npos) << first_path();
    folder.write("trees/broken.json", tree_json("x", "herb", "elm"));
    EXPECT_TRUE(names(said(), "x:/leaf", "'elm' is not one of maple"));
    folder.write("leaves/broken.json", R"({"id":"elm","name":"Elm","petals":5})");
    EXPECT_NE(first_path().find("leaves/broken.json:/petals"), std::string::npos) << first_path();
    // The leaves of a folder replace the built-in ones, which the built-in trees need.
    std::filesystem::remove_all(folder.path() / "trees");
    folder.write("leaves/broken.json", leaf_json("elm", "birch"));
    EXPECT_TRUE(names(said(), "birch:/leaf", "'birch' is not one of elm"));
}

}  // namespace
}  // namespace sporeprint::atlas_atlas_test
