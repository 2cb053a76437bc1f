#include "core/grow/names.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <iterator>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "core/grow/colony.h"
#include "core/grow/leaf.h"
#include "core/grow/mushroom.h"
#include "core/grow/tree.h"
#include "core/params/value.h"
#include "tests/support/glb_reader.h"
#include "tests/support/meshes.h"
#include "tests/support/orders.h"

namespace sporeprint::grow_names_test {
namespace {

MushroomSpec fly_agaric() {
    MushroomSpec spec;
    spec.mix = {{"amanita_muscaria", 1000}};
    spec.params.seed = 7;
    return spec;
}

/// Returns all names of meshes, nodes, materials and images of a file.
std::vector<std::string> names_in(const Body& file) {
    const Value json = json_chunk(joined(file));
    std::vector<std::string> found;
    for (const char* list : {"meshes", "nodes", "materials", "images"})
        if (const Value* items = json.find(list))
            for (const Value& item : items->items())
                found.push_back(item.find("name")->as_string());
    return found;
}

bool is_plain(const std::string& name) {
    return !name.empty() && name.size() <= 128 && std::all_of(name.begin(), name.end(), [](char c) {
        return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_' || c == 'L' ||
               c == 'O' || c == 'D';
    });
}

TEST(Names, StateSpeciesSeedAgeAndLevel) {
    MushroomSpec spec = fly_agaric();
    EXPECT_EQ(product_name(spec), "amanita_muscaria_s7_a60");
    spec.params.lod = 2;
    spec.params.file.compress = Compression::meshopt;
    EXPECT_EQ(product_name(spec), "amanita_muscaria_s7_a60") << "levels are one individual";
    EXPECT_EQ(level_name(product_name(spec), 2), "amanita_muscaria_s7_a60_LOD2");
    EXPECT_EQ(skin_name(spec), "amanita_muscaria_s7_a60_skin_LOD2");
    EXPECT_EQ(file_name(product_name(spec), 2, {}, spec.params.file),
              "amanita_muscaria_s7_a60_LOD2_meshopt");
    FileOptions chain;
    chain.lods = Lods::msft;
    EXPECT_EQ(file_name("x", 0, {}, chain), "x_LOD0_msft");
    EXPECT_EQ(file_name("x", 0, 9000, chain), "x_t9000_LOD0_msft");
    chain.image_format = ImageFormats::webp;
    EXPECT_EQ(file_name("x", 0, {}, chain), "x_LOD0_webp_msft");
    spec.mix = {{"boletus_edulis", 300}, {"amanita_muscaria", 700}};
    EXPECT_EQ(product_name(spec), "amanita_muscaria_700_boletus_edulis_300_s7_a60");
    std::swap(spec.mix[0], spec.mix[1]);
    EXPECT_EQ(product_name(spec), "amanita_muscaria_700_boletus_edulis_300_s7_a60");
    ColonySpec colony;
    colony.mix = fly_agaric().mix;
    EXPECT_EQ(product_name(colony), "amanita_muscaria_colony_s1_a60");
    const LeafSpec leaf{"maple", params_of(*atlas().find_leaf("maple"))};
    EXPECT_EQ(product_name(leaf, atlas()), "maple_leaf_s1");
    const TreeSpec tree{"broadleaf", params_of(*atlas().find_tree("broadleaf"))};
    EXPECT_EQ(product_name(tree, atlas()), "broadleaf_tree_s1");
}

TEST(Names, OfALibraryArePlainAndDifferByOwner) {
    EXPECT_EQ(name_of_species("amanita_muscaria"), "amanita_muscaria");
    const std::string first = name_of_species("~kaja.red_cap@12"),
                      second = name_of_species("~kaja_red.cap@12");
    EXPECT_TRUE(first.starts_with("kaja_red_cap_12_")) << first;
    EXPECT_TRUE(second.starts_with("kaja_red_cap_12_")) << second;
    EXPECT_NE(first, second);
    MushroomSpec spec = fly_agaric();
    spec.mix = {{"~kaja.red_cap@12", 500}, {"~sami.fence_col@draft", 500}};
    EXPECT_TRUE(is_plain(product_name(spec))) << product_name(spec);
    EXPECT_TRUE(is_plain(skin_name(spec))) << skin_name(spec);
}

TEST(Names, DifferWhereverTheIndividualDiffers) {
    const MushroomSpec first = fly_agaric();
    std::vector<MushroomSpec> all(10, first);
    all[1].params.seed = 8;
    all[2].params.age = 0.61;
    all[3].params.age = 0.605;
    all[4].params.age = 0.6050001;
    all[5].params.size = 2.0;
    all[6].params.ornaments.glow = 0.5;
    all[7].params.texture_size.value = 512;
    all[8].params.textures = Textures::none;
    all[9].mix = {{"amanita_muscaria", 400}, {"boletus_edulis", 300}, {"coprinus_comatus", 300}};
    MushroomSpec other = all[9];
    other.mix = {{"amanita_muscaria", 400}, {"boletus_edulis", 300}, {"russula_vinosa", 300}};
    all.push_back(other);
    std::set<std::string> names;
    for (const MushroomSpec& spec : all) {
        const std::string name = product_name(spec);
        EXPECT_TRUE(is_plain(name)) << name;
        EXPECT_TRUE(names.insert(name).second) << name;
    }
}

TEST(Names, OfAModelOfOnesOwnHaveItsHash) {
    MushroomSpec own;
    own.model = atlas().entries()[0].species.stages.back().model;
    const std::string name = product_name(own);
    EXPECT_TRUE(name.starts_with("model_s1_a60_")) << name;
    own.model->material.slime = 0.123;
    EXPECT_NE(product_name(own), name);
}

TEST(Names, InFilesOfTwoSeedsAreSharedOnlyByWhatIsEqual) {
    TreeSpec tree{"broadleaf", params_of(*atlas().find_tree("broadleaf"))};
    tree.params.lod = 3;
    tree.params.texture_size.value = 128;
    std::vector<std::string> one = names_in(grow_tree(tree, atlas()).glb);
    tree.params.seed = 2;
    std::vector<std::string> two = names_in(grow_tree(tree, atlas()).glb);
    std::vector<std::string> both;
    std::sort(one.begin(), one.end());
    std::sort(two.begin(), two.end());
    std::set_intersection(one.begin(), one.end(), two.begin(), two.end(), std::back_inserter(both));
    EXPECT_EQ(both.size(), 8u) << "two materials and their six images";
    for (const std::string& name : both)
        EXPECT_TRUE(name.find("_bark_") != std::string::npos ||
                    name.find("_leaf_") != std::string::npos)
            << name;
    // The leaf alone, without sprays beside it, has a material of its own.
    LeafSpec leaf{"oak", leaf_of(tree.params, atlas())};
    leaf.preset = tree.params.look.leaf.id.string();
    for (const std::string& name : names_in(grow_leaf(leaf, atlas()).glb))
        EXPECT_EQ(std::find(both.begin(), both.end(), name), both.end()) << name;
}

TEST(Names, AreNoneOnWhichAnEditorActs) {
    MushroomSpec spec = fly_agaric();
    spec.params.lod = 3;
    spec.params.texture_size.value = 128;
    ColonySpec colony;
    colony.mix = {{"hypholoma_fasciculare", 1000}};
    colony.params.count = 3;
    colony.params.lod = 3;
    colony.params.texture_size.value = 128;
    std::vector<std::string> all = names_in(grow_mushroom(spec, atlas()).glb);
    for (const std::string& name : names_in(grow_colony(colony, atlas()).glb)) all.push_back(name);
    for (std::string name : all) {
        EXPECT_TRUE(is_plain(name)) << name;
        // Godot looks for these behind '-', '_' or '$', before digits.
        while (!name.empty() && name.back() >= '0' && name.back() <= '9') name.pop_back();
        for (const char* acted_on :
             {"col", "convcol", "colonly", "convcolonly", "rigid", "navmesh", "occ", "occonly",
              "noimp", "loop", "cycle", "vcol", "alpha", "wheel", "vehicle"})
            EXPECT_FALSE(name.ends_with(std::string("_") + acted_on)) << name;
    }
}

}  // namespace
}  // namespace sporeprint::grow_names_test
