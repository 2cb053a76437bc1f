#include "core/world/absence.h"

#include <gtest/gtest.h>

#include "core/grow/world/parts.h"
#include "tests/support/atlas.h"

namespace sporeprint::world_absence_test {
namespace {

WorldParams preset(const char* id) { return params_of(*atlas().find_world(id)); }

std::string reason(const char* species, const WorldParams& params) {
    return reason_of_absence(atlas().find(species)->species.ecology, params);
}

TEST(Absence, HasNoReasonForSpeciesOfThePresets) {
    for (const WorldPreset& world : atlas().worlds()) {
        const WorldParams params = params_of(world);
        std::vector<Problem> problems;
        for (const std::string& id : species_in(params.fungi.species, "", problems))
            EXPECT_EQ(reason(id.c_str(), params), "") << id << " in " << world.id.view();
    }
}

TEST(Absence, NamesTheHostsThatAreMissing) {
    WorldParams pure = preset("beech");
    pure.stand.kinds = Text<256>("broadleaf");
    EXPECT_EQ(reason("amanita_muscaria", pure),
              "It lives on the roots of birch or spruce, none of which grows here.");
    WorldParams bare = preset("beech");
    bare.stand.density = 0.0;
    EXPECT_NE(reason("amanita_muscaria", bare), "");
    bare.stand.lone = Text<48>("birch");
    EXPECT_EQ(reason("amanita_muscaria", bare), "") << "one tree is enough";
}

TEST(Absence, NamesWoodAcidityAndAbundance) {
    WorldParams tidy = preset("beech");
    tidy.stand.dead_wood = 0.0;
    EXPECT_NE(reason("fomes_fomentarius", tidy).find("stand.dead_wood"), std::string::npos);
    WorldParams none = preset("meadow");
    none.fungi.abundance = 0.0;
    EXPECT_NE(reason("marasmius_oreades", none).find("fungi.abundance"), std::string::npos);
    for (const AtlasEntry& entry : atlas().entries()) {
        const ShareResponse& acidity = entry.species.ecology.acidity;
        if (acidity.tolerates.to >= 1.0 || acidity.tolerates.to <= acidity.prefers.to) continue;
        WorldParams sour = preset("meadow");
        sour.soil.acidity = 1.0;
        EXPECT_NE(reason_of_absence(entry.species.ecology, sour).find("soil.acidity is 1."),
                  std::string::npos)
            << entry.species.id.view();
    }
}

}  // namespace
}  // namespace sporeprint::world_absence_test
