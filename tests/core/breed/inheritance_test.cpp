#include "core/breed/inheritance.h"

#include <gtest/gtest.h>

#include <string>
#include <type_traits>
#include <variant>

#include "core/breed/traits.h"
#include "tests/support/atlas.h"

namespace sporeprint::breed_inheritance_test {
namespace {

const Species& species_of(const char* id) { return atlas().find(id)->species; }

TEST(Scaled, MultipliesLengthsAlone) {
    const Species& own = species_of("amanita_muscaria");
    EXPECT_EQ(scaled(own, 1.0), own);
    const Species twice = scaled(own, 2.0);
    const Model &before = own.stages[3].model, &after = twice.stages[3].model;
    EXPECT_DOUBLE_EQ(std::get<Swept>(after.shape).silhouette.cap[1].r,
                     2.0 * std::get<Swept>(before.shape).silhouette.cap[1].r);
    EXPECT_DOUBLE_EQ(after.ring.width, 2.0 * before.ring.width);
    EXPECT_EQ(after.ring.height, before.ring.height);
    EXPECT_EQ(after.warts, before.warts);
    EXPECT_DOUBLE_EQ(twice.facts.height_m.to, 2.0 * own.facts.height_m.to);
    EXPECT_EQ(twice.spread, own.spread);
    EXPECT_EQ(twice.ecology, own.ecology) << "mycelia do not grow with their bodies";
}

TEST(MostScale, IsWhereAnOutlineReachesItsRange) {
    const Species& own = species_of("macrolepiota_procera");
    const double most = most_scale(own);
    EXPECT_GT(most, 1.0);
    const Info r = info_of<OutlinePoint>("r"), y = info_of<OutlinePoint>("y");
    double reach = 0.0;
    for (const Stage& stage : scaled(own, most).stages)
        for (const OutlinePoint& point : std::get<Swept>(stage.model.shape).silhouette.cap)
            reach = std::max({reach, point.r / r.max, point.y / y.max});
    EXPECT_NEAR(reach, 1.0, 1e-9);
}

TEST(ModelAt, IsAStageAtItsAge) {
    const Species& own = species_of("boletus_edulis");
    for (const Stage& stage : own.stages) EXPECT_EQ(model_at(own, stage.age), stage.model);
    const double between = 0.5 * (own.stages[1].age + own.stages[2].age);
    const double roughness = model_at(own, between).surface.cap.roughness;
    EXPECT_NEAR(roughness,
                0.5 * (own.stages[1].model.surface.cap.roughness +
                       own.stages[2].model.surface.cap.roughness),
                1e-12);
}

TEST(Crossed, HasEachRoomOfOneParent) {
    const Species &a = species_of("amanita_muscaria"), &b = species_of("lactarius_deliciosus");
    BreedingParams params;
    int of_a = 0, of_b = 0;
    for (params.seed = 0; params.seed < 20; ++params.seed) {
        const Species child = crossed(a, b, Genes(params));
        for (const Stage& stage : child.stages) {
            Model model = stage.model;
            visit_traits(model, model_at(a, stage.age), model_at(b, stage.age), "",
                         [&]<class T>(const T& own, const T& first, const T& second,
                                      const std::string& path) {
                             if constexpr (!is_blended_trait<T> && !std::is_same_v<T, Silhouette> &&
                                           !std::is_same_v<T, std::vector<AxisPoint>>) {
                                 EXPECT_TRUE(own == first || own == second) << path;
                                 of_a += own == first && own != second ? 1 : 0;
                                 of_b += own == second && own != first ? 1 : 0;
                             }
                         });
            // What fits together alone comes together.
            const bool gills_of_a = model.hymenium == model_at(a, stage.age).hymenium;
            EXPECT_EQ(gills_of_a,
                      model.surface.hymenium == model_at(a, stage.age).surface.hymenium);
            EXPECT_EQ(model.ring == model_at(a, stage.age).ring,
                      model.ornaments.ring == model_at(a, stage.age).ornaments.ring);
        }
        EXPECT_TRUE(child.ground == a.ground || child.ground == b.ground);
    }
    EXPECT_GT(of_a, 100);
    EXPECT_GT(of_b, 100);
}

TEST(Crossed, BlendsTheSpreadOfIndividuals) {
    const Species &a = species_of("amanita_muscaria"), &b = species_of("mycena_galericulata");
    BreedingParams params;
    params.seed = 3;
    const Spread spread = crossed(a, b, Genes(params)).spread;
    const double low = std::min(a.spread.bend_deg, b.spread.bend_deg),
                 high = std::max(a.spread.bend_deg, b.spread.bend_deg);
    EXPECT_GE(spread.bend_deg, low);
    EXPECT_LE(spread.bend_deg, high);
}

TEST(Crossed, KeepsWhatIsLockedOfTheFirst) {
    const Species &a = species_of("amanita_muscaria"), &b = species_of("lactarius_deliciosus");
    BreedingParams params;
    params.share = 1.0;
    params.lock = {Text<64>("stages"), Text<64>("surface.stem"), Text<64>("hymenium.blades"),
                   Text<64>("surface.hymenium.colour")};
    const Species child = crossed(a, b, Genes(params));
    for (std::size_t i = 0; i < a.stages.size(); ++i) {
        const Model &own = child.stages[i].model, &first = a.stages[i].model,
                    second = model_at(b, a.stages[i].age);
        EXPECT_EQ(own.surface.stem, first.surface.stem);
        EXPECT_EQ(own.surface.cap, second.surface.cap);
        EXPECT_EQ(own.hymenium.blades, first.hymenium.blades);
        EXPECT_EQ(own.hymenium.depth, second.hymenium.depth);
        EXPECT_EQ(own.surface.hymenium.colour, first.surface.hymenium.colour);
        EXPECT_EQ(own.surface.hymenium.edge, second.surface.hymenium.edge);
    }
}

TEST(Crossed, LivesWhereOneParentDoesAndOnWoodIfItGrowsSideways) {
    const Species &soil = species_of("amanita_muscaria"), &wood = species_of("pleurotus_ostreatus");
    BreedingParams params;
    int on_wood = 0;
    for (params.seed = 0; params.seed < 30; ++params.seed) {
        const Species child = crossed(soil, wood, Genes(params));
        EXPECT_TRUE(child.ecology == soil.ecology || child.ecology == wood.ecology);
        EXPECT_EQ(child.is_lateral(), child.ecology.guild == Guild::wood) << params.seed;
        on_wood += child.ecology.guild == Guild::wood ? 1 : 0;
    }
    EXPECT_GT(on_wood, 5);
    EXPECT_LT(on_wood, 25);
    params.share = 1.0;
    EXPECT_EQ(crossed(soil, wood, Genes(params)).ecology, wood.ecology);
    params.lock = {Text<64>("ecology")};
    EXPECT_EQ(crossed(soil, wood, Genes(params)).ecology, soil.ecology);
}

}  // namespace
}  // namespace sporeprint::breed_inheritance_test
