// The seeds of shape, surface and damage: each changes its own side of a mushroom alone.

#include <gtest/gtest.h>

#include <array>
#include <string>
#include <vector>

#include "core/grow/mushroom.h"
#include "core/grow/painting.h"
#include "core/individual/mushroom_spec.h"
#include "core/individual/resolve.h"
#include "core/mesh/measure.h"
#include "core/params/canonical.h"
#include "tests/support/atlas.h"

namespace sporeprint::grow_split_seeds_test {
namespace {

MushroomSpec spec_of(const char* id) {
    MushroomSpec spec;
    spec.mix = {{id, 1000}};
    spec.params.seed = 7;
    spec.params.lod = 1;
    spec.params.weathering.bites = 0.7;
    spec.params.weathering.bruise = 0.5;
    return spec;
}

MushroomSpec with(MushroomSpec spec, SplitSeeds seeds) {
    spec.params.seeds = seeds;
    return spec;
}

std::vector<glm::vec3> positions(const MushroomSpec& spec) {
    return mushroom_mesh(spec, resolve(spec, atlas())).positions;
}

PaintParams painting(const MushroomSpec& spec) {
    return paint_spec_of(surface_spec(spec, atlas()), atlas()).front().painting;
}

/// Returns a painting without what differs by the seeds of surface and damage.
PaintParams without_seeds(PaintParams params) {
    params.surface_seed.reset();
    params.dew_seed.reset();
    params.damage_seed = 1;
    params.lightness = 1.0;
    return params;
}

constexpr std::array species = {"amanita_muscaria",    "boletus_edulis",  "cantharellus_cibarius",
                                "morchella_esculenta", "ramaria_formosa", "trametes_versicolor"};

TEST(SplitSeeds, EqualToThatOfTheIndividualChangeNothing) {
    for (const char* id : species) {
        const MushroomSpec own = spec_of(id), same = with(own, {7, 7, 7});
        EXPECT_EQ(positions(same), positions(own)) << id;
        EXPECT_EQ(canonical_text(painting(same)), canonical_text(painting(own))) << id;
        MushroomSpec dropped = same;
        dropped.params.drop_equal_seeds();
        EXPECT_EQ(dropped.params, own.params);
    }
}

TEST(SplitSeeds, AllThreeMakeTheIndividualOfThatSeed) {
    for (const char* id : species) {
        MushroomSpec other = spec_of(id);
        other.params.seed = 11;
        const MushroomSpec split = with(spec_of(id), {11, 11, 11});
        EXPECT_EQ(positions(split), positions(other)) << id;
        const PaintParams one = painting(split), two = painting(other);
        EXPECT_EQ(one.paint_seed(), two.paint_seed());
        EXPECT_EQ(one.damage_seed, two.damage_seed);
        EXPECT_EQ(one.lightness, two.lightness);
        EXPECT_EQ(canonical_text(without_seeds(one)), canonical_text(without_seeds(two))) << id;
    }
}

TEST(SplitSeeds, OfTheSurfaceLeavesTheMeshAndChangesThePainting) {
    for (const char* id : species) {
        const MushroomSpec own = spec_of(id), other = with(own, {{}, 11, {}});
        EXPECT_EQ(positions(other), positions(own)) << id;
        const PaintParams before = painting(own), after = painting(other);
        EXPECT_EQ(after.paint_seed(), 11U);
        EXPECT_NE(after.lightness, before.lightness);
        EXPECT_EQ(after.damage_seed, before.damage_seed);
        EXPECT_EQ(canonical_text(without_seeds(after)), canonical_text(without_seeds(before)));
        PaintParams small_before = before, small_after = after;
        small_before.side = small_after.side = 64;
        const RawImages one = paint_raw(small_before), two = paint_raw(small_after);
        EXPECT_NE(one.rgb[0], two.rgb[0]) << id;
    }
}

TEST(SplitSeeds, OfDamageChangesBitesAndWeatheringAlone) {
    for (const char* id : species) {
        const MushroomSpec own = spec_of(id), other = with(own, {{}, {}, 11});
        EXPECT_NE(positions(other), positions(own)) << id;
        const PaintParams before = painting(own), after = painting(other);
        EXPECT_NE(after.damage_seed, before.damage_seed) << id;
        EXPECT_EQ(after.paint_seed(), before.paint_seed());
        EXPECT_EQ(after.lightness, before.lightness);
        // Without weather nothing is left of it but columns on which closed cuts lie, in the surface.
        MushroomSpec whole = own, whole_other = other;
        for (MushroomSpec* spec : {&whole, &whole_other})
            spec->params.weathering = as_weathering(
                PaintedWeathering<Maybe>{0.0, 0.0, {}, {}, 0.0, 0.0, {}, 0.0, 0.0, 0.0, 0.0, 0.0});
        if (std::string(id) == "amanita_muscaria" || std::string(id) == "boletus_edulis") {
            for (MushroomSpec* spec : {&whole, &whole_other}) {
                spec->params.age = 0.3;
                spec->params.weathering.splits = spec->params.weathering.peel = 0.0;
            }
            const Mesh one = mushroom_mesh(whole, resolve(whole, atlas())),
                       two = mushroom_mesh(whole_other, resolve(whole_other, atlas()));
            EXPECT_NEAR(volume(two), volume(one), 2e-3 * volume(one)) << id;
            EXPECT_EQ(canonical_text(painting(whole_other)), canonical_text(painting(whole))) << id;
        }
    }
}

TEST(SplitSeeds, OfTheShapeChangesTheMeshAndLeavesThePaint) {
    for (const char* id : species) {
        const MushroomSpec own = spec_of(id), other = with(own, {11, {}, {}});
        EXPECT_NE(positions(other), positions(own)) << id;
        const PaintParams before = painting(own), after = painting(other);
        EXPECT_EQ(after.paint_seed(), before.paint_seed());
        EXPECT_EQ(after.damage_seed, before.damage_seed);
        EXPECT_EQ(after.lightness, before.lightness);
        // Warts and gills are where those of the mesh are.
        EXPECT_EQ(after.seed, 11U);
    }
}

TEST(SplitSeeds, OfIndividualsThatShareTheirImagesLeaveThese) {
    MushroomSpec one = spec_of("amanita_muscaria");
    one.params.share = ImageShare::species;
    const MushroomSpec other = with(one, {11, {}, {}});
    EXPECT_NE(positions(other), positions(one));
    PaintParams before = painting(one), after = painting(other);
    // The lengths of the painted shape are those of seed 1 for both.
    EXPECT_EQ(canonical_text(after), canonical_text(before));
    MushroomSpec explicit_default = with(one, {7, 1, 1});
    explicit_default.params.drop_equal_seeds();
    EXPECT_EQ(explicit_default.params, one.params);
    const MushroomSpec painted = with(one, {{}, 7, {}});
    EXPECT_EQ(painting(painted).paint_seed(), 7U);
}

TEST(SplitSeeds, AreInTheTextOnlyIfTheyAreGiven) {
    EXPECT_EQ(canonical_text(MushroomParams{}).find("seeds"), std::string::npos);
    EXPECT_EQ(canonical_text(PaintParams{}).find("surface_seed"), std::string::npos);
    MushroomParams params;
    params.seeds = SplitSeeds{{}, 4, {}};
    EXPECT_NE(canonical_text(params).find("seeds:{surface:4,}"), std::string::npos);
}

}  // namespace
}  // namespace sporeprint::grow_split_seeds_test
