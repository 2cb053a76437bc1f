#include "core/trace/form.h"

#include <gtest/gtest.h>

#include <variant>

#include "tests/support/atlas.h"

namespace sporeprint::trace_form_test {
namespace {

TEST(Form, OfEachSpeciesHasThePartsOfItsOutline) {
    std::size_t traceable = 0;
    for (const AtlasEntry& entry : atlas().entries()) {
        const Species& species = entry.species;
        const auto form = trace::form_of(species.facts.form);
        if (!form) continue;
        ++traceable;
        EXPECT_NE(*form, trace::Form::automatic);
        for (const Stage& stage : species.stages) {
            const auto* swept = std::get_if<Swept>(&stage.model.shape);
            ASSERT_NE(swept, nullptr) << species.id.string();
            EXPECT_EQ(!swept->silhouette.hymenium.empty(), trace::has_face(*form))
                << species.id.string();
        }
    }
    EXPECT_GE(traceable, 30U);
}

TEST(Form, OfWhatBranchesOrGrowsFromAWallIsNone) {
    for (const GrowthForm growth :
         {GrowthForm::coral, GrowthForm::antler, GrowthForm::bracket, GrowthForm::crust})
        EXPECT_FALSE(trace::form_of(growth).has_value()) << name(growth);
}

}  // namespace
}  // namespace sporeprint::trace_form_test
