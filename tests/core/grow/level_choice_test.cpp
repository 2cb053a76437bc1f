#include "core/grow/level_choice.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/geometry/budget.h"
#include "core/grow/colony.h"
#include "core/grow/colony_estimate.h"
#include "core/grow/colony_individuals.h"
#include "core/grow/leaf.h"
#include "core/grow/levels.h"
#include "core/grow/mushroom.h"
#include "core/grow/names.h"
#include "core/grow/tree.h"
#include "core/individual/proportion.h"
#include "tests/support/drawing.h"
#include "tests/support/effort.h"
#include "tests/support/glb_reader.h"
#include "tests/support/meshes.h"
#include "tests/support/mixes.h"
#include "tests/support/orders.h"
#include "tests/support/refusals.h"

namespace sporeprint::grow_level_choice_test {
namespace {

constexpr int last_whole = static_cast<int>(details.size()) - 1;

std::vector<DetailLevel> all_levels() {
    std::vector<DetailLevel> levels;
    for (int lod = 0; lod < last_whole; ++lod)
        for (int eighths = 0; eighths < DetailLevel::steps; ++eighths)
            levels.emplace_back(lod, eighths);
    levels.emplace_back(last_whole);
    return levels;
}

double triangles_at(const Individual& individual, DetailLevel level) {
    return static_cast<double>(body_count(individual, level, false).triangles);
}

double ratio(double a, double b) { return std::max(a, b) / std::min(a, b); }

MushroomSpec for_triangles(MushroomSpec spec, int triangles) {
    spec.params.lod = 0;
    spec.params.triangles = triangles;
    return spec;
}

class EveryLevel : public ::testing::TestWithParam<std::string> {};

INSTANTIATE_TEST_SUITE_P(Atlas, EveryLevel, ::testing::ValuesIn(species_ids()),
                         [](const auto& one) { return one.param; });

TEST_P(EveryLevel, HasNoMoreTrianglesThanTheOneBefore) {
    const Individual individual = resolved(order_of(GetParam(), 0.6, 3));
    double before = triangles_at(individual, 0);
    for (const DetailLevel level : all_levels()) {
        const double count = triangles_at(individual, level);
        EXPECT_LE(count, before) << level.number();
        EXPECT_LE(count, static_cast<double>(triangle_limit(level))) << level.number();
        before = count;
    }
}

TEST_P(EveryLevel, IsAValidMeshOfThePredictedSizeInTheBoxOfItsNeighbours) {
    constexpr std::array<double, 4> ages = {0.6, 0.2, 1.0, 0.0};
    const std::size_t stride = 9 / effort(8, 2, 8);
    for (const double age : std::span(ages).first(effort(4, 1, 4))) {
        MushroomSpec spec = textured(order_of(GetParam(), age, 3));
        spec.params.variation = 1.0;
        const Individual individual = resolved(spec);
        const Bounds whole = bounds(body_mesh(individual, 1));
        const glm::vec3 size = whole.max - whole.min;
        const float extent = std::max({size.x, size.y, size.z});
        for (std::size_t eighth = 1; eighth < 8; eighth += stride)
            for (int lod = 0; lod < last_whole; ++lod) {
                const DetailLevel level(lod, static_cast<int>(eighth));
                SCOPED_TRACE("age " + std::to_string(age) + ", level " +
                             std::to_string(level.number()));
                const Mesh mesh = body_mesh(individual, level);
                expect_valid(mesh);
                const MeshCount count = body_count(individual, level, false);
                EXPECT_EQ(mesh.positions.size(), count.vertices);
                EXPECT_LE(mesh.triangles(), count.triangles);
                const Bounds box = bounds(mesh);
                // Gaps of dropped branches and polygons of twelve corners.
                const float bar = (lod == 2 ? 0.13F : 0.06F) * extent;
                for (int axis = 0; axis < 3; ++axis) {
                    EXPECT_NEAR(box.min[axis], whole.min[axis], bar) << axis;
                    EXPECT_NEAR(box.max[axis], whole.max[axis], bar) << axis;
                }
                if (HasFailure()) return;
            }
    }
}

TEST_P(EveryLevel, OfAChainIsAStepFromItsNeighbours) {
    const bool is_folded =
        atlas().find(GetParam())->species.stages.front().model.spines.is_folded();
    MushroomSpec spec = order_of(GetParam(), 0.6, 3);
    spec.params.file.lods = Lods::msft;
    for (int first = 0; first <= last_whole; ++first) {
        spec.params.lod = first;
        const Individual individual = resolved(spec);
        const std::vector<DetailLevel> levels = levels_in_file(spec, individual);
        EXPECT_EQ(levels.front(), DetailLevel(first));
        for (int lod = first; lod <= last_whole; ++lod)
            EXPECT_EQ(std::count(levels.begin(), levels.end(), DetailLevel(lod)), 1);
        for (std::size_t i = 0; i + 1 < levels.size(); ++i) {
            EXPECT_LT(levels[i], levels[i + 1]);
            const double step =
                triangles_at(individual, levels[i]) / triangles_at(individual, levels[i + 1]);
            if (!individual.is_branched() && !is_folded) {
                EXPECT_LE(step, 4.5) << levels[i].number();
            }
            if (!levels[i].is_whole() || !levels[i + 1].is_whole()) {
                EXPECT_GE(step, least_step) << levels[i].number();
            }
        }
    }
}

TEST_P(EveryLevel, ForTrianglesIsTheNearestInRatio) {
    for (const int wanted : {30'000, 12'000, 7'000, 2'500, 600}) {
        const MushroomSpec spec = for_triangles(order_of(GetParam(), 0.6, 3), wanted);
        const Individual individual = resolved(spec);
        const DetailLevel chosen = first_level(spec, individual);
        const double off = ratio(triangles_at(individual, chosen), wanted);
        for (const DetailLevel level : all_levels()) {
            if (!level.is_whole() && !individual.is_branched() &&
                self_intersecting_curve(individual.outline, level))
                continue;
            EXPECT_LE(off, ratio(triangles_at(individual, level), wanted) + 1e-12)
                << wanted << ": " << level.number() << " is nearer than " << chosen.number();
        }
        EXPECT_LE(static_cast<double>(mesh_of(spec).triangles()), triangles_at(individual, chosen));
    }
}

TEST(LevelChoice, OutOfReachIsTheNearestThereIs) {
    const MushroomSpec fly = order_of("amanita_muscaria");
    EXPECT_EQ(first_level(for_triangles(fly, 1), resolved(fly)), DetailLevel(last_whole));
    EXPECT_EQ(first_level(for_triangles(fly, 10'000'000), resolved(fly)), DetailLevel(0));
}

TEST(LevelChoice, OfAClipIsWholeAndTheSameAtEveryAge) {
    MushroomSpec spec = growing(for_triangles(order_of("amanita_muscaria"), 12'000));
    const DetailLevel chosen = first_level(spec, resolved(spec));
    EXPECT_TRUE(chosen.is_whole());
    for (const double age : {0.0, 0.3, 1.0}) {
        spec.params.age = age;
        EXPECT_EQ(first_level(spec, resolved(spec)), chosen) << age;
    }
    for (const std::string& id : branched_ids()) {
        MushroomSpec coral = growing(for_triangles(order_of(id), 5'000));
        const DetailLevel whole = first_level(coral, resolved(coral));
        coral.params.age = 0.1;
        EXPECT_EQ(first_level(coral, resolved(coral)), whole) << id;
    }
}

TEST(LevelChoice, OfAnIndividualDoesNotChangeIt) {
    const MushroomSpec spec = for_triangles(order_of("boletus_edulis", 0.6, 9), 9'000);
    MushroomSpec plain = spec;
    plain.params.triangles.reset();
    const Individual a = resolved(spec), b = resolved(plain);
    const DetailLevel level = first_level(spec, a);
    EXPECT_TRUE(same_bits(body_mesh(a, level), body_mesh(b, level)));
    EXPECT_EQ(product_name(spec), product_name(plain));
}

TEST(LevelChoice, HasTheImagesOfTheNearestWholeLevel) {
    MushroomSpec spec = for_triangles(painted(order_of("amanita_muscaria"), 512), 12'000);
    const Individual individual = resolved(spec);
    const DetailLevel level = first_level(spec, individual);
    const MushroomSpec images = image_spec(spec, individual);
    EXPECT_EQ(images.params.lod, level.nearest());
    EXPECT_FALSE(images.params.triangles);
    const Estimate e = estimate(spec, individual);
    const auto side = std::uint64_t{512} >> level.nearest();
    EXPECT_EQ(e.texels, 3 * side * side);
    EXPECT_EQ(e.vertices, body_count(individual, level).vertices);
    const ReadScene found = expect_scene(joined(grow_mushroom(spec, atlas()).glb));
    EXPECT_EQ(found.meshes[0][0].mesh.positions.size(), e.vertices);
    EXPECT_TRUE(found.nodes[0].name.ends_with("_t12000_LOD0")) << found.nodes[0].name;
}

TEST(LevelChoice, AChainForTrianglesBeginsThereAndGoesOnWithSteps) {
    MushroomSpec spec = for_triangles(order_of("amanita_muscaria"), 15'000);
    spec.params.file.lods = Lods::nodes;
    const Individual individual = resolved(spec);
    const std::vector<DetailLevel> levels = levels_in_file(spec, individual);
    EXPECT_EQ(levels.front(), first_level(spec, individual));
    EXPECT_EQ(levels.back(), DetailLevel(last_whole));
    for (std::size_t i = 0; i + 1 < levels.size(); ++i) {
        const double step =
            triangles_at(individual, levels[i]) / triangles_at(individual, levels[i + 1]);
        EXPECT_GE(step, least_step);
        EXPECT_LE(step, 4.5);
    }
}

TEST(LevelChoice, IsRefusedBesideALevel) {
    MushroomSpec spec = order_of("amanita_muscaria");
    spec.params.lod = 2;
    spec.params.triangles = 5000;
    EXPECT_TRUE(names(refusal([&] { (void)resolved(spec); }), "/triangles", "lod=2"));
    apply_profile(Profile::mobile, spec.params);
    EXPECT_EQ(spec.params.lod, 1);
    EXPECT_TRUE(refusal([&] { (void)resolved(spec); }).empty()) << "the default of the profile";
}

TEST(LevelChoice, OfOtherProductsIsTheNearestWholeOne) {
    TreeSpec tree{"birch", params_of(*atlas().find_tree("birch"))};
    LeafSpec leaf{"oak", params_of(*atlas().find_leaf("oak"))};
    ColonySpec colony;
    colony.mix = {{"hypholoma_fasciculare", 1000}};
    const Individual typical = typical_individual(colony, atlas());
    const auto expect_nearest = [](auto spec, const auto& level_for, const auto& count_at) {
        for (const int wanted : {1, 300, 3'000, 40'000, 10'000'000}) {
            spec.params.triangles = wanted;
            const auto chosen = level_for(spec);
            EXPECT_FALSE(chosen.params.triangles);
            const double off = ratio(count_at(chosen, chosen.params.lod), wanted);
            for (int lod = 0; lod <= last_whole; ++lod)
                EXPECT_LE(off, ratio(count_at(chosen, lod), wanted)) << wanted << ' ' << lod;
        }
    };
    expect_nearest(
        leaf, [](const LeafSpec& spec) { return at_level(spec); },
        [](LeafSpec spec, int lod) {
            return static_cast<double>(most_of_leaf(spec.params.shape, lod).triangles);
        });
    const Bounds box{glm::vec3(0.0F), glm::vec3(1.0F)};
    expect_nearest(
        tree, [](const TreeSpec& spec) { return at_level(spec); },
        [&](TreeSpec spec, int lod) {
            spec.params.lod = lod;
            return static_cast<double>(levels_of(spec, atlas(), box).front().triangles);
        });
    double before = 1e9;
    for (const int wanted : {1'000'000, 30'000, 3'000, 300}) {
        colony.params.triangles = wanted;
        const ColonySpec chosen = at_level(colony, typical, atlas());
        const Colony parts = colony_parts(chosen, typical, atlas());
        const auto drawn = static_cast<double>(instanced_triangles(parts));
        EXPECT_LE(drawn, before);
        EXPECT_TRUE(chosen.params.lod == 0 || chosen.params.lod == last_whole ||
                    ratio(drawn, wanted) < 4.0)
            << drawn << " for " << wanted;
        before = drawn;
    }
    TreeSpec wanted = tree;
    wanted.params.triangles = 4'000;
    EXPECT_EQ(joined(grow_tree(wanted, atlas()).glb),
              joined(grow_tree(at_level(wanted), atlas()).glb));
}

// At the size where the coarser of two levels of a chain takes over, its silhouette differs by less
// than a pixel along its outline.
TEST_P(EveryLevel, OfAChainHasTheSilhouetteOfTheNext) {
    const double allowed =
        silhouette_tolerance(atlas().find(GetParam())->species.stages.front().model.spines);
    constexpr std::array<ViewDirection, 2> views = {{{20, 0}, {200, 40}}};
    MushroomSpec spec = textured(order_of(GetParam(), 0.6, 3));
    spec.params.file.lods = Lods::msft;
    const Individual individual = resolved(spec);
    const std::vector<Level> levels = levels_of(spec, individual, bounds(body_mesh(individual, 0)));
    for (std::size_t k = 0; k + 1 < levels.size(); ++k) {
        if (levels[k].lod.is_whole() && levels[k + 1].lod.is_whole()) continue;
        const Mesh finer = body_mesh(individual, levels[k].lod),
                   coarser = body_mesh(individual, levels[k + 1].lod);
        const Bounds box = bounds(finer);
        const glm::vec3 size = box.max - box.min;
        const double larger = std::max({size.x, size.y, size.z});
        // No larger than the sizes that neighbouring whole levels are compared at.
        constexpr std::array<int, 3> made_for = {256, 96, 32};
        const int pixels = made_for[static_cast<std::size_t>(levels[k].lod.lod)];
        const int whole = pixels + 3 * pixels / 4;
        const ImagePlane canvas{0.5F * (box.min + box.max), larger * whole / pixels, whole};
        for (const ViewDirection& view : views) {
            const Drawing fine = drawn(finer, view, canvas), coarse = drawn(coarser, view, canvas);
            EXPECT_LT(symmetric_difference(fine, coarse), allowed * outline_length(fine))
                << levels[k].lod.number() << " and " << levels[k + 1].lod.number();
        }
    }
}

}  // namespace
}  // namespace sporeprint::grow_level_choice_test
