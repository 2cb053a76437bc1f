// The ecologies of the atlas against the recorded facts of the same files, and against numbers of
// the literature.
#include "core/model/ecology.h"

#include <gtest/gtest.h>
#include <xxhash.h>

#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <string_view>

#include "core/atlas/atlas.h"
#include "core/math/elementary.h"
#include "core/params/canonical.h"
#include "core/params/reader.h"
#include "core/plant/tree_spec.h"
#include "tests/support/atlas.h"

namespace sporeprint::atlas_ecology_test {
namespace {

bool mentions(std::string_view text, std::string_view word) {
    return text.find(word) != std::string_view::npos;
}

bool mentions_any(std::string_view text, std::initializer_list<std::string_view> words) {
    return std::any_of(words.begin(), words.end(),
                       [&](std::string_view word) { return mentions(text, word); });
}

bool grows_on(const Ecology& ecology, std::string_view tree) {
    return std::any_of(ecology.trees.begin(), ecology.trees.end(),
                       [&](const Text<48>& one) { return one.view() == tree; });
}

template <class Use>
void for_each_species(Use use) {
    for (const AtlasEntry& entry : atlas().entries()) {
        SCOPED_TRACE(entry.species.id.string());
        use(entry.species, entry.species.facts, entry.species.ecology);
    }
}

TEST(EcologyOfSpecies, IsItsOwn) {
    std::set<std::string> texts;
    for_each_species([&](const Species&, const Facts& facts, const Ecology& ecology) {
        EXPECT_NE(ecology, Ecology{});
        EXPECT_TRUE(texts.insert(canonical_text(ecology)).second) << "another one has the same";
        EXPECT_FALSE(facts.season.empty());
    });
}

TEST(EcologyOfSpecies, NamesTreesOfTheAtlas) {
    for_each_species([&](const Species&, const Facts&, const Ecology& ecology) {
        std::set<std::string> trees;
        for (const Text<48>& tree : ecology.trees) {
            EXPECT_NE(atlas().find_tree(tree), nullptr) << tree.view();
            EXPECT_TRUE(trees.insert(tree.string()).second) << tree.view() << " stands there twice";
        }
        EXPECT_EQ(ecology.trees.empty() && ecology.guild == Guild::ectomycorrhizal, false)
            << "a mycorrhizal species has recorded hosts";
        if (ecology.guild == Guild::grass) {
            EXPECT_TRUE(ecology.trees.empty());
        }
    });
}

// What comes up through soil from buried wood counts to the litter: it needs no trunk to stand on.
TEST(EcologyOfSpecies, IsOfWoodWhereThatIsTheWholeSubstrate) {
    for_each_species([&](const Species& species, const Facts& facts, const Ecology& ecology) {
        const bool on_wood =
            mentions(facts.substrate, "wood") && !mentions(facts.substrate, "soil");
        EXPECT_EQ(ecology.guild == Guild::wood, on_wood) << facts.substrate.view();
        if (on_wood) {
            EXPECT_TRUE(
                mentions_any(facts.habitat, {"wood", "branch", "trunk", "stump", "twig", "elder"}))
                << facts.habitat.view();
            EXPECT_LT(ecology.decay.from, ecology.decay.to);
        } else {
            EXPECT_FALSE(ecology.on_standing_wood);
            EXPECT_EQ(ecology.decay, (Range{0.0, 1.0})) << "only wood decays";
        }
        // What grows sideways from a wall needs one.
        if (species.is_lateral()) {
            EXPECT_TRUE(on_wood);
        }
    });
}

TEST(EcologyOfSpecies, OfTurfIsThatOfWhatGrowsInGrass) {
    for_each_species([&](const Species&, const Facts& facts, const Ecology& ecology) {
        if (ecology.guild == Guild::grass) {
            EXPECT_TRUE(mentions_any(facts.habitat, {"grass", "lawn", "pasture", "meadow"}))
                << facts.habitat.view();
            EXPECT_EQ(ecology.light.at(1.0), 1.0) << "turf lies in the open";
            EXPECT_LT(ecology.light.at(0.1), 0.5) << "turf does not grow in a wood";
        } else {
            EXPECT_GT(ecology.light.at(0.4), 0.5) << "woods have such light at their edges";
        }
        if (mentions(facts.habitat, "in wet shade") || mentions(facts.habitat, "damp")) {
            EXPECT_EQ(ecology.light.at(0.1), 1.0);
            EXPECT_EQ(ecology.wetness.at(0.8), 1.0);
        }
    });
}

TEST(EcologyOfSpecies, HasTheTreesOfItsHabitat) {
    const std::map<std::string_view, std::string_view> trees = {
        {"birch", "birch"},   {"beech", "broadleaf"}, {"oak", "broadleaf"}, {"poplar", "poplar"},
        {"willow", "poplar"}, {"pine", "spruce"},     {"spruce", "spruce"}, {"elder", "shrub"}};
    for_each_species([&](const Species&, const Facts& facts, const Ecology& ecology) {
        if (ecology.guild != Guild::ectomycorrhizal && ecology.guild != Guild::wood) return;
        const std::string_view habitat = facts.habitat;
        // What it is seldom on is no reason to stand in such a wood.
        const std::string_view usual = habitat.substr(0, habitat.find("seldom"));
        for (const auto& [word, tree] : trees)
            if (mentions(usual, word)) {
                EXPECT_TRUE(grows_on(ecology, tree)) << word;
            }
        if (mentions(usual, "broad-leaved") && !ecology.trees.empty()) {
            EXPECT_TRUE(grows_on(ecology, "broadleaf"));
        }
    });
}

TEST(EcologyOfSpecies, OfAcidAndLimyPlacesDiffers) {
    for_each_species([&](const Species&, const Facts& facts, const Ecology& ecology) {
        if (mentions(facts.habitat, "lime-rich")) {
            EXPECT_GT(ecology.acidity.at(0.1), ecology.acidity.at(0.7));
        } else if (mentions(facts.habitat, "acid")) {
            EXPECT_LT(ecology.acidity.at(0.1), ecology.acidity.at(0.7));
        }
    });
}

// In the middle of a temperate year (mean 8.5, amplitude 9.5 degrees) some month of each season is warm
// enough.
TEST(EcologyOfSpecies, FruitsInTheTemperaturesOfItsMonths) {
    for_each_species([&](const Species&, const Facts& facts, const Ecology& ecology) {
        double most = 0.0;
        for (const int month : facts.season) {
            const double day = 30.4 * (month - 0.5);
            most = std::max(
                most, ecology.temperature.at(8.5 + 9.5 * cosine(2.0 * pi * (day - 197.0) / 365.0)));
        }
        EXPECT_GT(most, 0.5);
        const std::set<int> months(facts.season.begin(), facts.season.end());
        const bool in_midsummer = months.count(7) > 0;
        if (!in_midsummer) {
            EXPECT_LT(ecology.temperature.at(24.0), 0.5);
        }
    });
    const Ecology& oyster = atlas().find("pleurotus_ostreatus")->species.ecology;
    EXPECT_EQ(oyster.temperature.at(16.0), 0.0) << "it fruits only below 16 degrees";
    EXPECT_EQ(oyster.temperature.at(8.0), 1.0);
}

// Recorded lengths and widths of spores, micrometres, from the sources that the facts of each species name.
TEST(EcologyOfSpecies, HasSporesThatFallByStokesLaw) {
    struct Size {
        const char* id;
        double length, width;
    };
    constexpr Size sizes[] = {
        {"amanita_muscaria", 11, 8},          {"amanita_phalloides", 9.5, 8},
        {"armillaria_mellea", 8.25, 6},       {"boletus_edulis", 16, 5.25},
        {"cantharellus_cibarius", 9, 5.25},   {"coprinus_comatus", 12.5, 8.25},
        {"disciotis_venosa", 22, 13.5},       {"fomes_fomentarius", 17.5, 6},
        {"geastrum_triplex", 4.5, 4.5},       {"hypholoma_fasciculare", 7, 4.25},
        {"laccaria_amethystina", 9.5, 9.5},   {"lycoperdon_perlatum", 3.75, 3.75},
        {"macrolepiota_procera", 17.5, 11.5}, {"marasmius_oreades", 8.5, 5},
        {"morchella_esculenta", 19, 9.75},    {"mycena_galericulata", 10.25, 7},
        {"phallus_impudicus", 4, 2},          {"pleurotus_ostreatus", 10, 3.75},
        {"psilocybe_semilanceata", 13, 8},    {"russula_emetica", 9.5, 8},
        {"trametes_versicolor", 5, 2},        {"tremella_mesenterica", 8.5, 8}};
    for (const Size& size : sizes) {
        constexpr double density = 1000.0, gravity = 9.81, viscosity = 1.81e-5;
        const double cube = 1e-18 * size.length * size.width * size.width;
        const double expected = density * gravity * power(cube, 2.0 / 3.0) / (18.0 * viscosity);
        const double settling = atlas().find(size.id)->species.ecology.spores.settling;
        EXPECT_NEAR(settling / expected, 1.0, 0.3) << size.id;
    }
}

TEST(EcologyOfSpecies, ReleasesSporesAtTheHeightOfItsBodies) {
    for_each_species([&](const Species&, const Facts& facts, const Ecology& ecology) {
        if (ecology.on_standing_wood) {
            EXPECT_GE(ecology.spores.height, 0.2);
        } else if (ecology.guild != Guild::wood) {
            EXPECT_GE(ecology.spores.height, 0.3 * facts.height_m.from);
            EXPECT_LE(ecology.spores.height, facts.height_m.to);
        }
    });
}

TEST(EcologyOfSpecies, IsPerennialWhereTheHabitSaysSo) {
    for_each_species([&](const Species&, const Facts& facts, const Ecology& ecology) {
        EXPECT_EQ(ecology.body.perennial, mentions(facts.habit, "perennial"));
        if (ecology.body.perennial) {
            EXPECT_GT(ecology.body.days_alive, 365.0);
        }
    });
}

// Life spans of fruit bodies, days, of the sources of mycology.md 2.11.
TEST(EcologyOfSpecies, HasBodiesThatLiveAsLongAsObserved) {
    struct Life {
        const char* id;
        double least, most;
    };
    constexpr Life lives[] = {{"amanita_muscaria", 7, 10},       {"boletus_edulis", 10, 21},
                              {"cantharellus_cibarius", 14, 45}, {"coprinus_comatus", 2, 5},
                              {"disciotis_venosa", 20, 84},      {"fomes_fomentarius", 1000, 10000},
                              {"geastrum_triplex", 60, 300},     {"hygrocybe_conica", 10, 21},
                              {"lycoperdon_perlatum", 30, 200},  {"morchella_esculenta", 6, 20},
                              {"phallus_impudicus", 2, 5},       {"trametes_versicolor", 180, 365},
                              {"xylaria_hypoxylon", 60, 365}};
    for (const Life& life : lives) {
        const BodyLife& body = atlas().find(life.id)->species.ecology.body;
        EXPECT_LE(body.days_alive, life.most) << life.id;
        EXPECT_GE(body.days_to_mature + body.days_alive, life.least) << life.id;
    }
}

// Bodies that stand together, of species_facts.json (cluster_size_count).
TEST(EcologyOfSpecies, StandsInTuftsAsLargeAsCounted) {
    struct Count {
        const char* id;
        double least, most;
    };
    constexpr Count counts[] = {
        {"armillaria_mellea", 5, 60},       {"coprinellus_disseminatus", 50, 500},
        {"fomes_fomentarius", 1, 20},       {"geastrum_triplex", 1, 10},
        {"hypholoma_fasciculare", 10, 100}, {"lycoperdon_perlatum", 1, 20},
        {"mycena_galericulata", 3, 25},     {"mycena_haematopus", 3, 30},
        {"phallus_impudicus", 1, 10},       {"pleurotus_ostreatus", 3, 30},
        {"trametes_versicolor", 5, 100},    {"tremella_mesenterica", 1, 8},
        {"xylaria_hypoxylon", 3, 40}};
    for (const Count& count : counts) {
        const FruitHabit& fruit = atlas().find(count.id)->species.ecology.fruit;
        EXPECT_GE(fruit.clusters * fruit.tufts, count.least) << count.id;
        EXPECT_LE(fruit.clusters * fruit.tufts, count.most) << count.id;
    }
    for_each_species([&](const Species&, const Facts& facts, const Ecology& ecology) {
        const double together = ecology.fruit.clusters * ecology.fruit.tufts;
        if (mentions(facts.habit, "tufts")) {
            EXPECT_GE(ecology.fruit.tufts, 5.0);
        }
        if (facts.habit.view() == "solitary") {
            EXPECT_EQ(together, 1.0);
        }
        EXPECT_LE(ecology.fruit.tufts == 1.0 ? 0.0 : ecology.fruit.tuft_spread, 0.15);
    });
}

TEST(EcologyOfSpecies, AdvancesAsFastAsMeasuredRings) {
    for_each_species([&](const Species&, const Facts& facts, const Ecology& ecology) {
        const GenetHabit& genet = ecology.genet;
        EXPECT_GT(genet.rate, 0.0);
        if (mentions(facts.habit, "ring")) {
            EXPECT_GE(genet.speed, 0.06) << "rings advance 0.07 to 0.75 m a year";
            EXPECT_LE(genet.speed, 0.75);
        }
        EXPECT_GE(genet.speed * genet.life, 0.8) << "a mycelium becomes larger than a fruit body";
        if (ecology.guild == Guild::ectomycorrhizal) {
            EXPECT_LE(genet.reach, 8.0) << "mycelia of mature stands are up to 16 m across";
            EXPECT_LE(genet.speed, 0.2);
        }
        EXPECT_FALSE(ecology.ring.pioneer) << "pioneers leave a tree within years";
    });
    const GenetHabit& champignon = atlas().find("marasmius_oreades")->species.ecology.genet;
    EXPECT_EQ(champignon.speed, 0.3);
    EXPECT_EQ(champignon.reach, 20.0);
}

TEST(EcologyOfSpecies, SwellsInDaysOnlyIfItIsAJelly) {
    for_each_species([&](const Species&, const Facts& facts, const Ecology& ecology) {
        EXPECT_EQ(ecology.fruit.rain_memory <= 3, facts.form == GrowthForm::jelly);
    });
}

// Mushrooms have addresses with a token that is valid as long as their bytes are the same.
TEST(EcologyOfSpecies, IsNoPartOfTheHashOfAMushroom) {
    for (const AtlasEntry& entry : atlas().entries()) {
        std::string json = entry.json;
        const std::string ecology = "\"ecology\":" + dump(write(entry.species.ecology)) + ',';
        const std::size_t at = json.find(ecology);
        ASSERT_NE(at, std::string::npos);
        json.erase(at, ecology.size());
        EXPECT_EQ(entry.hash, XXH3_64bits(json.data(), json.size()))
            << "the hash is that of the text before there were ecologies";
        Species other = entry.species;
        other.ecology.genet.life += 1.0;
        const AtlasEntry changed = atlas_entry(other);
        EXPECT_EQ(changed.hash, entry.hash);
        EXPECT_NE(changed.ecology_hash, entry.ecology_hash);
        EXPECT_NE(changed.json, entry.json);
    }
}

TEST(EcologyOfTrees, HasTheDecayThatWasMeasured) {
    const auto of = [](const char* id) { return atlas().find_tree(id)->ecology; };
    EXPECT_EQ(of("beech").decay, 0.054);
    EXPECT_EQ(of("spruce").decay, 0.033);
    for (const TreePreset& tree : atlas().trees()) {
        EXPECT_NE(tree.ecology, TreeEcology{}) << tree.id.view();
        EXPECT_EQ(tree.ecology.evergreen, tree.id.view() == "spruce");
        EXPECT_GT(tree.ecology.decay, 0.03) << tree.id.view();
    }
    EXPECT_LT(of("spruce").crown, of("broadleaf").crown) << "it is narrower";
    EXPECT_LT(of("herb").height, of("shrub").height);
    EXPECT_LT(of("shrub").height, of("birch").height);
    // Pioneers need light and die young.
    for (const char* pioneer : {"birch", "poplar"}) {
        EXPECT_LT(of(pioneer).light.at(0.1), 0.1) << pioneer;
        EXPECT_LT(of(pioneer).life, of("broadleaf").life) << pioneer;
    }
    EXPECT_EQ(of("beech").light.at(0.1), 1.0);
}

TEST(EcologyOfTrees, IsNoParameterOfATree) {
    TreePreset other = *atlas().find_tree("birch");
    const std::string text = canonical_text(params_of(other));
    other.ecology.height = 3.0;
    EXPECT_EQ(canonical_text(params_of(other)), text);
}

}  // namespace
}  // namespace sporeprint::atlas_ecology_test
