#include "core/scene/scene_substrates.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "tests/support/refusals.h"
#include "tests/support/scenes.h"

namespace sporeprint::scene_substrates_test {
namespace {

using scenes::kinds;

std::uint32_t bit(std::string_view kind) {
    for (std::size_t i = 0; i < kinds().size(); ++i)
        if (kinds()[i] == kind) return 1U << i;
    return 0;
}

MaterialSoil guess(std::string_view name) { return guessed_soil(name, kinds()); }

TEST(SceneSubstrates, AreGuessedByTheWordsOfNames) {
    EXPECT_EQ(guess("Oak_Bark_01"), (MaterialSoil{Soil::wood, bit("broadleaf")}));
    EXPECT_EQ(guess("birchTrunk"), (MaterialSoil{Soil::wood, bit("birch")}));
    EXPECT_EQ(guess("Pine"), (MaterialSoil{Soil::wood, bit("spruce")}));
    EXPECT_EQ(guess("old wood"), (MaterialSoil{Soil::wood, all_trees}));
    EXPECT_EQ(guess("Mossy stump"), (MaterialSoil{Soil::wood, all_trees}));
    EXPECT_EQ(guess("ForestFloor"), (MaterialSoil{Soil::litter, all_trees}));
    EXPECT_EQ(guess("beech_litter"), (MaterialSoil{Soil::litter, bit("broadleaf")}));
    EXPECT_EQ(guess("SOIL"), (MaterialSoil{Soil::ground, 0}));
    EXPECT_EQ(guess("dirt.003"), (MaterialSoil{Soil::ground, 0}));
    EXPECT_EQ(guess("Lawn"), (MaterialSoil{Soil::grass, 0}));
    for (const char* nothing : {"Rock", "stone_wall", "Metal", "Water", "", "Material.001",
                                "oak leaves", "catalog", "underground"})
        EXPECT_EQ(guess(nothing), MaterialSoil()) << nothing;
}

TEST(SceneSubstrates, AreWhatSomebodySays) {
    std::vector<Problem> problems;
    const auto named =
        soils_in("Mesh A:beech,tiles:none,Base:ground+spruce+birch,b:wood,Top:litter,g:grass",
                 kinds(), "substrates", problems);
    EXPECT_TRUE(problems.empty());
    ASSERT_EQ(named.size(), 6U);
    EXPECT_EQ(named[0], (NamedSoil{"Mesh A", {Soil::wood, bit("broadleaf")}}));
    EXPECT_EQ(named[1].soil, MaterialSoil());
    EXPECT_EQ(named[2].soil, (MaterialSoil{Soil::ground, bit("spruce") | bit("birch")}));
    EXPECT_EQ(named[3].soil, (MaterialSoil{Soil::wood, all_trees}));
    EXPECT_EQ(named[4].soil, (MaterialSoil{Soil::litter, all_trees}));
    EXPECT_EQ(named[5].soil.soil, Soil::grass);
    const std::vector<std::string> materials = {"", "mesh a", "Bark", "tiles"};
    const auto soils = soils_of(materials, std::span(named).first(2), kinds(), "s", problems);
    EXPECT_TRUE(problems.empty());
    EXPECT_EQ(soils[0].soil, Soil::none);
    EXPECT_EQ(soils[1].trees, bit("broadleaf"));
    EXPECT_EQ(soils[2].soil, Soil::wood) << "others are guessed";
    EXPECT_EQ(soils[3].soil, Soil::none);
}

TEST(SceneSubstrates, NameWhatIsWrong) {
    const auto refused = [](std::string_view text) {
        std::vector<Problem> problems;
        EXPECT_TRUE(soils_in(text, kinds(), "substrates", problems).empty());
        return problems;
    };
    EXPECT_TRUE(names(refused("Bark"), "substrates", "'Bark' is no material and what it is"));
    EXPECT_TRUE(names(refused(":beech"), "substrates", "no material"));
    EXPECT_TRUE(names(refused("Bark:plastic"), "substrates", "'plastic' is nothing"));
    EXPECT_TRUE(names(refused("Bark:"), "substrates", "'' is nothing"));
    EXPECT_TRUE(names(refused("a:beech,A:oak"), "substrates", "named twice"));
    EXPECT_TRUE(names(refused("a:none+oak"), "substrates", "none has no trees"));
    EXPECT_TRUE(names(refused("a:oak+soil"), "substrates", "'soil' is nothing"));
    std::vector<Problem> problems;
    const std::vector<NamedSoil> unknown = {{"Brak", {Soil::wood, 1}}};
    const std::vector<std::string> materials = {"Bark"};
    static_cast<void>(soils_of(materials, unknown, kinds(), "substrates", problems));
    EXPECT_TRUE(names(problems, "substrates", "no material 'Brak'"));
}

TEST(SceneSubstrates, KnowWhichWoodStandsAndHowFarItsRootsReach) {
    const auto scene = scenes::Made()
                           .floor(-12, -12, 12, 12, 0, "soil")
                           .box({-0.2F, -0.1F, -0.2F}, {0.2F, 3.0F, 0.2F}, "birch bark")
                           .box({4, 0, 4}, {7, 0.3F, 4.4F}, "oak log")
                           .shared();
    const auto shape = std::make_shared<const SceneShape>(shape_of_scene(scene));
    const SceneHabitat habitat = scenes::habitat_in(shape);
    const SurfelSubstrates& substrates = habitat.substrates;
    int standing = 0, lying = 0;
    for (const SceneWood& piece : substrates.wood)
        if (piece.area > 0.5) ++(piece.stands ? standing : lying);
    EXPECT_EQ(standing, 1);
    EXPECT_EQ(lying, 1);

    FungusSpecies mycorrhizal = scenes::litter_species();
    mycorrhizal.ecology.guild = Guild::ectomycorrhizal;
    mycorrhizal.kinds = bit("birch");
    FungusSpecies of_oaks = mycorrhizal;
    of_oaks.kinds = bit("broadleaf");
    const auto at = [&](double x, double z) {
        return shape->surfels.nearest({x, 0.0, z}, {0.0, 1.0, 0.0}, 1.0).value();
    };
    SceneWood tree;
    tree.high.y = 3.1;
    const double reach = root_reach_of(tree);
    ASSERT_GT(reach, 0.5);
    ASSERT_LT(reach, 8.0);
    EXPECT_TRUE(substrates.suits(mycorrhizal, at(0.6 * reach, 0.0), 0.3));
    EXPECT_FALSE(substrates.suits(mycorrhizal, at(reach + 2.0, -6.0), 0.3));
    EXPECT_FALSE(substrates.suits(of_oaks, at(0.6 * reach, 0.0), 0.3)) << "it is another tree's";
    EXPECT_FALSE(substrates.suits(of_oaks, at(5.0, 5.0), 0.3)) << "a log has no roots";
    EXPECT_FALSE(substrates.suits(scenes::grass_species(), at(5.0, 5.0), 0.3));

    FungusSpecies rot = scenes::wood_species();
    rot.ecology.on_standing_wood = false;
    rot.ecology.decay = {0.2, 0.8};
    const std::uint32_t on_log =
        shape->surfels.nearest({5.5, 0.3, 4.2}, {0.0, 1.0, 0.0}, 0.5).value();
    const std::uint32_t on_tree =
        shape->surfels.nearest({0.2, 1.5, 0.0}, {1.0, 0.0, 0.0}, 0.5).value();
    EXPECT_TRUE(substrates.suits(rot, on_log, 0.3));
    EXPECT_FALSE(substrates.suits(rot, on_log, 0.1)) << "the wood is too fresh";
    EXPECT_FALSE(substrates.suits(rot, on_log, 0.9));
    EXPECT_FALSE(substrates.suits(rot, on_tree, 0.3)) << "it lives on fallen wood alone";
    rot.ecology.on_standing_wood = true;
    EXPECT_TRUE(substrates.suits(rot, on_tree, 0.3));
    rot.kinds = bit("spruce");
    EXPECT_FALSE(substrates.suits(rot, on_tree, 0.3));
}

}  // namespace
}  // namespace sporeprint::scene_substrates_test
