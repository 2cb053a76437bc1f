#include "core/plant/leaf_spec.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "core/params/canonical.h"
#include "core/params/corners.h"
#include "core/params/query.h"
#include "tests/support/atlas.h"
#include "tests/support/draws.h"
#include "tests/support/effort.h"

namespace sporeprint::plant_leaf_spec_test {
namespace {

TEST(LeafSpec, APresetHasItsOwnParametersByDefault) {
    for (const LeafPreset& preset : leaf_presets()) {
        const LeafParams params = params_of(preset);
        EXPECT_EQ(params.shape, preset.shape) << preset.id.string();
        EXPECT_EQ(params.palette, preset.palette) << preset.id.string();
        std::vector<Problem> problems;
        check(params, Info{.name = ""}, "", problems);
        EXPECT_TRUE(problems.empty()) << preset.id.string();
        EXPECT_EQ(query_text(params, params_of(preset)), "") << preset.id.string();
    }
}

TEST(LeafSpec, IsReadBackFromItsQuery) {
    Random random(3, 1);
    for (std::size_t i = 0; i < effort(200, 20); ++i) {
        const LeafParams own = params_of(leaf_presets()[i % leaf_presets().size()]);
        auto params = drawn<LeafParams>(random);
        params.palette.summer.inner = {1, 200, 3};
        const std::string text = query_text(params, own);
        std::vector<std::pair<std::string, std::string>> pairs;
        for (std::size_t at = 0; at < text.size();) {
            const std::size_t end = std::min(text.find('&', at), text.size());
            const std::string pair = text.substr(at, end - at);
            std::string value = pair.substr(pair.find('=') + 1);
            if (value.starts_with("%23")) value = '#' + value.substr(3);  // a colour
            pairs.emplace_back(pair.substr(0, pair.find('=')), value);
            at = end + 1;
        }
        LeafParams again = own;
        std::vector<Problem> problems;
        read_query(pairs, again, problems);
        ASSERT_TRUE(problems.empty()) << text << ": " << problems.front().message;
        ASSERT_EQ(canonical_text(again), canonical_text(params)) << text;
    }
}

TEST(LeafSpec, IndividualsOfAnyShapeAreValid) {
    Random random(9, 1);
    for (std::size_t i = 0; i < effort(5000, 300); ++i) {
        const auto shape = drawn<LeafShape>(random);
        const double variation = random.uniform();
        const LeafShape leaf = individual_leaf(shape, random.bits(), variation);
        std::vector<Problem> problems;
        check(leaf, Info{.name = ""}, "", problems);
        ASSERT_TRUE(problems.empty()) << problems.front().path << problems.front().message;
    }
}

TEST(LeafSpec, WithoutVariationEveryIndividualIsTheShapeItself) {
    for (const LeafPreset& preset : leaf_presets())
        EXPECT_EQ(individual_leaf(preset.shape, 7, 0.0), preset.shape) << preset.id.string();
    const LeafShape shape = leaf_preset("maple")->shape;
    EXPECT_NE(individual_leaf(shape, 7, 0.5), individual_leaf(shape, 8, 0.5));
}

TEST(LeafSpec, IndividualsVarySymmetricallyWithVariation) {
    const LeafShape shape = leaf_preset("birch")->shape;
    double mean = 0.0, squares = 0.0;
    constexpr int count = 2000;
    for (std::uint32_t seed = 0; seed < count; ++seed) {
        const double curl = individual_leaf(shape, seed, 1.0).curl_deg - shape.curl_deg;
        mean += curl / count;
        squares += curl * curl / count;
    }
    EXPECT_NEAR(mean, 0.0, 4.0 * 12.0 / std::sqrt(count));
    EXPECT_NEAR(std::sqrt(squares), 12.0, 1.0);
}

TEST(LeafSpec, ImagesDoNotDependOnParametersOfTheShape) {
    const LeafParams params = params_of(*leaf_preset("oak"));
    LeafParams other = params;
    other.size = 2.0;
    other.shape.length = 0.3;
    other.shape.petiole = 1.0;
    other.shape.curl_deg = other.shape.fold_deg = 3.0;
    other.shape.wave = 1.0;
    other.textures = Textures::linked;
    EXPECT_EQ(paint_of(other), paint_of(params));
    other.lod = 2;
    EXPECT_EQ(paint_of(other).texture_size.value, 256);
    other.lod = 0;
    other.shape.relief = 0.1;
    EXPECT_NE(paint_of(other), paint_of(params));
}

TEST(LeafSpec, CountsNeverExceedTheEstimate) {
    const auto expect_enough = [](const LeafShape& shape, int lod) {
        const LeafCount most = most_of_leaf(shape, lod);
        const Mesh mesh = leaf_mesh(shape, lod);
        EXPECT_LE(mesh.positions.size(), most.vertices) << lod;
        EXPECT_LE(mesh.triangles(), most.triangles) << lod;
        return static_cast<double>(most.triangles) - 6.0 * static_cast<double>(mesh.triangles());
    };
    for (const LeafPreset& preset : leaf_presets())
        for (int lod = 0; lod < leaf_lods; ++lod) {
            SCOPED_TRACE(preset.id.string());
            EXPECT_LT(expect_enough(preset.shape, lod), 200.0) << lod;
            LeafShape shape = preset.shape;
            walk_corners(shape, Info{.name = ""}, "", [&](const std::string&) {
                std::vector<Problem> problems;
                check(shape, Info{.name = ""}, "", problems);
                if (problems.empty()) expect_enough(shape, lod);
            });
        }
    Random random(4, 1);
    for (std::size_t i = 0; i < effort(300, 40); ++i)
        expect_enough(drawn<LeafShape>(random), static_cast<int>(i % leaf_lods));
}

}  // namespace
}  // namespace sporeprint::plant_leaf_spec_test
