#include "core/model/species.h"

#include <gtest/gtest.h>

#include <functional>
#include <string>
#include <vector>

#include "tests/support/orders.h"

namespace sporeprint::model_species_test {
namespace {

Species fly_agaric() { return atlas().find("amanita_muscaria")->species; }

std::vector<Problem> problems_after(const std::function<void(Species&)>& harm) {
    Species species = fly_agaric();
    harm(species);
    return problems_in(species);
}

Silhouette& silhouette_of(Stage& stage) { return std::get<Swept>(stage.model.shape).silhouette; }

TEST(Species, AtlasSpeciesAreValid) {
    for (const AtlasEntry& entry : atlas().entries())
        EXPECT_EQ(problems_in(entry.species), std::vector<Problem>{}) << entry.species.id.string();
}

OutlinePoint half_way(const OutlinePoint& a, const OutlinePoint& b) {
    return {0.5 * (a.r + b.r), 0.5 * (a.y + b.y)};
}

TEST(Species, InvalidTemplatesAreRefusedWithTheirPath) {
    const auto expect = [](const std::string& path, const std::string& words,
                           const std::function<void(Species&)>& harm) {
        EXPECT_TRUE(names(problems_after(harm), path, words));
    };
    expect("/id", "missing", [](Species& s) { s.id = ""; });
    expect("/id", "'Fly agaric'", [](Species& s) { s.id = "Fly agaric"; });
    expect("/stages", "at least 1", [](Species& s) { s.stages.clear(); });
    expect("/stages", "", [](Species& s) { s.stages.resize(9, s.stages.back()); });
    expect("/stages/1/age", "ascending", [](Species& s) { s.stages[1].age = s.stages[0].age; });
    expect("/stages/2/age", "", [](Species& s) { s.stages[2].age = 1.5; });
    expect("/stages/1/model/silhouette/stem", "the first stage has", [](Species& s) {
        auto& stem = silhouette_of(s.stages[1]).stem;
        stem.insert(stem.begin() + 1, half_way(stem[0], stem[1]));
    });
    expect("/stages/1/model/silhouette/hymenium", "the first stage has", [](Species& s) {
        auto& hymenium = silhouette_of(s.stages[1]).hymenium;
        hymenium.insert(hymenium.begin() + 1, half_way(hymenium[0], hymenium[1]));
    });
    expect("/stages/3/model/silhouette/cap", "the first stage has", [](Species& s) {
        auto& cap = silhouette_of(s.stages[3]).cap;
        cap.insert(cap.begin() + 1, half_way(cap[0], cap[1]));
    });
    expect("/stages/2/model/silhouette/cap/0", "last point of the hymenium",
           [](Species& s) { silhouette_of(s.stages[2]).cap[0].r += 0.001; });
    expect("/stages/1/model/axis", "the first stage has", [](Species& s) {
        std::get<Swept>(s.stages[1].model.shape).axis = {{}, {0.0, 1.0, 0.0}};
    });
    expect("/stages/1/model/surface/cap/ramp", "as many colours",
           [](Species& s) { s.stages[1].model.surface.cap.ramp.pop_back(); });
    expect("/stages/1/model/surface/hymenium/pattern", "pattern of the first",
           [](Species& s) { s.stages[1].model.surface.hymenium.pattern = HymeniumPattern::pores; });
    expect("/stages/1/model/surface/cap/skin/kind", "kind of the first",
           [](Species& s) { s.stages[1].model.surface.cap.skin.kind = SkinKind::granular; });
    expect("/stages/1/model/surface/stem/skin/kind", "kind of the first",
           [](Species& s) { s.stages[1].model.surface.stem.skin.kind = SkinKind::granular; });
    expect("/stages/1/model/warts", "those of the first",
           [](Species& s) { s.stages[1].model.warts.count = 7; });
    expect("/stages/1/model/scales", "those of the first",
           [](Species& s) { s.stages[1].model.scales.from = 0.3; });
    expect("/stages/1/model/volva", "those of the first",
           [](Species& s) { s.stages[1].model.volva.elongation = 2.0; });
    expect("/stages/0/model/ring/width", "", [](Species& s) { s.stages[0].model.ring.width = -1; });
    expect("/stages/0/model/deformation/zone_to", "zone_from", [](Species& s) {
        s.stages[0].model.deformation.zone_from = 0.5;
        s.stages[0].model.deformation.zone_to = 0.55;
    });
    expect("/spread/size", "", [](Species& s) { s.spread.size = 9.0; });
    expect("/facts/season/0", "", [](Species& s) { s.facts.season[0] = 13; });
    expect("/facts/height_m", "", [](Species& s) { s.facts.height_m = {0.3, 0.1}; });
}

TEST(Species, AllProblemsAreReportedAtOnce) {
    const auto problems = problems_after([](Species& s) {
        s.stages[1].age = 0.0;
        s.stages[1].model.warts.count = 7;
        s.stages[2].model.surface.cap.ramp.pop_back();
    });
    EXPECT_EQ(problems.size(), 3u);
}

TEST(Species, OneStageIsEnough) {
    EXPECT_TRUE(problems_after([](Species& s) { s.stages.resize(1); }).empty());
}

}  // namespace
}  // namespace sporeprint::model_species_test
