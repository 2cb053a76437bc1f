// Leaves, trees and roots are described like all parameters: they are read, written, and have a
// schema and canonical text.

#include <gtest/gtest.h>

#include <string>

#include "core/colony/root_system.h"
#include "core/params/canonical.h"
#include "core/params/reader.h"
#include "core/params/schema.h"
#include "core/plant/tree.h"
#include "tests/support/atlas.h"

namespace sporeprint::plant_params_test {
namespace {

template <class T>
void expect_described(const T& value) {
    std::vector<Problem> problems;
    const T again = read_all<T>(write(value), problems);
    EXPECT_TRUE(problems.empty()) << problems.front().path << ": " << problems.front().message;
    EXPECT_EQ(again, value);
    EXPECT_EQ(canonical_text(again), canonical_text(value));
    const Value schema = schema_document("plant", T{});
    const Value* properties = schema.find("properties");
    ASSERT_NE(properties, nullptr);
    // The written names are those of the schema.
    const Value written = write(value);
    for (const auto& [key, content] : written.members())
        EXPECT_NE(properties->find(key), nullptr) << key;
}

TEST(PlantParams, OfEveryPresetAreReadBackAsTheyWereWritten) {
    for (const LeafPreset& preset : leaf_presets()) {
        SCOPED_TRACE(preset.id.string());
        expect_described(preset.shape);
        expect_described(preset.palette);
    }
    for (const TreePreset& preset : tree_presets()) {
        SCOPED_TRACE(preset.id.string());
        expect_described(preset.shape);
        expect_described(preset.leaves);
    }
    expect_described(ColonyRoots{});
}

TEST(PlantParams, OwnMatricesComeInAsJson) {
    std::vector<Problem> problems;
    const auto shape = read_json<TreeShape>(
        R"({"order":3,"matrix":"own","rows":[[0.5,0.5],[0.25,0.25,0.5]]})", problems);
    EXPECT_TRUE(problems.empty());
    EXPECT_EQ(matrix_of(shape.topology).rows,
              (std::vector<std::vector<double>>{{0.5, 0.5}, {0.25, 0.25, 0.5}}));
}

}  // namespace
}  // namespace sporeprint::plant_params_test
